//! First derivatives and the structure tensor.

use super::separable::{Derivatives, first_orders};
use super::{FilterError, check_sigma, smooth};
use crate::exec::{Cancelled, Exec};
use crate::grid::{Grid, TensorField};
use std::ops::Range;

/// The gradient, per cell unit, of an image smoothed by a Gaussian of standard deviation `sigma` cell
/// units.
///
/// Inside the image it is exact for polynomials of degree 2; with a `sigma` of 0 it is the central
/// difference.
///
/// # Errors
/// A value or `sigma` that makes no sense, or the caller cancelled.
pub fn gaussian_gradient<const D: usize>(
    image: &Grid<f64, D>,
    sigma: f64,
    exec: &Exec,
) -> Result<Grid<[f64; D], D>, FilterError> {
    image.check_finite()?;
    check_sigma(sigma)?;
    Ok(gradient(image, sigma, 0.0..1.0, exec)?)
}

/// The same for an image and width that make sense.
pub(super) fn gradient<const D: usize>(
    image: &Grid<f64, D>,
    sigma: f64,
    share: Range<f64>,
    exec: &Exec,
) -> Result<Grid<[f64; D], D>, Cancelled> {
    let derivatives = Derivatives::new(*image.shape(), sigma, exec.simd());
    let mut gradient = image.map(|_| [0.0; D]);
    let put = |slab: &mut [[f64; D]], axis: usize, first: usize, row: &[f64]| {
        let places = slab[first..].iter_mut().zip(row);
        places.for_each(|(gradient, value)| gradient[axis] = *value);
    };
    derivatives.fill(image, &first_orders(), gradient.values_mut(), (share, exec), put)?;
    Ok(gradient)
}

/// The structure tensor `J_rho = K_rho * (grad f_sigma  grad f_sigma')`: the products of the first
/// derivatives of an image smoothed by `sigma`, averaged by a Gaussian of standard deviation `rho`,
/// both in cell units (Weickert 1999; Yang & Cohen, section 2.2).
///
/// Its eigenvectors are the directions in which the image changes most and least around a cell;
/// opposite sides of a line agree in it, where their gradients would cancel. A `rho` of 0 leaves the
/// products as they are.
///
/// # Errors
/// A value, `sigma` or `rho` that makes no sense, or the caller cancelled.
pub fn structure_tensor<const D: usize>(
    image: &Grid<f64, D>,
    sigma: f64,
    rho: f64,
    exec: &Exec,
) -> Result<TensorField<D>, FilterError> {
    image.check_finite()?;
    check_sigma(sigma)?;
    check_sigma(rho)?;
    let components = TensorField::<D>::COMPONENTS;
    // One pass for the gradient, and one for each product.
    let share = |pass: usize| {
        let part = 1.0 / (1 + components) as f64;
        pass as f64 * part..(pass + 1) as f64 * part
    };
    let gradient = gradient(image, sigma, share(0), exec)?;
    let mut values = vec![0.0; image.shape().cells() * components];
    let pairs = (0..D).flat_map(|i| (i..D).map(move |j| [i, j]));
    for (component, [i, j]) in pairs.enumerate() {
        let product = gradient.map(|gradient| gradient[i] * gradient[j]);
        let average = smooth(&product, rho, share(1 + component), exec)?;
        let places = values[component..].iter_mut().step_by(components);
        places.zip(average.values()).for_each(|(place, value)| *place = *value);
    }
    Ok(TensorField::from_parts(*image.shape(), values))
}
