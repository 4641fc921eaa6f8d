//! What is in a file.

use crate::decode::{Format, Raster};
use crate::{ImageFile, Placement, ReadError, SampleType};
use serde::Serialize;
use std::path::Path;

/// What is in a picture or a volume.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Info {
    /// The file's format, from its content.
    pub format: Format,
    /// Columns, rows and, of a volume, slices.
    pub size: Vec<usize>,
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
    /// The distance between neighbouring cell centres along each axis, if the file says so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spacing: Option<Vec<f64>>,
    /// Where the grid lies in the world, if the file says so.
    #[serde(flatten)]
    pub placement: Option<Placement>,
    /// The pictures in the file; more than 1 only for TIFF and DICOM. They are the slices of a volume,
    /// or else the first one is read.
    pub pages: usize,
}

/// Looks into a file: decodes it and reports what it holds.
///
/// # Errors
/// As [`ImageFile::read`].
pub fn info(path: impl AsRef<Path>) -> Result<Info, ReadError> {
    Ok(ImageFile::read(path)?.info())
}

impl ImageFile {
    /// What the file holds.
    #[must_use]
    pub fn info(&self) -> Info {
        let raster = &self.raster;
        let (min, max, not_finite) = range(raster);
        Info {
            format: raster.format,
            size: raster.size.clone(),
            channels: raster.channels,
            sample: raster.sample,
            min,
            max,
            not_finite,
            spacing: raster.geometry.map(|place| place.spacing[..raster.size.len()].to_vec()),
            placement: self.placement(),
            pages: raster.pages,
        }
    }
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
