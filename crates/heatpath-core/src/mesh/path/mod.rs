//! Paths across faces, from an end point to a source.

mod descent;
mod fan;
mod isolines;
mod shorten;
mod strip;

pub use descent::Descent;
pub use isolines::{Isoline, isolines};
pub use shorten::{ChainError, shorten, shorten_loop};

use super::vector::distance;
use super::{SurfacePoint, TriMesh};
use thiserror::Error;

/// How a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At a source with this label.
    Source(u32),
    /// Nowhere: no source lies in the component of the end point.
    Unreachable,
    /// On the way: there was no way down any more.
    Stuck,
}

/// A path from an end point to a source.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The points from the end point to the source: both, and a point for each edge or vertex
    /// between. Two neighbours share a face.
    pub points: Vec<SurfacePoint>,
    /// The same points in space.
    pub positions: Vec<[f64; 3]>,
    /// How the path ended.
    pub ending: Ending,
    /// The length in space.
    pub length: f64,
    /// The distance of the end point from its source, infinite where there is none.
    pub distance: f64,
}

/// Values that are not those of the vertices of a mesh.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ValuesError {
    /// There is not one for each vertex.
    #[error("{given} values were given for {expected} vertices")]
    Count {
        /// How many there are.
        given: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A value is not a number, or below all others.
    #[error("the value of vertex {vertex} is {value}; it must be finite, or infinity for none")]
    NotANumber {
        /// The first such vertex.
        vertex: usize,
        /// The value.
        value: f64,
    },
}

/// Checks that there is a number or infinity for each vertex.
fn check_values(mesh: &TriMesh, values: &[f64]) -> Result<(), ValuesError> {
    let (given, expected) = (values.len(), mesh.points().len());
    if given != expected {
        return Err(ValuesError::Count { given, expected });
    }
    match values.iter().position(|&value| value.is_nan() || value == f64::NEG_INFINITY) {
        Some(vertex) => Err(ValuesError::NotANumber { vertex, value: values[vertex] }),
        None => Ok(()),
    }
}

impl Path {
    pub(crate) fn new(
        mesh: &TriMesh,
        points: Vec<SurfacePoint>,
        ending: Ending,
        distance: f64,
    ) -> Self {
        let positions: Vec<[f64; 3]> = points.iter().map(|point| mesh.position(point)).collect();
        let length = length(&positions);
        Self { points, positions, ending, length, distance }
    }

    /// This path and then `next`, which begins where this one ends.
    #[must_use]
    pub fn then(&self, mesh: &TriMesh, next: &Self) -> Self {
        let points = [&self.points[..], &next.points[1..]].concat();
        Self::new(mesh, points, next.ending, self.distance + next.distance)
    }
}

/// The length of a polyline in space.
#[must_use]
pub fn length(positions: &[[f64; 3]]) -> f64 {
    positions.windows(2).fold(0.0, |sum, pair| sum + distance(pair[0], pair[1]))
}
