//! NRRD headers.

use super::{Numbers, Volume};
use std::io::{self, Write};

/// The header, up to and with the empty line if the numbers follow, else with the name of their file.
pub(super) fn write_header(
    out: &mut dyn Write,
    volume: &Volume<'_>,
    data: Option<&str>,
) -> io::Result<()> {
    let count = volume.size.len();
    let vector = |vector: [f64; 3]| {
        let parts: Vec<String> = vector[..count].iter().map(|x| format!("{x:?}")).collect();
        format!("({})", parts.join(","))
    };
    let axis = |axis: usize| {
        vector(volume.placement.direction[axis].map(|part| part * volume.spacing[axis]))
    };
    let list = |words: Vec<String>| words.join(" ");
    let kind = match volume.numbers {
        Numbers::F64(_) => "double",
        Numbers::U8(_) => "uint8",
    };
    writeln!(out, "NRRD0004\n# by heatpath\ntype: {kind}\ndimension: {count}")?;
    match count {
        2 => writeln!(out, "space dimension: 2")?,
        _ => writeln!(out, "space: left-posterior-superior")?,
    }
    writeln!(out, "sizes: {}", list(volume.size.iter().map(usize::to_string).collect()))?;
    writeln!(out, "space directions: {}", list((0..count).map(axis).collect()))?;
    writeln!(out, "kinds: {}", vec!["domain"; count].join(" "))?;
    writeln!(out, "endian: little\nencoding: raw")?;
    writeln!(out, "space origin: {}", vector(volume.placement.origin))?;
    match data {
        Some(name) => writeln!(out, "data file: {name}"),
        None => writeln!(out),
    }
}
