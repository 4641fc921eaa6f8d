//! How a DICOM file stores its pixels: types, colours and compressions.

use super::elements::{Elements, PIXEL_DATA};
use crate::sample::{SampleType, Samples};
use jpeg_decoder::{ColorTransform, Decoder};
use std::borrow::Cow;

/// One byte of a compressed frame stands for at most this many samples: of JPEG 8 blocks of 64 in one
/// bit each, and a margin.
const EXPANSION: u64 = 1024;

/// What the elements of the group 0028 say.
pub(super) struct Layout {
    pub(super) columns: u16,
    pub(super) rows: u16,
    pub(super) frames: usize,
    /// 1, or 3 for red, green and blue.
    pub(super) channels: u16,
    /// Whether a JPEG stores brightness and two differences of colour.
    is_ybr: bool,
    /// Whether colours come one plane after another.
    is_planar: bool,
    bytes: u16,
    bits: u16,
    is_signed: bool,
}

impl Layout {
    pub(super) fn new(elements: &Elements<'_>) -> Result<Self, String> {
        let short = |tag| elements.need_short(tag);
        let (allocated, bits) = (short(0x0028_0100)?, short(0x0028_0101)?);
        let high = elements.short(0x0028_0102).unwrap_or(bits.saturating_sub(1));
        let fits = (1..=allocated).contains(&bits) && high.checked_add(1) == Some(bits);
        if !matches!(allocated, 8 | 16 | 32) || !fits {
            return Err(format!(
                "pixels of {bits} bits up to bit {high} in {allocated}; 8, 16 and 32 bits, the lowest \
                 ones used, are accepted"
            ));
        }
        let colours = elements.text(0x0028_0004).unwrap_or_default();
        let channels = elements.short(0x0028_0002).unwrap_or(1);
        let is_ybr = matches!(colours.as_str(), "YBR_FULL" | "YBR_FULL_422");
        let is_jpeg = elements.fragments.is_some();
        match (channels, colours.as_str()) {
            (1, "MONOCHROME1" | "MONOCHROME2") | (3, "RGB") => {}
            (3, _) if is_ybr && is_jpeg => {}
            _ => return Err(format!("colours as {colours}; MONOCHROME and RGB are accepted")),
        }
        let frames = elements.array::<1>(0x0028_0008)?.map_or(1.0, |[frames]| frames);
        Ok(Self {
            columns: short(0x0028_0011)?,
            rows: short(0x0028_0010)?,
            frames: frames.max(1.0) as usize,
            channels,
            is_ybr,
            is_planar: channels == 3 && elements.short(0x0028_0006) == Some(1),
            bytes: allocated / 8,
            bits,
            is_signed: elements.short(0x0028_0103) == Some(1),
        })
    }

    pub(super) fn sample(&self) -> SampleType {
        match (self.bytes, self.is_signed) {
            (1, false) => SampleType::U8,
            (1, true) => SampleType::I8,
            (2, false) => SampleType::U16,
            (2, true) => SampleType::I16,
            (_, false) => SampleType::U32,
            (_, true) => SampleType::I32,
        }
    }

    /// The largest value of unsigned pixels of up to 16 bits.
    pub(super) fn white(&self) -> Option<f64> {
        let is_small = !self.is_signed && self.bits <= 16;
        is_small.then(|| f64::from((1_u32 << self.bits.min(16)) - 1))
    }

    /// What a file with all frames cannot do without.
    pub(super) fn least_bytes(&self, compression: Compression) -> u64 {
        let samples = self.frame_samples().saturating_mul(self.frames as u64);
        match compression {
            Compression::None => samples.saturating_mul(u64::from(self.bytes)),
            _ => samples.div_ceil(EXPANSION),
        }
    }

    fn frame_samples(&self) -> u64 {
        u64::from(self.columns) * u64::from(self.rows) * u64::from(self.channels)
    }

    fn frame_bytes(&self) -> usize {
        self.frame_samples() as usize * usize::from(self.bytes)
    }

    /// Of pixels with fewer bits than their bytes have, the others can hold anything.
    pub(super) fn unused_bits_cleared(&self, samples: Samples) -> Samples {
        let unused = u32::from(8 * self.bytes - self.bits);
        if unused == 0 {
            return samples;
        }
        match samples {
            Samples::U8(v) => Samples::U8(v.into_iter().map(|n| n << unused >> unused).collect()),
            Samples::I8(v) => Samples::I8(v.into_iter().map(|n| n << unused >> unused).collect()),
            Samples::U16(v) => Samples::U16(v.into_iter().map(|n| n << unused >> unused).collect()),
            Samples::I16(v) => Samples::I16(v.into_iter().map(|n| n << unused >> unused).collect()),
            Samples::U32(v) => Samples::U32(v.into_iter().map(|n| n << unused >> unused).collect()),
            Samples::I32(v) => Samples::I32(v.into_iter().map(|n| n << unused >> unused).collect()),
            other => other,
        }
    }
}

/// How pixels are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Rle,
    Jpeg,
}

impl Compression {
    pub(super) fn new(transfer_syntax: &str) -> Result<Self, String> {
        let kind = match transfer_syntax.strip_prefix("1.2.840.10008.1.2") {
            Some("" | ".1" | ".2") => return Ok(Self::None),
            Some(".5") => return Ok(Self::Rle),
            // Baseline, lossless with any predictor and with the first one.
            Some(".4.50" | ".4.57" | ".4.70") => return Ok(Self::Jpeg),
            Some(".4.51") => "JPEG of 12 bits",
            Some(".4.80" | ".4.81") => "JPEG-LS",
            Some(".4.90" | ".4.91") => "JPEG 2000",
            _ => transfer_syntax,
        };
        Err(format!(
            "pixels compressed by {kind}; raw, RLE, baseline and lossless JPEG are accepted: \
             decompress the file first, for example with gdcmconv --raw"
        ))
    }

    /// The bytes of one frame, the channels of a pixel side by side.
    pub(super) fn frame<'a>(
        self,
        elements: &Elements<'a>,
        layout: &Layout,
        frame: usize,
    ) -> Result<Cow<'a, [u8]>, String> {
        let bytes = match (self, &elements.fragments) {
            (Self::None, None) => {
                let pixels = elements.get(PIXEL_DATA).ok_or("there are no pixels (7fe0,0010)")?;
                let start = frame * layout.frame_bytes();
                let part = pixels.get(start..start + layout.frame_bytes());
                Cow::Borrowed(part.ok_or_else(|| {
                    let (found, needed) = (pixels.len(), layout.frame_bytes() * layout.frames);
                    format!("the pixels take {needed} bytes, but there are {found}")
                })?)
            }
            (Self::Rle, Some(fragments)) => {
                Cow::Owned(rle(&piece(fragments, layout, frame)?, layout)?)
            }
            (Self::Jpeg, Some(fragments)) => {
                return jpeg(&piece(fragments, layout, frame)?, layout).map(Cow::Owned);
            }
            _ => return Err("the pixels are not stored as the transfer syntax says".to_owned()),
        };
        if !layout.is_planar || self == Self::Rle {
            return Ok(bytes);
        }
        let (pixels, item) =
            (bytes.len() / usize::from(layout.channels), usize::from(layout.bytes));
        let places = (0..pixels).step_by(item).flat_map(|i| [i, i + pixels, i + 2 * pixels]);
        Ok(Cow::Owned(places.flat_map(|i| &bytes[i..i + item]).copied().collect()))
    }
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

/// Run lengths: a plane for each byte of a sample, the most significant one first (PS3.5, annex G).
fn rle(data: &[u8], layout: &Layout) -> Result<Vec<u8>, String> {
    let planes = usize::from(layout.channels * layout.bytes);
    let number = |i: usize| {
        let array = data.get(4 * i..4 * i + 4)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(array)).ok()
    };
    if number(0) != Some(planes) {
        return Err(format!("the run lengths have no {planes} planes"));
    }
    let pixels = layout.frame_bytes() / planes;
    let mut bytes = vec![0; layout.frame_bytes()];
    for plane in 0..planes {
        let start = number(plane + 1).and_then(|start| data.get(start..));
        let values = unpacked(start.ok_or("a plane of run lengths is missing")?, pixels)?;
        // Samples come out with the least significant byte first.
        let (channel, byte) =
            (plane / usize::from(layout.bytes), plane % usize::from(layout.bytes));
        let place = (channel + 1) * usize::from(layout.bytes) - 1 - byte;
        bytes.iter_mut().skip(place).step_by(planes).zip(values).for_each(|(to, from)| *to = from);
    }
    Ok(bytes)
}

/// The first `length` bytes of run lengths.
fn unpacked(data: &[u8], length: usize) -> Result<Vec<u8>, String> {
    let mut values = Vec::new();
    let mut rest = data;
    while values.len() < length {
        let [control, tail @ ..] = rest else { return Err("the run lengths end early".to_owned()) };
        let (control, count) = (*control, usize::from(*control));
        rest = match (control, tail) {
            (0..128, _) if count < tail.len() => {
                values.extend(&tail[..=count]);
                &tail[count + 1..]
            }
            (129.., [value, tail @ ..]) => {
                values.extend(std::iter::repeat_n(*value, 257 - count));
                tail
            }
            (128, tail) => tail,
            _ => return Err("the run lengths end early".to_owned()),
        };
    }
    values.truncate(length);
    Ok(values)
}

fn jpeg(data: &[u8], layout: &Layout) -> Result<Vec<u8>, String> {
    let mut decoder = Decoder::new(data);
    let transform = match (layout.channels, layout.is_ybr) {
        (3, true) => ColorTransform::YCbCr,
        (3, false) => ColorTransform::RGB,
        _ => ColorTransform::Grayscale,
    };
    decoder.set_color_transform(transform);
    decoder.read_info().map_err(|e| e.to_string())?;
    let info = decoder.info().ok_or("no JPEG header")?;
    let bytes = info.pixel_format.pixel_bytes() as u64;
    let needed = u64::from(layout.channels * layout.bytes);
    if [info.width, info.height] != [layout.columns, layout.rows] || bytes != needed {
        return Err(format!(
            "its JPEG has {} x {} pixels of {bytes} bytes, not {} x {} of {needed}",
            info.width, info.height, layout.columns, layout.rows
        ));
    }
    let pixels = decoder.decode().map_err(|e| e.to_string())?;
    let words = layout.bytes == 2 && cfg!(target_endian = "big");
    Ok(if words { pixels.chunks(2).flat_map(|word| [word[1], word[0]]).collect() } else { pixels })
}
