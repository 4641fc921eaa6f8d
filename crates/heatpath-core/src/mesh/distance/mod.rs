//! Distances from the sources.

mod eikonal;
mod exact;
mod heat_method;
mod varadhan;

pub use self::eikonal::{Eikonal, EikonalError, EikonalOptions};
pub use self::exact::{Exact, ExactError, ExactOptions, ExactPaths};
pub use self::heat_method::{HeatMethod, HeatMethodError, HeatMethodOptions, usual_time};
pub use self::varadhan::{Of, Scale, VaradhanOptions, varadhan};

use super::{SurfacePoint, TriMesh};

/// The distance of a vertex that nothing has reached: it lies in a component without a source, or
/// on no face.
///
/// All other distances are finite.
pub const NOT_REACHED: f64 = f64::INFINITY;

/// The label of a vertex that nothing has reached.
pub const NO_LABEL: u32 = u32::MAX;

/// The distance of each vertex from the nearest source, in the mesh's units times slowness.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceMap {
    values: Vec<f64>,
    labels: Vec<u32>,
}

impl DistanceMap {
    pub(crate) fn new(values: Vec<f64>, labels: Vec<u32>) -> Self {
        Self { values, labels }
    }

    /// A map of so many vertices that nothing has reached.
    pub(crate) fn none(vertices: usize) -> Self {
        Self::new(vec![NOT_REACHED; vertices], vec![NO_LABEL; vertices])
    }

    /// Forgets what lies beyond a distance.
    pub(crate) fn cut(&mut self, farthest: f64) {
        for (value, label) in self.values.iter_mut().zip(&mut self.labels) {
            if *value > farthest {
                (*value, *label) = (NOT_REACHED, NO_LABEL);
            }
        }
    }

    /// Takes the `values` that are nearer, under a label.
    pub(crate) fn merge(&mut self, values: &[f64], label: u32) {
        for ((own, label_here), &value) in self.values.iter_mut().zip(&mut self.labels).zip(values)
        {
            if value < *own {
                (*own, *label_here) = (value, label);
            }
        }
    }

    /// The distance of each vertex, [`NOT_REACHED`] where there is none.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The label of the source nearest to each vertex, [`NO_LABEL`] where there is none.
    #[must_use]
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// The distance at a point of the surface, interpolated between the corners of its face;
    /// [`NOT_REACHED`] if one of them was not.
    #[must_use]
    pub fn at(&self, mesh: &TriMesh, point: &SurfacePoint) -> f64 {
        mesh.value_at(&self.values, point)
    }
}
