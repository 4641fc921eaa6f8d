//! Explicit heat where D is a tensor: one row, and the order of rows when several steps are made at
//! once.

use super::gather::{BUNDLE, Bundle, Gather};
use super::kernel::{Extent, Window};
use crate::simd::Lanes;
use bytemuck::{cast_slice, pod_read_unaligned};
use std::ops::Range;

impl<const D: usize> Window<D> {
    /// Advances all cells by what they gather from others.
    ///
    /// The rows (in 3-D: planes) are passed over once by a front of all steps: each follows the one
    /// before as closely as heat reaches and no closer, so that two copies of u are enough, of
    /// which the steps write one in turn.
    #[inline(always)]
    pub(super) fn gather<L: Lanes>(
        &mut self,
        lanes: L,
        gather: &Gather<D>,
        extent: &Extent<D>,
        steps: usize,
    ) {
        let (last, reach) = (D - 1, gather.reach());
        let delay = reach[last];
        for front in 0..extent.size[last] + (steps - 1) * delay {
            for step in 0..steps.min(front / delay + 1) {
                let plane = front - step * delay;
                if extent.inner(last, (step + 1) * reach[last]).contains(&plane) {
                    self.gather_plane(lanes, gather, extent, [plane, step], steps);
                }
            }
        }
        if steps % 2 == 1 {
            std::mem::swap(&mut self.u, &mut self.other);
        }
    }

    /// Makes one step of the rows whose last index is `plane`.
    #[inline(always)]
    fn gather_plane<L: Lanes>(
        &mut self,
        lanes: L,
        gather: &Gather<D>,
        extent: &Extent<D>,
        [plane, step]: [usize; 2],
        steps: usize,
    ) {
        let inner = |axis: usize, step: usize| extent.inner(axis, step * gather.reach()[axis]);
        let rows = if D == 2 { 0..1 } else { inner(1, step + 1) };
        let cells = inner(0, step + 1);
        let bundles = cells.start / BUNDLE..cells.end.div_ceil(BUNDLE);
        for y in rows {
            let mut index = [0; D];
            index[1] = y;
            index[D - 1] = plane;
            let lasts = (1..D).all(|axis| inner(axis, steps).contains(&index[axis]));
            let with_sum = lasts && !self.sum.is_empty();
            self.gather_row(lanes, gather, extent, index, (bundles.clone(), step, with_sum));
        }
    }

    /// Makes one step of some bundles of a row.
    #[inline(always)]
    fn gather_row<L: Lanes>(
        &mut self,
        lanes: L,
        gather: &Gather<D>,
        extent: &Extent<D>,
        index: [usize; D],
        (bundles, step, with_sum): (Range<usize>, usize, bool),
    ) {
        let place = self.row(index) + bundles.start * BUNDLE;
        let row = std::array::from_fn(|axis| extent.low[axis] + index[axis]);
        let (before, after) =
            if step % 2 == 0 { (&self.u, &mut self.other) } else { (&self.other, &mut self.u) };
        let after = &mut after[place..][..bundles.len() * BUNDLE];
        let (after, _) = after.as_chunks_mut::<BUNDLE>();
        let sums = if with_sum { &mut self.sum[place..] } else { &mut [] };
        let (sums, _) = sums.as_chunks_mut::<BUNDLE>();
        let first = extent.low[0] / BUNDLE + bundles.start;
        let bundles = gather.bundles(row, first, bundles.len());
        for ((number, after), bundle) in after.iter_mut().enumerate().zip(bundles) {
            let here = place + number * BUNDLE;
            add_up(lanes, &bundle, before, here, &self.shifts, (after, sums.get_mut(number)));
        }
    }
}

/// What the cells of a bundle have after a step that stand at `here` before it.
#[inline(always)]
fn add_up<L: Lanes>(
    lanes: L,
    bundle: &Bundle,
    before: &[f64],
    here: usize,
    shifts: &[isize],
    (after, sum): (&mut [f64; BUNDLE], Option<&mut [f64; BUNDLE]>),
) {
    let n = size_of::<L::Vector>() / size_of::<f64>();
    // As many vectors as a bundle has at the lowest level.
    let mut sums = [lanes.splat(0.0); BUNDLE / 2];
    let own = &before[here..here + BUNDLE];
    for (part, sum) in sums.iter_mut().take(BUNDLE / n).enumerate() {
        *sum = lanes.mul(read::<L>(bundle.kept, part * n), read::<L>(own, part * n));
    }
    for (&term, shares) in bundle.terms.iter().zip(bundle.shares) {
        let from = here.wrapping_add_signed(shifts[term as usize]);
        let values = &before[from..from + BUNDLE];
        for (part, sum) in sums.iter_mut().take(BUNDLE / n).enumerate() {
            let flow = lanes.mul(lanes.widen(&shares.0, part * n), read::<L>(values, part * n));
            *sum = lanes.add(*sum, flow);
        }
    }
    for part in 0..BUNDLE / n {
        after[part * n..(part + 1) * n].copy_from_slice(cast_slice(&sums[part..=part]));
    }
    if let Some(sum) = sum {
        for part in 0..BUNDLE / n {
            let added = [lanes.add(read::<L>(sum, part * n), sums[part])];
            sum[part * n..(part + 1) * n].copy_from_slice(cast_slice(&added));
        }
    }
}

/// The vector that begins at number `from`.
#[inline(always)]
fn read<L: Lanes>(numbers: &[f64], from: usize) -> L::Vector {
    pod_read_unaligned(cast_slice(&numbers[from..from + size_of::<L::Vector>() / size_of::<f64>()]))
}
