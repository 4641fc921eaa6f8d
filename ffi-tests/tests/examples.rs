//! The examples do what they say, and give what the command gives, to the last bit.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_ffi_tests::{Workshop, heatpath, run, text, valgrind};
use std::fs;
use std::path::Path;
use std::process::Command;

const SIZE: [usize; 2] = [120, 90];

fn workshop(name: &str) -> Workshop {
    Workshop::new(env!("CARGO_TARGET_TMPDIR"), &format!("example_{name}"))
}

/// Writes a picture with dark lines that cross.
fn write_pgm(path: &Path) {
    let mut bytes = format!("P5\n{} {}\n255\n", SIZE[0], SIZE[1]).into_bytes();
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x as f64, y as f64)));
    bytes.extend(pixels.map(|(x, y)| {
        let [one, other] = [y - 20.0 - 0.4 * x, y - 75.0 + 0.5 * x].map(|d| (-d * d / 8.0).exp());
        (190.0 + 10.0 * (0.3 * x + 0.2 * y).sin() - 120.0 * one.max(other)) as u8
    }));
    fs::write(path, bytes).unwrap();
}

/// The numbers that a program prints.
fn numbers(output: &str) -> Vec<f64> {
    output.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

fn json(path: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn a_path_is_that_of_the_command() {
    let workshop = workshop("path");
    let program = workshop.example("path.cpp");
    let [picture, curves] = ["lines.pgm", "path.json"].map(|name| workshop.path(name));
    write_pgm(&picture);
    run(Command::new(heatpath())
        .arg("path")
        .arg(&picture)
        .args(["--source", "10,24", "--end", "110.5,64", "--quiet", "-o"])
        .arg(&curves));
    let points = json(&curves)["paths"][0]["points"].as_array().unwrap().clone();
    let expected: Vec<f64> = points
        .iter()
        .flat_map(|point| point.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()))
        .collect();
    for mut command in [Command::new(&program), valgrind(&program)] {
        let output = run(command.arg(&picture).args(["10", "24", "110.5", "64"]));
        assert_eq!(numbers(&text(&output)), expected);
    }
}

#[test]
fn a_tree_is_that_of_the_command() {
    let workshop = workshop("vessels");
    let program = workshop.example("vessels.cpp");
    let [picture, tree] = ["lines.pgm", "tree.json"].map(|name| workshop.path(name));
    write_pgm(&picture);
    run(Command::new(heatpath())
        .arg("vote")
        .arg(&picture)
        .args(["--medium", "vesselness", "--polarity", "dark", "--quiet", "-o"])
        .arg(&tree));
    let branches = json(&tree)["paths"].as_array().unwrap().clone();
    assert!(branches.len() > 3, "two lines that cross");
    let fields = ["from", "to", "physical_length", "mean_radius"];
    let expected: Vec<f64> = branches
        .iter()
        .flat_map(|branch| fields.map(|field| branch[field].as_f64().unwrap()))
        .collect();
    for mut command in [Command::new(&program), valgrind(&program)] {
        let output = command.arg(&picture).output().unwrap();
        assert!(output.status.success(), "{}", text(&output));
        assert_eq!(numbers(&String::from_utf8_lossy(&output.stdout)), expected);
        assert!(String::from_utf8_lossy(&output.stderr).contains("100 %"));
    }
}

#[test]
fn a_matrix_of_distances_is_almost_symmetric() {
    let workshop = workshop("matrix");
    let program = workshop.example("matrix.cpp");
    let picture = workshop.path("lines.pgm");
    write_pgm(&picture);
    for mut command in [Command::new(&program), valgrind(&program)] {
        let points = ["10", "24", "110", "64", "60", "45"];
        let output = text(&run(command.arg(&picture).arg("0.3").args(points)));
        let matrix: Vec<Vec<f64>> = output.lines().map(numbers).collect();
        assert_eq!(matrix.len(), 3);
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let [one, other] = [matrix[i][j], matrix[j][i]];
            assert!(one > 40.0 && (one / other - 1.0).abs() < 0.02, "{one} {other}");
        }
    }
}

#[test]
fn a_path_on_a_mesh_is_straight() {
    let workshop = workshop("mesh");
    let program = workshop.example("mesh.cpp");
    let surface = workshop.path("plane.off");
    let mut off = String::from("OFF\n25 32 0\n");
    (0..25).for_each(|i| off += &format!("{} {} 0\n", i % 5, i / 5));
    for (x, y) in (0..16).map(|i| (i % 4, i / 4)) {
        let i = 5 * y + x;
        off += &format!("3 {i} {} {}\n3 {i} {} {}\n", i + 1, i + 6, i + 6, i + 5);
    }
    fs::write(&surface, off).unwrap();
    for mut command in [Command::new(&program), valgrind(&program)] {
        let output = text(&run(command.arg(&surface).arg("4")));
        let (first, points) = output.split_once('\n').unwrap();
        let far = numbers(first);
        assert!(far[0] == 20.0 && (far[1] - 32.0_f64.sqrt()).abs() < 1e-12, "{first}");
        let points: Vec<f64> = numbers(points);
        assert!(points.chunks(3).all(|p| (p[0] + p[1] - 4.0).abs() < 1e-9), "{points:?}");
    }
}

#[test]
fn the_library_is_a_plugin() {
    let workshop = workshop("plugin");
    let program = workshop.example("plugin.c");
    let library = workshop.path("libheatpath.so.0");
    for mut command in [Command::new(&program), valgrind(&program)] {
        let output = text(&run(command.arg(&library)));
        assert_eq!(output, format!("heatpath {}\n20.000000\n", env!("CARGO_PKG_VERSION")));
    }
    let missing = Command::new(&program).arg("no_such_library.so").output().unwrap();
    assert_eq!(missing.status.code(), Some(1));
    assert!(text(&missing).starts_with("plugin: no_such_library.so"));
}
