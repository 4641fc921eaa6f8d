//! Damaged and lying files: one clear line, no panic, no huge allocation.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod common;

use common::{npy, zoo};
use heatpath_io::{
    PictureOptions, ReadError, info, info_from_bytes, read_mask_from_bytes, read_picture_from_bytes,
};
use std::path::Path;

fn error(bytes: &[u8]) -> ReadError {
    let error = info_from_bytes(bytes, "odd.file").unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with("odd.file: ") && !text.contains(char::is_control), "{text}");
    assert!(!error.is_access());
    error
}

#[test]
fn truncated_files_are_errors_or_whole_pictures() {
    for (name, bytes) in zoo() {
        let whole = info_from_bytes(&bytes, name).unwrap();
        for length in 0..bytes.len() {
            let part = &bytes[..length];
            let picture = read_picture_from_bytes(part, name, &PictureOptions::default());
            if let Ok(picture) = picture {
                // Text without its last line break, a directory without its end: nothing is lost.
                assert_eq!(picture.shape().size(), whole.size, "{name} cut at {length}");
            }
            let _ = read_mask_from_bytes(part, name, [1.0, 1.0]);
        }
    }
}

#[test]
fn flipped_bits_never_panic() {
    for (name, bytes) in zoo() {
        for bit in 0..8 * bytes.len() {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            if let Ok(picture) = read_picture_from_bytes(&damaged, name, &PictureOptions::default())
            {
                assert!(picture.values().iter().all(|v| (0.0..=1.0).contains(v)), "{name} {bit}");
            }
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
    }
}

#[test]
fn headers_that_lie_are_refused_before_allocating() {
    let text = |bytes: &[u8]| error(bytes).to_string();
    let array = text(&npy("'<f8'", false, "(1000000, 1000000)", &[0; 64]));
    assert!(array.contains("1000000 x 1000000 pixels are too large"), "{array}");
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

#[test]
fn zero_sizes_are_refused() {
    for bytes in [&b"P5\n0 3\n255\n"[..], b"P4\n3 0\n", b"P2\n0 0\n255\n"] {
        assert!(matches!(error(bytes), ReadError::Decode { .. }));
    }
    assert!(matches!(error(&npy("'<f8'", false, "(0, 0)", &[])), ReadError::Shape { .. }));
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
    assert!(info(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_err().is_access());
}

#[test]
fn impossible_spacings_are_refused() {
    let bytes = npy("'|u1'", false, "(1, 1)", &[1]);
    for spacing in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
        let options = PictureOptions { spacing, ..Default::default() };
        let error = read_picture_from_bytes(&bytes, "a.npy", &options).unwrap_err();
        assert!(matches!(error, ReadError::Grid { .. }));
    }
}
