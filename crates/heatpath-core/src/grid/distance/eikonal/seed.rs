//! Sources.

use super::stencil::Stencil;
use crate::grid::Matrix;
use crate::grid::medium::Medium;
use crate::grid::source::shares;
use crate::grid::tensor::{inverse, length, per_cell};

/// A source as the cells around it see it.
#[derive(Clone, Debug)]
pub(super) struct Seed<const D: usize> {
    /// In pixel coordinates.
    pub(super) point: [f64; D],
    /// The metric there, per squared pixel: near the source the distance is `sqrt(d' metric d)`.
    pub(super) metric: Matrix<D>,
    /// The distance at the source itself.
    pub(super) initial: f64,
    /// The cells around it and their distances.
    pub(super) cells: Vec<(usize, f64)>,
}

impl<const D: usize> Seed<D> {
    /// The seed of a source at `point`; in the cells that share it the distance is the mean of what it
    /// would be in the metric there and in that of the source.
    pub(super) fn new<const N: usize>(
        medium: &Medium<D>,
        stencil: &impl Stencil<D, N>,
        point: [f64; D],
        initial: f64,
    ) -> Self {
        let shape = medium.shape();
        let shares = shares(medium.mask(), point);
        let mut metric = [[0.0; D]; D];
        for &(cell, weight) in &shares {
            let there = metric_of(medium, cell);
            (0..D).for_each(|i| (0..D).for_each(|j| metric[i][j] += weight * there[i][j]));
        }
        let cells = shares.into_iter().map(|(cell, _)| {
            let centre = shape.centre(cell);
            let d = std::array::from_fn(|axis| centre[axis] - point[axis]);
            let mean = 0.5 * (length(&metric, d) + length(&metric_of(medium, cell), d));
            (stencil.place(shape.index(cell)), initial + mean)
        });
        Self { point, metric, initial, cells: cells.collect() }
    }
}

/// The metric in a cell, per squared pixel.
fn metric_of<const D: usize>(medium: &Medium<D>, cell: usize) -> Matrix<D> {
    inverse(&per_cell(&medium.speed_sq_tensor(cell), medium.shape()))
}
