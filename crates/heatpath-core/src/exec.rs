//! How to run a computation: threads, progress and cancellation; never what to compute.

pub use crate::simd::SimdLevel;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::{self, JoinHandle};
use thiserror::Error;

/// The caller asked for the computation to stop; nothing was returned.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("cancelled")]
pub struct Cancelled;

/// More threads were asked for than are possible.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("could not start {threads} threads: at most {} are possible", Exec::MOST_THREADS)]
pub struct ThreadsError {
    /// The number of threads asked for.
    pub threads: usize,
}

/// Called from time to time with the finished part (0 to 1); [`ControlFlow::Break`] cancels.
pub type Watch<'a> = dyn Fn(f64) -> ControlFlow<()> + Sync + 'a;

/// Where a computation runs and who watches it.
///
/// The threads belong to this value and end with it: a program that hosts heatpath as a library or
/// plugin keeps its own threads, and no process-wide state is changed. They start when there is work
/// for two of them; where the operating system refuses to start them, the calling thread works alone.
/// Results do not depend on the number of threads.
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
    /// There are too many.
    pub fn new(threads: usize) -> Result<Self, ThreadsError> {
        let count = match threads {
            0 => processors(),
            1..=Self::MOST_THREADS => threads,
            _ => return Err(ThreadsError { threads }),
        };
        let threads = Threads { count, pool: OnceLock::new() };
        Ok(Self { threads: Some(Arc::new(threads)), ..Self::single_threaded() })
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
        self.threads.as_ref().map_or(1, |threads| threads.count)
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

    /// The part of piece `number` (from 0) of `count` equal ones.
    #[must_use]
    pub fn piece(&self, number: usize, count: usize) -> Exec<'_> {
        self.part(number as f64 / count as f64, (number + 1) as f64 / count as f64)
    }

    /// Reports the finished part (0 to 1) and asks whether to go on.
    ///
    /// # Errors
    /// Whoever watches wants the work to stop.
    pub fn report(&self, finished: f64) -> Result<(), Cancelled> {
        match self.watch.as_ref().map(|watch| watch(finished)) {
            Some(ControlFlow::Break(())) => Err(Cancelled),
            _ => Ok(()),
        }
    }

    /// Calls `work` once for each of `items`, in parallel.
    pub(crate) fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
        use rayon::prelude::*;
        let threads = self.threads.as_ref().filter(|threads| threads.count > 1 && items.len() > 1);
        match threads.and_then(|threads| threads.pool()) {
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

/// How many processors there are; asking costs as much as a small computation.
fn processors() -> usize {
    static PROCESSORS: OnceLock<usize> = OnceLock::new();
    *PROCESSORS.get_or_init(|| thread::available_parallelism().map_or(1, usize::from))
}

/// So many threads, which start when there is work for two of them.
struct Threads {
    count: usize,
    /// `None` if the operating system refused to start them.
    pool: OnceLock<Option<Pool>>,
}

impl Threads {
    fn pool(&self) -> Option<&ThreadPool> {
        let pool = self.pool.get_or_init(|| Pool::start(self.count).ok());
        pool.as_ref().and_then(|pool| pool.pool.as_ref())
    }
}

/// A thread pool that has ended when it is dropped: rayon's own only asks its threads to end, and a
/// host that unloads its plugin then would find them running.
struct Pool {
    /// Always there until it is dropped.
    pool: Option<ThreadPool>,
    handles: Vec<JoinHandle<()>>,
}

impl Pool {
    fn start(threads: usize) -> Result<Self, ThreadPoolBuildError> {
        let mut handles = Vec::new();
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .spawn_handler(|worker| {
                let name = format!("heatpath-{}", worker.index());
                handles.push(thread::Builder::new().name(name).spawn(|| worker.run())?);
                Ok(())
            })
            .build()?;
        Ok(Self { pool: Some(pool), handles })
    }
}

impl Drop for Pool {
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
    fn threads_start_when_there_is_work_for_two() {
        let (exec, here) = (Exec::new(2).unwrap(), thread::current().id());
        exec.for_each(&mut [()], |()| assert_eq!(thread::current().id(), here));
        let has_started = || exec.threads.as_ref().unwrap().pool.get().is_some();
        assert!(exec.threads() == 2 && !has_started());
        exec.for_each(&mut [(), ()], |()| assert_ne!(thread::current().id(), here));
        assert!(has_started());
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
