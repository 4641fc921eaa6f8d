//! The order in which cells are eliminated.

use crate::grid::{Mask, Shape};

/// Boxes with sides of at most so many cells are not divided further.
const SMALLEST_SIDE: usize = 4;

/// Nested dissection of the open cells.
///
/// A plane of cells across the longest side is put last, the two halves beside it, which do not
/// touch each other, before it, each in the same way. Where cells are coupled over a `reach` of
/// more than one cell along the axis, the plane is as thick as that. The factor then has of the
/// order of `n log n` entries for a picture of n cells and `n^(4/3)` for a volume. Measured on
/// pictures of 300 to 1024 cells a side, factoring takes 0.5 to 0.7 of the time it takes in the
/// order of approximate minimum degree, and finding the pattern a third to a half.
pub(super) fn nested_dissection<const D: usize>(mask: &Mask<D>, reach: [usize; D]) -> Vec<usize> {
    let mut order = Vec::with_capacity(mask.shape().cells());
    let dissection = Dissection { shape: mask.shape(), reach };
    dissection.put([0; D], mask.shape().size(), &mut |cell| {
        if mask.is_open(cell) {
            order.push(cell);
        }
    });
    order
}

struct Dissection<'a, const D: usize> {
    shape: &'a Shape<D>,
    reach: [usize; D],
}

impl<const D: usize> Dissection<'_, D> {
    /// Puts the cells from `low` to before `high` in order.
    fn put(&self, low: [usize; D], high: [usize; D], put: &mut impl FnMut(usize)) {
        let sides: [usize; D] = std::array::from_fn(|axis| high[axis] - low[axis]);
        // The side that takes the most planes to cut through.
        let planes = |axis: usize| sides[axis].div_ceil(self.reach[axis]);
        let longest = (0..D).max_by_key(|&axis| planes(axis)).unwrap_or(0);
        if planes(longest) <= SMALLEST_SIDE {
            return self.put_box(low, sides, put);
        }
        let with = |mut corner: [usize; D], place: usize| {
            corner[longest] = place;
            corner
        };
        let thickness = self.reach[longest];
        let middle = low[longest] + (sides[longest] + 1 - thickness) / 2;
        self.put(low, with(high, middle), put);
        self.put(with(low, middle + thickness), high, put);
        let mut separator = sides;
        separator[longest] = thickness;
        self.put_box(with(low, middle), separator, put);
    }

    /// Puts the cells of a box in the order of memory.
    fn put_box(&self, low: [usize; D], sides: [usize; D], put: &mut impl FnMut(usize)) {
        for number in 0..sides.iter().product() {
            let mut rest = number;
            put(self.shape.position(std::array::from_fn(|axis| {
                let step = rest % sides[axis];
                rest /= sides[axis];
                low[axis] + step
            })));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;

    #[test]
    fn every_open_cell_is_there_once() {
        for size in [[1, 1, 1], [1, 37, 1], [9, 14, 5], [30, 4, 17]] {
            let shape = Shape::new(size).unwrap();
            let mask = Mask::new(Grid::from_fn(shape, |[x, y, z]| (x + 2 * y + 3 * z) % 5 != 1));
            let open: Vec<usize> = (0..shape.cells()).filter(|&cell| mask.is_open(cell)).collect();
            for reach in [[1; 3], [3, 1, 2]] {
                let mut order = nested_dissection(&mask, reach);
                order.sort_unstable();
                assert_eq!(order, open);
            }
        }
    }
}
