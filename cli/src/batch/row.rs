//! Rows: what a manifest asks for as command lines, checked by the parser of the command.

use super::manifest::{Given, Keys, one_line};
use super::options::{arguments, files, is_own, takes};
use crate::args::Args;
use crate::failure::in_one_line;
use clap::{ArgMatches, Command, CommandFactory};
use heatpath_io::data_file;
use std::path::{Path, PathBuf};

/// Commands that make no sense in a row.
const NOT_FOR_ROWS: [&str; 2] = ["batch", "completions"];

/// One run of a command.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// Counted from 1.
    pub(super) number: usize,
    pub(super) name: String,
    /// For example `mesh path`.
    pub(super) command: String,
    /// Its command line, without what the batch adds.
    pub(super) arguments: Vec<String>,
    /// The command line that compares the result with a truth, if there is one.
    pub(super) evaluation: Option<Vec<String>>,
    /// The files that it reads, as the manifest names them.
    pub(super) inputs: Vec<PathBuf>,
    pub(super) outputs: Vec<PathBuf>,
    /// Whether its command has `--threads` and the row leaves them open.
    pub(super) takes_threads: bool,
    /// Whether its command has `--quiet`.
    pub(super) takes_quiet: bool,
}

/// Turns keys into rows.
pub(super) struct Rows {
    parser: Command,
    defaults: Keys,
}

impl Rows {
    pub(super) fn new(defaults: Keys) -> Self {
        Self { parser: Args::command(), defaults }
    }

    /// The row of these keys.
    ///
    /// # Errors
    /// What is wrong, without saying in which row.
    pub(super) fn row(&mut self, number: usize, keys: &Keys) -> Result<Row, String> {
        let command = match keys.get("command").or_else(|| self.defaults.get("command")) {
            Some(Given::One(command) | Given::Cell(command)) => one_line(command),
            _ => return Err(format!("needs `command`, one of {}", self.commands().join(", "))),
        };
        let Some(description) = self.find(&command) else {
            let known = self.commands().join(", ");
            return Err(format!("`command` is `{command}`; it must be one of {known}"));
        };
        let keys = self.with_defaults(&description, number, keys);
        let arguments = arguments(&description, &command, &keys)?;
        let matches = self.matches(&arguments, &command)?;
        let mut outputs = files(&description, &matches, true);
        let is_main =
            |file: &Path| text(&keys, "output").is_some_and(|name| Path::new(name) == file);
        let format = |file: &Path| text(&keys, "format").filter(|_| is_main(file));
        let data: Vec<_> =
            outputs.iter().filter_map(|file| data_file(file, format(file))).collect();
        let evaluation = match command.as_str() {
            "evaluate" => None,
            _ => self.evaluation(&keys, &outputs)?,
        };
        outputs.extend(data);
        let mut inputs = files(&description, &matches, false);
        let truth = evaluation.is_some().then(|| text(&keys, "truth")).flatten();
        inputs.extend(truth.map(PathBuf::from));
        let name = text(&keys, "name").map_or_else(|| usual_name(&inputs), str::to_owned);
        Ok(Row {
            number,
            name,
            command,
            arguments,
            evaluation,
            inputs,
            outputs,
            takes_threads: takes(&description, "threads") && !keys.contains_key("threads"),
            takes_quiet: takes(&description, "quiet"),
        })
    }

    /// The defaults that no row's command has as an option.
    pub(super) fn idle_default(&self, rows: &[Row]) -> Option<&str> {
        let commands: Vec<Command> =
            rows.iter().filter_map(|row| self.find(&row.command)).collect();
        let is_used =
            |key: &str| commands.iter().any(|command| is_own(command, key) || takes(command, key));
        self.defaults.keys().map(String::as_str).find(|key| !is_used(key))
    }

    fn find(&self, command: &str) -> Option<Command> {
        let found = command.split(' ').try_fold(&self.parser, Command::find_subcommand)?;
        let is_for_rows = !found.has_subcommands() && !NOT_FOR_ROWS.contains(&found.get_name());
        is_for_rows.then(|| found.clone())
    }

    /// The names of all commands that a row can have.
    fn commands(&self) -> Vec<String> {
        let names = self.parser.get_subcommands().flat_map(|command| {
            let name = command.get_name();
            let inner: Vec<String> = command
                .get_subcommands()
                .map(|inner| format!("{name} {}", inner.get_name()))
                .collect();
            if inner.is_empty() { vec![name.to_owned()] } else { inner }
        });
        names.filter(|name| self.find(name).is_some()).collect()
    }

    /// The keys with those defaults that the command has, and patterns filled in.
    fn with_defaults(&self, command: &Command, number: usize, keys: &Keys) -> Keys {
        let fits = |key: &str| is_own(command, key) || takes(command, key);
        let defaults = self.defaults.iter().filter(|(key, _)| fits(key));
        let mut all: Keys =
            defaults.chain(keys).map(|(key, value)| (key.clone(), value.clone())).collect();
        // A tolerance for all rows means nothing to those without a truth.
        if !all.contains_key("truth") && !keys.contains_key("tolerance") {
            all.remove("tolerance");
        }
        let stem = text(&all, "input").map(stem).unwrap_or_default();
        let fill = |text: &mut String| {
            *text = text.replace("{stem}", &stem).replace("{row}", &number.to_string());
        };
        for (_, given) in all.iter_mut().filter(|(key, _)| *key != "input") {
            match given {
                Given::One(text) | Given::Cell(text) => fill(text),
                Given::Many(texts) => texts.iter_mut().for_each(fill),
                Given::Flag(_) => {}
            }
        }
        all
    }

    fn matches(&mut self, arguments: &[String], command: &str) -> Result<ArgMatches, String> {
        let words = ["heatpath"].into_iter().chain(arguments.iter().map(String::as_str));
        let matches =
            self.parser.try_get_matches_from_mut(words).map_err(|error| in_one_line(&error))?;
        let innermost =
            command.split(' ').try_fold(&matches, |found, name| found.subcommand_matches(name));
        innermost.cloned().ok_or_else(|| format!("`{command}` cannot be a row"))
    }

    /// The command line of `heatpath evaluate` for what this row writes.
    fn evaluation(
        &mut self,
        keys: &Keys,
        outputs: &[PathBuf],
    ) -> Result<Option<Vec<String>>, String> {
        let Some(truth) = keys.get("truth") else {
            let is_idle = keys.contains_key("tolerance");
            return if is_idle { Err("`tolerance` needs a `truth`".to_owned()) } else { Ok(None) };
        };
        let Some(output) = outputs.first().filter(|_| keys.contains_key("output")) else {
            return Err("`truth` is compared with what is written: it needs an `output`".to_owned());
        };
        if !keys.contains_key("tolerance") {
            return Err("`truth` needs a `tolerance`, for example [1, 2, 3]".to_owned());
        }
        let shared = ["tolerance", "mask", "spacing"];
        let shared =
            shared.iter().filter_map(|&key| Some((key.to_owned(), keys.get(key)?.clone())));
        let extracted = Given::One(output.to_string_lossy().into_owned());
        let keys: Keys = shared
            .chain([("truth".to_owned(), truth.clone()), ("extracted".to_owned(), extracted)])
            .collect();
        let Some(evaluate) = self.find("evaluate") else { return Ok(None) };
        let arguments = arguments(&evaluate, "evaluate", &keys)?;
        self.matches(&arguments, "evaluate")?;
        Ok(Some(arguments))
    }
}

fn text<'a>(keys: &'a Keys, key: &str) -> Option<&'a str> {
    match keys.get(key)? {
        Given::One(text) | Given::Cell(text) => Some(text),
        _ => None,
    }
}

/// The name of a file without folders and ending; a `.gz` is none.
fn stem(path: &str) -> String {
    let stem = |path: &Path| path.file_stem().map(PathBuf::from).unwrap_or_default();
    let once = stem(Path::new(path));
    let is_packed =
        Path::new(path).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gz"));
    let name = if is_packed { stem(&once) } else { once };
    name.to_string_lossy().into_owned()
}

fn usual_name(inputs: &[PathBuf]) -> String {
    let name = inputs.first().and_then(|input| input.file_name());
    name.map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(pairs: &[(&str, Given)]) -> Keys {
        pairs.iter().map(|(key, given)| ((*key).to_owned(), given.clone())).collect()
    }

    fn cell(text: &str) -> Given {
        Given::Cell(text.to_owned())
    }

    fn path(more: &[(&str, Given)]) -> Result<Row, String> {
        let usual =
            [("command", "path"), ("input", "in/a.nii.gz"), ("source", "1,2"), ("end", "3,4; 5,6")];
        let mut all = keys(&usual.map(|(key, text)| (key, cell(text))));
        all.extend(keys(&[("output", cell("{stem}-{row}.json"))]));
        all.extend(keys(more));
        Rows::new(Keys::new()).row(7, &all)
    }

    #[test]
    fn keys_become_a_command_line() {
        let many =
            |texts: &[&str]| Given::Many(texts.iter().map(|&text| text.to_owned()).collect());
        let more = [
            ("physical", cell("true")),
            ("range", many(&["20", "120"])),
            ("scale", many(&["2", "3"])),
        ];
        let row = path(&more).unwrap();
        let expected = "path --end=3,4 --end=5,6 --output=a-7.json --physical --range=20,120 --scale=2 \
                        --scale=3 --source=1,2 -- in/a.nii.gz";
        assert_eq!(row.arguments.join(" "), expected);
        assert_eq!((row.name.as_str(), row.number), ("a.nii.gz", 7));
        assert_eq!(row.inputs, [PathBuf::from("in/a.nii.gz")]);
        assert_eq!(row.outputs, [PathBuf::from("a-7.json")]);
        assert!(row.takes_threads && row.takes_quiet);
        assert!(!path(&[("threads", cell("1"))]).unwrap().takes_threads);
    }

    #[test]
    fn mistakes_are_told_in_one_line() {
        for (key, value, words) in [
            ("zource", cell("1,2"), &["--zource", "--source"][..]),
            ("medium_file", cell("a.npy"), &["--medium_file", "--medium-file"]),
            ("source", cell("1"), &["'1'", "--source", "x,y"]),
            ("source", Given::Many(vec!["1".into(), "2".into()]), &["'1'", "--source", "x,y"]),
            ("medium", cell("tubes"), &["tubes", "vesselness"]),
            ("physical", cell("yes"), &["`physical`", "true or false"]),
            ("power", Given::Flag(true), &["`power`", "needs a value"]),
            ("command", cell("paint"), &["paint", "mesh path", "keypoints"]),
            ("command", cell("mesh"), &["mesh", "mesh distance"]),
            ("command", cell("batch"), &["batch", "must be one of"]),
            ("json", cell("true"), &["`json`", "log"]),
            ("force", cell("true"), &["`force`", "heatpath batch --force"]),
            ("tolerance", cell("2"), &["`tolerance` needs a `truth`"]),
            ("truth", cell("t.png"), &["`truth` needs a `tolerance`"]),
            ("help", cell("true"), &["help"]),
        ] {
            let error = path(&[(key, value)]).unwrap_err();
            assert!(words.iter().all(|word| error.contains(word)), "{error}");
            assert!(!error.contains('\n') && !error.contains("Usage"), "{error}");
        }
        let missing = keys(&[("command", cell("path")), ("input", cell("a.png"))]);
        let error = Rows::new(Keys::new()).row(1, &missing).unwrap_err();
        assert!(error.contains("required") && error.contains("--source"), "{error}");
    }

    #[test]
    fn a_truth_is_compared_with_the_output() {
        let more = [
            ("truth", cell("{stem}.png")),
            ("tolerance", cell("1; 2")),
            ("mask", cell("view.png")),
        ];
        let row = path(&more).unwrap();
        let expected = "evaluate --extracted=a-7.json --mask=view.png --tolerance=1 --tolerance=2 \
                        --truth=a.png";
        assert_eq!(row.evaluation.unwrap().join(" "), expected);
        assert_eq!(row.inputs.last(), Some(&PathBuf::from("a.png")));
    }

    #[test]
    fn defaults_are_for_those_who_can_use_them() {
        let defaults = [("command", cell("path")), ("end", cell("1,1")), ("power", cell("2"))];
        let mut rows = Rows::new(keys(&defaults));
        rows.defaults.extend(keys(&[("tolerance", cell("2"))]));
        let files = [("input", cell("a.png")), ("source", cell("1,2")), ("output", cell("d.npy"))];
        let mut distance = keys(&files);
        distance.extend(keys(&[("command", cell("distance"))]));
        let distance = rows.row(1, &distance).unwrap();
        assert_eq!(distance.arguments[1..3], ["--output=d.npy", "--power=2"]);
        assert_eq!(rows.idle_default(std::slice::from_ref(&distance)), Some("end"));
        let path = rows.row(2, &keys(&files)).unwrap();
        assert!(path.arguments.contains(&"--end=1,1".to_owned()));
        assert_eq!(rows.idle_default(&[distance, path]), None);
    }
}
