//! The structure tensor.

use super::separable::first_orders;
use super::{FilterError, check_sigma, derivative};
use crate::exec::Exec;
use crate::grid::{Grid, TensorField};

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
    // One pass for each derivative and each product.
    let share = |pass: usize| {
        let part = 1.0 / (D + components) as f64;
        pass as f64 * part..(pass + 1) as f64 * part
    };
    let mut gradient = Vec::with_capacity(D);
    for (axis, orders) in first_orders().into_iter().enumerate() {
        gradient.push(derivative(image, sigma, orders, share(axis), exec)?.into_values());
    }
    let mut values = vec![0.0; image.shape().cells() * components];
    let pairs = (0..D).flat_map(|i| (i..D).map(move |j| [i, j]));
    for (component, [i, j]) in pairs.enumerate() {
        let product = gradient[i].iter().zip(&gradient[j]).map(|(a, b)| a * b).collect();
        let product = Grid::from_parts(*image.shape(), product);
        let average = derivative(&product, rho, [0; D], share(D + component), exec)?;
        let places = values[component..].iter_mut().step_by(components);
        places.zip(average.values()).for_each(|(place, value)| *place = *value);
    }
    Ok(TensorField::from_parts(*image.shape(), values))
}
