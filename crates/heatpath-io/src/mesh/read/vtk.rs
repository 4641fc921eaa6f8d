//! Poly data of VTK, legacy.

use super::cursor::{Cursor, Kind, Order, excerpt, parse, truncated};
use super::{Found, Reading, push_strip, vertex};

/// The numbers after a keyword.
struct Data<'a> {
    cursor: Cursor<'a>,
    is_binary: bool,
}

/// Which cells a part of the file describes.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Polygons,
    Strips,
    Others,
}

pub(super) fn read(bytes: &[u8]) -> Reading {
    let mut cursor = Cursor::new(bytes);
    cursor.line();
    cursor.line();
    let is_binary = match cursor.word() {
        Some(b"ASCII") => false,
        Some(b"BINARY") => true,
        _ => return Err("the third line is neither ASCII nor BINARY".to_owned()),
    };
    let (mut data, mut found) = (Data { cursor, is_binary }, Found::default());
    let (mut is_of_points, mut tuples) = (false, 0);
    while let Some(keyword) = data.cursor.word() {
        match keyword {
            b"DATASET" => match data.word()? {
                b"POLYDATA" => {}
                other => return Err(format!("has a {}; POLYDATA is read", excerpt(other))),
            },
            b"POINTS" => {
                let (count, kind) = (data.count()?, data.kind()?);
                for _ in 0..count {
                    found.soup.push_point([data.next(kind)?, data.next(kind)?, data.next(kind)?]);
                }
            }
            b"POLYGONS" => cells(&mut data, Part::Polygons, &mut found)?,
            b"TRIANGLE_STRIPS" => cells(&mut data, Part::Strips, &mut found)?,
            b"VERTICES" | b"LINES" => cells(&mut data, Part::Others, &mut found)?,
            b"METADATA" => data.skip_paragraph(),
            b"POINT_DATA" | b"CELL_DATA" => {
                (is_of_points, tuples) = (keyword == b"POINT_DATA", data.count()?);
            }
            _ => {
                let arrays = attribute(&mut data, keyword, tuples)?;
                found.arrays.extend(arrays.into_iter().filter(|_| is_of_points));
            }
        }
    }
    Ok(found)
}

/// Cells: each as its count and its corners, or, since version 5, all their ends and all corners.
fn cells(data: &mut Data<'_>, part: Part, found: &mut Found) -> Result<(), String> {
    let [first, second] = [data.count()?, data.count_on_line()?];
    let is_new = data.cursor.clone().word() == Some(b"OFFSETS");
    let mut cells: Vec<Vec<u32>> = Vec::new();
    if is_new {
        let offsets = data.named_block(first)?;
        let corners = data.named_block(second)?;
        for ends in offsets.windows(2) {
            let [start, end] = [vertex(ends[0])?, vertex(ends[1])?].map(|end| end as usize);
            let corners = corners.get(start..end).ok_or("a cell ends before it starts")?;
            cells.push(corners.iter().map(|&number| vertex(number)).collect::<Result<_, _>>()?);
        }
    } else {
        for _ in 0..first {
            let count = vertex(data.next(Kind::I32)?)?;
            let corners = (0..count).map(|_| vertex(data.next(Kind::I32)?));
            cells.push(corners.collect::<Result<_, _>>()?);
        }
    }
    for cell in cells {
        match part {
            Part::Polygons => found.soup.push(cell),
            Part::Strips => push_strip(&mut found.soup, &cell),
            Part::Others => {}
        }
    }
    Ok(())
}

/// The arrays that begin with a keyword, those of one number a point; others are passed over.
fn attribute(
    data: &mut Data<'_>,
    keyword: &[u8],
    tuples: usize,
) -> Result<Vec<(String, Vec<f64>)>, String> {
    let name = data.word()?;
    match keyword {
        b"SCALARS" => {
            let kind = data.kind_before_more()?;
            let rest = data.cursor.line().unwrap_or_default().trim_ascii();
            let components = if rest.is_empty() { 1 } else { parse(rest)? };
            if data.cursor.clone().word() == Some(b"LOOKUP_TABLE") {
                data.cursor.line();
            }
            Ok(data.array(name, components, tuples, kind)?.into_iter().collect())
        }
        b"FIELD" => {
            let mut arrays = Vec::new();
            for _ in 0..data.count()? {
                if data.cursor.clone().word() == Some(b"METADATA") {
                    data.word()?;
                    data.skip_paragraph();
                }
                let (name, components, tuples) = (data.word()?, data.count()?, data.count()?);
                let kind = data.kind()?;
                arrays.extend(data.array(name, components, tuples, kind)?);
            }
            Ok(arrays)
        }
        _ => {
            let (components, kind) = match keyword {
                b"VECTORS" | b"NORMALS" => (3, data.kind()?),
                b"TENSORS" => (9, data.kind()?),
                b"GLOBAL_IDS" | b"PEDIGREE_IDS" => (1, data.kind()?),
                b"TEXTURE_COORDINATES" => (data.count()?, data.kind()?),
                b"COLOR_SCALARS" => (data.count_on_line()?, Kind::U8),
                b"LOOKUP_TABLE" => {
                    let entries = data.count_on_line()?;
                    return data.array(name, 4, entries, Kind::U8).map(|_| Vec::new());
                }
                _ => return Err(format!("expected a keyword, found {:?}", excerpt(keyword))),
            };
            data.array(name, components, tuples, kind).map(|_| Vec::new())
        }
    }
}

impl<'a> Data<'a> {
    fn word(&mut self) -> Result<&'a [u8], String> {
        self.cursor.word().ok_or_else(truncated)
    }

    fn count(&mut self) -> Result<usize, String> {
        self.cursor.number()
    }

    /// A type, the last word of its line.
    fn kind(&mut self) -> Result<Kind, String> {
        let kind = self.kind_before_more()?;
        self.end_line();
        Ok(kind)
    }

    /// A type that more words may follow.
    fn kind_before_more(&mut self) -> Result<Kind, String> {
        let name = self.word()?;
        Ok(match &name.to_ascii_lowercase()[..] {
            b"char" | b"signed_char" => Kind::I8,
            b"unsigned_char" => Kind::U8,
            b"short" => Kind::I16,
            b"unsigned_short" => Kind::U16,
            b"int" | b"vtkidtype" => Kind::I32,
            b"unsigned_int" => Kind::U32,
            b"long" | b"vtktypeint64" => Kind::I64,
            b"unsigned_long" | b"vtktypeuint64" => Kind::U64,
            b"float" => Kind::F32,
            b"double" => Kind::F64,
            _ => return Err(format!("has numbers of type {:?}", excerpt(name))),
        })
    }

    /// A count, the last word of its line.
    fn count_on_line(&mut self) -> Result<usize, String> {
        let count = self.count()?;
        self.end_line();
        Ok(count)
    }

    fn end_line(&mut self) {
        self.cursor.line();
    }

    /// Passes over the rest of this line and all lines up to an empty one.
    fn skip_paragraph(&mut self) {
        self.end_line();
        while self.cursor.line().is_some_and(|line| !line.trim_ascii().is_empty()) {}
    }

    /// The next number; binary ones are big-endian.
    fn next(&mut self, kind: Kind) -> Result<f64, String> {
        if self.is_binary { self.cursor.binary(kind, Order::Big) } else { self.cursor.number() }
    }

    fn numbers(&mut self, count: usize, kind: Kind) -> Result<Vec<f64>, String> {
        (0..count).map(|_| self.next(kind)).collect()
    }

    /// A block such as `OFFSETS vtktypeint64` and its numbers.
    fn named_block(&mut self, count: usize) -> Result<Vec<f64>, String> {
        self.word()?;
        let kind = self.kind()?;
        self.numbers(count, kind)
    }

    /// An array, if it has one number a tuple.
    fn array(
        &mut self,
        name: &[u8],
        components: usize,
        tuples: usize,
        kind: Kind,
    ) -> Result<Option<(String, Vec<f64>)>, String> {
        let count = components.checked_mul(tuples).ok_or_else(truncated)?;
        let values = self.numbers(count, kind)?;
        Ok((components == 1).then(|| (decoded(name), values)))
    }
}

/// A name without its escapes: spaces are written as `%20`.
fn decoded(name: &[u8]) -> String {
    let (mut plain, mut rest) = (Vec::new(), name);
    while let [first, tail @ ..] = rest {
        let code = tail.get(..2).and_then(|code| std::str::from_utf8(code).ok());
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) if *first == b'%' => {
                plain.push(byte);
                rest = &tail[2..];
            }
            _ => {
                plain.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&plain).into_owned()
}
