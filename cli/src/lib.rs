//! The `heatpath` command, as a library for programs that are the command under another name.
//!
//! `args.rs` describes the command line, each subcommand has a file with a function of its name,
//! and what several of them need stands beside: what is read (`input.rs`), the distances (`solve.rs`,
//! by `heat.rs` or `eikonal.rs`), the progress bar (`run.rs`), what is written (`output.rs`) and what
//! went wrong (`failure.rs`). `batch/` runs the others many times.

mod args;
mod batch;
mod completions;
mod distance;
mod eikonal;
mod evaluate;
mod extraction;
mod failure;
mod heat;
mod heat_method;
mod info;
mod input;
mod keypoints;
mod medium;
mod mesh;
mod output;
mod path;
mod place;
mod run;
mod solve;
mod structure;
mod vote;

pub use failure::Failure;
pub use run::{be_a_guest, watch};

use args::{Args, Command};
use clap::Parser;
use std::ffi::OsString;
use std::process::ExitCode;

/// The program `heatpath`: does what its command line says, and prints the one line of a failure.
#[must_use]
pub fn main() -> ExitCode {
    let _lock = batch::follow_batch();
    match command(Args::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            output::complain(&failure);
            failure.code().into()
        }
    }
}

/// Does what a command line says; its first word is the name of the program.
///
/// # Errors
/// What the command `heatpath` would print, in one line.
pub fn heatpath(words: impl IntoIterator<Item = OsString>) -> Result<(), Failure> {
    command(Args::try_parse_from(words)?.command)
}

fn command(command: Command) -> Result<(), Failure> {
    match command {
        Command::Distance(args) => distance::distance(&args),
        Command::Path(args) => path::path(&args),
        Command::Vote(args) => vote::vote(&args),
        Command::Keypoints(args) => keypoints::keypoints(&args),
        Command::Medium(args) => medium::medium(&args),
        Command::Mesh(command) => mesh::mesh(&command),
        Command::Evaluate(args) => evaluate::evaluate(&args),
        Command::Batch(args) => batch::batch(&args),
        Command::Info(args) => info::info(&args),
        Command::Completions(args) => completions::completions(&args),
    }
}
