//! A volume without symmetry, turned and moved, and what the command says about it.

use crate::harness::{assert_same_path, heatpath, npy_values, workplace};
use heatpath_ffi_tests::npy;
use std::fs;
use std::path::{Path, PathBuf};

/// Columns, rows, slices.
pub(crate) const SIZE: [usize; 3] = [20, 17, 13];
pub(crate) const SPACING: [f64; 3] = [0.7, 0.9, 1.5];
pub(crate) const ORIGIN: [f64; 3] = [-12.0, 30.5, 7.25];
/// Indices of the source and the end.
pub(crate) const SOURCE: [f64; 3] = [4.0, 5.25, 3.0];
pub(crate) const END: [f64; 3] = [16.5, 12.0, 10.0];

/// The unit vectors along which columns, rows and slices are counted: turned about z, then about x.
pub(crate) fn axes() -> [[f64; 3]; 3] {
    let ((s, c), (u, v)) = (0.4_f64.sin_cos(), 0.25_f64.sin_cos());
    [[c, s * v, s * u], [-s, c * v, c * u], [0.0, -u, v]]
}

/// Where the voxel of an index is, of which 0, 0, 0 is at the origin.
pub(crate) fn place(index: [f64; 3]) -> [f64; 3] {
    let axes = axes();
    std::array::from_fn(|to| {
        ORIGIN[to] + (0..3).map(|from| axes[from][to] * SPACING[from] * index[from]).sum::<f64>()
    })
}

/// `x,y,z`, as programs want it.
pub(crate) fn argument(point: [f64; 3]) -> String {
    point.map(|number| number.to_string()).join(",")
}

/// Integers from 28 to 228, the x axis fastest.
pub(crate) fn voxels() -> impl Iterator<Item = i16> {
    (0..SIZE.iter().product()).map(|i: usize| {
        let [x, y, z] = [i % SIZE[0], i / SIZE[0] % SIZE[1], i / SIZE[0] / SIZE[1]];
        let [x, y, z] = [x, y, z].map(|n| n as f64);
        (128.0 + 100.0 * (0.3 * x + 0.2 * z).sin() * (0.25 * y - 0.1 * z).cos()) as i16
    })
}

/// The voxels as bytes of numpy's type `kind`.
pub(crate) fn bytes(kind: &str) -> Vec<u8> {
    match kind {
        "|u1" => voxels().map(|voxel| voxel as u8).collect(),
        "<i2" => voxels().flat_map(i16::to_le_bytes).collect(),
        "<f4" => voxels().flat_map(|voxel| f32::from(voxel).to_le_bytes()).collect(),
        _ => panic!("volumes of {kind} are not made"),
    }
}

/// A path that a host printed, a line a point: the command's is the same, bit for bit. Returns the
/// bytes of the command's distances.
pub(crate) fn command_agrees(kind: &str, host: &str, printed: &str) -> Vec<u8> {
    let folder = workplace(host);
    let [volume, distances, path] = ["v.npy", "d.npy", "p.csv"].map(|name| folder.join(name));
    let [columns, rows, slices] = SIZE;
    fs::write(&volume, npy(kind, &[slices, rows, columns], &bytes(kind))).unwrap();
    // A path runs from the end to the source.
    let (end, source) = (printed.lines().next().unwrap(), printed.lines().next_back().unwrap());
    let spacing = argument(SPACING);
    let common = [volume.to_str().unwrap(), "--spacing", &spacing, "--source", source];
    heatpath([&["distance"], &common[..]].concat(), &distances);
    heatpath([&["path"], &common[..], &["--end", end]].concat(), &path);
    assert_same_path(&path, printed, 3);
    npy_values(&distances, SIZE.iter().product())
}

/// Points that a host wrote are where those that it printed, as indices, should be.
pub(crate) fn assert_in_place(written: &[[f64; 3]], printed: &str) {
    let indices = printed.lines().map(|line| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        [numbers[0], numbers[1], numbers[2]]
    });
    let expected: Vec<[f64; 3]> = indices.map(place).collect();
    assert_eq!(written.len(), expected.len());
    for (point, expected) in written.iter().zip(&expected) {
        assert!(distance(*point, *expected) < 1e-4, "{point:?} instead of {expected:?}");
    }
    for (point, index) in [(expected[0], END), (expected[expected.len() - 1], SOURCE)] {
        assert!(distance(point, place(index)) < 1e-9, "{point:?} is not at {index:?}");
    }
}

pub(crate) fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    (0..3).map(|axis| (one[axis] - other[axis]).powi(2)).sum::<f64>().sqrt()
}

/// The path of a file in the folder of a host.
pub(crate) fn file(host: &str, name: &str, content: &[u8]) -> PathBuf {
    let path: &Path = &workplace(host).join(name);
    fs::write(path, content).unwrap();
    path.to_owned()
}
