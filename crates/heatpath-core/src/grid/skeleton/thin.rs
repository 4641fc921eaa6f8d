//! From a mask to its centreline.

use super::radii::depths_sq;
use super::simple::{Neighbourhood, shifted};
use crate::grid::Grid;

/// The centreline of a mask: curves one cell wide, with the mask's topology.
///
/// Cells are taken away layer by layer, a layer being as deep as the smallest spacing, so that the
/// centreline lies in the physical middle; within a layer side by side, as Lee, Kashyap & Chu (1994)
/// do. A cell goes only if it is simple, that is if no piece, hole, tunnel or cavity comes or goes with
/// it (pieces hang together by corners, the background by faces), and if it is not the end of a
/// curve. A blob becomes one or two cells, a hollow ball stays a surface. Beyond the grid lies
/// background. A centreline stays as it is.
#[must_use]
pub fn thin<const D: usize>(mask: &Grid<bool, D>) -> Grid<bool, D> {
    let unit = mask.shape().smallest_spacing();
    let layer = |depth_sq: f64| (depth_sq.sqrt() / unit - 1e-9).ceil();
    let mut waiting: Vec<(f64, usize)> = depths_sq(mask)
        .into_iter()
        .enumerate()
        .filter(|&(cell, _)| mask.values()[cell])
        .map(|(cell, depth_sq)| (layer(depth_sq), cell))
        .collect();
    waiting.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut thinning = Thinning { mask: mask.clone(), around: Neighbourhood::new() };
    let mut cells: Vec<usize> = Vec::new();
    for layer in waiting.chunk_by(|a, b| a.0 == b.0) {
        cells.extend(layer.iter().map(|&(_, cell)| cell));
        cells.sort_unstable();
        while thinning.peel(&mut cells) {}
    }
    thinning.mask
}

struct Thinning<const D: usize> {
    mask: Grid<bool, D>,
    around: Neighbourhood<D>,
}

impl<const D: usize> Thinning<D> {
    /// Takes what can go of `cells`, from each side once; whether any went.
    fn peel(&mut self, cells: &mut Vec<usize>) -> bool {
        let before = cells.len();
        for axis in 0..D {
            for side in [-1, 1] {
                self.peel_side(cells, axis, side);
                cells.retain(|&cell| self.mask.values()[cell]);
            }
        }
        cells.len() < before
    }

    fn peel_side(&mut self, cells: &[usize], axis: usize, side: isize) {
        let offset = std::array::from_fn(|other| if other == axis { side } else { 0 });
        let shape = *self.mask.shape();
        let is_bare = |cell: usize| {
            shifted(&shape, shape.index(cell), offset).is_none_or(|next| !self.mask.values()[next])
        };
        let can_go = |cell: &usize| {
            let around = self.around.around(&self.mask, *cell);
            is_bare(*cell) && around.count_ones() > 1 && self.around.is_simple(around)
        };
        let leaving: Vec<usize> = cells.iter().copied().filter(can_go).collect();
        // One after the other: two that are simple side by side need not be so together.
        for cell in leaving {
            let around = self.around.around(&self.mask, cell);
            if self.around.is_simple(around) {
                self.mask.values_mut()[cell] = false;
            }
        }
    }
}
