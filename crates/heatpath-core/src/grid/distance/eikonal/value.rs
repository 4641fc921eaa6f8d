//! What is known of a cell.

/// What is known of a cell's distance: itself if it is final, minus itself as long as it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Value(f64);

impl Value {
    /// Not yet reached.
    pub(super) const FAR: Self = Self(f64::NEG_INFINITY);
    /// Never to be reached.
    pub(super) const WALL: Self = Self(f64::INFINITY);

    pub(super) fn known(distance: f64) -> Self {
        Self(distance.abs())
    }

    pub(super) fn trial(distance: f64) -> Self {
        Self(-distance)
    }

    #[inline]
    pub(super) fn is_known(self) -> bool {
        self.0.is_sign_positive()
    }

    #[inline]
    pub(super) fn is_trial(self, distance: f64) -> bool {
        self.0.to_bits() == (-distance).to_bits()
    }

    #[inline]
    pub(super) fn is_improved_by(self, distance: f64) -> bool {
        !self.is_known() && distance < -self.0
    }

    #[inline]
    pub(super) fn or_infinite(self) -> f64 {
        if self.is_known() { self.0 } else { f64::INFINITY }
    }
}
