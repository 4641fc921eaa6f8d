//! What a call takes beside the caller's image and result: the image is not copied as it is.

use crate::harness::{Host, compile, has_program, installed};
use heatpath_ffi_tests::{run, text};
use std::path::Path;
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_program("pkg-config");
    vec![Host { name: "memory", package: "pkg-config", present, run: memory }]
}

const SIDE: u32 = 2048;

/// Bytes a pixel, for an image of some type of pixels.
fn taken(program: &Path, kind: u32, estimator: u32) -> f64 {
    let mut command = Command::new(program);
    command.args([kind, SIDE, estimator].map(|number| number.to_string()));
    command.env("LD_LIBRARY_PATH", installed().path("lib"));
    text(&run(&mut command)).trim().parse().unwrap()
}

fn memory() {
    let program = compile("memory", "benches/capi/memory.c", &[], &["--cflags", "--libs"]);
    for estimator in [heatpath::HP_NORMALIZED, heatpath::HP_EIKONAL] {
        let [small, large] =
            [heatpath::HP_U8, heatpath::HP_F64].map(|kind| taken(&program, kind, estimator));
        // A copy of the image would take 1 byte a pixel of the one, and 8 of the other.
        assert!((small - large).abs() < 1.0, "{small} and {large} bytes a pixel");
        assert!(small > 8.0 && small < 40.0, "{small} bytes a pixel");
    }
}
