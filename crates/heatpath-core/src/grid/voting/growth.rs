//! Growth that stops at the structure's edge.

use crate::error::{ParameterError, check, check_positive};
use crate::grid::Shape;
use crate::grid::medium::Medium;

/// Votes of the structure, which is where the medium is fast, instead of the front's.
///
/// Paths begin in all cells of the structure that heat covers, so that the votes of a cell are the
/// cells of the structure that lie beyond it, whatever holes and loops there are. A path votes only
/// with its part from the source to where it leaves the structure for good: walking outwards from
/// the source, it is cut at the first stretch outside of the structure that is longer than the gap; a
/// stretch outside at its end is cut off too. The source itself counts as inside.
///
/// Without it the paper's rules alone run on into the background once all branches are found. On
/// the generated tree of [`VotingOptions::level`](field@super::VotingOptions::level) accumulated votes
/// have a recall of 0.97 and a precision of 0.48 and 0.50. With growth both are at least 0.97, for
/// gaps of 2, 5 and 8 alike, in the conductivity of eq. (6) for a least squared speed of 0.1 to 0.6
/// and in vesselness for 0.005 to 0.15; for 0.3 the recall there is 0.94. Votes of the front, cut at
/// the structure's edge, had a precision there of 0.65 for 0.005, 0.81 for 0.05 and 0.996 for 0.15.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// The squared speed ([`Medium::speed_sq`]) from which on a cell belongs to the structure.
    /// Positive.
    pub least_speed_sq: f64,
    /// The longest way outside of the structure that a path may bridge, in cell units (multiples of
    /// the smallest spacing). From 0.
    pub gap: f64,
    /// A cell is kept whose density is above this: if at least so many cells of the structure lie
    /// beyond it.
    pub least_votes: u32,
}

impl Growth {
    /// Growth in cells of at least this squared speed, across gaps of 6 cells, where at least 10
    /// cells lie beyond.
    #[must_use]
    pub const fn new(least_speed_sq: f64) -> Self {
        Self { least_speed_sq, gap: 6.0, least_votes: 10 }
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        check_positive("least_speed_sq", self.least_speed_sq)?;
        check("gap", self.gap, self.gap >= 0.0, "a length from 0")
    }

    pub(super) fn is_inside<const D: usize>(&self, medium: &Medium<D>, cell: usize) -> bool {
        medium.speed_sq(cell) >= self.least_speed_sq
    }

    /// The number of points, from the last one backwards, with which a path votes.
    pub(super) fn voting_points<const D: usize>(
        &self,
        medium: &Medium<D>,
        points: &[[f64; D]],
    ) -> usize {
        let shape = medium.shape();
        let (mut voting, mut outside) = (1, 0.0);
        for (number, pair) in points.windows(2).rev().enumerate() {
            outside += step_length(shape, pair[0], pair[1]);
            if self.is_inside(medium, shape.position(shape.cell_at(pair[0]))) {
                (voting, outside) = (number + 2, 0.0);
            } else if outside > self.gap {
                break;
            }
        }
        voting
    }
}

/// The length of a step in cell units.
pub(super) fn step_length<const D: usize>(shape: &Shape<D>, from: [f64; D], to: [f64; D]) -> f64 {
    shape.physical_distance(from, to) / shape.smallest_spacing()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;
    use crate::grid::medium::{self, Form};

    #[test]
    fn a_path_is_cut_where_it_leaves_the_structure_for_good() {
        let shape = Shape::with_spacing([12, 1], [2.0, 2.0]).unwrap();
        let inside = [1, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 0];
        let speed_sq = Grid::from_fn(shape, |[x, _]| if inside[x] == 1 { 0.5 } else { 0.1 });
        let medium = medium::given(speed_sq, Form::Pointwise).unwrap();
        let points: Vec<[f64; 2]> = (0..12).rev().map(|x| [f64::from(x), 0.0]).collect();
        let growth = |least_speed_sq, gap| Growth { gap, ..Growth::new(least_speed_sq) };
        let voting = |gap| growth(0.5, gap).voting_points(&medium, &points);
        assert_eq!([0.0, 1.9, 2.0, 2.9, 3.0, 99.0].map(voting), [3, 3, 7, 7, 11, 11]);
        assert_eq!(growth(0.6, 99.0).voting_points(&medium, &points), 1, "the source alone");
    }
}
