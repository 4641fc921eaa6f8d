//! Poly data of VTK, legacy: binary, big-endian, in the layout that all versions read.

use super::{PointArray, finite_or_nan, is_single, word};
use heatpath_core::mesh::TriMesh;
use std::io::{self, Write};

pub(super) fn write(
    out: &mut dyn Write,
    mesh: &TriMesh,
    arrays: &[PointArray<'_>],
) -> io::Result<()> {
    let (points, faces) = (mesh.points().len(), mesh.faces().len());
    writeln!(out, "# vtk DataFile Version 3.0\nheatpath\nBINARY\nDATASET POLYDATA")?;
    if is_single(mesh) {
        writeln!(out, "POINTS {points} float")?;
        mesh.points()
            .iter()
            .flatten()
            .try_for_each(|&x| out.write_all(&(x as f32).to_be_bytes()))?;
    } else {
        writeln!(out, "POINTS {points} double")?;
        mesh.points().iter().flatten().try_for_each(|x| out.write_all(&x.to_be_bytes()))?;
    }
    writeln!(out, "\nPOLYGONS {faces} {}", 4 * faces)?;
    for face in mesh.faces() {
        out.write_all(&3_u32.to_be_bytes())?;
        face.iter().try_for_each(|vertex| out.write_all(&vertex.to_be_bytes()))?;
    }
    writeln!(out)?;
    if !arrays.is_empty() {
        writeln!(out, "POINT_DATA {points}")?;
    }
    for (name, values) in arrays {
        writeln!(out, "SCALARS {} double 1\nLOOKUP_TABLE default", word(name))?;
        values.iter().try_for_each(|&x| out.write_all(&finite_or_nan(x).to_be_bytes()))?;
        writeln!(out)?;
    }
    Ok(())
}
