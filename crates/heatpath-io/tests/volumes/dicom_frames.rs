//! DICOM: files of several frames.

use crate::common::dicom::{Dicom, SEQUENCE_END, frames, item};
use crate::common::volumes::text_error;
use crate::file;
use heatpath_io::{ImageFile, ReadError};
use std::fs;
use tempfile::tempdir;

/// A plain file of two frames with further decimal numbers.
fn plain(numbers: &[(u32, &str)]) -> Dicom {
    let mut more =
        vec![(0x0028_0008, *b"IS", b"2 ".to_vec()), (0x0028_0030, *b"DS", b"0.5\\0.25".to_vec())];
    more.extend(
        numbers.iter().map(|(tag, text)| (*tag, *b"DS", format!("{text:<8}").into_bytes())),
    );
    let pixels = vec![(0..12_u16).flat_map(u16::to_le_bytes).collect()];
    Dicom { more, pixels, ..Dicom::default() }
}

#[test]
fn frames_with_places_of_their_own_are_a_volume() {
    let file = file(&frames(&[4.0, 1.0, 2.5]).bytes());
    assert_eq!(file.spacing(), Some([0.25, 0.5, 1.5]));
    assert_eq!(file.placement().unwrap().origin, [1.0, 2.0, 1.0]);
    let volume = file.into_field::<3>(None).unwrap();
    assert_eq!([0, 1, 2].map(|z| volume[[0, 0, z]]), [6.0, 12.0, 0.0], "sorted by their place");
}

#[test]
fn one_frame_can_be_chosen_and_keeps_its_place() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.dcm");
    fs::write(&path, frames(&[4.0, 1.0, 2.5]).bytes()).unwrap();
    let file = ImageFile::read_component(&path, Some(2)).unwrap();
    assert_eq!(file.placement().unwrap().origin, [1.0, 2.0, 2.5]);
    assert_eq!(file.into_field::<2>(None).unwrap().values()[0], 12.0, "in the order of the file");
    let error = ImageFile::read_component(&path, Some(3)).unwrap_err();
    assert!(matches!(error, ReadError::Component { count: 3, .. }), "{error}");
    // In a folder a file is one slice.
    let error = ImageFile::read(folder.path()).unwrap_err();
    assert!(matches!(error, ReadError::Component { count: 3, .. }), "{error}");
}

#[test]
fn frames_that_are_no_volume_are_explained() {
    for heights in [&[1.0, 2.0, 4.0], &[1.0, 2.0, 1.0]] {
        let error = text_error(&frames(heights).bytes());
        assert!(error.contains("not evenly spaced") && error.contains("from 0 to 2"), "{error}");
    }
    let error = ImageFile::from_bytes(&plain(&[]).bytes(), "a.dcm").unwrap_err();
    assert!(matches!(error, ReadError::Component { count: 2, .. }), "{error}");
    let huge = (0x0028_0008, *b"IS", b"99999999".to_vec());
    let huge = Dicom { more: vec![huge], ..frames(&[]) };
    assert!(matches!(
        ImageFile::from_bytes(&huge.bytes(), "a").unwrap_err(),
        ReadError::Component { .. }
    ));
}

#[test]
fn regular_frames_have_one_distance() {
    let file = file(&plain(&[(0x0018_0088, "2.5")]).bytes());
    assert_eq!(file.spacing(), Some([0.25, 0.5, 2.5]));
    assert_eq!(file.into_field::<3>(None).unwrap().values()[11], 11.0);
}

#[test]
fn frames_that_follow_by_time_are_no_slices() {
    let by = |order: [u16; 2]| {
        let mut file = plain(&[(0x0018_0088, "2.5")]);
        let order = order.into_iter().flat_map(u16::to_le_bytes).collect();
        file.more.push((0x0028_0009, *b"AT", order));
        ImageFile::from_bytes(&file.bytes(), "a.dcm")
    };
    assert_eq!(by([0x0054, 0x0080]).unwrap().spacing(), Some([0.25, 0.5, 2.5]));
    let error = by([0x0018, 0x1063]).unwrap_err();
    assert!(matches!(error, ReadError::Component { count: 2, .. }), "{error}");
}

#[test]
fn frames_of_a_detector_lie_where_it_does() {
    let mut dicom = plain(&[(0x0018_0088, "2.5")]);
    let detector =
        item(&[(0x0020_0032, *b"DS", b"5\\6\\7 "), (0x0020_0037, *b"DS", b"1\\0\\0\\0\\-1\\0 ")]);
    dicom.more.push((0x0054_0022, *b"SQ", [detector, SEQUENCE_END.to_vec()].concat()));
    let file = file(&dicom.bytes());
    let place = file.placement().unwrap();
    assert_eq!(place.direction, [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
    assert_eq!((place.origin, file.spacing()), ([5.0, 6.0, 7.0], Some([0.25, 0.5, 2.5])));
}

#[test]
fn dose_grids_have_offsets() {
    let dose = |offsets: &'static str| plain(&[(0x0020_0032, "1\\2\\3"), (0x3004_000c, offsets)]);
    // Relative to the first frame, or heights.
    for offsets in ["0\\4", "3\\7"] {
        let file = file(&dose(offsets).bytes());
        assert_eq!(file.spacing(), Some([0.25, 0.5, 4.0]));
        assert_eq!(file.placement().unwrap().origin, [1.0, 2.0, 3.0]);
        assert_eq!(file.into_field::<3>(None).unwrap().values()[11], 11.0);
    }
    let down = file(&dose("0\\-4").bytes());
    assert_eq!(down.placement().unwrap().origin, [1.0, 2.0, -1.0], "sorted upwards");
    let few = text_error(&dose("0").bytes());
    assert!(few.contains("the offsets of frames end with 1; there is none 2"), "{few}");
}
