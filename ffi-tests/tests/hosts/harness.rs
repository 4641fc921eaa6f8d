//! What all hosts share: how they are reported, and one installed heatpath.

use heatpath_ffi_tests::{Prefix, repository, run};
use libtest_mimic::{Completion, Trial};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A test that needs software that may not be there.
pub(crate) struct Host {
    /// What `cargo test --test hosts NAME` finds it by.
    pub(crate) name: &'static str,
    /// The Debian package that brings the software.
    pub(crate) package: &'static str,
    /// Whether the software is there.
    pub(crate) present: fn() -> bool,
    /// Panics if heatpath does not work in this host.
    pub(crate) run: fn(),
}

impl Host {
    /// A missing host is reported as ignored, or with `HEATPATH_REQUIRE_HOSTS=1` as a failure.
    pub(crate) fn trial(self) -> Trial {
        Trial::ignorable_test(self.name, move || {
            if (self.present)() {
                (self.run)();
                return Ok(Completion::Completed);
            }
            let missing = format!("package {} missing: bash .ci/hosts", self.package);
            match std::env::var("HEATPATH_REQUIRE_HOSTS").as_deref() {
                Ok("1") => Err(missing.into()),
                _ => Ok(Completion::ignored_with(missing)),
            }
        })
    }
}

/// Whether a program can be started.
pub(crate) fn has_program(name: &str) -> bool {
    Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success())
}

/// Whether `CMake` can build projects, and a Debian package is installed.
pub(crate) fn has_cmake_and(package: &str) -> bool {
    let status = Command::new("dpkg-query").args(["-W", "-f", "${Status}", package]).output();
    has_program("cmake")
        && has_program("ninja")
        && status.is_ok_and(|output| output.stdout == b"install ok installed")
}

/// heatpath as installed for all hosts of this run.
pub(crate) fn installed() -> &'static Prefix {
    static PREFIX: LazyLock<Prefix> = LazyLock::new(|| Prefix::new(&workplace("prefix")));
    &PREFIX
}

/// The path of a file or folder of this run.
pub(crate) fn workplace(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("hosts").join(name)
}

/// Compiles a program of one file as `cc FILE $(pkg-config --cflags --libs heatpath)`, with more
/// arguments before.
pub(crate) fn compile(
    name: &str,
    source: &str,
    arguments: &[&str],
    pkg_config: &[&str],
) -> PathBuf {
    let flags = installed().pkg_config(pkg_config);
    let program = workplace(name);
    let mut compiler = Command::new("cc");
    compiler.args(arguments).args(["-Wall", "-Wextra", "-Werror", "-o"]).arg(&program);
    run(compiler.arg(repository(source)).args(flags));
    program
}

/// Runs the command with some words and the file for the result.
pub(crate) fn heatpath<'a>(words: impl IntoIterator<Item = &'a str>, output: &Path) {
    let mut command = Command::new(heatpath_ffi_tests::heatpath());
    run(command.args(words).args(["--quiet", "--force", "--output"]).arg(output));
}

/// The points of the only path in a CSV file of the command, which are also those that a program
/// printed, a line a point.
pub(crate) fn assert_same_path(csv: &Path, printed: &str, dimension: usize) {
    let csv = fs::read_to_string(csv).unwrap();
    let numbers = |line: &str, skip: usize| -> Vec<f64> {
        let fields = line.split(',').skip(skip).take(dimension);
        fields.map(|number| number.parse().unwrap()).collect()
    };
    let expected: Vec<Vec<f64>> = csv.lines().skip(1).map(|line| numbers(line, 2)).collect();
    let points: Vec<Vec<f64>> = printed.lines().map(|line| numbers(line, 0)).collect();
    assert!(expected.len() > 10, "{csv}");
    assert_eq!(points, expected, "the paths differ");
}

/// The values of an NPY file of `count` doubles, as bytes.
pub(crate) fn npy_values(npy: &Path, count: usize) -> Vec<u8> {
    let file = fs::read(npy).unwrap();
    file[file.len() - 8 * count..].to_vec()
}
