//! The pattern of the factor, found before any value is known.

use super::LinearError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{simplicial, supernodal};

/// The pattern of a symmetric matrix and of its Cholesky factor.
#[derive(Debug)]
pub struct Analysis {
    couplings: Vec<[usize; 2]>,
    pub(super) factor: supernodal::SymbolicSupernodalCholesky<usize>,
    /// The number of entries of the factor, those that its blocks hold for nothing not counted.
    pub(super) entries: usize,
    limit: usize,
}

impl Analysis {
    /// Analyses the matrix of `unknowns` rows whose entries off the diagonal are the `couplings`.
    ///
    /// Each coupling stands for two entries, above and below the diagonal; several between the same
    /// unknowns add up. Unknowns are eliminated in the order of their numbers. Only `limit` bytes
    /// may be needed for the factor.
    ///
    /// # Errors
    /// A coupling names an unknown that does not exist, or couples one with itself; or the factor
    /// would need more than `limit` bytes, in which case nothing of that size is allocated.
    pub fn new(
        unknowns: usize,
        couplings: Vec<[usize; 2]>,
        limit: usize,
    ) -> Result<Self, LinearError> {
        let wrong = |&[a, b]: &[usize; 2]| a == b || a.max(b) >= unknowns;
        if let Some(number) = couplings.iter().position(wrong) {
            return Err(LinearError::Coupling { number, ends: couplings[number], unknowns });
        }
        let within = |needed: usize| {
            if needed <= limit { Ok(()) } else { Err(LinearError::TooLarge { needed, limit }) }
        };
        within(Self::least_bytes(unknowns, couplings.len()))?;
        let (starts, rows) = upper_triangle(unknowns, &couplings);
        let pattern =
            SymbolicSparseColMatRef::new_unsorted_checked(unknowns, unknowns, &starts, None, &rows);
        let mut parents = vec![0; unknowns];
        let mut counts = vec![0; unknowns];
        let mut memory = buffer(simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(
            unknowns,
            rows.len(),
        ))?;
        let tree = simplicial::prefactorize_symbolic_cholesky(
            &mut parents,
            &mut counts,
            pattern,
            MemStack::new(&mut memory),
        );
        let entries = counts.iter().fold(0_usize, |sum, &count| sum.saturating_add(count));
        within(entries.saturating_mul(size_of::<f64>()))?;
        // === Columns of like pattern become one block
        let mut memory =
            buffer(supernodal::factorize_supernodal_symbolic_cholesky_scratch::<usize>(unknowns))?;
        let factor = supernodal::factorize_supernodal_symbolic_cholesky(
            pattern,
            tree,
            &counts,
            MemStack::new(&mut memory),
            Default::default(),
        )
        .map_err(|_| LinearError::OutOfMemory(entries))?;
        let analysis = Self { couplings, factor, entries, limit };
        within(analysis.bytes())?;
        Ok(analysis)
    }

    /// Less memory than this no factor takes, in bytes: that of the matrix itself.
    #[must_use]
    pub fn least_bytes(unknowns: usize, couplings: usize) -> usize {
        unknowns.saturating_add(couplings).saturating_mul(size_of::<f64>() + size_of::<usize>())
    }

    /// The memory that the factor takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.factor.len_val() * size_of::<f64>()
            + size_of_val(self.factor.row_idx())
            + (self.couplings.len() + self.unknowns()) * 3 * size_of::<f64>()
    }

    /// The most memory that was allowed, in bytes.
    #[must_use]
    pub fn limit(&self) -> usize {
        self.limit
    }

    /// The number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.factor.nrows()
    }

    /// The pairs of unknowns with an entry off the diagonal.
    #[must_use]
    pub fn couplings(&self) -> &[[usize; 2]] {
        &self.couplings
    }
}

/// The upper triangle without the diagonal, column by column: where each column starts, and rows.
fn upper_triangle(unknowns: usize, couplings: &[[usize; 2]]) -> (Vec<usize>, Vec<usize>) {
    let mut starts = vec![0; unknowns + 1];
    couplings.iter().for_each(|&[a, b]| starts[a.max(b) + 1] += 1);
    (0..unknowns).for_each(|column| starts[column + 1] += starts[column]);
    let (mut next, mut rows) = (starts.clone(), vec![0; couplings.len()]);
    for &[a, b] in couplings {
        let place = &mut next[a.max(b)];
        rows[*place] = a.min(b);
        *place += 1;
    }
    (starts, rows)
}

pub(super) fn buffer(needed: faer::dyn_stack::StackReq) -> Result<MemBuffer, LinearError> {
    MemBuffer::try_new(needed)
        .map_err(|_| LinearError::OutOfMemory(needed.unaligned_bytes_required()))
}
