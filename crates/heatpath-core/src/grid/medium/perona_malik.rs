//! Equations (7) to (9): heat stays inside regions without edges.

use super::{Form, Medium, MediumError};
use crate::error::check_positive;
use crate::grid::Grid;
use crate::grid::filter::{gaussian, gradient_sq};

/// The smallest D of eq. (8).
///
/// Its exponential form vanishes in floating point on strong edges, and a medium must be positive.
/// A millionth of the speed is a wall for any practical purpose.
pub const SMALLEST_DIFFUSION: f64 = 1e-12;

/// The two forms of eq. (8), with `g = |grad f|` and the contrast K.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EdgeStop {
    /// `D = exp(-(g / K)^2)`: high-contrast edges block nearly all heat.
    #[default]
    Exponential,
    /// `D = 1 / (1 + (g / K)^2)`: wide regions win over small ones, edges leak more.
    Rational,
}

/// The parameters of [`perona_malik`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeronaMalikOptions {
    /// The contrast K of eq. (8): the gradient, in grey values (full range 1) per cell, at which
    /// heat is held back. Positive; default 0.03.
    pub contrast: f64,
    /// Which form of eq. (8).
    pub edge_stop: EdgeStop,
    /// Standard deviation of the Gaussian applied before the gradient, in cells; 0 (the default)
    /// is none.
    pub smoothing: f64,
    /// With (the default) or without the gradient term of eq. (9).
    pub form: Form,
}

impl Default for PeronaMalikOptions {
    fn default() -> Self {
        Self {
            contrast: 0.03,
            edge_stop: EdgeStop::default(),
            smoothing: 0.0,
            form: Form::default(),
        }
    }
}

/// The Perona-Malik medium `u_t = div(D grad u)` with D of eq. (8).
///
/// `image` is f, scaled to `[0, 1]`. Lengths are `ds / sqrt(D)`. D is never below
/// [`SMALLEST_DIFFUSION`].
///
/// # Errors
/// A grey value that is not finite, or a parameter out of range.
pub fn perona_malik<const D: usize>(
    image: &Grid<f64, D>,
    options: PeronaMalikOptions,
) -> Result<Medium<D>, MediumError> {
    Ok(Medium::from_field(edge_stopping(image, options)?, options.form))
}

/// The field of eq. (8).
pub(super) fn edge_stopping<const D: usize>(
    image: &Grid<f64, D>,
    options: PeronaMalikOptions,
) -> Result<Grid<f64, D>, MediumError> {
    image.check_finite()?;
    check_positive("contrast", options.contrast)?;
    let gradient_sq = gradient_sq(&gaussian(image, options.smoothing)?);
    Ok(gradient_sq.map(|&g_sq| {
        let ratio_sq = g_sq / options.contrast.powi(2);
        let diffusion = match options.edge_stop {
            EdgeStop::Exponential => (-ratio_sq).exp(),
            EdgeStop::Rational => 1.0 / (1.0 + ratio_sq),
        };
        diffusion.max(SMALLEST_DIFFUSION)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn equation_8_in_numbers() {
        let ramp = Grid::from_fn(Shape::new([5, 3]).unwrap(), |[x, _]| 0.03 * x as f64);
        let at_centre = |edge_stop| {
            let options = PeronaMalikOptions { edge_stop, ..Default::default() };
            perona_malik(&ramp, options).unwrap().speed_sq(7)
        };
        assert!((at_centre(EdgeStop::Exponential) - (-1.0_f64).exp()).abs() < 1e-12);
        assert!((at_centre(EdgeStop::Rational) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn strong_edges_stay_positive() {
        let step = Grid::from_fn(Shape::new([6, 3]).unwrap(), |[x, _]| f64::from(u8::from(x > 2)));
        let medium = perona_malik(&step, PeronaMalikOptions::default()).unwrap();
        assert_eq!(medium.speed_sq(2), SMALLEST_DIFFUSION);
        assert_eq!(medium.speed_sq(0), 1.0);
    }
}
