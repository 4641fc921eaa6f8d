//! The size and spacing of a regular grid.

use thiserror::Error;

/// The number of cells along each axis and the physical distance between their centres.
///
/// Axis 0 is x (columns, to the right), axis 1 is y (rows, down), axis 2 is z (slices). In memory x
/// runs fastest, so a picture is stored row by row. A cell is addressed by its index `[x, y]` or
/// `[x, y, z]`, starting at 0, or by its position `index[0] + size[0] * (index[1] + ...)` in memory.
/// A point is given in the same pixel coordinates, with fractions: cell centres lie on whole
/// numbers and the grid covers `-0.5 ..= size - 0.5` along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape<const D: usize> {
    size: [usize; D],
    spacing: [f64; D],
}

/// Why a [`Shape`] cannot exist.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ShapeError {
    /// A side has no cells.
    #[error("the grid has no cells along axis {axis}: every side needs at least one")]
    Empty {
        /// The axis: 0 for x, 1 for y, 2 for z.
        axis: usize,
    },
    /// The number of cells does not fit into memory's address range.
    #[error("a grid of {size:?} cells is too large for this machine")]
    TooLarge {
        /// The cells along each axis.
        size: Vec<usize>,
    },
    /// A spacing is zero, negative, infinite or not a number.
    #[error("spacing along axis {axis} is {spacing}; it must be a positive finite length")]
    Spacing {
        /// The axis: 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The rejected value.
        spacing: f64,
    },
}

impl<const D: usize> Shape<D> {
    /// A grid of `size` cells with unit spacing.
    ///
    /// # Errors
    /// A side of zero, or more cells than can be addressed.
    pub fn new(size: [usize; D]) -> Result<Self, ShapeError> {
        Self::with_spacing(size, [1.0; D])
    }

    /// A grid of `size` cells whose centres are `spacing` apart along each axis.
    ///
    /// # Errors
    /// A side of zero, more cells than can be addressed, or a spacing that is not a positive
    /// finite number.
    pub fn with_spacing(size: [usize; D], spacing: [f64; D]) -> Result<Self, ShapeError> {
        if let Some(axis) = size.iter().position(|&n| n == 0) {
            return Err(ShapeError::Empty { axis });
        }
        let cells = size.iter().try_fold(1_usize, |product, &n| product.checked_mul(n));
        // The fields built on a grid take up to 16 bytes a cell in one allocation.
        if cells.is_none_or(|n| n > isize::MAX as usize / 16) {
            return Err(ShapeError::TooLarge { size: size.to_vec() });
        }
        match spacing.iter().position(|&h| !(h.is_finite() && h > 0.0)) {
            Some(axis) => Err(ShapeError::Spacing { axis, spacing: spacing[axis] }),
            None => Ok(Self { size, spacing }),
        }
    }

    /// A grid of another, smaller size with the same spacing.
    pub(crate) fn with_size(self, size: [usize; D]) -> Self {
        Self { size, ..self }
    }

    /// The cells along each axis.
    #[must_use]
    pub fn size(&self) -> [usize; D] {
        self.size
    }

    /// The physical distance between neighbouring cell centres along each axis.
    #[must_use]
    pub fn spacing(&self) -> [f64; D] {
        self.spacing
    }

    /// The smallest of the spacings: the physical length that one "cell unit" stands for.
    #[must_use]
    pub fn smallest_spacing(&self) -> f64 {
        self.spacing.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// The cells along the longest side.
    #[must_use]
    pub fn longest_side(&self) -> usize {
        self.size.into_iter().max().unwrap_or(0)
    }

    /// The number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.size.iter().product()
    }

    /// The number of axes along which there is more than one cell.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.size.iter().filter(|&&side| side > 1).count()
    }

    /// How far apart in memory two neighbours along `axis` are.
    #[must_use]
    pub fn stride(&self, axis: usize) -> usize {
        self.size[..axis].iter().product()
    }

    /// The position in memory of the cell at `index`.
    #[must_use]
    pub fn position(&self, index: [usize; D]) -> usize {
        (0..D).rev().fold(0, |position, axis| position * self.size[axis] + index[axis])
    }

    /// The index of the cell stored at `position`.
    #[must_use]
    pub fn index(&self, position: usize) -> [usize; D] {
        let mut rest = position;
        self.size.map(|n| {
            let coordinate = rest % n;
            rest /= n;
            coordinate
        })
    }

    /// The index of the first cell of each row along x.
    pub(crate) fn rows(&self) -> impl Iterator<Item = [usize; D]> + use<D> {
        let shape = *self;
        (0..shape.cells()).step_by(shape.size[0]).map(move |cell| shape.index(cell))
    }

    /// The neighbours of the cell at `position` that share a face with it.
    pub fn neighbours(&self, position: usize) -> impl Iterator<Item = usize> + use<D> {
        let (index, size) = (self.index(position), self.size);
        let strides: [usize; D] = std::array::from_fn(|axis| self.stride(axis));
        (0..D).flat_map(move |axis| {
            let below = (index[axis] > 0).then(|| position - strides[axis]);
            let above = (index[axis] + 1 < size[axis]).then(|| position + strides[axis]);
            below.into_iter().chain(above)
        })
    }

    /// The cells at most `radius` cells away along every axis from the cell at `position`.
    pub(crate) fn box_around(&self, position: usize, radius: usize) -> impl Iterator<Item = usize> {
        let index = self.index(position);
        let low = index.map(|i| i.saturating_sub(radius));
        let size = std::array::from_fn(|axis| {
            (index[axis] + radius).min(self.size[axis] - 1) + 1 - low[axis]
        });
        let shape = *self;
        let cells = shape.with_size(size);
        (0..cells.cells()).map(move |cell| {
            let offset = cells.index(cell);
            shape.position(std::array::from_fn(|axis| low[axis] + offset[axis]))
        })
    }

    /// Whether `point`, in pixel coordinates, lies on the grid (`-0.5 ..= size - 0.5`).
    #[must_use]
    pub fn contains(&self, point: [f64; D]) -> bool {
        (0..D).all(|axis| point[axis] >= -0.5 && point[axis] <= self.size[axis] as f64 - 0.5)
    }

    /// The index of the cell in which `point` lies; points off the grid go to the nearest cell.
    #[must_use]
    pub fn cell_at(&self, point: [f64; D]) -> [usize; D] {
        std::array::from_fn(|axis| {
            let nearest = (point[axis] + 0.5).floor().max(0.0);
            (nearest as usize).min(self.size[axis] - 1)
        })
    }

    /// The point in the middle of the cell stored at `position`.
    #[must_use]
    pub fn centre(&self, position: usize) -> [f64; D] {
        self.index(position).map(|i| i as f64)
    }

    /// The same grid measured in cells.
    pub(crate) fn unit_spacing(self) -> Self {
        Self { spacing: [1.0; D], ..self }
    }

    /// The length of the step `from` -> `to`, both in pixel coordinates, in physical units.
    #[must_use]
    pub fn physical_distance(&self, from: [f64; D], to: [f64; D]) -> f64 {
        (0..D)
            .map(|axis| ((to[axis] - from[axis]) * self.spacing[axis]).powi(2))
            .sum::<f64>()
            .sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_and_indices_are_inverse() {
        let shape = Shape::new([3, 4, 5]).unwrap();
        for position in 0..shape.cells() {
            assert_eq!(shape.position(shape.index(position)), position);
        }
        assert_eq!(shape.position([1, 0, 0]), 1);
        assert_eq!(shape.position([0, 1, 0]), 3);
        assert_eq!(shape.position([0, 0, 1]), 12);
    }

    #[test]
    fn neighbours_stop_at_the_border() {
        let shape = Shape::new([3, 2]).unwrap();
        assert_eq!(shape.neighbours(0).collect::<Vec<_>>(), [1, 3]);
        assert_eq!(shape.neighbours(4).collect::<Vec<_>>(), [3, 5, 1]);
    }

    #[test]
    fn bad_shapes_are_refused() {
        assert_eq!(Shape::new([3, 0]), Err(ShapeError::Empty { axis: 1 }));
        assert!(matches!(Shape::new([usize::MAX, 2]), Err(ShapeError::TooLarge { .. })));
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                Shape::with_spacing([2, 2], [1.0, bad]),
                Err(ShapeError::Spacing { axis: 1, .. })
            ));
        }
    }

    #[test]
    fn a_point_belongs_to_the_cell_around_it() {
        let shape = Shape::new([4, 3]).unwrap();
        assert_eq!(shape.cell_at([0.49, 1.5]), [0, 2]);
        assert_eq!(shape.cell_at([-0.5, 2.5]), [0, 2]);
        assert!(shape.contains([-0.5, 2.5]) && !shape.contains([-0.51, 0.0]));
        assert!(!shape.contains([f64::NAN, 0.0]));
    }
}
