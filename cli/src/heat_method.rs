//! The heat method, as the options ask for it.

use crate::args::HeatArgs;
use crate::failure::Failure;
use crate::heat;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{DistanceMap, HeatMethod, HeatMethodOptions};
use heatpath_core::grid::medium::Medium;

/// For how long heat flows, and the memory for it.
pub(crate) struct HeatMethodPlan(HeatMethodOptions);

impl HeatMethodPlan {
    /// Refuses what only other heat has.
    pub(crate) fn new(args: &HeatArgs) -> Result<Self, Failure> {
        if let Some(option) = heat::given(args, &["--time", "--memory"]) {
            return Err(Failure::usage(format!(
                "{option} is not for `--estimator heat-method`: its heat flows in one implicit step"
            )));
        }
        let usual = HeatMethodOptions::default();
        Ok(Self(HeatMethodOptions {
            time: args.time.unwrap_or(usual.time),
            memory_limit: heat::memory_limit(args, usual.memory_limit)?,
        }))
    }

    pub(crate) fn solve<const D: usize>(
        &self,
        medium: &Medium<D>,
        sources: &Sources<D>,
        exec: &Exec,
    ) -> Result<DistanceMap<D>, Failure> {
        Ok(HeatMethod::new(medium, self.0, exec)?.distance(sources, exec)?)
    }
}
