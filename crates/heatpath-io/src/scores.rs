//! How well curves agree with a truth, to files: JSON and CSV.

use crate::WriteError;
use crate::output::{known_format, write_atomically};
use heatpath_core::evaluation::{Evaluation, Score};
use serde::Serialize;
use std::path::Path;

/// The endings by which [`write_scores`] chooses a format.
pub const SCORE_ENDINGS: [&str; 2] = ["json", "csv"];

/// The layout of a score in JSON, and the columns of CSV.
#[derive(Serialize)]
struct Entry {
    tolerance: f64,
    recall: f64,
    precision: f64,
    f1: f64,
    truth_length: f64,
    extracted_length: f64,
    truth_mean_distance: f64,
    truth_largest_distance: f64,
    extracted_mean_distance: f64,
    extracted_largest_distance: f64,
}

/// Writes scores in the given format, or else in the one that the ending of `path` stands for.
///
/// - `.json`: as [`scores_json`], in one line;
/// - `.csv`: one row a tolerance, with the names of JSON as columns.
///
/// # Errors
/// The format is unknown, the folder is missing, the file exists and `overwrite` is not set, or the
/// operating system refuses.
pub fn write_scores(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    evaluation: &Evaluation,
) -> Result<(), WriteError> {
    let format = known_format(path.as_ref(), format, &SCORE_ENDINGS)?;
    write_atomically(path, overwrite, |out| {
        if format == "json" {
            return writeln!(out, "{}", scores_json(evaluation));
        }
        let mut writer = csv::Writer::from_writer(out);
        for entry in entries(evaluation) {
            writer.serialize(entry)?;
        }
        writer.flush()
    })
}

/// The scores as JSON, in one line: an object, or of several tolerances a list of objects.
///
/// ```json
/// { "tolerance": 2.0, "recall": 0.8, "precision": 0.9, "f1": 0.847, "truth_length": 100.0,
///   "extracted_length": 90.0, "truth_mean_distance": 1.2, "truth_largest_distance": 9.0,
///   "extracted_mean_distance": 0.7, "extracted_largest_distance": 4.0 }
/// ```
///
/// A distance is null if there is nothing to be near to.
#[must_use]
pub fn scores_json(evaluation: &Evaluation) -> String {
    let entries: Vec<Entry> = entries(evaluation).collect();
    let text = match &entries[..] {
        [entry] => serde_json::to_string(entry),
        entries => serde_json::to_string(entries),
    };
    // Numbers and lists always convert.
    text.unwrap_or_default()
}

fn entries(evaluation: &Evaluation) -> impl Iterator<Item = Entry> {
    let (truth, extracted) = (evaluation.truth_to_extracted, evaluation.extracted_to_truth);
    evaluation.scores.iter().map(move |score: &Score| Entry {
        tolerance: score.tolerance,
        recall: score.recall,
        precision: score.precision,
        f1: score.f1,
        truth_length: score.truth_length,
        extracted_length: score.extracted_length,
        truth_mean_distance: truth.mean,
        truth_largest_distance: truth.largest,
        extracted_mean_distance: extracted.mean,
        extracted_largest_distance: extracted.largest,
    })
}
