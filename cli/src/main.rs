//! The `heatpath` command.
//!
//! `args.rs` describes the command line, each subcommand has a file with a function of its name,
//! and what several of them need stands beside: what is read (`input.rs`), the distances (`solve.rs`,
//! by `heat.rs` or `eikonal.rs`), the progress bar (`run.rs`), what is written (`output.rs`) and what
//! went wrong (`failure.rs`).

mod args;
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
mod run;
mod solve;
mod structure;
mod vote;

use args::{Args, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let done = match Args::parse().command {
        Command::Distance(args) => distance::distance(&args),
        Command::Path(args) => path::path(&args),
        Command::Vote(args) => vote::vote(&args),
        Command::Keypoints(args) => keypoints::keypoints(&args),
        Command::Medium(args) => medium::medium(&args),
        Command::Mesh(command) => mesh::mesh(&command),
        Command::Evaluate(args) => evaluate::evaluate(&args),
        Command::Info(args) => info::info(&args),
        Command::Completions(args) => completions::completions(&args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            output::complain(&failure);
            failure.code()
        }
    }
}
