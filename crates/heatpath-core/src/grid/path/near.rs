//! Which sources are at hand.

use crate::grid::{Shape, Sources};

/// The sources by cell, so that a descent asks only those around it.
#[derive(Clone, Debug)]
pub(super) struct NearSources {
    /// Whether a source lies in a cell or one that touches it.
    is_near: Vec<bool>,
    /// Cells and numbers of the sources, in this order.
    by_cell: Vec<(usize, usize)>,
}

impl NearSources {
    pub(super) fn new<const D: usize>(shape: &Shape<D>, sources: &Sources<D>) -> Self {
        let cells = sources.points().iter().map(|&point| shape.position(shape.cell_at(point)));
        let mut by_cell: Vec<_> = cells.zip(0..).collect();
        by_cell.sort_unstable();
        let mut is_near = vec![false; shape.cells()];
        for &(cell, _) in &by_cell {
            shape.box_around(cell, 1).for_each(|near| is_near[near] = true);
        }
        Self { is_near, by_cell }
    }

    /// The numbers of the sources in a cell and those that touch it.
    pub(super) fn around<const D: usize>(
        &self,
        shape: &Shape<D>,
        cell: usize,
    ) -> impl Iterator<Item = usize> {
        let cells = self.is_near[cell].then(|| shape.box_around(cell, 1));
        cells.into_iter().flatten().flat_map(|cell| {
            let first = self.by_cell.partition_point(|&(other, _)| other < cell);
            let here = self.by_cell[first..].iter().take_while(move |&&(other, _)| other == cell);
            here.map(|&(_, number)| number)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Mask;

    #[test]
    fn sources_are_found_from_the_cells_around_them() {
        let shape = Shape::new([6, 5]).unwrap();
        let points = [[2.4, 2.0], [5.0, 4.0], [1.6, 2.2]];
        let sources = Sources::new(&points, &Mask::all_open(shape)).unwrap();
        let near = NearSources::new(&shape, &sources);
        let around = |index| near.around(&shape, shape.position(index)).collect::<Vec<_>>();
        assert_eq!(around([3, 3]), [0, 2]);
        assert_eq!(around([4, 3]), [1]);
        assert_eq!(around([0, 2]), [0_usize; 0]);
    }
}
