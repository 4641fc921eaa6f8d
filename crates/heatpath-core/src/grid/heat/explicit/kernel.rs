//! One row of explicit heat, as the formula reads.

/// The values and conductances on either side of a row along one axis.
#[derive(Clone, Copy)]
pub(super) struct Sides<'a> {
    /// u of the cells one step back along the axis.
    pub(super) before: &'a [f64],
    /// u of the cells one step on along the axis.
    pub(super) after: &'a [f64],
    /// The conductances of the faces towards `before`.
    pub(super) face_before: &'a [f64],
    /// The conductances of the faces towards `after`.
    pub(super) face_after: &'a [f64],
}

/// `next = u + step k sum over axes (flux in from after - flux out to before)`.
///
/// All slices are one row of cells; `factor` is k, or `None` for 1. The order of operations gives
/// the same bits for a picture and its mirror image, and for a picture and its transpose; there is
/// no fused multiply-add, so every processor rounds alike.
pub(super) fn diffuse_row<const D: usize>(
    next: &mut [f64],
    u: &[f64],
    sides: [Sides; D],
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
