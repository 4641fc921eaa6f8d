//! What is known of a cell.

use std::hint::select_unpredictable;

/// The bits of what is known of a cell's distance: of itself if it is final, of minus itself as long as
/// it is not.
///
/// So the bits of final distances are in their order, before those of all others, and whole numbers
/// are chosen between without a jump, which the processor could not foresee here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Value(u64);

const INFINITE: u64 = f64::INFINITY.to_bits();

impl Value {
    /// Not yet reached.
    pub(super) const FAR: Self = Self(f64::NEG_INFINITY.to_bits());
    /// Never to be reached.
    pub(super) const WALL: Self = Self(INFINITE);

    pub(super) fn known(distance: f64) -> Self {
        Self(distance.abs().to_bits())
    }

    pub(super) fn trial(distance: f64) -> Self {
        Self((-distance).to_bits())
    }

    #[inline]
    pub(super) fn is_known(self) -> bool {
        self.0 <= INFINITE
    }

    #[inline]
    pub(super) fn is_trial(self, distance: f64) -> bool {
        self == Self::trial(distance)
    }

    /// The distance as long as it is not final.
    #[inline]
    pub(super) fn as_trial(self) -> Option<f64> {
        (!self.is_known()).then_some(-f64::from_bits(self.0))
    }

    #[inline]
    pub(super) fn is_improved_by(self, distance: f64) -> bool {
        !self.is_known() && distance < -f64::from_bits(self.0)
    }

    #[inline]
    pub(super) fn or_infinite(self) -> f64 {
        f64::from_bits(self.0.min(INFINITE))
    }
}

/// One of two numbers, without a jump.
#[inline]
pub(super) fn choose(first: bool, a: f64, b: f64) -> f64 {
    f64::from_bits(select_unpredictable(first, a.to_bits(), b.to_bits()))
}
