//! `MetaImage` of ITK: lines `Key = value`, of which the last one says where the numbers are.
//!
//! <https://itk.org/Wiki/MetaIO/Documentation>

use super::block::Encoding;
use super::{Header, Scale, numbers, product};
use crate::decode::{Input, Raster};
use crate::placement::{Geometry, Placement, Vector};
use crate::sample::SampleType;
use crate::{ReadError, memory};
use std::collections::HashMap;

/// The keys of which a file may have one in its first line.
const FIRST_KEYS: [&str; 3] = ["ObjectType", "NDims", "Comment"];

/// The key of the last line.
const LAST_KEY: &str = "ElementDataFile";

/// Whether the first line is one of a header.
pub(in crate::decode) fn is_meta_image(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(64)];
    let key = start.split(|&c| c == b'=').next().unwrap_or_default();
    key.len() < start.len() && FIRST_KEYS.iter().any(|first| key.trim_ascii() == first.as_bytes())
}

/// `.mha`, and `.mhd` with its data in one file or a list of files beside it; raw, compressed and
/// text.
pub(in crate::decode) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let broken = |reason: String| input.broken(reason);
    let (fields, rest) = Fields::parse(input.bytes).map_err(broken)?;
    let header = fields.header().map_err(broken)?;
    let place = fields.need(LAST_KEY).map_err(broken)?;
    let beside = match place.split_whitespace().next().unwrap_or_default() {
        "LOCAL" => None,
        "LIST" => Some(list(input, rest, &header)?),
        _ if place.contains('%') => {
            return Err(input.broken(format!("its data lie in {place}; one name is accepted")));
        }
        _ => Some(input.beside(place)?),
    };
    let data = beside.as_deref().unwrap_or(rest);
    let data = fields.skip(&header, data).map_err(broken)?;
    let is_gzip = header.encoding == Encoding::Zlib && data.starts_with(&[0x1f, 0x8b]);
    let encoding = if is_gzip { Encoding::Gzip } else { header.encoding };
    Header { encoding, ..header }.decode(input, data)
}

/// The content of all files of a list, one after another.
fn list(input: &Input<'_>, names: &[u8], header: &Header) -> Result<Vec<u8>, ReadError> {
    memory::check(input.path, header.bytes())?;
    let mut data = Vec::new();
    for name in names.split(|&c| c == b'\n').map(<[u8]>::trim_ascii) {
        if name.is_empty() || data.len() as u64 >= header.bytes() {
            break;
        }
        data.extend(input.beside(&String::from_utf8_lossy(name))?);
    }
    Ok(data)
}

/// The fields of a header; the last one of each name counts.
struct Fields<'a>(HashMap<&'a str, &'a str>);

impl<'a> Fields<'a> {
    /// With what follows the last line.
    fn parse(bytes: &'a [u8]) -> Result<(Self, &'a [u8]), String> {
        let mut fields = HashMap::new();
        let mut rest = bytes;
        while !rest.is_empty() && !fields.contains_key(LAST_KEY) {
            let end = rest.iter().position(|&c| c == b'\n').unwrap_or(rest.len() - 1) + 1;
            let (line, after) = rest.split_at(end);
            let line = str::from_utf8(line).map_err(|_| "the header is not text")?.trim();
            match line.split_once('=').map(|(key, value)| (key.trim(), value.trim())) {
                Some(("ObjectType", kind)) if kind != "Image" => {
                    return Err(format!("it holds a {kind}, no Image"));
                }
                Some((key, value)) => drop(fields.insert(key, value)),
                None if line.is_empty() => {}
                None => return Err(format!("the header line {line:?} has no =")),
            }
            rest = after;
        }
        Ok((Self(fields), rest))
    }

    fn get(&self, names: &[&str]) -> Option<&'a str> {
        names.iter().find_map(|name| self.0.get(name).copied())
    }

    fn need(&self, name: &str) -> Result<&'a str, String> {
        self.get(&[name]).ok_or_else(|| format!("the header has no {name}"))
    }

    fn is_true(&self, names: &[&str]) -> bool {
        self.get(names).is_some_and(|value| value.starts_with(['T', 't', '1', 'Y', 'y']))
    }

    fn number<T: std::str::FromStr + Copy>(&self, name: &str, usual: T) -> Result<T, String> {
        let Some(text) = self.get(&[name]) else { return Ok(usual) };
        numbers(name, text)?.first().copied().ok_or_else(|| format!("{name} has no value"))
    }

    fn header(&self) -> Result<Header, String> {
        let sizes = numbers::<u64>("DimSize", self.need("DimSize")?)?;
        if !matches!(sizes.len(), 2..=4) {
            return Err(format!("{} axes; 2, 3 or 4 are accepted", sizes.len()));
        }
        let space = sizes.len().min(3);
        let channels = self.number("ElementNumberOfChannels", 1)?;
        let sample = sample_type(self.need("ElementType")?)?;
        let is_text = self.get(&["BinaryData"]).is_some_and(|_| !self.is_true(&["BinaryData"]));
        let encoding = match self.is_true(&["CompressedData"]) {
            true => Encoding::Zlib,
            false if is_text => Encoding::Text,
            false => Encoding::Raw,
        };
        Ok(Header {
            size: sizes[..space].to_vec(),
            channels,
            is_colour: matches!(channels, 3 | 4) && sample == SampleType::U8,
            frames: product(&sizes[space..]),
            sample,
            is_big_endian: self.is_true(&["ElementByteOrderMSB", "BinaryDataByteOrderMSB"]),
            encoding,
            skip: 0,
            scale: Scale::default(),
            geometry: Some(self.geometry(sizes.len())?),
        })
    }

    /// The matrix has a row for each axis of the image.
    fn geometry(&self, axes: usize) -> Result<Geometry, String> {
        let space = axes.min(3);
        let list = |names: &[&str], count: usize| -> Result<Option<Vec<f64>>, String> {
            let Some(text) = self.get(names) else { return Ok(None) };
            let values = numbers::<f64>(names[0], text)?;
            let (name, found) = (names[0], values.len());
            let message = format!("{name} has {found} numbers where {count} are needed");
            if found == count { Ok(Some(values)) } else { Err(message) }
        };
        let mut spacing = [1.0; 3];
        let mut origin: Vector = [0.0; 3];
        let mut direction = Placement::default().direction;
        if let Some(given) = list(&["ElementSpacing", "ElementSize"], axes)? {
            spacing[..space].copy_from_slice(&given[..space]);
        }
        if let Some(given) = list(&["Offset", "Position", "Origin"], axes)? {
            origin[..space].copy_from_slice(&given[..space]);
        }
        if let Some(given) = list(&["TransformMatrix", "Rotation", "Orientation"], axes * axes)? {
            for (axis, row) in given.chunks(axes).take(space).enumerate() {
                direction[axis][..space].copy_from_slice(&row[..space]);
            }
        }
        Geometry::new(spacing, origin, direction)
    }

    /// The data without a header of their own.
    fn skip<'d>(&self, header: &Header, data: &'d [u8]) -> Result<&'d [u8], String> {
        let (size, found) = (self.number::<i64>("HeaderSize", 0)?, data.len());
        let start = match size {
            // The data stand at the end.
            -1 => (found as u64).checked_sub(header.bytes()),
            size => u64::try_from(size).ok(),
        };
        let start = start.and_then(|start| usize::try_from(start).ok());
        let (start, needed) = (start.and_then(|start| data.get(start..)), header.bytes());
        start.ok_or_else(|| {
            format!("HeaderSize = {size}, but there are {found} bytes, of which {needed} are data")
        })
    }
}

fn sample_type(name: &str) -> Result<SampleType, String> {
    Ok(match name.trim_end_matches("_ARRAY") {
        "MET_CHAR" | "MET_ASCII_CHAR" => SampleType::I8,
        "MET_UCHAR" => SampleType::U8,
        "MET_SHORT" => SampleType::I16,
        "MET_USHORT" => SampleType::U16,
        "MET_INT" | "MET_LONG" => SampleType::I32,
        "MET_UINT" | "MET_ULONG" => SampleType::U32,
        "MET_LONG_LONG" => SampleType::I64,
        "MET_ULONG_LONG" => SampleType::U64,
        "MET_FLOAT" => SampleType::F32,
        "MET_DOUBLE" => SampleType::F64,
        _ => return Err(format!("samples of type {name}; integers and floats are accepted")),
    })
}
