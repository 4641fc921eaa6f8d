//! The factor of a matrix.

use super::LinearError;
use super::analysis::{Analysis, buffer};
use super::wide::{exponent_of, power_of_two};
use crate::Exec;
use faer::dyn_stack::MemStack;
use faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot;
use faer::sparse::linalg::cholesky::supernodal;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Spec};
use std::sync::Arc;

/// The diagonal of the scaled matrix is near two to this power.
const TOP: i32 = 1000;

/// Entries of the factor below this have lost bits.
const SMALLEST: f64 = f64::MIN_POSITIVE * (1_u64 << 62) as f64;

/// The Cholesky factor `L` of a symmetric positive definite matrix `A = L L'`.
///
/// What is factored is `S A S`, where S is diagonal and holds powers of two such that the diagonal
/// of `S A S` lies between 2^1000 and 2^1002. No bit is rounded by that. The entries of the factor
/// fall like heat does, across the width of the largest part that is cut out; from 2^501 down to
/// 2^-960 they are trusted, which is twice what they could span without S. Smaller ones are set to
/// zero: they are [`lost`](Self::lost), and [`solve`](Self::solve) makes up for them.
#[derive(Debug)]
pub struct Cholesky {
    pub(super) analysis: Arc<Analysis>,
    /// The blocks of the factor, one after the other, each column by column.
    pub(super) values: Vec<f64>,
    /// The exponents of S.
    pub(super) scales: Vec<i32>,
    pub(super) diagonal: Vec<f64>,
    pub(super) couplings: Vec<f64>,
    lost: usize,
}

impl Cholesky {
    /// Factors the matrix with these values: those of the diagonal, and one for each coupling.
    ///
    /// # Errors
    /// There are more or fewer values than in the pattern, the matrix is not positive definite, or
    /// there is not enough memory.
    pub fn new(
        analysis: Arc<Analysis>,
        diagonal: &[f64],
        couplings: &[f64],
        exec: &Exec,
    ) -> Result<Self, LinearError> {
        let mut cholesky = Self {
            analysis,
            values: Vec::new(),
            scales: Vec::new(),
            diagonal: Vec::new(),
            couplings: Vec::new(),
            lost: 0,
        };
        cholesky.refactor(diagonal, couplings, exec)?;
        Ok(cholesky)
    }

    /// Factors another matrix of the same pattern, in the same memory.
    ///
    /// # Errors
    /// As for [`new`](Self::new); the factor must not be used any more then.
    pub fn refactor(
        &mut self,
        diagonal: &[f64],
        couplings: &[f64],
        exec: &Exec,
    ) -> Result<(), LinearError> {
        let analysis = Arc::clone(&self.analysis);
        check_lengths(&analysis, diagonal, couplings)?;
        exec.report(0.0)?;
        if let Some(bad) = diagonal.iter().position(|value| !(value.is_finite() && *value > 0.0)) {
            return Err(LinearError::NotPositiveDefinite(bad));
        }
        self.scales =
            diagonal.iter().map(|&value| (TOP - exponent_of(value)).div_euclid(2)).collect();
        let symbolic = &analysis.factor;
        let missing = symbolic.len_val().saturating_sub(self.values.len());
        let bytes = missing * size_of::<f64>();
        self.values.try_reserve_exact(missing).map_err(|_| LinearError::OutOfMemory(bytes))?;
        self.values.resize(symbolic.len_val(), 0.0);
        let (starts, rows, values) = self.lower_triangle(diagonal, couplings);
        let n = analysis.unknowns();
        let pattern = SymbolicSparseColMatRef::new_unsorted_checked(n, n, &starts, None, &rows);
        // faer's own threads wait for each other in loops: on a busy machine of two cores they took
        // 1.5 times as long as one alone, for the same bits.
        let mut memory =
            buffer(supernodal::factorize_supernodal_numeric_llt_scratch::<usize, f64>(
                symbolic,
                Par::Seq,
                Spec::default(),
            ))?;
        supernodal::factorize_supernodal_numeric_llt(
            &mut self.values,
            SparseColMatRef::new(pattern, &values),
            Default::default(),
            symbolic,
            Par::Seq,
            MemStack::new(&mut memory),
            Spec::default(),
        )
        .map_err(|NonPositivePivot { index }| LinearError::NotPositiveDefinite(index))?;
        let tiny = |value: &&mut f64| value.abs() < SMALLEST;
        self.values.iter_mut().filter(tiny).for_each(|value| *value = 0.0);
        self.lost = analysis.entries.saturating_sub(self.kept());
        (self.diagonal, self.couplings) = (diagonal.to_vec(), couplings.to_vec());
        Ok(())
    }

    /// How many entries are not zero. Above the diagonal the blocks hold anything.
    fn kept(&self) -> usize {
        let blocks = (0..self.analysis.factor.n_supernodes()).map(|number| self.block(number));
        let columns = blocks.flat_map(|block| {
            (0..block.width())
                .map(move |j| block.column(j)[j..].iter().filter(|&&x| x != 0.0).count())
        });
        columns.sum()
    }

    /// How many entries of the factor are zero because they are too small for f64, or because
    /// couplings are zero.
    #[must_use]
    pub fn lost(&self) -> usize {
        self.lost
    }

    /// The lower triangle of `S A S`, column by column: where each column starts, rows, values.
    fn lower_triangle(
        &self,
        diagonal: &[f64],
        couplings: &[f64],
    ) -> (Vec<usize>, Vec<usize>, Vec<f64>) {
        let n = diagonal.len();
        let edges = self.analysis.couplings();
        let mut starts = vec![0; n + 1];
        (1..=n).for_each(|next| starts[next] = 1);
        edges.iter().for_each(|&[a, b]| starts[a.min(b) + 1] += 1);
        (0..n).for_each(|column| starts[column + 1] += starts[column]);
        let mut next = starts.clone();
        let (mut rows, mut values) = (vec![0; starts[n]], vec![0.0; starts[n]]);
        let mut put = |row: usize, column: usize, value: f64| {
            let scaled = value * power_of_two(self.scales[row]) * power_of_two(self.scales[column]);
            (rows[next[column]], values[next[column]]) = (row, scaled);
            next[column] += 1;
        };
        diagonal.iter().enumerate().for_each(|(i, &value)| put(i, i, value));
        edges.iter().zip(couplings).for_each(|(&[a, b], &value)| put(a.max(b), a.min(b), value));
        (starts, rows, values)
    }

    /// The pattern.
    #[must_use]
    pub fn analysis(&self) -> &Arc<Analysis> {
        &self.analysis
    }
}

fn check_lengths(
    analysis: &Analysis,
    diagonal: &[f64],
    couplings: &[f64],
) -> Result<(), LinearError> {
    let wrong = |what, expected, given| Err(LinearError::Length { what, expected, given });
    let (unknowns, pairs) = (analysis.unknowns(), analysis.couplings().len());
    if diagonal.len() != unknowns {
        return wrong("diagonal values", unknowns, diagonal.len());
    }
    if couplings.len() != pairs {
        return wrong("couplings", pairs, couplings.len());
    }
    Ok(())
}
