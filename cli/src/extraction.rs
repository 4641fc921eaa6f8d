//! Curves that were found to files.

use crate::args::OutputArgs;
use crate::failure::Failure;
use heatpath_core::grid::Grid;
use heatpath_core::grid::distance::NOT_REACHED;
use heatpath_core::grid::path::{Ending, Path as Curve};
use heatpath_core::grid::skeleton::{Branch, Graph};
use heatpath_io::{Curves, write_curves, write_graph, write_mask};
use std::path::Path;

/// A structure that was found, as a graph and as cells.
pub(crate) struct Extraction<'a, const D: usize> {
    pub(crate) graph: &'a Graph<D>,
    pub(crate) kept: &'a Grid<bool, D>,
    pub(crate) seeds: &'a [[f64; D]],
}

impl<const D: usize> Extraction<'_, D> {
    /// The graph, a drawing, or the cells.
    pub(crate) const ENDINGS: [&'static str; 9] =
        ["json", "csv", "swc", "vtp", "svg", "png", "npy", "tif", "tiff"];

    pub(crate) fn write(&self, path: &Path, out: &OutputArgs) -> Result<(), Failure> {
        let format = out.format.as_deref();
        let ending = format.or_else(|| path.extension()?.to_str()).unwrap_or_default();
        match ending.to_ascii_lowercase().as_str() {
            "svg" => {
                let shape = self.graph.shape;
                let curves = Curves {
                    spacing: shape.spacing(),
                    paths: self.paths(),
                    key_points: Vec::new(),
                };
                write_curves(path, format, out.force, &curves, &shape)?;
            }
            "png" | "npy" | "tif" | "tiff" => write_mask(path, format, out.force, self.kept)?,
            _ => write_graph(path, format, out.force, self.graph, self.seeds)?,
        }
        Ok(())
    }

    /// The branches as paths.
    pub(crate) fn paths(&self) -> Vec<Curve<D>> {
        let path = |branch: &Branch<D>| Curve {
            points: branch.points.clone(),
            ending: Ending::Source(0),
            length: branch.length,
            physical_length: branch.physical_length,
            distance: NOT_REACHED,
        };
        self.graph.branches.iter().map(path).collect()
    }
}
