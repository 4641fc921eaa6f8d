//! Explicit heat, one row after the other, as the formula reads.

/// A box of cells: where it lies in the arrays of the grid and in the window with u.
#[derive(Clone, Copy)]
pub(super) struct Block<const D: usize> {
    /// The cells along each axis.
    pub(super) size: [usize; D],
    /// The position of the first cell in the grid, and how far apart neighbours are there.
    pub(super) cell: usize,
    pub(super) cell_strides: [usize; D],
    /// The same in the window.
    pub(super) place: usize,
    pub(super) place_strides: [usize; D],
}

/// The values and conductances on either side of a row along one axis.
#[derive(Clone, Copy)]
struct Sides<'a> {
    before: &'a [f64],
    after: &'a [f64],
    face_before: &'a [f64],
    face_after: &'a [f64],
}

/// `next = u + step k sum over axes (flux in from after - flux out to before)` for all cells of a
/// block.
///
/// `faces` holds for each axis the conductances towards the neighbour before each cell; `factor` is
/// k, or `None` for 1. The order of operations gives the same bits for a picture and its mirror
/// image, and for a picture and its transpose; there is no fused multiply-add, so every processor
/// rounds alike.
#[inline(always)]
pub(super) fn diffuse<const D: usize>(
    next: &mut [f64],
    u: &[f64],
    faces: &[Vec<f64>; D],
    factor: Option<&[f64]>,
    step: f64,
    block: &Block<D>,
) {
    let (rows, planes) = (size_along(block.size, 1), size_along(block.size, 2));
    let n = block.size[0];
    for row in 0..rows * planes {
        let (y, z) = (row % rows, row / rows);
        let cell = block.cell + y * at(block.cell_strides, 1) + z * at(block.cell_strides, 2);
        let place = block.place + y * at(block.place_strides, 1) + z * at(block.place_strides, 2);
        let mut sides = [Sides { before: &[], after: &[], face_before: &[], face_after: &[] }; D];
        for (axis, sides) in sides.iter_mut().enumerate() {
            *sides = Sides {
                before: &u[place - block.place_strides[axis]..][..n],
                after: &u[place + block.place_strides[axis]..][..n],
                face_before: &faces[axis][cell..][..n],
                face_after: &faces[axis][cell + block.cell_strides[axis]..][..n],
            };
        }
        let next = &mut next[place..place + n];
        let factor = factor.map(|factor| &factor[cell..][..n]);
        diffuse_row(next, &u[place..][..n], &sides, factor, step);
    }
}

/// One row; all slices are of one length.
///
/// One loop an axis and one for the step: each is short enough for the compiler to make vector
/// instructions of. One loop for all was tried and is slower: written to `next` it stays scalar (too
/// many slices to prove apart), in arrays of eight values too, and by way of a buffer it gains
/// nothing, because the time goes into the loads that are not aligned.
#[inline(always)]
fn diffuse_row<const D: usize>(
    next: &mut [f64],
    u: &[f64],
    sides: &[Sides; D],
    factor: Option<&[f64]>,
    step: f64,
) {
    let n = next.len();
    let u = &u[..n];
    next.fill(0.0);
    for side in sides {
        let (before, after) = (&side.before[..n], &side.after[..n]);
        let (face_before, face_after) = (&side.face_before[..n], &side.face_after[..n]);
        for i in 0..n {
            next[i] += face_after[i] * (after[i] - u[i]) - face_before[i] * (u[i] - before[i]);
        }
    }
    match factor {
        None => next.iter_mut().zip(u).for_each(|(next, u)| *next = u + step * *next),
        Some(factor) => {
            let cells = next.iter_mut().zip(u).zip(factor);
            cells.for_each(|((next, u), k)| *next = u + step * k * *next);
        }
    }
}

fn size_along<const D: usize>(size: [usize; D], axis: usize) -> usize {
    size.get(axis).copied().unwrap_or(1)
}

fn at<const D: usize>(strides: [usize; D], axis: usize) -> usize {
    strides.get(axis).copied().unwrap_or(0)
}
