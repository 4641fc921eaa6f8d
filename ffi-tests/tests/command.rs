//! The C program and the command give the same distances, to the last bit.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_ffi_tests::{Workshop, repository, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The command, built in the profile of this test; usually cargo has done so already.
fn heatpath() -> PathBuf {
    let profile = if cfg!(debug_assertions) { "dev" } else { "release" };
    let mut build = Command::new(env!("CARGO"));
    build.args(["build", "--quiet", "--locked", "--package", "heatpath-cli", "--profile", profile]);
    run(build.current_dir(repository(".")));
    // This test runs in the folder `deps` beside the command.
    let test = std::env::current_exe().unwrap();
    test.ancestors().nth(2).unwrap().join("heatpath")
}

/// Writes a picture of 120 x 90 grey values without symmetry.
fn write_pgm(path: &Path) {
    let grey = |i: u32| {
        let (x, y) = (f64::from(i % 120), f64::from(i / 120));
        (128.0 + 90.0 * (0.07 * x + 0.02 * y).sin() * (0.11 * y + 1.0).cos()) as u8
    };
    let mut bytes = b"P5\n120 90\n255\n".to_vec();
    bytes.extend((0..120 * 90).map(grey));
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn the_c_program_and_the_command_agree() {
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), "command");
    let program = workshop.build("distance.c");
    let [picture, raw, npy] = ["picture.pgm", "raw", "distances.npy"].map(|n| workshop.path(n));
    write_pgm(&picture);
    run(Command::new(program).arg(&picture).args(["31.25", "40"]).arg(&raw));
    run(Command::new(heatpath())
        .arg("distance")
        .arg(&picture)
        .args(["--source", "31.25,40", "--quiet", "-o"])
        .arg(&npy));
    let (raw, npy) = (std::fs::read(raw).unwrap(), std::fs::read(npy).unwrap());
    // What follows the header of an NPY file are the same doubles (little-endian, as here).
    assert_eq!(raw.len(), 120 * 90 * 8);
    assert!(npy.ends_with(&raw), "the distances differ");
}
