//! Exact distances, as the options ask for them.

use crate::args::MethodArgs;
use crate::failure::Failure;
use crate::heat;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{DistanceMap, Eikonal, EikonalOptions};
use heatpath_core::grid::medium::Medium;

/// How far the distances go.
pub(crate) struct EikonalPlan {
    farthest: f64,
}

impl EikonalPlan {
    /// Refuses what only heat has.
    pub(crate) fn new(args: &MethodArgs) -> Result<Self, Failure> {
        if let Some(option) = heat::given(&args.heat, &[]) {
            return Err(Failure::usage(format!(
                "{option} is for heat only: `--estimator eikonal` finds distances without it"
            )));
        }
        match args.farthest {
            None => Ok(Self { farthest: f64::INFINITY }),
            Some(farthest) if farthest > 0.0 => Ok(Self { farthest }),
            Some(farthest) => Err(Failure::usage(format!(
                "--farthest is {farthest}; it must be a positive distance"
            ))),
        }
    }

    /// Marches through `medium`, if `ends` are given only until their distances are known.
    pub(crate) fn march<const D: usize>(
        &self,
        medium: &Medium<D>,
        sources: &Sources<D>,
        ends: &[[f64; D]],
        exec: &Exec,
    ) -> Result<DistanceMap<D>, Failure> {
        let options = EikonalOptions {
            farthest: self.farthest,
            targets: ends.to_vec(),
            ..EikonalOptions::default()
        };
        Ok(Eikonal::new(medium, exec)?.distance(sources, &options, exec)?)
    }
}
