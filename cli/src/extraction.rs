//! Curves that were found to files.

use crate::args::OutputArgs;
use crate::failure::Failure;
use heatpath_core::grid::Grid;
use heatpath_core::grid::distance::NOT_REACHED;
use heatpath_core::grid::path::{Ending, Path as Curve};
use heatpath_core::grid::skeleton::{Branch, Graph};
use heatpath_io::output::ending;
use heatpath_io::{Curves, FieldFormat, Placement, write_curves, write_graph, write_mask};
use std::path::Path;

/// A structure that was found, as a graph and as cells.
pub(crate) struct Extraction<'a, const D: usize> {
    pub(crate) graph: &'a Graph<D>,
    pub(crate) kept: &'a Grid<bool, D>,
    pub(crate) seeds: &'a [[f64; D]],
    pub(crate) placement: Option<Placement>,
}

impl<const D: usize> Extraction<'_, D> {
    /// The graph, a drawing, or the cells.
    pub(crate) const ENDINGS: [&'static str; 15] = [
        "json", "csv", "swc", "vtp", "svg", "png", "npy", "tif", "tiff", "nrrd", "nhdr", "mha",
        "mhd", "nii", "nii.gz",
    ];

    pub(crate) fn write(&self, path: &Path, out: &OutputArgs) -> Result<(), Failure> {
        let format = out.format.as_deref();
        let ending = format.unwrap_or_else(|| ending(path));
        match ending.to_ascii_lowercase().as_str() {
            "svg" => {
                let shape = self.graph.shape;
                let curves = Curves {
                    spacing: shape.spacing(),
                    placement: self.placement,
                    paths: self.paths(),
                    key_points: Vec::new(),
                };
                write_curves(path, format, out.force, &curves, &shape)?;
            }
            name if FieldFormat::ENDINGS.contains(&name) => {
                write_mask(path, format, out.force, self.kept, self.placement)?;
            }
            _ => {
                write_graph(path, format, out.force, self.graph, self.seeds, self.placement)?;
            }
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
            cost: f64::NAN,
        };
        self.graph.branches.iter().map(path).collect()
    }
}
