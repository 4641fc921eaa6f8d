//! One-dimensional Gaussian kernels and the loop that applies them.

use crate::simd::SimdLevel;

/// Where the truncated Gaussian ends, in standard deviations: `exp(-8)` of the peak is left there.
const TRUNCATE: f64 = 4.0;

/// Below this many cells a sampled Gaussian is the cell itself.
const SMALLEST_SIGMA: f64 = 1e-3;

/// How many cells of a row are computed at once.
const BLOCK: usize = 32;

/// The weights at offsets 0, 1, 2, ... of a kernel that is even or odd.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Kernel {
    half: Vec<f64>,
    odd: bool,
}

impl Kernel {
    /// An even kernel of these weights at offsets 0, 1, 2, ...
    pub(super) fn even(half: Vec<f64>) -> Self {
        Self { half, odd: false }
    }

    /// The derivative of the given order, 0 to 2, of a Gaussian of `sigma` cells, sampled and cut at
    /// four standard deviations. `longest` is the number of cells along the axis.
    ///
    /// What cutting and sampling lose is made up for in the moments: constants are kept by order 0,
    /// and orders 1 and 2 are exact for polynomials of degree 2 and 3. As `sigma` goes to 0 they
    /// become the central differences.
    pub(super) fn gaussian(order: usize, sigma: f64, longest: usize) -> Self {
        // Mirrored images repeat after two lengths, so a wider kernel would add nothing new.
        let radius = ((TRUNCATE * sigma).ceil() as usize).min(2 * longest);
        match order {
            0 => Self::even(smoothing(sigma, radius)),
            1 => Self { half: first_derivative(sigma, radius.max(1)), odd: true },
            _ => Self::even(second_derivative(sigma, radius.max(1))),
        }
    }

    /// The same kernel times `factor`.
    pub(super) fn times(mut self, factor: f64) -> Self {
        self.half.iter_mut().for_each(|weight| *weight *= factor);
        self
    }

    /// The largest offset.
    pub(super) fn radius(&self) -> usize {
        self.half.len() - 1
    }

    /// The weights and the places where they apply, `place(offset)` from that of the result.
    pub(super) fn taps(&self, place: impl Fn(isize) -> usize) -> Vec<Tap> {
        let tap = |(offset, &weight): (usize, &f64)| {
            // The middle is read twice.
            let weight = if offset == 0 { 0.5 * weight } else { weight };
            Tap { weight, lower: place(-(offset as isize)), upper: place(offset as isize) }
        };
        self.half.iter().enumerate().skip(usize::from(self.odd)).map(tap).collect()
    }

    /// `result[i]` = sum over `taps` of `weight (values[upper + i] + values[lower + i])`, or the
    /// difference of the two for an odd kernel.
    pub(super) fn apply(&self, taps: &[Tap], values: &[f64], result: &mut [f64], simd: SimdLevel) {
        if self.odd {
            simd.run(
                #[inline(always)]
                || combine(taps, values, result, |upper, lower| upper - lower),
            );
        } else {
            simd.run(
                #[inline(always)]
                || combine(taps, values, result, |upper, lower| upper + lower),
            );
        }
    }
}

/// A weight and where it applies.
pub(super) struct Tap {
    weight: f64,
    lower: usize,
    upper: usize,
}

#[inline(always)]
fn combine(taps: &[Tap], values: &[f64], result: &mut [f64], pair: impl Fn(f64, f64) -> f64) {
    let (blocks, rest) = result.as_chunks_mut::<BLOCK>();
    let first_of_rest = blocks.len() * BLOCK;
    for (block, result) in blocks.iter_mut().enumerate() {
        let mut sums = [0.0; BLOCK];
        for tap in taps {
            let upper = &values[tap.upper + block * BLOCK..][..BLOCK];
            let lower = &values[tap.lower + block * BLOCK..][..BLOCK];
            for i in 0..BLOCK {
                sums[i] += tap.weight * pair(upper[i], lower[i]);
            }
        }
        *result = sums;
    }
    for (i, sum) in rest.iter_mut().enumerate() {
        let i = first_of_rest + i;
        let terms = taps.iter().map(|t| t.weight * pair(values[t.upper + i], values[t.lower + i]));
        *sum = terms.fold(0.0, |sum, term| sum + term);
    }
}

/// The index that a mirror at the borders -0.5 and n - 0.5 shows in place of `i`.
pub(super) fn mirror(i: isize, n: usize) -> usize {
    let n = n as isize;
    if (0..n).contains(&i) {
        return i as usize;
    }
    let folded = i.rem_euclid(2 * n);
    (if folded < n { folded } else { 2 * n - 1 - folded }) as usize
}

/// Copies `row` with `margin` mirrored values before and after it.
pub(super) fn pad(row: &[f64], margin: usize, padded: &mut [f64]) {
    let n = row.len();
    padded[margin..margin + n].copy_from_slice(row);
    for i in 0..margin {
        padded[i] = row[mirror(i as isize - margin as isize, n)];
        padded[margin + n + i] = row[mirror((n + i) as isize, n)];
    }
}

/// A Gaussian that adds up to 1.
fn smoothing(sigma: f64, radius: usize) -> Vec<f64> {
    let sigma = sigma.max(SMALLEST_SIGMA);
    let mut half: Vec<f64> =
        (0..=radius).map(|i| (-0.5 * (i as f64 / sigma).powi(2)).exp()).collect();
    let total = half[0] + 2.0 * half[1..].iter().sum::<f64>();
    half.iter_mut().for_each(|weight| *weight /= total);
    half
}

/// A Gaussian over its value at offset 1, which is there however narrow it is; at offset 0 it may
/// be infinite.
fn over_first(sigma: f64, i: usize) -> f64 {
    ((1.0 - (i as f64).powi(2)) / (2.0 * sigma.max(SMALLEST_SIGMA).powi(2))).exp()
}

/// `i g(i)`, scaled so that a ramp has its slope.
fn first_derivative(sigma: f64, radius: usize) -> Vec<f64> {
    let mut half: Vec<f64> =
        (0..=radius).map(|i| if i == 0 { 0.0 } else { i as f64 * over_first(sigma, i) }).collect();
    let slope: f64 = half.iter().enumerate().map(|(i, weight)| 2.0 * i as f64 * weight).sum();
    half.iter_mut().for_each(|weight| *weight /= slope);
    half
}

/// `(i^2 - m) g(i)` with the m that keeps constants at 0, scaled so that a parabola has its
/// curvature.
fn second_derivative(sigma: f64, radius: usize) -> Vec<f64> {
    let moment = |power: i32| -> f64 {
        (1..=radius).map(|i| 2.0 * (i as f64).powi(power) * over_first(sigma, i)).sum()
    };
    let mean_square = moment(2) / (over_first(sigma, 0) + moment(0));
    let scale = 2.0 / (moment(4) - mean_square * moment(2));
    let mut half: Vec<f64> = (0..=radius)
        .map(|i| {
            if i == 0 { 0.0 } else { scale * ((i * i) as f64 - mean_square) * over_first(sigma, i) }
        })
        .collect();
    half[0] = -2.0 * half[1..].iter().sum::<f64>();
    half
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum of the kernel times `offset^power`.
    fn moment(kernel: &Kernel, power: i32) -> f64 {
        let of = |(offset, weight): (usize, &f64)| {
            let offset = offset as f64;
            let mirrored = if kernel.odd { -weight } else { *weight };
            weight * offset.powi(power) + mirrored * (-offset).powi(power)
        };
        let twice_the_middle = if power == 0 { kernel.half[0] } else { 0.0 };
        kernel.half.iter().enumerate().map(of).sum::<f64>() - twice_the_middle
    }

    #[test]
    fn moments_are_those_of_derivatives() {
        for sigma in [0.0, 0.01, 0.2, 0.5, 1.0, 2.7, 10.0] {
            let expected = [[1.0, 0.0, f64::NAN], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]];
            for (order, expected) in expected.into_iter().enumerate() {
                let kernel = Kernel::gaussian(order, sigma, 100);
                for (power, expected) in expected.into_iter().enumerate() {
                    let moment = moment(&kernel, power as i32);
                    let error = if expected.is_nan() { 0.0 } else { (moment - expected).abs() };
                    assert!(error < 1e-13, "sigma {sigma}, order {order}: {moment}");
                }
            }
        }
    }

    #[test]
    fn narrow_kernels_are_differences() {
        assert_eq!(Kernel::gaussian(0, 0.0, 9).half, [1.0]);
        assert_eq!(Kernel::gaussian(1, 0.0, 9).half, [0.0, 0.5]);
        assert_eq!(Kernel::gaussian(2, 0.0, 9).half, [-2.0, 1.0]);
    }

    #[test]
    fn wide_kernels_are_sampled_derivatives() {
        let (sigma, x) = (4.0_f64, 3.0_f64);
        let g = (-0.5 * (x / sigma) * (x / sigma)).exp() / (sigma * std::f64::consts::TAU.sqrt());
        let at_3 = |order| Kernel::gaussian(order, sigma, 100).half[3];
        assert!((at_3(0) / g - 1.0).abs() < 1e-3);
        // A kernel stands for a sum with f(x + i), which turns the odd derivative round.
        assert!((at_3(1) / (g * x / sigma.powi(2)) - 1.0).abs() < 2e-3);
        let second = g * (x * x - sigma * sigma) / sigma.powi(4);
        assert!((at_3(2) / second - 1.0).abs() < 2e-2);
    }

    #[test]
    fn blocks_and_rest_agree_with_the_plain_sum() {
        let values: Vec<f64> = (0..100).map(|i| f64::from(i * i % 37)).collect();
        for order in 0..3 {
            let kernel = Kernel::gaussian(order, 1.3, 100);
            let mut padded = vec![0.0; 100 + 2 * kernel.radius()];
            pad(&values, kernel.radius(), &mut padded);
            let mut result = vec![0.0; 100];
            let taps = kernel.taps(|offset| (kernel.radius() as isize + offset) as usize);
            kernel.apply(&taps, &padded, &mut result, SimdLevel::best());
            for (i, found) in result.into_iter().enumerate() {
                let at = |offset: isize| values[mirror(i as isize + offset, 100)];
                let sign = if kernel.odd { -1.0 } else { 1.0 };
                let expected: f64 = (1..=kernel.radius() as isize)
                    .map(|k| kernel.half[k as usize] * (at(k) + sign * at(-k)))
                    .sum::<f64>()
                    + kernel.half[0] * at(0);
                assert!((found - expected).abs() < 1e-12, "order {order}, {i}: {found}");
            }
        }
    }
}
