//! `OpenCV`: parts of pictures, where they are in memory, in 8, 16 and 32 bits a channel.

use crate::harness::{
    Host, assert_same_path, has_cmake_and, heatpath, installed, npy_values, workplace,
};
use heatpath_ffi_tests::{npy, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_cmake_and("libopencv-imgcodecs-dev");
    vec![Host { name: "opencv", package: "libopencv-imgcodecs-dev", present, run: opencv }]
}

const SIZE: [usize; 2] = [90, 70];
/// x, y, width, height.
const PART: [usize; 4] = [13, 9, 60, 50];
const SOURCE: &str = "4.25,6";
const END: &str = "55,44.5";

/// A value from 0 to 1 of a channel, without symmetry.
fn value(x: usize, y: usize, channel: usize) -> f64 {
    let (x, y, c) = (x as f64, y as f64, channel as f64);
    0.5 + 0.4 * (0.11 * x + 0.03 * y + c).sin() * (0.13 * y + 0.5 * c).cos()
}

#[derive(Clone, Copy)]
enum Depth {
    Eight,
    Sixteen,
    Float,
}

impl Depth {
    fn bytes(self, value: f64, big_endian: bool) -> Vec<u8> {
        match (self, big_endian) {
            (Self::Eight, _) => vec![(255.0 * value) as u8],
            (Self::Sixteen, true) => ((65535.0 * value) as u16).to_be_bytes().to_vec(),
            (Self::Sixteen, false) => ((65535.0 * value) as u16).to_le_bytes().to_vec(),
            (Self::Float, _) => (value as f32).to_le_bytes().to_vec(),
        }
    }

    /// Writes the colour picture as PPM or, of floats, as PFM, which begins at the bottom.
    fn write_colour(self, name: &str) -> PathBuf {
        let [width, height] = SIZE;
        let (kind, ending, last, big) = match self {
            Self::Eight => ("P6", "ppm", "255", true),
            Self::Sixteen => ("P6", "ppm", "65535", true),
            Self::Float => ("PF", "pfm", "-1.0", false),
        };
        let mut file = format!("{kind}\n{width} {height}\n{last}\n").into_bytes();
        for row in 0..height {
            let y = if ending == "pfm" { height - 1 - row } else { row };
            let places = (0..3 * width).map(|i| (i / 3, i % 3));
            file.extend(places.flat_map(|(x, channel)| self.bytes(value(x, y, channel), big)));
        }
        write(&format!("{name}.{ending}"), &file)
    }

    /// Writes one channel of the part as an array of numpy.
    fn write_part(self, name: &str, channel: usize) -> PathBuf {
        let [left, top, width, height] = PART;
        let kind = match self {
            Self::Eight => "|u1",
            Self::Sixteen => "<u2",
            Self::Float => "<f4",
        };
        let places = (0..width * height).map(|i| (left + i % width, top + i / width));
        let pixels = places.flat_map(|(x, y)| self.bytes(value(x, y, channel), false));
        write(&format!("{name}.npy"), &npy(kind, &[height, width], &pixels.collect::<Vec<_>>()))
    }
}

fn write(name: &str, bytes: &[u8]) -> PathBuf {
    let path = workplace("opencv").join(name);
    fs::write(&path, bytes).unwrap();
    path
}

/// Draws the path with `OpenCV` and returns what the program printed, and its picture and distances.
fn trace(program: &Path, picture: &Path, channel: usize, name: &str) -> [Vec<u8>; 3] {
    let output = workplace("opencv").join(name);
    let part = PART.map(|number| number.to_string()).join(",");
    let mut command = Command::new(program);
    command.arg(picture).arg(channel.to_string()).args([&part, SOURCE, END]).arg(&output);
    let printed = run(&mut command).stdout;
    let [drawn, raw] =
        ["png", "raw"].map(|ending| fs::read(output.with_extension(ending)).unwrap());
    [printed, drawn, raw]
}

fn opencv() {
    let program = installed().build("opencv").join("trace");
    for (name, depth) in
        [("eight", Depth::Eight), ("sixteen", Depth::Sixteen), ("float", Depth::Float)]
    {
        // Files begin with red, OpenCV with blue.
        let (colour, part) = (depth.write_colour(name), depth.write_part(name, 0));
        let [printed, drawn, raw] = trace(&program, &colour, 2, name);
        let [npy, csv] = ["distances.npy", "path.csv"].map(|name| workplace("opencv").join(name));
        let image = part.to_str().unwrap();
        heatpath(["distance", image, "--source", SOURCE], &npy);
        heatpath(["path", image, "--source", SOURCE, "--end", END], &csv);
        assert!(raw == npy_values(&npy, PART[2] * PART[3]), "{name}: the distances differ");
        let printed = String::from_utf8(printed).unwrap();
        assert_same_path(&csv, &printed, 2);
        shows_the_path(&drawn, &printed);
    }
}

/// The pixels next to all points of the path are red.
fn shows_the_path(png: &[u8], path: &str) {
    let picture = image::load_from_memory(png).unwrap().to_rgb8();
    assert_eq!([picture.width(), picture.height()], [PART[2] as u32, PART[3] as u32]);
    for point in path.lines() {
        let [x, y] = [0, 1].map(|axis| {
            let number: f64 = point.split(',').nth(axis).unwrap().parse().unwrap();
            number.round() as u32
        });
        let near = (x.saturating_sub(1)..=x + 1)
            .flat_map(|x| (y.saturating_sub(1)..=y + 1).map(move |y| (x, y)));
        let red = near.filter_map(|(x, y)| picture.get_pixel_checked(x, y));
        assert!(red.filter(|pixel| pixel.0 == [255, 0, 0]).count() > 0, "no path at {point}");
    }
}
