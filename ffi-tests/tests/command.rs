//! The C programs and the command give the same distances, to the last bit.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_ffi_tests::{Workshop, heatpath, run, text, valgrind};
use std::path::Path;
use std::process::Command;

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

/// Columns, rows, slices.
const SIZE: [usize; 3] = [20, 17, 13];

/// Writes the same bytes without a header and as an array of numpy.
fn write_volume(raw: &Path, npy: &Path) {
    let voxel = |i: usize| {
        let [x, y, z] = [i % SIZE[0], i / SIZE[0] % SIZE[1], i / SIZE[0] / SIZE[1]];
        let [x, y, z] = [x, y, z].map(|n| n as f64);
        (128.0 + 100.0 * (0.3 * x + 0.2 * z).sin() * (0.25 * y - 0.1 * z).cos()) as u8
    };
    let voxels: Vec<u8> = (0..SIZE.iter().product()).map(voxel).collect();
    let [columns, rows, slices] = SIZE;
    let file = heatpath_ffi_tests::npy("|u1", &[slices, rows, columns], &voxels);
    std::fs::write(npy, file).unwrap();
    std::fs::write(raw, voxels).unwrap();
}

/// With an estimator by its name for the command and its number for C.
fn agree_on_volumes(estimator: &str, number: u32) {
    let name = format!("command_volume_{estimator}");
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), &name);
    let program = workshop.build("volume.c");
    let [volume, npy, csv] = ["v.npy", "d.npy", "p.csv"].map(|name| workshop.path(name));
    let [raw, distances] = ["v.raw", "d.raw"].map(|name| workshop.path(name));
    write_volume(&raw, &volume);
    let heatpath = heatpath();
    let command = |name: &str, output: &Path, more: &[&str]| {
        let mut command = Command::new(heatpath);
        command.arg(name).arg(&volume).args(["--spacing", "1,1,2.5", "--source", "4,5.25,3"]);
        command.args(["--estimator", estimator, "--quiet", "-o"]).arg(output);
        run(command.args(more));
    };
    command("distance", &npy, &[]);
    command("path", &csv, &["--end", "19,16,12"]);
    let csv = std::fs::read_to_string(csv).unwrap();
    let points = csv.lines().skip(1).map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        [2, 3, 4].map(|i| fields[i].parse::<f64>().unwrap())
    });
    let points: Vec<[f64; 3]> = points.collect();
    for mut program in [Command::new(&program), valgrind(&program)] {
        program.arg(&raw).args(SIZE.map(|n| n.to_string())).args(["2.5", "4", "5.25", "3"]);
        let printed = text(&run(program.arg(&distances).arg(number.to_string())));
        let (raw, npy) = (std::fs::read(&distances).unwrap(), std::fs::read(&npy).unwrap());
        assert_eq!(raw.len(), SIZE.iter().product::<usize>() * 8);
        assert!(npy.ends_with(&raw), "the distances differ");
        let coordinates = printed.lines().flat_map(|line| line.split(','));
        let coordinates: Vec<f64> = coordinates.map(|number| number.parse().unwrap()).collect();
        assert_eq!(coordinates, points.as_flattened(), "the paths differ");
    }
}

#[test]
fn the_c_program_and_the_command_agree_on_heat_in_volumes() {
    agree_on_volumes("normalized", heatpath::HP_NORMALIZED);
}

#[test]
fn the_c_program_and_the_command_agree_on_exact_distances_in_volumes() {
    agree_on_volumes("eikonal", heatpath::HP_EIKONAL);
}
