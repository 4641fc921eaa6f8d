//! Structures found by the votes of many minimal paths (Yang & Cohen, section 4.1).
//!
//! Paths from everywhere to one source run together in the branches of a tree. Where many of them
//! pass, the geodesic density of eq. (23), there is a branch (Rouchdy & Cohen, "Geodesic voting for
//! the automatic extraction of tree structures", 2013). Here the paths begin at the front of the
//! region that heat covers, and heat flows on, or again from all that has been found, until
//! Algorithm 1 stops: [`vote`]. [`vote_by_fast_marching`] is the original, with ends at random or at
//! the border.

mod density;
mod fast_marching;
mod flow;
mod front;
mod growth;
mod options;
mod tally;

pub use density::{Counting, density};
pub use fast_marching::{Ends, FastMarchingVotingOptions, vote_by_fast_marching};
pub use front::{covered, front};
pub use growth::Growth;
pub use options::{Method, VotingOptions};

use self::tally::Tally;
use super::distance::EikonalError;
use super::heat::{Duration, Explicit, HeatError, HeatOptions};
use super::medium::Medium;
use super::{Grid, PointError, Sources};
use crate::error::{self, ParameterError};
use crate::exec::{Cancelled, Exec};
use thiserror::Error;

/// What the votes have found.
#[derive(Clone, Debug, PartialEq)]
pub struct Votes<const D: usize> {
    /// The geodesic density (eq. 23): the paths through each cell, summed up over all rounds.
    pub density: Grid<u32, D>,
    /// The cells that were kept in any round, and those of the sources.
    pub kept: Grid<bool, D>,
    /// The rounds, in their order.
    pub rounds: Vec<Round>,
    /// Why there were no more of them.
    pub stopped: Stop,
}

impl<const D: usize> Votes<D> {
    /// The cells that votes crossed or that were kept: with [`Growth`] the part of the structure that hangs
    /// together with the sources.
    #[must_use]
    pub fn crossed(&self) -> Grid<bool, D> {
        let mut crossed = self.kept.clone();
        let votes = self.density.values().iter();
        crossed.values_mut().iter_mut().zip(votes).for_each(|(cell, &votes)| *cell |= votes > 0);
        crossed
    }
}

/// What one round of votes came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Round {
    /// The cells that heat covers.
    pub covered: usize,
    /// The ends of paths: cells on the front, or with [`Growth`] of the structure.
    pub ends: usize,
    /// The largest density of this round.
    pub largest_density: u32,
    /// All cells kept up to now, with the new ones.
    pub kept: usize,
    /// The cells kept for the first time.
    pub new: usize,
}

/// Why voting stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// A larger share of the picture was kept than [`VotingOptions::largest_share`].
    LargestShare,
    /// The new cells were a smaller part of all kept ones than `settled_share` asks
    /// for.
    Settled,
    /// These were all rounds: one of [`Method::Front`], [`VotingOptions::rounds`] of the others.
    Rounds,
}

/// Why there are no votes.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum VotingError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// An end lies outside the grid or in a wall.
    #[error(transparent)]
    End(#[from] PointError),
    /// Heat cannot flow so.
    #[error(transparent)]
    Heat(#[from] HeatError),
    /// There are no distances.
    #[error(transparent)]
    Eikonal(#[from] EikonalError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Lets heat flow from `sources` in `medium` and finds the structure by votes.
///
/// Each round heat flows, paths run from the front of the region that it [covers](covered()) down
/// to the sources, and cells are kept through which more paths go than a part of the largest number
/// (eq. 23). [`VotingOptions::method`] says what heat does next. The rounds end by the two rules of
/// Algorithm 1: a large enough share of the picture is kept, or few of the kept cells are new. Walls
/// do not count as picture. With [`Growth`] the structure votes instead of the front, and the second
/// rule alone ends it.
///
/// Progress is that of the larger of two shares: of the rounds, and of the picture that may be kept
/// or, with [`Growth`], of the structure that heat has covered. The second rule may end it sooner.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::voting::{Growth, VotingOptions, vote};
/// use heatpath_core::grid::{Grid, Shape, Sources, medium};
///
/// let is_cross = |[x, y]: [usize; 2]| x.abs_diff(40) < 3 || y.abs_diff(30) < 3;
/// let image = Grid::from_fn(Shape::new([80, 60])?, |index| f64::from(u8::from(is_cross(index))));
/// let medium = medium::conductivity(&image, &[1.0], Default::default())?;
/// let sources = Sources::new(&[[40.0, 50.0]], medium.mask())?;
/// let growth = Some(Growth::new(0.5));
/// let options = VotingOptions { growth, ..VotingOptions::default() };
/// let votes = vote(&medium, &sources, &options, &Exec::single_threaded())?;
/// assert!(votes.kept[[40, 20]] && votes.kept[[20, 30]] && !votes.kept[[20, 20]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A parameter out of range, heat that cannot flow, or the caller cancelled.
pub fn vote<const D: usize>(
    medium: &Medium<D>,
    sources: &Sources<D>,
    options: &VotingOptions,
    exec: &Exec,
) -> Result<Votes<D>, VotingError> {
    options.check()?;
    let mut tally = Tally::new(medium, sources, options.growth);
    let mut explicit = Explicit::new(medium, options.heat())?.down_to(options.level());
    let steps = explicit.iterations();
    loop {
        let finished = tally.finished(options);
        let report = &mut |_| exec.report(finished);
        let heat = match options.method {
            Method::Accumulated => explicit.flow_reporting(&tally.found, report, exec)?,
            _ => {
                let duration = Duration::Iterations(steps * (tally.rounds.len() + 1));
                explicit = Explicit::new(medium, HeatOptions { duration, ..options.heat() })?
                    .down_to(options.level());
                explicit.flow_reporting(sources, report, exec)?
            }
        };
        tally.vote(&heat, options, exec)?;
        if let Some(stop) = tally.stop(options) {
            exec.report(1.0)?;
            return Ok(tally.votes(stop));
        }
    }
}

fn check_threshold(threshold: f64) -> Result<(), ParameterError> {
    error::check("threshold", threshold, (0.0..1.0).contains(&threshold), "from 0 to below 1")
}
