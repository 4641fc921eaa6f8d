//! From the pixels of a DICOM file to the samples of a frame.

use super::elements::{Elements, PIXEL_DATA};
use super::layout::Layout;
use super::{jpeg, jpeg_2000, jpeg_ls, rle};
use std::borrow::Cow;

/// What to do about pixels that are not read.
pub(super) const WAY_OUT: &str = "decompress the file first, for example with gdcmconv --raw";

/// How pixels are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Rle,
    Jpeg,
    JpegLs,
    Jpeg2000,
}

impl Compression {
    pub(super) fn new(transfer_syntax: &str) -> Result<Self, String> {
        match transfer_syntax.strip_prefix("1.2.840.10008.1.2") {
            Some("" | ".1" | ".2") => Ok(Self::None),
            Some(".5") => Ok(Self::Rle),
            // Baseline, extended, lossless with any predictor and with the first one.
            Some(".4.50" | ".4.51" | ".4.57" | ".4.70") => Ok(Self::Jpeg),
            Some(".4.80" | ".4.81") => Ok(Self::JpegLs),
            Some(".4.90" | ".4.91") => Ok(Self::Jpeg2000),
            _ => Err(format!(
                "pixels compressed by {transfer_syntax}; raw, RLE, JPEG, JPEG-LS and JPEG 2000 are \
                 accepted: {WAY_OUT}"
            )),
        }
    }

    /// One byte of a compressed frame stands for at most this many samples.
    pub(super) fn expansion(self) -> u64 {
        match self {
            // JPEG: 8 blocks of 64 in one bit each, and a margin. Run lengths: 64.
            Self::None | Self::Rle | Self::Jpeg => 1 << 10,
            // Runs of 2^15 in one bit each. A packet of JPEG 2000 has no such limit; with it, a frame
            // of one colour still has 2^24 pixels in 64 bytes.
            Self::JpegLs | Self::Jpeg2000 => 1 << 18,
        }
    }

    /// The bytes of memory that a decoder may need for each sample of a frame.
    pub(super) fn working_bytes(self) -> u64 {
        match self {
            // Blocks of 4 x 4 samples with 32 layers; smaller parts are refused.
            Self::Jpeg2000 => 64,
            Self::None | Self::Rle | Self::Jpeg | Self::JpegLs => 8,
        }
    }

    /// The bytes of one frame, the channels of a pixel side by side.
    pub(super) fn frame<'a>(
        self,
        elements: &Elements<'a>,
        layout: &Layout,
        frame: usize,
    ) -> Result<Cow<'a, [u8]>, String> {
        let Some(fragments) = &elements.fragments else {
            return match self {
                Self::None => raw(elements, layout, frame),
                _ => Err("the pixels are not compressed as the transfer syntax says".to_owned()),
            };
        };
        let piece = piece(fragments, layout, frame)?;
        let bytes = match self {
            Self::None => Err("the pixels lie in pieces, but are not compressed".to_owned()),
            Self::Rle => rle::decoded(&piece, layout),
            Self::Jpeg => jpeg::decoded(&piece, layout),
            Self::JpegLs => jpeg_ls::decoded(&piece, layout),
            Self::Jpeg2000 => jpeg_2000::decoded(&piece, layout),
        }?;
        let (found, needed) = (bytes.len(), layout.frame_bytes());
        if found != needed {
            return Err(format!("frame {frame} has {found} bytes decompressed, not {needed}"));
        }
        Ok(Cow::Owned(bytes))
    }
}

/// A frame that is not compressed.
fn raw<'a>(
    elements: &Elements<'a>,
    layout: &Layout,
    frame: usize,
) -> Result<Cow<'a, [u8]>, String> {
    let pixels = elements.data.get(PIXEL_DATA).ok_or("there are no pixels (7fe0,0010)")?;
    let missing =
        |needed: usize| format!("the pixels take {needed} bytes, but there are {}", pixels.len());
    let length = layout.frame_bytes();
    if layout.is_bit {
        let bits = frame * length..(frame + 1) * length;
        return match pixels.len().checked_mul(8) {
            Some(found) if bits.end <= found => {
                Ok(Cow::Owned(bits.map(|i| pixels[i / 8] >> (i % 8) & 1).collect()))
            }
            _ => Err(missing((layout.frames * length).div_ceil(8))),
        };
    }
    let part = pixels.get(frame * length..(frame + 1) * length);
    let part = part.ok_or_else(|| missing(layout.frames * length))?;
    Ok(if layout.is_planar { Cow::Owned(side_by_side(part, layout)) } else { Cow::Borrowed(part) })
}

/// Planes of colours as pixels.
fn side_by_side(planes: &[u8], layout: &Layout) -> Vec<u8> {
    let (plane, item) = (planes.len() / usize::from(layout.channels), usize::from(layout.bytes));
    let places = (0..plane).step_by(item).flat_map(|i| [i, i + plane, i + 2 * plane]);
    places.flat_map(|i| &planes[i..i + item]).copied().collect()
}

/// The compressed bytes of one frame.
fn piece<'a>(
    fragments: &[&'a [u8]],
    layout: &Layout,
    frame: usize,
) -> Result<Cow<'a, [u8]>, String> {
    match layout.frames {
        1 => Ok(Cow::Owned(fragments.concat())),
        frames if frames == fragments.len() => Ok(Cow::Borrowed(fragments[frame])),
        frames => {
            Err(format!("{} pieces of {frames} frames; one each is accepted", fragments.len()))
        }
    }
}
