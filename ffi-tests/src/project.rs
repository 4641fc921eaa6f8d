//! Projects that find an installed heatpath as those of its users do.

use crate::{repository, run, shared_library};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A place where `scripts/install` has put the library of the running test.
#[derive(Debug)]
pub struct Prefix {
    folder: PathBuf,
}

impl Prefix {
    /// Installs into a folder and moves the installation to `folder`: it must not mind.
    ///
    /// # Panics
    /// The script fails.
    #[must_use]
    pub fn new(folder: &Path) -> Self {
        let before = folder.with_extension("before");
        for old in [folder, &before] {
            let _ = fs::remove_dir_all(old);
        }
        let built = shared_library();
        let mut install = Command::new(repository("scripts/install"));
        install.arg("--prefix").arg(&before);
        install.arg("--library-folder").args(built.parent());
        run(install.env_remove("DESTDIR"));
        fs::rename(&before, folder).expect("the installation can be moved");
        Self { folder: folder.to_owned() }
    }

    /// The path of an installed file.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Builds the `CMake` project in `ffi-tests/hosts/<name>`, with all warnings as errors; returns
    /// the folder of its programs.
    ///
    /// # Panics
    /// It cannot be configured or built.
    #[must_use]
    pub fn build(&self, name: &str) -> PathBuf {
        self.build_project(&Path::new("ffi-tests/hosts").join(name), &[])
    }

    /// [`build`](Self::build) of the project in any folder of the repository, with more `arguments`
    /// for `CMake`.
    ///
    /// # Panics
    /// It cannot be configured or built.
    #[must_use]
    pub fn build_project(&self, project: &Path, arguments: &[&str]) -> PathBuf {
        let name = project.file_name().expect("a project has a name");
        let build = self.folder.with_file_name(name);
        let _ = fs::remove_dir_all(&build);
        let mut configure = Command::new("cmake");
        configure.args(["-G", "Ninja", "-Wno-dev", "-DCMAKE_BUILD_TYPE=RelWithDebInfo"]);
        for language in ["C", "CXX"] {
            configure.arg(format!("-DCMAKE_{language}_FLAGS=-Wall -Wextra -Werror"));
        }
        configure.arg(format!("-DCMAKE_PREFIX_PATH={}", self.folder.display()));
        configure.args(arguments).arg("-S").arg(repository(".").join(project));
        run(configure.arg("-B").arg(&build));
        run(Command::new("cmake").arg("--build").arg(&build));
        build
    }

    /// What `pkg-config` answers about heatpath.
    ///
    /// # Panics
    /// It does not find heatpath.
    #[must_use]
    pub fn pkg_config(&self, arguments: &[&str]) -> Vec<String> {
        let mut command = Command::new("pkg-config");
        command.args(arguments).arg("heatpath");
        command.env("PKG_CONFIG_PATH", self.path("lib/pkgconfig"));
        let answer: Output = run(&mut command);
        let words = String::from_utf8_lossy(&answer.stdout).into_owned();
        words.split_whitespace().map(str::to_owned).collect()
    }
}
