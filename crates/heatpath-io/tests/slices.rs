//! Volumes for eyes: a golden picture, and the right things at known places.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use heatpath_core::grid::path::{Ending, Path};
use heatpath_core::grid::{Grid, Shape};
use heatpath_io::colour::viridis;
use heatpath_io::{Overlay, WriteError, write_overlay};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{Rgb, RgbImage};
use std::fs::File;
use tempfile::tempdir;

/// Where panels begin, in pixels: below a title, beside the letter of an axis.
const CORNER: [u32; 2] = [16, 20];

/// The middle line of the tube in the volume below.
fn helix(turn: f64) -> [f64; 3] {
    [24.0 + 12.0 * turn.cos(), 20.0 + 12.0 * turn.sin(), 2.0 + 1.5 * turn]
}

/// A bright tube with slices as far apart as two and a half columns.
fn volume() -> Grid<f64, 3> {
    let shape = Shape::with_spacing([48, 40, 24], [1.0, 1.0, 2.5]).unwrap();
    let line: Vec<[f64; 3]> = (0..260).map(|i| helix(f64::from(i) * 0.05)).collect();
    Grid::from_fn(shape, |at| {
        let [x, y, z] = at.map(|i| i as f64);
        let apart =
            |p: &[f64; 3]| (p[0] - x).powi(2) + (p[1] - y).powi(2) + (2.5 * (p[2] - z)).powi(2);
        let nearest = line.iter().map(apart).fold(f64::INFINITY, f64::min);
        if nearest < 16.0 { 0.85 } else { 0.25 }
    })
}

fn path() -> Path<3> {
    through((0..=240).rev().map(|i| helix(f64::from(i) * 0.05)).collect())
}

fn through(points: Vec<[f64; 3]>) -> Path<3> {
    Path {
        points,
        ending: Ending::Source(0),
        length: 1.0,
        physical_length: 1.0,
        distance: 1.0,
        cost: 1.0,
    }
}

fn drawn(volume: &Grid<f64, 3>, layers: &Overlay<'_, 3>) -> RgbImage {
    let folder = tempdir().unwrap();
    let file = folder.path().join("overlay.png");
    write_overlay(&file, false, volume, layers).unwrap();
    image::open(file).unwrap().into_rgb8()
}

fn is_cyan([r, g, b]: [u8; 3]) -> bool {
    r < 90 && g > 160 && b > 190
}

/// The picture in `docs/figures`, which `HEATPATH_BLESS=1` draws anew.
#[test]
fn a_path_through_a_volume() {
    let drawn = drawn(&volume(), &Overlay { paths: &[path()], ..Overlay::default() });
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = root.join("../../docs/figures/volume.png");
    if std::env::var_os("HEATPATH_BLESS").is_some() {
        let out = File::create(&file).unwrap();
        let best = PngEncoder::new_with_quality(out, CompressionType::Best, FilterType::NoFilter);
        drawn.write_with_encoder(best).unwrap();
    }
    let expected = image::open(&file).unwrap().into_rgb8();
    assert_eq!(expected.dimensions(), drawn.dimensions());
    let differs = |(a, b): &(&Rgb<u8>, &Rgb<u8>)| (0..3).any(|i| a[i].abs_diff(b[i]) > 3);
    let count = expected.pixels().zip(drawn.pixels()).filter(differs).count();
    assert_eq!(count, 0, "pixels that differ");
}

/// Small cubes, each cell so many pixels wide that the longest side has 256 or more.
#[test]
fn panels_have_the_proportions_of_the_spacing() {
    let shape = Shape::with_spacing([10, 20, 8], [1.0, 1.0, 4.0]).unwrap();
    let volume =
        Grid::from_fn(shape, |[x, y, z]| f64::from(u8::from([x, y, z] == [7, 3, 6])) * 0.9 + 0.1);
    let picture = drawn(&volume, &Overlay { sources: &[[2.0, 5.0, 1.0]], ..Overlay::default() });
    // 32 units along z are 256 pixels: a cell has 8 x 8 x 32.
    let [left, top] = CORNER;
    let dark = [26; 3];
    let at = |x, y| picture.get_pixel(x, y).0;
    assert_eq!(at(left, top), dark);
    assert_eq!(at(left + 10 * 8 - 1, top + 20 * 8 - 1), dark);
    assert_ne!(at(left + 10 * 8, top), dark, "a panel of 10 x 20 cells ends here");
    // The source, and the slices through it: z = 1 does not show the bright cell.
    let [r, g, b] = at(left + 2 * 8 + 4, top + 5 * 8 + 4);
    assert!(r > 200 && g < 60 && b < 60, "{r} {g} {b}");
    assert_eq!(at(left + 7 * 8 + 4, top + 3 * 8 + 4), dark);
    // But all projections do.
    let bright = picture.pixels().filter(|pixel| pixel.0 == [255; 3]).count();
    let without =
        drawn(&volume.map(|_| 0.1), &Overlay { sources: &[[2.0, 5.0, 1.0]], ..Overlay::default() });
    let paper = without.pixels().filter(|pixel| pixel.0 == [255; 3]).count();
    assert_eq!(bright - paper, 8 * 8 + 32 * 8 + 8 * 32);
}

#[test]
fn fields_are_on_slices_with_a_bar_beside() {
    let shape = Shape::new([32, 24, 16]).unwrap();
    let (volume, field) = (Grid::from_fn(shape, |_| 1.0), Grid::from_fn(shape, |[x, ..]| x as f64));
    let plain = drawn(&volume, &Overlay::default());
    let picture = drawn(&volume, &Overlay { field: Some(&field), ..Overlay::default() });
    assert!(picture.width() > plain.width(), "a bar of colours");
    let half = |part| viridis(part).map(|c| (127.5 + f64::from(c) / 2.0).round() as u8);
    let [left, top] = CORNER;
    assert_eq!(picture.get_pixel(left, top).0, half(0.0));
    assert_eq!(picture.get_pixel(left + 32 * 8 - 1, top).0, half(1.0));
}

#[test]
fn curves_are_whole_on_projections_and_near_on_slices() {
    let volume = Grid::from_fn(Shape::new([64, 64, 64]).unwrap(), |_| 0.0);
    // From corner to corner: the slices show the middle of it.
    let path = through((0..64).map(|i| [f64::from(i); 3]).collect());
    let picture = drawn(&volume, &Overlay { paths: &[path], ..Overlay::default() });
    let cyan = |x: u32, y: u32| is_cyan(picture.get_pixel(x, y).0);
    let [left, top] = CORNER;
    let on = |cell: u32, offset: u32| cyan(left + offset + cell * 4 + 2, top + cell * 4 + 2);
    assert!(on(32, 0) && !on(25, 0) && !on(40, 0), "the slice");
    // The projection stands half a picture further right.
    let half = picture.width() / 2;
    assert!([10, 25, 32, 40, 55].into_iter().all(|cell| on(cell, half)), "the projection");
}

#[test]
fn odd_volumes_are_drawn_too() {
    for size in [[1, 1, 1], [1, 1, 500], [400, 1, 1], [3, 2000, 2]] {
        let volume = Grid::from_fn(Shape::new(size).unwrap(), |_| f64::NAN);
        let far = [[-1e9, 1e9, 0.0]];
        let picture = drawn(&volume, &Overlay { sources: &far, ..Overlay::default() });
        assert!(picture.width() < 3000 && picture.height() < 3000, "{size:?}");
    }
    let volume = Grid::from_fn(Shape::new([3, 2, 2]).unwrap(), |_| 0.0);
    let field = Grid::from_fn(Shape::new([2, 3, 2]).unwrap(), |_| 0.0);
    let layers = Overlay { field: Some(&field), ..Overlay::default() };
    let error = write_overlay("a.png", false, &volume, &layers).unwrap_err();
    assert!(matches!(error, WriteError::Mismatch { .. }), "{error}");
    assert!(error.to_string().contains("2 x 3 x 2 voxels"), "{error}");
}
