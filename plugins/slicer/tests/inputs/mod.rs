//! Inputs for the modules.

mod files;

use files::{MESH, nrrd};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const PROGRAMS: [(&str, &str); 4] = [
    ("HeatpathDistance", env!("CARGO_BIN_EXE_HeatpathDistance")),
    ("HeatpathPath", env!("CARGO_BIN_EXE_HeatpathPath")),
    ("HeatpathVesselTree", env!("CARGO_BIN_EXE_HeatpathVesselTree")),
    ("HeatpathMeshDistance", env!("CARGO_BIN_EXE_HeatpathMeshDistance")),
];

/// The program of a module.
pub(crate) fn program(name: &str) -> &'static Path {
    Path::new(PROGRAMS.iter().find(|(own, _)| *own == name).unwrap().1)
}

/// A folder with a volume, a mesh, points, and folders for the outputs of two `sides`.
pub(crate) fn inputs(sides: [&str; 2]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("volume.nrrd"), nrrd("")).unwrap();
    fs::write(path.join("mesh.off"), MESH).unwrap();
    fs::write(path.join("points.csv"), "1,11,10.5\n").unwrap();
    for side in sides {
        fs::create_dir(path.join(side)).unwrap();
    }
    folder
}

/// The words of a line, of which `%name` is an input in `folder` and `@name` an output of a side.
pub(crate) fn words(line: &str, folder: &Path, side: &str) -> Vec<String> {
    let place = |word: &str| match word.split_at(1) {
        ("%", name) => folder.join(name).display().to_string(),
        ("@", name) => folder.join(side).join(name).display().to_string(),
        _ => word.to_owned(),
    };
    line.split_whitespace().map(place).collect()
}

/// Compares all files of two sides; returns how many there are.
pub(crate) fn compare(folder: &Path, sides: [&str; 2]) -> usize {
    let [own, other] = sides.map(|side| folder.join(side));
    let mut files = 0;
    for file in fs::read_dir(&other).unwrap() {
        let file = file.unwrap().file_name();
        let [found, expected] = [&own, &other].map(|side| fs::read(side.join(&file)).unwrap());
        assert!(found == expected, "{} differs", file.display());
        files += 1;
    }
    assert_eq!(files, fs::read_dir(&own).unwrap().count());
    files
}
