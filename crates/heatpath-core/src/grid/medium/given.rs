//! Any positive field.

use super::{Form, Medium, MediumError};
use crate::grid::Grid;
use std::ops::RangeInclusive;

/// The values that a given field may have: beyond them products and quotients leave the range of
/// floating point.
pub const GIVEN_RANGE: RangeInclusive<f64> = 1e-100..=1e100;

/// The medium of a given positive field: lengths are `ds / sqrt(field)`.
///
/// A cost `c` per unit length, as fast marching takes it, is the field `1 / c^2`. For distances take
/// [`Form::Pointwise`]: in two dimensions `k laplace(u)` is the heat of the metric itself, while
/// [`Form::Divergence`] adds a drift that shifts `log u` by `log(D) / 2` from place to place.
///
/// # Errors
/// A value that is not finite, not positive or outside [`GIVEN_RANGE`]; the first such cell is
/// named.
pub fn given<const D: usize>(field: Grid<f64, D>, form: Form) -> Result<Medium<D>, MediumError> {
    field.check_finite()?;
    match field.values().iter().position(|value| !GIVEN_RANGE.contains(value)) {
        Some(position) => Err(MediumError::GivenValue {
            index: field.shape().index(position).to_vec(),
            value: field.values()[position],
        }),
        None => Ok(Medium::from_field(field, form)),
    }
}
