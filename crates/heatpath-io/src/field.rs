//! Fields to files.

use crate::encode::{Numbers, Volume};
use crate::legend::with_legend;
use crate::output::{check_dimension, known_format, write_atomically};
use crate::{Placement, WriteError};
use heatpath_core::grid::Grid;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, RgbImage};
use npyz::WriterBuilder;
use std::any::Any;
use std::io::{self, Cursor, Write};
use std::path::Path;
use tiff::encoder::{TiffEncoder, TiffKind, colortype};

/// From this many bytes of samples on a TIFF is written as `BigTIFF`, as its offsets need 64 bits.
const BIG_TIFF: usize = 4_000_000_000;

/// The largest number of pixels in a picture for eyes.
const MOST_PIXELS: usize = 1 << 29;

/// A format in which fields are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FieldFormat {
    /// An array for numpy: 64-bit floats, C order, shape (rows, columns) or (slices, rows, columns);
    /// infinities are kept.
    Npy,
    /// A TIFF of 32-bit floats, a page a slice; infinities are kept.
    Tiff,
    /// A colour-mapped picture with a colour bar, for eyes; not for volumes.
    Png,
    /// NRRD of 64-bit floats, raw; keeps infinities, spacing and placement.
    Nrrd,
    /// NRRD as a header, and beside it a file that ends in `.raw`.
    Nhdr,
    /// `MetaImage` of 64-bit floats, raw; keeps infinities, spacing and placement.
    Mha,
    /// `MetaImage` as a header, and beside it a file that ends in `.raw`.
    Mhd,
    /// `NIfTI`-1 of 64-bit floats; keeps infinities, spacing and placement, both of single floats.
    Nifti,
    /// The same, gzipped.
    NiftiGz,
}

impl FieldFormat {
    /// The endings by which the format is chosen.
    pub const ENDINGS: [&'static str; 10] =
        ["npy", "tif", "tiff", "png", "nrrd", "nhdr", "mha", "mhd", "nii", "nii.gz"];

    /// The format called `format`, or else the one that the ending of `path` stands for; capitals
    /// do not matter.
    ///
    /// # Errors
    /// It is none of [`Self::ENDINGS`].
    pub fn new(path: impl AsRef<Path>, format: Option<&str>) -> Result<Self, WriteError> {
        Ok(match known_format(path.as_ref(), format, &Self::ENDINGS)? {
            "npy" => Self::Npy,
            "png" => Self::Png,
            "nrrd" => Self::Nrrd,
            "nhdr" => Self::Nhdr,
            "mha" => Self::Mha,
            "mhd" => Self::Mhd,
            "nii" => Self::Nifti,
            "nii.gz" => Self::NiftiGz,
            _ => Self::Tiff,
        })
    }

    /// Whether the file says where the field lies in the world.
    fn is_placed(self) -> bool {
        !matches!(self, Self::Npy | Self::Tiff | Self::Png)
    }
}

/// What the file of a field says beyond its values; formats leave out what they cannot hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldStyle {
    /// A line of text above the field in a picture. Default: none.
    pub title: Option<String>,
    /// Where the field lies in the world, in medical formats. Default: the first cell at 0, the axes
    /// along those of the world.
    pub placement: Option<Placement>,
}

/// Writes a field in the given format, or else in the one that the ending of `path` stands for.
///
/// In a picture (`.png`) each cell is one pixel; if the longest side is below 256, each cell is a
/// square of several pixels. The field lies in the upper left corner, below the title if there is
/// one. Colours run from the smallest to the largest finite value; other cells are dark grey.
///
/// # Errors
/// The format is unknown or for pictures only, the folder is missing, the file exists and
/// `overwrite` is not set, the field is too large for the format, or the operating system refuses.
pub fn write_field<const D: usize>(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    field: &Grid<f64, D>,
    style: &FieldStyle,
) -> Result<(), WriteError> {
    let format_of_file = FieldFormat::new(&path, format)?;
    check_dimension(&path, format, D)?;
    if format_of_file.is_placed() {
        let numbers = Numbers::F64(field.values());
        let volume = Volume::new(field.shape(), style.placement, numbers);
        return volume.write(path.as_ref(), format_of_file, overwrite);
    }
    write_atomically(&path, overwrite, |out| match (format_of_file, as_picture(field)) {
        (FieldFormat::Npy, _) => write_npy(out, field),
        (FieldFormat::Png, Some(field)) => {
            check_picture_size(field.shape().size())?;
            write_png(out, &with_legend(field, style.title.as_deref()))
        }
        _ => write_tiff(out, field),
    })
}

/// Writes a mask in the given format, or else in the one that the ending of `path` stands for: 255 in
/// the cells that are true, 0 in the others. A picture (`.png`) has one grey pixel a cell, medical
/// formats a byte.
///
/// # Errors
/// As [`write_field`].
pub fn write_mask<const D: usize>(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    mask: &Grid<bool, D>,
    placement: Option<Placement>,
) -> Result<(), WriteError> {
    let format_of_file = FieldFormat::new(&path, format)?;
    if format_of_file.is_placed() {
        let bytes: Vec<u8> =
            mask.values().iter().map(|&is_in| if is_in { 255 } else { 0 }).collect();
        let volume = Volume::new(mask.shape(), placement, Numbers::U8(&bytes));
        return volume.write(path.as_ref(), format_of_file, overwrite);
    }
    let values = mask.map(|&is_inside| if is_inside { 255.0 } else { 0.0 });
    match (format_of_file, as_picture(&values)) {
        (FieldFormat::Png, Some(values)) => write_atomically(&path, overwrite, |out| {
            let size = values.shape().size();
            check_picture_size(size)?;
            let [width, height] = size.map(|n| n as u32);
            let pixels: Vec<u8> = values.values().iter().map(|&value| value as u8).collect();
            PngEncoder::new(out)
                .write_image(&pixels, width, height, ExtendedColorType::L8)
                .map_err(io::Error::other)
        }),
        _ => write_field(path, format, overwrite, &values, &FieldStyle::default()),
    }
}

/// The grid itself if it is a picture.
pub(crate) fn as_picture<const D: usize>(grid: &Grid<f64, D>) -> Option<&Grid<f64, 2>> {
    (grid as &dyn Any).downcast_ref()
}

fn write_npy<const D: usize>(out: &mut dyn Write, field: &Grid<f64, D>) -> io::Result<()> {
    let mut shape = field.shape().size().map(|n| n as u64);
    shape.reverse();
    let options = npyz::WriteOptions::<f64>::new().default_dtype().shape(&shape);
    let mut writer = options.writer(out).begin_nd()?;
    writer.extend(field.values().iter().copied())?;
    writer.finish()
}

fn write_tiff<const D: usize>(out: &mut dyn Write, field: &Grid<f64, D>) -> io::Result<()> {
    let mut bytes = Cursor::new(Vec::new());
    if field.values().len() * size_of::<f32>() < BIG_TIFF {
        encode_tiff(TiffEncoder::new(&mut bytes).map_err(io::Error::other)?, field)?;
    } else {
        encode_tiff(TiffEncoder::new_big(&mut bytes).map_err(io::Error::other)?, field)?;
    }
    out.write_all(bytes.get_ref())
}

fn encode_tiff<W: Write + io::Seek, K: TiffKind, const D: usize>(
    mut encoder: TiffEncoder<W, K>,
    field: &Grid<f64, D>,
) -> io::Result<()> {
    let size = field.shape().size();
    let [columns, rows] = [size[0], size[1]].map(u32::try_from);
    let (columns, rows) = (columns.map_err(io::Error::other)?, rows.map_err(io::Error::other)?);
    for slice in field.values().chunks(size[0] * size[1]) {
        let values: Vec<f32> = slice.iter().map(|&value| value as f32).collect();
        encoder
            .write_image::<colortype::Gray32Float>(columns, rows, &values)
            .map_err(io::Error::other)?;
    }
    Ok(())
}

/// Writes a picture as PNG.
pub(crate) fn write_png(out: &mut dyn Write, picture: &RgbImage) -> io::Result<()> {
    PngEncoder::new(out)
        .write_image(picture, picture.width(), picture.height(), ExtendedColorType::Rgb8)
        .map_err(io::Error::other)
}

/// Refuses pictures that no viewer would open.
pub(crate) fn check_picture_size(size: [usize; 2]) -> io::Result<()> {
    if size[0].saturating_mul(size[1]) <= MOST_PIXELS {
        return Ok(());
    }
    let [columns, rows] = size;
    Err(io::Error::other(format!("{columns} x {rows} cells are too large for a PNG picture")))
}
