//! What the factor has lost, made up for.
//!
//! Where two unknowns influence each other by less than f64 can hold, their entry of the factor is
//! zero, and a solution lacks whatever passes through it. If no entry of the matrix off the diagonal
//! is positive, all terms have one sign: such a solution is too small, nowhere too large, and the
//! missing part `b - A x` is not negative. So it is solved for again, until nothing is missing.

use super::{Cholesky, Entries, Wide};
use crate::exec::SimdLevel;

/// A missing part below this share of a row is rounding.
const ROUNDING: f64 = 1e-12;

impl Cholesky {
    /// Solves, and solves again for what is missing.
    pub(super) fn solve_refined(&self, sides: &[Entries], simd: SimdLevel) -> Vec<Vec<Wide>> {
        let mut solutions = self.solve_batch(sides, simd);
        let negative = sides.iter().flatten().any(|(_, value)| value.parts().0 < 0.0);
        let positive = self.couplings.iter().any(|&coupling| coupling > 0.0);
        // Without one sign what is missing cannot be told from rounding.
        if self.lost() == 0 || negative || positive {
            return solutions;
        }
        // Each time the solution reaches one unknown further at least.
        for _ in 0..self.analysis.unknowns() {
            let missing: Vec<Entries> =
                sides.iter().zip(&solutions).map(|(side, x)| self.missing(side, x)).collect();
            if missing.iter().all(Vec::is_empty) {
                break;
            }
            for (x, more) in solutions.iter_mut().zip(self.solve_batch(&missing, simd)) {
                x.iter_mut().zip(more).for_each(|(x, more)| *x = x.plus(more));
            }
        }
        solutions
    }

    /// The rows of `b - A x` that are not just rounding.
    fn missing(&self, side: &Entries, x: &[Wide]) -> Entries {
        let mut inflow = vec![Wide::ZERO; x.len()];
        side.iter().for_each(|&(row, value)| inflow[row] = inflow[row].plus(value));
        for (&[a, b], &coupling) in self.analysis.couplings().iter().zip(&self.couplings) {
            inflow[a] = inflow[a].plus(x[b].times(-coupling));
            inflow[b] = inflow[b].plus(x[a].times(-coupling));
        }
        let rows = inflow.into_iter().zip(x).zip(&self.diagonal).enumerate();
        rows.filter_map(|(row, ((inflow, x), &diagonal))| {
            let missing = inflow.plus(x.times(-diagonal));
            (missing.is_above(inflow.times(ROUNDING))).then_some((row, missing))
        })
        .collect()
    }
}
