//! NRRD: a text header, an empty line, and the numbers there or in a file beside it.
//!
//! <https://teem.sourceforge.net/nrrd/format.html>

use super::block::Encoding;
use super::nrrd_axes::{Axes, vectors};
use super::{Header, Scale, numbers, product};
use crate::ReadError;
use crate::decode::{Input, Raster};
use crate::placement::{Geometry, Placement, Vector, mirrored};
use crate::sample::SampleType;
use std::collections::HashMap;

/// `.nrrd`, and `.nhdr` with its data in one file beside it; raw, gzip and text; two or three axes in
/// space, and one before or after them for several values a cell.
pub(in crate::decode) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let (text, rest) = split(input.bytes);
    let fields = Fields::parse(text).map_err(|e| input.broken(e))?;
    let header = fields.header().map_err(|e| input.broken(e))?;
    match fields.get("datafile") {
        None => {
            let (header, data) = fields.skip(header, rest).map_err(|e| input.broken(e))?;
            header.decode(input, data)
        }
        Some(name) => {
            let data = input.beside(name)?;
            let (header, data) = fields.skip(header, &data).map_err(|e| input.broken(e))?;
            header.decode(input, data)
        }
    }
}

/// The header before the first empty line, and what follows that.
fn split(bytes: &[u8]) -> (&[u8], &[u8]) {
    let mut end = 0;
    for line in bytes.split_inclusive(|&c| c == b'\n') {
        if matches!(line, b"\n" | b"\r\n") {
            return (&bytes[..end], &bytes[end + line.len()..]);
        }
        end += line.len();
    }
    (bytes, &[])
}

/// The fields of a header, their names in small letters without spaces.
pub(super) struct Fields<'a>(HashMap<String, &'a str>);

impl<'a> Fields<'a> {
    fn parse(text: &'a [u8]) -> Result<Self, String> {
        let text = str::from_utf8(text).map_err(|_| "the header is not text")?;
        let mut fields = HashMap::new();
        for line in text.lines().skip(1).filter(|line| !line.starts_with('#')) {
            match line.split_once(':') {
                // A key and value of the user's own.
                Some((_, value)) if value.starts_with('=') => {}
                Some((name, value)) => {
                    let name = name.replace(' ', "").to_ascii_lowercase();
                    fields.insert(name, value.trim());
                }
                None => return Err(format!("the header line {line:?} is no field")),
            }
        }
        Ok(Self(fields))
    }

    pub(super) fn get(&self, name: &str) -> Option<&'a str> {
        self.0.get(name).copied()
    }

    fn need(&self, name: &str) -> Result<&'a str, String> {
        self.get(name).ok_or_else(|| format!("the header has no field {name}"))
    }

    fn header(&self) -> Result<Header, String> {
        let sizes = numbers::<u64>("sizes", self.need("sizes")?)?;
        let axes = Axes::new(self, &sizes)?;
        let sample = sample_type(self.need("type")?)?;
        let encoding = match self.need("encoding")?.to_ascii_lowercase().as_str() {
            "raw" => Encoding::Raw,
            "gz" | "gzip" => Encoding::Gzip,
            "txt" | "text" | "ascii" => Encoding::Text,
            other => return Err(format!("the encoding {other}; raw, gzip and text are accepted")),
        };
        let is_big_endian = match self.get("endian").map(str::to_ascii_lowercase).as_deref() {
            Some("big") => true,
            Some("little") => false,
            _ if sample.bytes() == 1 || encoding == Encoding::Text => false,
            _ => return Err("the header has no field endian of big or little".to_owned()),
        };
        let channels = product(&sizes[..axes.first]);
        let frames = product(&sizes[axes.first + axes.count..]);
        let is_rgb = matches!(channels, 3 | 4) && axes.first == 1;
        Ok(Header {
            size: sizes[axes.first..][..axes.count].to_vec(),
            channels,
            is_colour: is_rgb && (axes.is_colour || sample == SampleType::U8),
            frames,
            sample,
            is_big_endian,
            encoding,
            skip: 0,
            scale: Scale::default(),
            geometry: self.geometry(&axes)?,
        })
    }

    fn geometry(&self, axes: &Axes) -> Result<Option<Geometry>, String> {
        let Some(directions) = &axes.directions else {
            return self.bare_spacing(axes);
        };
        let signs = match self.get("space").map(str::to_ascii_lowercase).as_deref() {
            Some("right-anterior-superior" | "ras") => [-1.0, -1.0, 1.0],
            Some("left-anterior-superior" | "las") => [1.0, -1.0, 1.0],
            Some(space) if space.ends_with("time") => {
                return Err(format!("the space {space}; spaces without time are accepted"));
            }
            _ => [1.0; 3],
        };
        let world = |vector: Vector| mirrored(vector, signs);
        let along = directions[axes.first..][..axes.count].iter().flatten();
        let along: Vec<Vector> = along.map(|&vector| world(vector)).collect();
        let origin = self.get("spaceorigin").map(vectors).transpose()?.unwrap_or_default();
        let origin = origin.first().copied().flatten().unwrap_or_default();
        Geometry::from_axes(&along, world(origin)).map(Some)
    }

    /// The distances between cells, if that is all there is.
    fn bare_spacing(&self, axes: &Axes) -> Result<Option<Geometry>, String> {
        let Some(given) = self.get("spacings") else { return Ok(None) };
        let given = numbers::<f64>("spacings", given)?;
        let mut spacing = [1.0; 3];
        for (axis, &given) in given.iter().skip(axes.first).take(axes.count).enumerate() {
            // Not a number: not known.
            spacing[axis] = if given.is_nan() { 1.0 } else { given.abs() };
        }
        Geometry::new(spacing, [0.0; 3], Placement::default().direction).map(Some)
    }

    /// The header and the data without the lines that are to be skipped, nor the bytes if their
    /// number is found from the end.
    fn skip<'d>(&self, header: Header, data: &'d [u8]) -> Result<(Header, &'d [u8]), String> {
        let count = |name| {
            let text = self.get(name).unwrap_or("0");
            text.parse::<i64>().map_err(|_| format!("{name}: {text:?} is not a number"))
        };
        let mut rest = data;
        let lines = count("lineskip")?;
        for line in 0..lines {
            let end = rest.iter().position(|&c| c == b'\n');
            let end =
                end.ok_or_else(|| format!("line skip is {lines}, but there are {line} lines"))?;
            rest = &rest[end + 1..];
        }
        let skip = match count("byteskip")? {
            // The data stand at the end.
            -1 if header.encoding == Encoding::Raw => {
                (rest.len() as u64).checked_sub(header.bytes()).ok_or_else(|| {
                    format!("the data end early: {} of {} are there", rest.len(), header.bytes())
                })?
            }
            bytes => u64::try_from(bytes).map_err(|_| format!("byteskip: {bytes} is negative"))?,
        };
        Ok((Header { skip, ..header }, rest))
    }
}

/// The type of the samples by one of its many names.
fn sample_type(name: &str) -> Result<SampleType, String> {
    Ok(match name.to_ascii_lowercase().as_str() {
        "signed char" | "int8" | "int8_t" => SampleType::I8,
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => SampleType::U8,
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => {
            SampleType::I16
        }
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => {
            SampleType::U16
        }
        "int" | "signed int" | "int32" | "int32_t" => SampleType::I32,
        "uint" | "unsigned int" | "uint32" | "uint32_t" => SampleType::U32,
        "longlong"
        | "long long"
        | "long long int"
        | "signed long long"
        | "signed long long int"
        | "int64"
        | "int64_t" => SampleType::I64,
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => {
            SampleType::U64
        }
        "float" => SampleType::F32,
        "double" => SampleType::F64,
        _ => return Err(format!("samples of type {name}; integers and floats are accepted")),
    })
}
