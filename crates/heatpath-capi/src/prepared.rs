//! Media made ready for distances from any sources, by any method.

use crate::heat::{PreparedHeat, Readout, Solver};
use crate::status::Failure;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{DistanceMap, Eikonal, EikonalOptions};
use heatpath_core::grid::heat::Heat;
use heatpath_core::grid::medium::Medium;
use std::borrow::Cow;

/// How distances are found.
#[derive(Clone, Copy)]
pub(crate) enum Method {
    Heat(Solver),
    Eikonal { farthest: f64 },
}

/// A medium in which distances can be found.
pub(crate) enum Prepared<'a, const D: usize> {
    Heat(PreparedHeat<'a, D>),
    Eikonal { eikonal: Box<Eikonal<'a, D>>, farthest: f64 },
}

/// Distances, and the heat that they were read from, if they were.
pub(crate) struct Solved<const D: usize> {
    pub(crate) heat: Option<Heat<D>>,
    pub(crate) distances: DistanceMap<D>,
}

impl<'a, const D: usize> Prepared<'a, D> {
    pub(crate) fn new(
        medium: impl Into<Cow<'a, Medium<D>>>,
        method: Method,
        exec: &Exec,
    ) -> Result<Self, Failure> {
        match method {
            Method::Heat(solver) => Ok(Self::Heat(PreparedHeat::new(medium.into(), solver, exec)?)),
            Method::Eikonal { farthest } => {
                let eikonal = Box::new(Eikonal::new(medium, exec)?);
                Ok(Self::Eikonal { eikonal, farthest })
            }
        }
    }

    pub(crate) fn medium(&self) -> &Medium<D> {
        match self {
            Self::Heat(heat) => heat.medium(),
            Self::Eikonal { eikonal, .. } => eikonal.medium(),
        }
    }

    /// How many maps are made together.
    pub(crate) fn round(&self, threads: usize) -> usize {
        match self {
            Self::Heat(PreparedHeat::Implicit(_)) => 8 * threads,
            Self::Heat(PreparedHeat::Explicit(..)) | Self::Eikonal { .. } => 1,
        }
    }

    /// The distances from the nearest of the sources: all of them or, if there are `ends`, at least
    /// those that paths from there need. A `readout` is needed for heat only.
    pub(crate) fn solve(
        &self,
        sources: &Sources<D>,
        ends: &[[f64; D]],
        readout: Option<Readout>,
        exec: &Exec,
    ) -> Result<Solved<D>, Failure> {
        match self {
            Self::Heat(prepared) => {
                let readout = needed(readout)?;
                let heat = prepared.flow(sources, readout, !ends.is_empty(), exec)?;
                Ok(Solved { distances: readout.read(&heat), heat: Some(heat) })
            }
            Self::Eikonal { eikonal, farthest } => {
                let options = EikonalOptions {
                    farthest: *farthest,
                    targets: ends.to_vec(),
                    ..EikonalOptions::default()
                };
                let distances = eikonal.distance(sources, &options, exec)?;
                Ok(Solved { distances, heat: None })
            }
        }
    }

    /// The distances from each of several sources by itself.
    pub(crate) fn solve_each(
        &self,
        sources: &[Sources<D>],
        readout: Option<Readout>,
        exec: &Exec,
    ) -> Result<Vec<DistanceMap<D>>, Failure> {
        match self {
            Self::Heat(prepared) => prepared.distances_each(sources, needed(readout)?, exec),
            Self::Eikonal { .. } => sources
                .iter()
                .map(|sources| Ok(self.solve(sources, &[], None, exec)?.distances))
                .collect(),
        }
    }
}

fn needed(readout: Option<Readout>) -> Result<Readout, Failure> {
    readout.ok_or_else(|| {
        Failure::argument(
            "options: estimator is HP_EIKONAL, but the solver was made for heat: \
             hp_solver_create() must know it",
        )
    })
}
