//! The `heatpath` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    heatpath_cli::main()
}
