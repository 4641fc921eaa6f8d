//! Values of vertices from files.

use super::cursor::{Cursor, Kind, Order};
use crate::ReadError;
use crate::decode::decode_vector;
use crate::picture::read_bytes;
use crate::points::{Trouble, excerpt, number};
use csv::{ReaderBuilder, Trim};
use std::path::Path;

/// Reads a value for each vertex; infinite ones and NaN are kept.
///
/// The content decides the format: an NPY array of shape (vertices,) or (vertices, 1); a curvature
/// file of `FreeSurfer`; or CSV with or without a header line, of which the `column` is read, or else
/// the last one, such as [`write_mesh_values`](crate::write_mesh_values) writes.
///
/// # Errors
/// The file cannot be read, has no such column, or an entry is no number; the message names its line.
pub fn read_mesh_values(
    path: impl AsRef<Path>,
    column: Option<&str>,
) -> Result<Vec<f64>, ReadError> {
    let path = path.as_ref();
    let bytes = read_bytes(path)?;
    let found = match &bytes[..] {
        [0x93, b'N', b'U', b'M', ..] => return decode_vector(&bytes, path),
        [0xff, 0xff, 0xff, ..] => curvature(&bytes).map_err(|e| ("the file".to_owned(), e)),
        _ => from_csv(&bytes, column),
    };
    let none = || ("the file".to_owned(), "has no values".to_owned());
    found
        .and_then(|values| if values.is_empty() { Err(none()) } else { Ok(values) })
        .map_err(|(place, reason)| ReadError::Points { path: path.to_owned(), place, reason })
}

/// The numbers of vertices and faces, that of values a vertex (1), and the values; all big-endian.
fn curvature(bytes: &[u8]) -> Result<Vec<f64>, String> {
    let mut cursor = Cursor::new(bytes);
    cursor.take(3)?;
    let mut next = |kind| cursor.binary(kind, Order::Big);
    let [vertices, _, values] = [next(Kind::U32)?, next(Kind::U32)?, next(Kind::U32)?];
    if values != 1.0 {
        return Err(format!("has {values} values a vertex; one is read"));
    }
    (0..vertices as u32).map(|_| next(Kind::F32)).collect()
}

fn from_csv(bytes: &[u8], column: Option<&str>) -> Result<Vec<f64>, Trouble> {
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .trim(Trim::All)
        .comment(Some(b'#'))
        .from_reader(bytes);
    let (mut values, mut place) = (Vec::new(), None);
    for record in reader.byte_records() {
        let record = record.map_err(|error| {
            let line = error.position().map_or(1, csv::Position::line);
            (format!("line {line}"), excerpt(&error.to_string()))
        })?;
        let Some(place) = place else {
            // The first line: a header, or numbers already.
            let named = record.iter().position(|cell| Some(cell) == column.map(str::as_bytes));
            place = Some(match (named, column) {
                (None, Some(name)) => {
                    return Err(("line 1".to_owned(), format!("no column is called {name:?}")));
                }
                (named, _) => named.unwrap_or(record.len() - 1),
            });
            values.extend(place.and_then(|place| number(&record[place])));
            continue;
        };
        let value = number(&record[place]).ok_or_else(|| {
            let line = record.position().map_or(0, csv::Position::line);
            let found = excerpt(&String::from_utf8_lossy(&record[place]));
            (format!("line {line}"), format!("expected a number, found {found:?}"))
        })?;
        values.push(value);
    }
    Ok(values)
}
