//! Several rows at a time.

use super::child::{Lifelines, Outcome, Site};
use super::files::Stamp;
use super::log::{Log, Record, Status};
use super::plan::Task;
use super::row::Row;
use crate::failure::Failure;
use crate::run::progress_bar;
use indicatif::ProgressBar;
use serde_json::Value;
use std::io;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// What came of a run.
#[derive(Debug)]
pub(super) struct Run {
    /// Of the rows that ended.
    pub(super) records: Vec<Record>,
    pub(super) is_interrupted: bool,
}

/// What the threads share.
struct Shared<'a> {
    tasks: std::vec::IntoIter<Task>,
    log: &'a mut Log,
    records: Vec<Record>,
    /// Why the log could not be written.
    broken: Option<io::Error>,
}

/// Runs the tasks, `jobs` at a time, and notes each in the log.
pub(super) fn run(
    site: &Site,
    tasks: Vec<Task>,
    log: &mut Log,
    (jobs, quiet): (usize, bool),
) -> Result<Run, Failure> {
    let lifelines = Arc::new(Lifelines::new());
    let for_handler = Arc::clone(&lifelines);
    // Whoever asks twice will not wait for rows to end.
    drop(ctrlc::set_handler(move || {
        if for_handler.cut() {
            std::process::exit(130);
        }
    }));
    let bar = progress_bar((tasks.len() as u64, "{pos} of {len}"), "rows", quiet);
    bar.enable_steady_tick(Duration::from_millis(500));
    let tasks = tasks.into_iter();
    let shared = Mutex::new(Shared { tasks, log, records: Vec::new(), broken: None });
    thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(|| work(site, &shared, &lifelines, &bar));
        }
    });
    bar.finish_and_clear();
    let Shared { records, broken, .. } =
        shared.into_inner().unwrap_or_else(PoisonError::into_inner);
    match broken {
        Some(error) => Err(Failure::file(format!("the log cannot be written: {error}"))),
        None => Ok(Run { records, is_interrupted: lifelines.are_cut() }),
    }
}

/// Takes tasks until there are none.
fn work(site: &Site, shared: &Mutex<Shared<'_>>, lifelines: &Lifelines, bar: &ProgressBar) {
    let lock = || shared.lock().unwrap_or_else(PoisonError::into_inner);
    loop {
        let task = {
            let mut shared = lock();
            if lifelines.are_cut() {
                return;
            }
            let Some(task) = shared.tasks.next() else { return };
            if let Err(error) = shared.log.begin(&task.row) {
                shared.broken = Some(error);
                lifelines.cut();
                return;
            }
            task
        };
        let record = record(site, &task, lifelines);
        // A row that failed after an interruption was stopped by it.
        if lifelines.are_cut() && record.status == Status::Failed {
            return;
        }
        let mut shared = lock();
        if let Err(error) = shared.log.end(&record) {
            shared.broken = Some(error);
            lifelines.cut();
        }
        show(bar, &record);
        shared.records.push(record);
    }
}

/// Runs a row and says how it ended.
fn record(site: &Site, Task { row, overwrite }: &Task, lifelines: &Lifelines) -> Record {
    let start = Instant::now();
    let stamps =
        |files: &[PathBuf]| files.iter().map(|file| Stamp::now(&site.folder, file)).collect();
    let inputs = stamps(&row.inputs);
    let mut outcome =
        site.run(row, *overwrite, lifelines).unwrap_or_else(|error| not_started(&error));
    let mut scores = Value::Null;
    if let Some(arguments) = row.evaluation.as_ref().filter(|_| outcome.exit_code == Some(0)) {
        let evaluated =
            site.evaluate(arguments, lifelines).unwrap_or_else(|error| not_started(&error));
        (outcome.exit_code, outcome.message) = (evaluated.exit_code, evaluated.message);
        scores = evaluated.answer;
    }
    let is_done = outcome.exit_code == Some(0);
    let finished = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    Record {
        row: row.number,
        name: row.name.clone(),
        command: row.command.clone(),
        status: if is_done { Status::Done } else { Status::Failed },
        exit_code: outcome.exit_code,
        message: outcome.message,
        seconds: start.elapsed().as_secs_f64(),
        finished: finished.as_secs_f64(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        arguments: row.arguments.clone(),
        evaluation: row.evaluation.clone(),
        inputs,
        outputs: stamps(&row.outputs),
        answer: answer(row, outcome.answer),
        scores,
    }
}

fn not_started(error: &io::Error) -> Outcome {
    let message = format!("the process could not be run: {error}");
    Outcome { exit_code: None, message, answer: Value::Null }
}

/// The answer without the points of curves, if these are in a file.
fn answer(row: &Row, mut answer: Value) -> Value {
    if row.outputs.is_empty() {
        return answer;
    }
    let paths = answer.get_mut("paths").and_then(Value::as_array_mut).into_iter().flatten();
    for path in paths.filter_map(Value::as_object_mut) {
        path.remove("points");
        path.remove("radii");
    }
    answer
}

fn show(bar: &ProgressBar, record: &Record) {
    if record.status == Status::Failed {
        let Record { row, name, message, .. } = record;
        bar.println(format!("row {row} ({name}) failed: {message}"));
    }
    bar.inc(1);
}
