//! Which cells of a mask can go without a change of its topology.

use crate::grid::{Grid, Shape};

/// The 3^D cells around a cell, as bits, and which of them touch.
pub(super) struct Neighbourhood<const D: usize> {
    offsets: Vec<[isize; D]>,
    /// For each, those that share a face, an edge or a corner with it.
    touching: Vec<u32>,
    /// For each, those of the shell that share a face with it.
    facing: Vec<u32>,
    /// Those that share a face with the centre.
    faces: u32,
    /// Those that share a face or an edge with the centre.
    shell: u32,
}

impl<const D: usize> Neighbourhood<D> {
    pub(super) fn new() -> Self {
        let offsets: Vec<[isize; D]> = (0..3_usize.pow(D as u32))
            .map(|i| std::array::from_fn(|axis| (i / 3_usize.pow(axis as u32) % 3) as isize - 1))
            .collect();
        let steps = |a: [isize; D]| a.iter().map(|x| x.abs()).sum::<isize>();
        let minus = |a: [isize; D], b: [isize; D]| std::array::from_fn(|axis| a[axis] - b[axis]);
        let bits = |keep: &dyn Fn([isize; D]) -> bool| {
            let kept = offsets.iter().enumerate().filter(|&(_, &offset)| keep(offset));
            kept.fold(0_u32, |bits, (i, _)| bits | 1 << i)
        };
        let is_shell = |a: [isize; D]| matches!(steps(a), 1 | 2);
        let touching = |a: [isize; D]| {
            bits(&|b| steps(b) > 0 && b != a && minus(a, b).iter().all(|x: &isize| x.abs() <= 1))
        };
        let facing = |a: [isize; D]| bits(&|b| is_shell(b) && steps(minus(a, b)) == 1);
        Self {
            touching: offsets.iter().map(|&a| touching(a)).collect(),
            facing: offsets.iter().map(|&a| facing(a)).collect(),
            faces: bits(&|a| steps(a) == 1),
            shell: bits(&is_shell),
            offsets,
        }
    }

    /// The true cells around `cell`, itself left out; beyond the grid all is false.
    pub(super) fn around(&self, mask: &Grid<bool, D>, cell: usize) -> u32 {
        let (shape, index) = (mask.shape(), mask.shape().index(cell));
        let is_set = |offset: &[isize; D]| {
            *offset != [0; D]
                && shifted(shape, index, *offset).is_some_and(|there| mask.values()[there])
        };
        let set = self.offsets.iter().enumerate().filter(|(_, offset)| is_set(offset));
        set.fold(0, |bits, (i, _)| bits | 1 << i)
    }

    /// Whether removing the centre changes no topology: the true cells around it hang together, and
    /// so do the false ones that share a face with it (Malandain & Bertrand 1992).
    pub(super) fn is_simple(&self, around: u32) -> bool {
        if around == 0 || around & self.faces == self.faces {
            return false;
        }
        let outside = !around & self.shell;
        grown(around, &self.touching, lowest(around)) == around
            && outside & self.faces & !grown(outside, &self.facing, lowest(outside & self.faces))
                == 0
    }
}

/// The cell at `index + offset`, if it is on the grid.
pub(super) fn shifted<const D: usize>(
    shape: &Shape<D>,
    index: [usize; D],
    offset: [isize; D],
) -> Option<usize> {
    let mut there = index;
    for axis in 0..D {
        there[axis] = index[axis].checked_add_signed(offset[axis])?;
        if there[axis] >= shape.size()[axis] {
            return None;
        }
    }
    Some(shape.position(there))
}

fn lowest(bits: u32) -> u32 {
    bits & bits.wrapping_neg()
}

/// The part of `set` that hangs together with `seed`.
fn grown(set: u32, adjacent: &[u32], seed: u32) -> u32 {
    let (mut grown, mut new) = (seed, seed);
    while new != 0 {
        let next = adjacent[new.trailing_zeros() as usize] & set & !grown;
        new = (new & (new - 1)) | next;
        grown |= next;
    }
    grown
}

#[cfg(test)]
mod tests {
    use super::*;

    fn simple<const D: usize>(cells: &[[usize; D]]) -> bool {
        let mask = Grid::from_fn(Shape::new([3; D]).unwrap(), |i| cells.contains(&i));
        let neighbourhood = Neighbourhood::new();
        neighbourhood.is_simple(neighbourhood.around(&mask, mask.shape().cells() / 2))
    }

    #[test]
    fn known_neighbourhoods() {
        assert!(
            simple(&[[0, 0]]) && simple(&[[0, 1], [1, 0]]) && simple(&[[0, 0], [1, 0], [2, 0]])
        );
        assert!(!simple::<2>(&[]) && !simple(&[[0, 0], [2, 2]]) && !simple(&[[0, 1], [2, 1]]));
        assert!(!simple(&[[0, 1], [1, 0], [2, 1], [1, 2]]), "it would open a hole");
        assert!(simple(&[[0, 0, 0]]) && !simple(&[[0, 0, 0], [2, 2, 2]]));
        let ring = [[0, 1], [1, 0], [2, 1], [1, 2]].map(|[x, y]| [x, y, 1]);
        assert!(!simple(&ring), "it fills a ring");
        let lid = [ring[0], ring[1], ring[2], ring[3], [1, 1, 0]];
        assert!(simple(&lid), "it lies in a bowl");
    }
}
