//! What several rooms refuse.

use thiserror::Error;

/// A parameter is outside its range.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{name} is {value}; it must be {range}")]
pub struct ParameterError {
    /// The parameter's name.
    pub name: &'static str,
    /// The rejected value.
    pub value: f64,
    /// What would be right.
    pub range: &'static str,
}

/// Checks that a parameter is in its range, of which `range` are the words.
pub(crate) fn check(
    name: &'static str,
    value: f64,
    is_right: bool,
    range: &'static str,
) -> Result<(), ParameterError> {
    if is_right { Ok(()) } else { Err(ParameterError { name, value, range }) }
}

/// Checks that a parameter is a positive finite number.
pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<(), ParameterError> {
    check(name, value, value.is_finite() && value > 0.0, "a positive finite number")
}
