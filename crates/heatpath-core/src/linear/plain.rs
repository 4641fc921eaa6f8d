//! `L L' x = b` for numbers that f64 can hold.

use super::block::Block;
use super::wide::power_of_two;
use super::{Cholesky, Entries, Wide};
use crate::Exec;

/// A solution above this has lost no bits to the end of f64's range.
const SMALLEST: f64 = 1e-280;

impl Cholesky {
    /// Solves `A x = b` for each of the right-hand sides, which all have a value for each unknown, in
    /// plain f64: several times as fast as [`solve`](Self::solve), for solutions that do not fall or
    /// rise by hundreds of orders of magnitude.
    ///
    /// The sides are shared between the threads of `exec`.
    ///
    /// # Panics
    /// A side has more or fewer values than there are unknowns.
    pub fn solve_plain(&self, sides: &mut [Vec<f64>], exec: &Exec) {
        let level = exec.simd();
        exec.for_each(sides, |side| {
            assert_eq!(side.len(), self.analysis.unknowns(), "a value for each unknown");
            let mut below = Vec::new();
            self.rescale(side);
            for number in 0..self.analysis.factor.n_supernodes() {
                let block = self.block(number);
                level.run(|| block.forward_plain(side, &mut below));
            }
            for number in (0..self.analysis.factor.n_supernodes()).rev() {
                let block = self.block(number);
                level.run(|| block.backward_plain(side, &mut below));
            }
            self.rescale(side);
        });
    }

    /// As [`solve`](Self::solve), for right-hand sides that are not negative, in f64 for as long as that
    /// can hold the solution, which takes a third of the time. Differs from it by a few bits.
    #[must_use]
    pub fn solve_near(&self, sides: &[Entries], exec: &Exec) -> Vec<Vec<Wide>> {
        let dense = |side: &Entries| {
            let mut values = vec![0.0; self.analysis.unknowns()];
            side.iter().for_each(|&(unknown, value)| values[unknown] += value.to_f64());
            values
        };
        let mut near: Vec<Vec<f64>> = sides.iter().map(dense).collect();
        self.solve_plain(&mut near, exec);
        let is_held: Vec<bool> = near.iter().map(|solution| self.is_held(solution)).collect();
        let far = sides.iter().zip(&is_held).filter(|(_, is_held)| !**is_held);
        let far: Vec<Entries> = far.map(|(side, _)| side.clone()).collect();
        let mut far = self.solve(&far, exec).into_iter();
        let solution = |(near, is_held): (Vec<f64>, bool)| {
            let far = if is_held { None } else { far.next() };
            far.unwrap_or_else(|| near.into_iter().map(Wide::from).collect())
        };
        near.into_iter().zip(is_held).map(solution).collect()
    }

    /// Whether a positive solution has not come near the end of f64's range, where an unknown would be
    /// zero beside one that is not.
    fn is_held(&self, solution: &[f64]) -> bool {
        let couplings = self.analysis.couplings().iter().zip(&self.couplings);
        let mut couplings = couplings.filter(|(_, value)| **value != 0.0).map(|(ends, _)| ends);
        couplings.all(|&[a, b]| {
            let (low, high) = (solution[a].min(solution[b]), solution[a].max(solution[b]));
            high == 0.0 || low > SMALLEST
        })
    }

    /// Multiplies by S.
    fn rescale(&self, x: &mut [f64]) {
        x.iter_mut().zip(&self.scales).for_each(|(x, &scale)| *x *= power_of_two(scale));
    }
}

impl Block<'_> {
    /// Computes y of the columns, and takes their part from the rows below.
    #[inline(always)]
    fn forward_plain(&self, y: &mut [f64], below: &mut Vec<f64>) {
        let own = &mut y[self.start..self.end];
        // Right-hand sides of a few entries leave most blocks alone.
        if own.iter().all(|&value| value == 0.0) {
            return;
        }
        below.clear();
        below.resize(self.pattern.len(), 0.0);
        for j in 0..own.len() {
            let (top, bottom) = self.column(j).split_at(own.len());
            let value = own[j] / top[j];
            own[j] = value;
            own[j + 1..].iter_mut().zip(&top[j + 1..]).for_each(|(y, entry)| *y -= entry * value);
            below.iter_mut().zip(bottom).for_each(|(sum, entry)| *sum += entry * value);
        }
        self.pattern.iter().zip(below).for_each(|(&unknown, sum)| y[unknown] -= *sum);
    }

    /// Computes x of the columns from y there and x of the rows below.
    #[inline(always)]
    fn backward_plain(&self, x: &mut [f64], below: &mut Vec<f64>) {
        below.clear();
        below.extend(self.pattern.iter().map(|&unknown| x[unknown]));
        let own = &mut x[self.start..self.end];
        for j in (0..own.len()).rev() {
            let (top, bottom) = self.column(j).split_at(own.len());
            let sum = own[j] - dot(&top[j + 1..], &own[j + 1..]) - dot(bottom, below);
            own[j] = sum / top[j];
        }
    }
}

/// The scalar product: eight sums, added in the end, so that they fill vectors.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, last_a), (b, last_b)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..8 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let last: f64 = last_a.iter().zip(last_b).map(|(a, b)| a * b).sum();
    let s = sums;
    ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7])) + last
}
