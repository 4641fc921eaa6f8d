//! A float with an exponent of its own.

use std::f64::consts::LN_2;

/// A number `value * 2^exponent` that neither underflows nor overflows.
///
/// Heat falls by thousands of orders of magnitude across a picture; f64 ends at 308. The relative
/// precision is that of f64. Exponents may grow to a thousand million.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wide {
    /// Zero, or from 1 (inclusive) to 2 (exclusive) in magnitude.
    value: f64,
    exponent: i32,
}

impl Wide {
    /// Zero.
    pub const ZERO: Self = Self { value: 0.0, exponent: i32::MIN / 2 };

    /// The number `value * 2^exponent` of a finite `value`.
    #[inline]
    #[must_use]
    pub fn new(value: f64, exponent: i32) -> Self {
        match exponent_of(value) {
            -1023 if value == 0.0 => Self::ZERO,
            // A subnormal number.
            -1023 => Self::new(value * power_of_two(100), exponent - 100),
            own => Self {
                value: f64::from_bits(value.to_bits() & !EXPONENT_BITS | 1.0_f64.to_bits()),
                exponent: exponent + own,
            },
        }
    }

    /// Whether the number is zero.
    #[inline]
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.value == 0.0
    }

    /// The number as `value * 2^exponent`, the value from 1 to 2 in magnitude, or zero.
    #[must_use]
    pub fn parts(self) -> (f64, i32) {
        (self.value, if self.is_zero() { 0 } else { self.exponent })
    }

    /// The power of two below the magnitude.
    #[inline]
    pub(super) fn exponent(self) -> i32 {
        self.exponent
    }

    /// The number divided by `2^exponent`, as f64; it must fit.
    #[inline]
    pub(super) fn relative_to(self, exponent: i32) -> f64 {
        self.value * power_of_two((self.exponent - exponent).clamp(-1023, 1023))
    }

    /// The number times `2^exponent`.
    #[inline]
    #[must_use]
    pub fn shifted(self, exponent: i32) -> Self {
        if self.is_zero() { self } else { Self { exponent: self.exponent + exponent, ..self } }
    }

    /// The number times `factor`.
    #[inline]
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self::new(self.value, 0).product(Self::new(factor, 0)).shifted(self.exponent)
    }

    /// The product of two numbers whose exponents are small.
    #[inline]
    fn product(self, other: Self) -> Self {
        Self::new(self.value * other.value, 0).shifted(self.exponent + other.exponent)
    }

    /// The sum.
    #[inline]
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let (large, small) =
            if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let apart = large.exponent - small.exponent;
        if apart > 100 {
            return large;
        }
        Self::new(large.value + small.value * power_of_two(-apart), large.exponent)
    }

    /// Whether the number is positive and larger than `other`, which is not negative.
    pub(super) fn is_above(self, other: Self) -> bool {
        self.value > 0.0 && (self.exponent, self.value) > (other.exponent, other.value)
    }

    /// The number as f64, which it must not be too large for; below its range zero.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.relative_to(0)
    }

    /// The natural logarithm; minus infinity for zero.
    #[must_use]
    pub fn ln(self) -> f64 {
        if self.is_zero() {
            return f64::NEG_INFINITY;
        }
        self.value.ln() + f64::from(self.exponent) * LN_2
    }
}

impl From<f64> for Wide {
    fn from(value: f64) -> Self {
        Self::new(value, 0)
    }
}

const EXPONENT_BITS: u64 = 0x7ff << 52;

/// The exponent in the bits of `value`: -1023 for zero and subnormal numbers.
#[inline]
pub(super) fn exponent_of(value: f64) -> i32 {
    ((value.to_bits() & EXPONENT_BITS) >> 52) as i32 - 1023
}

/// Two to the power `exponent`, from -1023 (which gives zero) to 1023.
#[inline]
pub(crate) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_is_that_of_f64_within_its_range() {
        let values = [1.0, -3.5, 1e-300, 7e250, 0.1, 0.0, -0.3, 4e-310];
        for a in values {
            assert_eq!(Wide::from(a).relative_to(0), if a.abs() < 1e-300 { 0.0 } else { a });
            for b in values {
                let sum = Wide::from(a).plus(Wide::from(b));
                assert_eq!(sum, Wide::from(a + b), "{a} + {b}");
            }
        }
        assert_eq!(Wide::from(3.0).times(0.5), Wide::from(1.5));
        assert_eq!(Wide::from(3.0).times(0.0), Wide::ZERO);
        assert_eq!(Wide::ZERO.ln(), f64::NEG_INFINITY);
    }

    #[test]
    fn the_range_does_not_end() {
        let mut tiny = Wide::from(1.0);
        for _ in 0..1000 {
            tiny = tiny.times(1e-300);
        }
        assert!((tiny.ln() / (-300_000.0 * 10_f64.ln()) - 1.0).abs() < 1e-14);
        assert_eq!(tiny.plus(Wide::from(1.0)), Wide::from(1.0));
        assert_eq!(tiny.plus(tiny), tiny.times(2.0));
        assert_eq!(Wide::new(1.0, 1).shifted(-5).ln(), -4.0 * LN_2);
    }
}
