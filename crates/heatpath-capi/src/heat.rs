//! Heat of either kind, ready to flow from any sources.

use crate::status::Failure;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{
    DistanceMap, distance_matrix, normalized, normalized_each, varadhan,
};
use heatpath_core::grid::heat::{
    Explicit, Heat, HeatOptions, HeatSolver, Implicit, ImplicitOptions,
};
use heatpath_core::grid::medium::Medium;
use std::borrow::Cow;

/// How heat flows.
#[derive(Clone, Copy)]
pub(crate) enum Solver {
    Explicit(HeatOptions),
    Implicit(ImplicitOptions),
}

/// How heat is read as distance.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Readout {
    Normalized,
    Varadhan,
}

/// A medium in which heat can flow.
pub(crate) enum PreparedHeat<'a, const D: usize> {
    /// Checked only: what there is to prepare costs less than a step or two.
    Explicit(Cow<'a, Medium<D>>, HeatOptions),
    Implicit(Box<Implicit<'a, D>>),
}

impl<'a, const D: usize> PreparedHeat<'a, D> {
    pub(crate) fn new(
        medium: Cow<'a, Medium<D>>,
        solver: Solver,
        exec: &Exec,
    ) -> Result<Self, Failure> {
        match solver {
            Solver::Explicit(options) => {
                Explicit::new(medium.as_ref(), options)?;
                Ok(Self::Explicit(medium, options))
            }
            Solver::Implicit(options) => {
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

    /// Lets heat flow from all sources together; paths need its exposure.
    pub(crate) fn flow(
        &self,
        sources: &Sources<D>,
        readout: Readout,
        exposure: bool,
        exec: &Exec,
    ) -> Result<Heat<D>, Failure> {
        let balanced = readout == Readout::Normalized;
        match self {
            Self::Explicit(medium, options) => {
                let options = HeatOptions { exposure, ..*options };
                let explicit = Explicit::new(medium.as_ref(), options)?;
                Ok(explicit.flow_from(sources, balanced, exec)?)
            }
            Self::Implicit(implicit) => Ok(implicit.flow_from(sources, balanced, exec)?),
        }
    }

    /// Lets heat flow from `sources`, all equally warm at first, and keeps its exposure.
    pub(crate) fn exposure(&self, sources: &Sources<D>, exec: &Exec) -> Result<Heat<D>, Failure> {
        self.flow(sources, Readout::Varadhan, true, exec)
    }

    /// Lets heat flow from each of several sources by itself.
    pub(crate) fn flow_each(
        &self,
        sources: &[Sources<D>],
        exec: &Exec,
    ) -> Result<Vec<Heat<D>>, Failure> {
        match self {
            Self::Explicit(medium, options) => {
                Ok(short_lived(medium, *options)?.flow_each(sources, exec)?)
            }
            Self::Implicit(implicit) => Ok(implicit.flow_each(sources, exec)?),
        }
    }

    /// The distances from each of some points to each of others.
    pub(crate) fn matrix(
        &self,
        from: &Sources<D>,
        to: &Sources<D>,
        exec: &Exec,
    ) -> Result<Vec<Vec<f64>>, Failure> {
        match self {
            Self::Explicit(medium, options) => {
                Ok(distance_matrix(&short_lived(medium, *options)?, from, to, exec)?)
            }
            Self::Implicit(implicit) => Ok(distance_matrix(implicit.as_ref(), from, to, exec)?),
        }
    }

    /// The distances from each of several sources by itself.
    pub(crate) fn distances_each(
        &self,
        sources: &[Sources<D>],
        readout: Readout,
        exec: &Exec,
    ) -> Result<Vec<DistanceMap<D>>, Failure> {
        let heats = self.flow_each(sources, exec)?;
        Ok(match readout {
            Readout::Normalized => normalized_each(&heats, exec),
            Readout::Varadhan => heats.iter().map(varadhan).collect(),
        })
    }
}

/// Heat of which only the temperature is looked at.
fn short_lived<const D: usize>(
    medium: &Medium<D>,
    options: HeatOptions,
) -> Result<Explicit<'_, D>, Failure> {
    Ok(Explicit::new(medium, HeatOptions { exposure: false, ..options })?)
}

impl Readout {
    /// Reads distances from heat.
    pub(crate) fn read<const D: usize>(self, heat: &Heat<D>) -> DistanceMap<D> {
        match self {
            Self::Normalized => normalized(heat),
            Self::Varadhan => varadhan(heat),
        }
    }
}
