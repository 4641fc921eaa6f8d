//! How a DICOM file lays out its pixels.

use super::elements::DataSet;
use super::pixels::Compression;
use crate::error::pixels;
use crate::sample::{SampleType, Samples};

/// What the colours of pixels that are places in a list are called.
const PALETTE: &str = "PALETTE COLOR";

/// What the elements of the group 0028 say.
pub(super) struct Layout {
    pub(super) columns: u16,
    pub(super) rows: u16,
    pub(super) frames: usize,
    /// 1, or 3 for red, green and blue.
    pub(super) channels: u16,
    /// Whether a JPEG stores brightness and two differences of colour.
    pub(super) is_ybr: bool,
    /// Whether pixels are places in a list of colours.
    pub(super) is_palette: bool,
    /// Whether colours come one plane after another.
    pub(super) is_planar: bool,
    /// Whether eight pixels share a byte.
    pub(super) is_bit: bool,
    /// The bytes of a decoded sample.
    pub(super) bytes: u16,
    bits: u16,
    pub(super) is_signed: bool,
}

impl Layout {
    pub(super) fn new(data: &DataSet<'_>, compression: Compression) -> Result<Self, String> {
        let short = |tag| data.need_short(tag);
        let (allocated, bits) = (short(0x0028_0100)?, short(0x0028_0101)?);
        let high = data.short(0x0028_0102).unwrap_or(bits.saturating_sub(1));
        let fits = (1..=allocated).contains(&bits) && high.checked_add(1) == Some(bits);
        let is_bit = allocated == 1 && compression == Compression::None;
        if !(is_bit || matches!(allocated, 8 | 16 | 32)) || !fits {
            return Err(format!(
                "pixels of {bits} bits up to bit {high} in {allocated}; 8, 16 and 32 bits, the lowest \
                 ones used, and single bits that are not compressed are accepted"
            ));
        }
        let colours = data.text(0x0028_0004).unwrap_or_default();
        let channels = data.short(0x0028_0002).unwrap_or(1);
        check_colours(&colours, channels, compression)?;
        let frames = data.array::<1>(0x0028_0008)?.map_or(1.0, |[frames]| frames);
        Ok(Self {
            columns: short(0x0028_0011)?,
            rows: short(0x0028_0010)?,
            frames: frames.max(1.0) as usize,
            channels,
            is_ybr: colours.starts_with("YBR"),
            is_palette: colours == PALETTE,
            is_planar: channels == 3 && data.short(0x0028_0006) == Some(1),
            is_bit,
            bytes: allocated.div_ceil(8),
            bits,
            is_signed: data.short(0x0028_0103) == Some(1),
        })
    }

    /// What the samples are.
    pub(super) fn sample(&self) -> SampleType {
        if self.is_bit { SampleType::Bool } else { self.stored() }
    }

    /// The type of decoded numbers.
    pub(super) fn stored(&self) -> SampleType {
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
            Compression::None if self.is_bit => samples.div_ceil(8),
            Compression::None => samples.saturating_mul(u64::from(self.bytes)),
            _ => samples.div_ceil(compression.expansion()),
        }
    }

    pub(super) fn frame_samples(&self) -> u64 {
        u64::from(self.columns) * u64::from(self.rows) * u64::from(self.channels)
    }

    pub(super) fn frame_bytes(&self) -> usize {
        self.frame_samples() as usize * usize::from(self.bytes)
    }

    pub(super) fn pixel_bytes(&self) -> usize {
        usize::from(self.channels * self.bytes)
    }

    /// Refuses a compressed frame of another size.
    pub(super) fn check_size(&self, kind: &str, found: [u32; 2]) -> Result<(), String> {
        let expected = [self.columns, self.rows].map(u32::from);
        if found == expected {
            return Ok(());
        }
        Err(format!("its {kind} has {}, not {}", pixels(&found), pixels(&expected)))
    }

    /// Of pixels with fewer bits than their bytes have, the others can hold anything.
    pub(super) fn unused_bits_cleared(&self, samples: Samples) -> Samples {
        let unused = u32::from(8 * self.bytes - self.bits);
        if unused == 0 || self.is_bit {
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

/// Refuses colours that would come out wrong.
fn check_colours(colours: &str, channels: u16, compression: Compression) -> Result<(), String> {
    match (channels, colours, compression) {
        (1, "MONOCHROME1" | "MONOCHROME2" | PALETTE, _) | (3, "RGB", _) => Ok(()),
        (3, "YBR_FULL" | "YBR_FULL_422", Compression::Jpeg) => Ok(()),
        (3, "YBR_RCT" | "YBR_ICT", Compression::Jpeg2000) => Ok(()),
        _ => Err(format!(
            "{channels} values a pixel as {colours}; MONOCHROME, PALETTE COLOR, RGB and what JPEG makes \
             of it are accepted"
        )),
    }
}
