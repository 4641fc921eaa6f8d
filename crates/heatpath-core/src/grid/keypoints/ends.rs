//! Branches that go on to their end.

use super::search::{APART, Search, TIP_STEP};
use super::surroundings::Surroundings;

/// How far a branch may go on beyond its last key point without being found, in cells: no circle for
/// tips is smaller than the one, nor closer to the next than the other.
const LONGEST: f64 = APART + TIP_STEP;

/// The direction and the radius of a branch are those of its last cells, as many.
const STRETCH: f64 = 6.0;

/// A branch ends where its edge is nearer than this part of its radius, or than a cell less, which of
/// thin ones says more: there the edge is ahead, and not only beside.
const ROUND: f64 = 0.75;

/// The points of the straight way on from the beginning of a path to the end of its branch, half a
/// cell apart; empty if it is there.
pub(super) fn rest<const D: usize>(search: &Search<'_, D>, path: &[[f64; D]]) -> Vec<[f64; D]> {
    let end = path[0];
    let last: Vec<[f64; D]> =
        path.iter().copied().take_while(|&point| search.apart(point, end) <= STRETCH).collect();
    let far = last[last.len() - 1];
    let length = search.apart(far, end);
    let step: [f64; D] = std::array::from_fn(|axis| 0.5 * (end[axis] - far[axis]) / length);
    let surroundings = Surroundings::new(search, end);
    let radius = last.iter().map(|&point| surroundings.depth(point)).fold(0.0, f64::max);
    let least = (ROUND * radius).min(radius - 1.0);
    let next = |here: &[f64; D]| {
        let next = std::array::from_fn(|axis| here[axis] + step[axis]);
        let goes_on = search.medium.shape().contains(next)
            && search.medium.mask().segment_is_open(*here, next)
            && search.is_inside(next)
            && surroundings.depth(next) >= least;
        goes_on.then_some(next)
    };
    std::iter::successors(Some(end), next).skip(1).take((2.0 * LONGEST) as usize).collect()
}
