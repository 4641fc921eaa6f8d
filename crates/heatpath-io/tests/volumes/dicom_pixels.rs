//! DICOM: compressions, colours and bits.

use crate::common::codecs::{JPEG_2000, JPEG_2000_RGB, JPEG_2000_SIGNED, JPEG_LS, JPEG_LS_NEAR};
use crate::common::dicom::Dicom;
use crate::common::volumes::text_error;
use crate::file;
use heatpath_io::{Channel, PictureOptions};

/// A file with one compressed frame of 32 x 32 pixels.
fn compressed(syntax: &'static str, bits: [u16; 2], frame: &[u8]) -> Dicom {
    Dicom { syntax, size: [32, 32], bits, pixels: vec![frame.to_vec()], ..Dicom::default() }
}

fn values(dicom: &Dicom) -> Vec<f64> {
    file(&dicom.bytes()).into_field::<2>(None).unwrap().into_values()
}

/// The value of each pixel from its column and row.
fn expected(value: impl Fn(usize, usize) -> usize) -> Vec<f64> {
    (0..32 * 32).map(|i| value(i % 32, i / 32) as f64).collect()
}

#[test]
fn jpeg_2000_and_jpeg_ls_are_exact() {
    let mut unsigned = expected(|x, y| 13_000 * (x / 16 + y / 8));
    unsigned[0] = 65_535.0;
    let mut signed = expected(|x, y| 2000 * (x / 16 + y / 8));
    signed.iter_mut().for_each(|value| *value = (*value - 1500.0).min(2047.0));
    signed[0] = -2048.0;
    for syntax in ["1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91"] {
        assert_eq!(values(&compressed(syntax, [16, 16], JPEG_2000)), unsigned);
        let dicom = Dicom { is_signed: true, ..compressed(syntax, [16, 12], JPEG_2000_SIGNED) };
        assert_eq!(values(&dicom), signed);
    }
    assert_eq!(values(&compressed("1.2.840.10008.1.2.4.80", [16, 16], JPEG_LS)), unsigned);
    let near = values(&compressed("1.2.840.10008.1.2.4.81", [8, 8], JPEG_LS_NEAR));
    assert_eq!(near[..8], [0.0, 0.0, 7.0, 7.0, 14.0, 14.0, 21.0, 22.0]);
    let misses = near.iter().zip(expected(|x, y| 3 * x + 2 * y)).map(|(a, b)| (a - b).abs());
    assert_eq!(misses.fold(0.0, f64::max), 3.0);
}

#[test]
fn colours_of_jpeg_2000_are_read() {
    let dicom = Dicom {
        colours: "YBR_RCT ",
        ..compressed("1.2.840.10008.1.2.4.90", [8, 8], JPEG_2000_RGB)
    };
    assert_eq!(file(&dicom.bytes()).info().channels, 3);
    let channel = |channel| {
        let options = PictureOptions { channel, ..PictureOptions::<2>::default() };
        let picture = file(&dicom.bytes()).into_picture(&options).unwrap();
        picture.into_values().into_iter().map(|value| (255.0 * value).round()).collect::<Vec<_>>()
    };
    assert_eq!(channel(Channel::Red), expected(|x, _| 255 * (x / 16)));
    assert_eq!(channel(Channel::Green), expected(|_, y| 255 * (y / 16)));
    assert_eq!(channel(Channel::Blue), expected(|_, _| 7));
}

#[test]
fn frames_that_are_not_as_announced_are_refused() {
    let error = |dicom: Dicom| text_error(&dicom.bytes());
    let wavelets = compressed("1.2.840.10008.1.2.4.90", [16, 16], JPEG_2000);
    let small = Dicom { size: [32, 31], ..wavelets.clone() };
    assert!(error(small).contains("JPEG 2000 has 32 x 32 pixels, not 32 x 31 pixels"));
    let thin = Dicom { bits: [8, 8], ..wavelets.clone() };
    assert!(error(thin).contains("1 components of 16 bits; 1 of up to 8 bits"));
    let colour = Dicom { colours: "RGB ", ..wavelets.clone() };
    assert!(error(colour).contains("1 components of 16 bits; 3 of up to 16 bits"));
    let cut = Dicom { pixels: vec![JPEG_2000[..JPEG_2000.len() / 2].to_vec()], ..wavelets };
    assert!(error(cut).contains("not readable as DICOM"));
    let predicted = compressed("1.2.840.10008.1.2.4.80", [16, 16], JPEG_LS);
    let cut = Dicom { pixels: vec![JPEG_LS[..JPEG_LS.len() / 2].to_vec()], ..predicted.clone() };
    assert!(error(cut).contains("truncated JPEG-LS"));
    let thin = Dicom { bits: [8, 8], ..predicted };
    assert!(error(thin).contains("has the value 65535 where 8 bits are stored"));
    // A frame header of 12 bits, as far as it is looked at.
    let header = b"\xff\xd8\xff\xc1\0\x0b\x0c\0\x20\0\x20\x01\x01\x11\0".to_vec();
    let twelve = error(compressed("1.2.840.10008.1.2.4.51", [16, 12], &header));
    assert!(twelve.contains("JPEG of 12 bits") && twelve.contains("gdcmconv --raw"), "{twelve}");
}

#[test]
fn jpeg_2000_in_tiny_parts_is_refused() {
    let error =
        |frame: &[u8]| text_error(&compressed("1.2.840.10008.1.2.4.90", [16, 16], frame).bytes());
    let mut tiles = JPEG_2000.to_vec();
    tiles[27] = 1;
    assert!(error(&tiles).contains("tiles or precincts of less than 64 x 64"));
    let style = b"\xffR\0\x0c\0\0\0\x01\0\x05\x04\x04\0\x01";
    let at = JPEG_2000.windows(style.len()).position(|part| part == style).unwrap();
    let end = at + style.len();
    let with =
        |style: &[u8], more: &[u8]| [&JPEG_2000[..at], style, more, &JPEG_2000[end..]].concat();
    let precincts = b"\xffR\0\x12\x01\0\0\x01\0\x05\x04\x04\0\x01\x33\x33\x33\x33\x33\x33";
    assert!(error(&with(precincts, b"")).contains("tiles or precincts of less than 64 x 64"));
    let own = b"\xffS\0\x0f\0\x01\x05\x04\x04\0\x01\x33\x33\x33\x33\x33\x33";
    assert!(error(&with(style, own)).contains("tiles or precincts of less than 64 x 64"));
    let changes = [&b"\xff_\0\xe9"[..], &[0, 0, 0, 1, 6, 1, 2].repeat(33)].concat();
    assert!(error(&with(style, &changes)).contains("order of packets 33 times"));
}

#[test]
fn palettes_become_colours() {
    let words =
        |words: &[u16]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<_>>();
    let palette = |bits: u16, lists: [Vec<u8>; 3]| {
        let kind = words(&[3, 1, bits]);
        let described = (0x0028_1101..0x0028_1104).map(|tag| (tag, *b"US", kind.clone()));
        let listed = (0x0028_1201..0x0028_1204).zip(lists).map(|(tag, list)| (tag, *b"OW", list));
        Dicom {
            colours: "PALETTE COLOR ",
            more: described.chain(listed).collect(),
            ..Dicom::default()
        }
    };
    let red = |dicom: &Dicom| {
        let options =
            PictureOptions { channel: Channel::Red, range: Some((0.0, 1.0)), ..Default::default() };
        let options = PictureOptions { range: Some((0.0, 65_535.0)), ..options };
        let picture = file(&dicom.bytes()).into_picture::<2>(&options).unwrap();
        picture
            .into_values()
            .into_iter()
            .map(|value| (65_535.0 * value).round())
            .collect::<Vec<_>>()
    };
    // The first colour is that of pixel 1; what lies beyond has the last one.
    let wide = palette(16, [words(&[5, 6, 70]), words(&[0, 1, 0]), words(&[0, 0, 2])]);
    assert_eq!(file(&wide.bytes()).info().sample.name(), "uint16");
    assert_eq!(red(&wide), [5.0, 5.0, 6.0, 70.0, 70.0, 70.0]);
    for lists in [
        [words(&[5, 6, 7]), words(&[0, 1, 0]), words(&[0, 0, 2])],
        [vec![5, 6, 7, 0], vec![0, 1, 0, 0], vec![0, 0, 2, 0]],
    ] {
        let narrow = palette(8, lists);
        let info = file(&narrow.bytes()).info();
        assert_eq!((info.sample.name(), info.channels), ("uint8", 3));
        assert_eq!(red(&narrow), [5.0, 5.0, 6.0, 7.0, 7.0, 7.0]);
    }
    let short = palette(16, [words(&[5, 6, 7]), words(&[0]), words(&[0, 0, 2])]);
    assert!(text_error(&short.bytes()).contains("(0028,1202) has 1 colours of 3"));
    let odd = palette(12, [vec![], vec![], vec![]]);
    assert!(text_error(&odd.bytes()).contains("described as [3, 1, 12]"));
}

#[test]
fn bits_are_unpacked_over_the_frames() {
    // The lowest bit first, and no gap between frames.
    let pixels = vec![vec![0b1100_0001, 0b0000_1010]];
    let two = (0x0028_0008, *b"IS", b"2 ".to_vec());
    let between =
        [(0x0018_0088, *b"DS", b"2.5 ".to_vec()), (0x0028_0030, *b"DS", b"1\\1 ".to_vec())];
    let more = [vec![two], between.to_vec()].concat();
    let dicom = Dicom { bits: [1, 1], pixels, more, ..Dicom::default() };
    let file = file(&dicom.bytes());
    assert_eq!((file.info().sample.name(), file.spacing()), ("bool", Some([1.0, 1.0, 2.5])));
    let expected = [1, 0, 0, 0, 0, 0, 1, 1, 0, 1, 0, 1].map(f64::from);
    assert_eq!(file.into_field::<3>(None).unwrap().values(), expected);
    let short = Dicom { pixels: vec![vec![0; 1]], ..dicom };
    assert!(text_error(&short.bytes()).contains("2 bytes, but there are 1"));
}
