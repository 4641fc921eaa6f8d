//! Poly data of VTK, XML.

use super::cursor::{Kind, Order, truncated};
use super::xml_data::{DataArray, Storage};
use super::{Found, Reading, push_strip, vertex};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// A part of the mesh: its arrays, each with the name of the section in which it stands.
#[derive(Default)]
struct Piece {
    arrays: Vec<(String, DataArray)>,
}

/// The tags are read up to the appended data, which need not be XML; then the arrays.
pub(super) fn read(bytes: &[u8]) -> Reading {
    let mut storage = Storage::new(bytes.len());
    let pieces = tags(bytes, &mut storage)?;
    let mut found = Found::default();
    for (number, piece) in pieces.iter().enumerate() {
        add_piece(piece, &mut storage, &mut found, number == 0)?;
    }
    Ok(found)
}

fn tags<'a>(bytes: &'a [u8], storage: &mut Storage<'a>) -> Result<Vec<Piece>, String> {
    let mut reader = Reader::from_reader(bytes);
    let (mut pieces, mut section, mut is_in_array) = (Vec::<Piece>::new(), String::new(), false);
    loop {
        let event = reader.read_event().map_err(|error| error.to_string())?;
        let is_empty = matches!(event, Event::Empty(_));
        match event {
            Event::Start(tag) | Event::Empty(tag) => match tag.name().as_ref() {
                "VTKFile" => read_storage(&tag, storage)?,
                "AppendedData" => {
                    storage.appended_is_base64 =
                        attribute(&tag, "encoding").as_deref() != Some("raw");
                    let rest = &bytes[reader.buffer_position() as usize..];
                    let start = rest.iter().position(|&c| c == b'_').ok_or_else(truncated)?;
                    storage.appended = &rest[start + 1..];
                    return Ok(pieces);
                }
                "Piece" => pieces.push(Piece::default()),
                name @ ("Points" | "PointData" | "Polys" | "Strips") => section = name.to_owned(),
                "DataArray" => {
                    if let Some(piece) = pieces.last_mut().filter(|_| !section.is_empty()) {
                        piece.arrays.push((section.clone(), data_array(&tag)?));
                        is_in_array = !is_empty;
                    }
                }
                _ => is_in_array = false,
            },
            Event::Text(text) if is_in_array => {
                let array = pieces.last_mut().and_then(|piece| piece.arrays.last_mut());
                array.into_iter().for_each(|(_, array)| array.text.extend(text.as_bytes()));
            }
            Event::End(tag) => {
                is_in_array = false;
                if tag.name().as_ref() == section {
                    section.clear();
                }
                if tag.name().as_ref() == "VTKFile" {
                    return Ok(pieces);
                }
            }
            Event::Eof => return Err(truncated()),
            _ => {}
        }
    }
}

fn attribute(tag: &BytesStart<'_>, name: &str) -> Option<String> {
    let value = tag.try_get_attribute(name).ok()??.value;
    Some(value.into_owned())
}

fn read_storage(tag: &BytesStart<'_>, storage: &mut Storage<'_>) -> Result<(), String> {
    if attribute(tag, "type").as_deref() != Some("PolyData") {
        return Err("is no poly data".to_owned());
    }
    if attribute(tag, "byte_order").as_deref() == Some("BigEndian") {
        storage.order = Order::Big;
    }
    if attribute(tag, "header_type").as_deref() == Some("UInt64") {
        storage.header = Kind::U64;
    }
    match attribute(tag, "compressor").as_deref() {
        None => Ok(()),
        Some("vtkZLibDataCompressor") => {
            storage.is_compressed = true;
            Ok(())
        }
        Some(other) => Err(format!("is compressed by {other}; vtkZLibDataCompressor is read")),
    }
}

fn data_array(tag: &BytesStart<'_>) -> Result<DataArray, String> {
    let text = |name| attribute(tag, name).unwrap_or_default();
    let number = |name, usual| match attribute(tag, name) {
        None => Ok(usual),
        Some(text) => text.trim().parse().map_err(|_| format!("has a count of {text:?}")),
    };
    Ok(DataArray {
        name: text("Name"),
        kind: text("type"),
        components: number("NumberOfComponents", 1)?,
        format: text("format"),
        offset: number("offset", 0)?,
        text: Vec::new(),
    })
}

/// Adds a piece; point arrays that the pieces before do not have are left out at the end.
fn add_piece(
    piece: &Piece,
    storage: &mut Storage<'_>,
    found: &mut Found,
    is_first: bool,
) -> Result<(), String> {
    let before = found.soup.points().len() as f64;
    let section = |name: &'static str| {
        piece.arrays.iter().filter(move |(section, _)| section == name).map(|(_, array)| array)
    };
    for points in section("Points").take(1) {
        let numbers = storage.numbers(points)?;
        numbers.chunks_exact(3).for_each(|p| found.soup.push_point([p[0], p[1], p[2]]));
    }
    for (name, is_strip) in [("Polys", false), ("Strips", true)] {
        let array = |part: &str| section(name).find(|array| array.name == part);
        let (Some(corners), Some(ends)) = (array("connectivity"), array("offsets")) else {
            continue;
        };
        let (corners, ends) = (storage.numbers(corners)?, storage.numbers(ends)?);
        let mut start = 0;
        for end in ends {
            let end = vertex(end)? as usize;
            let cell = corners.get(start..end).ok_or("a cell ends before it starts")?;
            let cell: Vec<u32> =
                cell.iter().map(|&number| vertex(number + before)).collect::<Result<_, _>>()?;
            if is_strip {
                push_strip(&mut found.soup, &cell);
            } else {
                found.soup.push(cell);
            }
            start = end;
        }
    }
    for array in
        section("PointData").filter(|array| array.components == 1 && array.kind != "String")
    {
        let values = storage.numbers(array)?;
        match found.arrays.iter_mut().find(|(name, _)| *name == array.name) {
            Some((_, known)) => known.extend(values),
            None if is_first => found.arrays.push((array.name.clone(), values)),
            None => {}
        }
    }
    Ok(())
}
