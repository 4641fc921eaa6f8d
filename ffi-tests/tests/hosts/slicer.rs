//! The modules of 3D Slicer in programs of its kind: described to ctk-cli, Girder and nipype, and
//! run by nipype, with the results of the command.

#[path = "../../../plugins/slicer/tests/inputs/files.rs"]
mod files;

use crate::harness::{Host, heatpath, workplace};
use files::{MESH, nrrd};
use heatpath_ffi_tests::{program, repository, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || python().is_file();
    vec![Host { name: "slicer", package: "nipype, from PyPI,", present, run: slicer }]
}

/// The volume is turned and shifted in the world.
const WORLD: &str = "space: left-posterior-superior\nspace directions: (0,1,0) (-1,0,0) (0,0,1.5)\n\
                     kinds: domain domain domain\nspace origin: (40,50,-80)\n";

/// The Python of the virtual environment that `.ci/hosts` makes.
fn python() -> PathBuf {
    repository("target/slicer/bin/python3")
}

fn slicer() {
    let folder = workplace("slicer");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("volume.nrrd"), nrrd(WORLD)).unwrap();
    fs::write(folder.join("sources.csv"), "29,52,-65.5\n").unwrap();
    fs::write(folder.join("ends.csv"), "30,73,-74\n32.5,60,-74\n").unwrap();
    fs::write(folder.join("mesh.off"), MESH).unwrap();
    let programs = program("heatpath-slicer", "HeatpathDistance");
    let path = std::env::var("PATH").unwrap_or_default();
    let mut drive = Command::new(python());
    drive.env("PATH", format!("{}:{path}", programs.parent().unwrap().display()));
    // nipype would ask the network for its latest version.
    drive.env("NO_ET", "1");
    drive.arg(repository("ffi-tests/hosts/slicer/drive.py"));
    run(drive.arg(&folder));
    results_are_those_of_the_command(&folder);
}

fn results_are_those_of_the_command(folder: &Path) {
    let place = |name: &str| folder.join(name).display().to_string();
    let volume = format!("{} --physical", place("volume.nrrd"));
    let (sources, ends) = (place("sources.csv"), place("ends.csv"));
    let votes = folder.join("command.votes.nrrd");
    for (name, line) in [
        (
            "distance.nrrd",
            format!(
                "distance {volume} --sources {sources} --medium combined --power 2 --contrast 0.05 \
                 --range 0,200"
            ),
        ),
        ("path.vtp", format!("path {volume} --sources {sources} --ends {ends}")),
        (
            "tree.vtp",
            format!(
                "vote {volume} --medium vesselness --scale 1.5,2 --polarity bright --density {}",
                votes.display()
            ),
        ),
        (
            "mesh.vtp",
            format!(
                "mesh distance {} --source 0,0,0.1 --source 4,6,0 --method heat",
                place("mesh.off")
            ),
        ),
    ] {
        let expected = folder.join("command").with_extension(name);
        heatpath(line.split_whitespace(), &expected);
        assert!(fs::read(folder.join(name)).unwrap() == fs::read(&expected).unwrap(), "{name}");
    }
    assert!(fs::read(folder.join("votes.nrrd")).unwrap() == fs::read(votes).unwrap(), "votes");
}
