//! Media made ready for distances from any sources, by any method.

use crate::heat::{PreparedHeat, Readout, Solver};
use crate::run::rounds;
use crate::status::{Failure, HP_PANIC};
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::distance::{
    DistanceMap, Eikonal, EikonalOptions, HeatMethod, HeatMethodOptions,
};
use heatpath_core::grid::heat::Heat;
use heatpath_core::grid::labels::{Labels, labels};
use heatpath_core::grid::medium::Medium;
use heatpath_core::grid::path::Descent;
use std::borrow::Cow;

/// How distances are found.
#[derive(Clone, Copy)]
pub(crate) enum Approach {
    Heat(Solver),
    HeatMethod(HeatMethodOptions),
    Eikonal { farthest: f64 },
}

/// A medium in which distances can be found.
pub(crate) enum Prepared<'a, const D: usize> {
    Heat(PreparedHeat<'a, D>),
    HeatMethod(Box<HeatMethod<'a, D>>),
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
        approach: Approach,
        exec: &Exec,
    ) -> Result<Self, Failure> {
        match approach {
            Approach::Heat(solver) => {
                Ok(Self::Heat(PreparedHeat::new(medium.into(), solver, exec)?))
            }
            Approach::HeatMethod(options) => {
                Ok(Self::HeatMethod(Box::new(HeatMethod::new(medium, options, exec)?)))
            }
            Approach::Eikonal { farthest } => {
                let eikonal = Box::new(Eikonal::new(medium, exec)?);
                Ok(Self::Eikonal { eikonal, farthest })
            }
        }
    }

    pub(crate) fn medium(&self) -> &Medium<D> {
        match self {
            Self::Heat(heat) => heat.medium(),
            Self::HeatMethod(method) => method.medium(),
            Self::Eikonal { eikonal, .. } => eikonal.medium(),
        }
    }

    /// How many maps are made together.
    pub(crate) fn round(&self, threads: usize) -> usize {
        match self {
            Self::Heat(PreparedHeat::Implicit(_)) | Self::HeatMethod(_) => 8 * threads,
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
            Self::HeatMethod(method) => {
                Ok(Solved { distances: method.distance(sources, exec)?, heat: None })
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

    /// What paths descend.
    pub(crate) fn descent(
        &self,
        sources: &Sources<D>,
        solved: &Solved<D>,
    ) -> Result<Descent<'_, D>, Failure> {
        match &solved.heat {
            Some(heat) => Ok(Descent::new(heat, self.medium())?),
            None => Ok(Descent::of_distances(&solved.distances, sources, self.medium())),
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
            Self::HeatMethod(method) => Ok(method.distances(sources, exec)?),
            Self::Eikonal { .. } => sources
                .iter()
                .map(|sources| Ok(self.solve(sources, &[], None, exec)?.distances))
                .collect(),
        }
    }
}

impl<const D: usize> Prepared<'_, D> {
    /// Which of the sources each cell is nearest to, with shares if heat tells, and their distances if
    /// they were found on the way.
    pub(crate) fn nearest(
        &self,
        sources: &Sources<D>,
        exec: &Exec,
    ) -> Result<(Labels<D>, Option<DistanceMap<D>>), Failure> {
        match self {
            Self::Heat(prepared) => {
                let (sets, mut heats) = (sources.each(), Vec::new());
                for round in rounds(exec, sets.len(), self.round(exec.threads())) {
                    let (places, exec) = round?;
                    heats.extend(prepared.flow_each(&sets[places], &exec)?);
                }
                // There is a heat for each source, all on one grid.
                let labels = labels(&heats).ok_or_else(|| Failure::new(HP_PANIC, "no labels"))?;
                Ok((labels, None))
            }
            Self::Eikonal { eikonal, farthest } => {
                let options = EikonalOptions { farthest: *farthest, ..EikonalOptions::default() };
                let (map, nearest) = eikonal.distance_and_nearest(sources, &options, exec)?;
                Ok((Labels { nearest, shares: Vec::new() }, Some(map)))
            }
            Self::HeatMethod(_) => Err(Failure::argument(
                "solver: labels are of heat and of HP_EIKONAL; this one was made with \
                 HP_HEAT_METHOD",
            )),
        }
    }

    /// The distances from each of some points to each of others.
    pub(crate) fn matrix(
        &self,
        from: &Sources<D>,
        to: &Sources<D>,
        readout: Option<Readout>,
        exec: &Exec,
    ) -> Result<Vec<Vec<f64>>, Failure> {
        if let (Self::Heat(heat), Some(Readout::Normalized)) = (self, readout) {
            return heat.matrix(from, to, exec);
        }
        let maps = self.solve_each(&from.each(), readout, exec)?;
        let row = |map: &DistanceMap<D>| to.points().iter().map(|&point| map.at(point)).collect();
        Ok(maps.iter().map(row).collect())
    }
}

fn needed(readout: Option<Readout>) -> Result<Readout, Failure> {
    readout.ok_or_else(|| {
        Failure::argument(
            "options: estimator is HP_EIKONAL or HP_HEAT_METHOD, but the solver was made for heat: \
             hp_solver_create() must know it",
        )
    })
}
