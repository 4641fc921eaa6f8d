//! Heat of either kind, ready to flow from any sources.

use crate::settings::{Estimator, Method};
use crate::status::Failure;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{DistanceMap, normalized, normalized_each, varadhan};
use heatpath_core::grid::heat::{Explicit, Heat, HeatOptions, HeatSolver, Implicit};
use heatpath_core::grid::medium::Medium;

/// A medium in which heat can flow.
pub(crate) enum Prepared<const D: usize> {
    /// Checked only: what there is to prepare costs less than a step or two.
    Explicit(Medium<D>, HeatOptions),
    Implicit(Box<Implicit<'static, D>>),
}

impl<const D: usize> Prepared<D> {
    pub(crate) fn new(medium: Medium<D>, method: Method, exec: &Exec) -> Result<Self, Failure> {
        match method {
            Method::Explicit(options) => {
                Explicit::new(&medium, options)?;
                Ok(Self::Explicit(medium, options))
            }
            Method::Implicit(options) => {
                Ok(Self::Implicit(Box::new(Implicit::new(medium, options, exec)?)))
            }
        }
    }

    pub(crate) fn medium(&self) -> &Medium<D> {
        match self {
            Self::Explicit(medium, _) => medium,
            Self::Implicit(implicit) => implicit.medium(),
        }
    }

    /// How many maps are made together.
    pub(crate) fn round(&self, threads: usize) -> usize {
        match self {
            Self::Explicit(..) => 1,
            Self::Implicit(_) => 8 * threads,
        }
    }

    /// Lets heat flow from all sources together; paths need its exposure.
    pub(crate) fn flow(
        &self,
        sources: &Sources<D>,
        estimator: Estimator,
        exposure: bool,
        exec: &Exec,
    ) -> Result<Heat<D>, Failure> {
        let balanced = estimator == Estimator::Normalized;
        match self {
            Self::Explicit(medium, options) => {
                let explicit = Explicit::new(medium, HeatOptions { exposure, ..*options })?;
                Ok(explicit.flow_from(sources, balanced, exec)?)
            }
            Self::Implicit(implicit) => Ok(implicit.flow_from(sources, balanced, exec)?),
        }
    }

    /// Lets heat flow from each of several sources by itself.
    pub(crate) fn flow_each(
        &self,
        sources: &[Sources<D>],
        estimator: Estimator,
        exec: &Exec,
    ) -> Result<Vec<Heat<D>>, Failure> {
        match self {
            Self::Explicit(..) => {
                sources.iter().map(|sources| self.flow(sources, estimator, false, exec)).collect()
            }
            Self::Implicit(implicit) => Ok(implicit.flow_many(sources, exec)?),
        }
    }
}

/// Reads distances from heat.
pub(crate) fn distances<const D: usize>(heat: &Heat<D>, estimator: Estimator) -> DistanceMap<D> {
    match estimator {
        Estimator::Normalized => normalized(heat),
        Estimator::Varadhan => varadhan(heat),
    }
}

/// Reads distances from several heats.
pub(crate) fn distances_each<const D: usize>(
    heats: &[Heat<D>],
    estimator: Estimator,
    exec: &Exec,
) -> Vec<DistanceMap<D>> {
    match estimator {
        Estimator::Normalized => normalized_each(heats, exec),
        Estimator::Varadhan => heats.iter().map(varadhan).collect(),
    }
}
