//! DICOM: single files and folders of slices.

use crate::common::dicom::Dicom;
use crate::common::volumes::text_error;
use crate::file;
use heatpath_io::{ImageFile, Placement, ReadError};
use std::fs;
use tempfile::{TempDir, tempdir};

fn values(dicom: &Dicom) -> Vec<f64> {
    file(&dicom.bytes()).into_field::<2>(None).unwrap().into_values()
}

#[test]
fn pixels_are_rescaled_and_placed() {
    let dicom = Dicom {
        more: vec![
            (0x0028_1052, *b"DS", b"-1024".to_vec()),
            (0x0028_1053, *b"DS", b"2 ".to_vec()),
            (0x0028_0030, *b"DS", b"0.5\\0.25".to_vec()),
            (0x0020_0032, *b"DS", b"1\\2\\3 ".to_vec()),
            (0x0020_0037, *b"DS", b"0\\1\\0\\0\\0\\-1".to_vec()),
        ],
        ..Dicom::default()
    };
    assert_eq!(values(&dicom), [-1024.0, -1022.0, -1020.0, -1018.0, -1016.0, -1014.0]);
    let file = file(&dicom.bytes());
    assert_eq!(file.spacing(), Some([0.25, 0.5]), "columns first");
    let direction = [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]];
    assert_eq!(file.placement(), Some(Placement { origin: [1.0, 2.0, 3.0], direction }));
    assert_eq!(file.dimensions(), [2, 3]);
}

#[test]
fn every_plain_transfer_syntax_is_known() {
    for syntax in ["1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2"] {
        let dicom = Dicom { syntax, ..Dicom::default() };
        assert_eq!(values(&dicom), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0], "{syntax}");
    }
    // A sequence of undefined length, with an item of undefined length, is passed.
    let mut item = Vec::new();
    for (tag, length) in [(0xe000_fffe_u32, u32::MAX), (0xe00d_fffe, 0), (0xe0dd_fffe, 0)] {
        item.extend(tag.to_le_bytes());
        item.extend(length.to_le_bytes());
    }
    let dicom = Dicom { more: vec![(0x0008_1140, *b"SQ", item)], ..Dicom::default() };
    assert_eq!(values(&dicom)[5], 5.0);
}

#[test]
fn run_lengths_and_jpeg_are_decoded() {
    // Two planes: high bytes 0 six times, low bytes literally.
    let mut rle = vec![0; 64];
    rle[0] = 2;
    rle[4] = 64;
    rle[8] = 66;
    rle.extend([251, 0, 5, 0, 1, 2, 3, 4, 5]);
    let dicom = Dicom { syntax: "1.2.840.10008.1.2.5", pixels: vec![rle], ..Dicom::default() };
    assert_eq!(values(&dicom), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    let jpeg = crate::common::jpeg(&[77; 6], [3, 2], image::ExtendedColorType::L8);
    let syntax = "1.2.840.10008.1.2.4.50";
    let dicom = Dicom { syntax, bits: [8, 8], pixels: vec![jpeg.clone()], ..Dicom::default() };
    assert!(values(&dicom).iter().all(|value| (value - 77.0).abs() < 2.0));
    let dicom = Dicom { syntax, pixels: vec![jpeg], ..Dicom::default() };
    assert!(text_error(&dicom.bytes()).contains("pixels of 1 bytes, not 2"));
}

#[test]
fn what_is_not_supported_is_named() {
    for (syntax, name) in [
        ("1.2.840.10008.1.2.4.90", "no codestream of JPEG 2000"),
        ("1.2.840.10008.1.2.4.100", "1.2.840.10008.1.2.4.100"),
        ("1.2.840.10008.1.2.1.99", "deflated"),
    ] {
        let error =
            text_error(&Dicom { syntax, pixels: vec![vec![0; 4]], ..Dicom::default() }.bytes());
        assert!(error.contains(name), "{error}");
    }
    let frames = Dicom { more: vec![(0x0028_0008, *b"IS", b"3 ".to_vec())], ..Dicom::default() };
    let error = ImageFile::from_bytes(&frames.bytes(), "a.dcm").unwrap_err();
    assert!(matches!(error, ReadError::Component { count: 3, .. }), "{error}");
    let palette = Dicom { colours: "PALETTE COLOR ", ..Dicom::default() };
    assert!(text_error(&palette.bytes()).contains("the palette is described as []"));
    let brightness = Dicom { colours: "YBR_FULL", ..Dicom::default() };
    assert!(text_error(&brightness.bytes()).contains("3 values a pixel as YBR_FULL"));
    let short = Dicom { pixels: vec![vec![0; 4]], ..Dicom::default() };
    assert!(text_error(&short.bytes()).contains("12 bytes, but there are 4"));
}

/// A folder with slices at the given heights, whose values are ten times their height.
fn series(heights: &[f64], change: impl Fn(usize, &mut Dicom)) -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("notes.txt"), "no DICOM").unwrap();
    for (number, height) in heights.iter().enumerate() {
        let mut dicom = Dicom {
            more: vec![
                (0x0020_000e, *b"UI", b"1.2".to_vec()),
                (0x0028_0030, *b"DS", b"0.5\\0.25".to_vec()),
                (0x0020_0032, *b"DS", format!("1\\2\\{height:<4}").into_bytes()),
                (0x0020_0037, *b"DS", b"1\\0\\0\\0\\1\\0 ".to_vec()),
            ],
            pixels: vec![[(10.0 * height) as u8, 0].repeat(6)],
            ..Dicom::default()
        };
        change(number, &mut dicom);
        fs::write(folder.path().join(format!("{number}.dcm")), dicom.bytes()).unwrap();
    }
    folder
}

#[test]
fn slices_are_sorted_by_their_place() {
    let folder = series(&[4.0, 1.0, 2.5], |_, _| {});
    let file = ImageFile::read(folder.path()).unwrap();
    assert_eq!(file.spacing(), Some([0.25, 0.5, 1.5]));
    assert_eq!(file.placement().unwrap().origin, [1.0, 2.0, 1.0]);
    assert_eq!(file.info().sample.name(), "uint16");
    let volume = file.into_field::<3>(None).unwrap();
    assert_eq!(volume.shape().size(), [3, 2, 3]);
    assert_eq!([0, 1, 2].map(|z| volume[[2, 1, z]]), [10.0, 25.0, 40.0]);
}

#[test]
fn rescaling_may_differ_from_slice_to_slice() {
    let folder = series(&[1.0, 2.0], |number, dicom| {
        if number == 1 {
            dicom.more.push((0x0028_1052, *b"DS", b"100 ".to_vec()));
        }
    });
    let volume = ImageFile::read(folder.path()).unwrap().into_field::<3>(None).unwrap();
    assert_eq!([0, 1].map(|z| volume[[0, 0, z]]), [10.0, 120.0]);
}

#[test]
fn folders_that_are_no_volume_are_explained() {
    let text = |folder: &TempDir| {
        let error = ImageFile::read(folder.path()).unwrap_err();
        assert!(!error.is_access() && error.to_string().lines().count() == 1, "{error}");
        error.to_string()
    };
    let nothing = |_: usize, _: &mut Dicom| {};
    assert!(text(&series(&[], nothing)).contains("no pictures of DICOM"));
    assert!(text(&series(&[1.0, 2.0, 4.0], nothing)).contains("not evenly spaced"));
    assert!(text(&series(&[1.0, 1.0], nothing)).contains("not evenly spaced"));
    let other = |tag, value: &'static [u8]| {
        move |number: usize, dicom: &mut Dicom| {
            if number == 1 {
                dicom.more.retain(|(other, ..)| *other != tag);
                if !value.is_empty() {
                    dicom.more.push((tag, *b"UI", value.to_vec()));
                }
            }
        }
    };
    assert!(text(&series(&[1.0, 2.0], other(0x0020_000e, b"1.3 "))).contains("two series"));
    assert!(text(&series(&[1.0, 2.0], other(0x0028_0030, b"0.5\\0.5 "))).contains("differ in"));
    assert!(text(&series(&[1.0, 2.0], other(0x0020_0032, b""))).contains("no position"));
    let tilted = other(0x0020_0032, b"1\\1\\2 ");
    assert!(text(&series(&[1.0, 2.0], tilted)).contains("axes 1 and 2 meet at 135"));
}

#[test]
fn a_highest_bit_beyond_all_is_refused() {
    let mut bytes = Dicom::default().bytes();
    // The element of the highest bit, explicit and little-endian.
    let element = [0x28, 0, 0x02, 0x01, b'U', b'S', 2, 0, 15, 0];
    let at = bytes.windows(element.len()).position(|window| window == element).unwrap();
    bytes[at + 8..at + 10].copy_from_slice(&[0xff, 0xff]);
    assert!(text_error(&bytes).contains("up to bit 65535"));
}
