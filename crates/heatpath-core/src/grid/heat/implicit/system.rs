//! The system of one step: `1/k + step L`.

use super::super::operator::Operator;
use super::ImplicitError;
use crate::grid::medium::Medium;
use crate::linear::{Analysis, LinearError};

/// Refuses grids whose matrix alone is too large, before anything of their size is allocated.
pub(super) fn check_memory<const D: usize>(
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

/// The faces between open cells: the axis, and the cell after the face.
pub(super) fn faces<const D: usize>(
    medium: &Medium<D>,
) -> impl Iterator<Item = (usize, usize)> + '_ {
    let (shape, mask) = (*medium.shape(), medium.mask());
    (0..D).flat_map(move |axis| {
        let stride = shape.stride(axis);
        (stride..shape.cells())
            .filter(move |&cell| {
                shape.index(cell)[axis] > 0 && mask.is_open(cell) && mask.is_open(cell - stride)
            })
            .map(move |cell| (axis, cell))
    })
}

/// The diagonal of `1/k + step L` in the order of `cells`, and its entries for all faces.
pub(super) fn matrix<const D: usize>(
    medium: &Medium<D>,
    operator: &Operator<D>,
    cells: &[usize],
    step: f64,
) -> (Vec<f64>, Vec<f64>) {
    let mut diagonal: Vec<f64> =
        (0..medium.shape().cells()).map(|cell| 1.0 / operator.factor_of(cell)).collect();
    let couplings = faces(medium)
        .map(|(axis, cell)| {
            let weight = step * operator.conductance(axis, cell);
            diagonal[cell] += weight;
            diagonal[cell - medium.shape().stride(axis)] += weight;
            -weight
        })
        .collect();
    (cells.iter().map(|&cell| diagonal[cell]).collect(), couplings)
}
