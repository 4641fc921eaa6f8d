//! Telling the caller how far a computation is, and asking whether to go on.

use crate::options::hp_progress;
use crate::status::Failure;
use heatpath_core::exec::Cancelled;
use std::ffi::c_void;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

/// The caller's callback.
pub(crate) struct Progress {
    callback: hp_progress,
    user: *mut c_void,
    /// The bits of the largest number reported so far.
    furthest: AtomicU64,
}

// SAFETY: `Exec` wants a callback that could be shared, but calls it on the calling thread only.
// The pointer `user` is not followed here.
unsafe impl Sync for Progress {}

impl Progress {
    pub(crate) fn new(callback: hp_progress, user: *mut c_void) -> Self {
        Self { callback, user, furthest: AtomicU64::new(0) }
    }

    /// Reports the finished part (0 to 1). What is reported never falls, even when a stage has to
    /// begin anew.
    pub(crate) fn report(&self, finished: f64) -> ControlFlow<()> {
        let Some(callback) = self.callback else {
            return ControlFlow::Continue(());
        };
        // Numbers that are not negative are in the same order as their bits.
        let now = finished.clamp(0.0, 1.0).to_bits();
        let furthest = self.furthest.fetch_max(now, Ordering::Relaxed).max(now);
        // SAFETY: the caller promises a function that can be called with its `user` until the call
        // of the library returns.
        match unsafe { callback(f64::from_bits(furthest), self.user) } {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    }

    /// As [`report`](Self::report), as an error of the library.
    pub(crate) fn check(&self, finished: f64) -> Result<(), Failure> {
        match self.report(finished) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Cancelled.into()),
        }
    }
}
