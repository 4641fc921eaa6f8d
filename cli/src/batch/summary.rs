//! All rows as a table.

use super::log::Record;
use crate::failure::Failure;
use heatpath_io::write_atomically;
use serde_json::Value;
use std::io::{self, Write};
use std::path::Path;

const COLUMNS: [&str; 11] = [
    "row",
    "name",
    "command",
    "status",
    "exit_code",
    "seconds",
    "input",
    "output",
    "curves",
    "length",
    "message",
];

/// What is compared with a truth, a column for each tolerance.
pub(super) const SCORES: [&str; 3] = ["recall", "precision", "f1"];

/// Writes the summary as CSV.
pub(super) fn write(path: &Path, records: &[Record]) -> Result<(), Failure> {
    Ok(write_atomically(path, true, |out| write_csv(out, records))?)
}

fn write_csv(out: &mut dyn Write, records: &[Record]) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let tolerances = tolerances(records);
    let scores = tolerances.iter().flat_map(|t| SCORES.map(|score| format!("{score}@{t}")));
    writer.write_record(COLUMNS.map(str::to_owned).into_iter().chain(scores))?;
    for record in records {
        let scores =
            tolerances.iter().flat_map(|tolerance| SCORES.map(|key| score(record, tolerance, key)));
        let scores = scores.map(|score| score.map(|score| score.to_string()).unwrap_or_default());
        writer.write_record(cells(record).into_iter().chain(scores))?;
    }
    writer.flush()
}

fn cells(record: &Record) -> [String; 11] {
    let file =
        |path: Option<&Path>| path.map(|path| path.display().to_string()).unwrap_or_default();
    let curves = lengths(record);
    [
        record.row.to_string(),
        record.name.clone(),
        record.command.clone(),
        record.status.name().to_owned(),
        record.exit_code.map(|code| code.to_string()).unwrap_or_default(),
        format!("{:.3}", record.seconds),
        file(record.inputs.first().map(|input| input.path.as_path())),
        file(record.outputs.first().map(|output| output.path.as_path())),
        curves.as_ref().map(|curves| curves.len().to_string()).unwrap_or_default(),
        curves.map(|curves| curves.iter().sum::<f64>().to_string()).unwrap_or_default(),
        record.message.clone(),
    ]
}

/// The physical lengths of the curves that a row found, if it was about curves.
pub(super) fn lengths(record: &Record) -> Option<Vec<f64>> {
    let paths = record.answer.get("paths")?.as_array()?;
    Some(paths.iter().filter_map(|path| path.get("physical_length")?.as_f64()).collect())
}

/// The tolerances of all rows, each once, in order, as they are written.
pub(super) fn tolerances(records: &[Record]) -> Vec<String> {
    let all = records.iter().flat_map(scores).filter_map(|score| score.get("tolerance")?.as_f64());
    let mut all: Vec<f64> = all.collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all.iter().map(f64::to_string).collect()
}

/// One score of a row.
pub(super) fn score(record: &Record, tolerance: &str, key: &str) -> Option<f64> {
    let is_meant =
        |score: &&Value| score["tolerance"].as_f64().is_some_and(|t| t.to_string() == tolerance);
    scores(record).iter().find(is_meant)?.get(key)?.as_f64()
}

/// One or several scores: of one tolerance there is no list.
fn scores(record: &Record) -> &[Value] {
    let of_evaluate = if record.command == "evaluate" { &record.answer } else { &record.scores };
    match of_evaluate {
        Value::Array(list) => list,
        Value::Null => &[],
        one => std::slice::from_ref(one),
    }
}
