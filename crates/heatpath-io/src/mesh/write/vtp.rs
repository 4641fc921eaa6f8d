//! Poly data of VTK, XML: arrays in base64, which carries NaN and loses no digit.

use super::{PointArray, finite_or_nan, is_single};
use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use heatpath_core::mesh::TriMesh;
use quick_xml::escape::escape;
use std::io::{self, Write};

pub(super) fn write(
    out: &mut dyn Write,
    mesh: &TriMesh,
    arrays: &[PointArray<'_>],
) -> io::Result<()> {
    let (points, faces) = (mesh.points().len(), mesh.faces().len());
    writeln!(
        out,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" \
         byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfPolys=\"{faces}\">"
    )?;
    if let Some((first, _)) = arrays.first() {
        writeln!(out, "<PointData Scalars=\"{}\">", escape(*first))?;
        for (name, values) in arrays {
            let values = values.iter().map(|&value| finite_or_nan(value).to_le_bytes());
            array(out, ["Float64", name], 1, values)?;
        }
        writeln!(out, "</PointData>")?;
    }
    writeln!(out, "<Points>")?;
    let coordinates = mesh.points().iter().flatten();
    if is_single(mesh) {
        array(out, ["Float32", "Points"], 3, coordinates.map(|&x| (x as f32).to_le_bytes()))?;
    } else {
        array(out, ["Float64", "Points"], 3, coordinates.map(|x| x.to_le_bytes()))?;
    }
    writeln!(out, "</Points>\n<Polys>")?;
    let corners = mesh.faces().iter().flatten();
    array(out, ["Int64", "connectivity"], 1, corners.map(|&v| i64::from(v).to_le_bytes()))?;
    array(out, ["Int64", "offsets"], 1, (1..=faces).map(|face| (3 * face as i64).to_le_bytes()))?;
    writeln!(out, "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>")
}

/// An array: the number of its bytes, and its bytes.
fn array<const N: usize>(
    out: &mut dyn Write,
    [kind, name]: [&str; 2],
    components: usize,
    values: impl Iterator<Item = [u8; N]>,
) -> io::Result<()> {
    write!(out, "<DataArray type=\"{kind}\" Name=\"{}\" ", escape(name))?;
    writeln!(out, "NumberOfComponents=\"{components}\" format=\"binary\">")?;
    let bytes: Vec<u8> = values.flatten().collect();
    let mut encoder = EncoderWriter::new(&mut *out, &STANDARD);
    encoder.write_all(&(bytes.len() as u64).to_le_bytes())?;
    encoder.write_all(&bytes)?;
    encoder.finish()?;
    drop(encoder);
    writeln!(out, "\n</DataArray>")
}
