//! Any bytes behind the beginning of a medical format: an error of one line, or a volume whose place is
//! finite and whose values are as many as its size says.

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

fuzz_target!(|bytes: &[u8]| {
    let Some((choice, rest)) = bytes.split_first() else { return };
    let choice = usize::from(*choice) % (STARTS.len() + 1);
    let start = STARTS.get(choice).map_or_else(dicom, |start| start.to_vec());
    match ImageFile::from_bytes(&[&start, rest].concat(), "fuzz") {
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

/// A preamble and the mark.
fn dicom() -> Vec<u8> {
    [&[0; 128][..], b"DICM"].concat()
}

fn check(spacing: Option<[f64; 3]>, place: Option<Placement>) {
    let is_length = |h: &f64| h.is_finite() && *h > 0.0;
    assert!(spacing.is_none_or(|spacing| spacing.iter().all(is_length)));
    let is_finite = |place: Placement| {
        place.origin.iter().chain(place.direction.as_flattened()).all(|x| x.is_finite())
    };
    assert!(place.is_none_or(is_finite));
}
