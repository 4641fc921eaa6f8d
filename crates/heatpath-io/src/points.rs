//! Lists of points from files: sources and ends.

use crate::ReadError;
use crate::picture::read_bytes;
use csv::{ByteRecord, ReaderBuilder, Trim};
use serde_json::Value;
use std::path::Path;

/// The names of the coordinates.
pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];

/// Why an entry is no point, and where it stands.
pub(crate) type Trouble = (String, String);

/// Reads points in pixel coordinates.
///
/// The content decides the format. Text that begins with a bracket or a brace is JSON:
/// `[[x, y], ...]`, `[{"x": x, "y": y}, ...]` or either of these as `{"points": ...}`. All else is
/// CSV: two columns x and y, or any columns under a header line that names `x` and `y`; lines that
/// begin with `#` are comments. In volumes a third number, `z`, follows.
///
/// # Errors
/// The file cannot be read, holds no points, or an entry is not as many finite numbers; the
/// message names its line (counted from 1) or its place in the JSON list (from 0).
pub fn read_points<const D: usize>(path: impl AsRef<Path>) -> Result<Vec<[f64; D]>, ReadError> {
    read_points_from_bytes(&read_bytes(path.as_ref())?, path)
}

/// [`read_points`] of a file whose content is `bytes`; `name` stands in messages.
///
/// # Errors
/// As [`read_points`].
pub fn read_points_from_bytes<const D: usize>(
    bytes: &[u8],
    name: impl AsRef<Path>,
) -> Result<Vec<[f64; D]>, ReadError> {
    // Some editors put a byte order mark first.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let points = match bytes.trim_ascii_start().first() {
        None => Ok(Vec::new()),
        Some(b'[' | b'{') => from_json(bytes),
        Some(_) => from_csv(bytes),
    };
    let no_points = || ("the file".to_owned(), "has no points".to_owned());
    points.and_then(|points| if points.is_empty() { Err(no_points()) } else { Ok(points) }).map_err(
        |(place, reason)| ReadError::Points { path: name.as_ref().to_owned(), place, reason },
    )
}

// === JSON

fn from_json<const D: usize>(bytes: &[u8]) -> Result<Vec<[f64; D]>, Trouble> {
    let value: Value = serde_json::from_slice(bytes)
        .map_err(|error| (format!("line {}", error.line()), format!("not valid JSON: {error}")))?;
    let list = value.get("points").unwrap_or(&value).as_array().ok_or_else(|| {
        let reason = "expected a list of points, or an object with a list named \"points\"";
        ("the file".to_owned(), reason.to_owned())
    })?;
    list.iter()
        .enumerate()
        .map(|(i, entry)| json_point(entry).ok_or_else(|| json_trouble::<D>(i, entry)))
        .collect()
}

fn json_point<const D: usize>(entry: &Value) -> Option<[f64; D]> {
    let numbers: Option<Vec<f64>> = match entry {
        Value::Array(numbers) => numbers.iter().map(Value::as_f64).collect(),
        _ => AXES[..D].iter().map(|&axis| entry.get(axis)?.as_f64()).collect(),
    };
    numbers?.try_into().ok()
}

fn json_trouble<const D: usize>(i: usize, entry: &Value) -> Trouble {
    let found = excerpt(&entry.to_string());
    let named: Vec<_> = AXES[..D].iter().map(|axis| format!("\"{axis}\": {axis}")).collect();
    let (list, object) = (AXES[..D].join(", "), named.join(", "));
    (format!("entry {i}"), format!("expected [{list}] or {{{object}}}, found {found}"))
}

// === CSV

fn from_csv<const D: usize>(bytes: &[u8]) -> Result<Vec<[f64; D]>, Trouble> {
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .comment(Some(b'#'))
        .from_reader(bytes);
    let (mut points, mut columns) = (Vec::new(), None);
    for record in reader.byte_records() {
        let record = record.map_err(|error| ("the file".to_owned(), error.to_string()))?;
        if record.len() == 1 && record[0].is_empty() {
            continue;
        }
        let start = record.position().map_or(0, csv::Position::byte) as usize;
        let place = |reason| (format!("line {}", line_number(bytes, start)), reason);
        if columns.is_none() && is_header(&record) {
            columns = Some(header::<D>(&record).map_err(place)?);
            continue;
        }
        let columns =
            columns.get_or_insert(Columns { of: std::array::from_fn(|axis| axis), exact: true });
        points.push(csv_point(&record, columns).map_err(place)?);
    }
    Ok(points)
}

/// The number of the first line from `start` on that is neither empty nor a comment.
fn line_number(bytes: &[u8], start: usize) -> usize {
    let (before, rest) = bytes.split_at(start.min(bytes.len()));
    let mut lines = rest.split(|&c| c == b'\n');
    let skipped = lines
        .position(|line| !line.starts_with(b"#") && !line.trim_ascii().is_empty())
        .unwrap_or(0);
    1 + before.iter().filter(|&&c| c == b'\n').count() + skipped
}

/// Where the coordinates stand.
struct Columns<const D: usize> {
    of: [usize; D],
    /// Whether there must be no other columns.
    exact: bool,
}

/// A first line without any number is a header.
fn is_header(record: &ByteRecord) -> bool {
    record.iter().all(|cell| number(cell).is_none())
}

fn header<const D: usize>(record: &ByteRecord) -> Result<Columns<D>, String> {
    let column =
        |name: &&str| record.iter().position(|cell| cell.eq_ignore_ascii_case(name.as_bytes()));
    let columns: Option<Vec<usize>> = AXES[..D].iter().map(column).collect();
    match columns.and_then(|columns| columns.try_into().ok()) {
        Some(of) => Ok(Columns { of, exact: false }),
        None => Err(format!(
            "expected {} or a header line with columns {}, found {}",
            numbers::<D>(),
            AXES[..D].join(" and "),
            text(record)
        )),
    }
}

/// What a line without a header must be.
fn numbers<const D: usize>() -> String {
    format!("{} numbers {}", if D == 2 { "two" } else { "three" }, AXES[..D].join(","))
}

fn csv_point<const D: usize>(
    record: &ByteRecord,
    columns: &Columns<D>,
) -> Result<[f64; D], String> {
    if columns.exact && record.len() != D {
        return Err(format!("expected {}, found {}", numbers::<D>(), text(record)));
    }
    let mut point = [0.0; D];
    for (axis, coordinate) in point.iter_mut().enumerate() {
        let cell = record.get(columns.of[axis]).unwrap_or_default();
        let found = || excerpt(&String::from_utf8_lossy(cell));
        *coordinate = number(cell).filter(|value| value.is_finite()).ok_or_else(|| {
            format!("expected a finite number for {}, found \"{}\"", AXES[axis], found())
        })?;
    }
    Ok(point)
}

pub(crate) fn number(cell: &[u8]) -> Option<f64> {
    str::from_utf8(cell).ok()?.parse().ok()
}

fn text(record: &ByteRecord) -> String {
    let cells: Vec<_> = record.iter().map(String::from_utf8_lossy).collect();
    format!("\"{}\"", excerpt(&cells.join(",")))
}

/// The beginning of a text that may be long, on one line.
pub(crate) fn excerpt(text: &str) -> String {
    let line = text.replace(char::is_control, " ");
    match line.char_indices().nth(40) {
        None => line,
        Some((cut, _)) => format!("{}...", &line[..cut]),
    }
}
