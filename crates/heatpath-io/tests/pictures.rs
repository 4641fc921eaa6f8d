//! Each format and type arrives with the right values.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod common;

use ::tiff::encoder::{Compression, colortype};
use common::{npy, palette_tiff, png, raw_tiff, tiff, zoo};
use heatpath_io::{Channel, Format, ImageFile, PictureOptions, ReadError, SampleType};
use image::ExtendedColorType;

fn field(bytes: &[u8]) -> Vec<f64> {
    common::field::<2>(bytes, "test").unwrap().into_values()
}

fn picture(bytes: &[u8], options: &PictureOptions<2>) -> Vec<f64> {
    common::picture(bytes, "test", options).unwrap().into_values()
}

fn mask(bytes: &[u8]) -> Vec<bool> {
    let mask = common::mask::<2>(bytes, "test").unwrap();
    (0..mask.shape().cells()).map(|i| mask.is_open(i)).collect()
}

fn sample(bytes: &[u8]) -> SampleType {
    common::info(bytes, "test").unwrap().sample
}

fn close(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
}

#[test]
fn every_file_of_the_zoo_is_a_picture_or_a_volume() {
    fn check<const D: usize>(name: &str, bytes: &[u8]) {
        let picture = common::picture::<D>(bytes, name, &PictureOptions::default()).unwrap();
        assert_eq!(picture.shape().size().to_vec(), common::info(bytes, name).unwrap().size);
        assert!(picture.values().iter().all(|v| (0.0..=1.0).contains(v)), "{name}");
    }
    for (name, bytes) in zoo() {
        let info = common::info(&bytes, name).unwrap();
        match info.size.len() {
            2 => check::<2>(name, &bytes),
            _ => check::<3>(name, &bytes),
        }
        assert!(name.starts_with(match info.format {
            Format::Png => "png",
            Format::Jpeg => "jpeg",
            Format::Tiff => "tiff",
            Format::Pnm => "p",
            Format::Npy => "npy",
            Format::Nrrd => "nrrd",
            Format::MetaImage => "mha",
            Format::Nifti => "nifti",
            _ => "dicom",
        }));
        let pages = match name {
            "tiff pages" => 2,
            "dicom frames" => 3,
            _ => 1,
        };
        assert_eq!(info.pages, pages);
    }
}

#[test]
fn png_keeps_sixteen_bits_and_rows() {
    let bytes: Vec<u8> =
        [0_u16, 1, 256, 65535, 1000, 7].iter().flat_map(|v| v.to_ne_bytes()).collect();
    let file = png(&bytes, [3, 2], ExtendedColorType::L16);
    assert_eq!(field(&file), [0.0, 1.0, 256.0, 65535.0, 1000.0, 7.0]);
    assert_eq!(sample(&file), SampleType::U16);
    assert_eq!(picture(&file, &PictureOptions::default())[3], 1.0);
    let grid = ImageFile::from_bytes(&file, "test").unwrap().into_field([0.5, 2.0]).unwrap();
    assert_eq!((grid.shape().size(), grid.shape().spacing()), ([3, 2], [0.5, 2.0]));
    assert_eq!(grid[[1, 1]], 1000.0);
}

#[test]
fn channels_of_colour_pictures() {
    let file = png(&[255, 0, 0, 51, 102, 204], [2, 1], ExtendedColorType::Rgb8);
    let of = |channel| picture(&file, &PictureOptions { channel, ..Default::default() });
    assert!(close(&of(Channel::Red), &[1.0, 0.2]));
    assert!(close(&of(Channel::Green), &[0.0, 0.4]));
    assert!(close(&of(Channel::Blue), &[0.0, 0.8]));
    let luma = [0.2126, 0.2126 * 0.2 + 0.7152 * 0.4 + 0.0722 * 0.8];
    assert!(close(&of(Channel::Luma), &luma));
    // Alpha changes nothing.
    let file = png(&[255, 0, 0, 9, 51, 102, 204, 0], [2, 1], ExtendedColorType::Rgba8);
    assert!(close(&picture(&file, &PictureOptions::default()), &luma));
    // Grey is grey with each choice.
    let file = png(&[51, 0, 255, 128], [2, 1], ExtendedColorType::La8);
    let blue = PictureOptions { channel: Channel::Blue, ..Default::default() };
    assert!(close(&picture(&file, &blue), &[0.2, 1.0]));
}

#[test]
fn fields_and_masks_of_colour_files() {
    let file = png(&[0, 0, 0, 0, 0, 9], [2, 1], ExtendedColorType::Rgb8);
    let error = common::field::<2>(&file, "test").unwrap_err();
    assert!(matches!(error, ReadError::Colour { channels: 3, .. }), "{error}");
    assert_eq!(mask(&file), [false, true]);
}

#[test]
fn ranges_stretch_and_clamp() {
    let file = npy("'<i2'", false, "(1, 4)", &[10_i16, 20, 30, -10].map(i16::to_le_bytes).concat());
    assert_eq!(picture(&file, &PictureOptions::default()), [0.5, 0.75, 1.0, 0.0]);
    let options = PictureOptions { range: Some((10.0, 20.0)), ..Default::default() };
    assert_eq!(picture(&file, &options), [0.0, 1.0, 1.0, 0.0]);
    let constant = npy("'<i2'", false, "(1, 2)", &[5, 0, 5, 0]);
    assert_eq!(picture(&constant, &PictureOptions::default()), [0.0, 0.0]);
    for range in [(1.0, 1.0), (2.0, 1.0), (0.0, f64::INFINITY), (f64::NAN, 1.0)] {
        let options = PictureOptions { range: Some(range), ..Default::default() };
        let error = common::picture::<2>(&file, "test", &options).unwrap_err();
        assert!(matches!(error, ReadError::Range { .. }));
    }
}

#[test]
fn npy_types_in_both_byte_orders() {
    /// The values -3 (or 3), 0 and 100 in a type.
    macro_rules! check {
        ($kind:ty, $name:literal, $first:expr, $sample:ident) => {
            let values: [$kind; 3] = [$first as $kind, 0 as $kind, 100 as $kind];
            for (order, data) in [
                ("<", values.map(<$kind>::to_le_bytes).concat()),
                (">", values.map(<$kind>::to_be_bytes).concat()),
            ] {
                let file = npy(&format!("'{order}{}'", $name), false, "(3, 1)", &data);
                assert_eq!(field(&file), [f64::from($first), 0.0, 100.0], "{order}{}", $name);
                assert_eq!(sample(&file), SampleType::$sample);
            }
        };
    }
    check!(u16, "u2", 3, U16);
    check!(u32, "u4", 3, U32);
    check!(u64, "u8", 3, U64);
    check!(i16, "i2", -3, I16);
    check!(i32, "i4", -3, I32);
    check!(i64, "i8", -3, I64);
    check!(f32, "f4", -3.0, F32);
    check!(f64, "f8", -3.0, F64);
    assert_eq!(field(&npy("'|i1'", false, "(1, 2)", &[0xff, 1])), [-1.0, 1.0]);
    assert_eq!(field(&npy("'|b1'", false, "(1, 2)", &[1, 0])), [1.0, 0.0]);
    assert_eq!(sample(&npy("'|b1'", false, "(1, 2)", &[1, 0])), SampleType::Bool);
}

#[test]
fn npy_orders_and_shapes() {
    // numpy.arange(6).reshape(2, 3), in C and in Fortran order
    let c = npy("'|u1'", false, "(2, 3)", &[0, 1, 2, 3, 4, 5]);
    let fortran = npy("'|u1'", true, "(2, 3)", &[0, 3, 1, 4, 2, 5]);
    assert_eq!(field(&c), field(&fortran));
    // numpy.arange(12).reshape(2, 2, 3)
    let c = npy("'|u1'", false, "(2, 2, 3)", &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
    let fortran = npy("'|u1'", true, "(2, 2, 3)", &[0, 6, 3, 9, 1, 7, 4, 10, 2, 8, 5, 11]);
    let green = PictureOptions { channel: Channel::Green, ..Default::default() };
    assert!(close(&picture(&c, &green), &[1.0, 4.0, 7.0, 10.0].map(|v| v / 255.0)));
    assert_eq!(picture(&c, &green), picture(&fortran, &green));
    for (shape, cells) in
        [("(3,)", 3), ("(1, 1, 1, 2)", 2), ("()", 1), ("(0, 3)", 0), ("(2, 2, 0)", 0)]
    {
        let file = npy("'|u1'", false, shape, &vec![0; cells]);
        let error = common::field::<2>(&file, "test").unwrap_err();
        assert!(matches!(error, ReadError::Shape { .. }), "{error}");
    }
    for descr in
        ["[('a', '<f4'), ('b', '|u1', (2,))]", "'<f2'", "'<c8'", "'|O'", "'<U3'", "'<M8[s]'"]
    {
        let file = npy(descr, false, "(1, 1)", &[0; 64]);
        let error = common::field::<2>(&file, "test").unwrap_err();
        assert!(matches!(error, ReadError::Type { .. }), "{error}");
    }
}

#[test]
fn pnm_values_are_as_stored() {
    assert_eq!(field(b"P2\n3 1\n15\n0 7 15\n"), [0.0, 7.0, 15.0]);
    assert_eq!(picture(b"P2 3 1 15 0 3 15", &PictureOptions::default()), [0.0, 0.2, 1.0]);
    assert_eq!(field(b"P5\n2 1\n4095\n\x0f\xff\x00\x01"), [4095.0, 1.0]);
    assert_eq!(field(b"P2\n1 1\n65535\n258"), [258.0]);
    // In bilevel files 1 is ink.
    assert_eq!(field(b"P1\n3 1\n1 0 1\n"), [0.0, 1.0, 0.0]);
    assert_eq!(mask(b"P4\n3 1\n\xa0"), [false, true, false]);
    assert_eq!(sample(b"P4\n3 1\n\xa0"), SampleType::Bool);
    let red = PictureOptions { channel: Channel::Red, ..Default::default() };
    assert_eq!(picture(b"P3\n1 2\n255\n255 0 0\n0 0 255\n", &red), [1.0, 0.0]);
    assert!(common::field::<2>(b"P2\n1 1\n0\n0", "test").is_err());
}

#[test]
fn every_twelve_bit_value_survives() {
    let data: Vec<u8> = (0..4096_u16).flat_map(u16::to_be_bytes).collect();
    let file = [b"P5\n64 64\n4095\n".as_slice(), &data].concat();
    assert!(field(&file).iter().enumerate().all(|(i, &value)| value == i as f64));
}

#[test]
fn tiff_types() {
    let raw = Compression::Uncompressed;
    assert_eq!(field(&tiff::<colortype::Gray16>([2, 1], &[&[1, 65535]], raw)), [1.0, 65535.0]);
    assert_eq!(field(&tiff::<colortype::GrayI16>([2, 1], &[&[-1, 9]], raw)), [-1.0, 9.0]);
    assert_eq!(field(&tiff::<colortype::Gray32>([1, 1], &[&[u32::MAX]], raw)), [4_294_967_295.0]);
    assert_eq!(field(&tiff::<colortype::GrayI32>([1, 1], &[&[i32::MIN]], raw)), [-2_147_483_648.0]);
    assert_eq!(field(&tiff::<colortype::Gray64Float>([1, 1], &[&[0.1]], raw)), [0.1]);
    let lzw = tiff::<colortype::RGB16>([1, 1], &[&[1, 2, 3]], Compression::Lzw);
    let info = common::info(&lzw, "test").unwrap();
    assert_eq!((info.channels, info.min, info.max), (3, Some(1.0), Some(3.0)));
}

#[test]
fn float_tiffs_with_gaps() {
    let values = [0.0_f32, 4.0, f32::NAN, 1.0];
    let file = tiff::<colortype::Gray32Float>([2, 2], &[&values], Compression::Uncompressed);
    let error = common::picture::<2>(&file, "gap.tif", &PictureOptions::default()).unwrap_err();
    assert_eq!(error.to_string(), "gap.tif: the pixel at x = 0, y = 1 is NaN; all must be finite");
    assert!(field(&file)[2].is_nan());
    let info = common::info(&file, "gap.tif").unwrap();
    assert_eq!((info.min, info.max, info.not_finite), (Some(0.0), Some(4.0), 1));
    assert!(common::mask::<2>(&file, "gap.tif").is_err());
}

#[test]
fn tiffs_that_pack_bits() {
    let entries = |bits, white_is_zero: bool| {
        [(258, 3, 1, bits), (259, 3, 1, 1), (262, 3, 1, u32::from(!white_is_zero)), (277, 3, 1, 1)]
    };
    let file = raw_tiff([3, 2], &[0b1010_0000, 0b0100_0000], &entries(1, false), &[]);
    assert_eq!(field(&file), [1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
    assert_eq!(sample(&file), SampleType::Bool);
    let file = raw_tiff([3, 2], &[0b1010_0000, 0b0100_0000], &entries(1, true), &[]);
    assert_eq!(field(&file), [0.0, 1.0, 0.0, 1.0, 0.0, 1.0]);
    let file = raw_tiff([3, 1], &[0x1f, 0x70], &entries(4, false), &[]);
    assert_eq!(field(&file), [1.0, 15.0, 7.0]);
    assert!(close(&picture(&file, &PictureOptions::default()), &[1.0 / 15.0, 1.0, 7.0 / 15.0]));
}

#[test]
fn tiff_planes_are_put_side_by_side() {
    // Two pixels: all reds, all greens, all blues, in three strips.
    let more: Vec<u8> = [8_u32, 10, 12, 2, 2, 2].iter().flat_map(|v| v.to_be_bytes()).collect();
    let mut file = raw_tiff(
        [2, 1],
        &[1, 2, 10, 20, 100, 200],
        &[(258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 2), (277, 3, 1, 3), (284, 3, 1, 2)],
        &more,
    );
    // Lists of three strips instead of one: at 14 the offsets, at 26 the lengths.
    for (tag, at) in [(273_u16, 14_u32), (279, 26)] {
        let entry =
            file.windows(4).position(|w| w == [tag.to_be_bytes(), [0, 4]].concat()).unwrap();
        file[entry + 4..entry + 12]
            .copy_from_slice(&[3_u32.to_be_bytes(), at.to_be_bytes()].concat());
    }
    for (channel, values) in [
        (Channel::Red, [1.0, 2.0]),
        (Channel::Green, [10.0, 20.0]),
        (Channel::Blue, [100.0, 200.0]),
    ] {
        let options = PictureOptions { channel, range: Some((0.0, 1000.0)), ..Default::default() };
        assert!(close(&picture(&file, &options), &values.map(|v| v / 1000.0)));
    }
}

#[test]
fn tiff_palettes_become_colours() {
    // Places: black red grey, white white red.
    let options = PictureOptions { channel: Channel::Red, ..Default::default() };
    let grey = f64::from(0x1234) / 65535.0;
    assert!(close(&picture(&palette_tiff(), &options), &[0.0, 1.0, grey, 1.0, 1.0, 1.0]));
    assert_eq!(mask(&palette_tiff()), [false, true, true, true, true, true]);
    assert_eq!(common::info(&palette_tiff(), "test").unwrap().channels, 3);
}

#[test]
fn one_bit_png_is_zero_and_one() {
    assert_eq!(field(ONE_BIT_PNG), [1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
    assert_eq!(sample(ONE_BIT_PNG), SampleType::Bool);
    assert_eq!(picture(ONE_BIT_PNG, &PictureOptions::default())[..2], [1.0, 0.0]);
}

/// Three columns, two rows: 101, 010.
const ONE_BIT_PNG: &[u8] = &[
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
    0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x02, 0x01, 0x00, 0x00, 0x00, 0x00, 0xb5, 0x0f, 0x5b,
    0xb7, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x58, 0xc0, 0xe0, 0x00,
    0x00, 0x02, 0x24, 0x00, 0xe1, 0x73, 0xeb, 0x3b, 0xf2, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e,
    0x44, 0xae, 0x42, 0x60, 0x82,
];
#[test]
fn arrays_of_three_axes_are_volumes() {
    // numpy.arange(24).reshape(2, 2, 6): slices, rows, columns
    let data: Vec<u8> = (0..24).collect();
    let file = npy("'|u1'", false, "(2, 2, 6)", &data);
    let volume = common::field::<3>(&file, "test").unwrap();
    assert_eq!(volume.shape().size(), [6, 2, 2]);
    assert_eq!((volume[[5, 0, 0]], volume[[0, 1, 0]], volume[[4, 1, 1]]), (5.0, 6.0, 22.0));
    assert!(!common::mask::<3>(&file, "test").unwrap().is_open(0));
    let error = common::field::<2>(&file, "v.npy").unwrap_err();
    assert_eq!(error.to_string(), "v.npy: has 6 x 2 x 2 voxels; a picture is needed");
    let info = common::info(&file, "test").unwrap();
    assert_eq!((info.size, info.channels, info.max), (vec![6, 2, 2], 1, Some(23.0)));
}

#[test]
fn one_more_axis_holds_tensors() {
    let data: Vec<u8> = (0..36).collect();
    // numpy.arange(36).reshape(3, 4, 3) and (1, 3, 2, 6)
    let plane = npy("'|u1'", false, "(3, 4, 3)", &data);
    let file = ImageFile::from_bytes(&plane, "test").unwrap();
    assert!(file.has_tensors(2) && !file.has_tensors(3));
    let field = file.into_tensors([0.5, 2.0]).unwrap();
    assert_eq!((field.shape().size(), field.shape().spacing()), ([4, 3], [0.5, 2.0]));
    assert_eq!(field.at(5), [[15.0, 16.0], [16.0, 17.0]]);
    let space = npy("'|u1'", false, "(1, 3, 2, 6)", &data);
    let file = ImageFile::from_bytes(&space, "v.npy").unwrap();
    assert!(file.has_tensors(3) && !file.has_tensors(2));
    assert_eq!((file.info().size, file.info().channels), (vec![2, 3, 1], 6));
    assert_eq!(file.info().max, Some(35.0));
    let field = file.clone().into_tensors([1.0; 3]).unwrap();
    assert_eq!(field.shape().size(), [2, 3, 1]);
    assert_eq!(field.at(3), [[18.0, 19.0, 20.0], [19.0, 21.0, 22.0], [20.0, 22.0, 23.0]]);
    let error = file.clone().into_field([1.0; 3]).unwrap_err();
    assert_eq!(error.to_string(), "v.npy: a field of tensors; one value a voxel is needed");
    let error = file.into_tensors([1.0; 2]).unwrap_err().to_string();
    let right = "v.npy: no field of tensors; that is an NPY array of shape (rows, columns, 3), which \
                 are xx, xy, yy";
    assert_eq!(error, right);
    let grey = ImageFile::from_bytes(&npy("'|u1'", false, "(6, 6)", &data), "test").unwrap();
    assert!(matches!(grey.into_tensors([1.0; 3]), Err(ReadError::NoTensors { dimension: 3, .. })));
}

/// Three axes of which the last one is short: colours, unless a volume is asked for.
#[test]
fn an_axis_of_colours_can_be_one_of_columns() {
    for columns in [1, 3, 4] {
        let data: Vec<u8> = (0..2 * 5 * columns).collect();
        let file = npy("'|u1'", false, &format!("(2, 5, {columns})"), &data);
        let decoded = ImageFile::from_bytes(&file, "test").unwrap();
        assert_eq!(decoded.dimensions(), [2, 3]);
        assert_eq!(decoded.info().size, [5, 2]);
        let volume = decoded.into_field([1.0, 1.0, 2.5]).unwrap();
        assert_eq!(volume.shape().size(), [usize::from(columns), 5, 2]);
        assert_eq!(volume.shape().spacing(), [1.0, 1.0, 2.5]);
        assert!(volume.values().iter().enumerate().all(|(i, &value)| value == i as f64));
    }
}

#[test]
fn pages_of_grey_are_the_slices_of_a_volume() {
    let pages: [&[u16]; 3] =
        [&[1, 2, 3, 4, 5, 6], &[7, 8, 9, 10, 11, 12], &[13, 14, 15, 16, 17, 18]];
    for compression in [Compression::Uncompressed, Compression::Lzw, Compression::Packbits] {
        let file = tiff::<colortype::Gray16>([3, 2], &pages, compression);
        let volume = common::field::<3>(&file, "test").unwrap();
        assert_eq!(volume.shape().size(), [3, 2, 3]);
        assert!(volume.values().iter().enumerate().all(|(i, &value)| value == (i + 1) as f64));
        let grey = common::picture::<3>(&file, "test", &PictureOptions::default()).unwrap();
        assert_eq!(grey[[2, 1, 2]], 18.0 / 65535.0);
        let error = common::mask::<2>(&file, "stack.tif").unwrap_err().to_string();
        assert_eq!(error, "stack.tif: has 3 x 2 x 3 voxels; a picture is needed");
    }
    // Several pages in colour: the first one, as before.
    let colour = tiff::<colortype::RGB8>([1, 1], &[&[1, 2, 3], &[4, 5, 6]], Compression::Lzw);
    let info = common::info(&colour, "test").unwrap();
    assert_eq!((info.size, info.channels, info.pages), (vec![1, 1], 3, 2));
}

#[test]
fn pictures_are_no_volumes() {
    for (name, bytes) in zoo() {
        let info = common::info(&bytes, name).unwrap();
        // A frame of DICOM can be a slice.
        if info.size.len() == 2 && name != "npy colour" && !name.starts_with("dicom") {
            let error = common::field::<3>(&bytes, name).unwrap_err();
            assert!(matches!(error, ReadError::Dimension { dimension: 3, .. }), "{error}");
            assert!(error.to_string().contains("a volume is needed: a medical format"), "{error}");
        }
    }
}

#[test]
fn info_is_plain_json() {
    let file = png(&[1, 2, 3, 4, 5, 6], [3, 2], ExtendedColorType::L8);
    let json = serde_json::to_value(common::info(&file, "test").unwrap()).unwrap();
    let expected = serde_json::json!({
        "format": "png", "size": [3, 2], "channels": 1, "sample": "uint8",
        "min": 1.0, "max": 6.0, "not_finite": 0, "pages": 1
    });
    assert_eq!(json, expected);
}
