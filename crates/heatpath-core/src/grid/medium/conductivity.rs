//! Equation (6): heat flows where the grey value resembles the source's.

use super::{Form, Medium, MediumError};
use crate::error::{check, check_positive};
use crate::grid::Grid;

/// The parameters of [`conductivity`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductivityOptions {
    /// The power n of eq. (6): how strongly unlike grey values are held back. Positive; default 3.
    pub power: f64,
    /// The constant epsilon of eq. (6), which keeps the conductivity positive. Positive;
    /// default 1e-3.
    pub floor: f64,
}

impl Default for ConductivityOptions {
    fn default() -> Self {
        Self { power: 3.0, floor: 1e-3 }
    }
}

/// The conductivity `alpha = |1 - |f(p0) - f(x)||^n + epsilon` (eq. 6), in `u_t = alpha laplace(u)`.
///
/// `image` is f, scaled to `[0, 1]`. `references` are the grey values f(p0) to resemble, usually
/// [`Sources::values`](crate::grid::Sources::values); of several, the nearest in value counts in
/// each cell. Lengths are `ds / sqrt(alpha)`.
///
/// # Errors
/// A grey value or reference that is not finite, no reference, or a parameter out of range.
pub fn conductivity<const D: usize>(
    image: &Grid<f64, D>,
    references: &[f64],
    options: ConductivityOptions,
) -> Result<Medium<D>, MediumError> {
    Ok(Medium::from_field(alpha(image, references, options)?, Form::Pointwise))
}

/// The field of eq. (6).
pub(super) fn alpha<const D: usize>(
    image: &Grid<f64, D>,
    references: &[f64],
    options: ConductivityOptions,
) -> Result<Grid<f64, D>, MediumError> {
    image.check_finite()?;
    check_positive("power", options.power)?;
    check_positive("floor", options.floor)?;
    for &reference in references {
        check("reference value", reference, reference.is_finite(), "finite")?;
    }
    check("number of reference values", 0.0, !references.is_empty(), "at least 1")?;
    let power = to_the(options.power);
    Ok(image.map(|&value| {
        let difference = references.iter().map(|r| (r - value).abs()).fold(f64::INFINITY, f64::min);
        power((1.0 - difference).abs()) + options.floor
    }))
}

/// Raises to a power; to a small whole one by multiplication, which is far faster.
fn to_the(power: f64) -> impl Fn(f64) -> f64 {
    let whole = (power.fract() == 0.0 && power <= 16.0).then_some(power as i32);
    move |base| whole.map_or_else(|| base.powf(power), |whole| base.powi(whole))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn powers_by_multiplication_are_powers() {
        for power in [1.0, 2.0, 3.0, 6.0, 16.0, 2.5, 40.0] {
            for base in [0.0, 0.03, 0.7, 1.0, 1.3_f64] {
                let (found, expected) = (to_the(power)(base), base.powf(power));
                assert!((found - expected).abs() <= 4e-15 * expected, "{base}^{power}: {found}");
            }
        }
    }

    #[test]
    fn equation_6_in_numbers() {
        let image = Grid::from_values(Shape::new([3, 1]).unwrap(), vec![0.2, 0.7, 1.0]).unwrap();
        let options = ConductivityOptions { power: 2.0, floor: 0.01 };
        let medium = conductivity(&image, &[0.2], options).unwrap();
        let expected = [1.01, 0.26, 0.05];
        for (position, expected) in expected.into_iter().enumerate() {
            assert!((medium.speed_sq(position) - expected).abs() < 1e-15);
        }
        let two = conductivity(&image, &[0.2, 0.9], options).unwrap();
        assert!((two.speed_sq(2) - 0.82).abs() < 1e-15, "the nearest reference counts");
    }

    #[test]
    fn bad_parameters_are_named() {
        let image = Grid::from_values(Shape::new([2, 1]).unwrap(), vec![0.0, f64::NAN]).unwrap();
        let options = ConductivityOptions::default();
        let error = conductivity(&image, &[0.5], options).unwrap_err().to_string();
        assert_eq!(error, "the value at [1, 0] is NaN; all values must be finite numbers");
        let fine = image.map(|_| 0.5);
        let error = conductivity(&fine, &[0.5], ConductivityOptions { power: -1.0, ..options });
        assert_eq!(
            error.unwrap_err().to_string(),
            "power is -1; it must be a positive finite number"
        );
        assert!(conductivity(&fine, &[], options).is_err());
        assert!(conductivity(&fine, &[f64::INFINITY], options).is_err());
    }
}
