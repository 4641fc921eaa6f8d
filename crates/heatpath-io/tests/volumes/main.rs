//! Medical volumes: what their headers say, and what is written is read back with its place.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

#[path = "../common/mod.rs"]
mod common;
mod dicom;
mod dicom_frames;
mod dicom_pixels;
mod meta_image;
mod nifti;
mod nrrd;

use common::volumes::nrrd;
use heatpath_core::grid::{Grid, Shape};
use heatpath_io::{
    FieldFormat, FieldStyle, ImageFile, PictureOptions, Placement, info, write_field, write_mask,
};
use proptest::prelude::*;
use tempfile::tempdir;

/// How exactly spacing and direction come back where a format keeps only their product.
const PRODUCT: f64 = 1e-14;

/// How exactly `NIfTI`-1 keeps a place, which has single floats.
const SINGLE: f64 = 3e-7;

fn file(bytes: &[u8]) -> ImageFile {
    ImageFile::from_bytes(bytes, "a.file").unwrap()
}

fn values(bytes: &[u8]) -> Vec<f64> {
    file(bytes).into_field::<3>(None).unwrap().into_values()
}

/// A rotation, from the angles about z, y and x.
fn rotation([a, b, c]: [f64; 3]) -> [[f64; 3]; 3] {
    let ([sa, ca], [sb, cb], [sc, cc]) =
        ([a.sin(), a.cos()], [b.sin(), b.cos()], [c.sin(), c.cos()]);
    [
        [ca * cb, sa * cb, -sb],
        [ca * sb * sc - sa * cc, sa * sb * sc + ca * cc, cb * sc],
        [ca * sb * cc + sa * sc, sa * sb * cc - ca * sc, cb * cc],
    ]
}

/// Any axes, also left-handed ones.
fn any_placement() -> impl Strategy<Value = Placement> {
    let angles = [-3.2..3.2_f64, -1.6..1.6_f64, -3.2..3.2_f64];
    let origin = [-500.0..500.0_f64, -500.0..500.0_f64, -500.0..500.0_f64];
    (angles, origin, any::<bool>(), any::<bool>()).prop_map(|(angles, origin, turned, mirrored)| {
        let mut direction = Placement::default().direction;
        if turned {
            direction = rotation(angles);
        }
        if mirrored {
            direction[0] = direction[0].map(|x| -x);
        }
        Placement { origin, direction }
    })
}

fn any_volume() -> impl Strategy<Value = Grid<f64, 3>> {
    let sides = ([1..6_usize, 1..6_usize, 1..6_usize], [0.1..4.0_f64, 0.1..4.0_f64, 0.1..4.0_f64]);
    sides.prop_flat_map(|(size, spacing)| {
        let shape = Shape::with_spacing(size, spacing).unwrap();
        prop::collection::vec(any::<f64>(), shape.cells())
            .prop_map(move |values| Grid::from_values(shape, values).unwrap())
    })
}

fn bits<const D: usize>(field: &Grid<f64, D>) -> Vec<u64> {
    field.values().iter().map(|value| value.to_bits()).collect()
}

fn close(one: f64, other: f64, relative: f64) -> bool {
    (one - other).abs() <= relative * one.abs().max(other.abs()).max(1.0)
}

/// Writes a field under a name and checks that everything comes back; how exactly the geometry does
/// is `relative`.
fn round_trip<const D: usize>(
    name: &str,
    field: &Grid<f64, D>,
    placement: Placement,
    relative: f64,
) {
    let folder = tempdir().unwrap();
    let path = folder.path().join(name);
    let style = FieldStyle { placement: Some(placement), ..FieldStyle::default() };
    write_field(&path, None, false, field, &style).unwrap();
    let file = ImageFile::read(&path).unwrap();
    let (spacing, back) = (file.spacing::<D>().unwrap(), file.placement().unwrap());
    for axis in 0..D {
        let written = field.shape().spacing()[axis];
        assert!(close(spacing[axis], written, relative), "{name}: {spacing:?}");
        for row in 0..3 {
            let (one, other) = (back.direction[axis][row], placement.direction[axis][row]);
            assert!(close(one, other, relative), "{name}: {back:?} of {placement:?}");
        }
    }
    for row in 0..3 {
        let (one, other) = (back.origin[row], placement.origin[row]);
        assert!(close(one, other, relative), "{name}: {back:?} of {placement:?}");
    }
    assert_eq!(bits(&file.into_field::<D>(None).unwrap()), bits(field), "{name}");
}

proptest! {
    #[test]
    fn values_come_back_to_the_bit_and_the_place_as_exactly_as_it_can(
        field in any_volume(),
        placement in any_placement(),
    ) {
        let exactness = [PRODUCT, PRODUCT, 0.0, 0.0, SINGLE, SINGLE];
        for (name, relative) in PLACED.into_iter().zip(exactness) {
            round_trip(name, &field, placement, relative);
        }
    }

    #[test]
    fn no_header_panics(text in "[ -~\n]{0,300}", tail in prop::collection::vec(any::<u8>(), 0..40)) {
        for start in ["NRRD0004\n", "NDims = 3\n"] {
            let bytes = [start.as_bytes(), text.as_bytes(), b"\n\n", &tail].concat();
            let _ = ImageFile::from_bytes(&bytes, "a.file");
        }
    }

    #[test]
    fn damaged_volumes_never_panic(
        start in 0..common::volumes::zoo().len(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let (name, mut bytes) = common::volumes::zoo().swap_remove(start);
        for (place, byte) in damage {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        if let Ok(file) = ImageFile::from_bytes(&bytes, name) {
            let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
            prop_assert!(file.spacing::<3>().is_none_or(|s| finite(&s) && s.iter().all(|h| *h > 0.0)));
            prop_assert!(file.placement().is_none_or(|p| finite(&p.origin) && finite(p.direction.as_flattened())));
            let _ = file.clone().into_field::<2>(None);
            let _ = file.into_field::<3>(None);
        }
    }
}

#[test]
fn straight_axes_come_back_exactly() {
    let shape = Shape::with_spacing([3, 2, 2], [0.1, 1.0 / 3.0, 2.7]).unwrap();
    let field = Grid::from_fn(shape, |[x, y, z]| (x + 10 * y + 100 * z) as f64);
    let placement = Placement { origin: [1e-3, -7.1, 1e9], ..Placement::default() };
    for name in PLACED {
        let is_single = name.contains(".nii");
        round_trip(name, &field, placement, if is_single { SINGLE } else { 0.0 });
    }
}

/// The endings whose formats say where a field lies.
const PLACED: [&str; 6] = ["a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.nii", "a.nii.gz"];

#[test]
fn pictures_are_placed_in_space_too() {
    let shape = Shape::with_spacing([3, 2], [0.5, 2.0]).unwrap();
    let field = Grid::from_fn(shape, |[x, y]| (x + 10 * y) as f64);
    let flat = Placement { origin: [3.0, -4.0, 0.0], ..Placement::default() };
    let [x, y, z] = flat.direction;
    let sagittal = Placement { origin: [3.0, -4.0, 9.0], direction: [y, z, x] };
    for name in PLACED {
        round_trip(name, &field, flat, 0.0);
        round_trip(name, &field, sagittal, 0.0);
    }
    assert_eq!(sagittal.to_pixels([3.0, -2.0], [0.5, 2.0]), Some([4.0, 0.0]));
    assert_eq!(sagittal.to_pixels([4.0, -2.0], [0.5, 2.0]), None, "beside its plane");
}

#[test]
fn a_slice_is_a_picture_and_a_picture_a_slice() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.mha");
    let flat = Grid::from_fn(Shape::new([3, 2]).unwrap(), |[x, y]| (x + 10 * y) as f64);
    write_field(&path, None, false, &flat, &FieldStyle::default()).unwrap();
    let file = ImageFile::read(&path).unwrap();
    assert_eq!(file.dimensions(), [2, 3]);
    let slice = file.into_field::<3>(None).unwrap();
    assert_eq!(slice.shape().size(), [3, 2, 1]);
    write_field(&path, None, true, &slice, &FieldStyle::default()).unwrap();
    let file = ImageFile::read(&path).unwrap();
    assert_eq!(file.dimensions(), [3, 2]);
    assert_eq!(file.into_field::<2>(None).unwrap(), flat);
}

#[test]
fn masks_are_bytes() {
    let folder = tempdir().unwrap();
    let mask = Grid::from_fn(Shape::new([3, 2, 2]).unwrap(), |[x, y, z]| x + y + z == 2);
    for name in PLACED {
        let path = folder.path().join(name);
        write_mask(&path, None, true, &mask, None).unwrap();
        let about = info(&path).unwrap();
        assert_eq!((about.sample.name(), about.max), ("uint8", Some(255.0)), "{name}");
        let back = heatpath_io::read_mask::<3>(&path, None).unwrap();
        assert_eq!(back.open(), &mask, "{name}");
    }
}

#[test]
fn every_placed_format_is_covered() {
    let pictures = ["npy", "tif", "tiff", "png"];
    for ending in FieldFormat::ENDINGS.iter().filter(|ending| !pictures.contains(ending)) {
        assert!(PLACED.contains(&format!("a.{ending}").as_str()), "{ending}");
    }
}

#[test]
fn spacing_is_that_of_the_file_unless_given() {
    let bytes = nrrd(
        "type: uint8\nspace: LPS\nspace directions: (0.5,0,0) (0,1,0) (0,0,2)\nspace origin: (1,2,3)",
    );
    let spacing = |given| {
        let options = PictureOptions { spacing: given, ..PictureOptions::default() };
        file(&bytes).into_picture::<3>(&options).unwrap().shape().spacing()
    };
    assert_eq!(spacing(None), [0.5, 1.0, 2.0]);
    assert_eq!(spacing(Some([3.0; 3])), [3.0; 3]);
    assert_eq!(file(&bytes).placement().unwrap().origin, [1.0, 2.0, 3.0]);
}
