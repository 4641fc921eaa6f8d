//! `NIfTI`: what headers say.

use crate::common::volumes::{Nifti, gzip, text_error};
use crate::{file, values};
use heatpath_io::{ImageFile, Placement, ReadError};

#[test]
fn both_versions_and_byte_orders_are_known() {
    let numbers: Vec<f64> = (0..12).map(|i| 0.5 * f64::from(i) - 1.0).collect();
    for nifti in [
        Nifti::default(),
        Nifti { is_second: true, ..Nifti::default() },
        Nifti { is_big_endian: true, ..Nifti::default() },
        Nifti { is_big_endian: true, is_second: true, ..Nifti::default() },
    ] {
        let nifti = Nifti { scale: [0.5, -1.0], ..nifti };
        let bytes = nifti.bytes();
        assert_eq!(values(&bytes), numbers);
        assert_eq!(values(&gzip(&bytes)), numbers);
        assert_eq!(file(&bytes).info().sample.name(), "int16");
        assert_eq!(file(&bytes).spacing(), Some([1.0, 2.0, 4.0]));
    }
    let plain = Nifti { scale: [0.0, 7.0], ..Nifti::default() };
    assert_eq!(values(&plain.bytes())[11], 11.0, "a slope of 0: not scaled");
}

#[test]
fn ras_becomes_lps() {
    let sform = Nifti {
        sform: Some([[0.0, 3.0, 0.0, 10.0], [2.0, 0.0, 0.0, 20.0], [0.0, 0.0, 4.0, 30.0]]),
        ..Nifti::default()
    };
    let place = file(&sform.bytes()).placement().unwrap();
    assert_eq!(file(&sform.bytes()).spacing(), Some([2.0, 3.0, 4.0]));
    assert_eq!(place.origin, [-10.0, -20.0, 30.0]);
    assert_eq!(place.direction, [[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    // A quarter turn about z, and a third axis that points down.
    let half = 0.5_f64.sqrt();
    let qform =
        Nifti { qform: Some([0.0, 0.0, half, 10.0, 20.0, 30.0]), handed: -1.0, ..Nifti::default() };
    let place = file(&qform.bytes()).placement().unwrap();
    assert_eq!(place.origin, [-10.0, -20.0, 30.0]);
    let expected = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
    for (found, expected) in place.direction.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-6, "{place:?}");
    }
    let neither = file(&Nifti::default().bytes());
    assert_eq!(neither.placement(), Some(Placement::default()));
}

#[test]
fn lengths_become_millimetres() {
    for (unit, factor) in [(1, 1000.0), (2, 1.0), (3, 0.001)] {
        for is_second in [false, true] {
            let rows = [[1.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
            let nifti = Nifti { sform: Some(rows), unit, is_second, ..Nifti::default() };
            let (spacing, place) =
                (file(&nifti.bytes()).spacing::<3>(), file(&nifti.bytes()).placement());
            assert_eq!(spacing, Some([factor; 3]));
            assert_eq!(place.unwrap().origin[0], -5.0 * factor);
        }
    }
}

#[test]
fn frames_need_a_choice() {
    let nifti = Nifti { size: vec![3, 2, 1, 2], ..Nifti::default() };
    let error = ImageFile::from_bytes(&nifti.bytes(), "a.nii").unwrap_err();
    assert!(matches!(error, ReadError::Component { count: 2, .. }), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.nii.gz");
    std::fs::write(&path, gzip(&nifti.bytes())).unwrap();
    let chosen = ImageFile::read_component(&path, Some(1)).unwrap();
    assert_eq!(chosen.into_field::<3>(None).unwrap().values(), [6.0, 7.0, 8.0, 9.0, 10.0, 11.0]);
    let colour = Nifti { size: vec![2, 2, 2], kind: 128, ..Nifti::default() };
    assert_eq!(file(&colour.bytes()).info().channels, 3);
}

#[test]
fn pairs_of_files_are_read() {
    for (is_second, magic) in [(false, b"ni1\0"), (true, b"ni2\0")] {
        let bytes = Nifti { is_second, magic, offset: 0, ..Nifti::default() }.bytes();
        let (header, data) = bytes.split_at(bytes.len() - 24);
        let zipped = |bytes: &[u8], is_zipped| if is_zipped { gzip(bytes) } else { bytes.to_vec() };
        for (header_name, data_name) in [
            ("a.hdr", "a.img"),
            ("a.hdr.gz", "a.img.gz"),
            ("a.hdr", "a.img.gz"),
            ("b.c", "b.c.img"),
        ] {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join(header_name);
            std::fs::write(&path, zipped(header, header_name.ends_with("gz"))).unwrap();
            let missing = ImageFile::read(&path).unwrap_err();
            assert!(missing.is_access() && missing.to_string().contains(".img: "), "{missing}");
            let data = zipped(data, data_name.ends_with("gz"));
            std::fs::write(folder.path().join(data_name), data).unwrap();
            let file = ImageFile::read(&path).unwrap();
            assert_eq!(file.spacing(), Some([1.0, 2.0, 4.0]));
            let values = file.into_field::<3>(None).unwrap().into_values();
            assert_eq!(values, (0..12).map(f64::from).collect::<Vec<_>>());
        }
    }
}

#[test]
fn what_is_no_single_file_is_explained() {
    let with = |nifti: Nifti| text_error(&nifti.bytes());
    assert!(with(Nifti { magic: b"ni1\0", ..Nifti::default() }).contains("odd.file.img"));
    assert!(with(Nifti { magic: b"\0\0\0\0", ..Nifti::default() }).contains("Analyze"));
    assert!(with(Nifti { kind: 32, ..Nifti::default() }).contains("numbered 32"));
    assert!(with(Nifti { size: vec![3], ..Nifti::default() }).contains("1 axes"));
    let huge = Nifti { size: vec![30_000, 30_000, 2], ..Nifti::default() };
    assert!(with(huge).contains("30000 x 30000 x 2 voxels are too large"));
    let sheared = [[1.0, 0.5, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let sheared = Nifti { sform: Some(sheared), ..Nifti::default() };
    assert!(with(sheared).contains("axes 0 and 1 meet at 63.43 degrees"));
    let mut zipped = gzip(&Nifti::default().bytes());
    let last = zipped.len() - 1;
    zipped[last] ^= 1;
    assert!(text_error(&zipped).contains("damaged"), "the length at the end is wrong");
}
