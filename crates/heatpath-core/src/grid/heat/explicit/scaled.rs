//! Numbers beyond the range of f64: one power of two for a whole block of values.
//!
//! Heat falls by hundreds or thousands of orders of magnitude across a picture, but only by some
//! tens from a cell to the next. A block of neighbouring cells therefore shares one exponent.
//! Multiplying by a power of two is exact, so the bits are those of a float without limits, as long
//! as the values of one block differ by less than [`RANGE`] powers of two.

use std::ops::Range;
use wide::f64x8;

/// The largest value of a block is kept near two to this power, with room above for sums.
const TOP: i32 = 960;

/// Values smaller than two to this power are dropped: their neighbours may have been lost below
/// the smallest f64, so they could be wrong.
const BOTTOM: i32 = -960;

/// How many powers of two the values of one block may span.
pub(super) const RANGE: i32 = TOP - BOTTOM;

/// Values that stand for `value * 2^exponent`.
#[derive(Clone, Debug, Default)]
pub(super) struct Scaled {
    pub(super) exponent: i32,
    pub(super) values: Vec<f64>,
}

impl Scaled {
    /// No heat, scaled for values near one.
    pub(super) fn zeros(len: usize) -> Self {
        Self { exponent: -TOP, values: vec![0.0; len] }
    }

    /// Adds `amount` to the value at `i`.
    pub(super) fn add_at(&mut self, i: usize, amount: f64) {
        self.values[i] += Scale::new(-self.exponent).apply(amount);
    }

    /// Makes room for `len` values of up to about `2^exponent` times [`TOP`]: keeps the larger of the
    /// two exponents.
    #[inline(always)]
    pub(super) fn grow(&mut self, exponent: i32, len: usize) {
        if self.values.is_empty() {
            *self = Self { exponent, values: vec![0.0; len] };
        }
        if exponent > self.exponent {
            let scale = Scale::new(self.exponent - exponent);
            self.values.iter_mut().for_each(|value| *value = scale.apply(*value));
            self.exponent = exponent;
        }
    }

    /// The natural logarithms of some of the values, minus infinity for zero.
    ///
    /// The same bits whatever the exponent of the block.
    pub(super) fn ln(&self, range: Range<usize>, logarithms: &mut [f64]) {
        for (values, logarithms) in self.values[range].chunks(8).zip(logarithms.chunks_mut(8)) {
            let (mut mantissas, mut exponents) = ([1.0; 8], [f64::NEG_INFINITY; 8]);
            for (i, &value) in values.iter().enumerate() {
                if trusted(value) > 0.0 {
                    let exponent = exponent_of(value);
                    mantissas[i] = value * power_of_two(-exponent);
                    exponents[i] = f64::from(exponent + self.exponent);
                }
            }
            let ln = f64x8::from(mantissas).ln() + f64x8::from(exponents) * f64x8::LN_2;
            logarithms.copy_from_slice(&ln.to_array()[..logarithms.len()]);
        }
    }
}

/// Zero in place of a value too small to be trusted.
#[inline(always)]
pub(super) fn trusted(value: f64) -> f64 {
    const SMALLEST: f64 = power_of_two(BOTTOM);
    if value < SMALLEST { 0.0 } else { value }
}

/// What values must not be smaller than if those `steps` later shall not be dropped: a cell that
/// heat comes to in a step seldom has less than 2^-16 of the cell before.
pub(super) fn nearly_lost(steps: usize) -> f64 {
    power_of_two(BOTTOM + 16 * steps as i32)
}

/// The largest of some values that are not negative.
pub(super) fn largest(values: &[f64]) -> f64 {
    let mut largest = Largest::default();
    largest.take(values);
    largest.value()
}

/// The largest of values that come in parts and are not negative.
///
/// Many at a time, because the comparisons of one maximum wait for each other.
#[derive(Default)]
pub(super) struct Largest([f64; 16]);

impl Largest {
    #[inline(always)]
    pub(super) fn take(&mut self, values: &[f64]) {
        let (chunks, rest) = values.as_chunks::<16>();
        let mut lanes = self.0;
        for chunk in chunks {
            lanes = std::array::from_fn(|lane| greater(chunk[lane], lanes[lane]));
        }
        self.0 = lanes;
        let lanes = self.0.iter_mut().zip(rest);
        lanes.for_each(|(lane, &value)| *lane = greater(value, *lane));
    }

    pub(super) fn value(&self) -> f64 {
        self.0.into_iter().fold(0.0, greater)
    }
}

#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The exponent for a block whose largest value is `value * 2^exponent`.
pub(super) fn exponent_for(value: f64, exponent: i32) -> i32 {
    exponent + exponent_of(value) - TOP
}

/// The exponent of a positive f64: `value` is at least two to this power and less than twice that
/// (subnormal values count as the smallest normal one).
pub(super) fn exponent_of(value: f64) -> i32 {
    (value.to_bits() >> 52) as i32 - 1023
}

/// A multiplication by a power of two that may itself be out of range.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    first: f64,
    second: f64,
}

impl Scale {
    pub(super) fn new(exponent: i32) -> Self {
        if exponent < -2044 {
            return Self { first: 0.0, second: 0.0 };
        }
        // Two factors reach from the smallest f64 to the largest.
        let half = exponent.min(2044) / 2;
        let rest = exponent.min(2044) - half;
        Self { first: power_of_two(half), second: power_of_two(rest) }
    }

    #[inline(always)]
    pub(super) fn apply(self, value: f64) -> f64 {
        value * self.first * self.second
    }
}

/// Two to the power `exponent`, which must be that of a normal f64 (-1022 to 1023).
const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_exact_and_never_overflow_half_way() {
        assert_eq!(Scale::new(3).apply(1.5), 12.0);
        assert_eq!(Scale::new(1760).apply(power_of_two(-900)), power_of_two(860));
        assert_eq!(Scale::new(-1900).apply(power_of_two(960)), power_of_two(-940));
        assert_eq!(Scale::new(i32::MIN / 2).apply(power_of_two(1000)), 0.0);
        assert_eq!(Scale::new(0).apply(0.1), 0.1);
    }

    #[test]
    fn the_largest_is_found_wherever_it_stands() {
        for len in 0..40 {
            for place in 0..len {
                let values: Vec<f64> =
                    (0..len).map(|i| if i == place { 2.0 } else { 1.0 }).collect();
                assert_eq!(largest(&values), 2.0);
            }
        }
        assert_eq!(largest(&[]), 0.0);
    }

    #[test]
    fn growing_keeps_the_values() {
        let mut heat = Scaled { exponent: -5000, values: vec![3.0, 0.0] };
        heat.grow(-4999, 2);
        assert_eq!((heat.exponent, &heat.values[..]), (-4999, &[1.5, 0.0][..]));
        heat.grow(-9000, 2);
        assert_eq!((heat.exponent, &heat.values[..]), (-4999, &[1.5, 0.0][..]));
        let mut ln = [0.0; 2];
        heat.ln(0..2, &mut ln);
        assert!((ln[0] - 1.5_f64.ln() + 4999.0 * std::f64::consts::LN_2).abs() < 1e-12);
        assert_eq!(ln[1], f64::NEG_INFINITY);
        let mut empty = Scaled::default();
        empty.grow(-70, 1);
        assert_eq!((empty.exponent, empty.values), (-70, vec![0.0]));
    }

    #[test]
    fn the_largest_value_of_a_block_is_kept_near_the_top() {
        let exponent = exponent_for(3.0, -4000);
        let kept = Scale::new(-4000 - exponent).apply(3.0);
        assert_eq!(exponent_of(kept), TOP);
        assert_eq!(RANGE, 1920);
    }
}
