//! The log: what has become of rows, a line of JSON for each, and what is needed to go on after
//! an interruption at any moment.
//!
//! Beside the log stands a journal, `LOG.started`, while a batch runs or after it was killed: the
//! outputs of the rows that were begun, so that what they left may be overwritten. The batch locks its
//! log; its rows lock the journal, so that the next batch can wait until they are gone.

use super::files::Stamp;
use super::row::Row;
use crate::failure::Failure;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{HashMap, HashSet};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// How a row ended.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Status {
    Done,
    Failed,
}

impl Status {
    /// Its name in the log, the summary and the report.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed => "failed",
        }
    }
}

/// A line of the log.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Record {
    /// Its number in the manifest at that time, from 1.
    pub(super) row: usize,
    pub(super) name: String,
    pub(super) command: String,
    pub(super) status: Status,
    /// None if the row was killed.
    pub(super) exit_code: Option<i32>,
    /// What went wrong.
    pub(super) message: String,
    pub(super) seconds: f64,
    /// When it ended, in seconds since 1970.
    pub(super) finished: f64,
    pub(super) version: String,
    /// The command line.
    pub(super) arguments: Vec<String>,
    pub(super) evaluation: Option<Vec<String>>,
    pub(super) inputs: Vec<Stamp>,
    pub(super) outputs: Vec<Stamp>,
    /// What the command printed for `--json`; points of curves that are in an output are left out.
    pub(super) answer: Value,
    /// What `heatpath evaluate --json` printed.
    pub(super) scores: Value,
}

impl Record {
    /// Whether this is the same work as the row's, on the same inputs.
    fn is_of(&self, row: &Row, folder: &Path) -> bool {
        let is_same = |stamp: &Stamp| *stamp == Stamp::now(folder, &stamp.path);
        self.inputs.iter().all(is_same) && self.evaluation == row.evaluation
    }

    /// Whether all that it wrote is there.
    fn is_complete(&self, folder: &Path) -> bool {
        self.outputs.iter().all(|output| output.is_complete(folder))
    }
}

/// What the logs of earlier runs know.
#[derive(Debug, Default)]
pub(super) struct History {
    /// The last record of each command line.
    records: HashMap<Vec<String>, Record>,
    /// The outputs of all rows that were begun.
    ours: HashSet<PathBuf>,
}

/// What is to be done with a row.
#[derive(Debug)]
pub(super) enum Fate {
    /// Nothing: this is how it ended.
    Keep(Box<Record>),
    Run {
        overwrite: bool,
    },
}

impl History {
    /// What is to be done with a row; failed rows run again if asked to `retry`.
    pub(super) fn fate(&self, row: &Row, folder: &Path, retry: bool) -> Fate {
        let is_settled = |record: &&Record| match record.status {
            Status::Done => record.is_complete(folder),
            Status::Failed => !retry,
        };
        let record = self.records.get(&row.arguments).filter(|record| record.is_of(row, folder));
        match record.filter(is_settled) {
            Some(record) => {
                let name = row.name.clone();
                Fate::Keep(Box::new(Record { row: row.number, name, ..record.clone() }))
            }
            None => {
                Fate::Run { overwrite: row.outputs.iter().any(|output| self.ours.contains(output)) }
            }
        }
    }

    /// Whether a file was written by an earlier run, or begun.
    pub(super) fn is_ours(&self, output: &Path) -> bool {
        self.ours.contains(output)
    }

    /// Adds the lines of a log.
    fn read(&mut self, path: &Path, lines: &str) -> Result<(), Failure> {
        for (number, line) in lines.lines().enumerate() {
            let record: Record = serde_json::from_str(line).map_err(|error| {
                let (path, number) = (path.display(), number + 1);
                Failure::bad_input(format!(
                    "{path}: line {number} is no line of a batch log: {error}"
                ))
            })?;
            self.ours.extend(record.outputs.iter().map(|output| output.path.clone()));
            let known = self.records.get(&record.arguments);
            if known.is_none_or(|known| known.finished <= record.finished) {
                self.records.insert(record.arguments.clone(), record);
            }
        }
        Ok(())
    }

    /// Adds what a journal says was begun; its last line may be cut off.
    fn read_journal(&mut self, path: &Path) {
        let text = fs::read_to_string(path).unwrap_or_default();
        let begun = text.lines().filter_map(|line| serde_json::from_str::<Vec<PathBuf>>(line).ok());
        self.ours.extend(begun.flatten());
    }
}

/// How a batch begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Start {
    /// There must be no log.
    First,
    /// Logs count.
    Continue,
    /// The log is emptied.
    Anew,
}

/// The log of a running batch.
#[derive(Debug)]
pub(super) struct Log {
    file: File,
    /// Where the journal is, if there is one.
    journal: PathBuf,
}

impl Log {
    /// Opens the log at `path`, waits for rows of a killed batch, and reads what it and the logs of
    /// `others` know.
    pub(super) fn open(
        path: &Path,
        start: Start,
        others: &[PathBuf],
    ) -> Result<(Self, History), Failure> {
        let failed = |error: io::Error| Failure::file(format!("{}: {error}", path.display()));
        if start == Start::First && fs::metadata(path).is_ok_and(|about| about.len() > 0) {
            let path = path.display();
            return Err(Failure::file(format!(
                "{path}: already exists; --resume goes on with it, --force begins anew"
            )));
        }
        let mut file =
            OpenOptions::new().read(true).append(true).create(true).open(path).map_err(failed)?;
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            let path = path.display();
            return Err(Failure::file(format!("{path}: another batch is writing this log")));
        }
        let journal = journal_of(path);
        wait_for_rows(&journal);
        let mut history = History::default();
        if start == Start::Anew {
            file.set_len(0).map_err(failed)?;
        } else {
            let lines = whole_lines(&mut file).map_err(failed)?;
            file.set_len(lines.len() as u64).map_err(failed)?;
            history.read(path, &lines)?;
            history.read_journal(&journal);
        }
        for other in others {
            let lines = whole_lines(&mut File::open(other).map_err(failed)?).map_err(failed)?;
            history.read(other, &lines)?;
            history.read_journal(&journal_of(other));
        }
        Ok((Self { file, journal }, history))
    }

    /// What rows lock.
    pub(super) fn journal(&self) -> &Path {
        &self.journal
    }

    /// Notes that a row begins.
    pub(super) fn begin(&mut self, row: &Row) -> io::Result<()> {
        let mut journal = OpenOptions::new().append(true).create(true).open(&self.journal)?;
        // The line before may be cut off.
        write_line(&mut journal, &format!("\n{}", serde_json::to_string(&row.outputs)?))
    }

    /// Notes how a row ended.
    pub(super) fn end(&mut self, record: &Record) -> io::Result<()> {
        write_line(&mut self.file, &serde_json::to_string(record)?)
    }

    /// All rows that were begun are in the log: the journal can go.
    pub(super) fn close(self) -> io::Result<()> {
        if self.journal.exists() { fs::remove_file(&self.journal) } else { Ok(()) }
    }
}

/// Whether a batch is writing this log.
pub(super) fn is_busy(log: &Path) -> bool {
    File::open(log)
        .is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
}

fn journal_of(log: &Path) -> PathBuf {
    let mut name = log.as_os_str().to_owned();
    name.push(".started");
    PathBuf::from(name)
}

/// Returns once no row of a killed batch is left. Where files cannot be locked nobody waits.
fn wait_for_rows(journal: &Path) {
    if let Ok(journal) = OpenOptions::new().append(true).open(journal) {
        drop(journal.lock());
    }
}

/// The text up to the last end of a line: a line that was cut off never happened.
fn whole_lines(file: &mut File) -> io::Result<String> {
    file.seek(SeekFrom::Start(0))?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    let end = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |last| last + 1);
    if bytes.get(end).is_some_and(|&first| first != b'{') {
        return Err(io::Error::other("is no log of a batch: the last line is no JSON"));
    }
    bytes.truncate(end);
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// Writes a line at once, and onto the disk.
fn write_line(file: &mut File, line: &str) -> io::Result<()> {
    file.write_all(format!("{line}\n").as_bytes())?;
    file.sync_data()
}
