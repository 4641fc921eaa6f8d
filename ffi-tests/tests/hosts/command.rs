//! The command, with whose results those of viewers are compared.

use heatpath_ffi_tests::run;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// Runs the command with some words and the file for the result.
pub(crate) fn heatpath<'a>(words: impl IntoIterator<Item = &'a str>, output: &Path) {
    static PROGRAM: LazyLock<PathBuf> = LazyLock::new(heatpath_ffi_tests::heatpath);
    let mut command = Command::new(&*PROGRAM);
    command.args(words).args(["--quiet", "--force", "--output"]).arg(output);
    run(&mut command);
}
