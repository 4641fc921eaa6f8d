//! Branches that go on to their end.

use super::search::{APART, STRAIGHT_STEP, STRETCH, Search, TIP_STEP};
use super::surroundings::Surroundings;

/// How far a branch may go on beyond its last key point without being found, in cells: no circle for
/// tips is smaller than the one, nor closer to the next than the other.
const LONGEST: f64 = APART + TIP_STEP;

/// A branch ends where its edge is nearer than this part of its radius, or than a cell less, which of
/// thin ones says more: there the edge is ahead, and not only beside.
const ROUND: f64 = 0.75;

/// The points of the straight way on from the beginning of a path to the end of its branch; empty if
/// it is there.
pub(super) fn rest<const D: usize>(search: &Search<'_, D>, path: &[[f64; D]]) -> Vec<[f64; D]> {
    let surroundings = Surroundings::new(search, path[0]);
    let depths = search.within(path, STRETCH).iter().map(|&point| surroundings.depth(point));
    let radius = depths.fold(0.0, f64::max);
    let least = (ROUND * radius).min(radius - 1.0);
    let goes_on = |&point: &[f64; D]| surroundings.depth(point) >= least;
    let most = (LONGEST / STRAIGHT_STEP) as usize;
    search.straight_on(path).take_while(goes_on).take(most).collect()
}
