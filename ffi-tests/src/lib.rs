//! C and C++ programs that use heatpath as its users do; `cargo test` builds and runs them.
//!
//! The programs are in `c/`; `distance.c` is the one to copy from. They are compiled with all
//! warnings as errors against `include/heatpath.h` and linked to the shared library, which is
//! installed for them under the name that the loader asks for. This library holds what the tests
//! share. `hosts/` holds programs for the software of others, built with `CMake` against an installed
//! heatpath ([`Prefix`]).
//!
//! The shared library comes from cargo itself: `heatpath-capi` is a dependency of the tests, so
//! cargo builds all of its kinds, in the same profile, before they run, and puts them next to the
//! test program.

mod project;

pub use project::Prefix;

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

/// The shared library that belongs to the running test.
///
/// # Panics
/// It is not there.
#[must_use]
pub fn shared_library() -> PathBuf {
    let test = std::env::current_exe().expect("a test program knows its path");
    let name = format!("{}heatpath{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let places = test.ancestors().skip(1).take(2).map(|folder| folder.join(&name));
    let found = places.clone().find(|path| path.is_file());
    found.unwrap_or_else(|| panic!("no shared library at {:?}", places.collect::<Vec<_>>()))
}

/// A file or folder of this repository.
#[must_use]
pub fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// A program of this workspace, built in the profile of the running test; usually cargo has done so
/// already.
///
/// # Panics
/// It cannot be built.
#[must_use]
pub fn program(package: &str, name: &str) -> PathBuf {
    let profile = if cfg!(debug_assertions) { "dev" } else { "release" };
    let mut build = Command::new(env!("CARGO"));
    build.args(["build", "--quiet", "--locked", "--package", package, "--profile", profile]);
    run(build.current_dir(repository(".")));
    // Tests run in the folder `deps` beside the programs.
    let test = std::env::current_exe().expect("a test program knows its path");
    test.ancestors().nth(2).expect("it lies in two folders").join(name)
}

/// The command.
///
/// # Panics
/// It cannot be built.
#[must_use]
pub fn heatpath() -> &'static Path {
    static PROGRAM: LazyLock<PathBuf> = LazyLock::new(|| program("heatpath-cli", "heatpath"));
    &PROGRAM
}

/// An array of numpy: values in C order, of a type such as `"<f4"`.
#[must_use]
pub fn npy(kind: &str, shape: &[usize], values: &[u8]) -> Vec<u8> {
    let shape: String = shape.iter().map(|size| format!("{size}, ")).collect();
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}\n");
    let mut file = b"\x93NUMPY\x01\0".to_vec();
    file.extend(u16::try_from(header.len()).expect("a header is short").to_le_bytes());
    file.extend(header.as_bytes());
    file.extend(values);
    file
}

/// A folder of its own in which a test compiles and runs programs.
#[derive(Debug)]
pub struct Workshop {
    folder: PathBuf,
}

impl Workshop {
    /// An empty folder `name` in `parent`, with the shared library installed in it.
    ///
    /// # Panics
    /// The folder cannot be made.
    #[must_use]
    pub fn new(parent: &str, name: &str) -> Self {
        let folder = Path::new(parent).join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("the folder can be made");
        // One name for the linker, one for the loader.
        for name in ["libheatpath.so", "libheatpath.so.0"] {
            // Linked, as the library is large: in a folder beside its own.
            let (library, link) = (shared_library(), folder.join(name));
            let linked =
                fs::hard_link(&library, &link).or_else(|_| fs::copy(&library, &link).map(drop));
            linked.expect("the library can be copied");
        }
        Self { folder }
    }

    /// The path of a file in the folder.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Compiles and links a program of `c/`, as C99 or C++17 by its ending.
    ///
    /// # Panics
    /// The compiler has anything to say.
    #[must_use]
    pub fn build(&self, source: &str) -> PathBuf {
        self.compile(&repository("ffi-tests/c").join(source), &[])
    }

    /// The same program, which stops at the first use of memory that is not its own, at leaks and at
    /// undefined behaviour.
    ///
    /// # Panics
    /// The compiler has anything to say.
    #[must_use]
    pub fn build_sanitized(&self, source: &str) -> PathBuf {
        let flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
        self.compile(&repository("ffi-tests/c").join(source), &flags)
    }

    /// Compiles and links a program of `examples/cpp`.
    ///
    /// # Panics
    /// The compiler has anything to say.
    #[must_use]
    pub fn example(&self, source: &str) -> PathBuf {
        self.compile(&repository("examples/cpp").join(source), &[])
    }

    fn compile(&self, path: &Path, flags: &[&str]) -> PathBuf {
        let name = path.file_stem().expect("a source has a name").to_string_lossy();
        let program = self.folder.join(format!("{name}{}", flags.concat()));
        let folder = self.folder.display();
        let mut compiler = compiler(path);
        compiler.args(["-g", "-O1", "-pthread"]).args(flags);
        compiler.arg("-o").args([&program, path]);
        compiler.args([format!("-L{folder}"), format!("-Wl,-rpath,{folder}")]);
        let output = run(compiler.args(["-lheatpath", "-lm", "-ldl"]));
        assert!(output.stderr.is_empty(), "{}", text(&output));
        program
    }

    /// Compiles a text without linking it, as C99 or C++17 by the ending of its name.
    ///
    /// # Panics
    /// The compiler has anything to say.
    pub fn check(&self, name: &str, text_of_program: &str) {
        let path = self.path(name);
        fs::write(&path, text_of_program).expect("the program can be written");
        let output = run(compiler(&path).args(["-c", "-o"]).args([&self.path("checked.o"), &path]));
        assert!(output.stderr.is_empty(), "{}", text(&output));
    }
}

/// The compiler for a file, with warnings as errors: `CC` or `CXX` if set.
fn compiler(source: &Path) -> Command {
    let c = source.extension() == Some(OsStr::new("c"));
    let (variable, usual, standard) =
        if c { ("CC", "cc", "-std=c99") } else { ("CXX", "c++", "-std=c++17") };
    let mut command = Command::new(std::env::var_os(variable).unwrap_or_else(|| usual.into()));
    command.args([standard, "-Wall", "-Wextra", "-pedantic", "-Werror", "-I"]);
    command.arg(repository("include"));
    command
}

/// A program under valgrind, which fails with 99 for any misuse or leak of memory.
///
/// Memory that is "possibly lost" is none: the queues of the thread pool (crossbeam-epoch) mark
/// their pointers in the lowest bits.
///
/// # Panics
/// There is no valgrind.
#[must_use]
pub fn valgrind(program: &Path) -> Command {
    let there = Command::new("valgrind").arg("--version").output().is_ok();
    assert!(there, "this test needs valgrind: please install it (apt install valgrind)");
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--error-exitcode=99", "--leak-check=full"]);
    command.args(["--show-leak-kinds=definite", "--errors-for-leak-kinds=definite"]).arg(program);
    command
}

/// Runs a command that must succeed.
///
/// # Panics
/// It cannot be started or fails.
pub fn run(command: &mut Command) -> Output {
    let output = command.output();
    let output = output.unwrap_or_else(|error| panic!("{command:?} cannot be started: {error}"));
    assert!(output.status.success(), "{command:?}: {}\n{}", output.status, text(&output));
    output
}

/// All that a program said.
#[must_use]
pub fn text(output: &Output) -> String {
    let [out, error] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    format!("{out}{error}")
}
