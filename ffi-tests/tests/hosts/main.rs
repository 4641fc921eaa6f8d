//! heatpath in the software of others, where that is installed; one file a host.
//!
//! The programs are in `ffi-tests/hosts`. `.ci/test` installs what the light hosts need and
//! `.ci/hosts` the rest; a host that is missing is reported as ignored, with the name of its package.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod abi;
mod debian;
mod dicom;
mod empty;
mod emulator;
mod harness;
mod itk;
mod loader;
mod memory;
mod napari;
mod opencv;
mod orthanc;
mod paraview;
mod report;
mod slicer;
mod volume;
mod vtk;

use harness::Host;
use libtest_mimic::{Arguments, run};

fn main() {
    let arguments = Arguments::from_args();
    let hosts = [
        abi::hosts(),
        debian::hosts(),
        emulator::hosts(),
        empty::hosts(),
        itk::hosts(),
        loader::hosts(),
        memory::hosts(),
        napari::hosts(),
        opencv::hosts(),
        orthanc::hosts(),
        paraview::hosts(),
        report::hosts(),
        slicer::hosts(),
        vtk::hosts(),
    ];
    let hosts = hosts.into_iter().flatten();
    run(&arguments, hosts.map(Host::trial).collect()).exit();
}
