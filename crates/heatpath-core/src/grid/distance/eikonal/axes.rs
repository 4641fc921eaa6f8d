//! The stencil of an isotropic medium.

use super::stencil::Stencil;
use crate::grid::medium::Medium;
use crate::grid::{Matrix, Shape};

/// The eikonal equation along the axes of the grid: in a cell of speed c the squared derivatives add
/// up to `1 / c^2`.
///
/// There are two places of wall around the grid, so that no step needs to be checked.
#[derive(Debug)]
pub(super) struct Axes<const D: usize> {
    frame: Shape<D>,
    strides: [usize; D],
    /// One over the squared spacing, in cell units.
    per_step_sq: [f64; D],
    /// 0 in walls.
    speed_sq: Vec<f64>,
}

/// The width of the wall around the grid.
const MARGIN: usize = 2;

impl<const D: usize> Axes<D> {
    /// The number of places for a grid, or the largest number if there are more.
    pub(super) fn places_around(shape: &Shape<D>) -> usize {
        let sides = shape.size().map(|n| n.saturating_add(2 * MARGIN));
        sides.into_iter().fold(1, usize::saturating_mul)
    }

    pub(super) fn new(medium: &Medium<D>) -> Self {
        let (shape, mask, unit) =
            (*medium.shape(), medium.mask(), medium.shape().smallest_spacing());
        let frame = shape.with_size(shape.size().map(|n| n + 2 * MARGIN));
        let mut axes = Self {
            frame,
            strides: std::array::from_fn(|axis| frame.stride(axis)),
            per_step_sq: shape.spacing().map(|h| (unit / h).powi(2)),
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
    fn places(&self) -> usize {
        self.frame.cells()
    }

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
    fn has_closed_side(&self, _: usize) -> bool {
        // No axis follows from others.
        false
    }

    #[inline]
    fn nearest_along_axes(&self, _: usize, _: impl Fn(usize) -> f64) -> Option<(f64, usize)> {
        None
    }

    fn is_open_at(&self, point: [f64; D]) -> bool {
        let point = point.map(|part| part + MARGIN as f64);
        self.frame.contains(point) && self.is_open(self.frame.position(self.frame.cell_at(point)))
    }

    fn vector(&self, _: usize, direction: usize) -> [f64; D] {
        std::array::from_fn(|axis| f64::from(u8::from(axis == direction)))
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
    fn for_dependents(
        &self,
        place: usize,
        mut visit: impl FnMut(usize, [usize; D], Option<usize>),
    ) {
        let index = self.frame.index(place).map(|i| i - MARGIN);
        for (axis, stride) in self.strides.into_iter().enumerate() {
            let (mut behind, mut ahead) = (index, index);
            // Wraps on a wall, which no one visits further.
            behind[axis] = behind[axis].wrapping_sub(1);
            ahead[axis] += 1;
            visit(place - stride, behind, Some(place - 2 * stride));
            visit(place + stride, ahead, Some(place + 2 * stride));
        }
    }
}
