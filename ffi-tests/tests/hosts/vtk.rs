//! VTK: volumes whose extent begins anywhere, and meshes of quadrilaterals.

use crate::harness::{Host, has_cmake_and, installed, workplace};
use crate::volume::{self, END, ORIGIN, SIZE, SOURCE, SPACING, argument, place};
use heatpath_ffi_tests::{run, text};
use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_cmake_and("libvtk9-dev");
    vec![Host { name: "vtk", package: "libvtk9-dev", present, run: vtk }]
}

fn vtk() {
    let programs = installed().build("vtk");
    for (kind, element) in [("|u1", "UInt8"), ("<i2", "Int16"), ("<f4", "Float32")] {
        traces(&programs.join("trace"), kind, element);
    }
    measures_a_sphere(&programs.join("sphere"));
}

/// Where the extent of the volume begins.
const BEGIN: [f64; 3] = [5.0, -3.0, 2.0];

/// Writes the volume for VTK, whose origin is where the indices are 0, outside this one.
fn write_vti(element: &str) -> PathBuf {
    let axes = volume::axes();
    let words = |numbers: &[f64]| numbers.iter().map(|n| format!("{n} ")).collect::<String>();
    let extent: Vec<f64> =
        (0..3).flat_map(|axis| [BEGIN[axis], BEGIN[axis] + SIZE[axis] as f64 - 1.0]).collect();
    let begin = place(BEGIN);
    let origin: [f64; 3] = std::array::from_fn(|axis| 2.0 * ORIGIN[axis] - begin[axis]);
    let direction: Vec<f64> = (0..9).map(|i| axes[i % 3][i / 3]).collect();
    let values: String = volume::voxels().map(|voxel| format!("{voxel} ")).collect();
    let file = format!(
        "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"{0}\" \
         Origin=\"{1}\" Spacing=\"{2}\" Direction=\"{3}\"><Piece Extent=\"{0}\">\
         <PointData Scalars=\"grey\"><DataArray type=\"{element}\" Name=\"grey\" format=\"ascii\">\n\
         {values}\n</DataArray></PointData></Piece></ImageData></VTKFile>\n",
        words(&extent),
        words(&origin),
        words(&SPACING),
        words(&direction),
    );
    volume::file("vtk", "volume.vti", file.as_bytes())
}

fn traces(program: &Path, kind: &str, element: &str) {
    let output = workplace("vtk").join("traced");
    let mut trace = Command::new(program);
    trace.arg(write_vti(element)).args([SOURCE, END].map(|index| argument(place(index))));
    let printed = text(&run(trace.arg(&output)));
    let distances = volume::command_agrees(kind, "vtk", &printed);
    let written = fs::read(output.with_extension("vti")).unwrap();
    let found = written.windows(distances.len()).any(|bytes| bytes == distances);
    assert!(found, "{element}: the distances differ");
    volume::assert_in_place(&points(&output.with_extension("vtp")), &printed);
}

/// The points of a VTP file in text.
fn points(path: &Path) -> Vec<[f64; 3]> {
    let file = fs::read_to_string(path).unwrap();
    let (_, points) = file.split_once("<Points>").unwrap();
    let (_, array) = points.split_once('>').unwrap();
    let (numbers, _) = array.split_once('<').unwrap();
    let numbers = numbers.split_whitespace().map(|number| number.parse().unwrap());
    numbers.collect::<Vec<f64>>().as_chunks().0.to_vec()
}

/// Half a great circle is pi long; the mesh of quadrilaterals lies a little inside the sphere.
fn measures_a_sphere(program: &Path) {
    let [surface, path] = ["sphere.vtp", "path.vtp"].map(|name| workplace("vtk").join(name));
    let printed = text(&run(Command::new(program).args([&surface, &path])));
    let number = |name: &str| -> f64 {
        let words: Vec<&str> = printed.split_whitespace().collect();
        let at = words.iter().position(|word| *word == name).unwrap();
        words[at + 1].parse().unwrap()
    };
    assert!(number("mean") < 1e-3, "{printed}");
    assert!(number("largest") < 2e-3, "{printed}");
    assert!((number("path") - PI).abs() < 2e-3, "{printed}");
    let points = points(&path);
    let length: f64 = points.windows(2).map(|pair| volume::distance(pair[0], pair[1])).sum();
    assert!((length - number("path")).abs() < 1e-5, "{length} is not the length of\n{printed}");
    assert!(fs::read_to_string(&surface).unwrap().contains("Name=\"distance\""));
}
