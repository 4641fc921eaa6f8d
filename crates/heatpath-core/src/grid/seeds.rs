//! Where automatic extraction begins: one seed in each piece of the structure.

use super::medium::Medium;
use super::{Grid, Shape, structure};

/// One point in each piece of the structure, that of the longest piece first.
///
/// Cells of the [`structure`](super::structure()) that touch, also by a corner, are one piece. A piece counts if the diagonal of the box around it is at least
/// `least_extent` in cell units (multiples of the smallest spacing): noise makes short pieces, vessels
/// long ones. The point is the piece's fastest cell, of several equally fast ones the first in memory.
///
/// ```
/// use heatpath_core::grid::medium::{Form, given};
/// use heatpath_core::grid::{Grid, Shape, seeds};
///
/// // Two lines and a spot.
/// let speed_sq = Grid::from_fn(Shape::new([60, 40])?, |[x, y]| match (x, y) {
///     (_, 10) | (20..40, 30) | (50, 35) => 1.0 - 1e-3 * (x as f64 - 25.0).abs(),
///     _ => 1e-3,
/// });
/// let seeds = seeds(&given(speed_sq, Form::Pointwise)?, 0.5, 10.0);
/// assert_eq!(seeds, [[25.0, 10.0], [25.0, 30.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn seeds<const D: usize>(
    medium: &Medium<D>,
    least_speed_sq: f64,
    least_extent: f64,
) -> Vec<[f64; D]> {
    let rank = |cell: usize| (medium.speed_sq(cell), std::cmp::Reverse(cell));
    let fastest = |piece: &Vec<usize>| {
        piece.iter().copied().reduce(|best, cell| if rank(cell) > rank(best) { cell } else { best })
    };
    let pieces = long_pieces(medium, least_speed_sq, least_extent);
    pieces.iter().filter_map(fastest).map(|cell| medium.shape().centre(cell)).collect()
}

/// The cells of each piece of the structure whose extent is at least `least_extent`, the longest
/// piece first.
pub(super) fn long_pieces<const D: usize>(
    medium: &Medium<D>,
    least_speed_sq: f64,
    least_extent: f64,
) -> Vec<Vec<usize>> {
    let shape = medium.shape();
    let mut waiting = structure(medium, least_speed_sq);
    let mut pieces = Vec::new();
    for first in 0..shape.cells() {
        if waiting.values()[first] {
            let piece = piece_around(first, &mut waiting);
            let extent = extent(&piece, shape);
            if extent >= least_extent {
                pieces.push((extent, piece));
            }
        }
    }
    pieces.sort_by(|a, b| b.0.total_cmp(&a.0));
    pieces.into_iter().map(|(_, piece)| piece).collect()
}

/// The piece of `waiting` cells around one of them, which are then waiting no more.
fn piece_around<const D: usize>(first: usize, waiting: &mut Grid<bool, D>) -> Vec<usize> {
    let shape = *waiting.shape();
    waiting.values_mut()[first] = false;
    let (mut piece, mut next) = (vec![first], 0);
    while let Some(&cell) = piece.get(next) {
        next += 1;
        let around = shape.box_around(cell, 1);
        piece.extend(around.filter(|&near| std::mem::take(&mut waiting.values_mut()[near])));
    }
    piece
}

/// The diagonal of the box around a piece, in cell units.
fn extent<const D: usize>(piece: &[usize], shape: &Shape<D>) -> f64 {
    let (mut low, mut high) = ([usize::MAX; D], [0; D]);
    for index in piece.iter().map(|&cell| shape.index(cell)) {
        low = std::array::from_fn(|axis| low[axis].min(index[axis]));
        high = std::array::from_fn(|axis| high[axis].max(index[axis]));
    }
    let corner = |index: [usize; D]| index.map(|i| i as f64);
    shape.physical_distance(corner(low), corner(high)) / shape.smallest_spacing()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Mask;
    use crate::grid::medium::{Form, given};

    fn medium(spacing: [f64; 2], rows: &[&str]) -> Medium<2> {
        let shape = Shape::with_spacing([rows[0].len(), rows.len()], spacing).unwrap();
        let speed = |[x, y]: [usize; 2]| f64::from(rows[y].as_bytes()[x] - b'0').max(0.5);
        given(Grid::from_fn(shape, speed), Form::Pointwise).unwrap()
    }

    #[test]
    fn pieces_touch_at_corners_and_are_ordered_by_their_extent() {
        let medium = medium([1.0; 2], &["2000000", "0300022", "0022000", "0000000", "5000000"]);
        assert_eq!(seeds(&medium, 2.0, 0.0), [[1.0, 1.0], [5.0, 1.0], [0.0, 4.0]]);
        assert_eq!(seeds(&medium, 2.0, 1.0), [[1.0, 1.0], [5.0, 1.0]]);
        assert_eq!(seeds(&medium, 4.0, 0.0), [[0.0, 4.0]]);
        assert!(seeds(&medium, 9.0, 0.0).is_empty());
    }

    #[test]
    fn extents_are_physical_and_walls_divide() {
        let rows = ["00000", "22222", "00000"];
        let tall = medium([1.0, 3.0], &rows);
        assert_eq!(seeds(&tall, 2.0, 4.0).len(), 1);
        assert!(seeds(&tall, 2.0, 4.1).is_empty());
        let walls = Mask::new(Grid::from_fn(*tall.shape(), |[x, _]| x != 3));
        let divided = tall.with_walls(walls).unwrap();
        assert_eq!(seeds(&divided, 2.0, 0.0), [[0.0, 1.0], [4.0, 1.0]]);
    }
}
