//! Signed normal cycles (Cohen-Steiner and Morvan 2003).

use super::Form;
use super::ball::Ball;
use super::frame::{Frame, face_normal, unit};
use crate::mesh::TriMesh;
use crate::mesh::vector::{Vector, add, cross, dot, subtract};

/// The folded edges of a mesh.
#[derive(Debug)]
pub(super) struct Cycles {
    folds: Vec<Option<Fold>>,
}

/// Two faces that meet at an angle.
#[derive(Clone, Copy, Debug)]
struct Fold {
    /// Halfway between the normals.
    normal: Vector,
    along: Vector,
    /// The angle between the normals, positive where the edge is convex.
    angle: f64,
}

impl Cycles {
    pub(super) fn new(mesh: &TriMesh) -> Self {
        let normals: Vec<_> = (0..mesh.faces().len()).map(|face| face_normal(mesh, face)).collect();
        let edges = 0..mesh.adjacency().edges().len();
        Self { folds: edges.map(|edge| fold(mesh, &normals, edge)).collect() }
    }

    /// `T = 1 / |B| sum angle length(edge in B) e e'` has the principal curvatures in each other's
    /// directions; a quarter turn puts them right.
    pub(super) fn form(&self, ball: &Ball<'_>, frame: &Frame) -> Form {
        let area: f64 = ball.faces().iter().map(|&(_, area)| area).sum();
        if area <= 0.0 {
            return [[0.0; 2]; 2];
        }
        let [mut uu, mut uw, mut ww] = [0.0; 3];
        for &(edge, length) in ball.edges() {
            let Some(fold) = self.folds[edge as usize] else { continue };
            let [u, w] = frame.carried(fold.along, fold.normal);
            let weight = fold.angle * length;
            uu += weight * u * u;
            uw += weight * u * w;
            ww += weight * w * w;
        }
        let scale = 1.0 / (area * ball.unit());
        [[ww * scale, -uw * scale], [-uw * scale, uu * scale]]
    }
}

/// The fold at an edge between two faces that agree about outside; none elsewhere.
fn fold(mesh: &TriMesh, normals: &[Option<Vector>], edge: usize) -> Option<Fold> {
    let adjacency = mesh.adjacency();
    let &[one, other] = adjacency.edge_faces().of(edge) else { return None };
    let ends = adjacency.edges()[edge];
    let [one_way, other_way] =
        [one, other].map(|face| runs_along(mesh.faces()[face as usize], ends));
    if one_way == other_way {
        return None;
    }
    let [m, n] = [normals[one as usize]?, normals[other as usize]?];
    let [from, to] = ends.map(|end| mesh.points()[end as usize]);
    let along = unit(if one_way { subtract(to, from) } else { subtract(from, to) })?;
    let angle = dot(cross(m, n), along).atan2(dot(m, n));
    Some(Fold { normal: unit(add(m, n)).unwrap_or(m), along, angle })
}

/// Whether the corners of a face run from the first end of its edge to the second.
fn runs_along(face: [u32; 3], [from, to]: [u32; 2]) -> bool {
    (0..3).any(|i| face[i] == from && face[(i + 1) % 3] == to)
}
