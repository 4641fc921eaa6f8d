//! Formats of positions and faces alone.

use heatpath_core::mesh::TriMesh;
use std::io::{self, Write};

pub(super) fn write_obj(out: &mut dyn Write, mesh: &TriMesh) -> io::Result<()> {
    mesh.points().iter().try_for_each(|[x, y, z]| writeln!(out, "v {x} {y} {z}"))?;
    let faces = mesh.faces().iter().map(|face| face.map(|vertex| u64::from(vertex) + 1));
    faces.into_iter().try_for_each(|[a, b, c]| writeln!(out, "f {a} {b} {c}"))
}

pub(super) fn write_off(out: &mut dyn Write, mesh: &TriMesh) -> io::Result<()> {
    writeln!(out, "OFF\n{} {} 0", mesh.points().len(), mesh.faces().len())?;
    mesh.points().iter().try_for_each(|[x, y, z]| writeln!(out, "{x} {y} {z}"))?;
    mesh.faces().iter().try_for_each(|[a, b, c]| writeln!(out, "3 {a} {b} {c}"))
}

/// Normals are left at 0: readers compute them.
pub(super) fn write_stl(out: &mut dyn Write, mesh: &TriMesh) -> io::Result<()> {
    let mut header = [b' '; 80];
    header[..8].copy_from_slice(b"heatpath");
    out.write_all(&header)?;
    out.write_all(&(mesh.faces().len() as u32).to_le_bytes())?;
    for face in 0..mesh.faces().len() {
        out.write_all(&[0; 12])?;
        for x in mesh.corners(face).into_iter().flatten() {
            out.write_all(&(x as f32).to_le_bytes())?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}
