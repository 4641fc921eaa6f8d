//! What the heat sees: lengths of edges, and how slow each face is.
//!
//! A medium fixes the metric, and each of them can be given as the field that is at hand: the squared
//! speed P of eq. (16) at each vertex, the slowness of each face, or the metric itself.

mod curvature;
mod given;
mod scalars;
mod tensor;

pub use curvature::{Bend, CurvatureMediumOptions};
pub use scalars::ScalarsOptions;
pub use tensor::Directed;

use super::TriMesh;
use super::triangle::area;
use crate::error::ParameterError;
use std::borrow::Cow;
use std::sync::Arc;
use thiserror::Error;

/// A mesh with its metric: distances are integrals of `slowness ds`.
///
/// Lengths inside a face are those of the triangle with the sides [`lengths`](Self::lengths): the
/// mesh's own, or those of a metric that depends on direction. Flat triangles are given a little
/// height ([`mollified`](Self::mollified)), so that every face has an area and every stage after
/// this one may divide by it.
#[derive(Clone, Debug)]
pub struct Medium {
    mesh: Arc<TriMesh>,
    lengths: Vec<f64>,
    slowness: Vec<f64>,
    /// The squared speed at each vertex, if the medium was made from it.
    speed_sq: Option<Vec<f64>>,
    mollified: f64,
}

/// Why a medium cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MediumError {
    /// A given value is zero, negative or absurd somewhere.
    #[error("the {what} is {value} at {place} {number}; it must be positive, from 1e-100 to 1e100")]
    Value {
        /// What was given: `slowness`, `squared speed`.
        what: &'static str,
        /// The value.
        value: f64,
        /// `vertex` or `face`.
        place: &'static str,
        /// The number of the first such place.
        number: usize,
    },
    /// There are more or fewer values than vertices or faces.
    #[error("{given} values were given for {expected} {places}")]
    Length {
        /// `vertices` or `faces`.
        places: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        given: usize,
    },
    /// A metric is not symmetric and positive definite on its face, or absurd.
    #[error(
        "the metric of face {face} is {value:?}; it must be symmetric and positive definite, from 1e-100 \
         to 1e100"
    )]
    Metric {
        /// The number of the first such face.
        face: usize,
        /// The metric.
        value: [[f64; 3]; 3],
    },
    /// A cost along or across a direction is zero, negative or absurd.
    #[error("the {what} is {value} at face {face}; it must be positive, from 1e-50 to 1e50")]
    Cost {
        /// `cost along` or `cost across`.
        what: &'static str,
        /// The value.
        value: f64,
        /// The number of the first such face.
        face: usize,
    },
    /// A direction is infinite or not a number.
    #[error("the direction of face {face} is {value:?}; it must be finite")]
    Direction {
        /// The number of the first such face.
        face: usize,
        /// The direction.
        value: [f64; 3],
    },
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The mesh has no extent: all its vertices are in one place.
    #[error("all vertices of the mesh lie in one point")]
    Point,
}

/// Triangles must exceed flat ones by this part of the mean length of an edge.
const LEAST_EXCESS: f64 = 1e-6;

impl Medium {
    /// The surface as it is: distances are lengths.
    ///
    /// # Errors
    /// All vertices lie in one point.
    pub fn uniform(mesh: impl Into<Arc<TriMesh>>) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        let (lengths, slowness) = (mesh.edge_lengths(), vec![1.0; mesh.faces().len()]);
        Self::from_parts(mesh, lengths, slowness)
    }

    /// A medium from the lengths of its edges and the slowness of its faces, both positive.
    pub(crate) fn from_parts(
        mesh: Arc<TriMesh>,
        mut lengths: Vec<f64>,
        slowness: Vec<f64>,
    ) -> Result<Self, MediumError> {
        let mollified = mollify(&mesh, &mut lengths).ok_or(MediumError::Point)?;
        Ok(Self { mesh, lengths, slowness, speed_sq: None, mollified })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &Arc<TriMesh> {
        &self.mesh
    }

    /// The length of each edge, in the order of [`Adjacency::edges`](super::Adjacency::edges).
    #[must_use]
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// The slowness of each face: the factor on its lengths.
    #[must_use]
    pub fn slowness(&self) -> &[f64] {
        &self.slowness
    }

    /// The squared speed P at each vertex, as eq. (16) takes it: what was given, or that of the mean
    /// slowness of the faces at the vertex (1 where there are none).
    #[must_use]
    pub fn speed_sq(&self) -> Cow<'_, [f64]> {
        if let Some(given) = &self.speed_sq {
            return given.into();
        }
        let faces = self.mesh.adjacency().vertex_faces();
        let at = |vertex| {
            let slowness = faces.of(vertex).iter().map(|&face| self.slowness[face as usize]);
            let mean = slowness.sum::<f64>() / faces.of(vertex).len().max(1) as f64;
            if mean > 0.0 { 1.0 / (mean * mean) } else { 1.0 }
        };
        (0..faces.len()).map(at).collect()
    }

    /// How much was added to the length of each edge so that no face is flat; 0 in most meshes.
    #[must_use]
    pub fn mollified(&self) -> f64 {
        self.mollified
    }

    /// The sides of a face: side i is opposite corner i.
    #[inline]
    #[must_use]
    pub fn sides(&self, face: usize) -> [f64; 3] {
        self.mesh.adjacency().face_edges()[face].map(|edge| self.lengths[edge as usize])
    }

    /// The area of a face by [`sides`](Self::sides), without its slowness.
    #[must_use]
    pub fn area(&self, face: usize) -> f64 {
        area(self.sides(face))
    }

    /// The largest slowness over the smallest.
    #[must_use]
    pub fn contrast(&self) -> f64 {
        let [low, high] = self
            .slowness
            .iter()
            .fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], &x| [low.min(x), high.max(x)]);
        high / low
    }
}

/// Adds to all lengths what the flattest triangle lacks (Sharp and Crane, A Laplacian for Nonmanifold
/// Triangle Meshes, 2020); how much that is, or none if all lengths are zero.
fn mollify(mesh: &TriMesh, lengths: &mut [f64]) -> Option<f64> {
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    if mean <= 0.0 {
        return None;
    }
    let least = LEAST_EXCESS * mean;
    let lack = |edges: &[u32; 3]| {
        let sides = edges.map(|edge| lengths[edge as usize]);
        let longest = sides.into_iter().fold(0.0, f64::max);
        least + 2.0 * longest - sides.iter().sum::<f64>()
    };
    let added = mesh.adjacency().face_edges().iter().map(lack).fold(0.0, f64::max);
    lengths.iter_mut().for_each(|length| *length += added);
    Some(added)
}
