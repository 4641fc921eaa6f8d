//! Any bytes behind the beginning of a medical format, or as a compressed frame of DICOM: an error of one
//! line, or a volume whose place is finite and whose values are as many as its size says.

#![no_main]

use heatpath_io::{ImageFile, Placement};
use libfuzzer_sys::fuzz_target;

/// What headers begin with; the first byte of the input chooses.
const STARTS: [&[u8]; 5] = [
    b"",
    b"NRRD0005\n",
    b"ObjectType = Image\nNDims = 3\n",
    b"\x5c\x01\0\0",
    b"\x1c\x02\0\0n+2\0\r\n\x1a\n",
];

/// What frames of DICOM can be compressed by: RLE, JPEG, lossless JPEG, JPEG-LS, JPEG 2000.
const SYNTAXES: [&str; 5] = [".5", ".4.50", ".4.70", ".4.80", ".4.90"];

fuzz_target!(|bytes: &[u8]| {
    let Some((choice, rest)) = bytes.split_first() else { return };
    let choice = usize::from(*choice) % (STARTS.len() + SYNTAXES.len() + 1);
    let file = match (STARTS.get(choice), choice.checked_sub(STARTS.len() + 1)) {
        (Some(start), _) => [start, rest].concat(),
        (None, Some(syntax)) => frame(SYNTAXES[syntax], rest),
        (None, None) => [&PREAMBLE, rest].concat(),
    };
    match ImageFile::from_bytes(&file, "fuzz") {
        Ok(file) => {
            check(file.spacing::<3>(), file.placement());
            let size = file.info().size;
            let cells: usize = size.iter().product();
            let field = match size.len() {
                2 => file.into_field::<2>(None).map(|field| field.values().len()),
                _ => file.into_field::<3>(None).map(|field| field.values().len()),
            };
            assert!(field.is_err() || field.is_ok_and(|found| found == cells));
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
});

/// What DICOM begins with: 128 bytes of anything, and its mark.
const PREAMBLE: [u8; 132] = {
    let mut preamble = [0; 132];
    [preamble[128], preamble[129], preamble[130], preamble[131]] = *b"DICM";
    preamble
};

/// A DICOM file of one frame of 32 x 32 pixels of 16 bits, compressed as a transfer syntax says.
fn frame(syntax: &str, stream: &[u8]) -> Vec<u8> {
    let short = |tag, value: u16| element(tag, b"US", &value.to_le_bytes());
    let syntax = format!("1.2.840.10008.1.2{syntax}");
    let length = (stream.len() as u32).to_le_bytes();
    [
        PREAMBLE.to_vec(),
        element([2, 0x10], b"UI", syntax.as_bytes()),
        short([0x28, 2], 1),
        element([0x28, 4], b"CS", b"MONOCHROME2 "),
        short([0x28, 0x10], 32),
        short([0x28, 0x11], 32),
        short([0x28, 0x100], 16),
        short([0x28, 0x101], 16),
        short([0x28, 0x102], 15),
        short([0x28, 0x103], 0),
        b"\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff\xfe\xff\0\xe0\0\0\0\0\xfe\xff\0\xe0".to_vec(),
        [&length, stream, b"\xfe\xff\xdd\xe0\0\0\0\0"].concat(),
    ]
    .concat()
}

fn element(tag: [u16; 2], kind: &[u8; 2], value: &[u8]) -> Vec<u8> {
    let tag = tag.into_iter().flat_map(u16::to_le_bytes).collect::<Vec<_>>();
    [&tag, &kind[..], &(value.len() as u16).to_le_bytes(), value].concat()
}

fn check(spacing: Option<[f64; 3]>, place: Option<Placement>) {
    let is_length = |h: &f64| h.is_finite() && *h > 0.0;
    assert!(spacing.is_none_or(|spacing| spacing.iter().all(is_length)));
    let is_finite = |place: Placement| {
        place.origin.iter().chain(place.direction.as_flattened()).all(|x| x.is_finite())
    };
    assert!(place.is_none_or(is_finite));
}
