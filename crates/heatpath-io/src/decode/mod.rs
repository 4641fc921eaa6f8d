//! From a file's bytes to its samples: one file per format, all with the same result.

mod dicom;
mod jpeg;
mod npy;
mod npy_header;
mod palette;
mod png;
mod pnm;
mod tiff;
mod volume;

use crate::ReadError;
use crate::error::pixels;
use crate::memory;
use crate::picture::read_bytes;
use crate::placement::Geometry;
use crate::sample::{SampleType, Samples};
use image::{ColorType, ImageDecoder};
use serde::Serialize;
use std::fmt;
use std::path::{Component, Path};

/// The largest accepted number of pixels, in a volume over all slices.
const MOST_PIXELS: u64 = 1 << 30;

/// A format of pictures and volumes, recognised by a file's first bytes and never by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Format {
    /// Portable Network Graphics.
    Png,
    /// JPEG.
    Jpeg,
    /// TIFF and `BigTIFF`, both byte orders.
    Tiff,
    /// PBM, PGM and PPM, as text (`P1` to `P3`) or binary (`P4` to `P6`).
    Pnm,
    /// An array written by numpy.
    Npy,
    /// NRRD, of `Teem` and 3D Slicer; its data in the file or beside it.
    Nrrd,
    /// `MetaImage`, of ITK; its data in the file or beside it.
    MetaImage,
    /// `NIfTI`-1 and `NIfTI`-2 in one file or in a pair of header and data, plain or gzipped.
    Nifti,
    /// DICOM: a file, or the slices of a series in a folder.
    Dicom,
}

impl Format {
    /// Looks at the first bytes.
    #[must_use]
    pub fn recognise(bytes: &[u8]) -> Option<Self> {
        match bytes {
            // The preamble before the mark can be the beginning of a TIFF.
            _ if dicom::is_dicom(bytes) => Some(Self::Dicom),
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Some(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Some(Self::Jpeg),
            [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => Some(Self::Tiff),
            [b'P', b'1'..=b'6', b' ' | b'\t'..=b'\r' | b'#', ..] => Some(Self::Pnm),
            [0x93, b'N', b'U', b'M', b'P', b'Y', ..] => Some(Self::Npy),
            [b'N', b'R', b'R', b'D', b'0', b'0', b'0', b'1'..=b'5', ..] => Some(Self::Nrrd),
            _ if volume::meta_image::is_meta_image(bytes) => Some(Self::MetaImage),
            _ if volume::nifti::is_nifti(bytes) => Some(Self::Nifti),
            _ => None,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Tiff => "TIFF",
            Self::Pnm => "PNM",
            Self::Npy => "NPY",
            Self::Nrrd => "NRRD",
            Self::MetaImage => "MetaImage",
            Self::Nifti => "NIfTI",
            Self::Dicom => "DICOM",
        })
    }
}

/// A decoded file: a picture, or a volume.
#[derive(Clone, Debug)]
pub(crate) struct Raster {
    pub(crate) format: Format,
    /// Columns, rows and, of a volume, slices.
    pub(crate) size: Vec<usize>,
    /// Grey, grey and alpha, red-green-blue, these and alpha, or the components of a tensor.
    pub(crate) channels: usize,
    pub(crate) sample: SampleType,
    /// Slice by slice and row by row, the channels of a pixel side by side.
    pub(crate) samples: Samples,
    /// The value of white, for the types that have one: bilevel, 8 and 16 bit unsigned.
    pub(crate) white: Option<f64>,
    /// Pictures in the file; the first one was decoded, or all of them as the slices of a volume.
    pub(crate) pages: usize,
    /// Whether the file has an axis of channels, which could be that of columns as well.
    pub(crate) channel_axis: bool,
    /// Where it lies in the world, in formats that say so.
    pub(crate) geometry: Option<Geometry>,
}

impl Raster {
    /// The first picture of a file, or its volume, without a place; samples with the type in which they
    /// are stored.
    fn new(
        format: Format,
        size: Vec<usize>,
        channels: usize,
        (sample, samples): (SampleType, Samples),
        white: Option<f64>,
    ) -> Self {
        let (pages, channel_axis, geometry) = (1, false, None);
        Self { format, size, channels, sample, samples, white, pages, channel_axis, geometry }
    }

    /// The dimensions in which it can be read, the likelier one first.
    pub(crate) fn dimensions(&self) -> &'static [usize] {
        match self.size.len() {
            2 if self.channel_axis || self.geometry.is_some() => &[2, 3],
            2 => &[2],
            _ if self.size[2] == 1 => &[3, 2],
            _ => &[3],
        }
    }

    /// The same samples in `dimension` dimensions, if that is one of [`Self::dimensions`].
    pub(crate) fn in_dimension(mut self, dimension: usize) -> Option<Self> {
        if !self.dimensions().contains(&dimension) {
            return None;
        }
        match self.size.len() {
            2 if dimension == 3 && self.channel_axis => {
                self.size.insert(0, std::mem::replace(&mut self.channels, 1));
            }
            2 if dimension == 3 => self.size.push(1),
            _ => self.size.truncate(dimension),
        }
        Some(self)
    }

    /// The channels without alpha: 1, 3, or those of a tensor.
    pub(crate) fn colours(&self) -> usize {
        match self.channels {
            1 | 2 => 1,
            3 | 4 => 3,
            components => components,
        }
    }

    /// Whether it has the numbers of a symmetric matrix for each cell of a grid of that `dimension`.
    pub(crate) fn has_tensors(&self, dimension: usize) -> bool {
        let components = dimension * (dimension + 1) / 2;
        self.channel_axis && self.size.len() == dimension && self.channels == components
    }
}

/// Where bytes come from, and what is wanted of them.
#[derive(Clone, Copy, Default)]
pub(crate) struct Wanted<'a> {
    /// The folder of further files that belong to this one; none if there are only the bytes.
    pub(crate) folder: Option<&'a Path>,
    /// Which one of several values a cell, or of several frames; none if there must be one.
    pub(crate) component: Option<usize>,
}

/// Decodes the first picture, or the volume, of a file whose content is `bytes`; `path` is for
/// messages.
pub(crate) fn decode(bytes: &[u8], path: &Path, wanted: Wanted<'_>) -> Result<Raster, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::Empty { path: path.to_owned() });
    }
    let format = Format::recognise(bytes)
        .ok_or_else(|| ReadError::Unrecognised { path: path.to_owned() })?;
    let input = Input { bytes, path, format, wanted };
    match format {
        Format::Nrrd => volume::nrrd::decode(&input),
        Format::MetaImage => volume::meta_image::decode(&input),
        Format::Nifti => volume::nifti::decode(&input),
        Format::Dicom => dicom::decode(&input),
        _ if wanted.component.is_some_and(|component| component > 0) => {
            Err(ReadError::Component { path: path.to_owned(), count: 1 })
        }
        Format::Png => png::decode(&input),
        Format::Jpeg => jpeg::decode(&input),
        Format::Tiff => tiff::decode(&input),
        Format::Pnm => pnm::decode(&input),
        Format::Npy => npy::decode(&input),
    }
}

/// Decodes the DICOM files of a folder as one volume.
pub(crate) use dicom::decode_folder;

/// The numbers of an NPY array with one axis.
pub(crate) fn decode_vector(bytes: &[u8], path: &Path) -> Result<Vec<f64>, ReadError> {
    npy::vector(&Input { bytes, path, format: Format::Npy, wanted: Wanted::default() })
}

/// What a decoder is given, and the errors it may return.
struct Input<'a> {
    bytes: &'a [u8],
    path: &'a Path,
    format: Format,
    wanted: Wanted<'a>,
}

impl Input<'_> {
    /// The content of a file in the same folder or below it.
    fn beside(&self, name: &str) -> Result<Vec<u8>, ReadError> {
        let name = Path::new(name);
        let is_below = name.components().all(|part| matches!(part, Component::Normal(_)));
        if !is_below || name.as_os_str().is_empty() {
            let name = name.display();
            return Err(self.broken(format!(
                "its data lie in {name}; a name in the folder of the header is accepted"
            )));
        }
        match self.wanted.folder {
            Some(folder) => read_bytes(&folder.join(name)),
            None => Err(self.broken(format!("its data lie in the file {}", name.display()))),
        }
    }

    fn broken(&self, reason: impl fmt::Display) -> ReadError {
        let reason = one_line(&reason.to_string());
        ReadError::Decode { path: self.path.to_owned(), format: self.format, reason }
    }

    fn wrong_type(&self, found: impl fmt::Display) -> ReadError {
        ReadError::Type { path: self.path.to_owned(), found: one_line(&found.to_string()) }
    }

    /// Checks a claimed size before anything of that size is allocated. `least_bytes` is what a
    /// file of such a picture cannot do without.
    fn check_size(&self, size: &[u64], least_bytes: u64) -> Result<Vec<usize>, ReadError> {
        let (path, bytes) = (self.path.to_owned(), self.bytes.len() as u64);
        if size.contains(&0) {
            return Err(self.broken(format!("{}: nothing to see", pixels(size))));
        }
        let product = size.iter().try_fold(1_u64, |product, &n| product.checked_mul(n));
        if product.is_none_or(|pixels| pixels > MOST_PIXELS) {
            return Err(ReadError::TooLarge { path, size: size.to_vec(), most: MOST_PIXELS });
        }
        memory::check(self.path, product.unwrap_or(0).saturating_mul(size_of::<f64>() as u64))?;
        if least_bytes > bytes {
            return Err(ReadError::Truncated { path, size: size.to_vec(), bytes });
        }
        Ok(size.iter().map(|&n| n as usize).collect())
    }

    /// Runs a decoder of the `image` crate: its samples and how many there are in a pixel.
    fn samples(&self, decoder: impl ImageDecoder) -> Result<(Samples, usize), ReadError> {
        let colour = decoder.color_type();
        let length = usize::try_from(decoder.total_bytes()).map_err(|e| self.broken(e))?;
        let mut bytes = vec![0; length];
        decoder.read_image(&mut bytes).map_err(|e| self.broken(e))?;
        let samples = match colour {
            ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => {
                Samples::U8(bytes)
            }
            ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
                let pairs = bytes.chunks_exact(2);
                Samples::U16(pairs.map(|pair| u16::from_ne_bytes([pair[0], pair[1]])).collect())
            }
            other => return Err(self.wrong_type(format!("{other:?}"))),
        };
        Ok((samples, usize::from(colour.channel_count())))
    }
}

/// A decoder's words, which may quote the file, fit for one line of a terminal.
pub(crate) fn one_line(text: &str) -> String {
    let plain = text.replace(char::is_control, " ");
    let line = plain.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(200) {
        None => line,
        Some((cut, _)) => format!("{}...", &line[..cut]),
    }
}
