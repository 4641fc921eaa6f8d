//! Heat, as the options ask for it.

use crate::args::{AutoArg, FaceMeanArg, HeatArgs, SolverArg};
use crate::failure::Failure;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{DistanceMap, normalized, varadhan};
use heatpath_core::grid::heat::{
    Duration, Explicit, FaceMean, Heat, HeatOptions, HeatSolver, Implicit, ImplicitOptions, Step,
};
use heatpath_core::grid::medium::Medium;

/// How heat flows, and how it is read as a distance.
pub(crate) struct HeatPlan {
    solver: Solver,
    readout: Readout,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Readout {
    Varadhan,
    Normalized,
}

enum Solver {
    Explicit(HeatOptions),
    Implicit(ImplicitOptions),
}

impl HeatPlan {
    /// Refuses options that do not go together.
    pub(crate) fn new(args: &HeatArgs, readout: Readout) -> Result<Self, Failure> {
        let solver = match args.solver {
            None | Some(SolverArg::Explicit) => Solver::Explicit(explicit(args)?),
            Some(SolverArg::Implicit) => Solver::Implicit(implicit(args)?),
        };
        Ok(Self { solver, readout })
    }

    /// The name of the solver.
    pub(crate) fn solver(&self) -> &'static str {
        match self.solver {
            Solver::Explicit(_) => "explicit",
            Solver::Implicit(_) => "implicit",
        }
    }

    /// Lets heat flow; keeps its `exposure` for paths if asked to.
    pub(crate) fn flow<const D: usize>(
        &self,
        medium: &Medium<D>,
        sources: &Sources<D>,
        exposure: bool,
        exec: &Exec,
    ) -> Result<Heat<D>, Failure> {
        let balanced = self.readout == Readout::Normalized;
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

    /// Reads heat that has flowed as distances.
    pub(crate) fn read<const D: usize>(&self, heat: &Heat<D>) -> DistanceMap<D> {
        match self.readout {
            Readout::Varadhan => varadhan(heat),
            Readout::Normalized => normalized(heat),
        }
    }
}

/// The first option of heat that was given and is not among `allowed`.
pub(crate) fn given(args: &HeatArgs, allowed: &[&str]) -> Option<&'static str> {
    let options = [
        ("--solver", args.solver.is_some()),
        ("--iterations", args.iterations.is_some()),
        ("--time", args.time.is_some()),
        ("--step", args.step.is_some()),
        ("--memory", args.memory.is_some()),
        ("--face-mean", args.face_mean.is_some()),
    ];
    let mut given = options.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name);
    given.find(|name| !allowed.contains(name))
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
        Some(AutoArg::Auto) => Step::Auto,
        Some(AutoArg::Fixed(step)) => Step::Fixed(step),
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
    let memory_limit = memory_limit(args, usual.memory_limit)?;
    Ok(ImplicitOptions {
        time: args.time.unwrap_or(usual.time),
        steps: args.iterations.unwrap_or(usual.steps),
        face_mean: face_mean(args),
        memory_limit,
    })
}

/// --memory in bytes.
pub(crate) fn memory_limit(args: &HeatArgs, usual: usize) -> Result<usize, Failure> {
    match args.memory {
        None => Ok(usual),
        // More than there is becomes the largest number there is.
        Some(gibibytes) if gibibytes > 0.0 => Ok((gibibytes * f64::from(1 << 30)) as usize),
        Some(gibibytes) => Err(Failure::usage(format!(
            "--memory is {gibibytes}; it must be a positive number of GiB"
        ))),
    }
}

fn face_mean(args: &HeatArgs) -> FaceMean {
    match args.face_mean {
        Some(FaceMeanArg::Arithmetic) => FaceMean::Arithmetic,
        None | Some(FaceMeanArg::Harmonic) => FaceMean::Harmonic,
    }
}
