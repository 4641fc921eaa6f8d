//! Heat, with a progress bar and an answer to Ctrl-C.

use crate::args::{EstimatorArg, FaceMeanArg, HeatArgs, SolverArg, StepArg};
use crate::failure::Failure;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{DistanceMap, normalized, varadhan};
use heatpath_core::grid::heat::{
    Duration, Explicit, FaceMean, Heat, HeatOptions, HeatSolver, Implicit, ImplicitOptions, Step,
};
use heatpath_core::grid::medium::Medium;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// What the options of a command ask for.
pub(crate) struct Plan {
    solver: Solver,
    estimator: EstimatorArg,
    threads: usize,
}

enum Solver {
    Explicit(HeatOptions),
    Implicit(ImplicitOptions),
}

impl Plan {
    /// Refuses options that do not go together.
    pub(crate) fn new(args: &HeatArgs) -> Result<Self, Failure> {
        let solver = match args.solver {
            SolverArg::Explicit => Solver::Explicit(explicit(args)?),
            SolverArg::Implicit => Solver::Implicit(implicit(args)?),
        };
        Ok(Self { solver, estimator: args.estimator, threads: args.threads })
    }

    /// The name of the solver.
    pub(crate) fn solver(&self) -> &'static str {
        match self.solver {
            Solver::Explicit(_) => "explicit",
            Solver::Implicit(_) => "implicit",
        }
    }

    fn heat<const D: usize>(
        &self,
        medium: &Medium<D>,
        sources: &Sources<D>,
        exposure: bool,
        exec: &Exec,
    ) -> Result<Heat<D>, Failure> {
        let balanced = self.estimator == EstimatorArg::Normalized;
        match self.solver {
            Solver::Explicit(options) => {
                let explicit = Explicit::new(medium, HeatOptions { exposure, ..options })?;
                Ok(explicit.flow_from(sources, balanced, exec)?)
            }
            Solver::Implicit(options) => {
                Ok(Implicit::new(medium, options, exec)?.flow_from(sources, balanced, exec)?)
            }
        }
    }
}

fn explicit(args: &HeatArgs) -> Result<HeatOptions, Failure> {
    if args.memory.is_some() {
        return Err(Failure::usage("--memory limits implicit heat: it needs `--solver implicit`"));
    }
    let duration = match (args.iterations, args.time) {
        (Some(_), Some(_)) => {
            let message =
                "--iterations and --time cannot both be given, but with `--solver implicit`";
            return Err(Failure::usage(message));
        }
        (Some(iterations), None) => Duration::Iterations(iterations),
        (None, Some(time)) => Duration::Time(time),
        (None, None) => Duration::Usual,
    };
    let step = match args.step {
        None => Step::Usual,
        Some(StepArg::Auto) => Step::Auto,
        Some(StepArg::Fixed(step)) => Step::Fixed(step),
    };
    Ok(HeatOptions { duration, step, face_mean: face_mean(args), ..HeatOptions::default() })
}

fn implicit(args: &HeatArgs) -> Result<ImplicitOptions, Failure> {
    if args.step.is_some() {
        return Err(Failure::usage(
            "--step is for explicit heat only: a step of implicit heat is as long as --time over \
             --iterations",
        ));
    }
    let usual = ImplicitOptions::default();
    let memory_limit = match args.memory {
        None => usual.memory_limit,
        // More than there is becomes the largest number there is.
        Some(gibibytes) if gibibytes > 0.0 => (gibibytes * f64::from(1 << 30)) as usize,
        Some(gibibytes) => {
            return Err(Failure::usage(format!(
                "--memory is {gibibytes}; it must be a positive number of GiB"
            )));
        }
    };
    Ok(ImplicitOptions {
        time: args.time.unwrap_or(usual.time),
        steps: args.iterations.unwrap_or(usual.steps),
        face_mean: face_mean(args),
        memory_limit,
    })
}

fn face_mean(args: &HeatArgs) -> FaceMean {
    match args.face_mean {
        FaceMeanArg::Arithmetic => FaceMean::Arithmetic,
        FaceMeanArg::Harmonic => FaceMean::Harmonic,
    }
}

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
    plan: &Plan,
    exposure: bool,
    quiet: bool,
) -> Result<Outcome<D>, Failure> {
    let sources = Sources::new(sources, medium.mask())?;
    let bar = progress_bar(quiet);
    let interrupted = interruption();
    let exec = Exec::new(plan.threads)?.with_watch(|finished| {
        bar.set_position((finished * 1000.0) as u64);
        if interrupted.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let start = Instant::now();
    let heat = plan.heat(medium, &sources, exposure, &exec);
    bar.finish_and_clear();
    let heat = heat?;
    let heat_seconds = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let distances = match plan.estimator {
        EstimatorArg::Varadhan => varadhan(&heat),
        EstimatorArg::Normalized => normalized(&heat),
    };
    let distance_seconds = start.elapsed().as_secs_f64();
    let (threads, simd) = (exec.threads(), exec.simd().name());
    Ok(Outcome { heat, distances, heat_seconds, distance_seconds, threads, simd })
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
