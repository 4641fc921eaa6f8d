//! Formats of medical volumes: from a header and a block of numbers to samples.

mod block;
pub(super) mod meta_image;
pub(super) mod nifti;
mod nifti_place;
pub(super) mod nrrd;
mod nrrd_axes;

use super::{Input, Raster};
use crate::placement::Geometry;
use crate::sample::{SampleType, Samples};
use crate::{ReadError, memory};
use block::{Block, Encoding};

pub(super) use block::samples;

use std::str::FromStr;

/// What a header says.
struct Header {
    /// Columns, rows and, of a volume, slices.
    size: Vec<u64>,
    /// The values of a cell that stand side by side.
    channels: u64,
    /// Whether they are red, green, blue and perhaps alpha.
    is_colour: bool,
    /// The whole pictures or volumes that follow one another.
    frames: u64,
    sample: SampleType,
    is_big_endian: bool,
    encoding: Encoding,
    /// The bytes before the numbers, after inflating.
    skip: u64,
    /// Values are slope times the stored number plus intercept.
    scale: Scale,
    geometry: Option<Geometry>,
}

/// From stored numbers to values.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Scale {
    pub(super) slope: f64,
    pub(super) intercept: f64,
}

impl Default for Scale {
    fn default() -> Self {
        Self { slope: 1.0, intercept: 0.0 }
    }
}

/// Which of a file's numbers become samples.
struct Choice {
    /// The samples of each cell.
    channels: usize,
    /// The one of the values side by side that is taken; none for all of them.
    channel: Option<usize>,
    /// The picture or volume that is taken.
    frame: u64,
}

impl Header {
    /// How many numbers there are.
    fn numbers(&self) -> u64 {
        product(&self.size).saturating_mul(product(&[self.channels, self.frames]))
    }

    /// The bytes of all numbers.
    fn bytes(&self) -> u64 {
        self.numbers().saturating_mul(self.sample.bytes() as u64)
    }

    /// The samples of `data`, which begins where the numbers begin.
    fn decode(self, input: &Input<'_>, data: &[u8]) -> Result<Raster, ReadError> {
        let choice = self.choose(input)?;
        let data = Input { bytes: data, ..*input };
        let least_bytes = self.encoding.least_bytes(self.numbers(), self.sample, self.skip);
        let size = data.check_size(&self.size, least_bytes)?;
        let length = size.iter().product::<usize>() * self.channels as usize;
        memory::check(input.path, (length as u64).saturating_mul(self.sample.bytes() as u64))?;
        let first = choice.frame as usize * length;
        let block = Block {
            sample: self.sample,
            is_big_endian: self.is_big_endian,
            skip: self.skip as usize,
            first,
            length,
        };
        let taken = choice.channel.map(|channel| (channel, self.channels as usize));
        let samples = block.read(self.encoding, data.bytes, taken).map_err(|e| input.broken(e))?;
        let (samples, is_scaled) = self.scale.apply(samples);
        let white = self.sample.white().filter(|_| !is_scaled);
        let raster =
            Raster::new(input.format, size, choice.channels, (self.sample, samples), white);
        Ok(Raster { geometry: self.geometry, ..raster })
    }

    fn choose(&self, input: &Input<'_>) -> Result<Choice, ReadError> {
        let count = self.channels.saturating_mul(self.frames);
        let wrong = || ReadError::Component { path: input.path.to_owned(), count };
        if self.channels == 0 || self.frames == 0 || (self.channels > 1 && self.frames > 1) {
            return Err(input.broken(format!(
                "{} values a cell in {} frames; either may be more than 1, not both",
                self.channels, self.frames
            )));
        }
        match input.wanted.component {
            None if count == 1 => Ok(Choice { channels: 1, channel: None, frame: 0 }),
            None if self.is_colour && self.frames == 1 && matches!(count, 3 | 4) => {
                Ok(Choice { channels: count as usize, channel: None, frame: 0 })
            }
            Some(component) if (component as u64) < count => Ok(match self.frames {
                1 => Choice { channels: 1, channel: Some(component), frame: 0 },
                _ => Choice { channels: 1, channel: None, frame: component as u64 },
            }),
            _ => Err(wrong()),
        }
    }
}

impl Scale {
    /// The values, and whether they differ from what was stored.
    pub(super) fn apply(self, samples: Samples) -> (Samples, bool) {
        if self == Self::default() {
            return (samples, false);
        }
        let mut values = samples.values(0..samples.len());
        values.iter_mut().for_each(|value| *value = self.slope * *value + self.intercept);
        (Samples::F64(values), true)
    }
}

fn product(sizes: &[u64]) -> u64 {
    sizes.iter().fold(1, |product, &n| product.saturating_mul(n))
}

/// Numbers between white space.
fn numbers<T: FromStr>(field: &str, text: &str) -> Result<Vec<T>, String> {
    let wrong = |word: &str| format!("{field}: {word:?} is not a number that fits");
    text.split_whitespace().map(|word| word.parse().map_err(|_| wrong(word))).collect()
}
