//! The caller's threads, and telling the caller how far they are and asking whether to go on.

use crate::options::hp_progress;
use crate::status::Failure;
use heatpath_core::Exec;
use heatpath_core::exec::Cancelled;
use std::ffi::c_void;
use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

/// A call of the library: its threads and the caller's callback.
pub(crate) struct Run {
    threads: usize,
    callback: hp_progress,
    user: *mut c_void,
    /// Where in the whole work the current part of it begins and ends.
    part: Mutex<[f64; 2]>,
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
        let (part, furthest) = (Mutex::new([0.0, 1.0]), AtomicU64::new(0));
        Ok(Self { threads: check_threads(threads)?, callback, user, part, furthest })
    }

    /// Threads that report how far they are in the current part of the work; at first that is all of it.
    pub(crate) fn exec(&self) -> Result<Exec<'_>, Failure> {
        let exec = match self.threads {
            1 => Exec::single_threaded(),
            threads => Exec::new(threads)?,
        };
        Ok(exec.with_watch(|finished| self.report(finished)))
    }

    /// Makes what follows the part from `begin` to `end` (0 to 1) of the work.
    pub(crate) fn part(&self, begin: f64, end: f64) -> Result<(), Failure> {
        *self.part.lock().unwrap_or_else(PoisonError::into_inner) = [begin, end];
        self.check(0.0)
    }

    /// Makes work on `count` things, `together` at a time, that many parts up to `end`: the places of
    /// each.
    pub(crate) fn rounds(
        &self,
        count: usize,
        together: usize,
        end: f64,
    ) -> impl Iterator<Item = Result<Range<usize>, Failure>> + '_ {
        let share = move |done: usize| end * done as f64 / count as f64;
        (0..count).step_by(together).map(move |begin| {
            let places = begin..count.min(begin + together);
            self.part(share(places.start), share(places.end)).map(|()| places)
        })
    }

    /// Reports that everything is done.
    pub(crate) fn finish(&self) -> Result<(), Failure> {
        self.part(1.0, 1.0)
    }

    /// Reports how much of the current part is finished (0 to 1), and asks whether to go on.
    pub(crate) fn check(&self, finished: f64) -> Result<(), Failure> {
        match self.report(finished) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Cancelled.into()),
        }
    }

    /// What is reported never falls, even when a stage has to begin anew.
    fn report(&self, finished: f64) -> ControlFlow<()> {
        let Some(callback) = self.callback else {
            return ControlFlow::Continue(());
        };
        let [begin, end] = *self.part.lock().unwrap_or_else(PoisonError::into_inner);
        // Numbers that are not negative are in the same order as their bits.
        let now = (begin + (end - begin) * finished).clamp(0.0, 1.0).to_bits();
        let furthest = self.furthest.fetch_max(now, Ordering::Relaxed).max(now);
        // SAFETY: the caller promises a function that can be called with its `user` until the call
        // of the library returns.
        match unsafe { callback(f64::from_bits(furthest), self.user) } {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    }
}

/// The caller's number of threads, if it is possible.
fn check_threads(threads: u32) -> Result<usize, Failure> {
    let most = Exec::MOST_THREADS;
    if threads as usize <= most {
        return Ok(threads as usize);
    }
    Err(Failure::argument(format!("threads is {threads}; it must be at most {most}")))
}
