//! `heatpath batch`: many runs of the other commands.
//!
//! `manifest.rs` reads keys, `row.rs` with `options.rs` makes checked command lines of them, `plan.rs` decides by the
//! `log.rs` of earlier runs which rows run, `pool.rs` runs several at once, each as the process of
//! `child.rs`; `summary.rs` and `report/` show what came of it.

pub(crate) mod args;
mod child;
mod files;
mod log;
mod manifest;
mod options;
mod plan;
mod pool;
mod report;
mod row;
mod summary;

pub(crate) use child::follow_batch;

use crate::failure::Failure;
use crate::output::print_json;
use args::BatchArgs;
use child::Site;
use log::{Log, Record, Start, Status};
use plan::Plan;
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

/// What `--json` prints.
#[derive(Serialize)]
struct Answer<'a> {
    rows: usize,
    done: usize,
    failed: usize,
    /// How many of both were left out.
    unchanged: usize,
    seconds: f64,
    log: &'a Path,
    summary: &'a Path,
    report: Option<&'a Path>,
}

pub(crate) fn batch(args: &BatchArgs) -> Result<(), Failure> {
    let start = Instant::now();
    let plan = Plan::new(args)?;
    let (mut log, history) = Log::open(&plan.log, plan.start, &plan.other_logs)?;
    let (kept, work) = plan.divide(&history, args.retry_failed);
    if plan.start == Start::Continue {
        plan.check_existing(work.iter().map(|task| &task.row), &history)?;
    }
    plan.tidy(&work)?;
    // === Run
    let unchanged = kept.len();
    let jobs = usize::from(args.jobs).min(work.len()).max(1);
    let site = Site::new(&plan.folder, log.journal(), jobs)
        .map_err(|error| Failure::file(format!("rows cannot be run: {error}")))?;
    let run = pool::run(&site, work, &mut log, (jobs, args.quiet))?;
    if !run.is_interrupted {
        log.close().map_err(|error| Failure::file(format!("{}: {error}", plan.log.display())))?;
    }
    // === Report
    let mut records: Vec<Record> = kept.into_iter().chain(run.records).collect();
    records.sort_by_key(|record| record.row);
    summary::write(&plan.summary, &records)?;
    if let Some(file) = &plan.report {
        report::write(file, &plan, &records, start.elapsed())?;
    }
    let count = |status| records.iter().filter(|record| record.status == status).count();
    let answer = Answer {
        rows: plan.rows.len(),
        done: count(Status::Done),
        failed: count(Status::Failed),
        unchanged,
        seconds: start.elapsed().as_secs_f64(),
        log: &plan.log,
        summary: &plan.summary,
        report: plan.report.as_deref(),
    };
    if args.json {
        print_json(&answer)?;
    } else if !args.quiet {
        drop(writeln!(io::stderr(), "{}", line(&answer)));
    }
    outcome(&answer, &records, run.is_interrupted)
}

/// All is well only if all rows are done.
fn outcome(answer: &Answer<'_>, records: &[Record], is_interrupted: bool) -> Result<(), Failure> {
    if is_interrupted {
        return Err(Failure::interrupted());
    }
    let Some(first) = records.iter().find(|record| record.status == Status::Failed) else {
        return Ok(());
    };
    Err(Failure::rows(
        answer.failed,
        format!(
            "{} of {} rows failed; the first is row {} ({}): {}",
            answer.failed, answer.rows, first.row, first.name, first.message
        ),
    ))
}

/// The answer in words.
fn line(answer: &Answer<'_>) -> String {
    let Answer { rows, done, failed, unchanged, seconds, .. } = answer;
    let log = answer.log.display();
    format!(
        "{rows} rows: {done} done, {failed} failed, {unchanged} left out; {seconds:.1} s; {log}"
    )
}
