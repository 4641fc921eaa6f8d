//! Meshes, values at their vertices, and paths on them to files.

mod bare;
mod paths;
mod ply;
mod values;
mod vtk;
mod vtp;

pub use paths::{PATH_ENDINGS, mesh_curves, write_mesh_paths};
pub use values::write_mesh_values;

use crate::WriteError;
use crate::output::{known_format, write_atomically};
use heatpath_core::mesh::TriMesh;
use std::path::Path;

/// The endings by which [`write_mesh`] chooses a format.
pub const MESH_ENDINGS: [&str; 6] = ["ply", "vtp", "vtk", "obj", "off", "stl"];

/// The formats that hold positions and faces only.
const BARE: [&str; 3] = ["obj", "off", "stl"];

/// Values of the vertices, with their name: such as `distance`, `label`, `curvature`.
pub type PointArray<'a> = (&'a str, &'a [f64]);

/// Writes a mesh and values of its vertices, in the given format, or else in the one that the ending
/// of `path` stands for.
///
/// Coordinates are 32-bit floats if that loses nothing, as in meshes from most files, else 64-bit
/// ones (STL has 32 bits only); values are 64-bit floats.
///
/// - `.ply`: binary, little-endian, a property for each array; infinities are kept;
/// - `.vtp` (base64) and `.vtk` (legacy, binary): what is infinite is NaN there, so that VTK and
///   `ParaView` find the range of the others and draw it in the colour for NaN;
/// - `.obj`, `.off` (text), `.stl` (binary): the mesh alone.
///
/// In names, white space becomes `_`.
///
/// # Errors
/// The format is unknown or cannot hold arrays, an array has more or fewer values than there are
/// vertices, the folder is missing, the file exists and `overwrite` is not set, or the operating
/// system refuses.
pub fn write_mesh(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    mesh: &TriMesh,
    arrays: &[PointArray<'_>],
) -> Result<(), WriteError> {
    let path = path.as_ref();
    let format = known_format(path, format, &MESH_ENDINGS)?;
    check_arrays(path, mesh.points().len(), arrays)?;
    if BARE.contains(&format) && !arrays.is_empty() {
        return Err(WriteError::NoValues { path: path.to_owned() });
    }
    write_atomically(path, overwrite, |out| match format {
        "ply" => ply::write(out, mesh, arrays),
        "vtp" => vtp::write(out, mesh, arrays),
        "vtk" => vtk::write(out, mesh, arrays),
        "obj" => bare::write_obj(out, mesh),
        "off" => bare::write_off(out, mesh),
        _ => bare::write_stl(out, mesh),
    })
}

fn check_arrays(path: &Path, expected: usize, arrays: &[PointArray<'_>]) -> Result<(), WriteError> {
    match arrays.iter().find(|(_, values)| values.len() != expected) {
        None => Ok(()),
        Some(&(name, values)) => Err(WriteError::Values {
            path: path.to_owned(),
            name: name.to_owned(),
            given: values.len(),
            expected,
        }),
    }
}

/// Whether all coordinates are 32-bit floats.
fn is_single(mesh: &TriMesh) -> bool {
    mesh.points().iter().flatten().all(|&x| f64::from(x as f32) == x)
}

/// A name as one word.
fn word(name: &str) -> String {
    let fits = |c: char| !c.is_whitespace() && !c.is_control();
    name.chars().map(|c| if fits(c) { c } else { '_' }).collect()
}

/// A value as VTK wants it.
fn finite_or_nan(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::NAN }
}
