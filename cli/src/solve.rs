//! Distances by any method.

use crate::args::{EstimatorArg, MethodArgs};
use crate::eikonal::EikonalPlan;
use crate::failure::Failure;
use crate::heat::{HeatPlan, Readout};
use crate::heat_method::HeatMethodPlan;
use crate::run::run;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::DistanceMap;
use heatpath_core::grid::heat::Heat;
use heatpath_core::grid::medium::Medium;
use heatpath_core::grid::path::Descent;
use std::time::Instant;

/// What the options of a command ask for.
pub(crate) struct Plan {
    approach: Approach,
    /// The name of the estimator.
    pub(crate) estimator: &'static str,
    threads: usize,
}

enum Approach {
    Heat(HeatPlan),
    HeatMethod(HeatMethodPlan),
    Eikonal(EikonalPlan),
}

impl Plan {
    /// Refuses options that do not go together.
    pub(crate) fn new(args: &MethodArgs) -> Result<Self, Failure> {
        if args.farthest.is_some() && args.estimator != EstimatorArg::Eikonal {
            return Err(Failure::usage(
                "--farthest limits exact distances: it needs `--estimator eikonal`",
            ));
        }
        let heat = |readout| HeatPlan::new(&args.heat, readout).map(Approach::Heat);
        let (approach, estimator) = match args.estimator {
            EstimatorArg::Varadhan => (heat(Readout::Varadhan)?, "varadhan"),
            EstimatorArg::Normalized => (heat(Readout::Normalized)?, "normalized"),
            EstimatorArg::HeatMethod => {
                (Approach::HeatMethod(HeatMethodPlan::new(&args.heat)?), "heat-method")
            }
            EstimatorArg::Eikonal => (Approach::Eikonal(EikonalPlan::new(args)?), "eikonal"),
        };
        Ok(Self { approach, estimator, threads: args.threads })
    }

    /// The name of the solver of heat.
    pub(crate) fn solver(&self) -> Option<&'static str> {
        match &self.approach {
            Approach::Heat(plan) => Some(plan.solver()),
            Approach::HeatMethod(_) | Approach::Eikonal(_) => None,
        }
    }

    /// Whether heat flows.
    pub(crate) fn has_heat(&self) -> bool {
        !matches!(self.approach, Approach::Eikonal(_))
    }

    /// Why an end was not reached.
    pub(crate) fn not_reached(&self) -> &'static str {
        match self.approach {
            Approach::Heat(_) => "no heat has arrived there; use more --iterations",
            Approach::HeatMethod(_) => "no heat has arrived there",
            Approach::Eikonal(_) => "it lies beyond --farthest",
        }
    }

    /// What takes the time.
    fn work(&self) -> &'static str {
        match self.approach {
            Approach::Heat(_) => "heat",
            Approach::HeatMethod(_) => "heat method",
            Approach::Eikonal(_) => "fast marching",
        }
    }
}

impl Approach {
    fn solve<const D: usize>(
        &self,
        medium: &Medium<D>,
        sources: &Sources<D>,
        ends: &[[f64; D]],
        exec: &Exec,
    ) -> Result<Solution<D>, Failure> {
        match self {
            Self::Heat(plan) => {
                let start = Instant::now();
                let heat = plan.flow(medium, sources, !ends.is_empty(), exec)?;
                let heat_seconds = start.elapsed().as_secs_f64();
                Ok(Solution { distances: plan.read(&heat), heat: Some(heat), heat_seconds })
            }
            Self::HeatMethod(plan) => {
                let distances = plan.solve(medium, sources, exec)?;
                Ok(Solution { distances, heat: None, heat_seconds: 0.0 })
            }
            Self::Eikonal(plan) => {
                let distances = plan.march(medium, sources, ends, exec)?;
                Ok(Solution { distances, heat: None, heat_seconds: 0.0 })
            }
        }
    }
}

/// What a method finds.
struct Solution<const D: usize> {
    heat: Option<Heat<D>>,
    distances: DistanceMap<D>,
    heat_seconds: f64,
}

/// Distances, and how long they took.
pub(crate) struct Outcome<'a, const D: usize> {
    medium: &'a Medium<D>,
    sources: Sources<D>,
    /// What the distances were read from, if they were.
    pub(crate) heat: Option<Heat<D>>,
    pub(crate) distances: DistanceMap<D>,
    /// 0 if there is no heat.
    pub(crate) heat_seconds: f64,
    pub(crate) distance_seconds: f64,
    pub(crate) threads: usize,
    pub(crate) simd: &'static str,
}

impl<'a, const D: usize> Outcome<'a, D> {
    /// What paths descend.
    pub(crate) fn descent(&self) -> Result<Descent<'a, D>, Failure> {
        match &self.heat {
            Some(heat) => Ok(Descent::new(heat, self.medium)?),
            None => Ok(Descent::of_distances(&self.distances, &self.sources, self.medium)),
        }
    }
}

/// Finds the distances from `sources` in `medium`: all of them or, if there are `ends`, at least
/// those that paths from there need.
pub(crate) fn solve<'a, const D: usize>(
    medium: &'a Medium<D>,
    sources: &[[f64; D]],
    ends: &[[f64; D]],
    plan: &Plan,
    quiet: bool,
) -> Result<Outcome<'a, D>, Failure> {
    let sources = Sources::new(sources, medium.mask())?;
    run(plan.work(), (plan.threads, quiet), |exec| {
        let start = Instant::now();
        let solution = plan.approach.solve(medium, &sources, ends, exec)?;
        let Solution { heat, distances, heat_seconds } = solution;
        let distance_seconds = start.elapsed().as_secs_f64() - heat_seconds;
        let (threads, simd) = (exec.threads(), exec.simd().name());
        Ok(Outcome {
            medium,
            sources: sources.clone(),
            heat,
            distances,
            heat_seconds,
            distance_seconds,
            threads,
            simd,
        })
    })
}
