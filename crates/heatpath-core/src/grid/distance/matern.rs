//! What implicit heat looks like in a uniform medium: the Matérn functions.
//!
//! One implicit step is not the heat kernel but the resolvent: `(1 - step laplace)^-1` of a point
//! is `K_0(r) / 2 pi` in the plane and `exp(-r) / 4 pi r` in space, where r is the distance over
//! `sqrt(step)`. After m steps it is `r^v K_v(r) / ((2 pi)^(N/2) 2^(m-1) (m-1)!)` with
//! `v = m - N/2`, where K is the modified Bessel function of the second kind. Everything here is in
//! logarithms, for r of any size.

use crate::grid::Grid;

/// What is left of a unit of heat after some implicit steps, as a function of the distance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Matern {
    /// The dimension of space: 1, 2 or 3.
    pub(crate) dimension: usize,
    /// The number of steps.
    pub(crate) steps: usize,
    /// Whether all steps are added up, as in the exposure, or only the last one counts.
    pub(crate) sum: bool,
}

impl Matern {
    /// The logarithm of the function at `r > 0`, and its slope.
    pub(crate) fn ln(self, r: f64) -> (f64, f64) {
        use std::f64::consts::{LN_2, PI};
        // The ratio is K_(v+1) / K_v, of the order v of the step.
        let (mut ln, mut slope, mut ratio, mut order) = match self.dimension {
            1 => (-r - LN_2, -1.0, 1.0 + 1.0 / r, 0.5),
            2 => {
                let (ln_k0, ratio) = bessel_k0(r);
                (ln_k0 - (2.0 * PI).ln(), -ratio, ratio, 0.0)
            }
            _ => (-r - (4.0 * PI * r).ln(), -1.0 - 1.0 / r, 1.0, -0.5),
        };
        // The sum of the steps so far over the last of them, and its slope over the last.
        let (mut total, mut total_slope) = (1.0, slope);
        for step in 1..self.steps {
            let growth = r * ratio / (2.0 * step as f64);
            ln += growth.ln();
            slope = -1.0 / ratio;
            order += 1.0;
            ratio = 1.0 / ratio + 2.0 * order / r;
            total = total / growth + 1.0;
            total_slope = total_slope / growth + slope;
        }
        if self.sum { (ln + total.ln(), total_slope / total) } else { (ln, slope) }
    }

    /// The distance at which the function has the logarithm `ln`: Newton's method from `guess`.
    ///
    /// Zero if the function is nowhere as large.
    pub(crate) fn distance(self, ln: f64, guess: f64) -> f64 {
        let mut r = guess.max(SMALLEST);
        for _ in 0..100 {
            let (here, slope) = self.ln(r);
            let next = (r + (ln - here) / slope).clamp(0.25 * r, 4.0 * r + 1.0);
            if next < SMALLEST {
                return 0.0;
            }
            // The next step would be the square of this one.
            if (next - r).abs() <= 1e-7 * r {
                return next;
            }
            r = next;
        }
        r
    }
}

/// Distances below this are zero.
const SMALLEST: f64 = 1e-12;

/// The inverse of a [`Matern`] function, tabulated.
///
/// A distance is a cubic polynomial of the logarithm in each of many pieces, which meet with equal
/// values and slopes (Hermite interpolation). Close to the source the distance is like a root or an
/// exponential, far away nearly linear: pieces that are each longer than the last by the same factor
/// suit all of them. Against Newton's method the distances are off by less than 3e-8 of
/// themselves after up to ten steps; a map of 512 x 512 cells takes 1.4 ms instead of 23.
#[derive(Debug)]
pub(crate) struct Inverse {
    function: Matern,
    /// The logarithm from which pieces are counted downwards.
    origin: f64,
    /// The number of the first piece.
    first: u64,
    /// The coefficients of each piece.
    pieces: Vec<[f64; 4]>,
}

/// Below this distance Newton's method serves; few cells are as near to a source.
const NEAREST: f64 = 1.0 / 16.0;

/// The pieces between a number and its double are two to this power.
const PIECES: u32 = 6;

impl Inverse {
    /// The inverse down to the logarithm `lowest`; none is tabulated if that is above all pieces.
    pub(crate) fn new(function: Matern, lowest: f64) -> Self {
        let (ln, slope) = function.ln(NEAREST);
        // The distance is like the root of what is missing to the top, which would be here.
        let nearest = -0.5 * slope * NEAREST;
        let (origin, first) = (ln + nearest, piece(nearest) + 1);
        let end = first.max(piece((origin - lowest).max(nearest)) + 1);
        let mut guess = NEAREST;
        let knots: Vec<[f64; 3]> = (first..=end)
            .map(|number| {
                let s = start(number);
                guess = function.distance(origin - s, guess);
                [s, guess, -1.0 / function.ln(guess).1]
            })
            .collect();
        let pieces = knots.windows(2).map(|ends| hermite(ends[0], ends[1])).collect();
        Self { function, origin, first, pieces }
    }

    /// The distance at which the function has the logarithm `ln`.
    #[inline]
    pub(crate) fn distance(&self, ln: f64) -> f64 {
        let s = self.origin - ln;
        let number = piece(s);
        match self.pieces.get(number.wrapping_sub(self.first) as usize) {
            Some([a, b, c, d]) => {
                let t = s - start(number);
                a + t * (b + t * (c + t * d))
            }
            None => self.function.distance(ln, NEAREST),
        }
    }
}

/// The smallest finite value of a field of logarithms; infinity if there is none.
pub(crate) fn lowest<const D: usize>(field: &Grid<f64, D>) -> f64 {
    field.values().iter().copied().filter(|ln| ln.is_finite()).fold(f64::INFINITY, f64::min)
}

/// The number of the piece in which `s` lies: its exponent and the first bits behind.
fn piece(s: f64) -> u64 {
    s.to_bits() >> (52 - PIECES)
}

/// Where a piece starts.
fn start(number: u64) -> f64 {
    f64::from_bits(number << (52 - PIECES))
}

/// The cubic polynomial of `s - s0` with given values and slopes at both ends.
fn hermite([s0, value0, slope0]: [f64; 3], [s1, value1, slope1]: [f64; 3]) -> [f64; 4] {
    let width = s1 - s0;
    let mean = (value1 - value0) / width;
    let square = (3.0 * mean - 2.0 * slope0 - slope1) / width;
    [value0, slope0, square, (slope0 + slope1 - 2.0 * mean) / (width * width)]
}

/// The logarithm of the Bessel function `K_0(x)`, and `K_1(x) / K_0(x)`.
///
/// Abramowitz and Stegun 9.8.1 to 9.8.8; relative errors below 3e-7.
fn bessel_k0(x: f64) -> (f64, f64) {
    let polynomial = |x: f64, coefficients: [f64; 7]| {
        coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
    };
    if x <= 2.0 {
        let (t, y, ln) = ((x / 3.75).powi(2), 0.25 * x * x, (0.5 * x).ln());
        let i0 = polynomial(t, I0);
        let i1 = x * polynomial(t, I1);
        let k0 = polynomial(y, K0_NEAR) - ln * i0;
        let k1 = polynomial(y, K1_NEAR) / x + ln * i1;
        return (k0.ln(), k1 / k0);
    }
    let k0 = polynomial(2.0 / x, K0_FAR);
    (k0.ln() - 0.5 * x.ln() - x, polynomial(2.0 / x, K1_FAR) / k0)
}

const I0: [f64; 7] = [1.0, 3.5156229, 3.0899424, 1.2067492, 0.2659732, 0.0360768, 0.0045813];
const I1: [f64; 7] = [0.5, 0.87890594, 0.51498869, 0.15084934, 0.02658733, 0.00301532, 0.00032411];
const K0_NEAR: [f64; 7] =
    [-0.57721566, 0.42278420, 0.23069756, 0.03488590, 0.00262698, 0.00010750, 0.00000740];
const K1_NEAR: [f64; 7] =
    [1.0, 0.15443144, -0.67278579, -0.18156897, -0.01919402, -0.00110404, -0.00004686];
const K0_FAR: [f64; 7] =
    [1.25331414, -0.07832358, 0.02189568, -0.01062446, 0.00587872, -0.00251540, 0.00053208];
const K1_FAR: [f64; 7] =
    [1.25331414, 0.23498619, -0.03655620, 0.01504268, -0.00780353, 0.00325614, -0.00068245];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_functions() {
        // Values of scipy.special.k0 and k1.
        for (x, k0, k1) in [
            (0.01, 4.721244730161095, 99.97389411857176),
            (1.0, 0.42102443824070834, 0.6019072301972346),
            (2.0, 0.11389387274953341, 0.13986588181652246),
            (3.0, 0.03473950438627925, 0.04015643112819418),
            (30.0, 2.1324774964630566e-14, 2.167732049003943e-14),
        ] {
            let (ln_k0, ratio) = bessel_k0(x);
            assert!((ln_k0 - f64::ln(k0)).abs() < 3e-7, "{x}");
            assert!((ratio / (k1 / k0) - 1.0).abs() < 5e-7, "{x}");
        }
    }

    #[test]
    fn the_slope_is_the_derivative_and_the_distance_the_inverse() {
        for dimension in 1..=3 {
            for steps in [1, 2, 3, 10] {
                for sum in [false, true] {
                    let matern = Matern { dimension, steps, sum };
                    for r in [1e-3, 0.05, 0.7, 3.0, 50.0, 4000.0, 1e6] {
                        let (ln, slope) = matern.ln(r);
                        let d = 1e-4 * r;
                        let difference = (matern.ln(r + d).0 - matern.ln(r - d).0) / (2.0 * d);
                        let scale = slope.abs().max(1e-3);
                        assert!((difference - slope).abs() < 1e-3 * scale, "{matern:?} at {r}");
                        let again = matern.distance(ln, 1.0);
                        // The top of the function is flat.
                        let blur = 1e-13 * ln.abs().max(1.0) / slope.abs();
                        assert!((again - r).abs() < 1e-9 * r + blur, "{matern:?} at {r}: {again}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_table_agrees_with_newton() {
        let mut worst = 0.0_f64;
        for dimension in 1..=3 {
            for steps in [1, 2, 3, 10] {
                for sum in [false, true] {
                    let matern = Matern { dimension, steps, sum };
                    let inverse = Inverse::new(matern, matern.ln(1e9).0);
                    assert!(inverse.pieces.len() < 5000);
                    let mut last = 0.0;
                    for i in -2000..3000 {
                        let r = 10_f64.powf(f64::from(i) * 0.003);
                        let (ln, slope) = matern.ln(r);
                        let (found, exact) = (inverse.distance(ln), matern.distance(ln, r));
                        // The top of the function is flat.
                        let blur = 1e-13 * ln.abs().max(1.0) / slope.abs();
                        let error = ((found - exact).abs() - blur) / r;
                        assert!(error < 1e-7, "{matern:?} at {r}: {found}, {exact}");
                        assert!(found >= last - blur, "{matern:?} at {r}: {found} after {last}");
                        (worst, last) = (worst.max(error), found);
                    }
                }
            }
        }
        println!("largest relative difference {worst:.1e}");
    }

    #[test]
    fn closed_forms_in_space() {
        let matern = |steps| Matern { dimension: 3, steps, sum: false };
        let r = 2.5_f64;
        let pi = std::f64::consts::PI;
        assert!((matern(1).ln(r).0 - ((-r).exp() / (4.0 * pi * r)).ln()).abs() < 1e-14);
        assert!((matern(2).ln(r).0 - ((-r).exp() / (8.0 * pi)).ln()).abs() < 1e-14);
        assert_eq!(matern(2).distance(1.0, 1.0), 0.0);
    }
}
