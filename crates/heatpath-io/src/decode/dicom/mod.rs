//! DICOM: single files, and folders with the slices of a series.

mod descriptions;
mod elements;
mod frame;
mod jpeg;
mod jpeg_2000;
mod jpeg_ls;
mod layout;
mod palette;
mod pixels;
mod reader;
mod rle;
mod series;
mod stack;

use super::{Input, Raster};
use crate::ReadError;
use elements::{Elements, PREAMBLE};
use frame::Frames;
use stack::{Slice, stacked};

pub(crate) use series::decode as decode_folder;

/// Whether the mark of the format stands after the preamble.
pub(super) fn is_dicom(bytes: &[u8]) -> bool {
    bytes.get(PREAMBLE..).is_some_and(|rest| rest.starts_with(b"DICM"))
}

/// The frame that is wanted, or all frames as a volume if the file says where they lie; grey, in colour
/// or of single bits. Values are rescaled.
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let elements = Elements::parse(input.bytes).map_err(|e| input.broken(e))?;
    let frames = Frames::new(&elements).map_err(|e| input.broken(e))?;
    let slices = match frames.chosen(input)? {
        Some(frame) => vec![frame],
        None => frames.slices(input)?.ok_or_else(|| frames.choice(input))?,
    };
    let count = slices.len();
    let named = (0..).zip(slices).map(|(i, frame)| Slice::new(format!("frame {i}"), frame));
    stacked(named.collect()).map_err(|reason| match count {
        1 => input.broken(reason),
        _ => input
            .broken(format!("no volume (choose one component, from 0 to {}): {reason}", count - 1)),
    })
}
