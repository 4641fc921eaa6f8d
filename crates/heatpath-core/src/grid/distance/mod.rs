//! Distances from the sources.

mod eikonal;
mod heat_method;
pub(super) mod matern;
mod matrix;
mod varadhan;

pub(crate) use eikonal::Arrival;
pub use eikonal::{Eikonal, EikonalError, EikonalOptions, Order};
pub use heat_method::{HeatMethod, HeatMethodError, HeatMethodOptions};
pub use matrix::distance_matrix;
pub use varadhan::{normalized, normalized_each, varadhan};

use super::{Grid, Shape};

/// The distance of a cell that nothing has reached: no heat came there, or it is a wall.
///
/// All other distances are finite.
pub const NOT_REACHED: f64 = f64::INFINITY;

/// The distance of each cell from its source, in physical units where the medium's speed is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceMap<const D: usize> {
    field: Grid<f64, D>,
}

impl<const D: usize> DistanceMap<D> {
    /// The distances, [`NOT_REACHED`] where there is none.
    #[must_use]
    pub fn field(&self) -> &Grid<f64, D> {
        &self.field
    }

    /// Gives up the map for its field.
    #[must_use]
    pub fn into_field(self) -> Grid<f64, D> {
        self.field
    }

    /// The size and spacing.
    #[must_use]
    pub fn shape(&self) -> &Shape<D> {
        self.field.shape()
    }

    /// The distances of the cells that were reached, x fastest.
    pub fn reached(&self) -> impl Iterator<Item = f64> {
        self.field.values().iter().copied().filter(|distance| distance.is_finite())
    }

    /// The distance at `point` (pixel coordinates), interpolated between the cells that were
    /// reached; [`NOT_REACHED`] if the cell around the point was not.
    #[must_use]
    pub fn at(&self, point: [f64; D]) -> f64 {
        interpolated(self.shape(), point, |cell| self.field.values()[cell])
    }
}

/// The distance at `point`, interpolated between those of the cells around it that were reached.
pub(crate) fn interpolated<const D: usize>(
    shape: &Shape<D>,
    point: [f64; D],
    mut distance: impl FnMut(usize) -> f64,
) -> f64 {
    if distance(shape.position(shape.cell_at(point))).is_infinite() {
        return NOT_REACHED;
    }
    let (mut sum, mut weights) = (0.0, 0.0);
    for (cell, weight) in super::sample::corners(shape, point) {
        let distance = distance(cell);
        if distance.is_finite() {
            sum += weight * distance;
            weights += weight;
        }
    }
    sum / weights
}
