//! The programs do what a host asks, and their results are those of the command.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod inputs;

use base64::Engine;
use heatpath_slicer::description;
use heatpath_slicer::modules::{ALL, DISTANCE};
use inputs::{compare, inputs, program, words};
use std::ffi::OsString;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Output, Stdio};

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn programs_describe_themselves() {
    for module in ALL {
        let output = Command::new(program(module.name)).arg("--xml").output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty());
        assert_eq!(text(&output.stdout), description(module));
    }
}

#[test]
fn programs_have_a_picture() {
    let output = Command::new(program("HeatpathPath")).arg("--logo").output().unwrap();
    let lines: Vec<&str> = text(&output.stdout).lines().collect();
    assert_eq!(lines[..4], ["LOGO", "48", "48", "3"]);
    assert_eq!(lines[4], lines[5].len().to_string());
    let packed = base64::engine::general_purpose::STANDARD.decode(lines[5]).unwrap();
    let mut pixels = Vec::new();
    flate2::read::ZlibDecoder::new(&packed[..]).read_to_end(&mut pixels).unwrap();
    assert_eq!(pixels.len(), 48 * 48 * 3);
    // The source is white.
    assert_eq!(pixels[(33 * 48 + 14) * 3..][..3], [255; 3]);
}

const SIDES: [&str; 2] = ["module", "command"];

/// Runs a program and the command, and compares the files that they write; returns how often the program tells how
/// far it is.
fn agree(name: &str, given: &str, command: &str) -> usize {
    let folder = inputs(SIDES);
    let folder = folder.path();
    let returned = folder.join("returned");
    let mut module = Command::new(program(name));
    module.args(words(given, folder, "module")).arg("--returnparameterfile").arg(&returned);
    let told = check_protocol(name, &module.output().unwrap());
    assert_eq!(fs::read(returned).unwrap(), b"");
    let command = words(command, folder, "command");
    heatpath_cli::heatpath(command.into_iter().map(OsString::from)).unwrap();
    assert_eq!(compare(folder, SIDES), given.matches('@').count());
    told
}

/// Standard error is silent, and standard output holds whole elements with rising numbers; returns how
/// many.
fn check_protocol(name: &str, output: &Output) -> usize {
    assert_eq!(text(&output.stderr), "");
    assert!(output.status.success(), "{}", output.status);
    let lines: Vec<&str> = text(&output.stdout).lines().collect();
    let start = format!("<filter-start><filter-name>{name}</filter-name>");
    assert!(lines[0].starts_with(&start) && lines[0].ends_with("</filter-start>"), "{}", lines[0]);
    let end = format!("<filter-end><filter-name>{name}</filter-name><filter-time>");
    assert!(lines.last().unwrap().starts_with(&end));
    let number = |line: &&str| -> f64 {
        let number = line.strip_prefix("<filter-progress>").unwrap();
        number.strip_suffix("</filter-progress>").unwrap().parse().unwrap()
    };
    let numbers: Vec<f64> = lines[1..lines.len() - 1].iter().map(number).collect();
    assert!(numbers.is_sorted() && numbers.iter().all(|n| (0.0..=1.0).contains(n)), "{numbers:?}");
    // Work that is done at once tells nothing on the way.
    assert!(numbers.last().is_none_or(|&last| last == 1.0), "{numbers:?}");
    numbers.len()
}

#[test]
fn distances_are_those_of_the_command() {
    let told = agree(
        "HeatpathDistance",
        "%volume.nrrd @d.npy --source 1,11,10.5 --power 2.000000 --threads 0 --floor 0.000000",
        "heatpath distance %volume.nrrd -o @d.npy --physical --source 1,11,10.5 --power 2 --quiet",
    );
    assert!(told > 5, "{told}");
    agree(
        "HeatpathDistance",
        "--sourcesFile %points.csv --medium vesselness --scale 1.5,2 --estimator eikonal %volume.nrrd @d.npy",
        "heatpath distance %volume.nrrd -o @d.npy --physical --sources %points.csv --medium vesselness \
         --scale 1.5,2 --estimator eikonal --quiet",
    );
}

#[test]
fn paths_are_those_of_the_command() {
    agree(
        "HeatpathPath",
        "%volume.nrrd @p.vtp --source 1,11,10.5 --end 22,8,7 --end 12.5,10,6 --range 0,255",
        "heatpath path %volume.nrrd -o @p.vtp --physical --source 1,11,10.5 --end 22,8,7 \
         --end 12.5,10,6 --quiet",
    );
}

#[test]
fn trees_are_those_of_the_command() {
    agree(
        "HeatpathVesselTree",
        "%volume.nrrd @t.vtp --outputDensity @n.npy --scale 1.5,2 --polarity bright --prune 3",
        "heatpath vote %volume.nrrd -o @t.vtp --density @n.npy --physical --medium vesselness \
         --scale 1.5,2 --polarity bright --prune 3 --quiet",
    );
    agree(
        "HeatpathVesselTree",
        "%volume.nrrd @t.vtp --scaleChoice auto --polarity bright",
        "heatpath vote %volume.nrrd -o @t.vtp --physical --medium vesselness --scale auto \
         --polarity bright --quiet",
    );
}

#[test]
fn distances_on_meshes_are_those_of_the_command() {
    agree(
        "HeatpathMeshDistance",
        "%mesh.off @m.vtp --source 0,0,0.1 --source 4,6,0 --method heat",
        "heatpath mesh distance %mesh.off -o @m.vtp --source 0,0,0.1 --source 4,6,0 --method heat \
         --quiet",
    );
}

#[test]
fn a_failure_is_one_line() {
    let folder = inputs(SIDES);
    let (volume, out) = (folder.path().join("volume.nrrd"), folder.path().join("out.npy"));
    for (more, code, line) in [
        (&["--source", "1,90,1"][..], 3, "source 0 at [1.0, 90.0, 1.0] lies outside the grid of"),
        (&["--source", "1,2"], 2, "--source 1,2: has 2 numbers, but the input is a volume"),
        (&[], 2, "the following required arguments were not provided: <--source <X,Y[,Z]>"),
        (&["--source", "1,2,3", "--power", "much"], 2, "invalid value 'much' for '--power <N>'"),
        (
            &[
                "--source",
                "1,2,3",
                "--medium",
                "vesselness",
                "--scale",
                "2",
                "--scaleChoice",
                "auto",
            ],
            2,
            "--scale: `auto` stands alone",
        ),
        (&["--bogus"], 2, "unexpected argument '--bogus' found"),
    ] {
        let output =
            Command::new(program(DISTANCE.name)).args([&volume, &out]).args(more).output().unwrap();
        let message = text(&output.stderr);
        let expected = format!("HeatpathDistance: error: {line}");
        assert!(message.starts_with(&expected) && message.lines().count() == 1, "{message}");
        assert_eq!(output.status.code(), Some(code), "{message}");
        assert!(!out.exists());
    }
}

#[test]
fn a_module_that_is_killed_leaves_nothing() {
    let folder = inputs(SIDES);
    let line = "%volume.nrrd @out.npy --source 1,2,3 --iterations 1000000000";
    let mut module = Command::new(program("HeatpathDistance"));
    module.args(words(line, folder.path(), "module")).stdout(Stdio::piped());
    let mut child = module.spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("<filter-start>"), "{line}");
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(fs::read_dir(folder.path().join("module")).unwrap().count(), 0);
}
