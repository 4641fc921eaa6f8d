//! Samples that are places in a list of colours: of TIFF how to get them, and for all formats the colours.

use super::Raster;
use crate::sample::{SampleType, Samples};

/// The tag that says what samples stand for.
const INTERPRETATION: u16 = 262;
/// Its value for grey where 0 is black.
const GREY: u16 = 1;

/// Reads whole numbers in one of the two byte orders.
struct Reader<'a> {
    bytes: &'a [u8],
    little: bool,
}

impl Reader<'_> {
    /// The number of `length` bytes at `at`.
    fn number(&self, at: usize, length: usize) -> Option<usize> {
        let bytes = self.bytes.get(at..at.checked_add(length)?)?;
        let push = |number: u64, &byte: &u8| number << 8 | u64::from(byte);
        let number = match self.little {
            true => bytes.iter().rev().fold(0, push),
            false => bytes.iter().fold(0, push),
        };
        usize::try_from(number).ok()
    }
}

/// A copy of the file that interprets the first picture as grey; none if its directory is damaged.
pub(super) fn as_grey(bytes: &[u8]) -> Option<Vec<u8>> {
    let reader = Reader { bytes, little: bytes.first() == Some(&b'I') };
    // Where the directory's position stands and how long that number is; how long the number of
    // entries is; how long an entry is and where its value begins.
    let (at, offset, count, entry, value) = match reader.number(2, 2)? {
        42 => (4, 4, 2, 12, 8),
        _ => (8, 8, 8, 20, 12),
    };
    let directory = reader.number(at, offset)?;
    let entries = reader.number(directory, count)?;
    let first = directory.checked_add(count)?;
    let mut starts = (0..entries).map(|i| first.checked_add(i.checked_mul(entry)?));
    let found =
        starts.find_map(|start| match start.map(|start| (start, reader.number(start, 2))) {
            Some((start, Some(tag))) if tag == usize::from(INTERPRETATION) => Some(Some(start)),
            Some((_, Some(_))) => None,
            // The directory ends before its time.
            _ => Some(None),
        });
    let at = found??.checked_add(value)?;
    let mut copy = bytes.to_vec();
    let grey = if reader.little { GREY.to_le_bytes() } else { GREY.to_be_bytes() };
    copy.get_mut(at..at.checked_add(2)?)?.copy_from_slice(&grey);
    Some(copy)
}

/// The samples of a picture.
pub(super) struct Coloured {
    pub(super) channels: usize,
    pub(super) sample: SampleType,
    pub(super) samples: Samples,
    /// The value of white, if there is one.
    pub(super) white: Option<f64>,
}

/// The picture with each sample replaced by its colour: all reds, all greens and all blues stand in
/// a row in `colours`. A list of greys gives a grey picture.
pub(super) fn resolved(places: &Raster, colours: &[u16]) -> Result<Raster, String> {
    let length = colours.len() / 3;
    let indices = match &places.samples {
        Samples::U8(indices) if places.channels == 1 => indices,
        _ => return Err(format!("a palette with {} is not accepted", places.sample)),
    };
    if let Some(&beyond) = indices.iter().find(|&&i| usize::from(i) >= length) {
        return Err(format!("colour {beyond} is not in the palette of {length} colours"));
    }
    let Coloured { channels, sample, samples, white } =
        coloured(indices.iter().map(|&i| usize::from(i)), colours);
    let size = places.size.clone();
    Ok(Raster { size, channels, sample, samples, white, ..*places })
}

/// The colours at places in such a list, which are all in it.
pub(super) fn coloured(places: impl Iterator<Item = usize>, colours: &[u16]) -> Coloured {
    let length = colours.len() / 3;
    let channels = if is_grey(colours, length) { 1 } else { 3 };
    let values = places.flat_map(|i| (0..channels).map(move |c| colours[i + c * length]));
    // Palettes have 16 bits; most are 8-bit colours in both bytes.
    let (samples, sample, white) = if colours.iter().all(|colour| colour % 257 == 0) {
        (Samples::U8(values.map(|value| (value >> 8) as u8).collect()), SampleType::U8, 255.0)
    } else {
        (Samples::U16(values.collect()), SampleType::U16, 65535.0)
    };
    Coloured { channels, sample, samples, white: Some(white) }
}

fn is_grey(colours: &[u16], length: usize) -> bool {
    (0..length).all(|i| colours[i] == colours[i + length] && colours[i] == colours[i + 2 * length])
}
