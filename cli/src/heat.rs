//! Heat, with a progress bar and an answer to Ctrl-C.

use crate::args::{EstimatorArg, FaceMeanArg, HeatArgs, StepArg};
use crate::failure::Failure;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{DistanceMap, normalized, varadhan};
use heatpath_core::grid::heat::{Duration, Explicit, FaceMean, Heat, HeatOptions, Step};
use heatpath_core::grid::medium::Medium;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Heat that has flowed, the distances read from it, and how long both took.
pub(crate) struct Outcome<const D: usize> {
    pub(crate) heat: Heat<D>,
    pub(crate) distances: DistanceMap<D>,
    pub(crate) heat_seconds: f64,
    pub(crate) distance_seconds: f64,
    pub(crate) threads: usize,
    pub(crate) simd: &'static str,
}

/// Lets heat flow from `sources` through `medium` and reads it as distances; keeps its `exposure` for
/// paths if asked to.
pub(crate) fn flow<const D: usize>(
    medium: &Medium<D>,
    sources: &[[f64; D]],
    args: &HeatArgs,
    exposure: bool,
    quiet: bool,
) -> Result<Outcome<D>, Failure> {
    let sources = Sources::new(sources, medium.mask())?;
    let explicit = Explicit::new(medium, HeatOptions { exposure, ..options(args) })?;
    let bar = progress_bar(quiet);
    let interrupted = interruption();
    let exec = Exec::new(args.threads)?.with_watch(|finished| {
        bar.set_position((finished * 1000.0) as u64);
        if interrupted.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let start = Instant::now();
    let heat = match args.estimator {
        EstimatorArg::Varadhan => explicit.flow(&sources, &exec),
        EstimatorArg::Normalized => explicit.flow_balanced(&sources, &exec),
    };
    bar.finish_and_clear();
    let heat = heat?;
    let heat_seconds = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let distances = match args.estimator {
        EstimatorArg::Varadhan => varadhan(&heat),
        EstimatorArg::Normalized => normalized(&heat),
    };
    let distance_seconds = start.elapsed().as_secs_f64();
    let (threads, simd) = (exec.threads(), exec.simd().name());
    Ok(Outcome { heat, distances, heat_seconds, distance_seconds, threads, simd })
}

fn options(args: &HeatArgs) -> HeatOptions {
    HeatOptions {
        duration: match (args.iterations, args.time) {
            (Some(iterations), _) => Duration::Iterations(iterations),
            (None, Some(time)) => Duration::Time(time),
            (None, None) => Duration::Usual,
        },
        step: match args.step {
            None => Step::Usual,
            Some(StepArg::Auto) => Step::Auto,
            Some(StepArg::Fixed(step)) => Step::Fixed(step),
        },
        face_mean: match args.face_mean {
            FaceMeanArg::Arithmetic => FaceMean::Arithmetic,
            FaceMeanArg::Harmonic => FaceMean::Harmonic,
        },
        ..HeatOptions::default()
    }
}

/// A bar on standard error; indicatif shows it on terminals only.
fn progress_bar(quiet: bool) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let style =
        ProgressStyle::with_template("heat [{bar:40}] {percent:>3} % {elapsed} (left: {eta})");
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> ");
    ProgressBar::with_draw_target(Some(1000), target).with_style(style)
}

/// A flag that Ctrl-C and requests to terminate set.
fn interruption() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&flag);
    // Without a handler an interruption ends the process at once, which leaves no partial file
    // either: outputs are renamed when complete.
    drop(ctrlc::set_handler(move || seen.store(true, Ordering::Relaxed)));
    flag
}
