//! PNG, through the `image` crate.

use super::{Input, Raster};
use crate::ReadError;
use crate::sample::{SampleType, Samples};
use image::Limits;
use image::codecs::png::PngDecoder;
use std::io::Cursor;

/// Deflate turns one byte into at most this many.
const EXPANSION: u64 = 1032;

/// Where the bit depth and the colour type stand, after the signature, a length, a name, the width
/// and the height.
const DEPTH: usize = 24;

/// Palettes are resolved to colours and 2 and 4 bit greys widened to 8 bits. 1-bit greys stay 0
/// and 1. Of an animation the first picture is read.
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let size = check_header(input)?;
    let mut limits = Limits::no_limits();
    // For ancillary chunks; the pixels themselves have been checked.
    limits.max_alloc = Some((input.bytes.len() as u64).saturating_mul(2 * EXPANSION));
    let decoder =
        PngDecoder::with_limits(Cursor::new(input.bytes), limits).map_err(|e| input.broken(e))?;
    let (samples, channels) = input.samples(decoder)?;
    let (samples, sample, white) = match samples {
        Samples::U8(values) if input.bytes[DEPTH..DEPTH + 2] == [1, 0] && channels == 1 => {
            let bits = values.into_iter().map(|value| value.min(1)).collect();
            (Samples::U8(bits), SampleType::Bool, 1.0)
        }
        Samples::U16(values) => (Samples::U16(values), SampleType::U16, 65535.0),
        other => (other, SampleType::U8, 255.0),
    };
    Ok(Raster::new(input.format, size, channels, (sample, samples), Some(white)))
}

/// Reads the size from the first chunk, which every PNG begins with.
fn check_header(input: &Input<'_>) -> Result<Vec<usize>, ReadError> {
    let header = input.bytes.get(8..DEPTH + 2).filter(|header| &header[4..8] == b"IHDR");
    let Some(header) = header else {
        return Err(input.broken("the header is missing"));
    };
    let number = |at: usize| {
        u64::from(u32::from_be_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]))
    };
    let [width, height] = [number(8), number(12)];
    let samples = match header[17] {
        2 => 3,
        4 => 2,
        6 => 4,
        _ => 1,
    };
    let row_bits = width.saturating_mul(samples * u64::from(header[16]));
    let raw_bytes = height.saturating_mul(row_bits.div_ceil(8) + 1);
    input.check_size(&[width, height], raw_bytes.div_ceil(EXPANSION))
}
