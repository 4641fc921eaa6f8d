//! Property tests: what is written is read back, and no bytes panic.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod common;

use heatpath_core::grid::{Grid, Shape};
use heatpath_io::{FieldStyle, ImageFile, PictureOptions, read_field, write_field};
use image::ExtendedColorType;
use proptest::prelude::*;
use tempfile::tempdir;

fn any_field() -> impl Strategy<Value = Grid<f64, 2>> {
    [1..12_usize, 1..12_usize].prop_flat_map(fields_of)
}

/// Often with 1, 3 or 4 columns, which could be colours.
fn any_volume() -> impl Strategy<Value = Grid<f64, 3>> {
    [1..6_usize, 1..6_usize, 1..6_usize].prop_flat_map(fields_of)
}

fn fields_of<const D: usize>(size: [usize; D]) -> impl Strategy<Value = Grid<f64, D>> {
    let shape = Shape::new(size).unwrap();
    prop::collection::vec(any::<f64>(), shape.cells())
        .prop_map(move |values| Grid::from_values(shape, values).unwrap())
}

fn bits<const D: usize>(field: &Grid<f64, D>) -> Vec<u64> {
    field.values().iter().map(|value| value.to_bits()).collect()
}

proptest! {
    #[test]
    fn npy_fields_survive_to_the_bit(field in any_field()) {
        let folder = tempdir().unwrap();
        let path = folder.path().join("a.npy");
        write_field(&path, None, false, &field, &FieldStyle::default()).unwrap();
        let back = read_field(&path, [1.0, 1.0]).unwrap();
        prop_assert_eq!(back.shape(), field.shape());
        prop_assert_eq!(bits(&back), bits(&field));
    }

    #[test]
    fn npy_volumes_survive_to_the_bit(field in any_volume()) {
        let folder = tempdir().unwrap();
        let path = folder.path().join("a.npy");
        write_field(&path, None, false, &field, &FieldStyle::default()).unwrap();
        let back = read_field(&path, [1.0; 3]).unwrap();
        prop_assert_eq!(back.shape(), field.shape());
        prop_assert_eq!(bits(&back), bits(&field));
    }

    #[test]
    fn tiff_volumes_survive_as_single_floats(field in any_volume()) {
        let folder = tempdir().unwrap();
        let path = folder.path().join("a.tif");
        write_field(&path, None, false, &field, &FieldStyle::default()).unwrap();
        let single = field.map(|&value| f64::from(value as f32));
        match field.shape().size()[2] {
            1 => prop_assert_eq!(ImageFile::read(&path).unwrap().dimensions(), [2]),
            _ => prop_assert_eq!(bits(&read_field(&path, [1.0; 3]).unwrap()), bits(&single)),
        }
    }

    #[test]
    fn fortran_volumes_are_the_transposed_order(field in any_volume()) {
        let [columns, rows, slices] = field.shape().size();
        let data: Vec<u8> = (0..columns * rows * slices)
            .flat_map(|i| field[[i / slices / rows, i / slices % rows, i % slices]].to_be_bytes())
            .collect();
        let file = common::npy("'>f8'", true, &format!("({slices}, {rows}, {columns})"), &data);
        let back = common::field::<3>(&file, "a.npy").unwrap();
        prop_assert_eq!(bits(&back), bits(&field));
    }

    #[test]
    fn fortran_order_is_the_transposed_order(field in any_field()) {
        let [columns, rows] = field.shape().size();
        let data: Vec<u8> = (0..columns * rows)
            .flat_map(|i| field[[i / rows, i % rows]].to_be_bytes())
            .collect();
        let file = common::npy("'>f8'", true, &format!("({rows}, {columns})"), &data);
        let back = common::field::<2>(&file, "a.npy").unwrap();
        prop_assert_eq!(bits(&back), bits(&field));
    }

    #[test]
    fn sixteen_bit_pngs_survive(size in [1..9_usize, 1..9_usize], seed in any::<u16>()) {
        let shape = Shape::new(size).unwrap();
        let field = Grid::from_fn(shape, |[x, y]| {
            f64::from(seed.wrapping_mul(31).wrapping_add((x * 7919 + y * 104_729) as u16))
        });
        let bytes: Vec<u8> =
            field.values().iter().flat_map(|&v| (v as u16).to_ne_bytes()).collect();
        let file = common::png(&bytes, size.map(|n| n as u32), ExtendedColorType::L16);
        let back = common::field::<2>(&file, "a.png").unwrap();
        prop_assert_eq!(back, field);
    }

    #[test]
    fn pictures_lie_between_zero_and_one(field in any_field(), low in any::<f64>(), high in any::<f64>()) {
        let data: Vec<u8> = field.values().iter().flat_map(|v| v.to_le_bytes()).collect();
        let [columns, rows] = field.shape().size();
        let file = common::npy("'<f8'", false, &format!("({rows}, {columns})"), &data);
        for range in [None, Some((low, high))] {
            let options = PictureOptions { range, ..Default::default() };
            if let Ok(picture) = common::picture::<2>(&file, "a.npy", &options) {
                prop_assert!(picture.values().iter().all(|v| (0.0..=1.0).contains(v)));
            } else {
                let odd = field.check_finite().is_err();
                prop_assert!(odd || range.is_some_and(|(l, h)| !(l.is_finite() && h.is_finite() && l < h)));
            }
        }
    }

    #[test]
    fn no_bytes_panic(start in 0..common::zoo().len(), cut in 0..400_usize, tail in prop::collection::vec(any::<u8>(), 0..80)) {
        let (name, mut bytes) = common::zoo().swap_remove(start);
        bytes.truncate(cut);
        bytes.extend(tail);
        let _ = ImageFile::from_bytes(&bytes, name);
    }
}
