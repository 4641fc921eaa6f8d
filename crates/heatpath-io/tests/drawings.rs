//! Pictures for eyes: the right colours at known places.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use heatpath_core::grid::keypoints::KeyPoint;
use heatpath_core::grid::path::{Ending, Path};
use heatpath_core::grid::{Grid, Shape};
use heatpath_io::colour::{NOT_FINITE, viridis};
use heatpath_io::{FieldStyle, Overlay, WriteError, write_field, write_overlay};
use image::RgbImage;
use tempfile::tempdir;

fn ramp(size: [usize; 2]) -> Grid<f64, 2> {
    Grid::from_fn(Shape::new(size).unwrap(), |[x, _]| x as f64 / (size[0] - 1) as f64)
}

fn grey(size: [usize; 2], value: f64) -> Grid<f64, 2> {
    Grid::from_fn(Shape::new(size).unwrap(), |_| value)
}

fn path(points: &[[f64; 2]], ending: Ending) -> Path<2> {
    Path {
        points: points.to_vec(),
        ending,
        length: 1.0,
        physical_length: 1.0,
        distance: 1.0,
        cost: 1.0,
    }
}

fn drawn_field(field: &Grid<f64, 2>, title: Option<&str>) -> RgbImage {
    let folder = tempdir().unwrap();
    let file = folder.path().join("field.png");
    write_field(
        &file,
        None,
        false,
        field,
        &FieldStyle { title: title.map(str::to_owned), ..FieldStyle::default() },
    )
    .unwrap();
    image::open(file).unwrap().into_rgb8()
}

fn drawn_overlay(picture: &Grid<f64, 2>, layers: &Overlay<'_, 2>) -> RgbImage {
    let folder = tempdir().unwrap();
    let file = folder.path().join("overlay.png");
    write_overlay(&file, false, picture, layers).unwrap();
    image::open(file).unwrap().into_rgb8()
}

fn dark(pixel: [u8; 3]) -> bool {
    pixel.iter().all(|&c| c < 120)
}

#[test]
fn large_fields_are_drawn_pixel_by_pixel() {
    let mut field = ramp([300, 200]);
    field[[150, 100]] = f64::INFINITY;
    let picture = drawn_field(&field, None);
    assert!(picture.width() > 300 && picture.height() == 200);
    for (x, part) in [(0, 0.0), (299, 1.0)] {
        for y in [0, 199] {
            assert_eq!(picture.get_pixel(x, y).0, viridis(part));
        }
    }
    assert_eq!(picture.get_pixel(150, 100).0, NOT_FINITE);
    assert_eq!(picture.get_pixel(151, 100).0, viridis(151.0 / 299.0));
    // The bar: yellow above, blue below, numbers to its right.
    assert_eq!(picture.get_pixel(320, 8).0, viridis(1.0));
    assert_eq!(picture.get_pixel(320, 191).0, viridis(0.0));
    let labels = (336..picture.width()).flat_map(|x| (0..200).map(move |y| (x, y)));
    assert!(labels.map(|(x, y)| picture.get_pixel(x, y).0).any(dark));
}

#[test]
fn small_fields_are_enlarged_and_titles_stand_above() {
    let picture = drawn_field(&ramp([4, 2]), None);
    assert!(picture.width() > 256 && picture.height() == 128);
    assert_eq!(picture.get_pixel(63, 127).0, viridis(0.0));
    assert_eq!(picture.get_pixel(64, 0).0, viridis(1.0 / 3.0));
    assert_eq!(picture.get_pixel(255, 0).0, viridis(1.0));
    let titled =
        drawn_field(&ramp([4, 2]), Some("a title that is much longer than the field is wide"));
    assert_eq!(titled.height(), 128 + 24);
    assert_eq!(titled.get_pixel(255, 24).0, viridis(1.0));
    assert!((0..24).any(|y| (0..256).any(|x| dark(titled.get_pixel(x, y).0))));
}

#[test]
fn odd_fields_are_drawn_too() {
    for field in [
        grey([1, 1], 3.0),
        grey([1, 1], f64::NAN),
        grey([500, 1], f64::INFINITY),
        grey([1, 500], -1e300),
        Grid::from_fn(
            Shape::new([2, 1]).unwrap(),
            |[x, _]| if x == 0 { f64::MIN } else { f64::MAX },
        ),
    ] {
        assert!(drawn_field(&field, Some("odd")).height() >= 96);
    }
}

#[test]
fn curves_ends_and_sources_are_drawn() {
    let picture = grey([400, 300], 0.5);
    let done = path(&[[50.0, 50.0], [350.0, 50.0]], Ending::Source(0));
    let open = path(&[[50.0, 150.0], [350.0, 150.0]], Ending::StepLimit);
    let lone = path(&[[200.0, 250.0]], Ending::Unreachable);
    let paths = [done, open, lone];
    let image = drawn_overlay(
        &picture,
        &Overlay { paths: &paths, sources: &[[30.0, 280.0]], ..Overlay::default() },
    );
    assert_eq!((image.width(), image.height()), (400, 300));
    let at = |x, y| image.get_pixel(x, y).0;
    assert_eq!(at(200, 20), [128; 3]);
    let [r, g, b] = at(200, 50);
    assert!(r < 60 && g > 160 && b > 200, "a curve is cyan: {:?}", at(200, 50));
    let orange = |[r, g, b]: [u8; 3]| r > 200 && (100..200).contains(&g) && b < 60;
    let along = (60..340).filter(|&x| orange(at(x, 150))).count();
    assert!((100..200).contains(&along), "dashes: {along} of 280");
    for end in [(50, 50), (50, 150), (200, 250)] {
        assert_eq!(at(end.0, end.1), [255; 3], "the end at {end:?}");
    }
    for source in [(350, 50), (30, 280)] {
        let [r, g, b] = at(source.0, source.1);
        assert!(r > 200 && g < 60 && b < 60, "the source at {source:?}");
    }
}

#[test]
fn pieces_have_no_dots_but_key_points_are_yellow() {
    let key_point = KeyPoint { point: [200.0, 50.0], parent: None, ln_temperature: None };
    let paths = [path(&[[50.0, 50.0], [350.0, 50.0]], Ending::Source(0))];
    let layers =
        Overlay { paths: &paths, are_pieces: true, key_points: &[key_point], ..Overlay::default() };
    let image = drawn_overlay(&grey([400, 300], 0.5), &layers);
    let at = |x, y| image.get_pixel(x, y).0;
    let [r, g, b] = at(200, 50);
    assert!(r > 240 && g > 200 && b < 60, "yellow: {:?}", at(200, 50));
    assert_ne!(at(50, 50), [255; 3], "no dot at the end");
    assert!(at(350, 50)[0] < 60, "and no cross: {:?}", at(350, 50));
}

#[test]
fn a_field_shines_through() {
    let mut field = ramp([300, 20]);
    field[[10, 10]] = f64::INFINITY;
    let image = drawn_overlay(
        &grey([300, 20], 1.0),
        &Overlay { field: Some(&field), ..Default::default() },
    );
    let expected = viridis(0.0).map(|c| (127.5 + f64::from(c) / 2.0).round() as u8);
    assert_eq!(image.get_pixel(0, 0).0, expected);
    assert_eq!(image.get_pixel(10, 10).0, [255; 3]);
}

#[test]
fn overlays_of_small_pictures_hit_the_enlarged_pixels() {
    let line = path(&[[0.0, 1.0], [7.0, 1.0]], Ending::Source(0));
    let image =
        drawn_overlay(&grey([8, 4], 0.0), &Overlay { paths: &[line], ..Default::default() });
    assert_eq!((image.width(), image.height()), (256, 128));
    // The middle of row 1 is at 1.5 x 32.
    assert!(image.get_pixel(128, 48).0[2] > 200);
    assert_eq!(image.get_pixel(128, 16).0, [0; 3]);
    assert_eq!(image.get_pixel(16, 47).0, [255; 3]);
}

#[test]
fn overlays_refuse_what_does_not_fit() {
    let (picture, field) = (grey([3, 2], 0.0), ramp([2, 3]));
    let layers = Overlay { field: Some(&field), ..Default::default() };
    let error = write_overlay("a.png", false, &picture, &layers).unwrap_err();
    assert!(matches!(error, WriteError::Mismatch { .. }), "{error}");
    let error = write_overlay("a.jpg", false, &picture, &Overlay::default()).unwrap_err();
    assert!(matches!(error, WriteError::Ending { .. }), "{error}");
}

#[test]
fn wild_paths_do_no_harm() {
    let wild = path(&[[f64::NAN, 0.0], [1e300, -1e300], [f64::INFINITY, 2.0]], Ending::StepLimit);
    let far = path(&[[-1e6, 5.0], [1e6, 5.0]], Ending::Source(0));
    drawn_overlay(&grey([8, 8], 0.0), &Overlay { paths: &[wild, far], ..Default::default() });
}
