//! How to run a computation: threads, progress and cancellation; never what to compute.

pub use crate::simd::SimdLevel;

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use thiserror::Error;

/// The caller asked for the computation to stop; nothing was returned.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("cancelled")]
pub struct Cancelled;

/// A thread pool could not be started.
#[derive(Debug, Error)]
#[error("could not start {threads} threads: {reason}")]
pub struct ThreadsError {
    /// The number of threads asked for.
    pub threads: usize,
    /// What was wrong with that, or what the operating system said.
    pub reason: String,
}

/// Called from time to time with the finished part (0 to 1); [`ControlFlow::Break`] cancels.
pub type Watch<'a> = dyn Fn(f64) -> ControlFlow<()> + Sync + 'a;

/// Where a computation runs and who watches it.
///
/// The threads belong to this value and end with it: a program that hosts heatpath as a library or
/// plugin keeps its own threads, and no process-wide state is changed. Results do not depend on
/// the number of threads.
pub struct Exec<'a> {
    threads: Option<Arc<Threads>>,
    simd: SimdLevel,
    watch: Option<Box<Watch<'a>>>,
}

impl<'a> Exec<'a> {
    /// The largest number of threads that can be asked for: far beyond it threads die while they
    /// start, and take the process with them.
    pub const MOST_THREADS: usize = 1024;

    /// Runs on `threads` threads of its own, at most [`Self::MOST_THREADS`]; 0 takes one per
    /// processor.
    ///
    /// # Errors
    /// There are too many, or the operating system refused to start them.
    pub fn new(threads: usize) -> Result<Self, ThreadsError> {
        if threads > Self::MOST_THREADS {
            let reason = format!("at most {} are possible", Self::MOST_THREADS);
            return Err(ThreadsError { threads, reason });
        }
        Ok(Self { threads: Some(Arc::new(Threads::start(threads)?)), ..Self::single_threaded() })
    }

    /// Runs on the calling thread alone.
    #[must_use]
    pub fn single_threaded() -> Self {
        Self { threads: None, simd: SimdLevel::best(), watch: None }
    }

    /// Uses at most the vector instructions of `level`.
    #[must_use]
    pub fn with_simd(mut self, level: SimdLevel) -> Self {
        self.simd = level.min(SimdLevel::best());
        self
    }

    /// The vector instructions in use.
    #[must_use]
    pub fn simd(&self) -> SimdLevel {
        self.simd
    }

    /// Calls `watch` with the finished part (0 to 1) every few milliseconds to seconds, always on
    /// the calling thread, and cancels when it answers [`ControlFlow::Break`].
    ///
    /// The part falls back when a computation has to begin again with a wider range of numbers.
    #[must_use]
    pub fn with_watch(mut self, watch: impl Fn(f64) -> ControlFlow<()> + Sync + 'a) -> Self {
        self.watch = Some(Box::new(watch));
        self
    }

    /// The number of threads.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.threads.as_ref().map_or(1, |threads| threads.handles.len())
    }

    /// The same threads for the part from `begin` to `end` (0 to 1) of the work: what they report is
    /// where in that part they are.
    #[must_use]
    pub fn part(&self, begin: f64, end: f64) -> Exec<'_> {
        let watch = move |finished| match self.report(begin + (end - begin) * finished) {
            Ok(()) => ControlFlow::Continue(()),
            Err(Cancelled) => ControlFlow::Break(()),
        };
        let whole = Exec { threads: self.threads.clone(), simd: self.simd, watch: None };
        whole.with_watch(watch)
    }

    /// Reports the finished part and asks whether to go on.
    pub(crate) fn report(&self, finished: f64) -> Result<(), Cancelled> {
        match self.watch.as_ref().map(|watch| watch(finished)) {
            Some(ControlFlow::Break(())) => Err(Cancelled),
            _ => Ok(()),
        }
    }

    /// Calls `work` once for each of `items`, in parallel.
    pub(crate) fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
        use rayon::prelude::*;
        match self.threads.as_ref().and_then(|threads| threads.pool.as_ref()) {
            Some(pool) => pool.install(|| items.par_iter_mut().for_each(work)),
            None => items.iter_mut().for_each(work),
        }
    }

    /// Calls `work` once for each of `items`, in parallel, with one of `scratch`, of which there must
    /// be one for each of the [`threads`](Self::threads).
    pub(crate) fn for_each_with<T: Send, S: Send>(
        &self,
        items: &mut [T],
        scratch: &[Mutex<S>],
        work: impl Fn(&mut S, &mut T) + Sync + Send,
    ) {
        self.for_each(items, |item| {
            let thread = rayon::current_thread_index().unwrap_or(0) % scratch.len();
            // A lock poisoned by a panic is met by nobody: the panic ends the whole call.
            let mut scratch = scratch[thread].lock().unwrap_or_else(PoisonError::into_inner);
            work(&mut scratch, item);
        });
    }
}

/// A thread pool that has ended when it is dropped: rayon's own only asks its threads to end, and a
/// host that unloads its plugin then would find them running.
struct Threads {
    /// Always there until it is dropped.
    pool: Option<ThreadPool>,
    handles: Vec<JoinHandle<()>>,
}

impl Threads {
    fn start(threads: usize) -> Result<Self, ThreadsError> {
        let threads = match threads {
            0 => thread::available_parallelism().map_or(1, usize::from),
            threads => threads,
        };
        let mut handles = Vec::new();
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .spawn_handler(|worker| {
                let name = format!("heatpath-{}", worker.index());
                handles.push(thread::Builder::new().name(name).spawn(|| worker.run())?);
                Ok(())
            })
            .build()
            .map_err(|error| ThreadsError { threads, reason: error.to_string() })?;
        Ok(Self { pool: Some(pool), handles })
    }
}

impl Drop for Threads {
    fn drop(&mut self) {
        drop(self.pool.take());
        for handle in self.handles.drain(..) {
            // A worker that panicked has told its caller already.
            drop(handle.join());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_parts_are_parts() {
        let told = Mutex::new(Vec::new());
        let exec = Exec::single_threaded().with_watch(|finished| {
            told.lock().unwrap().push(finished);
            if finished < 0.7 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        let half = exec.part(0.5, 1.0);
        assert_eq!(exec.report(0.25), Ok(()));
        assert_eq!(half.report(0.0), Ok(()));
        assert_eq!(half.part(0.0, 0.5).report(0.5), Ok(()));
        assert_eq!(half.part(0.5, 1.0).report(0.5), Err(Cancelled));
        assert_eq!(*told.lock().unwrap(), [0.25, 0.5, 0.625, 0.875]);
    }

    #[test]
    fn parts_run_on_the_same_threads() {
        let exec = Exec::new(3).unwrap();
        let names = |exec: &Exec| {
            let mut items = [(); 64].map(|()| None);
            exec.for_each(&mut items, |item| *item = Some(thread::current().id()));
            items.into_iter().flatten().collect::<std::collections::HashSet<_>>()
        };
        let part = exec.part(0.0, 0.5);
        assert_eq!(part.threads(), 3);
        let all: std::collections::HashSet<_> =
            names(&exec).union(&names(&part)).copied().collect();
        assert!(all.len() <= 3, "{all:?}");
        assert!(!all.contains(&thread::current().id()));
    }
}
