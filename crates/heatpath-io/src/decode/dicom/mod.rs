//! DICOM: single files, and folders with the slices of a series.

mod elements;
mod frame;
mod pixels;
mod series;

use super::{Format, Input, Raster};
use crate::ReadError;
use elements::{Elements, PREAMBLE};
use frame::Frame;

pub(crate) use series::decode as decode_folder;

/// Whether the mark of the format stands after the preamble.
pub(super) fn is_dicom(bytes: &[u8]) -> bool {
    bytes.get(PREAMBLE..).is_some_and(|rest| rest.starts_with(b"DICM"))
}

/// One frame: raw, run lengths, baseline and lossless JPEG; grey or in colour. Values are rescaled.
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let elements = Elements::parse(input.bytes).map_err(|e| input.broken(e))?;
    let frame = Frame::decode(input, &elements)?;
    let (samples, is_scaled) = frame.scale.apply(frame.samples);
    Ok(Raster {
        format: Format::Dicom,
        size: frame.size.to_vec(),
        channels: frame.channels,
        sample: frame.sample,
        samples,
        white: frame.white.filter(|_| !is_scaled),
        pages: 1,
        channel_axis: false,
        geometry: frame.geometry,
    })
}
