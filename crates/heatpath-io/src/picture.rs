//! Pictures, fields and masks from files.

use crate::ReadError;
use crate::decode::{Raster, decode};
use heatpath_core::grid::{Grid, Mask, Shape, fraction};
use std::path::Path;

/// The parts of red, green and blue in the luma of Rec. 709.
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Which grey value a colour picture gives. Grey pictures give their grey with each of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The red channel.
    Red,
    /// The green channel: the usual choice for pictures of the retina.
    Green,
    /// The blue channel.
    Blue,
    /// Luma of Rec. 709: 0.2126 red + 0.7152 green + 0.0722 blue.
    #[default]
    Luma,
}

/// How the samples of a file become grey values from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureOptions {
    /// Which grey value a colour picture gives; alpha is ignored. Default: luma.
    pub channel: Channel,
    /// The raw values that become 0 and 1, the lower one first; what lies outside is clamped.
    ///
    /// Default: from 0 to the largest value of the type for bilevel, 8 and 16 bit unsigned samples
    /// (for PNM to the largest value that the header announces), for all others from the smallest
    /// to the largest value of the picture. A constant picture becomes 0.
    pub range: Option<(f64, f64)>,
    /// The physical distance between the centres of two neighbouring columns and of two
    /// neighbouring rows, positive. Default: 1 and 1.
    pub spacing: [f64; 2],
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self { channel: Channel::default(), range: None, spacing: [1.0; 2] }
    }
}

/// Reads a picture as grey values from 0 to 1.
///
/// # Errors
/// The file cannot be read, is no picture, or has pixels that are infinite or not a number; the
/// range is empty or not finite; the spacing is not positive and finite.
pub fn read_picture(
    path: impl AsRef<Path>,
    options: &PictureOptions,
) -> Result<Grid<f64, 2>, ReadError> {
    read_picture_from_bytes(&read_bytes(path.as_ref())?, path, options)
}

/// [`read_picture`] of a file whose content is `bytes`; `name` stands in messages.
///
/// # Errors
/// As [`read_picture`].
pub fn read_picture_from_bytes(
    bytes: &[u8],
    name: impl AsRef<Path>,
    options: &PictureOptions,
) -> Result<Grid<f64, 2>, ReadError> {
    let path = name.as_ref();
    if let Some((low, high)) = options.range
        && !(low.is_finite() && high.is_finite() && low < high)
    {
        return Err(ReadError::Range { low, high });
    }
    let raster = decode(bytes, path)?;
    let mut picture = grid(&raster, grey(&raster, options.channel), options.spacing, path)?;
    refuse(&picture, |value| !value.is_finite(), path)?;
    let (low, high) = options.range.unwrap_or_else(|| natural_range(&raster, picture.values()));
    for value in picture.values_mut() {
        *value = fraction(*value, low, high);
    }
    Ok(picture)
}

/// Reads one raw value a pixel, unscaled. Values that are infinite or not a number are kept.
///
/// # Errors
/// The file cannot be read, is no picture, or is in colour; the spacing is not positive and finite.
pub fn read_field(path: impl AsRef<Path>, spacing: [f64; 2]) -> Result<Grid<f64, 2>, ReadError> {
    read_field_from_bytes(&read_bytes(path.as_ref())?, path, spacing)
}

/// [`read_field`] of a file whose content is `bytes`; `name` stands in messages.
///
/// # Errors
/// As [`read_field`].
pub fn read_field_from_bytes(
    bytes: &[u8],
    name: impl AsRef<Path>,
    spacing: [f64; 2],
) -> Result<Grid<f64, 2>, ReadError> {
    let raster = decode(bytes, name.as_ref())?;
    if raster.colours() > 1 {
        let path = name.as_ref().to_owned();
        return Err(ReadError::Colour { path, channels: raster.channels });
    }
    grid(&raster, grey(&raster, Channel::default()), spacing, name.as_ref())
}

/// Reads a mask: pixels that are zero (in a colour picture: black) are walls, all others are open.
/// Alpha is ignored. In bilevel PNM files ink is zero, that is wall.
///
/// # Errors
/// The file cannot be read, is no picture, or has pixels that are not a number; the spacing is not
/// positive and finite.
pub fn read_mask(path: impl AsRef<Path>, spacing: [f64; 2]) -> Result<Mask<2>, ReadError> {
    read_mask_from_bytes(&read_bytes(path.as_ref())?, path, spacing)
}

/// [`read_mask`] of a file whose content is `bytes`; `name` stands in messages.
///
/// # Errors
/// As [`read_mask`].
pub fn read_mask_from_bytes(
    bytes: &[u8],
    name: impl AsRef<Path>,
    spacing: [f64; 2],
) -> Result<Mask<2>, ReadError> {
    let raster = decode(bytes, name.as_ref())?;
    let brightest = (0..raster.colours())
        .map(|channel| plane(&raster, channel))
        .reduce(|a, b| a.iter().zip(&b).map(|(a, b)| larger_magnitude(*a, *b)).collect());
    let values = grid(&raster, brightest.unwrap_or_default(), spacing, name.as_ref())?;
    refuse(&values, f64::is_nan, name.as_ref())?;
    Ok(Mask::new(values.map(|&value| value != 0.0)))
}

/// The file's bytes.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    std::fs::read(path).map_err(|source| ReadError::Open { path: path.to_owned(), source })
}

/// One channel of the picture.
fn plane(raster: &Raster, channel: usize) -> Vec<f64> {
    raster.samples.values((channel..raster.samples.len()).step_by(raster.channels))
}

fn grey(raster: &Raster, channel: Channel) -> Vec<f64> {
    match channel {
        _ if raster.colours() == 1 => plane(raster, 0),
        Channel::Red => plane(raster, 0),
        Channel::Green => plane(raster, 1),
        Channel::Blue => plane(raster, 2),
        Channel::Luma => {
            let mut luma = vec![0.0; raster.size[0] * raster.size[1]];
            for (channel, part) in LUMA.into_iter().enumerate() {
                luma.iter_mut().zip(plane(raster, channel)).for_each(|(sum, v)| *sum += part * v);
            }
            luma
        }
    }
}

fn grid(
    raster: &Raster,
    values: Vec<f64>,
    spacing: [f64; 2],
    path: &Path,
) -> Result<Grid<f64, 2>, ReadError> {
    let shape = Shape::with_spacing(raster.size, spacing)
        .map_err(|source| ReadError::Grid { path: path.to_owned(), source })?;
    Grid::from_values(shape, values).map_err(|error| ReadError::Decode {
        path: path.to_owned(),
        format: raster.format,
        reason: error.to_string(),
    })
}

/// Returns the first value that is `bad` as an error.
fn refuse(grid: &Grid<f64, 2>, bad: impl Fn(f64) -> bool, path: &Path) -> Result<(), ReadError> {
    match grid.values().iter().position(|&value| bad(value)) {
        None => Ok(()),
        Some(position) => {
            let ([x, y], value) = (grid.shape().index(position), grid.values()[position]);
            Err(ReadError::NotFinite { path: path.to_owned(), x, y, value })
        }
    }
}

fn natural_range(raster: &Raster, values: &[f64]) -> (f64, f64) {
    match raster.white {
        Some(white) => (0.0, white),
        None => (
            values.iter().copied().fold(f64::INFINITY, f64::min),
            values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ),
    }
}

/// The number farther from zero; not a number if one of them is not.
fn larger_magnitude(a: f64, b: f64) -> f64 {
    if a.is_nan() || a.abs() > b.abs() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_larger_magnitude_keeps_what_is_not_a_number() {
        assert!(larger_magnitude(f64::NAN, 1.0).is_nan());
        assert!(larger_magnitude(1.0, f64::NAN).is_nan());
        assert_eq!(larger_magnitude(-3.0, 2.0), -3.0);
    }
}
