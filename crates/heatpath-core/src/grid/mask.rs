//! Walls: cells that heat cannot enter and paths cannot cross.

use super::{Grid, Shape};

/// Which cells are open; the others are walls with no flux through them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask<const D: usize> {
    open: Grid<bool, D>,
}

impl<const D: usize> Mask<D> {
    /// A mask whose cells are open where `open` is true and walls where it is false.
    #[must_use]
    pub fn new(open: Grid<bool, D>) -> Self {
        Self { open }
    }

    /// A mask without walls.
    #[must_use]
    pub fn all_open(shape: Shape<D>) -> Self {
        Self { open: Grid::from_fn(shape, |_| true) }
    }

    /// The same cells of a grid of the same size that may have another spacing.
    pub(crate) fn with_spacing_of(self, shape: &Shape<D>) -> Self {
        Self { open: self.open.with_spacing_of(shape) }
    }

    /// Whether each cell is open.
    #[must_use]
    pub fn open(&self) -> &Grid<bool, D> {
        &self.open
    }

    /// The size and spacing.
    #[must_use]
    pub fn shape(&self) -> &Shape<D> {
        self.open.shape()
    }

    /// Whether the cell stored at `position` is open.
    #[must_use]
    pub fn is_open(&self, position: usize) -> bool {
        self.open.values()[position]
    }

    /// Whether there are no walls.
    #[must_use]
    pub fn is_all_open(&self) -> bool {
        self.open.values().iter().all(|&open| open)
    }

    /// Whether `point` (pixel coordinates) lies in an open cell.
    #[must_use]
    pub fn is_open_at(&self, point: [f64; D]) -> bool {
        self.open[self.shape().cell_at(point)]
    }

    /// Whether the straight segment from `from` to `to` (pixel coordinates) stays in open cells.
    ///
    /// Every cell that the segment enters counts, so nothing slips between two walls that touch at
    /// a corner only: a segment through that corner is refused.
    #[must_use]
    pub fn segment_is_open(&self, from: [f64; D], to: [f64; D]) -> bool {
        let (first, last) = (self.shape().cell_at(from), self.shape().cell_at(to));
        let touch = (0..D).all(|axis| first[axis].abs_diff(last[axis]) <= 1);
        if touch && self.step_is_open(first, last) {
            return true;
        }
        // === The parameters in (0, 1) at which the segment crosses a cell border
        let mut crossings = vec![0.0, 1.0];
        for axis in 0..D {
            let (a, b) = (from[axis], to[axis]);
            let (low, high) = (a.min(b), a.max(b));
            let mut border = (low + 0.5).floor() + 0.5;
            while border < high {
                crossings.push((border - a) / (b - a));
                border += 1.0;
            }
        }
        crossings.sort_by(f64::total_cmp);
        // === Between two crossings the segment is inside one cell
        let at = |s: f64| std::array::from_fn(|i| from[i] + s * (to[i] - from[i]));
        let inside =
            crossings.windows(2).map(|pair| self.shape().cell_at(at(0.5 * (pair[0] + pair[1]))));
        let mut previous = self.shape().cell_at(from);
        self.open[previous]
            && inside.chain([self.shape().cell_at(to)]).all(|cell| {
                let open = self.step_is_open(previous, cell);
                previous = cell;
                open
            })
    }

    /// Whether all cells of the smallest box around two touching cells are open.
    fn step_is_open(&self, from: [usize; D], to: [usize; D]) -> bool {
        (0..1_usize << D).all(|corner| {
            self.open[std::array::from_fn(|axis| {
                if corner >> axis & 1 == 0 { from[axis] } else { to[axis] }
            })]
        })
    }

    /// Marks every cell that can be reached from one of `seeds` through faces of open cells.
    #[must_use]
    pub fn reachable_from(&self, seeds: impl IntoIterator<Item = usize>) -> Grid<bool, D> {
        let mut reached = self.open.map(|_| false);
        let mut stack: Vec<usize> = seeds.into_iter().filter(|&seed| self.is_open(seed)).collect();
        while let Some(cell) = stack.pop() {
            if !std::mem::replace(&mut reached.values_mut()[cell], true) {
                stack.extend(
                    self.shape()
                        .neighbours(cell)
                        .filter(|&next| self.is_open(next) && !reached.values()[next]),
                );
            }
        }
        reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(rows: &[&str]) -> Mask<2> {
        let shape = Shape::new([rows[0].len(), rows.len()]).unwrap();
        Mask::new(Grid::from_fn(shape, |[x, y]| rows[y].as_bytes()[x] == b'.'))
    }

    #[test]
    fn a_segment_is_stopped_by_any_wall_it_enters() {
        let mask = mask(&["....", ".#..", "...."]);
        assert!(mask.segment_is_open([0.0, 0.0], [3.0, 0.0]));
        assert!(!mask.segment_is_open([0.0, 1.0], [3.0, 1.0]));
        assert!(!mask.segment_is_open([0.0, 0.9], [2.0, 0.0]));
        assert!(mask.segment_is_open([0.0, 0.4], [3.0, 0.4]));
        assert!(!mask.segment_is_open([1.0, 1.0], [1.0, 1.0]));
    }

    #[test]
    fn walls_that_touch_at_a_corner_do_not_leak() {
        let mask = mask(&[".#", "#."]);
        assert!(!mask.segment_is_open([0.0, 0.0], [1.0, 1.0]));
        assert!(!mask.reachable_from([0]).values()[3]);
    }

    #[test]
    fn reachability_follows_open_faces() {
        let mask = mask(&["..#.", "..#.", "..#."]);
        let reached = mask.reachable_from([0]);
        assert!(reached[[1, 2]] && !reached[[3, 0]] && !reached[[2, 1]]);
    }
}
