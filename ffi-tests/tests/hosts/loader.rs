//! A program that loads the library when it runs, also under valgrind.

use crate::harness::{Host, has_program, installed};
use heatpath_ffi_tests::{run, text, valgrind};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_program("cmake") && has_program("ninja");
    vec![Host { name: "loader", package: "cmake", present, run: loader }]
}

fn loader() {
    let program = installed().build("loader").join("loader");
    let linked = text(&run(Command::new("readelf").arg("-d").arg(&program)));
    assert!(!linked.contains("heatpath"), "{linked}");
    for mut command in [Command::new(&program), valgrind(&program)] {
        assert_eq!(text(&run(command.arg(installed().path("lib/libheatpath.so.0")))), "");
    }
}
