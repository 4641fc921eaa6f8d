//! Pictures, volumes, fields of numbers and of tensors, and masks from files.

use crate::decode::{Raster, Wanted, decode, decode_folder};
use crate::{Placement, ReadError, memory};
use heatpath_core::grid::{Grid, LengthError, Mask, Shape, TensorField, fraction};
use std::path::{Path, PathBuf};

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
pub struct PictureOptions<const D: usize> {
    /// Which grey value a colour picture gives; alpha is ignored. Default: luma.
    pub channel: Channel,
    /// The raw values that become 0 and 1, the lower one first; what lies outside is clamped.
    ///
    /// Default: from 0 to the largest value of the type for bilevel, 8 and 16 bit unsigned samples
    /// (for PNM to the largest value that the header announces), for all others from the smallest
    /// to the largest value of the picture. A constant picture becomes 0.
    pub range: Option<(f64, f64)>,
    /// The physical distance between the centres of two neighbouring columns, of two neighbouring
    /// rows and, in volumes, of two neighbouring slices, positive. Default: as the file says, else 1.
    pub spacing: Option<[f64; D]>,
}

impl<const D: usize> Default for PictureOptions<D> {
    fn default() -> Self {
        Self { channel: Channel::default(), range: None, spacing: None }
    }
}

/// A decoded file that says itself whether it is a picture or a volume.
///
/// Pictures are PNG, JPEG, TIFF, PNM and arrays of numpy of shape (rows, columns) or, in colour,
/// (rows, columns, 3 or 4). Volumes are TIFF files of several grey pages of one size and type, and
/// arrays of shape (slices, rows, columns). Medical formats hold either.
///
/// Where a `spacing` is asked for, `None` is that of the file, or 1 where the file has none.
///
/// ```
/// use heatpath_core::grid::{Grid, Shape};
/// use heatpath_io::{FieldStyle, ImageFile, write_field};
///
/// # let folder = tempfile::tempdir()?;
/// let path = folder.path().join("ramp.tif");
/// let ramp = Grid::from_fn(Shape::new([5, 4, 3])?, |[x, y, z]| (x + y + z) as f64);
/// write_field(&path, None, false, &ramp, &FieldStyle::default())?;
///
/// let file = ImageFile::read(&path)?;
/// assert_eq!(file.dimensions(), [3]);
/// assert_eq!(file.into_field([1.0; 3])?, ramp);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ImageFile {
    pub(crate) path: PathBuf,
    pub(crate) raster: Raster,
}

impl ImageFile {
    /// Reads and decodes a file, and the files beside it that a header may name; or a folder with the
    /// slices of a DICOM series, in order of their positions.
    ///
    /// # Errors
    /// The file cannot be read, or is neither a picture nor a volume.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        Self::read_component(path, None)
    }

    /// [`read`](Self::read), with a choice, from 0 on, among several values of a cell or several
    /// frames: one picture or volume of many. Medical formats have them.
    ///
    /// # Errors
    /// As [`read`](Self::read); there is no such component, or several and none is chosen.
    pub fn read_component(
        path: impl AsRef<Path>,
        component: Option<usize>,
    ) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let wanted = Wanted { folder: path.parent(), component };
        if path.is_dir() {
            return Ok(Self { raster: decode_folder(path, wanted)?, path: path.to_owned() });
        }
        Self::decode(&read_bytes(path)?, path, wanted)
    }

    /// [`read`](Self::read) of a file whose content is `bytes`; `name` stands in messages. There are
    /// no files beside it.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn from_bytes(bytes: &[u8], name: impl AsRef<Path>) -> Result<Self, ReadError> {
        Self::decode(bytes, name.as_ref(), Wanted::default())
    }

    pub(crate) fn decode(bytes: &[u8], path: &Path, wanted: Wanted<'_>) -> Result<Self, ReadError> {
        Ok(Self { raster: decode(bytes, path, wanted)?, path: path.to_owned() })
    }

    /// The distance between neighbouring cell centres along each axis, if the file says so.
    #[must_use]
    pub fn spacing<const D: usize>(&self) -> Option<[f64; D]> {
        let spacing = self.raster.geometry?.spacing;
        Some(std::array::from_fn(|axis| spacing.get(axis).copied().unwrap_or(1.0)))
    }

    /// Where the grid lies in the world, if the file says so.
    #[must_use]
    pub fn placement(&self) -> Option<Placement> {
        Some(self.raster.geometry?.placement)
    }

    /// The dimensions in which the file can be read, the likelier one first: 2 for a picture, 3 for
    /// a volume.
    ///
    /// Both for an array of three axes whose last one has 1, 3 or 4 entries: they can be colours or
    /// columns. Both for a picture in a medical format, which can be a slice, and for one slice.
    #[must_use]
    pub fn dimensions(&self) -> &'static [usize] {
        self.raster.dimensions()
    }

    /// The values as greys from 0 to 1.
    ///
    /// # Errors
    /// The file has another dimension, or values that are infinite or not a number; the range is
    /// empty or not finite; the spacing is not positive and finite.
    pub fn into_picture<const D: usize>(
        self,
        options: &PictureOptions<D>,
    ) -> Result<Grid<f64, D>, ReadError> {
        if let Some((low, high)) = options.range
            && !(low.is_finite() && high.is_finite() && low < high)
        {
            return Err(ReadError::Range { low, high });
        }
        let file = self.in_dimension(D)?;
        let mut picture = file.grid(grey(&file.raster, options.channel), options.spacing)?;
        refuse(&picture, |value| !value.is_finite(), &file.path)?;
        let natural = || natural_range(&file.raster, picture.values());
        let (low, high) = options.range.unwrap_or_else(natural);
        for value in picture.values_mut() {
            *value = fraction(*value, low, high);
        }
        Ok(picture)
    }

    /// The raw values, one a pixel, unscaled. Those that are infinite or not a number are kept.
    ///
    /// # Errors
    /// The file has another dimension or is in colour; the spacing is not positive and finite.
    pub fn into_field<const D: usize>(
        self,
        spacing: impl Into<Option<[f64; D]>>,
    ) -> Result<Grid<f64, D>, ReadError> {
        let file = self.in_dimension(D)?;
        if file.raster.colours() > 1 {
            return Err(ReadError::Colour { path: file.path, channels: file.raster.channels });
        }
        file.grid(grey(&file.raster, Channel::default()), spacing.into())
    }

    /// Whether the file can be read as a field of tensors on a picture (`dimension` 2) or volume (3).
    ///
    /// An array of shape (rows, columns, 3) can, although it can be a picture in colour as well.
    #[must_use]
    pub fn has_tensors(&self, dimension: usize) -> bool {
        self.raster.has_tensors(dimension)
    }

    /// The raw values as one symmetric matrix a pixel: an array of numpy of shape (rows, columns, 3),
    /// which are xx, xy, yy, or (slices, rows, columns, 6), which are xx, xy, xz, yy, yz, zz. Values
    /// that are infinite or not a number are kept.
    ///
    /// # Errors
    /// The file has no tensors on that many axes; the spacing is not positive and finite.
    pub fn into_tensors<const D: usize>(
        self,
        spacing: impl Into<Option<[f64; D]>>,
    ) -> Result<TensorField<D>, ReadError> {
        if !self.has_tensors(D) {
            return Err(ReadError::NoTensors { path: self.path, dimension: D });
        }
        let samples = &self.raster.samples;
        let components = samples.values(0..samples.len());
        TensorField::from_components(self.shape(spacing.into())?, components)
            .map_err(|e| self.broken(&e))
    }

    /// The mask: pixels that are zero (in a colour picture: black) are walls, all others are open.
    /// Alpha is ignored. In bilevel PNM files ink is zero, that is wall.
    ///
    /// # Errors
    /// The file has another dimension, or pixels that are not a number; the spacing is not positive
    /// and finite.
    pub fn into_mask<const D: usize>(
        self,
        spacing: impl Into<Option<[f64; D]>>,
    ) -> Result<Mask<D>, ReadError> {
        let file = self.in_dimension(D)?;
        let brightest = (0..file.raster.colours())
            .map(|channel| plane(&file.raster, channel))
            .reduce(|a, b| a.iter().zip(&b).map(|(a, b)| larger_magnitude(*a, *b)).collect());
        let values = file.grid(brightest.unwrap_or_default(), spacing.into())?;
        refuse(&values, f64::is_nan, &file.path)?;
        Ok(Mask::new(values.map(|&value| value != 0.0)))
    }

    fn in_dimension(self, dimension: usize) -> Result<Self, ReadError> {
        if self.has_tensors(3) {
            return Err(ReadError::Tensors { path: self.path });
        }
        let (path, size) = (self.path, self.raster.size.clone());
        match self.raster.in_dimension(dimension) {
            Some(raster) => Ok(Self { path, raster }),
            None => Err(ReadError::Dimension { path, size, dimension }),
        }
    }

    fn grid<const D: usize>(
        &self,
        values: Vec<f64>,
        spacing: Option<[f64; D]>,
    ) -> Result<Grid<f64, D>, ReadError> {
        Grid::from_values(self.shape(spacing)?, values).map_err(|error| self.broken(&error))
    }

    fn shape<const D: usize>(&self, spacing: Option<[f64; D]>) -> Result<Shape<D>, ReadError> {
        let spacing = spacing.or_else(|| self.spacing()).unwrap_or([1.0; D]);
        let size = std::array::from_fn(|axis| self.raster.size[axis]);
        Shape::with_spacing(size, spacing)
            .map_err(|source| ReadError::Grid { path: self.path.clone(), source })
    }

    fn broken(&self, error: &LengthError) -> ReadError {
        ReadError::Decode {
            path: self.path.clone(),
            format: self.raster.format,
            reason: error.to_string(),
        }
    }
}

/// Reads a picture or a volume as grey values from 0 to 1.
///
/// # Errors
/// As [`ImageFile::read`] and [`ImageFile::into_picture`].
pub fn read_picture<const D: usize>(
    path: impl AsRef<Path>,
    options: &PictureOptions<D>,
) -> Result<Grid<f64, D>, ReadError> {
    ImageFile::read(path)?.into_picture(options)
}

/// Reads one raw value a pixel, unscaled. Values that are infinite or not a number are kept.
///
/// # Errors
/// As [`ImageFile::read`] and [`ImageFile::into_field`].
pub fn read_field<const D: usize>(
    path: impl AsRef<Path>,
    spacing: impl Into<Option<[f64; D]>>,
) -> Result<Grid<f64, D>, ReadError> {
    ImageFile::read(path)?.into_field(spacing)
}

/// Reads one symmetric matrix a pixel, unscaled. Values that are infinite or not a number are kept.
///
/// # Errors
/// As [`ImageFile::read`] and [`ImageFile::into_tensors`].
pub fn read_tensors<const D: usize>(
    path: impl AsRef<Path>,
    spacing: impl Into<Option<[f64; D]>>,
) -> Result<TensorField<D>, ReadError> {
    ImageFile::read(path)?.into_tensors(spacing)
}

/// Reads a mask: pixels that are zero (in a colour picture: black) are walls, all others are open.
///
/// # Errors
/// As [`ImageFile::read`] and [`ImageFile::into_mask`].
pub fn read_mask<const D: usize>(
    path: impl AsRef<Path>,
    spacing: impl Into<Option<[f64; D]>>,
) -> Result<Mask<D>, ReadError> {
    ImageFile::read(path)?.into_mask(spacing)
}

/// The file's bytes.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    let open = |source| ReadError::Open { path: path.to_owned(), source };
    let about = std::fs::metadata(path).map_err(open)?;
    if about.is_file() {
        memory::check(path, about.len())?;
    }
    std::fs::read(path).map_err(open)
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
            let mut luma = vec![0.0; raster.samples.len() / raster.channels];
            for (channel, part) in LUMA.into_iter().enumerate() {
                luma.iter_mut().zip(plane(raster, channel)).for_each(|(sum, v)| *sum += part * v);
            }
            luma
        }
    }
}

/// Returns the first value that is `bad` as an error.
fn refuse<const D: usize>(
    grid: &Grid<f64, D>,
    bad: impl Fn(f64) -> bool,
    path: &Path,
) -> Result<(), ReadError> {
    match grid.values().iter().position(|&value| bad(value)) {
        None => Ok(()),
        Some(position) => Err(ReadError::NotFinite {
            path: path.to_owned(),
            index: grid.shape().index(position).to_vec(),
            value: grid.values()[position],
        }),
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
