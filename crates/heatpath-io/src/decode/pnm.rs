//! PBM, PGM and PPM, through the `image` crate.

use super::{Input, Raster};
use crate::ReadError;
use crate::sample::{SampleType, Samples};
use image::codecs::pnm::{PnmDecoder, PnmHeader, PnmSubtype, SampleEncoding};
use std::io::Cursor;

/// Values are given back as stored, from 0 to the largest value that the header announces. In
/// bilevel files (`P1`, `P4`) ink is 0 and paper is 1.
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let decoder = PnmDecoder::new(Cursor::new(input.bytes)).map_err(|e| input.broken(e))?;
    let header = decoder.header();
    let size = check_header(input, header)?;
    let bilevel = matches!(header.subtype(), PnmSubtype::Bitmap(_));
    let white = header.maximal_sample();
    let (samples, channels) = input.samples(decoder)?;
    let samples = unscaled(samples, white);
    let sample = match &samples {
        _ if bilevel => SampleType::Bool,
        Samples::U16(_) => SampleType::U16,
        _ => SampleType::U8,
    };
    let white = Some(f64::from(white));
    Ok(Raster::new(input.format, size, channels, (sample, samples), white))
}

fn check_header(input: &Input<'_>, header: &PnmHeader) -> Result<Vec<usize>, ReadError> {
    let claimed = [u64::from(header.width()), u64::from(header.height())];
    if header.maximal_sample() == 0 {
        return Err(input.broken("the largest sample value is 0"));
    }
    let samples = match header.subtype() {
        PnmSubtype::Pixmap(_) => 3,
        _ => 1,
    };
    let row = claimed[0].saturating_mul(samples);
    let row_bytes = match header.subtype() {
        PnmSubtype::Bitmap(SampleEncoding::Binary) => row.div_ceil(8),
        _ if header.maximal_sample() > 255 => row.saturating_mul(2),
        _ => row,
    };
    input.check_size(&claimed, claimed[1].saturating_mul(row_bytes))
}

/// Undoes the decoder's stretching of 0..white to the whole range of the type.
fn unscaled(samples: Samples, white: u32) -> Samples {
    let raw = |value: f64, full: f64| (value * f64::from(white) / full).round();
    match samples {
        Samples::U8(v) if white != 255 => {
            Samples::U8(v.into_iter().map(|value| raw(f64::from(value), 255.0) as u8).collect())
        }
        Samples::U16(v) if white != 65535 => {
            Samples::U16(v.into_iter().map(|value| raw(f64::from(value), 65535.0) as u16).collect())
        }
        other => other,
    }
}
