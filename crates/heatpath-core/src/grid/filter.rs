//! Gaussian smoothing and image gradients.

use super::{Grid, Shape};
use thiserror::Error;

/// A Gaussian's width is negative, infinite or not a number.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("smoothing sigma is {0}; it must be zero or a positive finite number of cells")]
pub struct SigmaError(pub f64);

/// Where the truncated Gaussian ends, in standard deviations: `exp(-8)` of the peak is left there.
const TRUNCATE: f64 = 4.0;

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
    if !(sigma.is_finite() && sigma >= 0.0) {
        return Err(SigmaError(sigma));
    }
    let shape = *image.shape();
    let mut result = image.clone();
    for axis in 0..D {
        let cells = sigma * shape.smallest_spacing() / shape.spacing()[axis];
        let kernel = half_gaussian(cells, shape.size()[axis]);
        if kernel.len() > 1 {
            result = convolve(&result, axis, &kernel);
        }
    }
    Ok(result)
}

/// The weights of a normalised Gaussian at offsets 0, 1, 2, ...
fn half_gaussian(sigma: f64, longest: usize) -> Vec<f64> {
    // Mirrored images repeat after two lengths, so a wider kernel would add nothing new.
    let radius = ((TRUNCATE * sigma).ceil() as usize).min(2 * longest);
    let mut half: Vec<f64> = (0..=radius)
        .map(|i| if i == 0 { 1.0 } else { (-0.5 * (i as f64 / sigma).powi(2)).exp() })
        .collect();
    let total = half[0] + 2.0 * half[1..].iter().sum::<f64>();
    half.iter_mut().for_each(|weight| *weight /= total);
    half
}

/// Convolves along one axis with a symmetric kernel given by its non-negative offsets.
fn convolve<const D: usize>(image: &Grid<f64, D>, axis: usize, half: &[f64]) -> Grid<f64, D> {
    let shape = image.shape();
    let (n, stride) = (shape.size()[axis] as isize, shape.stride(axis) as isize);
    let values = image.values();
    Grid::from_fn(*shape, |index| {
        let base = shape.position(index) as isize - index[axis] as isize * stride;
        let at = |i: isize| values[(base + mirror(i, n) * stride) as usize];
        let centre = index[axis] as isize;
        let pairs = half.iter().enumerate().skip(1);
        pairs.fold(half[0] * at(centre), |sum, (offset, weight)| {
            sum + weight * (at(centre - offset as isize) + at(centre + offset as isize))
        })
    })
}

/// The index that a mirror at the borders -0.5 and n - 0.5 shows in place of `i`.
fn mirror(i: isize, n: isize) -> isize {
    let folded = i.rem_euclid(2 * n);
    if folded < n { folded } else { 2 * n - 1 - folded }
}

/// The squared length of the image gradient per cell unit, by central differences.
///
/// Differences are divided by the physical distance and multiplied by the smallest spacing, so the
/// value does not depend on the unit of length. At the border the image is mirrored, which leaves
/// half of the one-sided difference.
#[must_use]
pub fn gradient_sq<const D: usize>(image: &Grid<f64, D>) -> Grid<f64, D> {
    let shape: &Shape<D> = image.shape();
    let scale = shape.spacing().map(|h| 0.5 * shape.smallest_spacing() / h);
    Grid::from_fn(*shape, |index| {
        let centre = shape.position(index);
        (0..D)
            .map(|axis| {
                let stride = shape.stride(axis);
                let lower = if index[axis] > 0 { centre - stride } else { centre };
                let upper =
                    if index[axis] + 1 < shape.size()[axis] { centre + stride } else { centre };
                (scale[axis] * (image.values()[upper] - image.values()[lower])).powi(2)
            })
            .sum()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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
