//! The programs do what a host asks, and their results are those of the command.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use base64::Engine;
use heatpath_slicer::description;
use heatpath_slicer::modules::{ALL, DISTANCE};
use std::ffi::OsString;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Output, Stdio};

const PROGRAMS: [(&str, &str); 4] = [
    ("HeatpathDistance", env!("CARGO_BIN_EXE_HeatpathDistance")),
    ("HeatpathPath", env!("CARGO_BIN_EXE_HeatpathPath")),
    ("HeatpathVesselTree", env!("CARGO_BIN_EXE_HeatpathVesselTree")),
    ("HeatpathMeshDistance", env!("CARGO_BIN_EXE_HeatpathMeshDistance")),
];

fn program(name: &str) -> Command {
    Command::new(PROGRAMS.iter().find(|(own, _)| *own == name).unwrap().1)
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn programs_describe_themselves() {
    for module in ALL {
        let output = program(module.name).arg("--xml").output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty());
        assert_eq!(text(&output.stdout), description(module));
    }
}

#[test]
fn programs_have_a_picture() {
    let output = program("HeatpathPath").arg("--logo").output().unwrap();
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

const SIZE: [usize; 3] = [24, 20, 16];

/// A bright tube that winds through a volume.
fn write_volume(path: &Path) {
    let voxel = |i: usize| {
        let [x, y, z] = [i % SIZE[0], i / SIZE[0] % SIZE[1], i / SIZE[0] / SIZE[1]];
        let [x, y, z] = [x, y, z].map(|n| n as f64);
        let (u, v) = (y - 10.0 - 4.0 * (0.25 * x).sin(), z - 8.0 - 3.0 * (0.2 * x).cos());
        (20.0 + 200.0 * (-(u * u + v * v) / 6.0).exp()) as u8
    };
    let [columns, rows, slices] = SIZE;
    let header = format!(
        "{{'descr': '|u1', 'fortran_order': False, 'shape': ({slices}, {rows}, {columns}), }}\n"
    );
    let mut file = b"\x93NUMPY\x01\0".to_vec();
    file.extend((header.len() as u16).to_le_bytes());
    file.extend(header.as_bytes());
    file.extend((0..SIZE.iter().product()).map(voxel));
    fs::write(path, file).unwrap();
}

/// A roof of two rectangles.
const MESH: &str = "OFF\n6 4 0\n0 0 0\n4 0 0\n0 3 1\n4 3 1\n0 6 0\n4 6 0\n\
                    3 0 1 2\n3 1 3 2\n3 2 3 4\n3 3 5 4\n";

/// Words, of which `%name` is an input in `folder` and `@name` an output in a folder there.
fn words(line: &str, folder: &Path, outputs: &str) -> Vec<OsString> {
    let place = |word: &str| match word.split_at(1) {
        ("%", name) => folder.join(name).into(),
        ("@", name) => folder.join(outputs).join(name).into(),
        _ => word.into(),
    };
    line.split_whitespace().map(place).collect()
}

/// Runs a program and the command, and compares the files that they write; returns how often the program tells how
/// far it is.
fn agree(name: &str, given: &str, command: &str) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_volume(&folder.join("volume.npy"));
    fs::write(folder.join("mesh.off"), MESH).unwrap();
    fs::write(folder.join("points.csv"), "1,11,10.5\n").unwrap();
    let [own, commands] = ["module", "command"].map(|name| folder.join(name));
    fs::create_dir(&own).unwrap();
    fs::create_dir(&commands).unwrap();
    let returned = folder.join("returned");
    let mut module = program(name);
    module.args(words(given, folder, "module")).arg("--returnparameterfile").arg(&returned);
    let told = check_protocol(name, &module.output().unwrap());
    assert_eq!(fs::read(returned).unwrap(), b"");
    heatpath_cli::heatpath(words(command, folder, "command")).unwrap();
    let mut files = 0;
    for file in fs::read_dir(&commands).unwrap() {
        let file = file.unwrap().file_name();
        let [found, expected] = [&own, &commands].map(|side| fs::read(side.join(&file)).unwrap());
        assert!(found == expected, "{name}: {} differs", file.display());
        files += 1;
    }
    assert_eq!(files, fs::read_dir(&own).unwrap().count());
    assert_eq!(files, given.matches('@').count());
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
        "%volume.npy @d.npy --source 1,11,10.5 --power 2.000000 --threads 0 --floor 0.000000",
        "heatpath distance %volume.npy -o @d.npy --physical --source 1,11,10.5 --power 2 --quiet",
    );
    assert!(told > 5, "{told}");
    agree(
        "HeatpathDistance",
        "--sourcesFile %points.csv --medium vesselness --scale 1.5,2 --estimator eikonal %volume.npy @d.npy",
        "heatpath distance %volume.npy -o @d.npy --physical --sources %points.csv --medium vesselness \
         --scale 1.5,2 --estimator eikonal --quiet",
    );
}

#[test]
fn paths_are_those_of_the_command() {
    agree(
        "HeatpathPath",
        "%volume.npy @p.vtp --source 1,11,10.5 --end 22,8,7 --end 12.5,10,6 --range 0,255",
        "heatpath path %volume.npy -o @p.vtp --physical --source 1,11,10.5 --end 22,8,7 \
         --end 12.5,10,6 --quiet",
    );
}

#[test]
fn trees_are_those_of_the_command() {
    agree(
        "HeatpathVesselTree",
        "%volume.npy @t.vtp --outputDensity @n.npy --scale 1.5,2 --polarity bright --prune 3",
        "heatpath vote %volume.npy -o @t.vtp --density @n.npy --physical --medium vesselness \
         --scale 1.5,2 --polarity bright --prune 3 --quiet",
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
    let folder = tempfile::tempdir().unwrap();
    let (volume, out) = (folder.path().join("volume.npy"), folder.path().join("out.npy"));
    write_volume(&volume);
    for (more, code, line) in [
        (&["--source", "1,90,1"][..], 3, "source 0 at [1.0, 90.0, 1.0] lies outside the grid of"),
        (&["--source", "1,2"], 2, "--source 1,2: has 2 numbers, but the input is a volume"),
        (&[], 2, "the following required arguments were not provided: <--source <X,Y[,Z]>"),
        (&["--source", "1,2,3", "--power", "much"], 2, "invalid value 'much' for '--power <N>'"),
        (&["--bogus"], 2, "unexpected argument '--bogus' found"),
    ] {
        let output = program(DISTANCE.name).args([&volume, &out]).args(more).output().unwrap();
        let message = text(&output.stderr);
        let expected = format!("HeatpathDistance: error: {line}");
        assert!(message.starts_with(&expected) && message.lines().count() == 1, "{message}");
        assert_eq!(output.status.code(), Some(code), "{message}");
        assert!(!out.exists());
    }
}

#[test]
fn a_module_that_is_killed_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let volume = folder.path().join("volume.npy");
    write_volume(&volume);
    let mut module = program("HeatpathDistance");
    module.arg(&volume).arg(folder.path().join("out.npy"));
    module.args(["--source", "1,2,3", "--iterations", "1000000000"]).stdout(Stdio::piped());
    let mut child = module.spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("<filter-start>"), "{line}");
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "only the input is there");
}
