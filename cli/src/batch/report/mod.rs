//! All rows as a page that needs no other file: tables, and pictures within.
//!
//! `page.html` is the page, filled in by a template engine that escapes all text.

mod entry;

use super::log::{Record, Status};
use super::plan::Plan;
use super::summary::{SCORES, score, tolerances};
use crate::failure::Failure;
use entry::{Entry, number};
use heatpath_io::write_atomically;
use humantime::format_rfc3339_seconds;
use minijinja::Environment;
use minijinja::value::Serde;
use serde::Serialize;
use std::path::Path;
use std::time::{Duration, SystemTime};

const PAGE: &str = include_str!("page.html");

/// What the page shows.
#[derive(Serialize)]
struct Page {
    title: String,
    facts: Vec<(&'static str, String)>,
    has_failed: bool,
    tolerances: Vec<String>,
    entries: Vec<Entry>,
    /// The mean of each score over the rows that have it.
    means: Vec<String>,
}

/// Writes the report.
pub(super) fn write(
    path: &Path,
    plan: &Plan,
    records: &[Record],
    elapsed: Duration,
) -> Result<(), Failure> {
    let page = Page::new(plan, records, elapsed);
    let text =
        render(&page).map_err(|error| Failure::file(format!("{}: {error:#}", path.display())))?;
    Ok(write_atomically(path, true, |out| out.write_all(text.as_bytes()))?)
}

fn render(page: &Page) -> Result<String, minijinja::Error> {
    let mut environment = Environment::new();
    // The name decides that text is escaped.
    environment.add_template("page.html", PAGE)?;
    environment.get_template("page.html")?.render(Serde(page))
}

impl Page {
    fn new(plan: &Plan, records: &[Record], elapsed: Duration) -> Self {
        let count = |status| records.iter().filter(|record| record.status == status).count();
        let (done, failed) = (count(Status::Done), count(Status::Failed));
        let work: f64 = records.iter().map(|record| record.seconds).sum();
        let name = plan.manifest.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut facts = vec![
            ("rows", plan.rows.len().to_string()),
            ("done", done.to_string()),
            ("failed", failed.to_string()),
            ("not finished", (plan.rows.len() - records.len()).to_string()),
            ("time of the rows", seconds(work)),
            ("time of this run", seconds(elapsed.as_secs_f64())),
            ("written", format_rfc3339_seconds(SystemTime::now()).to_string()),
            ("heatpath", versions(records)),
            ("system", format!("{} {}", std::env::consts::OS, std::env::consts::ARCH)),
            ("manifest", plan.manifest.display().to_string()),
        ];
        facts.retain(|(key, value)| *key != "not finished" || value != "0");
        let tolerances = tolerances(records);
        Self {
            title: name,
            facts,
            has_failed: failed > 0,
            means: means(records, &tolerances),
            entries: records
                .iter()
                .map(|record| Entry::new(record, &plan.folder, &tolerances))
                .collect(),
            tolerances,
        }
    }
}

/// Of the commands that made the results.
fn versions(records: &[Record]) -> String {
    let mut all: Vec<&str> = records.iter().map(|record| record.version.as_str()).collect();
    all.sort_unstable();
    all.dedup();
    all.join(", ")
}

fn means(records: &[Record], tolerances: &[String]) -> Vec<String> {
    let keys = tolerances.iter().flat_map(|tolerance| SCORES.map(|key| (tolerance, key)));
    keys.map(|(tolerance, key)| {
        let values: Vec<f64> =
            records.iter().filter_map(|record| score(record, tolerance, key)).collect();
        number(values.iter().sum::<f64>() / values.len() as f64)
    })
    .collect()
}

fn seconds(seconds: f64) -> String {
    format!("{seconds:.2} s")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped() {
        let page = Page {
            title: "<script>alert('x')</script> & \"co\"".to_owned(),
            facts: vec![("rows", "<b>".to_owned())],
            has_failed: false,
            tolerances: Vec::new(),
            entries: Vec::new(),
            means: Vec::new(),
        };
        let text = render(&page).unwrap();
        assert!(text.contains("&lt;script&gt;alert(") && text.contains("&lt;b&gt;"), "{text}");
        assert!(!text.contains("<script"), "{text}");
    }
}
