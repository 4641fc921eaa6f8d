//! A long computation with a progress bar and an answer to Ctrl-C.

use crate::failure::Failure;
use heatpath_core::Exec;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::RefCell;
use std::ops::ControlFlow;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by Ctrl-C and requests to terminate.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether signals are the business of somebody else.
static GUEST: AtomicBool = AtomicBool::new(false);

type Observer = Rc<dyn Fn(f64) -> ControlFlow<()>>;

thread_local! {
    static OBSERVER: RefCell<Observer> = RefCell::new(Rc::new(|_| ControlFlow::Continue(())));
}

/// Lets `observer` know, from now on, which part of a long computation of this thread is finished, from
/// 0 to 1; [`ControlFlow::Break`] stops it.
pub fn watch(observer: impl Fn(f64) -> ControlFlow<()> + 'static) {
    OBSERVER.set(Rc::new(observer));
}

/// Leaves Ctrl-C and requests to terminate, from now on, to the program that this library is a guest of.
pub fn be_a_guest() {
    GUEST.store(true, Ordering::Relaxed);
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
    let bar = progress_bar((1000, "{percent:>3} %"), work, quiet);
    // Without a handler an interruption ends the process at once, which leaves no partial file
    // either: outputs are renamed when complete. A second handler is refused, and not needed.
    if !GUEST.load(Ordering::Relaxed) {
        drop(ctrlc::set_handler(interrupt));
    }
    let exec = Exec::new(threads)?.with_watch(|finished| {
        bar.set_position((finished * 1000.0) as u64);
        match INTERRUPTED.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => {
                // The observer may itself run something that is observed.
                let observe = OBSERVER.with_borrow(Rc::clone);
                observe(finished)
            }
        }
    });
    let computed = compute(&exec);
    bar.finish_and_clear();
    computed
}

/// A bar on standard error, up to a number that is shown in this form; indicatif shows it on terminals
/// only.
pub(crate) fn progress_bar(
    (end, form): (u64, &str),
    work: &'static str,
    quiet: bool,
) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let style = format!("{{prefix}} [{{bar:40}}] {form} {{elapsed}} (left: {{eta}})");
    let style = ProgressStyle::with_template(&style);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> ");
    ProgressBar::with_draw_target(Some(end), target).with_style(style).with_prefix(work)
}
