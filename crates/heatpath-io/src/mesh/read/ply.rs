//! PLY.

use super::cursor::{Cursor, Kind, Order, excerpt, parse, truncated};
use super::{Found, Reading, push_strip, vertex};

/// What the header says of one kind of things.
struct Element<'a> {
    name: &'a [u8],
    count: usize,
    properties: Vec<Property<'a>>,
}

struct Property<'a> {
    name: &'a [u8],
    /// The type of the number of entries, if this is a list.
    list: Option<Kind>,
    kind: Kind,
}

/// The numbers after the header: words, or binary in this order.
struct Numbers<'a> {
    cursor: Cursor<'a>,
    order: Option<Order>,
}

impl Numbers<'_> {
    fn next(&mut self, kind: Kind) -> Result<f64, String> {
        match self.order {
            Some(order) => self.cursor.binary(kind, order),
            None => self.cursor.number(),
        }
    }

    /// The entries of a list into `list`.
    fn list(&mut self, count: Kind, kind: Kind, list: &mut Vec<f64>) -> Result<(), String> {
        list.clear();
        let count = self.next(count)?;
        for _ in 0..count as u64 {
            list.push(self.next(kind)?);
        }
        Ok(())
    }
}

pub(super) fn read(bytes: &[u8]) -> Reading {
    let mut cursor = Cursor::new(bytes);
    let (elements, order) = header(&mut cursor)?;
    let (mut numbers, mut found) = (Numbers { cursor, order }, Found::default());
    for element in &elements {
        match element.name {
            b"vertex" => vertices(&mut numbers, element, &mut found)?,
            _ => lists(&mut numbers, element, &mut found)?,
        }
    }
    Ok(found)
}

fn header<'a>(cursor: &mut Cursor<'a>) -> Result<(Vec<Element<'a>>, Option<Order>), String> {
    let mut elements: Vec<Element<'_>> = Vec::new();
    let mut order = None;
    loop {
        let line = cursor.line().ok_or_else(truncated)?;
        let words: Vec<&[u8]> =
            line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
        match words[..] {
            [b"format", b"ascii", _] => order = None,
            [b"format", b"binary_little_endian", _] => order = Some(Order::Little),
            [b"format", b"binary_big_endian", _] => order = Some(Order::Big),
            [b"element", name, count] => {
                elements.push(Element { name, count: parse(count)?, properties: Vec::new() });
            }
            [b"property", ref words @ ..] => {
                let element = elements.last_mut().ok_or("a property before the first element")?;
                element.properties.push(property(words)?);
            }
            [] | [b"ply" | b"comment" | b"obj_info", ..] => {}
            [b"end_header"] => return Ok((elements, order)),
            _ => return Err(format!("the header has the line {:?}", excerpt(line))),
        }
    }
}

fn property<'a>(words: &[&'a [u8]]) -> Result<Property<'a>, String> {
    match *words {
        [b"list", count, of, name] => {
            Ok(Property { name, list: Some(kind(count)?), kind: kind(of)? })
        }
        [of, name] => Ok(Property { name, list: None, kind: kind(of)? }),
        _ => Err("the header has a property without a type or name".to_owned()),
    }
}

fn kind(name: &[u8]) -> Result<Kind, String> {
    Ok(match name {
        b"char" | b"int8" => Kind::I8,
        b"uchar" | b"uint8" => Kind::U8,
        b"short" | b"int16" => Kind::I16,
        b"ushort" | b"uint16" => Kind::U16,
        b"int" | b"int32" => Kind::I32,
        b"uint" | b"uint32" => Kind::U32,
        b"float" | b"float32" => Kind::F32,
        b"double" | b"float64" => Kind::F64,
        _ => return Err(format!("the header has the type {:?}", excerpt(name))),
    })
}

/// All numbers of an element's properties, in the order of the properties; lists are passed over.
fn columns(numbers: &mut Numbers<'_>, element: &Element<'_>) -> Result<Vec<Vec<f64>>, String> {
    let mut columns = vec![Vec::new(); element.properties.len()];
    if columns.is_empty() {
        return Ok(columns);
    }
    let mut list = Vec::new();
    for _ in 0..element.count {
        for (property, column) in element.properties.iter().zip(&mut columns) {
            match property.list {
                Some(count) => numbers.list(count, property.kind, &mut list)?,
                None => column.push(numbers.next(property.kind)?),
            }
        }
    }
    Ok(columns)
}

fn vertices(
    numbers: &mut Numbers<'_>,
    element: &Element<'_>,
    found: &mut Found,
) -> Result<(), String> {
    let columns = columns(numbers, element)?;
    let column =
        |name: &[u8]| element.properties.iter().position(|p| p.name == name && p.list.is_none());
    let axes = [column(b"x"), column(b"y"), column(b"z")];
    let [Some(x), Some(y), Some(z)] = axes.map(|axis| axis.map(|axis| &columns[axis])) else {
        return Err("the vertices have no x, y and z".to_owned());
    };
    for ((&x, &y), &z) in x.iter().zip(y).zip(z) {
        found.soup.push_point([x, y, z]);
    }
    let colours = [column(b"red"), column(b"green"), column(b"blue")];
    if let [Some(red), Some(green), Some(blue)] = colours {
        let channels = [red, green, blue];
        let part = |channel: usize, point: usize| match element.properties[channel].kind {
            Kind::F32 | Kind::F64 => (columns[channel][point] * 255.0).round() as u8,
            _ => columns[channel][point] as u8,
        };
        let colour = |point| channels.map(|channel| part(channel, point));
        found.colours = Some((0..columns[red].len()).map(colour).collect());
    }
    let special: Vec<usize> = axes.into_iter().chain(colours).flatten().collect();
    for (number, (property, values)) in element.properties.iter().zip(columns).enumerate() {
        if property.list.is_none() && !special.contains(&number) {
            let name = String::from_utf8_lossy(property.name).into_owned();
            found.arrays.push((name, values));
        }
    }
    Ok(())
}

/// Faces and strips; other elements are passed over.
fn lists(
    numbers: &mut Numbers<'_>,
    element: &Element<'_>,
    found: &mut Found,
) -> Result<(), String> {
    if element.properties.is_empty() {
        return Ok(());
    }
    let mut list = Vec::new();
    for _ in 0..element.count {
        for property in &element.properties {
            let Some(count) = property.list else {
                numbers.next(property.kind)?;
                continue;
            };
            numbers.list(count, property.kind, &mut list)?;
            match (element.name, property.name) {
                (b"face", b"vertex_indices" | b"vertex_index") => {
                    let corners = list.iter().map(|&number| vertex(number));
                    found.soup.push(corners.collect::<Result<Vec<_>, _>>()?);
                }
                (b"tristrips", _) => {
                    for strip in list.split(|&number| number == -1.0) {
                        let corners = strip.iter().map(|&number| vertex(number));
                        push_strip(&mut found.soup, &corners.collect::<Result<Vec<_>, _>>()?);
                    }
                }
                _ => {}
            }
        }
    }
    Ok(())
}
