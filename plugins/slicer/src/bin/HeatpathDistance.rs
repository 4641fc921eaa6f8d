//! A command line module of 3D Slicer, see `heatpath_slicer`.

use heatpath_slicer::modules::DISTANCE;
use std::process::ExitCode;

fn main() -> ExitCode {
    heatpath_slicer::main(&DISTANCE)
}
