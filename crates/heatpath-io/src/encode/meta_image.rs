//! `MetaImage` headers.

use super::{Numbers, Volume};
use std::io::{self, Write};

/// The header, of which the last line names the file of the numbers or says that they follow.
pub(super) fn write_header(
    out: &mut dyn Write,
    volume: &Volume<'_>,
    data: Option<&str>,
) -> io::Result<()> {
    let axes = volume.size.len();
    let list = |numbers: &[f64]| {
        numbers[..axes].iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(" ")
    };
    let matrix: Vec<String> =
        volume.placement.direction[..axes].iter().map(|axis| list(axis)).collect();
    let sizes: Vec<String> = volume.size.iter().map(usize::to_string).collect();
    let kind = match volume.numbers {
        Numbers::F64(_) => "MET_DOUBLE",
        Numbers::U8(_) => "MET_UCHAR",
    };
    writeln!(out, "ObjectType = Image\nNDims = {axes}\nBinaryData = True")?;
    writeln!(out, "BinaryDataByteOrderMSB = False\nCompressedData = False")?;
    writeln!(out, "TransformMatrix = {}", matrix.join(" "))?;
    writeln!(out, "Offset = {}", list(&volume.placement.origin))?;
    writeln!(out, "ElementSpacing = {}", list(&volume.spacing))?;
    writeln!(out, "DimSize = {}", sizes.join(" "))?;
    writeln!(out, "ElementType = {kind}")?;
    writeln!(out, "ElementDataFile = {}", data.unwrap_or("LOCAL"))
}
