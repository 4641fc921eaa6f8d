//! The geodesic density without tracing: votes flow down.
//!
//! From each cell one goes to the next on the way down, so the cells are a forest whose roots are
//! the sources' cells. Each cell on the way of an end is asked for the next one once, however many
//! ways go through it; then the votes are added up in one pass from far to near.

use super::Growth;
use super::growth::step_length;
use crate::grid::Grid;
use crate::grid::path::Descent;

/// The ways down from all ends to the sources.
struct Forest {
    /// The cells on the ways, each behind the next one on its own way.
    near_to_far: Vec<usize>,
    /// The next cell of each cell, itself at a source; or [`NOT_MET`] or [`LOST`].
    next: Vec<usize>,
}

/// Of a cell on no way.
const NOT_MET: usize = usize::MAX;

/// Of a cell whose way ends at no source.
const LOST: usize = usize::MAX - 1;

impl Forest {
    fn new<const D: usize>(descent: &Descent<'_, D>, ends: &[usize]) -> Self {
        let cells = descent.medium().shape().cells();
        let mut forest = Self { near_to_far: Vec::new(), next: vec![NOT_MET; cells] };
        ends.iter().for_each(|&end| forest.add(descent, end));
        forest
    }

    /// Adds the way down from `end` as far as it is new.
    fn add<const D: usize>(&mut self, descent: &Descent<'_, D>, end: usize) {
        let mut way = Vec::new();
        let mut here = end;
        while self.next[here] == NOT_MET {
            let next = descent.next_cell(here).unwrap_or(LOST);
            self.next[here] = next;
            way.push(here);
            if next == LOST || next == here {
                break;
            }
            here = next;
        }
        if self.next[here] == LOST {
            way.iter().for_each(|&cell| self.next[cell] = LOST);
        } else {
            self.near_to_far.extend(way.iter().rev());
        }
    }
}

/// The votes of ways instead of paths.
pub(super) fn flow_votes<const D: usize>(
    descent: &Descent<'_, D>,
    ends: &[[f64; D]],
    growth: Option<Growth>,
) -> Grid<u32, D> {
    let shape = *descent.medium().shape();
    let ends: Vec<usize> = ends.iter().map(|&end| shape.position(shape.cell_at(end))).collect();
    let forest = Forest::new(descent, &ends);
    let mut waiting = vec![0; shape.cells()];
    ends.iter().for_each(|&end| waiting[end] += 1);
    let votes_here = where_votes_count(descent, &forest, growth);
    let mut votes = vec![0; shape.cells()];
    for (&cell, counts) in forest.near_to_far.iter().zip(votes_here).rev() {
        // A vote waits until it comes to where it counts, and counts all the way from there.
        if counts {
            votes[cell] += std::mem::take(&mut waiting[cell]);
        }
        let next = forest.next[cell];
        if next != cell {
            votes[next] += votes[cell];
            waiting[next] += std::mem::take(&mut waiting[cell]);
        }
    }
    Grid::from_parts(shape, votes)
}

/// Of each cell from near to far: whether a vote that comes there begins to count.
fn where_votes_count<const D: usize>(
    descent: &Descent<'_, D>,
    forest: &Forest,
    growth: Option<Growth>,
) -> Vec<bool> {
    let Some(growth) = growth else {
        return vec![true; forest.near_to_far.len()];
    };
    let medium = descent.medium();
    let shape = medium.shape();
    // How far outside of the structure the way has been for; infinite where it is cut.
    let mut outside = vec![0.0; shape.cells()];
    let counts = forest.near_to_far.iter().map(|&cell| {
        let next = forest.next[cell];
        if next == cell {
            return true;
        }
        let length = outside[next] + step_length(shape, shape.centre(cell), shape.centre(next));
        let is_inside = growth.is_inside(medium, cell) && length.is_finite();
        let is_cut = length > growth.gap;
        outside[cell] = if is_inside { 0.0 } else if is_cut { f64::INFINITY } else { length };
        is_inside
    });
    counts.collect()
}
