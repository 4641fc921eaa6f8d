//! Polylines for VTK.

use crate::placement::World;
use std::io::{self, Write};

/// Values of polylines by name, one each.
pub(crate) type LineArray = (&'static str, Vec<f64>);

/// Writes polylines, given in pixel coordinates with a radius for each point or none at all, as VTK
/// XML poly data in text, in the `world`; `arrays` must be finite, as text has no word for other
/// values that all versions of VTK read.
pub(crate) fn write<const D: usize>(
    out: &mut dyn Write,
    lines: &[(&[[f64; D]], &[f64])],
    world: World<D>,
    arrays: &[LineArray],
) -> io::Result<()> {
    let points: usize = lines.iter().map(|(points, _)| points.len()).sum();
    let has_radii = lines.iter().any(|(_, radii)| !radii.is_empty());
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(out, "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">")?;
    let count = lines.len();
    writeln!(out, "<PolyData><Piece NumberOfPoints=\"{points}\" NumberOfLines=\"{count}\">")?;
    if has_radii {
        writeln!(out, "<PointData Scalars=\"radius\">")?;
        let radii = lines.iter().flat_map(|(_, radii)| radii.iter());
        array(out, "Float64", "radius", 1, radii.map(|&radius| known(radius)))?;
        writeln!(out, "</PointData>")?;
    }
    if !arrays.is_empty() {
        writeln!(out, "<CellData>")?;
        for (name, values) in arrays {
            array(out, "Float64", name, 1, values.iter())?;
        }
        writeln!(out, "</CellData>")?;
    }
    writeln!(out, "<Points>")?;
    let coordinates = lines.iter().flat_map(|(points, _)| points.iter());
    array(out, "Float64", "points", 3, coordinates.flat_map(|&point| world.point(point)))?;
    writeln!(out, "</Points><Lines>")?;
    array(out, "Int64", "connectivity", 1, 0..points)?;
    let ends = lines.iter().scan(0, |end, (points, _)| {
        *end += points.len();
        Some(*end)
    });
    array(out, "Int64", "offsets", 1, ends)?;
    writeln!(out, "</Lines></Piece></PolyData></VTKFile>")
}

fn array(
    out: &mut dyn Write,
    kind: &str,
    name: &str,
    components: usize,
    values: impl Iterator<Item = impl std::fmt::Display>,
) -> io::Result<()> {
    write!(out, "<DataArray type=\"{kind}\" Name=\"{name}\" ")?;
    writeln!(out, "NumberOfComponents=\"{components}\" format=\"ascii\">")?;
    for value in values {
        write!(out, "{value} ")?;
    }
    writeln!(out, "\n</DataArray>")
}

/// A radius, or 0 where it is not known.
pub(crate) fn known(radius: f64) -> f64 {
    if radius.is_finite() { radius } else { 0.0 }
}
