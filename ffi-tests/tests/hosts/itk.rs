//! ITK: volumes that are turned in space, and fast marching beside that of ITK.

use crate::harness::{Host, has_cmake_and, installed, workplace};
use crate::volume::{self, END, ORIGIN, SIZE, SOURCE, SPACING, argument, place};
use heatpath_ffi_tests::{run, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_cmake_and("libinsighttoolkit5-dev");
    vec![Host { name: "itk", package: "libinsighttoolkit5-dev", present, run: itk }]
}

fn itk() {
    let programs = installed().build("itk");
    for (kind, element) in [("<i2", "MET_SHORT"), ("<f4", "MET_FLOAT")] {
        traces(&programs.join("trace"), kind, element);
    }
    marches(&programs.join("fast_marching"));
}

/// Writes the volume as `MetaImage`.
fn write_mha(kind: &str, element: &str) -> PathBuf {
    let words = |numbers: &[f64]| numbers.iter().map(|n| format!(" {n}")).collect::<String>();
    let header = format!(
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n\
         TransformMatrix ={}\nOffset ={}\nElementSpacing ={}\nDimSize ={}\n\
         ElementType = {element}\nElementDataFile = LOCAL\n",
        words(volume::axes().as_flattened()),
        words(&ORIGIN),
        words(&SPACING),
        words(&SIZE.map(|size| size as f64)),
    );
    volume::file("itk", "volume.mha", &[header.into_bytes(), volume::bytes(kind)].concat())
}

fn traces(program: &Path, kind: &str, element: &str) {
    let output = workplace("itk").join("traced");
    let mut trace = Command::new(program);
    trace.arg(write_mha(kind, element)).args([SOURCE, END].map(|index| argument(place(index))));
    let printed = text(&run(trace.arg(&output)));
    let distances = volume::command_agrees(kind, "itk", &printed);
    let written = fs::read(output.with_extension("mha")).unwrap();
    assert!(written.ends_with(&distances), "{kind}: the distances differ");
    let csv = fs::read_to_string(output.with_extension("csv")).unwrap();
    let points = csv.lines().skip(1).map(|line| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        [numbers[0], numbers[1], numbers[2]]
    });
    volume::assert_in_place(&points.collect::<Vec<_>>(), &printed);
}

/// The errors of both, and what they differ by, in parts of the mean distance.
fn marches(program: &Path) {
    let printed = text(&run(&mut Command::new(program)));
    let means = ["distance", "itk", "heatpath", "difference"].map(|name| {
        let line = printed.lines().find(|line| line.starts_with(name)).unwrap();
        line.split(' ').nth(2).unwrap().parse::<f64>().unwrap()
    });
    let [_, itk, heatpath, difference] = means.map(|mean| mean / means[0]);
    assert!(itk < 0.06, "{printed}");
    assert!(heatpath < 1e-4, "{printed}");
    assert!((difference - itk).abs() < 1e-3, "next to ITK's error ours is none: {printed}");
}
