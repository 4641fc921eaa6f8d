//! Rows as processes of their own: a crash, or the system's want of memory, costs one row alone.
//!
//! A row ends with its batch. Its standard input is a pipe whose other end the batch holds (the
//! lifeline); when that is cut, also because the batch was killed, the row stops as if by Ctrl-C.
//! Until it has ended it locks the journal, for which the next batch waits.

use super::manifest::one_line;
use super::row::Row;
use crate::run;
use serde_json::Value;
use std::collections::HashMap;
use std::env;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{ChildStdin, Command, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Names the journal to processes that are rows.
const JOURNAL: &str = "HEATPATH_BATCH_JOURNAL";

/// The longest message that is kept.
const LONGEST: usize = 1000;

/// What rows have in common.
#[derive(Debug)]
pub(super) struct Site {
    program: PathBuf,
    journal: PathBuf,
    /// Where file names count from.
    pub(super) folder: PathBuf,
    /// The processors of each row.
    threads: usize,
}

/// What a process left.
#[derive(Debug)]
pub(super) struct Outcome {
    pub(super) exit_code: Option<i32>,
    /// What went wrong; empty if nothing did.
    pub(super) message: String,
    /// What it printed.
    pub(super) answer: Value,
}

impl Site {
    pub(super) fn new(folder: &Path, journal: &Path, jobs: usize) -> io::Result<Self> {
        let processors = thread::available_parallelism().map_or(1, usize::from);
        Ok(Self {
            program: env::current_exe()?,
            journal: std::path::absolute(journal)?,
            folder: folder.to_owned(),
            threads: (processors / jobs).max(1),
        })
    }

    /// Runs the command of a row.
    pub(super) fn run(&self, row: &Row, overwrite: bool, lines: &Lifelines) -> io::Result<Outcome> {
        let mut command = self.command();
        // Options stand before the positional ones.
        let mut added = vec!["--json".to_owned()];
        added.extend(row.takes_quiet.then(|| "--quiet".to_owned()));
        added.extend((overwrite && !row.outputs.is_empty()).then(|| "--force".to_owned()));
        added.extend(row.takes_threads.then(|| format!("--threads={}", self.threads)));
        let words = row.command.split(' ').count();
        command.args(&row.arguments[..words]).args(added).args(&row.arguments[words..]);
        finish(command, lines)
    }

    /// Runs a row's comparison with a truth.
    pub(super) fn evaluate(&self, arguments: &[String], lines: &Lifelines) -> io::Result<Outcome> {
        let mut command = self.command();
        command.args(arguments).arg("--json");
        finish(command, lines)
    }

    fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command
            .current_dir(&self.folder)
            .env(JOURNAL, &self.journal)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }
}

fn finish(mut command: Command, lines: &Lifelines) -> io::Result<Outcome> {
    let mut child = command.spawn()?;
    let number = child.id();
    lines.hold(number, child.stdin.take());
    let output = child.wait_with_output();
    lines.release(number);
    let output = output?;
    let message = if output.status.success() {
        String::new()
    } else {
        message(output.status, &String::from_utf8_lossy(&output.stderr))
    };
    // What fails may print nothing, or half a line.
    let answer = serde_json::from_slice(&output.stdout).unwrap_or_default();
    Ok(Outcome { exit_code: output.status.code(), message, answer })
}

/// What a process that failed said, in one line.
fn message(status: ExitStatus, said: &str) -> String {
    let error = said.lines().find_map(|line| line.strip_prefix("heatpath: error: "));
    let said: String = match error {
        Some(error) => error.to_owned(),
        None => one_line(said),
    };
    let said: String = said.chars().take(LONGEST).collect();
    match (status.code(), said.is_empty()) {
        (None, true) => format!("was killed ({status}); out of memory, perhaps"),
        (None, false) => format!("was killed ({status}): {said}"),
        (Some(_), true) => status.to_string(),
        (Some(_), false) => said,
    }
}

/// The batch's ends of the pipes to its rows.
#[derive(Debug)]
pub(super) struct Lifelines {
    /// By process; none after all were cut.
    held: Mutex<Option<HashMap<u32, ChildStdin>>>,
}

impl Lifelines {
    pub(super) fn new() -> Self {
        Self { held: Mutex::new(Some(HashMap::new())) }
    }

    /// Stops all rows, now and from now on. Returns whether that had been done before.
    pub(super) fn cut(&self) -> bool {
        self.lock().take().is_none()
    }

    pub(super) fn are_cut(&self) -> bool {
        self.lock().is_none()
    }

    /// After a cut the line is dropped at once.
    fn hold(&self, process: u32, line: Option<ChildStdin>) {
        if let (Some(held), Some(line)) = (self.lock().as_mut(), line) {
            held.insert(process, line);
        }
    }

    fn release(&self, process: u32) {
        if let Some(held) = self.lock().as_mut() {
            held.remove(&process);
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Option<HashMap<u32, ChildStdin>>> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// In a process that is a row: stops when the batch does. The lock lasts as long as what is returned.
pub(crate) fn follow_batch() -> Option<File> {
    let journal = env::var_os(JOURNAL)?;
    let lock = File::open(journal).ok();
    // Where files cannot be locked the next batch does not wait.
    if let Some(file) = &lock {
        drop(file.lock_shared());
    }
    thread::spawn(|| {
        let mut byte = [0];
        while matches!(io::stdin().read(&mut byte), Ok(1..)) {}
        run::interrupt();
    });
    lock
}
