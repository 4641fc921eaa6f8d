//! heatpath in napari, and from Python without it.

use crate::harness::{Host, VERSION, installed, workplace};
use heatpath_ffi_tests::{heatpath, repository, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let has_python = || program("python3").is_file();
    let has_screen = || program("napari").is_file() && Path::new("/usr/bin/xvfb-run").is_file();
    let package = "napari, from PyPI, or xvfb,";
    vec![
        Host { name: "python", package, present: has_python, run: library },
        Host { name: "napari", package, present: has_screen, run: widgets },
    ]
}

/// A program of the virtual environment that `.ci/hosts` makes.
fn program(name: &str) -> PathBuf {
    repository("target/napari/bin").join(name)
}

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = workplace(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Lets Python find a package, and the package the library.
fn with_package(mut command: Command, package: PathBuf) -> Command {
    command.env("PYTHONPATH", package).env("PYTHONDONTWRITEBYTECODE", "1");
    command.env("HEATPATH_LIBRARY", installed().path("lib/libheatpath.so.0"));
    command
}

fn library() {
    let python = Command::new(program("python3"));
    let mut python = with_package(python, repository("plugins/napari"));
    python.arg(repository("ffi-tests/hosts/napari/library.py"));
    run(python.arg(heatpath()).arg(folder("python")));
}

/// Installs the package without a network into a folder of its own.
fn install(folder: &Path) -> PathBuf {
    let (source, package) = (folder.join("source"), folder.join("package"));
    // pip leaves files beside what it builds.
    run(Command::new("cp").arg("-r").args([&repository("plugins/napari"), &source]));
    let mut pip = Command::new(program("python3"));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-index"]);
    pip.args(["--no-deps", "--no-build-isolation", "--target"]).args([&package, &source]);
    run(&mut pip);
    package
}

fn widgets() {
    let folder = folder("napari");
    let package = install(&folder);
    assert!(package.join(format!("heatpath_napari-{VERSION}.dist-info")).is_dir());
    let mut validate = with_package(Command::new(program("npe2")), package.clone());
    run(validate.args(["validate", "heatpath-napari"]));
    let mut napari = with_package(Command::new("xvfb-run"), package);
    napari.args(["--auto-servernum", "--server-args", "-screen 0 1280x900x24"]);
    napari.env("NAPARI_CONFIG", folder.join("settings.yaml")).env("XDG_CACHE_HOME", &folder);
    napari.arg(program("python3")).arg(repository("ffi-tests/hosts/napari/widgets.py"));
    run(napari.arg(folder.join("window.png")));
    assert!(folder.join("window.png").is_file());
}
