//! The caller's threads, and telling the caller how far they are and asking whether to go on.

use crate::options::hp_progress;
use crate::status::Failure;
use heatpath_core::Exec;
use heatpath_core::exec::Cancelled;
use std::ffi::c_void;
use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicU64, Ordering};

/// A call of the library: its threads and the caller's callback.
pub(crate) struct Run {
    threads: usize,
    callback: hp_progress,
    user: *mut c_void,
    /// The bits of the largest number reported so far.
    furthest: AtomicU64,
}

// SAFETY: `Exec` wants a callback that could be shared, but calls it on the calling thread only.
// The pointer `user` is not followed here.
unsafe impl Sync for Run {}

impl Run {
    pub(crate) fn new(
        threads: u32,
        callback: hp_progress,
        user: *mut c_void,
    ) -> Result<Self, Failure> {
        Ok(Self { threads: check_threads(threads)?, callback, user, furthest: AtomicU64::new(0) })
    }

    /// The threads, which report how far they are.
    pub(crate) fn exec(&self) -> Result<Exec<'_>, Failure> {
        let exec = match self.threads {
            1 => Exec::single_threaded(),
            threads => Exec::new(threads)?,
        };
        Ok(exec.with_watch(|finished| self.report(finished)))
    }

    /// Reports that everything is done.
    pub(crate) fn finish(&self) -> Result<(), Failure> {
        match self.report(1.0) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Cancelled.into()),
        }
    }

    /// What is reported never falls, even when a stage has to begin anew.
    fn report(&self, finished: f64) -> ControlFlow<()> {
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
}

/// Work on `count` things, `together` at a time: the places of each round, and what it runs on.
pub(crate) fn rounds<'a>(
    exec: &'a Exec<'_>,
    count: usize,
    together: usize,
) -> impl Iterator<Item = Result<(Range<usize>, Exec<'a>), Cancelled>> {
    let share = move |done: usize| done as f64 / count as f64;
    (0..count.div_ceil(together)).map(move |round| {
        let begin = round * together;
        let places = begin..count.min(begin + together);
        let round = exec.part(share(places.start), share(places.end));
        round.report(0.0).map(|()| (places, round))
    })
}

/// The caller's number of threads, if it is possible.
fn check_threads(threads: u32) -> Result<usize, Failure> {
    let most = Exec::MOST_THREADS;
    if threads as usize <= most {
        return Ok(threads as usize);
    }
    Err(Failure::argument(format!("threads is {threads}; it must be at most {most}")))
}
