//! A long computation with a progress bar and an answer to Ctrl-C.

use crate::failure::Failure;
use heatpath_core::Exec;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by Ctrl-C and requests to terminate.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Is told how far the work is.
static OBSERVER: OnceLock<fn(f64)> = OnceLock::new();

/// Lets `observer` know, from now on, which part of a long computation is finished, from 0 to 1. The
/// first observer stays.
pub fn watch(observer: fn(f64)) {
    OBSERVER.get_or_init(|| observer);
}

/// As Ctrl-C does.
pub(crate) fn interrupt() {
    INTERRUPTED.store(true, Ordering::Relaxed);
}

/// Runs `compute` on `threads` threads (0: one a processor) under a bar that is called after the
/// `work`.
pub(crate) fn run<T>(
    work: &'static str,
    (threads, quiet): (usize, bool),
    compute: impl FnOnce(&Exec) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let bar = progress_bar(work, quiet);
    // Without a handler an interruption ends the process at once, which leaves no partial file
    // either: outputs are renamed when complete. A second handler is refused, and not needed.
    drop(ctrlc::set_handler(interrupt));
    let exec = Exec::new(threads)?.with_watch(|finished| {
        bar.set_position((finished * 1000.0) as u64);
        if let Some(observe) = OBSERVER.get() {
            observe(finished);
        }
        if INTERRUPTED.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let computed = compute(&exec);
    bar.finish_and_clear();
    computed
}

/// A bar on standard error; indicatif shows it on terminals only.
fn progress_bar(work: &'static str, quiet: bool) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let style =
        ProgressStyle::with_template("{prefix} [{bar:40}] {percent:>3} % {elapsed} (left: {eta})");
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> ");
    ProgressBar::with_draw_target(Some(1000), target).with_style(style).with_prefix(work)
}
