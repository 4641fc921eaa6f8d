//! The discrete `div(D grad u)` of a tensor D: a conductance for each pair of cells.

use crate::grid::medium::Medium;
use crate::grid::stencil::{conditioned, selling, smallest_eigenvalue};
use crate::grid::tensor::per_cell;
use crate::grid::{Mask, Matrix, Shape, TensorField};
use std::collections::BTreeMap;

/// The part of the smallest eigenvalue of D that flows along the axes, whatever the directions of
/// D.
const AXIS_PART: f64 = 0.125;

/// The pairs of cells between which heat flows, and their conductances, in cell units.
///
/// The energy `grad u' D grad u` of a cell is a sum of `weight (u(cell + offset) - u(cell))^2` over
/// the offsets of Selling's decomposition of D, half of it with each sign (Fehrenbach & Mirebeau
/// 2014). So a pair has the mean of the weights that its two cells give to the offset between them,
/// 0 where a cell does not have that offset: that is why no harmonic mean is possible. All weights
/// are positive, so heat is positive, and rows add up to nothing: heat is conserved.
///
/// A pair whose segment leaves the grid or meets a wall does not exist, not even if it slips
/// between two walls that touch at a corner. Along a border that D slants across, this could leave
/// cells without any partner, in the corners first. Therefore an eighth of the smallest eigenvalue
/// (at least a D-th of that) is taken out of D and given to the axes: heat comes at every step to
/// all open neighbours that share a face, as in other media, and to no cell that cannot be reached
/// through faces.
#[derive(Debug)]
pub(super) struct Links<const D: usize> {
    shape: Shape<D>,
    /// All offsets that occur, from a cell to one after it in memory.
    offsets: Vec<[i16; D]>,
    /// Of each cell, those to cells that come after it in memory.
    forward: Vec<Vec<Link>>,
}

/// One end of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    /// The number of the offset from this cell to the other.
    pub(super) offset: u32,
    pub(super) conductance: f64,
}

impl<const D: usize> Links<D> {
    pub(super) fn new(medium: &Medium<D>, field: &TensorField<D>) -> Self {
        let (shape, mask) = (*medium.shape(), medium.mask());
        let is_all_open = mask.is_all_open();
        let mut forward = vec![Vec::new(); shape.cells()];
        let mut numbers = BTreeMap::new();
        for cell in (0..shape.cells()).filter(|&cell| mask.is_open(cell)) {
            for (offset, weight) in weights(per_cell(&field.at(cell), &shape)) {
                let next = numbers.len() as u32;
                let number = *numbers.entry(offset).or_insert(next);
                for [from, to] in pairs(&shape, cell, offset).into_iter().flatten() {
                    if is_all_open || is_open(mask, from, to) {
                        add::<D>(&mut forward[from], number, 0.5 * weight);
                    }
                }
            }
        }
        let mut offsets = vec![[0; D]; numbers.len()];
        numbers.into_iter().for_each(|(offset, number)| offsets[number as usize] = offset);
        Self { shape, offsets, forward }
    }

    /// Calls `visit` for each pair: its first cell in memory, its second, and what is between them.
    pub(super) fn for_each_pair(&self, mut visit: impl FnMut([usize; 2], Link)) {
        let shift = |offset: &[i16; D]| -> isize {
            let strides = (0..D).map(|axis| self.shape.stride(axis) as isize);
            offset.iter().zip(strides).map(|(&part, stride)| isize::from(part) * stride).sum()
        };
        let shifts: Vec<_> = self.offsets.iter().map(shift).collect();
        for (cell, links) in self.forward.iter().enumerate() {
            for &link in links {
                visit([cell, cell.wrapping_add_signed(shifts[link.offset as usize])], link);
            }
        }
    }

    /// All offsets that occur, from a cell to one after it in memory.
    pub(super) fn offsets(&self) -> &[[i16; D]] {
        &self.offsets
    }

    /// How many cells heat moves along each axis in one step at most; at least 1.
    pub(super) fn reach(&self) -> [usize; D] {
        self.offsets.iter().fold([1; D], |reach, offset| {
            std::array::from_fn(|axis| reach[axis].max(offset[axis].unsigned_abs().into()))
        })
    }
}

/// Adds half a pair to the links of a cell.
fn add<const D: usize>(links: &mut Vec<Link>, offset: u32, conductance: f64) {
    if let Some(link) = links.iter_mut().find(|link| link.offset == offset) {
        link.conductance += conductance;
    } else {
        links.reserve_exact(if links.is_empty() { D + 2 } else { 1 });
        links.push(Link { offset, conductance });
    }
}

/// Offsets and weights whose sum of `weight offset offset'` is the matrix, the axes always among
/// them.
fn weights<const D: usize>(matrix: Matrix<D>) -> impl Iterator<Item = ([i16; D], f64)> {
    let mut rest = conditioned(&matrix);
    let axis_part = AXIS_PART * smallest_eigenvalue(&rest);
    (0..D).for_each(|axis| rest[axis][axis] -= axis_part);
    let axes =
        (0..D).map(move |axis| (std::array::from_fn(|other| i16::from(other == axis)), axis_part));
    selling(&rest).map(|(offset, weight)| (offset.map(|part| part as i16), weight)).chain(axes)
}

/// The pairs of a cell and those at an offset after and before it, as far as they are on the grid.
fn pairs<const D: usize>(
    shape: &Shape<D>,
    cell: usize,
    offset: [i16; D],
) -> [Option<[usize; 2]>; 2] {
    let index = shape.index(cell);
    let at = |sign: isize| -> Option<usize> {
        let mut other = index;
        for axis in 0..D {
            other[axis] = other[axis].checked_add_signed(sign * isize::from(offset[axis]))?;
            if other[axis] >= shape.size()[axis] {
                return None;
            }
        }
        Some(shape.position(other))
    };
    [at(1).map(|after| [cell, after]), at(-1).map(|before| [before, cell])]
}

fn is_open<const D: usize>(mask: &Mask<D>, from: usize, to: usize) -> bool {
    mask.segment_is_open(mask.shape().centre(from), mask.shape().centre(to))
}
