//! Equation (11): heat runs along edges and thin lines.

use super::{Form, Medium, MediumError};
use crate::error::check_positive;
use crate::grid::Grid;
use crate::grid::filter::{gaussian, gradient_sq};

/// The parameters of [`edges`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgesOptions {
    /// The constant epsilon of eq. (11), which lets heat cross flat regions. Positive;
    /// default 1e-3.
    pub floor: f64,
    /// Standard deviation of the Gaussian applied before the gradient, in cells; 0 (the default)
    /// is none.
    pub smoothing: f64,
    /// With (the default) or without the gradient term of eq. (9).
    pub form: Form,
}

impl Default for EdgesOptions {
    fn default() -> Self {
        Self { floor: 1e-3, smoothing: 0.0, form: Form::default() }
    }
}

/// The medium that follows edges: `u_t = div(D grad u)` with `D = |grad f|^2 + epsilon` (eq. 11).
///
/// `image` is f, scaled to `[0, 1]`, its gradient in grey values per cell. Lengths are
/// `ds / sqrt(D)`. Central differences are at most 0.5 along each axis and far smaller on most
/// pictures, so heat is slow in this medium: a larger step (`Step::Auto`) carries it further.
///
/// # Errors
/// A grey value that is not finite, or a parameter out of range.
pub fn edges<const D: usize>(
    image: &Grid<f64, D>,
    options: EdgesOptions,
) -> Result<Medium<D>, MediumError> {
    image.check_finite()?;
    check_positive("floor", options.floor)?;
    let gradient_sq = gradient_sq(&gaussian(image, options.smoothing)?);
    Ok(Medium::from_field(gradient_sq.map(|&g_sq| g_sq + options.floor), options.form))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn equation_11_in_numbers() {
        let ramp = Grid::from_fn(Shape::new([5, 3]).unwrap(), |[x, y]| 0.1 * (x + y) as f64);
        let medium = edges(&ramp, EdgesOptions::default()).unwrap();
        assert!((medium.speed_sq(7) - 0.021).abs() < 1e-15);
    }
}
