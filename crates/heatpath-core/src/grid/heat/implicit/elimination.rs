//! Systems whose couplings are the faces between open cells: order and pattern.

use super::options::{ImplicitError, explained};
use super::order;
use super::system::{check_memory, faces};
use crate::exec::Exec;
use crate::grid::medium::Medium;
use crate::linear::{Analysis, Cholesky};
use std::sync::Arc;

/// The order of elimination of the open cells, and the pattern of the factor.
#[derive(Debug)]
pub(crate) struct Elimination<const D: usize> {
    /// The open cells in the order of elimination.
    pub(crate) cells: Vec<usize>,
    /// The place of each cell in that order.
    pub(crate) places: Vec<usize>,
    /// The faces in the order of the couplings: the axis, and the cell after the face.
    pub(crate) faces: Vec<(usize, usize)>,
    pub(super) analysis: Arc<Analysis>,
}

impl<const D: usize> Elimination<D> {
    /// Orders and analyses; refuses to take more than `memory_limit` bytes before it does.
    pub(crate) fn new(medium: &Medium<D>, memory_limit: usize) -> Result<Self, ImplicitError> {
        check_memory(medium, memory_limit)?;
        let cells = order::nested_dissection(medium.mask());
        let mut places = vec![0; medium.shape().cells()];
        cells.iter().enumerate().for_each(|(place, &cell)| places[cell] = place);
        let faces: Vec<(usize, usize)> = faces(medium).collect();
        let couplings = faces
            .iter()
            .map(|&(axis, cell)| [places[cell], places[cell - medium.shape().stride(axis)]])
            .collect();
        let analysis = Analysis::new(cells.len(), couplings, memory_limit).map_err(explained)?;
        Ok(Self { cells, places, faces, analysis: Arc::new(analysis) })
    }

    /// Factors a matrix with this diagonal, in the order of elimination, and these couplings.
    pub(crate) fn factor(
        &self,
        diagonal: &[f64],
        couplings: &[f64],
        exec: &Exec,
    ) -> Result<Cholesky, ImplicitError> {
        Cholesky::new(Arc::clone(&self.analysis), diagonal, couplings, exec).map_err(explained)
    }
}
