//! `heatpath mesh`: the same on triangle meshes.
//!
//! `args.rs` describes the command line; what is read is in `input.rs`, what makes ways short in
//! `medium.rs`, the distances in `solve.rs`, and what is written in `output.rs`.

pub(crate) mod args;
mod curvature;
mod distance;
mod failure;
mod idle;
mod input;
mod medium;
mod output;
mod path;
mod solve;

pub(crate) use output::MeshFacts;

use crate::failure::Failure;
use args::MeshCommand;

pub(crate) fn mesh(command: &MeshCommand) -> Result<(), Failure> {
    match command {
        MeshCommand::Distance(args) => distance::distance(args),
        MeshCommand::Path(args) => path::path(args),
        MeshCommand::Curvature(args) => curvature::curvature(args),
    }
}
