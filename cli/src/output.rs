//! What the commands say.

use crate::args::OutputArgs;
use crate::failure::Failure;
use heatpath_io::{FieldFormat, check_output};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// Prints the one line that explains a failure.
pub(crate) fn complain(failure: &Failure) {
    // If standard error is closed there is nobody to tell.
    drop(writeln!(io::stderr(), "heatpath: error: {failure}"));
}

/// Tells what was done, on standard error, unless asked to be quiet or to print JSON.
pub(crate) fn tell(out: &OutputArgs, message: &str) {
    if !out.quiet && !out.json {
        drop(writeln!(io::stderr(), "{message}"));
    }
}

/// Tells what to be careful of, on standard error, unless asked to be quiet.
pub(crate) fn warn(out: &OutputArgs, message: &str) {
    if !out.quiet {
        drop(writeln!(io::stderr(), "warning: {message}"));
    }
}

/// Prints one JSON object on standard output.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(value).map_err(Failure::file)?;
    print(&text)
}

/// Prints a line on standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let failed = |error| Failure::file(format!("standard output: {error}"));
    writeln!(io::stdout(), "{text}").map_err(failed)
}

/// Checks before a long computation that the results can be written.
pub(crate) fn check(
    output: Option<&Path>,
    endings: &[&str],
    out: &OutputArgs,
) -> Result<(), Failure> {
    if let Some(output) = output {
        check_output(output, out.format.as_deref(), out.force, endings)?;
    }
    if let Some(overlay) = &out.overlay {
        check_output(overlay, None, out.force, &["png"])?;
        if output == Some(overlay) {
            return Err(Failure::usage(format!(
                "{}: is given as --output and as --overlay; they need two files",
                overlay.display()
            )));
        }
    }
    Ok(())
}

/// Checks that a field can be written to the file of a further option.
pub(crate) fn check_field(
    option: &str,
    file: Option<&Path>,
    output: Option<&Path>,
    out: &OutputArgs,
) -> Result<(), Failure> {
    let Some(file) = file else { return Ok(()) };
    check_output(file, None, out.force, &FieldFormat::ENDINGS)?;
    for (other, name) in [(output, "--output"), (out.overlay.as_deref(), "--overlay")] {
        if other == Some(file) {
            return Err(Failure::usage(format!(
                "{}: is given as {option} and as {name}; they need two files",
                file.display()
            )));
        }
    }
    Ok(())
}

/// Checks, once the input is known, that the results can have `dimension` axes.
pub(crate) fn check_dimension(
    output: Option<&Path>,
    out: &OutputArgs,
    dimension: usize,
) -> Result<(), Failure> {
    if let Some(output) = output {
        heatpath_io::check_dimension(output, out.format.as_deref(), dimension)?;
    }
    Ok(())
}
