//! Which source is the nearest, and how surely.

use super::Grid;
use super::heat::Heat;

/// Which source each cell belongs to.
#[derive(Clone, Debug)]
pub struct Labels<const D: usize> {
    /// The number of the nearest source, counted from 0; `None` where none is reached.
    pub nearest: Grid<Option<usize>, D>,
    /// For each source, its share `u_i / sum of all u_j` of a cell, from 0 to 1; 0 where none is
    /// reached.
    pub shares: Vec<Grid<f64, D>>,
}

/// Labels every cell with the nearest of several sources, one heat for each.
///
/// The temperatures are compared relative to what makes the sources equally strong, as
/// [`normalized`](super::distance::normalized) distances are. The share of a source is 1/2 where two
/// are equally near, and turns to 0 and 1 within some `sqrt(t)` of there. The heats are to be of the
/// same medium, time and scheme; `None` if there are none or their grids differ.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::heat::{Implicit, ImplicitOptions};
/// use heatpath_core::grid::labels::labels;
/// use heatpath_core::grid::{Shape, Sources, medium};
///
/// let medium = medium::uniform(Shape::new([65, 48])?);
/// let exec = Exec::single_threaded();
/// let implicit = Implicit::new(&medium, ImplicitOptions::default(), &exec)?;
/// let points = Sources::new(&[[12.0, 20.0], [52.0, 20.0]], medium.mask())?;
/// let labels = labels(&implicit.flow_many(&points.each(), &exec)?).expect("two heats");
/// assert_eq!(labels.nearest[[20, 40]], Some(0));
/// assert!((labels.shares[1][[32, 20]] - 0.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn labels<const D: usize>(heats: &[Heat<D>]) -> Option<Labels<D>> {
    let shape = *heats.first()?.shape();
    if heats.iter().any(|heat| heat.shape().size() != shape.size()) {
        return None;
    }
    let references: Vec<f64> = heats.iter().map(Heat::ln_reference).collect();
    let ln =
        |heat: usize, cell: usize| heats[heat].ln_temperature().values()[cell] - references[heat];
    let mut nearest = Grid::from_fn(shape, |_| None);
    let mut shares = vec![Grid::from_fn(shape, |_| 0.0); heats.len()];
    for cell in 0..shape.cells() {
        let best = (0..heats.len()).reduce(|a, b| if ln(b, cell) > ln(a, cell) { b } else { a })?;
        let largest = ln(best, cell);
        if largest == f64::NEG_INFINITY {
            continue;
        }
        nearest.values_mut()[cell] = Some(best);
        let sum: f64 = (0..heats.len()).map(|i| (ln(i, cell) - largest).exp()).sum();
        for (i, share) in shares.iter_mut().enumerate() {
            share.values_mut()[cell] = (ln(i, cell) - largest).exp() / sum;
        }
    }
    Some(Labels { nearest, shares })
}
