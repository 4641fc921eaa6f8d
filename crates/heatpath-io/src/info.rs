//! What is in a picture file.

use crate::decode::{Format, Raster, decode};
use crate::picture::read_bytes;
use crate::{ReadError, SampleType};
use serde::Serialize;
use std::path::Path;

/// What is in a picture file.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Info {
    /// The file's format, from its content.
    pub format: Format,
    /// Columns and rows.
    pub size: [usize; 2],
    /// The channels: 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha.
    pub channels: usize,
    /// The type of the samples.
    pub sample: SampleType,
    /// The smallest finite raw value over all channels but alpha; none if no value is finite.
    pub min: Option<f64>,
    /// The largest finite raw value over all channels but alpha; none if no value is finite.
    pub max: Option<f64>,
    /// How many values are infinite or not a number, alpha left out.
    pub not_finite: usize,
    /// The pictures in the file; more than 1 only for TIFF, of which the first one is read.
    pub pages: usize,
}

/// Looks into a file: decodes it and reports what it holds.
///
/// # Errors
/// The file cannot be read or is no picture.
pub fn info(path: impl AsRef<Path>) -> Result<Info, ReadError> {
    info_from_bytes(&read_bytes(path.as_ref())?, path)
}

/// [`info`] of a file whose content is `bytes`; `name` stands in messages.
///
/// # Errors
/// As [`info`].
pub fn info_from_bytes(bytes: &[u8], name: impl AsRef<Path>) -> Result<Info, ReadError> {
    let raster = decode(bytes, name.as_ref())?;
    let (min, max, not_finite) = range(&raster);
    let Raster { format, size, channels, sample, pages, .. } = raster;
    Ok(Info { format, size, channels, sample, min, max, not_finite, pages })
}

/// The smallest and the largest finite value and the number of others, without alpha.
fn range(raster: &Raster) -> (Option<f64>, Option<f64>, usize) {
    let (mut min, mut max, mut not_finite) = (f64::INFINITY, f64::NEG_INFINITY, 0);
    raster.samples.for_each(|i, value| {
        if i % raster.channels >= raster.colours() {
            return;
        }
        if value.is_finite() {
            min = min.min(value);
            max = max.max(value);
        } else {
            not_finite += 1;
        }
    });
    let finite = |value: f64| value.is_finite().then_some(value);
    (finite(min), finite(max), not_finite)
}
