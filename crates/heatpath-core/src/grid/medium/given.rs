//! Any positive field.

use super::{Form, Medium, MediumError};
use crate::grid::Grid;

/// The medium of a given positive field: lengths are `ds / sqrt(field)`.
///
/// A cost `c` per unit length, as fast marching takes it, is the field `1 / c^2`. For distances take
/// [`Form::Pointwise`]: in two dimensions `k laplace(u)` is the heat of the metric itself, while
/// [`Form::Divergence`] adds a drift that shifts `log u` by `log(D) / 2` from place to place.
///
/// # Errors
/// A value that is not finite or not positive; the first such cell is named.
pub fn given<const D: usize>(field: Grid<f64, D>, form: Form) -> Result<Medium<D>, MediumError> {
    field.check_finite()?;
    match field.values().iter().position(|&value| value <= 0.0) {
        Some(position) => Err(MediumError::NotPositive {
            index: field.shape().index(position).to_vec(),
            value: field.values()[position],
        }),
        None => Ok(Medium::from_field(field, form)),
    }
}
