//! What was written, small enough for a page with many results.

use crate::colour::{colour_map, enlargement};
use crate::decode::Wanted;
use crate::legend::enlarged;
use crate::picture::read_bytes;
use crate::{Format, ImageFile, ReadError};
use heatpath_core::grid::{Grid, Shape};
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageFormat, ImageReader, RgbImage, imageops};
use std::io::Cursor;
use std::path::Path;

/// Of 100: lines stay sharp.
const QUALITY: u8 = 85;

/// A small picture.
#[derive(Clone, Debug)]
pub struct Thumbnail {
    /// The bytes of a JPEG file.
    pub jpeg: Vec<u8>,
    /// Columns and rows, in pixels.
    pub size: [u32; 2],
}

/// Reads a picture or field for a glance at it: a PNG as it is, any other file in the colours of
/// [`colour_map`], of a volume the middle slice. The longest side has at most `longest` pixels.
///
/// # Errors
/// The file cannot be read as a picture, field or volume.
pub fn thumbnail(path: impl AsRef<Path>, longest: u32) -> Result<Thumbnail, ReadError> {
    let path = path.as_ref();
    let bytes = read_bytes(path)?;
    let wanted = Wanted { folder: path.parent(), component: None };
    let broken = |error: &dyn ToString| ReadError::Decode {
        path: path.to_owned(),
        format: Format::Png,
        reason: error.to_string(),
    };
    let picture = match image::guess_format(&bytes) {
        Ok(ImageFormat::Png) => {
            let reader = ImageReader::with_format(Cursor::new(&bytes), ImageFormat::Png);
            reader.decode().map_err(|error| broken(&error))?.into_rgb8()
        }
        _ => in_colours(ImageFile::decode(&bytes, path, wanted)?)?,
    };
    let picture = reduced(picture, longest.max(1));
    let [width, height] = [picture.width(), picture.height()];
    let mut jpeg = Vec::new();
    JpegEncoder::new_with_quality(&mut jpeg, QUALITY)
        .write_image(&picture, width, height, ExtendedColorType::Rgb8)
        .map_err(|error| broken(&error))?;
    Ok(Thumbnail { jpeg, size: [width, height] })
}

fn in_colours(file: ImageFile) -> Result<RgbImage, ReadError> {
    let field = match file.dimensions()[0] {
        2 => file.into_field([1.0; 2])?,
        _ => middle_slice(&file.into_field([1.0; 3])?),
    };
    Ok(enlarged(&colour_map(&field), enlargement(field.shape().size()) as u32))
}

fn middle_slice(volume: &Grid<f64, 3>) -> Grid<f64, 2> {
    let [columns, rows, slices] = volume.shape().size();
    let shape = Shape::new([columns, rows]).expect("a slice of a volume is no larger than that");
    Grid::from_fn(shape, |[x, y]| volume[[x, y, slices / 2]])
}

fn reduced(picture: RgbImage, longest: u32) -> RgbImage {
    let (width, height) = picture.dimensions();
    if width.max(height) <= longest {
        return picture;
    }
    let side = |side: u32| {
        let part = f64::from(side) / f64::from(width.max(height));
        ((f64::from(longest) * part).round() as u32).max(1)
    };
    imageops::resize(&picture, side(width), side(height), imageops::FilterType::Triangle)
}
