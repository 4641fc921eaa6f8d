//! Paths on meshes: curves in space.

use crate::WriteError;
use crate::curves::{Curves, write_curves};
use crate::output::known_format;
use heatpath_core::grid::Shape;
use heatpath_core::grid::path::{Ending as CurveEnding, Path as Curve};
use heatpath_core::mesh::path::{Ending, Path as MeshPath};
use std::path::Path;

/// The endings by which [`write_mesh_paths`] chooses a format.
pub const PATH_ENDINGS: [&str; 4] = ["json", "csv", "swc", "vtp"];

/// Writes paths in the mesh's coordinates, in the given format, or else in the one that the ending of
/// `path` stands for: JSON, CSV, SWC or VTP as [`write_curves`] does for volumes.
///
/// # Errors
/// The format is unknown, the folder is missing, the file exists and `overwrite` is not set, or the
/// operating system refuses.
pub fn write_mesh_paths(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    paths: &[MeshPath],
) -> Result<(), WriteError> {
    let format = known_format(path.as_ref(), format, &PATH_ENDINGS)?;
    // Only drawings, which are not of volumes, need the size of a picture.
    let shape = Shape::new([1; 3]).expect("one cell is a grid");
    write_curves(path, Some(format), overwrite, &mesh_curves(paths), &shape)
}

/// Paths on a mesh as curves with the spacing 1, for [`curves_json`](crate::curves_json). One that
/// was stuck has the ending `step_limit`.
#[must_use]
pub fn mesh_curves(paths: &[MeshPath]) -> Curves<3> {
    let curve = |path: &MeshPath| Curve {
        points: path.positions.clone(),
        ending: match path.ending {
            Ending::Source(label) => CurveEnding::Source(label as usize),
            Ending::Unreachable => CurveEnding::Unreachable,
            Ending::Stuck => CurveEnding::StepLimit,
        },
        length: path.length,
        physical_length: path.length,
        distance: path.distance,
        cost: f64::NAN,
    };
    Curves {
        spacing: [1.0; 3],
        placement: None,
        paths: paths.iter().map(curve).collect(),
        key_points: Vec::new(),
    }
}
