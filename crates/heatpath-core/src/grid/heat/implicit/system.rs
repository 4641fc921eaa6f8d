//! The system of one step: `1/k + step L`.

use super::super::operator::Operator;
use super::ImplicitError;
use super::elimination::faces;
use crate::grid::medium::Medium;
use crate::linear::{Analysis, LinearError};

/// Refuses grids whose matrix alone is too large, before anything of their size is allocated.
pub(crate) fn check_memory<const D: usize>(
    medium: &Medium<D>,
    limit: usize,
) -> Result<(), ImplicitError> {
    let open = (0..medium.shape().cells()).filter(|&cell| medium.mask().is_open(cell)).count();
    let needed = Analysis::least_bytes(open, faces(medium).count());
    if needed <= limit {
        return Ok(());
    }
    Err(ImplicitError::TooLarge(LinearError::TooLarge { needed, limit }))
}

/// The cells between which heat flows.
pub(super) fn couplings<const D: usize>(operator: &Operator<D>) -> Vec<[usize; 2]> {
    let mut couplings = Vec::new();
    operator.for_each_pair(|pair, _| couplings.push(pair));
    couplings
}

/// The diagonal of `1/k + step L` in the order of `cells`, and its entries for all couplings.
pub(super) fn matrix<const D: usize>(
    operator: &Operator<D>,
    cells: &[usize],
    step: f64,
) -> (Vec<f64>, Vec<f64>) {
    let mut diagonal: Vec<f64> =
        (0..operator.medium().shape().cells()).map(|cell| 1.0 / operator.factor_of(cell)).collect();
    let mut couplings = Vec::new();
    operator.for_each_pair(|[a, b], conductance| {
        let weight = step * conductance;
        diagonal[a] += weight;
        diagonal[b] += weight;
        couplings.push(-weight);
    });
    (cells.iter().map(|&cell| diagonal[cell]).collect(), couplings)
}
