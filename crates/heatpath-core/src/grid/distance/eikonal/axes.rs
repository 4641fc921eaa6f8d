//! The stencil of an isotropic medium.

use super::stencil::{Dependent, Stencil};
use super::value::Value;
use crate::grid::medium::Medium;
use crate::grid::{Matrix, Shape};
use crate::simd::prefetch;

/// The eikonal equation along the axes of the grid: in a cell of speed c the squared derivatives add
/// up to `1 / c^2`.
///
/// There are two places of wall around the grid, so that no step needs to be checked. Places are those
/// of bricks, 8 cells wide along each axis, one after the other, and within a brick in the order of Morton
/// (the bits of the coordinates in turn): cells that are near to each other are so in memory too, in
/// few cache lines and pages.
#[derive(Debug)]
pub(super) struct Axes<const D: usize> {
    /// The number of bricks.
    bricks: Shape<D>,
    /// From a cell to the same one in the next brick along each axis.
    strides: [usize; D],
    /// One over the squared spacing, in cell units.
    per_step_sq: [f64; D],
    /// 0 in walls.
    speed_sq: Vec<f64>,
}

/// The width of the wall around the grid, at least.
const MARGIN: usize = 2;

/// The width of a brick is two to the power of that.
const BITS: usize = 3;
const WIDTH: usize = 1 << BITS;

impl<const D: usize> Axes<D> {
    /// The number of places for a grid, or the largest number if there are more.
    pub(super) fn places_around(shape: &Shape<D>) -> usize {
        let sides = Self::bricks(shape).map(|bricks| bricks.saturating_mul(WIDTH));
        sides.into_iter().fold(1, usize::saturating_mul)
    }

    fn bricks(shape: &Shape<D>) -> [usize; D] {
        shape.size().map(|n| n.saturating_add(2 * MARGIN).div_ceil(WIDTH))
    }

    pub(super) fn new(medium: &Medium<D>) -> Self {
        let (shape, mask, unit) =
            (*medium.shape(), medium.mask(), medium.shape().smallest_spacing());
        let bricks = shape.with_size(Self::bricks(&shape));
        let mut axes = Self {
            bricks,
            strides: std::array::from_fn(|axis| bricks.stride(axis) << (BITS * D)),
            per_step_sq: shape.spacing().map(|h| (unit / h).powi(2)),
            speed_sq: vec![0.0; Self::places_around(&shape)],
        };
        let along_row = axes.along_row(shape.size()[0]);
        for row in shape.rows() {
            let (cell, first) = (shape.position(row), axes.place(row));
            for (x, added) in along_row.iter().enumerate().filter(|(x, _)| mask.is_open(cell + x)) {
                axes.speed_sq[first + added] = medium.speed_sq(cell + x);
            }
        }
        axes
    }

    /// The bits of a place that tell where it is in its brick.
    const WITHIN: usize = (1 << (BITS * D)) - 1;

    /// Those that tell it along an axis.
    #[inline]
    fn along(axis: usize) -> usize {
        (0..BITS).map(|bit| 1 << (axis + bit * D)).sum()
    }

    /// The place of an index that counts the margin too.
    #[inline]
    fn place_around(&self, index: [usize; D]) -> usize {
        let brick = self.bricks.position(index.map(|i| i >> BITS));
        let bit = |axis: usize, bit: usize| (index[axis] >> bit & 1) << (axis + bit * D);
        let along = |axis| (0..BITS).map(|number| bit(axis, number)).sum::<usize>();
        (brick << (BITS * D)) + (0..D).map(along).sum::<usize>()
    }

    /// The index of a place, without the margin.
    #[inline]
    fn index(&self, place: usize) -> [usize; D] {
        let brick = self.bricks.index(place >> (BITS * D));
        std::array::from_fn(|axis| {
            let bit = |bit| (place >> (axis + bit * D) & 1) << bit;
            let within = (0..BITS).map(bit).sum::<usize>();
            (brick[axis] * WIDTH + within).wrapping_sub(MARGIN)
        })
    }

    /// The place that is 1 or 2 steps ahead or behind: a sum or difference of the bits along the axis,
    /// which carries across the others.
    #[inline]
    fn step(&self, place: usize, axis: usize, steps: isize) -> usize {
        let along = Self::along(axis);
        let by = 1 << if steps.abs() == 1 { axis } else { axis + D };
        let (moved, bricks) = if steps > 0 {
            let sum = (place | !along & Self::WITHIN) & Self::WITHIN;
            (sum + by, (sum + by) >> (BITS * D))
        } else {
            let difference = (place & along).wrapping_sub(by);
            (difference, ((difference as isize) >> (BITS * D)) as usize)
        };
        (place & !along | moved & along).wrapping_add(bricks.wrapping_mul(self.strides[axis]))
    }
}

impl<const D: usize> Stencil<D, D> for Axes<D> {
    fn places(&self) -> usize {
        self.speed_sq.len()
    }

    #[inline]
    fn place(&self, index: [usize; D]) -> usize {
        self.place_around(index.map(|i| i + MARGIN))
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
        Some(self.step(place, direction, steps))
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
        let cells = self.bricks.with_size(self.bricks.size().map(|n| n * WIDTH));
        let around = point.map(|part| part + MARGIN as f64);
        cells.contains(around) && self.is_open(self.place_around(cells.cell_at(around)))
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
    fn for_dependents(&self, place: usize, mut visit: impl FnMut(Dependent<D>)) {
        let index = self.index(place);
        for axis in 0..D {
            let (mut behind, mut ahead) = (index, index);
            // Wraps on a wall, which no one visits further.
            behind[axis] = behind[axis].wrapping_sub(1);
            ahead[axis] += 1;
            let at = |steps| self.step(place, axis, steps);
            for (side, index) in [(-1, behind), (1, ahead)] {
                let (place, opposite) = (at(side), Some(at(2 * side)));
                visit(Dependent { place, index, direction: Some(axis), opposite });
            }
        }
    }

    #[inline]
    fn prefetch_around(&self, place: usize, values: &[Value]) {
        for axis in 0..D {
            for side in [-1, 1] {
                let (near, next) = (self.step(place, axis, side), self.step(place, axis, 2 * side));
                prefetch(&self.speed_sq[near]);
                prefetch(&values[near]);
                prefetch(&values[next]);
            }
        }
    }
}
