//! The skeleton of a mask: its centreline, radii and a graph of nodes and branches.
//!
//! ```
//! use heatpath_core::grid::skeleton::{Graph, PruneOptions};
//! use heatpath_core::grid::{Grid, Shape};
//!
//! // A bar of 31 x 5 cells.
//! let shape = Shape::new([41, 11])?;
//! let bar = Grid::from_fn(shape, |[x, y]| (5..36).contains(&x) && (3..8).contains(&y));
//! let graph = Graph::of_mask(&bar).pruned(PruneOptions::default());
//! assert_eq!((graph.nodes.len(), graph.branches.len()), (2, 1));
//! assert_eq!(graph.branches[0].radii[10], 2.5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod graph;
mod network;
mod prune;
mod radii;
mod simple;
mod thin;

pub use graph::{Branch, Graph, Node};
pub use prune::PruneOptions;
pub use radii::radii;
pub use thin::thin;

pub(crate) use graph::smoothed;
pub(crate) use network::Network;

use super::{Grid, Shape};

/// The cells that polylines, in pixel coordinates, pass through; what lies beyond the grid is left out.
///
/// Each polyline gives cells that hang together by faces, edges or corners. Of many paths to one
/// source, `Graph::of_mask(&raster(...))` makes one graph; its radii are those of the raster.
#[must_use]
pub fn raster<const D: usize>(
    polylines: &[impl AsRef<[[f64; D]]>],
    shape: Shape<D>,
) -> Grid<bool, D> {
    let mut mask = Grid::from_fn(shape, |_| false);
    let mut mark = |point: [f64; D]| {
        if shape.contains(point) {
            mask[shape.cell_at(point)] = true;
        }
    };
    for points in polylines.iter().map(AsRef::as_ref) {
        points.iter().for_each(|&point| mark(point));
        for pair in points.windows(2) {
            let step = |axis: usize| (pair[1][axis] - pair[0][axis]).abs();
            let parts = (4.0 * (0..D).map(step).fold(0.0, f64::max)).ceil();
            for part in 1..parts as usize {
                let along = part as f64 / parts;
                let at = |axis: usize| pair[0][axis] + along * (pair[1][axis] - pair[0][axis]);
                mark(std::array::from_fn(at));
            }
        }
    }
    mask
}
