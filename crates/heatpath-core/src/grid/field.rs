//! One value per cell.

use super::Shape;
use thiserror::Error;

/// One value per cell of a regular grid: an image (`D = 2`) or a volume (`D = 3`).
///
/// Values are stored with x fastest, as described at [`Shape`].
///
/// ```
/// use heatpath_core::grid::{Grid, Shape};
///
/// let picture = Grid::from_values(Shape::new([3, 2])?, vec![1, 2, 3, 4, 5, 6])?;
/// assert_eq!(picture[[2, 1]], 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<T, const D: usize> {
    shape: Shape<D>,
    values: Vec<T>,
}

/// The number of values does not match the number of cells.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("a grid of {expected} cells was given {given} values")]
pub struct LengthError {
    /// The number of cells.
    pub expected: usize,
    /// The number of values.
    pub given: usize,
}

/// A value is infinite or not a number.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("the value at {index:?} is {value}; all values must be finite numbers")]
pub struct NotFinite {
    /// The index of the first such cell.
    pub index: Vec<usize>,
    /// Its value.
    pub value: f64,
}

impl<T, const D: usize> Grid<T, D> {
    /// A grid whose cells hold `values`, x fastest.
    ///
    /// # Errors
    /// The number of values differs from the number of cells.
    pub fn from_values(shape: Shape<D>, values: Vec<T>) -> Result<Self, LengthError> {
        let (expected, given) = (shape.cells(), values.len());
        if expected == given {
            Ok(Self { shape, values })
        } else {
            Err(LengthError { expected, given })
        }
    }

    /// A grid of as many `values` as it has cells.
    pub(crate) fn from_parts(shape: Shape<D>, values: Vec<T>) -> Self {
        debug_assert_eq!(shape.cells(), values.len());
        Self { shape, values }
    }

    /// A grid whose cell at index `i` holds `value(i)`.
    pub fn from_fn(shape: Shape<D>, mut value: impl FnMut([usize; D]) -> T) -> Self {
        let values = (0..shape.cells()).map(|position| value(shape.index(position))).collect();
        Self { shape, values }
    }

    /// The same values on a grid of the same size that may have another spacing.
    pub(crate) fn with_spacing_of(self, shape: &Shape<D>) -> Self {
        debug_assert_eq!(self.shape.size(), shape.size());
        Self { shape: *shape, ..self }
    }

    /// The size and spacing.
    #[must_use]
    pub fn shape(&self) -> &Shape<D> {
        &self.shape
    }

    /// The values, x fastest.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values, x fastest, to be changed in place.
    #[must_use]
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// Gives up the grid for its values.
    #[must_use]
    pub fn into_values(self) -> Vec<T> {
        self.values
    }

    /// The grid of `change(value)` for each value.
    #[must_use]
    pub fn map<U>(&self, change: impl FnMut(&T) -> U) -> Grid<U, D> {
        Grid { shape: self.shape, values: self.values.iter().map(change).collect() }
    }
}

impl<const D: usize> Grid<f64, D> {
    /// The largest absolute value.
    pub(crate) fn largest_size(&self) -> f64 {
        self.values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
    }

    /// Checks that every value is a finite number.
    ///
    /// # Errors
    /// Names the first cell that is not.
    pub fn check_finite(&self) -> Result<(), NotFinite> {
        match self.values.iter().position(|value| !value.is_finite()) {
            Some(position) => Err(NotFinite {
                index: self.shape.index(position).to_vec(),
                value: self.values[position],
            }),
            None => Ok(()),
        }
    }
}

impl<T, const D: usize> std::ops::Index<[usize; D]> for Grid<T, D> {
    type Output = T;

    fn index(&self, index: [usize; D]) -> &T {
        &self.values[self.shape.position(index)]
    }
}

impl<T, const D: usize> std::ops::IndexMut<[usize; D]> for Grid<T, D> {
    fn index_mut(&mut self, index: [usize; D]) -> &mut T {
        &mut self.values[self.shape.position(index)]
    }
}

/// Where `value` lies between `low` (0) and `high` (1), clamped to that range; 0 if these are equal.
///
/// This is how raw values become grey values.
#[must_use]
pub fn fraction(value: f64, low: f64, high: f64) -> f64 {
    if high <= low {
        return 0.0;
    }
    let width = high - low;
    if width.is_finite() {
        return ((value - low) / width).clamp(0.0, 1.0);
    }
    // The difference of the two largest numbers overflows; that of their halves does not.
    ((0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_stay_between_zero_and_one() {
        assert_eq!(fraction(5.0, 0.0, 10.0), 0.5);
        assert_eq!(fraction(-1.0, 0.0, 10.0), 0.0);
        assert_eq!(fraction(11.0, 0.0, 10.0), 1.0);
        assert_eq!(fraction(3.0, 3.0, 3.0), 0.0);
        assert_eq!(fraction(0.0, -f64::MAX, f64::MAX), 0.5);
        assert_eq!(fraction(5e-324, 0.0, 5e-324), 1.0);
    }
}
