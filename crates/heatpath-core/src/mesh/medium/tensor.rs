//! Metrics that depend on direction.
//!
//! What is given is always the *metric* G, by which lengths are `sqrt(dx' G dx)`: large where and along
//! which it is slow. The diffusion tensor of eq. (12) is its inverse.

use super::given::{check_count, is_sensible};
use super::{Medium, MediumError};
use crate::mesh::TriMesh;
use crate::mesh::vector::{Vector, cross, dot, length, scale, subtract};
use std::sync::Arc;

/// A direction and what it costs to go along and across it: the metric
/// `along^2 c c' + across^2 (1 - c c')` with the unit vector c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directed {
    /// The direction, of any length; its part in the plane of the face counts. Where that is zero,
    /// all directions cost [`across`](Self::across).
    pub direction: [f64; 3],
    /// The slowness along it, from 1e-50 to 1e50.
    pub along: f64,
    /// The slowness across it, from 1e-50 to 1e50.
    pub across: f64,
}

impl Medium {
    /// A medium with a metric for each face: lengths are `sqrt(dx' G dx)` with a symmetric 3 x 3
    /// matrix G in space, of which the part in the plane of the face counts.
    ///
    /// An edge is as long as the mean over its faces says. Triangles that could not close with
    /// such sides, where the metric changes much from face to face, have their longest side
    /// shortened to the way around.
    ///
    /// # Errors
    /// There is not one metric a face, or one is not symmetric and positive definite, with its
    /// factors in the plane of the face from 1e-100 to 1e100.
    pub fn tensor(
        mesh: impl Into<Arc<TriMesh>>,
        metric: &[[[f64; 3]; 3]],
    ) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        check_count("faces", metric.len(), mesh.faces().len())?;
        if let Some(face) = (0..metric.len()).find(|&face| !is_metric(&metric[face])) {
            return Err(MediumError::Metric { face, value: metric[face] });
        }
        let along = |face: usize, side: Vector| {
            let turned = metric[face].map(|row| dot(row, side));
            dot(turned, side).max(0.0).sqrt()
        };
        Self::from_sides(mesh, along)
    }

    /// A medium with a direction for each face and what it costs to go along and across it.
    ///
    /// # Errors
    /// There is not one direction a face, one is not finite, or a cost is not from 1e-50 to 1e50.
    pub fn directed(
        mesh: impl Into<Arc<TriMesh>>,
        directed: &[Directed],
    ) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        check_count("faces", directed.len(), mesh.faces().len())?;
        directed
            .iter()
            .enumerate()
            .try_for_each(|(face, directed)| check_directed(face, directed))?;
        let in_plane: Vec<_> = (0..directed.len())
            .map(|face| in_plane(mesh.corners(face), directed[face].direction))
            .collect();
        let long = |face: usize, side: Vector| {
            let Directed { along, across, .. } = directed[face];
            let Some(direction) = in_plane[face] else { return across * length(side) };
            let part = dot(side, direction);
            let rest = length(subtract(side, scale(direction, part)));
            (along * part).hypot(across * rest)
        };
        Self::from_sides(mesh, long)
    }

    /// A medium whose edges are as long as the mean over their faces of `long(face, side)`.
    fn from_sides(
        mesh: Arc<TriMesh>,
        long: impl Fn(usize, Vector) -> f64,
    ) -> Result<Self, MediumError> {
        let adjacency = mesh.adjacency();
        let mean = |(edge, &[a, b]): (usize, &[u32; 2])| {
            let side = subtract(mesh.points()[b as usize], mesh.points()[a as usize]);
            let faces = adjacency.edge_faces().of(edge);
            faces.iter().map(|&face| long(face as usize, side)).sum::<f64>() / faces.len() as f64
        };
        let mut lengths: Vec<f64> = adjacency.edges().iter().enumerate().map(mean).collect();
        close_triangles(&mesh, &mut lengths);
        let slowness = vec![1.0; mesh.faces().len()];
        Self::from_parts(mesh, lengths, slowness)
    }
}

/// The longest side of a triangle is at most this part of the two others together.
const MOST_STRETCHED: f64 = 0.999_999;

/// So often at most all triangles are gone through, and what is left is for mollification. A mesh with a
/// crease medium of contrast 10 took up to 26 rounds, most of them 5.
const MOST_ROUNDS: usize = 100;

/// Shortens sides that are longer than the way around their triangle: that way is as short for whoever
/// measures it. (Mollification would lengthen all edges by what the worst triangle lacks.)
fn close_triangles(mesh: &TriMesh, lengths: &mut [f64]) {
    for _ in 0..MOST_ROUNDS {
        let mut closed = true;
        for edges in mesh.adjacency().face_edges() {
            let sides = edges.map(|edge| lengths[edge as usize]);
            let longest = (1..3).fold(0, |best, i| if sides[i] > sides[best] { i } else { best });
            let around = MOST_STRETCHED * (sides[(longest + 1) % 3] + sides[(longest + 2) % 3]);
            if sides[longest] > around * (1.0 + 1e-12) {
                lengths[edges[longest] as usize] = around;
                closed = false;
            }
        }
        if closed {
            return;
        }
    }
}

fn check_directed(face: usize, directed: &Directed) -> Result<(), MediumError> {
    let Directed { direction, along, across } = *directed;
    for (what, value) in [("cost along", along), ("cost across", across)] {
        if value.is_sign_negative() || !is_sensible(value * value) {
            return Err(MediumError::Cost { what, value, face });
        }
    }
    let error = MediumError::Direction { face, value: direction };
    if direction.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(error) }
}

/// The unit vector along the part of `direction` in the plane of a face; none if there is none.
fn in_plane([a, b, c]: [Vector; 3], direction: Vector) -> Option<Vector> {
    let unit = |v: Vector| {
        let length = length(v);
        (length > 0.0).then(|| scale(v, 1.0 / length))
    };
    let normal = unit(cross(unit(subtract(b, a))?, unit(subtract(c, a))?))?;
    let direction = unit(direction)?;
    let part = subtract(direction, scale(normal, dot(normal, direction)));
    if length(part) > 1e-9 { unit(part) } else { None }
}

/// Whether a matrix is symmetric and positive definite with sensible eigenvalues.
fn is_metric(metric: &[[f64; 3]; 3]) -> bool {
    let size = metric.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let symmetric =
        (0..3).all(|i| (metric[i][(i + 1) % 3] - metric[(i + 1) % 3][i]).abs() <= 1e-12 * size);
    let finite = metric.iter().flatten().all(|x| x.is_finite());
    finite && symmetric && crate::grid::eigen(metric).0.into_iter().all(is_sensible)
}
