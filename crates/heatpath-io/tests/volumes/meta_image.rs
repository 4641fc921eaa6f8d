//! `MetaImage`: what headers say.

use crate::common::volumes::{gzip, meta_image, text_error, zlib};
use crate::{file, values};
use heatpath_io::{ImageFile, ReadError, info, read_field};
use std::fs;
use tempfile::tempdir;

/// Twelve numbers of 16 bits, 0 to 11, the most significant byte first.
fn big() -> Vec<u8> {
    (0..12_i16).flat_map(i16::to_be_bytes).collect()
}

fn numbers() -> Vec<f64> {
    (0..12).map(f64::from).collect()
}

#[test]
fn orders_compressions_and_text_are_known() {
    let short = "ElementType = MET_SHORT\nElementByteOrderMSB = True\n";
    assert_eq!(values(&meta_image(short, &big())), numbers());
    let compressed = format!("{short}CompressedData = True\n");
    assert_eq!(values(&meta_image(&compressed, &zlib(&big()))), numbers());
    assert_eq!(values(&meta_image(&compressed, &gzip(&big()))), numbers());
    let text = "ElementType = MET_FLOAT\nBinaryData = False\n";
    assert_eq!(values(&meta_image(text, b"0 1 2 3 4 5 6 7 8 9 10 11")), numbers());
    let at_end = format!("{short}HeaderSize = -1\n");
    assert_eq!(values(&meta_image(&at_end, &[b"anything", &big()[..]].concat())), numbers());
}

#[test]
fn each_row_of_the_matrix_is_an_axis() {
    for (origin, matrix) in
        [("Offset", "TransformMatrix"), ("Position", "Rotation"), ("Origin", "Orientation")]
    {
        let place = format!(
            "ElementType = MET_UCHAR\nElementSpacing = 1 2 3\n{origin} = 10 20 30\n\
             {matrix} = 0 1 0 -1 0 0 0 0 1\n"
        );
        let file = file(&meta_image(&place, &[0; 12]));
        let place = file.placement().unwrap();
        assert_eq!(file.spacing(), Some([1.0, 2.0, 3.0]));
        assert_eq!(place.origin, [10.0, 20.0, 30.0]);
        assert_eq!(place.direction, [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    }
}

#[test]
fn frames_and_channels_need_a_choice() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.mha");
    let data: Vec<u8> = (0..24).collect();
    let write = |head: &str| {
        let head = format!("{head}\nElementType = MET_CHAR\nElementDataFile = LOCAL\n");
        fs::write(&path, [head.as_bytes(), &data].concat()).unwrap();
    };
    for (head, expected) in [
        ("NDims = 4\nDimSize = 3 2 2 2", 12.0),
        ("NDims = 3\nDimSize = 3 2 2\nElementNumberOfChannels = 2", 1.0),
    ] {
        write(head);
        let error = ImageFile::read(&path).unwrap_err();
        assert!(matches!(error, ReadError::Component { count: 2, .. }), "{error}");
        let chosen = ImageFile::read_component(&path, Some(1)).unwrap();
        assert_eq!(chosen.into_field::<3>(None).unwrap().values()[0], expected);
    }
    let colour = "ElementNumberOfChannels = 3\nElementType = MET_UCHAR\n";
    assert_eq!(file(&meta_image(colour, &[1; 36])).info().channels, 3);
}

#[test]
fn data_may_lie_in_files_beside_the_header() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.mhd");
    let write = |place: &str| {
        let head = "NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\nElementDataFile = ";
        fs::write(&path, format!("{head}{place}\n")).unwrap();
    };
    fs::write(folder.path().join("1.raw"), [1; 6]).unwrap();
    fs::write(folder.path().join("2.raw"), [2; 6]).unwrap();
    fs::write(folder.path().join("all.raw"), [3; 12]).unwrap();
    write("all.raw");
    assert_eq!(read_field::<3>(&path, None).unwrap().values(), [3.0; 12]);
    write("LIST\n1.raw\n2.raw");
    assert_eq!(read_field::<3>(&path, None).unwrap().values()[5..7], [1.0, 2.0]);
    for (place, word) in [
        ("LIST\n1.raw", "too large for a file of 6 bytes"),
        ("slice%02d.raw 1 2 1", "slice%02d.raw"),
        ("../all.raw", "../all.raw"),
        ("none.raw", "none.raw"),
    ] {
        write(place);
        let error = info(&path).unwrap_err().to_string();
        assert!(error.lines().count() == 1 && error.contains(word), "{error}");
    }
}

#[test]
fn odd_headers_are_explained() {
    let image = |fields: &str| text_error(&meta_image(fields, &[0; 12]));
    for (fields, words) in [
        ("ElementType = MET_STRING", "MET_STRING"),
        ("ElementSpacing = 1 2", "ElementSpacing has 2 numbers where 3 are needed"),
        ("ElementSpacing = 1 2 -3", "spacing -3"),
        ("Offset = 1 2 x", "Offset: \"x\""),
        ("TransformMatrix = 1 0 0 0 2 0 0 0 1", "no unit vector"),
        ("TransformMatrix = 1 0 0 0.6 0.8 0 0 0 1", "axes 0 and 1 meet at 53.13 degrees"),
        ("HeaderSize = 99", "HeaderSize = 99, but there are 12 bytes, of which 12 are data"),
        ("nonsense", "has no ="),
        ("NDims = 5\nDimSize = 1 1 1 1 1", "5 axes"),
        ("CompressedData = True", "damaged"),
    ] {
        let error = image(&format!("ElementType = MET_UCHAR\n{fields}\n"));
        assert!(error.contains(words), "{fields}: {error}");
    }
    assert!(text_error(b"ObjectType = Scene\n1 2 3\n").contains("holds a Scene"));
    assert!(text_error(b"NDims = 3\nDimSize = 1 1 1\n").contains("no ElementType"));
}
