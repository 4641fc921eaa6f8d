//! Keys as options of a command.

use super::manifest::{Given, Keys};
use clap::builder::ValueParser;
use clap::{Arg, ArgAction, ArgMatches, Command};
use std::path::PathBuf;

/// Options that name files to be written.
const OUTPUTS: [&str; 4] = ["output", "overlay", "density", "travelling"];

/// What a batch sets itself.
const RESERVED: [(&str, &str); 3] = [
    ("json", "each row's answer stands in the log"),
    ("quiet", "`heatpath batch --quiet` says nothing"),
    ("force", "`heatpath batch --force` overwrites existing files"),
];

/// Whether the batch itself understands this key in rows of the command.
pub(super) fn is_own(command: &Command, key: &str) -> bool {
    let is_evaluate = command.get_name() == "evaluate";
    matches!(key, "command" | "name") || matches!(key, "truth" | "tolerance") && !is_evaluate
}

pub(super) fn takes(command: &Command, key: &str) -> bool {
    option(command, key).is_some()
}

fn option<'a>(command: &'a Command, key: &str) -> Option<&'a Arg> {
    let is_called =
        |arg: &&Arg| arg.get_long() == Some(key) || arg.is_positional() && arg.get_id() == key;
    command.get_arguments().find(is_called)
}

/// The command line of a command with the options of these keys.
pub(super) fn arguments(
    command: &Command,
    words: &str,
    keys: &Keys,
) -> Result<Vec<String>, String> {
    let (mut arguments, mut positional) = (Vec::new(), Vec::new());
    for (key, given) in keys.iter().filter(|(key, _)| !is_own(command, key)) {
        if let Some((_, why)) = RESERVED.iter().find(|(reserved, _)| reserved == key) {
            return Err(format!("`{key}` is not for rows: {why}"));
        }
        match option(command, key) {
            Some(arg) if arg.is_positional() => positional.extend(values(arg, key, given)?),
            Some(arg) if !arg.get_action().takes_values() => {
                arguments.extend(is_set(key, given)?.then(|| format!("--{key}")));
            }
            Some(arg) => {
                let values = values(arg, key, given)?;
                arguments.extend(values.iter().map(|value| format!("--{key}={value}")));
            }
            // The parser says what it could mean.
            None => arguments.push(format!("--{key}")),
        }
    }
    let words = words.split(' ').map(str::to_owned);
    let separator = (!positional.is_empty()).then(|| "--".to_owned());
    Ok(words.chain(arguments).chain(separator).chain(positional).collect())
}

fn is_set(key: &str, given: &Given) -> Result<bool, String> {
    match given {
        Given::Flag(is_set) => Ok(*is_set),
        Given::Cell(text) if text == "true" => Ok(true),
        Given::Cell(text) if text == "false" => Ok(false),
        _ => Err(format!("`{key}` must be true or false")),
    }
}

/// The values with which the option stands in the command line, once for each.
fn values(arg: &Arg, key: &str, given: &Given) -> Result<Vec<String>, String> {
    let is_repeatable = matches!(arg.get_action(), ArgAction::Append);
    match given {
        Given::Flag(_) => Err(format!("`{key}` needs a value, not true or false")),
        Given::One(text) => Ok(vec![text.clone()]),
        Given::Many(texts) if is_repeatable => Ok(texts.clone()),
        Given::Many(texts) => Ok(vec![texts.join(",")]),
        Given::Cell(text) if is_repeatable => {
            Ok(text.split(';').map(|part| part.trim().to_owned()).collect())
        }
        Given::Cell(text) => Ok(vec![text.clone()]),
    }
}

/// The files that a command reads or writes.
pub(super) fn files(command: &Command, matches: &ArgMatches, are_outputs: bool) -> Vec<PathBuf> {
    let is_file =
        |arg: &&Arg| arg.get_value_parser().type_id() == ValueParser::path_buf().type_id();
    let files = command.get_arguments().filter(is_file).map(|arg| arg.get_id().as_str());
    let files = files.filter(|id| OUTPUTS.contains(id) == are_outputs);
    files.filter_map(|id| matches.get_many::<PathBuf>(id)).flatten().cloned().collect()
}
