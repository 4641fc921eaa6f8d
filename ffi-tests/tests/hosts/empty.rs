//! An empty project finds heatpath through `CMake` and pkg-config, in a place that it was moved to.

use crate::harness::{Host, VERSION, compile, has_program, installed, workplace};
use heatpath_ffi_tests::{run, text};
use std::fs;
use std::path::Path;
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let has_cmake = || has_program("cmake") && has_program("ninja");
    let has_pkg_config = || has_program("pkg-config");
    vec![
        Host { name: "cmake", package: "cmake", present: has_cmake, run: cmake },
        Host { name: "cmake_versions", package: "cmake", present: has_cmake, run: versions },
        Host {
            name: "pkg_config",
            package: "pkg-config",
            present: has_pkg_config,
            run: pkg_config,
        },
    ]
}

const MAIN: &str = "ffi-tests/hosts/empty/main.c";

/// Whether the loader will look for libheatpath.
fn is_shared(program: &Path) -> bool {
    text(&run(Command::new("readelf").arg("-d").arg(program))).contains("libheatpath.so.0")
}

fn says_its_distance(program: &mut Command) {
    assert_eq!(text(&run(program)), format!("heatpath {VERSION}: 4\n"));
}

fn cmake() {
    let programs = installed().build("empty");
    for (name, shared) in [("shared", true), ("static", false)] {
        let program = programs.join(name);
        assert_eq!(is_shared(&program), shared, "{name}");
        says_its_distance(&mut Command::new(program));
    }
}

/// Versions of which `CMake` must say whether this heatpath will do.
fn versions() {
    let script = workplace("versions.cmake");
    let mut numbers = VERSION.split('.').map(|number| number.parse::<u32>().unwrap());
    let [major, minor, patch] = [(); 3].map(|()| numbers.next().unwrap());
    for (version, fits) in [
        (format!("{major}"), true),
        (format!("{major}.{minor}"), true),
        (VERSION.to_owned(), true),
        (format!("{VERSION} EXACT"), true),
        (format!("{major}.{minor}.{}", patch + 1), false),
        (format!("{major}.{}", minor + 1), false),
        (format!("{}", major + 1), false),
        ("0.0.9".to_owned(), false),
    ] {
        // No target can be made in a script: only the version is looked at.
        let stops = "function(add_library)\nendfunction()\nfunction(set_target_properties)\n\
                     endfunction()\n";
        let asks = format!("find_package(heatpath {version} CONFIG QUIET)\n");
        fs::create_dir_all(script.parent().unwrap()).unwrap();
        fs::write(&script, format!("{stops}{asks}message(\"found ${{heatpath_FOUND}}\")\n"))
            .unwrap();
        let place = format!("-DCMAKE_PREFIX_PATH={}", installed().path("").display());
        let said = text(&run(Command::new("cmake").arg(place).arg("-P").arg(&script)));
        assert_eq!(said.trim(), format!("found {}", u8::from(fits)), "{version}");
    }
}

fn pkg_config() {
    assert_eq!(installed().pkg_config(&["--modversion"]), [VERSION]);
    let shared = compile("pkg_config_shared", MAIN, &[], &["--cflags", "--libs"]);
    assert!(is_shared(&shared));
    says_its_distance(Command::new(shared).env("LD_LIBRARY_PATH", installed().path("lib")));
    let static_flags = ["--static", "--cflags", "--libs"];
    let alone = compile("pkg_config_static", MAIN, &["-static"], &static_flags);
    says_its_distance(&mut Command::new(alone));
}
