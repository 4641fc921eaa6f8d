//! The region that heat covers, and its front.

use crate::grid::heat::Heat;
use crate::grid::{Grid, Mask, Shape};

/// The cells that `heat` covers: those with `-ln(u / u_max) <= level`, where `u_max` is the highest
/// temperature.
#[must_use]
pub fn covered<const D: usize>(heat: &Heat<D>, level: f64) -> Grid<bool, D> {
    let ln_temperature = heat.ln_temperature();
    let hottest = ln_temperature.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    ln_temperature.map(|&ln| ln.is_finite() && hottest - ln <= level)
}

/// The front of a region: the positions of its cells on its outer boundary, in ascending order.
///
/// Beyond the outer boundary lies what is connected, through faces of cells that are not in the
/// region, to the border of the picture: open cells and walls alike. The border of the picture
/// itself is a boundary too. So holes in the region have no front, and of a region that fills its
/// domain the front is the border of that domain, from which Rouchdy & Cohen (2013) let paths begin.
#[must_use]
pub fn front<const D: usize>(region: &Grid<bool, D>) -> Vec<usize> {
    let shape = region.shape();
    let beyond = Mask::new(region.map(|&is_inside| !is_inside));
    let border = (0..shape.cells()).filter(|&cell| is_at_border(shape, cell));
    let outside = beyond.reachable_from(border);
    let is_front = |&cell: &usize| {
        region.values()[cell]
            && (is_at_border(shape, cell)
                || shape.neighbours(cell).any(|next| outside.values()[next]))
    };
    (0..shape.cells()).filter(is_front).collect()
}

/// Whether a cell is one of the outermost along an axis with more than one cell.
fn is_at_border<const D: usize>(shape: &Shape<D>, cell: usize) -> bool {
    let (index, size) = (shape.index(cell), shape.size());
    let is_outermost =
        |axis: usize| size[axis] > 1 && (index[axis] == 0 || index[axis] + 1 == size[axis]);
    shape.cells() == 1 || (0..D).any(is_outermost)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front_of(rows: &[&str]) -> Vec<usize> {
        let shape = Shape::new([rows[0].len(), rows.len()]).unwrap();
        front(&Grid::from_fn(shape, |[x, y]| rows[y].as_bytes()[x] == b'#'))
    }

    #[test]
    fn holes_have_no_front() {
        let rows = [".......", ".#####.", ".##.##.", ".#####.", ".#####.", "......."];
        let mut expected: Vec<usize> = (8..13).chain(29..34).collect();
        expected.extend([15, 19, 22, 26]);
        expected.sort_unstable();
        assert_eq!(front_of(&rows), expected, "the cells around [3, 2] are not in it");
    }

    #[test]
    fn the_border_of_the_picture_is_a_front() {
        assert_eq!(front_of(&["###", "###", "###"]), [0, 1, 2, 3, 5, 6, 7, 8]);
        assert_eq!(front_of(&["###"]), [0, 2], "an axis of one cell has no border");
        assert_eq!(front_of(&["#"]), [0]);
        assert_eq!(front_of(&["..", ".."]), [0; 0]);
    }
}
