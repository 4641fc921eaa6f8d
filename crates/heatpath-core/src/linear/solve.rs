//! `L L' x = b` for numbers of any range.
//!
//! The heat of one source is a right-hand side with one entry. The forward pass `L y = b` then only
//! touches the blocks on the way from the source's to the last one; the backward pass `L' x = y`
//! touches all of them once and takes nearly all of the time.
//!
//! Many right-hand sides go through each block together, while it is in the cache.

use super::block::{Below, Block};
use super::{Analysis, Cholesky, Wide};
use crate::Exec;
use crate::exec::SimdLevel;
use std::collections::BTreeSet;

/// How many right-hand sides go through the factor together.
const BATCH: usize = 8;

/// A right-hand side: unknowns and their values; the others are zero.
pub type Entries = Vec<(usize, Wide)>;

impl Cholesky {
    /// Solves `A x = b` for each right-hand side.
    ///
    /// With a matrix whose entries off the diagonal are not positive and right-hand sides that are
    /// not negative, nothing cancels, and every value of every solution is accurate to its last
    /// few bits, however small. The result does not depend on the number of threads.
    ///
    /// The sides are shared between the threads of `exec`.
    #[must_use]
    pub fn solve(&self, sides: &[Entries], exec: &Exec) -> Vec<Vec<Wide>> {
        let share = sides.len().div_ceil(exec.threads()).clamp(1, BATCH);
        let mut batches: Vec<(&[Entries], Vec<Vec<Wide>>)> =
            sides.chunks(share).map(|batch| (batch, Vec::new())).collect();
        exec.for_each(&mut batches, |(batch, solved)| {
            *solved = self.solve_refined(batch, exec.simd());
        });
        batches.into_iter().flat_map(|(_, solved)| solved).collect()
    }

    pub(super) fn solve_batch(&self, sides: &[Entries], simd: SimdLevel) -> Vec<Vec<Wide>> {
        let mut solutions: Vec<Vec<Wide>> =
            sides.iter().map(|side| self.forward(side, simd)).collect();
        let mut scratch = vec![Below::default(); sides.len()];
        for number in (0..self.analysis.factor.n_supernodes()).rev() {
            let block = self.block(number);
            simd.run(|| block.backward(&mut solutions, &mut scratch));
        }
        for solution in &mut solutions {
            solution.iter_mut().zip(&self.scales).for_each(|(x, &scale)| *x = x.shifted(scale));
        }
        solutions
    }

    /// `L y = S b`.
    fn forward(&self, side: &Entries, simd: SimdLevel) -> Vec<Wide> {
        let mut y = vec![Wide::ZERO; self.analysis.unknowns()];
        for &(unknown, value) in side {
            y[unknown] = y[unknown].plus(value.shifted(self.scales[unknown]));
        }
        for number in self.analysis.touched(side) {
            let block = self.block(number);
            simd.run(|| block.forward(&mut y));
        }
        y
    }

    pub(super) fn block(&self, number: usize) -> Block<'_> {
        let factor = &self.analysis.factor;
        let (start, end) = (factor.supernode_begin()[number], factor.supernode_end()[number]);
        let places = factor.col_ptr_for_val();
        let pattern = factor.supernode(number).pattern();
        let height = end - start + pattern.len();
        Block {
            start,
            end,
            pattern,
            height,
            values: &self.values[places[number]..places[number + 1]],
        }
    }
}

impl Analysis {
    /// The blocks that the entries of a right-hand side reach, in order.
    fn touched(&self, side: &Entries) -> BTreeSet<usize> {
        let ends = self.factor.supernode_end();
        let block_of = |unknown: usize| ends.partition_point(|&end| end <= unknown);
        let mut touched = BTreeSet::new();
        for &(unknown, _) in side {
            let mut number = block_of(unknown);
            while touched.insert(number) {
                match self.factor.supernode(number).pattern().first() {
                    Some(&next) => number = block_of(next),
                    None => break,
                }
            }
        }
        touched
    }
}
