//! NRRD: what headers say.

use crate::common::volumes::{gzip, nrrd, text_error};
use crate::{file, values};
use heatpath_io::{ImageFile, ReadError, info, read_field};
use std::fs;
use tempfile::tempdir;

#[test]
fn the_spaces_of_nrrd_become_lps() {
    for (space, sign) in [
        ("right-anterior-superior", [-1.0, -1.0]),
        ("RAS", [-1.0, -1.0]),
        ("left-anterior-superior", [1.0, -1.0]),
        ("left-posterior-superior", [1.0, 1.0]),
        ("scanner-xyz", [1.0, 1.0]),
    ] {
        let bytes = nrrd(&format!(
            "type: uint8\nspace: {space}\nspace directions: (0,2,0) ( 3, 0, 0 ) (0,0,0.5)\n\
             space origin: (10,20,30)"
        ));
        let (spacing, place) = (file(&bytes).spacing::<3>(), file(&bytes).placement().unwrap());
        let [x, y] = sign;
        assert_eq!(spacing, Some([2.0, 3.0, 0.5]));
        assert_eq!(place.origin, [10.0 * x, 20.0 * y, 30.0], "{space}");
        assert_eq!(place.direction, [[0.0, y, 0.0], [x, 0.0, 0.0], [0.0, 0.0, 1.0]], "{space}");
    }
}

#[test]
fn nrrd_knows_types_orders_encodings_and_skips() {
    let numbers: Vec<f64> = (0..12).map(f64::from).collect();
    let big: Vec<u8> = (0..12_i16).flat_map(i16::to_be_bytes).collect();
    let with = |fields: &str, data: &[u8]| {
        let head =
            format!("NRRD0005\r\n# note\r\ndimension: 3\r\nsizes: 3 2 2\r\n{fields}\r\n\r\n");
        [head.as_bytes(), data].concat()
    };
    let raw = with("type: short\r\nkey:=value\r\nendian: big\r\nencoding: raw", &big);
    assert_eq!(values(&raw), numbers);
    let zipped = gzip(&big);
    assert_eq!(values(&with("type: int16\nendian: big\nencoding: gzip", &zipped)), numbers);
    let text = b"0 1 2 3, 4 5\n6 7 8 9 10 11\n";
    assert_eq!(values(&with("type: float\nencoding: ascii", text)), numbers);
    let skipping = with(
        "type: int16\nendian: big\nencoding: raw\nline skip: 1\nbyte skip: 2",
        &[b"a line\nxy", &big[..]].concat(),
    );
    assert_eq!(values(&skipping), numbers);
    let at_end = with(
        "type: int16\nendian: big\nencoding: raw\nbyte skip: -1",
        &[b"whatever", &big[..]].concat(),
    );
    assert_eq!(values(&at_end), numbers);
    assert_eq!(file(&raw).info().sample.name(), "int16");
    assert_eq!(file(&raw).placement(), None);
    let spaced = with("type: int16\nendian: big\nencoding: raw\nspacings: 1.5 NaN -2", &big);
    assert_eq!(file(&spaced).spacing(), Some([1.5, 1.0, 2.0]));
}

#[test]
fn several_values_a_voxel_need_a_choice() {
    let folder = tempdir().unwrap();
    let data: Vec<u8> = (0..24).collect();
    let write = |name: &str, head: &str| {
        let path = folder.path().join(name);
        let head = format!("NRRD0004\ndimension: 4\n{head}\nencoding: raw\n\n");
        fs::write(&path, [head.as_bytes(), &data].concat()).unwrap();
        path
    };
    let first =
        write("first.nrrd", "type: int8\nsizes: 2 3 2 2\nkinds: vector domain domain domain");
    let last = write("last.nrrd", "type: int8\nsizes: 3 2 2 2");
    for path in [&first, &last] {
        let error = ImageFile::read(path).unwrap_err();
        assert!(matches!(error, ReadError::Component { count: 2, .. }), "{error}");
        assert!(ImageFile::read_component(path, Some(2)).is_err());
    }
    let chosen = |path, component| {
        let file = ImageFile::read_component(path, Some(component)).unwrap();
        file.into_field::<3>(None).unwrap().into_values()
    };
    let expected = |start: usize, step| (start..24).step_by(step).take(12).map(|n| n as f64);
    assert_eq!(chosen(&first, 1), expected(1, 2).collect::<Vec<_>>());
    assert_eq!(chosen(&last, 1), expected(12, 1).collect::<Vec<_>>());
    let colour =
        write("rgb.nrrd", "type: uint8\nsizes: 3 2 2 2\nkinds: RGB-color domain domain domain");
    assert_eq!(info(&colour).unwrap().channels, 3);
    assert_eq!(chosen(&colour, 2)[1], 5.0);
}

#[test]
fn data_beside_a_header_stay_in_its_folder() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.nhdr");
    let head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 2 2\nencoding: raw\ndata file: ";
    fs::write(folder.path().join("a.raw"), [7; 12]).unwrap();
    fs::write(&path, format!("{head}a.raw\n")).unwrap();
    assert_eq!(read_field::<3>(&path, None).unwrap().values(), [7.0; 12]);
    for outside in ["/etc/passwd", "../a.raw", "LIST"] {
        fs::write(&path, format!("{head}{outside}\n")).unwrap();
        let error = ImageFile::read(&path).unwrap_err().to_string();
        assert!(error.lines().count() == 1 && error.contains(outside), "{error}");
    }
    let error = text_error(format!("{head}a.raw\n").as_bytes());
    assert!(error.contains("its data lie in the file a.raw"), "{error}");
}

#[test]
fn odd_nrrd_headers_are_explained() {
    let place = "type: uint8\nspace: LPS\nspace origin: (0,0,0)\nspace directions:";
    for (fields, words) in [
        ("type: block", "samples of type block"),
        ("type: short", "endian"),
        (&format!("{place} (1,0,0) (0,1,0) (0,0.5,1)"), "axes 1 and 2 meet at 63.43 degrees"),
        (&format!("{place} (1,0,0) (0,1,0) (0,0,0)"), "spacing 0"),
        (&format!("{place} (1,0,0) (0,1,0)"), "names 2 axes"),
        (&format!("{place} (1,0,0) (0,1,0) 5"), "no vector"),
        (&format!("{place} (1,0,0) none (0,1,0)"), "2 or 3 are needed"),
        ("type: uint8\nhello", "no field"),
        ("type: uint8\nbyte skip: 13", "too large for a file of 12 bytes"),
        ("type: uint8\nline skip: 9", "line skip is 9, but there are 0 lines"),
    ] {
        let error = text_error(&nrrd(fields));
        assert!(error.contains(words), "{fields}: {error}");
    }
    let error = text_error(b"NRRD0004\ntype: uint8\nsizes: 2 2\nencoding: bzip2\n\n");
    assert!(error.contains("raw, gzip and text"), "{error}");
    let error = text_error(b"NRRD0004\ntype: uint8\nsizes: 900 900 900\nencoding: gzip\n\nabc");
    assert!(error.contains("900 x 900 x 900 voxels are too large for a file of"), "{error}");
    let error = text_error(&nrrd("type: uint8")[..70]);
    assert!(error.contains("too large for a file of"), "{error}");
}
