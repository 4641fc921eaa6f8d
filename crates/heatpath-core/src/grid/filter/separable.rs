//! Gaussian derivatives, one axis after the other.
//!
//! The work is cut into slabs, which are the rows of a picture or the slices of a volume. Each axis
//! is one pass: across the slabs first, then from row to row of a slice, then along the rows, whose
//! ends are mirrored into a margin. Every pass runs along memory, so the compiler makes vectors of
//! it, and what lies between two passes is one slab or one row, which stays in the cache.

use super::kernel::{Kernel, mirror, pad};
use crate::exec::{Cancelled, Exec};
use crate::grid::{Grid, Shape};
use crate::simd::SimdLevel;
use std::ops::Range;
use std::sync::Mutex;

/// How many slabs each thread works through between two reports.
const SLABS_BETWEEN_REPORTS: usize = 16;

/// The kernels of one width, for the derivatives of order 0 to 2 along each axis.
pub(super) struct Derivatives<const D: usize> {
    shape: Shape<D>,
    kernels: [[Kernel; 3]; D],
    simd: SimdLevel,
}

/// What one thread needs to work on a slab.
pub(super) struct Scratch {
    /// The slab after the pass across slabs, for each order.
    slabs: [Vec<f64>; 3],
    row: Vec<f64>,
    padded: Vec<f64>,
}

impl<const D: usize> Derivatives<D> {
    /// Derivatives, per cell unit, of an image smoothed by `sigma` cell units: multiples of the
    /// smallest spacing.
    pub(super) fn new(shape: Shape<D>, sigma: f64, simd: SimdLevel) -> Self {
        Self::with_sigmas(shape, [sigma; D], simd)
    }

    /// The same with a width along each axis, all in cell units.
    pub(super) fn with_sigmas(shape: Shape<D>, sigmas: [f64; D], simd: SimdLevel) -> Self {
        const { assert!(D == 2 || D == 3, "a picture or a volume") };
        let kernels = std::array::from_fn(|axis| {
            let units = shape.spacing()[axis] / shape.smallest_spacing();
            std::array::from_fn(|order| {
                let sigma = sigmas[axis] / units;
                let kernel = Kernel::gaussian(order, sigma, shape.size()[axis]);
                kernel.times(units.powi(-(order as i32)))
            })
        });
        Self { shape, kernels, simd }
    }

    pub(super) fn scratch(&self) -> Scratch {
        let (slab, row) = (slab_cells(&self.shape), self.shape.size()[0]);
        Scratch {
            slabs: std::array::from_fn(|_| vec![0.0; slab]),
            row: vec![0.0; row],
            padded: vec![0.0; row + 2 * self.margin()],
        }
    }

    fn margin(&self) -> usize {
        self.kernels[0].iter().map(Kernel::radius).max().unwrap_or(0)
    }

    /// The derivatives of the given `orders` along each axis, in one slab of `image`.
    ///
    /// `finish(derivative, first, row)` gets each row as it is ready: which of `orders` it belongs
    /// to and where it begins in the slab.
    pub(super) fn slab(
        &self,
        image: &Grid<f64, D>,
        slab: usize,
        orders: &[[usize; D]],
        scratch: &mut Scratch,
        mut finish: impl FnMut(usize, usize, &[f64]),
    ) {
        self.across_slabs(image, slab, orders, &mut scratch.slabs);
        let width = self.shape.size()[0];
        let rows = slab_cells(&self.shape) / width;
        for (derivative, orders) in orders.iter().enumerate() {
            let values = &scratch.slabs[orders[D - 1]];
            let along_row = &self.kernels[0][orders[0]];
            let taps_along_row = along_row.taps(|k| (self.margin() as isize + k) as usize);
            for row in 0..rows {
                if D == 3 {
                    let kernel = &self.kernels[1][orders[1]];
                    let taps = kernel.taps(|k| width * mirror(row as isize + k, rows));
                    kernel.apply(&taps, values, &mut scratch.row, self.simd);
                    pad(&scratch.row, self.margin(), &mut scratch.padded);
                } else {
                    pad(&values[row * width..][..width], self.margin(), &mut scratch.padded);
                }
                along_row.apply(&taps_along_row, &scratch.padded, &mut scratch.row, self.simd);
                finish(derivative, row * width, &scratch.row);
            }
        }
    }

    /// Fills `values`, of which there are as many for every cell of `image`, in parallel.
    ///
    /// `put(slab, derivative, first, row)` gets the values of a slab, and the rest as
    /// [`slab`](Self::slab) says it; progress goes through `share` of the whole.
    pub(super) fn fill<T: Send>(
        &self,
        image: &Grid<f64, D>,
        orders: &[[usize; D]],
        values: &mut [T],
        (share, exec): (Range<f64>, &Exec),
        put: impl Fn(&mut [T], usize, usize, &[f64]) + Sync + Send,
    ) -> Result<(), Cancelled> {
        let slabs = values.chunks_mut(values.len() / self.shape.size()[D - 1]);
        for_each_slab(
            exec,
            share,
            slabs,
            || self.scratch(),
            |scratch, slab, values| {
                self.slab(image, slab, orders, scratch, |derivative, first, row| {
                    put(values, derivative, first, row);
                });
            },
        )
    }

    /// The pass along the last axis, for the orders that are needed.
    fn across_slabs(
        &self,
        image: &Grid<f64, D>,
        slab: usize,
        orders: &[[usize; D]],
        slabs: &mut [Vec<f64>; 3],
    ) {
        let cells = slab_cells(&self.shape);
        let count = self.shape.size()[D - 1];
        for (order, result) in slabs.iter_mut().enumerate() {
            if orders.iter().any(|orders| orders[D - 1] == order) {
                let kernel = &self.kernels[D - 1][order];
                let taps = kernel.taps(|k| cells * mirror(slab as isize + k, count));
                kernel.apply(&taps, image.values(), result, self.simd);
            }
        }
    }
}

/// The cells of a slab: a row of a picture, a slice of a volume.
pub(super) fn slab_cells<const D: usize>(shape: &Shape<D>) -> usize {
    shape.cells() / shape.size()[D - 1]
}

/// The orders of the first derivatives along each axis.
pub(super) fn first_orders<const D: usize>() -> [[usize; D]; D] {
    std::array::from_fn(|axis| std::array::from_fn(|other| usize::from(other == axis)))
}

/// The orders of the second derivatives on and above the diagonal, row by row.
pub(super) fn second_orders<const D: usize>() -> Vec<[usize; D]> {
    let first = first_orders::<D>();
    let sum = |i: usize, j: usize| std::array::from_fn(|axis| first[i][axis] + first[j][axis]);
    (0..D).flat_map(|i| (i..D).map(move |j| sum(i, j))).collect()
}

/// Calls `work(scratch, slab, part)` for each of `parts`, which belong to the slabs in order, in
/// parallel; progress goes through `share` of the whole.
pub(super) fn for_each_slab<T: Send, S: Send>(
    exec: &Exec,
    share: Range<f64>,
    parts: impl Iterator<Item = T>,
    scratch: impl Fn() -> S,
    work: impl Fn(&mut S, usize, &mut T) + Sync + Send,
) -> Result<(), Cancelled> {
    let scratch: Vec<_> = (0..exec.threads()).map(|_| Mutex::new(scratch())).collect();
    let mut parts: Vec<_> = parts.enumerate().collect();
    let count = parts.len() as f64;
    for batch in parts.chunks_mut(SLABS_BETWEEN_REPORTS * exec.threads()) {
        let finished = batch.first().map_or(0.0, |(slab, _)| *slab as f64 / count);
        exec.report(share.start + (share.end - share.start) * finished)?;
        exec.for_each_with(batch, &scratch, |scratch, (slab, part)| work(scratch, *slab, part));
    }
    Ok(())
}
