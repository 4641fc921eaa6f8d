//! What the page shows of a row.

use crate::batch::files::Stamp;
use crate::batch::log::Record;
use crate::batch::summary::{SCORES, lengths, score};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use heatpath_io::thumbnail;
use humantime::format_rfc3339_seconds;
use serde::Serialize;
use serde_json::Value;
use std::path::Path;
use std::time::{Duration, UNIX_EPOCH};

/// The longest side of a picture on the page, in pixels.
const LONGEST: u32 = 560;

/// As many curves of a row are listed one by one.
const MOST_CURVES: usize = 12;

/// What the page shows of a row.
#[derive(Serialize)]
pub(super) struct Entry {
    row: usize,
    name: String,
    command: String,
    status: &'static str,
    seconds: String,
    curves: String,
    length: String,
    /// Of all tolerances of the page.
    scores: Vec<String>,
    message: String,
    pictures: Vec<Picture>,
    facts: Vec<(String, String)>,
    paths: Vec<Curve>,
    /// How many more there are.
    more_paths: usize,
    command_line: String,
}

#[derive(Serialize)]
struct Picture {
    caption: String,
    width: u32,
    height: u32,
    /// A JPEG in base64.
    data: String,
}

/// A curve in a list.
#[derive(Serialize)]
struct Curve {
    length: String,
    physical_length: String,
    distance: String,
    ended: String,
}

impl Entry {
    pub(super) fn new(record: &Record, folder: &Path, tolerances: &[String]) -> Self {
        let lengths = lengths(record);
        let all_scores = tolerances.iter().flat_map(|t| SCORES.map(|key| score(record, t, key)));
        let none: &[Value] = &[];
        let paths =
            record.answer.get("paths").and_then(Value::as_array).map_or(none, Vec::as_slice);
        Self {
            row: record.row,
            name: record.name.clone(),
            command: record.command.clone(),
            status: record.status.name(),
            seconds: format!("{:.2}", record.seconds),
            curves: lengths.as_ref().map(|lengths| lengths.len().to_string()).unwrap_or_default(),
            length: lengths.map(|lengths| number(lengths.iter().sum())).unwrap_or_default(),
            scores: all_scores.map(|score| score.map(number).unwrap_or_default()).collect(),
            message: record.message.clone(),
            pictures: record.outputs.iter().filter_map(|file| picture(file, folder)).collect(),
            facts: facts(record),
            paths: paths.iter().take(MOST_CURVES).map(curve).collect(),
            more_paths: paths.len().saturating_sub(MOST_CURVES),
            command_line: command_line(&record.arguments),
        }
    }
}

/// A number for eyes, with four digits or so.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        _ if !value.is_finite() => String::new(),
        1000.0.. => format!("{value:.0}"),
        10.0.. => format!("{value:.1}"),
        _ => format!("{value:.3}"),
    }
}

/// What can be shown of an output; tables and curves cannot.
fn picture(file: &Stamp, folder: &Path) -> Option<Picture> {
    file.bytes?;
    let small = thumbnail(folder.join(&file.path), LONGEST).ok()?;
    let [width, height] = small.size;
    let data = BASE64_STANDARD.encode(small.jpeg);
    Some(Picture { caption: file.path.display().to_string(), width, height, data })
}

/// The single values of the answer, and the files.
fn facts(record: &Record) -> Vec<(String, String)> {
    let answer = record.answer.as_object().into_iter().flatten();
    let mut facts: Vec<(String, String)> = answer
        .filter(|(key, _)| *key != "version")
        .filter_map(|(key, value)| Some((key.replace('_', " "), single(value)?)))
        .collect();
    let files = |key: &str, files: &[Stamp]| -> Vec<(String, String)> {
        files.iter().map(|file| (key.to_owned(), file_in_words(file))).collect()
    };
    facts.extend(files("input", &record.inputs));
    facts.extend(files("output", &record.outputs));
    let finished = UNIX_EPOCH + Duration::from_secs_f64(record.finished.max(0.0));
    facts.push(("finished".to_owned(), format_rfc3339_seconds(finished).to_string()));
    facts
}

/// A number or a word, or a few of them, such as a size.
fn single(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Number(whole) if !whole.is_f64() => Some(whole.to_string()),
        Value::Number(value) => value.as_f64().map(number),
        Value::Array(list) if (1..=3).contains(&list.len()) => {
            Some(list.iter().map(single).collect::<Option<Vec<_>>>()?.join(" x "))
        }
        _ => None,
    }
}

fn file_in_words(file: &Stamp) -> String {
    let path = file.path.display();
    match file.bytes {
        Some(bytes) => format!("{path} ({bytes} bytes)"),
        None => format!("{path} (missing)"),
    }
}

fn curve(path: &Value) -> Curve {
    let value = |key: &str| path.get(key).and_then(Value::as_f64).map(number).unwrap_or_default();
    Curve {
        length: value("length"),
        physical_length: value("physical_length"),
        distance: value("distance"),
        ended: path.get("ended").and_then(Value::as_str).unwrap_or_default().replace('_', " "),
    }
}

/// The command line as a shell takes it.
fn command_line(arguments: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=+,./:@%".contains(c);
    let quoted = arguments.iter().map(|argument| {
        if !argument.is_empty() && argument.chars().all(plain) {
            argument.clone()
        } else {
            format!("'{}'", argument.replace('\'', "'\\''"))
        }
    });
    ["heatpath".to_owned()].into_iter().chain(quoted).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn command_lines_can_be_pasted() {
        let arguments = ["path", "--source=1,2", "a b.png", "it's", ""].map(str::to_owned);
        assert_eq!(command_line(&arguments), "heatpath path --source=1,2 'a b.png' 'it'\\''s' ''");
    }

    #[test]
    fn numbers_are_short() {
        let cases = [(0.12345, "0.123"), (12.345, "12.3"), (-1234.5, "-1234"), (f64::NAN, "")];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
