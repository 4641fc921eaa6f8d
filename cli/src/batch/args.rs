//! The command line of `heatpath batch`, described.

use clap::value_parser;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub(crate) struct BatchArgs {
    /// The manifest: TOML with a table `[[row]]` for each input and perhaps `[defaults]`, or CSV with a
    /// line for each. Keys are the options of the row's `command`; file names count from the manifest's
    /// folder.
    pub(crate) manifest: PathBuf,
    /// What rows have that do not say otherwise, in place of the manifest's defaults (repeatable).
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_and_value)]
    pub(crate) default: Vec<(String, String)>,
    /// How many rows run at once; they share the processors.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..))]
    pub(crate) jobs: u16,
    /// Run only the I-th of N parts of the rows, I from 1; log, summary and report get `.I-of-N` into
    /// their names.
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub(crate) shard: Option<Shard>,
    /// Go on with what the logs say: leave out rows that are done and unchanged, and failed rows.
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    /// As --resume, but run failed rows again.
    #[arg(long, conflicts_with = "force")]
    pub(crate) retry_failed: bool,
    /// A line of JSON for each finished row [default: the manifest's name with .log.jsonl].
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) log: Option<PathBuf>,
    /// A table of all rows [default: the manifest's name with .summary.csv].
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) summary: Option<PathBuf>,
    /// A page with tables and pictures that opens without a network (.html).
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) report: Option<PathBuf>,
    /// Print one JSON object on standard output when all is done.
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
    /// No progress and no messages but errors.
    #[arg(long, help_heading = "Output")]
    pub(crate) quiet: bool,
    /// Begin anew and overwrite existing files.
    #[arg(long, help_heading = "Output")]
    pub(crate) force: bool,
}

impl BatchArgs {
    /// Whether logs of an earlier run count.
    pub(super) fn continues(&self) -> bool {
        self.resume || self.retry_failed
    }
}

/// One of several parts of the rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shard {
    part: usize,
    parts: usize,
}

impl Shard {
    /// Whether a row, counted from 0, belongs to this part. Neighbours go to different parts: what is
    /// slow often stands together.
    pub(super) fn has(self, row: usize) -> bool {
        row % self.parts == self.part - 1
    }

    /// What tells the files of parts from one another.
    pub(super) fn mark(self) -> String {
        format!("{}-of-{}", self.part, self.parts)
    }
}

fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/').and_then(|(part, parts)| {
        Some(Shard { part: part.trim().parse().ok()?, parts: parts.trim().parse().ok()? })
    });
    numbers
        .filter(|shard| (1..=shard.parts).contains(&shard.part))
        .ok_or_else(|| "expected I/N with I from 1 to N, for example 2/8".to_owned())
}

fn key_and_value(text: &str) -> Result<(String, String), String> {
    let pair = text.split_once('=').filter(|(key, _)| !key.is_empty());
    let pair = pair.map(|(key, value)| (key.to_owned(), value.to_owned()));
    pair.ok_or_else(|| "expected KEY=VALUE, for example channel=green".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_disjoint_and_complete() {
        for parts in 1..6 {
            let shards: Vec<Shard> = (1..=parts).map(|part| Shard { part, parts }).collect();
            for row in 0..20 {
                assert_eq!(shards.iter().filter(|shard| shard.has(row)).count(), 1);
            }
        }
        assert_eq!(shard("2/8"), Ok(Shard { part: 2, parts: 8 }));
        for bad in ["0/3", "4/3", "1", "a/b", "1/0", "-1/3"] {
            assert!(shard(bad).is_err(), "{bad}");
        }
    }
}
