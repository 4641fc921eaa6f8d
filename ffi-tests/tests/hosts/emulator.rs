//! A processor without AVX: the library chooses its instructions when it runs, and changes no bit.

use crate::harness::{Host, has_program};
use heatpath_ffi_tests::{Workshop, run};
use std::fs;
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_program("qemu-x86_64");
    vec![Host { name: "old_processor", package: "qemu-user", present, run: old_processor }]
}

const SIZE: [usize; 3] = [24, 20, 9];

fn old_processor() {
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), "hosts_old_processor");
    let program = workshop.build("volume.c");
    let voxels: Vec<u8> = (0..SIZE.iter().product()).map(|i: usize| (i * i % 251) as u8).collect();
    let [raw, here, there] = ["raw", "here", "there"].map(|name| workshop.path(name));
    fs::write(&raw, voxels).unwrap();
    let mut emulator = Command::new("qemu-x86_64");
    emulator.args(["-cpu", "Nehalem"]).arg(&program);
    for (mut command, output) in [(Command::new(&program), &here), (emulator, &there)] {
        command.arg(&raw).args(SIZE.map(|n| n.to_string())).args(["2.5", "4", "5.25", "3"]);
        run(command.arg(output).arg(heatpath::HP_NORMALIZED.to_string()));
    }
    let [here, there] = [here, there].map(|output| fs::read(output).unwrap());
    assert_eq!(here.len(), 8 * SIZE.iter().product::<usize>());
    assert!(here == there, "the distances differ");
}
