//! Second derivatives.

use super::separable::{Derivatives, second_orders};
use super::{FilterError, check_sigma};
use crate::exec::Exec;
use crate::grid::{Grid, TensorField};

/// The matrix of second derivatives, per cell unit squared, of an image smoothed by a Gaussian of
/// standard deviation `sigma` cell units.
///
/// The derivatives are taken of the Gaussian, whose sampled kernels are corrected so that inside
/// the image the Hessian of every polynomial of degree 3 is that of the smoothed polynomial; with a
/// `sigma` of 0 they are differences of neighbours. Times `sigma^2` the values can be compared between
/// scales (Lindeberg 1998).
///
/// # Errors
/// A value or `sigma` that makes no sense, or the caller cancelled.
pub fn hessian<const D: usize>(
    image: &Grid<f64, D>,
    sigma: f64,
    exec: &Exec,
) -> Result<TensorField<D>, FilterError> {
    image.check_finite()?;
    check_sigma(sigma)?;
    let shape = *image.shape();
    let derivatives = Derivatives::new(shape, sigma, exec.simd());
    let components = TensorField::<D>::COMPONENTS;
    let mut values = vec![0.0; shape.cells() * components];
    let progress = (0.0..1.0, exec);
    let put = |slab: &mut [f64], component: usize, first: usize, row: &[f64]| {
        let places = slab[first * components + component..].iter_mut().step_by(components);
        places.zip(row).for_each(|(place, value)| *place = *value);
    };
    derivatives.fill(image, &second_orders(), &mut values, progress, put)?;
    Ok(TensorField::from_parts(shape, values))
}
