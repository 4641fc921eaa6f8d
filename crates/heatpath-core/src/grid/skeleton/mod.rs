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

use super::raster::crossed;
use super::{Grid, Shape};

/// The cells that polylines, in pixel coordinates, cross; segments that leave the grid are left out.
///
/// Each polyline gives cells that hang together by faces, edges or corners. Of many paths to one
/// source, `Graph::of_mask(&raster(...))` makes one graph; its radii are those of the raster.
#[must_use]
pub fn raster<const D: usize>(
    polylines: &[impl AsRef<[[f64; D]]>],
    shape: Shape<D>,
) -> Grid<bool, D> {
    let mut mask = Grid::from_fn(shape, |_| false);
    for points in polylines.iter().map(AsRef::as_ref) {
        for inside in points.split(|&point| !shape.contains(point)) {
            crossed(&shape, inside).into_iter().for_each(|cell| mask.values_mut()[cell] = true);
        }
    }
    mask
}
