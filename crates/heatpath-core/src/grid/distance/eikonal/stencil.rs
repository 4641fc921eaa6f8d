//! Which neighbours a cell's distance comes from.

use crate::grid::medium::Medium;
use crate::grid::tensor::Matrix;
use crate::grid::Shape;

/// The discrete eikonal equation: in every cell the weighted squares of derivatives along some
/// directions add up to 1.
///
/// Cells have places in memory, of which there may be more than cells. Each of the `N` directions
/// leads from a cell to one neighbour ahead and one behind.
pub(super) trait Stencil<const D: usize, const N: usize>: Sync {
    fn shape(&self) -> &Shape<D>;

    /// The number of places.
    fn places(&self) -> usize;

    /// The place of a cell.
    fn place(&self, index: [usize; D]) -> usize;

    /// Whether the equation holds at a place: it is that of an open cell.
    fn is_open(&self, place: usize) -> bool;

    /// The weight of a direction, per squared step.
    fn weight(&self, place: usize, direction: usize) -> f64;

    /// The place after `steps` steps, -2 to 2, along a direction; `None` if a wall or the border is
    /// in the way.
    fn neighbour(&self, place: usize, direction: usize, steps: isize) -> Option<usize>;

    /// The component of a covector along a direction.
    fn along(&self, place: usize, direction: usize, covector: &[f64; D]) -> f64;

    /// The squared length of a step along a direction in a metric.
    fn length_sq(&self, place: usize, direction: usize, metric: &Matrix<D>) -> f64;

    /// Calls `visit` with the place of each cell whose equation holds the cell at a place, with its
    /// index, and with the place of the cell opposite of it there.
    fn for_dependents(&self, place: usize, visit: impl FnMut(usize, [usize; D], Option<usize>));
}

/// The stencil of an isotropic medium: along the axes of the grid.
///
/// There are two places of wall around the grid, so that no step needs to be checked.
#[derive(Debug)]
pub(super) struct Axes<const D: usize> {
    shape: Shape<D>,
    frame: Shape<D>,
    strides: [usize; D],
    /// One over the squared spacing.
    per_step_sq: [f64; D],
    /// 0 in walls.
    speed_sq: Vec<f64>,
}

/// The width of the wall around the grid.
const MARGIN: usize = 2;

impl<const D: usize> Axes<D> {
    pub(super) fn new(medium: &Medium<D>) -> Self {
        let (shape, mask) = (*medium.shape(), medium.mask());
        let frame = shape.with_size(shape.size().map(|n| n + 2 * MARGIN));
        let mut axes = Self {
            shape,
            frame,
            strides: std::array::from_fn(|axis| frame.stride(axis)),
            per_step_sq: shape.spacing().map(|h| 1.0 / (h * h)),
            speed_sq: vec![0.0; frame.cells()],
        };
        for row in shape.rows() {
            let (cell, place) = (shape.position(row), axes.place(row));
            for x in (0..shape.size()[0]).filter(|x| mask.is_open(cell + x)) {
                axes.speed_sq[place + x] = medium.speed_sq(cell + x);
            }
        }
        axes
    }
}

impl<const D: usize> Stencil<D, D> for Axes<D> {
    fn shape(&self) -> &Shape<D> {
        &self.shape
    }

    fn places(&self) -> usize {
        self.frame.cells()
    }

    #[inline]
    fn place(&self, index: [usize; D]) -> usize {
        self.frame.position(index.map(|i| i + MARGIN))
    }

    fn is_open(&self, place: usize) -> bool {
        self.speed_sq[place] > 0.0
    }

    #[inline]
    fn weight(&self, place: usize, direction: usize) -> f64 {
        self.speed_sq[place] * self.per_step_sq[direction]
    }

    #[inline]
    fn neighbour(&self, place: usize, direction: usize, steps: isize) -> Option<usize> {
        Some(place.wrapping_add_signed(steps * self.strides[direction] as isize))
    }

    #[inline]
    fn along(&self, _: usize, direction: usize, covector: &[f64; D]) -> f64 {
        covector[direction]
    }

    #[inline]
    fn length_sq(&self, _: usize, direction: usize, metric: &Matrix<D>) -> f64 {
        metric[direction][direction]
    }

    #[inline]
    fn for_dependents(&self, place: usize, mut visit: impl FnMut(usize, [usize; D], Option<usize>)) {
        let index = self.frame.index(place);
        for (axis, stride) in self.strides.into_iter().enumerate() {
            let (mut before, mut after) = (index.map(|i| i - MARGIN), index.map(|i| i - MARGIN));
            before[axis] = before[axis].wrapping_sub(1);
            after[axis] += 1;
            visit(place - stride, before, Some(place - 2 * stride));
            visit(place + stride, after, Some(place + 2 * stride));
        }
    }
}
