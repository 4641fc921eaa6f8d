//! From the command line of a module to that of `heatpath`.

use crate::module::{Kind, Module, Parameter};
use clap::{Arg, ArgAction, ArgMatches, Command};
use heatpath_cli::Failure;
use std::ffi::OsString;
use std::path::PathBuf;

/// What a host asks of a module.
#[derive(Debug, PartialEq)]
pub enum Request {
    /// An answer to `--help` or `--version`.
    Help(String),
    /// The description of the module.
    Xml,
    /// Its picture.
    Logo,
    /// The work.
    Run {
        /// The command line of `heatpath`.
        words: Vec<OsString>,
        /// Where numbers that are results go.
        return_parameters: Option<PathBuf>,
    },
}

/// Reads the command line of a module; its first word is the name of the program.
///
/// # Errors
/// What is wrong with it, in one line.
pub fn command_line(
    module: &Module,
    words: impl IntoIterator<Item = OsString>,
) -> Result<Request, Failure> {
    let given = match parser(module).try_get_matches_from(words) {
        Ok(given) => given,
        Err(error) if error.use_stderr() => return Err(error.into()),
        Err(help) => return Ok(Request::Help(help.to_string())),
    };
    if given.get_flag("xml") {
        return Ok(Request::Xml);
    }
    if given.get_flag("logo") {
        return Ok(Request::Logo);
    }
    let own = module.command.iter().copied().map(OsString::from);
    let chosen = parameters(module).flat_map(|parameter| passed_on(parameter, &given));
    let words = own.chain(chosen).chain(["--quiet", "--force"].map(OsString::from)).collect();
    let return_parameters = given.get_one::<OsString>("returnparameterfile").map(PathBuf::from);
    Ok(Request::Run { words, return_parameters })
}

fn parameters(module: &Module) -> impl Iterator<Item = &Parameter> {
    module.groups.iter().flat_map(|group| group.parameters)
}

fn parser(module: &Module) -> Command {
    let flag = |name| Arg::new(name).long(name).action(ArgAction::SetTrue).exclusive(true);
    let hidden =
        |name| Arg::new(name).long(name).value_parser(clap::value_parser!(OsString)).hide(true);
    Command::new(module.name)
        .version(env!("CARGO_PKG_VERSION"))
        .about(module.description)
        .args_override_self(true)
        .arg(flag("xml").help("Describe this module to a host such as 3D Slicer"))
        .arg(flag("logo").help("Print the picture of this module"))
        // Slicer and programs that imitate it may pass these; the second is for libraries.
        .arg(hidden("returnparameterfile"))
        .arg(hidden("processinformationaddress"))
        .args(parameters(module).map(argument))
}

fn argument(parameter: &Parameter) -> Arg {
    let arg = Arg::new(parameter.name)
        .help(parameter.description)
        .value_parser(clap::value_parser!(OsString))
        .allow_hyphen_values(true);
    match parameter.kind {
        Kind::File { position: Some(position), .. } => arg.index(position + 1).required(true),
        Kind::Points => arg.long(parameter.name).action(ArgAction::Append),
        _ => arg.long(parameter.name),
    }
}

/// The words of the command for what was given, unless that is nothing or the usual.
fn passed_on(parameter: &Parameter, given: &ArgMatches) -> Vec<OsString> {
    let values = given.get_many::<OsString>(parameter.name).into_iter().flatten();
    let chosen = values.filter(|value| !value.is_empty() && !is_usual(&parameter.kind, value));
    chosen
        .flat_map(|value| [OsString::from(parameter.option), value.clone()])
        .filter(|word| !word.is_empty())
        .collect()
}

fn is_usual(kind: &Kind, value: &OsString) -> bool {
    let text = value.to_str().unwrap_or_default();
    match *kind {
        Kind::Number { usual } => text.parse() == Ok(usual),
        Kind::Integer { usual } => text.parse() == Ok(usual),
        Kind::Choice { among } => among.first() == Some(&text),
        Kind::File { .. } | Kind::Points | Kind::Numbers => false,
    }
}
