//! What has been found up to a round.

use super::density::votes;
use super::{Growth, Round, Stop, Votes, VotingOptions, covered, front};
use crate::exec::{Cancelled, Exec};
use crate::grid::heat::Heat;
use crate::grid::medium::Medium;
use crate::grid::path::Descent;
use crate::grid::{Grid, Sources, structure};

/// The list L of Algorithm 1, and the votes up to now.
pub(super) struct Tally<'a, const D: usize> {
    medium: &'a Medium<D>,
    /// The sources and the centres of the kept cells.
    pub(super) found: Sources<D>,
    density: Grid<u32, D>,
    kept: Grid<bool, D>,
    open: usize,
    /// The cells of the structure, with growth: where paths may begin.
    structure: Option<Vec<usize>>,
    pub(super) rounds: Vec<Round>,
}

impl<'a, const D: usize> Tally<'a, D> {
    pub(super) fn new(medium: &'a Medium<D>, sources: &Sources<D>, growth: Option<Growth>) -> Self {
        let mut kept = medium.mask().open().map(|_| false);
        sources.points().iter().for_each(|&point| kept[medium.shape().cell_at(point)] = true);
        Self {
            medium,
            found: sources.clone(),
            density: kept.map(|_| 0),
            kept,
            open: positions(medium.mask().open()).len(),
            structure: growth.map(|growth| positions(&structure(medium, growth.least_speed_sq))),
            rounds: Vec::new(),
        }
    }

    /// Votes from the ends that `heat` has come to.
    pub(super) fn vote(
        &mut self,
        heat: &Heat<D>,
        options: &VotingOptions,
        exec: &Exec,
    ) -> Result<(), Cancelled> {
        let finished = self.finished(options);
        let report = &mut |_| exec.report(finished);
        let region = covered(heat, options.level());
        report(0.0)?;
        let shape = self.medium.shape();
        let ends = match &self.structure {
            Some(cells) => cells.iter().copied().filter(|&cell| region.values()[cell]).collect(),
            None => front(&region),
        };
        let ends: Vec<_> = ends.into_iter().map(|cell| shape.centre(cell)).collect();
        let descent = Descent::new(heat, self.medium).expect("heat keeps its exposure by default");
        let counting = (options.counting(), options.growth);
        let density = votes(&descent, &ends, counting, report, exec)?;
        let covered = region.values().iter().filter(|&&is_inside| is_inside).count();
        self.count(&density, |largest| options.least_votes(largest), (covered, ends.len()));
        Ok(())
    }

    /// Keeps the cells whose density is above `least_votes` of the largest density.
    pub(super) fn count(
        &mut self,
        density: &Grid<u32, D>,
        least_votes: impl Fn(u32) -> f64,
        (covered, ends): (usize, usize),
    ) {
        let votes = density.values();
        let largest_density = votes.iter().copied().max().unwrap_or(0);
        let least = least_votes(largest_density);
        let kept = self.kept.values_mut();
        let is_new = |&cell: &usize| f64::from(votes[cell]) > least && !kept[cell];
        let new: Vec<usize> = (0..votes.len()).filter(is_new).collect();
        new.iter().for_each(|&cell| kept[cell] = true);
        self.found.extend(new.iter().map(|&cell| self.medium.shape().centre(cell)));
        self.density.values_mut().iter_mut().zip(votes).for_each(|(sum, votes)| *sum += votes);
        let kept = self.kept.values().iter().filter(|&&kept| kept).count();
        self.rounds.push(Round { covered, ends, largest_density, kept, new: new.len() });
    }

    /// Whether one of the rules of Algorithm 1 is met, or all rounds are over.
    pub(super) fn stop(&self, options: &VotingOptions) -> Option<Stop> {
        let &Round { kept, new, .. } = self.rounds.last()?;
        if options.growth.is_none() && kept as f64 > options.largest_share * self.open as f64 {
            Some(Stop::LargestShare)
        } else if (kept - new) as f64 > options.settled_share() * kept as f64 {
            Some(Stop::Settled)
        } else {
            (self.rounds.len() >= options.most_rounds()).then_some(Stop::Rounds)
        }
    }

    /// How far voting is on its way to the end that is in sight.
    pub(super) fn finished(&self, options: &VotingOptions) -> f64 {
        let Some(round) = self.rounds.last() else { return 0.0 };
        let most_ends = self.rounds.iter().map(|round| round.ends).max().unwrap_or(0);
        let rounds = self.rounds.len() as f64 / options.most_rounds() as f64;
        let share = match &self.structure {
            Some(cells) => most_ends as f64 / cells.len() as f64,
            None => round.kept as f64 / (options.largest_share * self.open as f64),
        };
        let old = (round.kept - round.new) as f64 / round.kept.max(1) as f64;
        let settled = old / options.settled_share();
        rounds.max(0.5 * (share.min(1.0) + settled.min(1.0)))
    }

    pub(super) fn votes(self, stopped: Stop) -> Votes<D> {
        Votes { density: self.density, kept: self.kept, rounds: self.rounds, stopped }
    }
}

/// The positions of the cells that are true.
pub(super) fn positions<const D: usize>(cells: &Grid<bool, D>) -> Vec<usize> {
    let cells = cells.values().iter().enumerate();
    cells.filter(|(_, is_inside)| **is_inside).map(|(cell, _)| cell).collect()
}
