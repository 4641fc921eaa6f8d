//! Symmetric systems on the cells of a grid: order and pattern.

use super::options::{ImplicitError, explained};
use super::order;
use crate::exec::Exec;
use crate::grid::Mask;
use crate::grid::medium::Medium;
use crate::linear::{Analysis, Cholesky};
use std::sync::Arc;

/// The order of elimination of the open cells, and the pattern of the factor.
#[derive(Debug)]
pub(crate) struct Elimination {
    /// The open cells in the order of elimination.
    pub(crate) cells: Vec<usize>,
    /// The place of each cell in that order.
    pub(crate) places: Vec<usize>,
    analysis: Arc<Analysis>,
}

impl Elimination {
    /// Orders the open cells, of which `couplings` are the pairs with an entry off the diagonal, at
    /// most `reach` cells apart along each axis, and analyses; refuses to take more than
    /// `memory_limit` bytes before it does.
    pub(crate) fn new<const D: usize>(
        mask: &Mask<D>,
        reach: [usize; D],
        couplings: impl Iterator<Item = [usize; 2]>,
        memory_limit: usize,
    ) -> Result<Self, ImplicitError> {
        let cells = order::nested_dissection(mask, reach);
        let mut places = vec![0; mask.shape().cells()];
        cells.iter().enumerate().for_each(|(place, &cell)| places[cell] = place);
        let couplings = couplings.map(|pair| pair.map(|cell| places[cell])).collect();
        let analysis = Analysis::new(cells.len(), couplings, memory_limit).map_err(explained)?;
        Ok(Self { cells, places, analysis: Arc::new(analysis) })
    }

    /// Factors a matrix with this diagonal, in the order of elimination, and these entries of the
    /// couplings.
    pub(crate) fn factor(
        &self,
        diagonal: &[f64],
        couplings: &[f64],
        exec: &Exec,
    ) -> Result<Cholesky, ImplicitError> {
        Cholesky::new(Arc::clone(&self.analysis), diagonal, couplings, exec).map_err(explained)
    }
}

/// The faces between open cells: the axis, and the cell after the face.
pub(crate) fn faces<const D: usize>(
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
