//! Curves from files: JSON, CSV and SWC.

use crate::picture::read_bytes;
use crate::points::{AXES, Trouble, excerpt, number};
use crate::swc;
use crate::{Placement, ReadError};
use csv::ReaderBuilder;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Curves of a file that says itself whether they lie in a picture or in a volume.
///
/// The content decides the format. JSON is what [`write_curves`](crate::write_curves) and
/// [`write_graph`](crate::write_graph) write: an object with a list `paths`, of which
/// each has `points`. CSV has a header line that names `x`, `y` and, in volumes, `z`; rows of another
/// `path` than those before begin a new curve. Lines of seven numbers are SWC, in physical units.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFile {
    path: PathBuf,
    curves: Vec<Vec<[f64; 3]>>,
    dimensions: &'static [usize],
    is_physical: bool,
}

impl CurveFile {
    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read, or holds no curves; the message names the line or the entry.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        Self::from_bytes(&read_bytes(path.as_ref())?, path)
    }

    /// [`read`](Self::read) of a file whose content is `bytes`; `name` stands in messages.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn from_bytes(bytes: &[u8], name: impl AsRef<Path>) -> Result<Self, ReadError> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let path = name.as_ref().to_owned();
        let read = match bytes.trim_ascii_start().first() {
            None => Err(("the file".to_owned(), "is empty".to_owned())),
            Some(b'[' | b'{') => from_json(bytes),
            Some(_) if is_swc(bytes) => swc::read(bytes).map(|curves| {
                let is_flat = curves.iter().flatten().all(|point| point[2] == 0.0);
                (curves, if is_flat { &[2, 3][..] } else { &[3] })
            }),
            Some(_) => from_csv(bytes),
        };
        let is_physical = is_swc(bytes);
        match read {
            Ok((curves, dimensions)) => Ok(Self { path, curves, dimensions, is_physical }),
            Err((place, reason)) => Err(ReadError::Points { path, place, reason }),
        }
    }

    /// The dimensions in which the curves can be read, the likelier one first: 2 in a picture, 3 in a
    /// volume. Both for SWC whose points all have z = 0.
    #[must_use]
    pub fn dimensions(&self) -> &'static [usize] {
        self.dimensions
    }

    /// The curves in pixel coordinates of a grid with the given spacing, for SWC also at the given
    /// place; without one the first cell is at 0.
    ///
    /// # Errors
    /// They have another dimension, or lie outside of a picture's plane.
    pub fn into_polylines<const D: usize>(
        self,
        spacing: [f64; D],
        placement: Option<Placement>,
    ) -> Result<Vec<Vec<[f64; D]>>, ReadError> {
        let trouble = |reason: String| {
            let (path, place) = (self.path.clone(), "the file".to_owned());
            ReadError::Points { path, place, reason }
        };
        if !self.dimensions.contains(&D) {
            let words = |d: usize| if d == 2 { "a picture" } else { "a volume" };
            let [found, needed] = [self.dimensions[0], D].map(words);
            return Err(trouble(format!("lies in {found}, not in {needed}")));
        }
        let placement = placement.unwrap_or_default();
        let point = |point: &[f64; 3]| {
            let point = std::array::from_fn(|axis| point[axis]);
            if self.is_physical { placement.to_pixels(point, spacing) } else { Some(point) }
        };
        let curve = |curve: &Vec<[f64; 3]>| curve.iter().map(point).collect::<Option<Vec<_>>>();
        let curves: Option<Vec<_>> = self.curves.iter().map(curve).collect();
        curves.ok_or_else(|| trouble("lies outside of the picture's plane".to_owned()))
    }
}

/// Curves and the dimensions that they can have.
type Found = (Vec<Vec<[f64; 3]>>, &'static [usize]);

/// Whether the first line that is no comment has seven cells, all numbers.
fn is_swc(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|&c| c == b'\n').map(<[u8]>::trim_ascii);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with(b"#")).unwrap_or_default();
    let cells = first.split(u8::is_ascii_whitespace).filter(|cell| !cell.is_empty());
    cells.clone().count() == 7 && cells.clone().all(|cell| number(cell).is_some())
}

fn the_file(reason: &str) -> Trouble {
    ("the file".to_owned(), reason.to_owned())
}

fn from_json(bytes: &[u8]) -> Result<Found, Trouble> {
    let value: Value = serde_json::from_slice(bytes)
        .map_err(|error| (format!("line {}", error.line()), format!("not valid JSON: {error}")))?;
    let list = value.get("paths").and_then(Value::as_array);
    let list = list.ok_or_else(|| the_file("expected an object with a list named \"paths\""))?;
    let first = list.iter().find_map(|curve| curve.get("points")?.get(0)?.as_array());
    let given = value.get("dimension").and_then(Value::as_u64);
    let dimensions: &[usize] = match given.or(first.map(|point| point.len() as u64)) {
        Some(2) => &[2],
        Some(3) => &[3],
        None if list.is_empty() => &[2, 3],
        _ => return Err(the_file("expected points of two or three numbers")),
    };
    let curve = |(i, curve): (usize, &Value)| {
        let points = curve.get("points").and_then(Value::as_array);
        let found = points?.iter().map(|point| json_point(point, dimensions[0]));
        Some(found.collect::<Option<Vec<_>>>().ok_or(i))
    };
    let curves = list.iter().enumerate().map(|(i, entry)| {
        curve((i, entry)).unwrap_or(Err(i)).map_err(|i| {
            let reason = format!("expected \"points\", each {} numbers", dimensions[0]);
            (format!("curve {i}"), reason)
        })
    });
    Ok((curves.collect::<Result<_, _>>()?, dimensions))
}

fn json_point(point: &Value, dimension: usize) -> Option<[f64; 3]> {
    let numbers = point.as_array().filter(|numbers| numbers.len() == dimension)?;
    let mut point = [0.0; 3];
    for (coordinate, number) in point.iter_mut().zip(numbers) {
        *coordinate = number.as_f64().filter(|number| number.is_finite())?;
    }
    Some(point)
}

fn from_csv(bytes: &[u8]) -> Result<Found, Trouble> {
    let mut reader =
        ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(bytes);
    let broken = |error: csv::Error| {
        let line = error.position().map_or(1, csv::Position::line);
        (format!("line {line}"), excerpt(&error.to_string()))
    };
    let header = reader.byte_headers().map_err(broken)?.clone();
    let column =
        |name: &str| header.iter().position(|cell| cell.eq_ignore_ascii_case(name.as_bytes()));
    let (Some(x), Some(y)) = (column("x"), column("y")) else {
        return Err(the_file(
            "no curves (JSON, CSV with a header line that names x and y, SWC) and no mask",
        ));
    };
    let columns: Vec<usize> = [x, y].into_iter().chain(column("z")).collect();
    let mut curves: Vec<Vec<[f64; 3]>> = Vec::new();
    let mut name: Option<Vec<u8>> = None;
    for record in reader.byte_records() {
        let record = record.map_err(broken)?;
        let mut point = [0.0; 3];
        for (axis, &column) in columns.iter().enumerate() {
            let value = number(&record[column]).filter(|value| value.is_finite());
            point[axis] = value.ok_or_else(|| {
                let line = record.position().map_or(0, csv::Position::line);
                let found = excerpt(&String::from_utf8_lossy(&record[column]));
                let reason =
                    format!("expected a finite number for {}, found {found:?}", AXES[axis]);
                (format!("line {line}"), reason)
            })?;
        }
        let own = column("path").map_or_else(Vec::new, |path| record[path].to_vec());
        if name.as_ref() != Some(&own) {
            curves.push(Vec::new());
            name = Some(own);
        }
        curves.last_mut().into_iter().for_each(|curve| curve.push(point));
    }
    Ok((curves, if columns.len() == 3 { &[3] } else { &[2] }))
}
