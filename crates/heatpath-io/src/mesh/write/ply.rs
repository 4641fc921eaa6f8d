//! PLY.

use super::{PointArray, is_single, word};
use heatpath_core::mesh::TriMesh;
use std::io::{self, Write};

pub(super) fn write(
    out: &mut dyn Write,
    mesh: &TriMesh,
    arrays: &[PointArray<'_>],
) -> io::Result<()> {
    let single = is_single(mesh);
    let kind = if single { "float" } else { "double" };
    writeln!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}", mesh.points().len())?;
    for axis in ["x", "y", "z"] {
        writeln!(out, "property {kind} {axis}")?;
    }
    for (name, _) in arrays {
        writeln!(out, "property double {}", word(name))?;
    }
    let count = mesh.faces().len();
    writeln!(out, "element face {count}\nproperty list uchar int vertex_indices\nend_header")?;
    for (vertex, point) in mesh.points().iter().enumerate() {
        for &x in point {
            match single {
                true => out.write_all(&(x as f32).to_le_bytes())?,
                false => out.write_all(&x.to_le_bytes())?,
            }
        }
        for (_, values) in arrays {
            out.write_all(&values[vertex].to_le_bytes())?;
        }
    }
    for face in mesh.faces() {
        out.write_all(&[3])?;
        for vertex in face {
            out.write_all(&vertex.to_le_bytes())?;
        }
    }
    Ok(())
}
