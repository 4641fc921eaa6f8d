//! The Debian packages hold what they should, and a program can be built from them.

use crate::harness::{Host, VERSION, has_program, workplace};
use heatpath_ffi_tests::{repository, run, shared_library, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_program("dpkg-shlibdeps") && has_program("pkg-config");
    vec![Host { name: "debian", package: "dpkg-dev", present, run: debian }]
}

fn dpkg_deb(option: &str, package: &Path) -> String {
    text(&run(Command::new("dpkg-deb").arg(option).arg(package)))
}

/// Makes the packages in an empty folder.
fn make() -> [PathBuf; 2] {
    let folder = workplace("debian");
    let _ = fs::remove_dir_all(&folder);
    let mut package = Command::new(repository("scripts/package"));
    let built = shared_library();
    run(package.arg(&folder).arg("--library-folder").args(built.parent()));
    let architecture = text(&run(Command::new("dpkg").arg("--print-architecture")));
    ["libheatpath0", "libheatpath-dev"]
        .map(|name| folder.join(format!("{name}_{VERSION}_{}.deb", architecture.trim())))
}

fn debian() {
    let [runtime, dev] = make();
    let (about, inside) = (dpkg_deb("--info", &runtime), dpkg_deb("--contents", &runtime));
    assert!(about.contains("Depends: libc6 (>= "), "{about}");
    assert!(about.contains("libgcc-s1 (>= "), "{about}");
    assert!(
        inside.contains(&format!("/libheatpath.so.0 -> libheatpath.so.{VERSION}\n")),
        "{inside}"
    );
    assert!(!inside.contains("heatpath.h"), "{inside}");
    let (about, inside) = (dpkg_deb("--info", &dev), dpkg_deb("--contents", &dev));
    assert!(
        about.contains(&format!("Depends: libheatpath0 (= {VERSION}), libc6-dev\n")),
        "{about}"
    );
    for file in ["libheatpath.a", "cmake/heatpath/heatpathConfig.cmake", "pkgconfig/heatpath.pc"] {
        assert!(inside.contains(&format!("/{file}\n")), "{file} is not in\n{inside}");
    }
    builds_a_program(&[runtime, dev]);
}

/// Unpacks the packages into a root of their own and builds a program from what is there.
fn builds_a_program(packages: &[PathBuf]) {
    let root = workplace("debian/root");
    for package in packages {
        run(Command::new("dpkg").arg("-x").args([package, &root]));
    }
    let triplet = text(&run(Command::new("dpkg-architecture").arg("-qDEB_HOST_MULTIARCH")));
    let libraries = root.join("usr/lib").join(triplet.trim());
    let mut ask = Command::new("pkg-config");
    ask.args(["--cflags", "--libs", "heatpath"])
        .env("PKG_CONFIG_PATH", libraries.join("pkgconfig"));
    let flags = text(&run(&mut ask));
    let program = workplace("debian/program");
    let mut compiler = Command::new("cc");
    compiler.arg(repository("ffi-tests/hosts/empty/main.c")).arg("-o").arg(&program);
    run(compiler.args(flags.split_whitespace()));
    let said = text(&run(Command::new(program).env("LD_LIBRARY_PATH", libraries)));
    assert_eq!(said, format!("heatpath {VERSION}: 4\n"));
}
