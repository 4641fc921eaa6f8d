//! The region R of a key point.

use super::search::{APART, Branch, Search, cells_between, leads_to};
use super::window::{Flow, box_around};
use crate::grid::Grid;

/// The cells of the structure inside a key point's circle that are connected with it there, to
/// which enough of its heat has come, and which lie along its ways to the peaks on the circle. A branch
/// that begins inside the circle but has no peak on it, as the other arm of a sharp fork, is not known
/// yet.
#[derive(Clone, Debug)]
pub(super) struct Region<const D: usize> {
    low: [usize; D],
    cells: Grid<bool, D>,
}

impl<const D: usize> Region<D> {
    pub(super) fn new(
        search: &Search<'_, D>,
        flow: &Flow<D>,
        point: [f64; D],
        peaks: &[Branch<D>],
    ) -> Self {
        let shape = search.medium.shape();
        let radius = search.options.radius;
        let (low, size) = box_around(shape, point, radius.ceil() as usize);
        let inner = shape.with_size(size);
        let outside = |index: [usize; D]| -> [f64; D] {
            std::array::from_fn(|axis| (low[axis] + index[axis]) as f64)
        };
        let limit = radius * shape.smallest_spacing();
        let belongs = Grid::from_fn(inner, |index| {
            let at = outside(index);
            shape.physical_distance(point, at) <= limit
                && search.is_inside(at)
                && search.is_warm(flow, at, 1.0)
                && (cells_between(point, at) < APART || leads_to(peaks, at))
        });
        let mut cells = belongs.map(|_| false);
        let start: [f64; D] = std::array::from_fn(|axis| point[axis] - low[axis] as f64);
        let mut stack: Vec<usize> =
            inner.box_around(inner.position(inner.cell_at(start)), 1).collect();
        while let Some(cell) = stack.pop() {
            if belongs.values()[cell] && !std::mem::replace(&mut cells.values_mut()[cell], true) {
                stack.extend(inner.box_around(cell, 1));
            }
        }
        Self { low, cells }
    }

    /// Whether a point lies in the region or beside it.
    pub(super) fn contains(&self, point: [f64; D]) -> bool {
        let shape = self.cells.shape();
        let inside: [f64; D] = std::array::from_fn(|axis| point[axis] - self.low[axis] as f64);
        shape.contains(inside)
            && shape
                .box_around(shape.position(shape.cell_at(inside)), 1)
                .any(|cell| self.cells.values()[cell])
    }
}
