//! What a batch will do, decided before anything starts.

use super::args::BatchArgs;
use super::files::unique;
use super::log::{Fate, History, Record, Start, is_busy};
use super::manifest::{Manifest, complaint};
use super::row::{Row, Rows};
use crate::failure::Failure;
use heatpath_io::{check_output, remove_leftovers};
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The rows and files of a batch.
#[derive(Debug)]
pub(super) struct Plan {
    pub(super) manifest: PathBuf,
    /// That of the manifest, where the file names of rows count from.
    pub(super) folder: PathBuf,
    /// The rows of this part.
    pub(super) rows: Vec<Row>,
    pub(super) start: Start,
    pub(super) log: PathBuf,
    /// Those of other parts, if they count.
    pub(super) other_logs: Vec<PathBuf>,
    pub(super) summary: PathBuf,
    pub(super) report: Option<PathBuf>,
}

/// A row that is to run.
#[derive(Debug)]
pub(super) struct Task {
    pub(super) row: Row,
    pub(super) overwrite: bool,
}

impl Plan {
    /// Reads the manifest and checks all that can be checked beforehand.
    pub(super) fn new(args: &BatchArgs) -> Result<Self, Failure> {
        let rows = rows(args)?;
        let start = match (args.continues(), args.force) {
            (true, _) => Start::Continue,
            (_, true) => Start::Anew,
            _ => Start::First,
        };
        let usual = |ending: &str| args.manifest.with_extension(ending);
        let marked = |path: PathBuf| match args.shard {
            Some(shard) => with_mark(&path, &shard.mark()),
            None => path,
        };
        let whole_log = args.log.clone().unwrap_or_else(|| usual("log.jsonl"));
        let log = marked(whole_log.clone());
        let mut plan = Self {
            manifest: args.manifest.clone(),
            folder: folder_of(&args.manifest).to_owned(),
            rows,
            start,
            other_logs: if args.continues() { other_logs(&whole_log, &log) } else { Vec::new() },
            log,
            summary: marked(args.summary.clone().unwrap_or_else(|| usual("summary.csv"))),
            report: args.report.clone().map(marked),
        };
        plan.check_files()?;
        let is_busy = |log: &&PathBuf| args.shard.is_none() && is_busy(log);
        if let Some(busy) = plan.other_logs.iter().find(is_busy) {
            let busy = busy.display();
            return Err(Failure::file(format!("{busy}: another batch is writing this log")));
        }
        if let Some(shard) = args.shard {
            plan.rows.retain(|row| shard.has(row.number - 1));
        }
        if plan.start == Start::First {
            plan.check_existing(plan.rows.iter(), &History::default())?;
        }
        Ok(plan)
    }

    /// Parts the rows into those whose fate is known and those that are to run.
    pub(super) fn divide(&self, history: &History, retry: bool) -> (Vec<Record>, Vec<Task>) {
        let (mut kept, mut tasks) = (Vec::new(), Vec::new());
        for row in &self.rows {
            match history.fate(row, &self.folder, retry) {
                Fate::Keep(record) => kept.push(*record),
                Fate::Run { overwrite } => {
                    let overwrite = overwrite || self.start == Start::Anew;
                    tasks.push(Task { row: row.clone(), overwrite });
                }
            }
        }
        (kept, tasks)
    }

    /// Refuses to write over files that no earlier run has written.
    pub(super) fn check_existing<'a>(
        &self,
        mut rows: impl Iterator<Item = &'a Row>,
        history: &History,
    ) -> Result<(), Failure> {
        rows.try_for_each(|row| {
            let is_strange = |output: &&PathBuf| {
                !history.is_ours(output) && self.folder.join(output).symlink_metadata().is_ok()
            };
            let Some(output) = row.outputs.iter().find(is_strange) else { return Ok(()) };
            let why = format!("{} already exists; --force overwrites it", output.display());
            Err(Failure::file(self.about(row, &why)))
        })
    }

    /// Removes what killed rows have left, and makes the folders of outputs.
    pub(super) fn tidy(&self, tasks: &[Task]) -> Result<(), Failure> {
        for row in tasks.iter().map(|task| &task.row) {
            for output in row.outputs.iter().map(|output| self.folder.join(output)) {
                fs::create_dir_all(folder_of(&output)).map_err(|error| {
                    let folder = folder_of(&output).display();
                    Failure::file(self.about(row, &format!("the folder {folder}: {error}")))
                })?;
                remove_leftovers(&output)?;
            }
        }
        [Some(&self.summary), self.report.as_ref()]
            .into_iter()
            .flatten()
            .try_for_each(|file| Ok(remove_leftovers(file)?))
    }

    /// Refuses files that are written twice, or read while rows write them: rows do not wait for one
    /// another.
    fn check_files(&self) -> Result<(), Failure> {
        let overwrite = self.start != Start::First;
        check_output(&self.summary, None, overwrite, &["csv"])?;
        if let Some(report) = &self.report {
            check_output(report, None, overwrite, &["html", "htm"])?;
        }
        let files_of_batch =
            [Some(&self.manifest), Some(&self.log), Some(&self.summary), self.report.as_ref()];
        let mut writers: HashMap<PathBuf, &str> = HashMap::new();
        for file in files_of_batch.into_iter().flatten() {
            if writers.insert(unique(file), BATCH).is_some() {
                let file = file.display();
                return Err(Failure::usage(format!(
                    "{file}: the batch needs it for something else"
                )));
            }
        }
        let names: Vec<String> =
            self.rows.iter().map(|row| format!("row {}", row.number)).collect();
        for (row, name) in self.rows.iter().zip(&names) {
            for output in &row.outputs {
                if let Some(other) = writers.insert(self.unique_in_folder(output), name) {
                    let output = output.display();
                    return Err(self.bad(row, &format!("{output} is used by {other} as well")));
                }
            }
        }
        self.rows.iter().try_for_each(|row| self.check_inputs(row, &writers))
    }

    /// Refuses a row that reads what another one writes.
    fn check_inputs(&self, row: &Row, writers: &HashMap<PathBuf, &str>) -> Result<(), Failure> {
        let writer = |input: &PathBuf| writers.get(&self.unique_in_folder(input)).copied();
        let of_rows = |input| Some((input, writer(input).filter(|writer| *writer != BATCH)?));
        let Some((input, writer)) = row.inputs.iter().find_map(of_rows) else { return Ok(()) };
        let input = input.display();
        Err(self.bad(
            row,
            &format!("reads {input}, which {writer} writes; rows do not wait for one another"),
        ))
    }

    /// The one path of a file that a row names.
    fn unique_in_folder(&self, file: &Path) -> PathBuf {
        unique(&self.folder.join(file))
    }

    fn about(&self, row: &Row, what: &str) -> String {
        about(&self.manifest, row.number, what)
    }

    fn bad(&self, row: &Row, what: &str) -> Failure {
        Failure::bad_input(self.about(row, what))
    }
}

/// Who writes the files of the batch itself, in messages.
const BATCH: &str = "the batch itself";

/// The rows of the manifest.
fn rows(args: &BatchArgs) -> Result<Vec<Row>, Failure> {
    let manifest = Manifest::read(args)?;
    let mut parser = Rows::new(manifest.defaults);
    let mut rows = Vec::new();
    for (number, keys) in (1..).zip(&manifest.rows) {
        let row = parser.row(number, keys);
        rows.push(row.map_err(|what| Failure::bad_input(about(&args.manifest, number, &what)))?);
    }
    match parser.idle_default(&rows) {
        Some(key) => {
            let what = format!("the default `{key}` is an option of no row's command");
            Err(complaint(&args.manifest, &what))
        }
        None => Ok(rows),
    }
}

fn about(manifest: &Path, row: usize, what: &str) -> String {
    format!("{}: row {row}: {what}", manifest.display())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// `runs/log.jsonl` with the mark `1-of-2` is `runs/log.1-of-2.jsonl`.
fn with_mark(path: &Path, mark: &str) -> PathBuf {
    let ending = path.extension().map(|ending| ending.to_string_lossy().into_owned());
    path.with_extension(ending.map_or(mark.to_owned(), |ending| format!("{mark}.{ending}")))
}

/// The logs of the whole and of all its parts but our own, in alphabetical order.
fn other_logs(whole: &Path, own: &Path) -> Vec<PathBuf> {
    let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let part = name(&with_mark(whole, "*")).unwrap_or_default();
    let (before, after) = part.split_once('*').unwrap_or((&part, ""));
    let is_mark = |mark: &str| {
        mark.split_once("-of-")
            .is_some_and(|(i, n)| i.parse::<usize>().is_ok() && n.parse::<usize>().is_ok())
    };
    let is_part = |path: &Path| {
        let name = name(path).unwrap_or_default();
        let mark = name.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        mark.is_some_and(is_mark) || path.file_name() == whole.file_name()
    };
    let entries = fs::read_dir(folder_of(whole)).into_iter().flatten().flatten();
    let logs = entries.map(|entry| entry.path()).filter(|path| is_part(path));
    let mut logs: Vec<PathBuf> = logs.filter(|path| path.file_name() != own.file_name()).collect();
    logs.sort();
    logs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_files_of_their_own() {
        assert_eq!(
            with_mark(Path::new("a/b.log.jsonl"), "1-of-2"),
            Path::new("a/b.log.1-of-2.jsonl")
        );
        assert_eq!(with_mark(Path::new("log"), "1-of-2"), Path::new("log.1-of-2"));
        assert_eq!(folder_of(Path::new("a.toml")), Path::new("."));
    }
}
