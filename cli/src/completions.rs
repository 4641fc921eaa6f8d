//! `heatpath completions`

use crate::args::{Args, CompletionsArgs};
use crate::failure::Failure;
use crate::output;
use clap::CommandFactory;

pub(crate) fn completions(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), "heatpath", &mut script);
    output::print(String::from_utf8_lossy(&script).trim_end())
}
