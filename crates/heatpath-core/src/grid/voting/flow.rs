//! The geodesic density without tracing every path: votes flow down.
//!
//! From the centre of a cell a path is traced for a few cells only, and goes on from the centre of
//! the cell that it comes to. So paths that come to the same cell are the same from there on, and
//! each piece is traced once, however many paths go through it. The pieces are a forest whose roots
//! are the sources' cells; votes are added up in one pass over it, from far to near.

use super::Growth;
use super::growth::step_length;
use crate::exec::{Cancelled, Exec};
use crate::grid::Grid;
use crate::grid::medium::Medium;
use crate::grid::path::{Descent, Ending, PathOptions};
use crate::grid::raster::crossed;

/// The steps of a piece.
const STEPS: usize = 8;

/// A piece of a path.
struct Piece {
    /// The cells that it enters, from the one in whose centre it begins to the next such cell.
    cells: Vec<usize>,
    /// Its length in cell units from a cell to the next, on average.
    length: f64,
    /// From which of its cells on a vote counts that has not counted before, if from any.
    begins: Option<usize>,
}

impl Piece {
    /// The piece that begins in `start`; `None` where no path does, or it finds no source.
    fn trace<const D: usize>(descent: &Descent<'_, D>, start: usize) -> Option<Self> {
        let shape = descent.medium().shape();
        let short = PathOptions { largest_steps: Some(STEPS), ..PathOptions::default() };
        let (mut points, mut ending) = descent.trace(shape.centre(start), short);
        let last = shape.position(shape.cell_at(points[points.len() - 1]));
        // Votes must not go round in circles.
        let is_lower = descent.at(last) < descent.at(start);
        if ending == Ending::StepLimit && !is_lower {
            (points, ending) = descent.trace(shape.centre(start), PathOptions::default());
        }
        if !(matches!(ending, Ending::Source(_)) || is_lower) {
            return None;
        }
        let cells = crossed(shape, &points);
        let length: f64 = points.windows(2).map(|p| step_length(shape, p[0], p[1])).sum();
        Some(Self { length: length / (cells.len() - 1).max(1) as f64, cells, begins: Some(0) })
    }

    fn start(&self) -> usize {
        self.cells[0]
    }

    fn end(&self) -> usize {
        self.cells[self.cells.len() - 1]
    }

    /// The cells in which its votes count: the last one counts at the beginning of the next piece.
    fn counting(&self) -> &[usize] {
        &self.cells[..self.cells.len() - 1]
    }

    /// Finds out where votes begin to count. Walking outwards, a path that comes to the end of this
    /// piece after so long outside of the structure has been outside for the returned length at its
    /// start; infinite where it is cut.
    fn grow<const D: usize>(&mut self, growth: &Growth, medium: &Medium<D>, outside: f64) -> f64 {
        let mut outside = outside;
        self.begins = None;
        for (number, &cell) in self.cells[..self.cells.len() - 1].iter().enumerate().rev() {
            outside += self.length;
            if outside.is_finite() && growth.is_inside(medium, cell) {
                (self.begins, outside) = (Some(number), 0.0);
            } else if outside > growth.gap {
                outside = f64::INFINITY;
            }
        }
        outside
    }
}

/// [`density`](super::density()) by [`Counting::Flow`](super::Counting::Flow), of checked ends.
pub(super) fn flow_votes<const D: usize>(
    descent: &Descent<'_, D>,
    ends: &[[f64; D]],
    growth: Option<Growth>,
    report: &mut dyn FnMut(f64) -> Result<(), Cancelled>,
    exec: &Exec,
) -> Result<Grid<u32, D>, Cancelled> {
    let shape = *descent.medium().shape();
    let ends: Vec<usize> = ends.iter().map(|&end| shape.position(shape.cell_at(end))).collect();
    let mut pieces = pieces(descent, &ends, report, exec)?;
    if let Some(growth) = growth {
        let mut outside = vec![0.0; shape.cells()];
        for piece in &mut pieces {
            outside[piece.start()] = piece.grow(&growth, descent.medium(), outside[piece.end()]);
        }
    }
    Ok(Grid::from_parts(shape, add_up(descent, &ends, &pieces)))
}

/// The pieces of all ways from `ends` to the sources, from near to far.
fn pieces<const D: usize>(
    descent: &Descent<'_, D>,
    ends: &[usize],
    report: &mut dyn FnMut(f64) -> Result<(), Cancelled>,
    exec: &Exec,
) -> Result<Vec<Piece>, Cancelled> {
    let mut is_known = vec![false; descent.medium().shape().cells()];
    descent.source_cells().for_each(|cell| is_known[cell] = true);
    let mut pieces: Vec<Piece> = Vec::new();
    let mut starts = ends.to_vec();
    loop {
        starts.retain(|&start| !std::mem::replace(&mut is_known[start], true));
        if starts.is_empty() {
            break;
        }
        report(0.0)?;
        let mut found: Vec<_> = starts.iter().map(|&start| (start, None)).collect();
        exec.for_each(&mut found, |(start, piece)| *piece = Piece::trace(descent, *start));
        let first = pieces.len();
        pieces.extend(found.into_iter().filter_map(|(_, piece)| piece));
        starts = pieces[first..].iter().map(Piece::end).collect();
    }
    let height = |piece: &Piece| descent.at(piece.start());
    pieces.sort_by(|a, b| height(a).total_cmp(&height(b)));
    // A path that reaches no source does not vote.
    let mut leads_to_source = vec![false; is_known.len()];
    descent.source_cells().for_each(|cell| leads_to_source[cell] = true);
    pieces.retain(|piece| {
        leads_to_source[piece.start()] = leads_to_source[piece.end()];
        leads_to_source[piece.end()]
    });
    Ok(pieces)
}

/// Lets the votes of `ends` flow down the `pieces`.
fn add_up<const D: usize>(descent: &Descent<'_, D>, ends: &[usize], pieces: &[Piece]) -> Vec<u32> {
    let cells = descent.medium().shape().cells();
    // The votes that come to the start of a piece and count already, and those that do not yet.
    let (mut counting, mut waiting) = (vec![0; cells], vec![0; cells]);
    ends.iter().for_each(|&end| waiting[end] += 1);
    let mut votes = vec![0; cells];
    for piece in pieces.iter().rev() {
        let mut count = std::mem::take(&mut counting[piece.start()]);
        let mut wait = std::mem::take(&mut waiting[piece.start()]);
        for (number, &cell) in piece.counting().iter().enumerate() {
            if piece.begins == Some(number) {
                count += std::mem::take(&mut wait);
            }
            votes[cell] += count;
        }
        counting[piece.end()] += count;
        waiting[piece.end()] += wait;
    }
    let mut roots: Vec<usize> = descent.source_cells().collect();
    roots.sort_unstable();
    roots.dedup();
    roots.into_iter().for_each(|root| votes[root] += counting[root] + waiting[root]);
    votes
}
