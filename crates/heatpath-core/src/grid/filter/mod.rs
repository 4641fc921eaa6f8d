//! Gaussian smoothing, derivatives and what they tell about directions and tubes.
//!
//! All widths are standard deviations in cell units, multiples of the smallest spacing, and all
//! derivatives are per cell unit, so that filters are round in physical space and do not depend on
//! the unit of length. Images are mirrored about their borders, `-0.5` and `size - 0.5`.

mod contrast;
mod elongated;
mod flux;
mod hessian;
mod kernel;
mod measure;
mod medialness;
mod separable;
mod structure;
mod vesselness;

pub use contrast::{DEVIATION, even_grey, normalize_contrast};
pub use hessian::hessian;
pub use measure::{Measure, Polarity};
pub use medialness::medialness;
pub use structure::{gaussian_gradient, structure_tensor};
pub use vesselness::{LARGEST_ELONGATION, LARGEST_SCALE, Tubes, Vesselness, vesselness};

pub(super) use measure::rise;

use super::{Grid, NotFinite};
use crate::error::ParameterError;
use crate::exec::{Cancelled, Exec};
use separable::Derivatives;
use std::ops::Range;
use thiserror::Error;

/// Derivatives below this part of the image's largest value in size are rounding errors.
pub(super) const QUIET: f64 = 1e-12;

/// A Gaussian's width is negative, infinite or not a number.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("smoothing sigma is {0}; it must be zero or a positive finite number of cells")]
pub struct SigmaError(pub f64);

/// Why there is no filtered image.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FilterError {
    /// A value of the image is infinite or not a number.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// A Gaussian's width makes no sense.
    #[error(transparent)]
    Sigma(#[from] SigmaError),
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The mask is for another grid.
    #[error("the mask has {mask:?} cells but the image has {image:?}")]
    MaskSize {
        /// The mask's cells along each axis.
        mask: Vec<usize>,
        /// The image's cells along each axis.
        image: Vec<usize>,
    },
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Smooths with a Gaussian of standard deviation `sigma`, given in cell units (multiples of the
/// smallest spacing), so that the blur is round in physical space.
///
/// The kernel is sampled, cut at four standard deviations and normalised; the image is mirrored
/// about its border. A `sigma` of 0 returns the image unchanged.
///
/// # Errors
/// `sigma` is negative or not finite.
pub fn gaussian<const D: usize>(
    image: &Grid<f64, D>,
    sigma: f64,
) -> Result<Grid<f64, D>, SigmaError> {
    check_sigma(sigma)?;
    let smooth = smooth(image, sigma, 0.0..1.0, &Exec::single_threaded());
    Ok(smooth.expect("nobody watches, so nobody cancels"))
}

/// The squared length of the image gradient per cell unit, by central differences.
///
/// Differences are divided by the physical distance and multiplied by the smallest spacing, so the
/// value does not depend on the unit of length. At the border the image is mirrored, which leaves
/// half of the one-sided difference.
#[must_use]
pub fn gradient_sq<const D: usize>(image: &Grid<f64, D>) -> Grid<f64, D> {
    let gradient = structure::gradient(image, 0.0, 0.0..1.0, &Exec::single_threaded());
    let gradient = gradient.expect("nobody watches, so nobody cancels");
    gradient.map(|gradient| gradient.iter().map(|g| g * g).sum())
}

fn check_sigma(sigma: f64) -> Result<(), SigmaError> {
    if sigma.is_finite() && sigma >= 0.0 { Ok(()) } else { Err(SigmaError(sigma)) }
}

/// The image smoothed by `sigma` cell units, in parallel; progress goes through `share` of the whole.
fn smooth<const D: usize>(
    image: &Grid<f64, D>,
    sigma: f64,
    share: Range<f64>,
    exec: &Exec,
) -> Result<Grid<f64, D>, Cancelled> {
    let derivatives = Derivatives::new(*image.shape(), sigma, exec.simd());
    let mut smooth = image.map(|_| 0.0);
    let put = |slab: &mut [f64], _: usize, first: usize, row: &[f64]| {
        slab[first..first + row.len()].copy_from_slice(row);
    };
    derivatives.fill(image, &[[0; D]], smooth.values_mut(), (share, exec), put)?;
    Ok(smooth)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn smoothing_keeps_constants_and_the_mean() {
        let shape = Shape::new([9, 7]).unwrap();
        let constant = Grid::from_fn(shape, |_| 0.25);
        let smooth = gaussian(&constant, 2.0).unwrap();
        assert!(smooth.values().iter().all(|v| (v - 0.25).abs() < 1e-15));
        let spot = Grid::from_fn(shape, |i| f64::from(u8::from(i == [1, 2])));
        let total: f64 = gaussian(&spot, 1.5).unwrap().values().iter().sum();
        assert!((total - 1.0).abs() < 1e-14, "mirrored borders lose nothing: {total}");
    }

    #[test]
    fn smoothing_has_the_asked_width() {
        let shape = Shape::with_spacing([81, 81], [1.0, 2.0]).unwrap();
        let spot = Grid::from_fn(shape, |i| f64::from(u8::from(i == [40, 40])));
        let smooth = gaussian(&spot, 3.0).unwrap();
        for (axis, h) in [(0, 1.0), (1, 2.0)] {
            let variance: f64 = (0..shape.cells())
                .map(|p| smooth.values()[p] * (h * (shape.index(p)[axis] as f64 - 40.0)).powi(2))
                .sum();
            assert!((variance.sqrt() - 3.0).abs() < 0.01, "axis {axis}: {}", variance.sqrt());
        }
    }

    #[test]
    fn the_gradient_does_not_depend_on_the_unit_of_length() {
        let ramp = |spacing| {
            Grid::from_fn(Shape::with_spacing([6, 5], spacing).unwrap(), |[x, y]| {
                0.1 * x as f64 + 0.2 * y as f64
            })
        };
        assert!((gradient_sq(&ramp([1.0, 1.0]))[[2, 2]] - 0.05).abs() < 1e-15);
        assert!((gradient_sq(&ramp([0.3, 0.3]))[[2, 2]] - 0.05).abs() < 1e-15);
        assert!((gradient_sq(&ramp([1.0, 2.0]))[[2, 2]] - 0.02).abs() < 1e-15);
    }

    #[test]
    fn a_sigma_that_makes_no_sense_is_refused() {
        let image = Grid::from_fn(Shape::new([2, 2]).unwrap(), |_| 0.0);
        assert_eq!(gaussian(&image, -1.0), Err(SigmaError(-1.0)));
        assert!(gaussian(&image, f64::NAN).is_err());
    }
}
