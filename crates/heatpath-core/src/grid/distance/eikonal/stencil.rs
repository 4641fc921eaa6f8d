//! Which neighbours a cell's distance comes from.

use super::value::Value;
use crate::grid::Matrix;

/// A cell whose equation holds another.
#[derive(Clone, Copy)]
pub(super) struct Dependent<const D: usize> {
    pub(super) place: usize,
    pub(super) index: [usize; D],
    /// The direction that leads from it to the other, or back; `None` if it is along an axis, past a
    /// closed side.
    pub(super) direction: Option<usize>,
    /// The place opposite of the other.
    pub(super) opposite: Option<usize>,
}

/// The discrete eikonal equation: in every cell the weighted squares of derivatives along some
/// directions add up to 1.
///
/// Cells have places in memory, of which there may be more than cells. Each of the `N` directions
/// leads from a cell to one neighbour ahead and one behind. Lengths are in cell units.
pub(super) trait Stencil<const D: usize, const N: usize> {
    /// The number of places.
    fn places(&self) -> usize;

    /// The place of a cell: a sum of what each coordinate adds.
    fn place(&self, index: [usize; D]) -> usize;

    /// What is added to the place of the first cell of a row for each of its cells.
    fn along_row(&self, cells: usize) -> Vec<usize> {
        let mut index = [0; D];
        let first = self.place(index);
        let added = |x| {
            index[0] = x;
            self.place(index) - first
        };
        (0..cells).map(added).collect()
    }

    /// Whether there is an open cell at a place.
    fn is_open(&self, place: usize) -> bool;

    /// The weight of a squared derivative per step along a direction.
    fn weight(&self, place: usize, direction: usize) -> f64;

    /// The place after `steps` steps, -2 to 2, along a direction; `None` if the border or a wall is
    /// in the way, unless places beyond are closed.
    fn neighbour(&self, place: usize, direction: usize, steps: isize) -> Option<usize>;

    /// Whether some direction of a cell leads nowhere on one side, and its derivative follows from
    /// those along others.
    fn has_closed_side(&self, place: usize) -> bool;

    /// For a cell with a closed side the least distance by one step from a neighbour along an axis, given
    /// the neighbours' distances, and that neighbour. So every cell is reached that open cells
    /// connect with a source, even where all offsets meet walls.
    fn nearest_along_axes(
        &self,
        place: usize,
        distance: impl Fn(usize) -> f64,
    ) -> Option<(f64, usize)>;

    /// Whether there is an open cell at a point in pixel coordinates.
    fn is_open_at(&self, point: [f64; D]) -> bool;

    /// A direction as a vector, in cells.
    fn vector(&self, place: usize, direction: usize) -> [f64; D];

    /// The component of a covector along a direction, per step.
    fn along(&self, place: usize, direction: usize, covector: &[f64; D]) -> f64;

    /// The squared length of a step along a direction in a metric.
    fn length_sq(&self, place: usize, direction: usize, metric: &Matrix<D>) -> f64;

    /// Calls `visit` with each cell whose equation holds the cell at a place.
    fn for_dependents(&self, place: usize, visit: impl FnMut(Dependent<D>));

    /// Has fetched what will be needed of these cells as soon as the one at a place is known.
    fn prefetch_around(&self, place: usize, values: &[Value]);
}
