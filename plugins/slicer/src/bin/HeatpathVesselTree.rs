//! A command line module of 3D Slicer, see `heatpath_slicer`.

use heatpath_slicer::modules::VESSEL_TREE;
use std::process::ExitCode;

fn main() -> ExitCode {
    heatpath_slicer::main(&VESSEL_TREE)
}
