//! Votes as they were: minimal paths by fast marching (Rouchdy & Cohen 2013, the paper's [29]).

use super::density::votes;
use super::tally::{Tally, positions};
use super::{Counting, Stop, Votes, VotingError, check_threshold, front};
use crate::error::check;
use crate::exec::Exec;
use crate::grid::Sources;
use crate::grid::distance::{Eikonal, EikonalOptions};
use crate::grid::medium::Medium;
use crate::grid::path::Descent;

/// Where the paths begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// At cells drawn at random from all open ones, with equal chances; the same seed draws the
    /// same cells.
    Random {
        /// How many, at least 1; the paper draws 500.
        count: usize,
        /// Any number.
        seed: u64,
    },
    /// At each open cell on the border of the picture or of what is open in it.
    Border,
}

impl Default for Ends {
    fn default() -> Self {
        Self::Random { count: 500, seed: 1 }
    }
}

/// The parameters of [`vote_by_fast_marching`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FastMarchingVotingOptions {
    /// Where the paths begin; default 500 random cells.
    pub ends: Ends,
    /// Cells are kept whose density is above this part of the largest one. From 0 to below 1;
    /// default 1/30.
    pub threshold: f64,
    /// How paths are counted.
    pub counting: Counting,
}

impl Default for FastMarchingVotingOptions {
    fn default() -> Self {
        let (ends, counting) = (Ends::default(), Counting::default());
        Self { ends, threshold: 1.0 / 30.0, counting }
    }
}

/// Geodesic voting by fast marching: paths from all over the picture down the exact distance to
/// `sources`, and the cells through which most of them go (Rouchdy & Cohen 2013). The baseline of
/// the paper's Figures 16 to 18, in one round.
///
/// # Errors
/// A parameter out of range, a grid too large for fast marching, or the caller cancelled.
pub fn vote_by_fast_marching<const D: usize>(
    medium: &Medium<D>,
    sources: &Sources<D>,
    options: &FastMarchingVotingOptions,
    exec: &Exec,
) -> Result<Votes<D>, VotingError> {
    let &FastMarchingVotingOptions { ends, threshold, counting } = options;
    check_threshold(threshold)?;
    let cells = cells(ends, medium)?;
    let eikonal = Eikonal::new(medium, exec)?;
    let distances =
        eikonal.distance(sources, &EikonalOptions::default(), &exec.part(0.0, DISTANCE_END))?;
    let descent = Descent::of_distances(&distances, sources, medium);
    let ends: Vec<_> = cells.into_iter().map(|cell| medium.shape().centre(cell)).collect();
    let exec = exec.part(DISTANCE_END, 1.0);
    let report = &mut |finished| exec.report(finished);
    let density = votes(&descent, &ends, (counting, None), report, &exec)?;
    let mut tally = Tally::new(medium, sources, None);
    let least_votes = |largest| threshold * f64::from(largest);
    tally.count(&density, least_votes, (distances.reached().count(), ends.len()));
    Ok(tally.votes(Stop::Rounds))
}

/// Where the distances end in the progress.
const DISTANCE_END: f64 = 0.7;

/// The cells at which the paths begin.
fn cells<const D: usize>(ends: Ends, medium: &Medium<D>) -> Result<Vec<usize>, VotingError> {
    let open = medium.mask().open();
    match ends {
        Ends::Border => Ok(front(open)),
        Ends::Random { count, seed } => {
            check("count", count as f64, count > 0, "at least 1")?;
            let open = positions(open);
            let mut random = SplitMix(seed);
            Ok((0..count).map(|_| open[random.below(open.len())]).collect())
        }
    }
}

/// Random numbers (Steele, Lea & Flood, "Fast splittable pseudorandom number generators", 2014).
struct SplitMix(u64);

impl SplitMix {
    /// A whole number below `end`.
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((u128::from(z ^ z >> 31) * end as u128) >> 64) as usize
    }
}
