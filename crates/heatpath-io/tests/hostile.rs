//! Damaged and lying files: one clear line, no panic, no huge allocation.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod common;

use ::tiff::encoder::{Compression, colortype};
use common::{npy, zoo};
use heatpath_io::{PictureOptions, ReadError, info};
use std::path::Path;

fn error(bytes: &[u8]) -> ReadError {
    let error = common::info(bytes, "odd.file").unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with("odd.file: ") && !text.contains(char::is_control), "{text}");
    assert!(!error.is_access());
    error
}

#[test]
fn truncated_files_are_errors_or_whole() {
    fn check<const D: usize>(name: &str, part: &[u8], whole: &[usize]) {
        if let Ok(picture) = common::picture::<D>(part, name, &PictureOptions::default()) {
            // Text without its last line break, a directory without its end: nothing is lost.
            let length = part.len();
            assert_eq!(picture.shape().size().to_vec(), whole, "{name} cut at {length}");
        }
        let _ = common::mask::<D>(part, name);
    }
    for (name, bytes) in zoo() {
        let whole = common::info(&bytes, name).unwrap().size;
        for length in 0..bytes.len() {
            match whole.len() {
                2 => check::<2>(name, &bytes[..length], &whole),
                _ => check::<3>(name, &bytes[..length], &whole),
            }
        }
    }
}

#[test]
fn flipped_bits_never_panic() {
    fn check<const D: usize>(name: &str, damaged: &[u8]) {
        if let Ok(picture) = common::picture::<D>(damaged, name, &PictureOptions::default()) {
            assert!(picture.values().iter().all(|v| (0.0..=1.0).contains(v)), "{name}");
        }
    }
    for (name, bytes) in zoo() {
        for bit in 0..8 * bytes.len() {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            check::<2>(name, &damaged);
            check::<3>(name, &damaged);
        }
    }
}

#[test]
fn unknown_content_is_named() {
    assert!(matches!(error(b""), ReadError::Empty { .. }));
    for junk in [&b"GIF89a"[..], b"hello", b"P7\nWIDTH 1", b"P9 1 1", b"\0", b"II\x2b", b"%PDF-1.4"]
    {
        let error = error(junk);
        assert!(matches!(error, ReadError::Unrecognised { .. }), "{error}");
        assert!(error.to_string().contains("PNG, JPEG, TIFF, PNM"));
        assert!(error.to_string().contains("NIfTI, NRRD, MetaImage and DICOM"));
    }
}

#[test]
fn headers_that_lie_are_refused_before_allocating() {
    let text = |bytes: &[u8]| error(bytes).to_string();
    let array = text(&npy("'<f8'", false, "(1000000, 1000000)", &[0; 64]));
    assert!(array.contains("1000000 x 1000000 pixels are too large"), "{array}");
    let volume = text(&npy("'|u1'", false, "(10000, 10000, 10000)", &[0; 64]));
    assert!(volume.contains("10000 x 10000 x 10000 voxels are too large"), "{volume}");
    let volume = text(&npy("'<f4'", false, "(64, 64, 64)", &[0; 64]));
    assert!(volume.contains("64 x 64 x 64 voxels are too large for a file of"), "{volume}");
    assert!(text(&npy("'<f8'", false, "(1000, 1000)", &[0; 64])).contains("too large"));
    assert!(
        text(&npy("'<f8'", false, "(99999999999, 99999999999)", &[0; 64])).contains("too large")
    );
    assert!(text(b"P5\n100000 100000\n255\nabc").contains("100000 x 100000 pixels are too large"));
    assert!(text(b"P5\n10000 10000\n255\nabc").contains("file of 22 bytes"));
    assert!(text(b"P2\n4294967295 4294967295\n255\n1 2").contains("too large"));
    let ihdr = |width: u32, height: u32| {
        let size = [width.to_be_bytes(), height.to_be_bytes()].concat();
        [b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", &size[..], &[8, 0, 0, 0, 0, 1, 2, 3, 4]].concat()
    };
    assert!(text(&ihdr(0x7fff_ffff, 0x7fff_ffff)).contains("2147483647 x 2147483647"));
    assert!(text(&ihdr(30000, 30000)).contains("too large for a file of"));
    assert!(text(&ihdr(0, 5)).contains("0 x 5"));
}

/// A stack whose pages all point to the same few bytes must not grow beyond its file.
#[test]
fn pages_that_share_their_samples_are_refused() {
    let mut file = b"II\x2a\0\x08\0\0\0".to_vec();
    let pages = 50_u32;
    let (length, samples) = (2 + 9 * 12 + 4, 8 + pages * (2 + 9 * 12 + 4));
    for page in 1..=pages {
        file.extend(9_u16.to_le_bytes());
        for (tag, value) in [
            (256_u16, 64_u32),
            (257, 64),
            (258, 8),
            (259, 1),
            (262, 1),
            (273, samples),
            (277, 1),
            (278, 64),
            (279, 64 * 64),
        ] {
            file.extend(tag.to_le_bytes());
            file.extend(4_u16.to_le_bytes());
            file.extend(1_u32.to_le_bytes());
            file.extend(value.to_le_bytes());
        }
        let next = if page < pages { 8 + page * length } else { 0 };
        file.extend(next.to_le_bytes());
    }
    file.extend([7; 64 * 64]);
    let text = error(&file).to_string();
    assert!(text.contains("64 x 64 x 50 voxels are too large for a file of"), "{text}");
}

#[test]
fn stacks_with_a_page_that_differs_are_refused() {
    let page: &[u8] = &[1; 20];
    let whole = common::tiff::<colortype::Gray8>([5, 4], &[page; 3], Compression::Uncompressed);
    // Pages of which the third is narrower, and one whose directory is cut off.
    let width = [256_u16.to_le_bytes(), 4_u16.to_le_bytes(), 1_u16.to_le_bytes()].concat();
    let places: Vec<usize> =
        (0..whole.len() - 6).filter(|&i| whole[i..i + 6] == width[..]).collect();
    assert_eq!(places.len(), 3, "a directory a page");
    let with_width = |page: usize, width: u8| {
        let mut file = whole.clone();
        file[places[page] + 8] = width;
        file
    };
    let text = error(&with_width(2, 4)).to_string();
    assert!(text.contains("page 3: has") && text.contains("4 x 4 pixels, but page 1"), "{text}");
    let text = error(&whole[..places[2] + 4]).to_string();
    assert!(text.contains("page 3: "), "{text}");
    // A second page of another size is a thumbnail.
    let picture = common::info(&with_width(1, 4), "thumbnail").unwrap();
    assert_eq!((picture.size, picture.pages), (vec![5, 4], 3));
}

#[test]
fn zero_sizes_are_refused() {
    for bytes in [&b"P5\n0 3\n255\n"[..], b"P4\n3 0\n", b"P2\n0 0\n255\n"] {
        assert!(matches!(error(bytes), ReadError::Decode { .. }));
    }
    for shape in ["(0, 0)", "(0, 2, 2)", "(2, 0, 3)", "(2, 2, 0)"] {
        assert!(matches!(error(&npy("'<f8'", false, shape, &[])), ReadError::Shape { .. }));
    }
}

#[test]
fn arrays_with_odd_headers_are_refused() {
    for (descr, shape) in
        [("'<f8'", "(-1, 2)"), ("'<f8'", "((((((1,),),),),)"), ("'<q8'", "(1, 1)")]
    {
        error(&npy(descr, false, shape, &[0; 64]));
    }
    error(&npy("[('\u{1b}[31m\n', '<f4')]", false, "(1, 1)", &[0; 64]));
    error(b"\x93NUMPY\x01\0\x04\0{}\n");
    error(b"\x93NUMPY\x01\0\x02\0{}");
}

#[test]
fn what_the_system_refuses_is_an_access_error() {
    let missing = info("no/such/file.png").unwrap_err();
    assert!(missing.is_access() && missing.to_string().starts_with("no/such/file.png: "));
    let folder = info(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_err();
    assert!(!folder.is_access() && folder.to_string().contains("no pictures of DICOM"), "{folder}");
}

#[test]
fn impossible_spacings_are_refused() {
    let bytes = npy("'|u1'", false, "(1, 1)", &[1]);
    for spacing in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
        let options = PictureOptions { spacing: Some(spacing), ..Default::default() };
        let error = common::picture(&bytes, "a.npy", &options).unwrap_err();
        assert!(matches!(error, ReadError::Grid { .. }));
    }
}
