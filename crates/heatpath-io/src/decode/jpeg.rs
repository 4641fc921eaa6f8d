//! JPEG, through the `image` crate.

use super::{Input, Raster};
use crate::ReadError;
use crate::sample::SampleType;
use image::ImageDecoder;
use image::codecs::jpeg::JpegDecoder;
use std::io::Cursor;

/// One byte of a JPEG describes at most this many pixels: 8 blocks of 64, each with one bit, and a
/// margin.
const PIXELS_A_BYTE: u64 = 1024;

/// Greys stay greys; all colour spaces come out as red, green, blue. The orientation that a camera
/// may have noted is not applied: pixel coordinates are those of the stored picture.
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    // The decoder itself is lenient and fills what is missing with grey.
    if !is_complete(input.bytes) {
        return Err(input.broken("the file is truncated: it has no end marker"));
    }
    let decoder = JpegDecoder::new(Cursor::new(input.bytes)).map_err(|e| input.broken(e))?;
    let (width, height) = decoder.dimensions();
    let claimed = [u64::from(width), u64::from(height)];
    let size = input.check_size(&claimed, (claimed[0] * claimed[1]).div_ceil(PIXELS_A_BYTE))?;
    let (samples, channels) = input.samples(decoder)?;
    Ok(Raster::new(input.format, size, channels, (SampleType::U8, samples), Some(255.0)))
}

/// Whether the markers of the file lead to an end-of-image marker.
fn is_complete(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some(marker) = next_marker(bytes, at) {
        at = match bytes[marker + 1] {
            0xd9 => return true,
            // Markers without a segment.
            0x01 | 0xd0..=0xd8 => marker + 2,
            // All others carry the length of their segment; a scan's data is skipped by searching.
            _ => match bytes.get(marker + 2..marker + 4) {
                Some(length) => {
                    marker + 2 + usize::from(u16::from_be_bytes([length[0], length[1]]))
                }
                None => return false,
            },
        };
    }
    false
}

/// The position of the next `ff` that is followed by a marker's code.
fn next_marker(bytes: &[u8], from: usize) -> Option<usize> {
    let rest = bytes.get(from..)?;
    let offset =
        rest.windows(2).position(|pair| pair[0] == 0xff && !matches!(pair[1], 0 | 0xff))?;
    Some(from + offset)
}
