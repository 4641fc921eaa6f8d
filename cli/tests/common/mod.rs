//! A folder in which tests run the command as a user does.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]
#![allow(dead_code, reason = "each test program uses a part of this")]

use image::{GrayImage, Luma};
use npyz::WriterBuilder;
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A folder and the command run in it.
pub(crate) struct Bench {
    folder: TempDir,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self { folder: TempDir::new().unwrap() }
    }

    /// With a picture of a bright curve, `curve.png`.
    pub(crate) fn with_picture() -> Self {
        let bench = Self::new();
        let curve = |x: f64| 40.0 + 15.0 * (x / 12.0).sin();
        GrayImage::from_fn(100, 80, |x, y| {
            Luma([if (f64::from(y) - curve(f64::from(x))).abs() < 3.0 { 220 } else { 60 }])
        })
        .save(bench.path("curve.png"))
        .unwrap();
        bench
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_heatpath"));
        command.current_dir(self.folder.path()).args(arguments.split_whitespace());
        command
    }

    pub(crate) fn run(&self, arguments: &str) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// Runs what must succeed; returns standard output.
    pub(crate) fn ok(&self, arguments: &str) -> String {
        let output = self.run(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "heatpath {arguments}: {error}");
        String::from_utf8(output.stdout).unwrap()
    }

    pub(crate) fn json(&self, arguments: &str) -> Value {
        serde_json::from_str(&self.ok(arguments)).unwrap()
    }

    /// Runs what must fail with one line on standard error that contains all of `words`, and
    /// leaves no file behind.
    pub(crate) fn fails(&self, arguments: &str, code: i32, words: &[&str]) {
        let before = self.files();
        let output = self.run(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "heatpath {arguments}: {error}");
        assert_eq!(error.trim_end().lines().count(), 1, "heatpath {arguments}: {error}");
        for word in words {
            assert!(error.contains(word), "heatpath {arguments}: no {word:?} in {error}");
        }
        assert_eq!(self.files(), before, "heatpath {arguments} left something behind");
    }

    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let mut files: Vec<_> =
            fs::read_dir(self.folder.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        files
    }

    pub(crate) fn npy(&self, name: &str) -> (Vec<u64>, Vec<f64>) {
        let file = npyz::NpyFile::new(fs::File::open(self.path(name)).unwrap()).unwrap();
        (file.shape().to_vec(), file.into_vec().unwrap())
    }

    /// Writes an array of 64-bit floats.
    pub(crate) fn write_npy(&self, name: &str, shape: &[u64], value: impl Fn(usize) -> f64) {
        let mut writer = npyz::WriteOptions::new()
            .default_dtype()
            .shape(shape)
            .writer(fs::File::create(self.path(name)).unwrap())
            .begin_nd()
            .unwrap();
        writer.extend((0..shape.iter().product::<u64>() as usize).map(value)).unwrap();
        writer.finish().unwrap();
    }
}
