//! `NIfTI`-1 and `NIfTI`-2: a binary header, and the numbers in the same file or in one beside it; plain
//! or gzipped.
//!
//! <https://nifti.nimh.nih.gov/nifti-1> and <https://nifti.nimh.nih.gov/nifti-2>

use super::block::Encoding;
use super::{Header, Scale, nifti_place, product};
use crate::ReadError;
use crate::decode::{Input, Raster};
use crate::sample::SampleType;
use flate2::bufread::MultiGzDecoder;
use std::borrow::Cow;
use std::io::Read;

/// The longer of the two headers.
const LONGEST: usize = 540;

/// The first bytes of gzipped files.
const GZIP: &[u8] = &[0x1f, 0x8b];

/// Whether there is a header of this format, or of Analyze, from which it comes.
pub(in crate::decode) fn is_nifti(bytes: &[u8]) -> bool {
    Words::new(&start(bytes)).is_some()
}

/// `.nii` and `.nii.gz`, and `.hdr` with its data in `.img` or `.img.gz`. The place is that of the sform,
/// else of the qform.
pub(in crate::decode) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let start = start(input.bytes);
    let words = Words::new(&start).ok_or_else(|| input.broken("no header"))?;
    let header = words.header().map_err(|e| input.broken(e))?;
    if words.is_whole() {
        let is_gzip = input.bytes.starts_with(GZIP);
        return header.encoded(is_gzip).decode(input, input.bytes);
    }
    let name = data_name(input);
    let data = input.beside(&name)?;
    let path = input.path.with_file_name(&name);
    header.encoded(name.ends_with(".gz")).decode(&Input { path: &path, ..*input }, &data)
}

impl Header {
    fn encoded(self, is_gzip: bool) -> Self {
        Self { encoding: if is_gzip { Encoding::Gzip } else { Encoding::Raw }, ..self }
    }
}

/// The other file of a pair, of which either may be gzipped.
fn data_name(input: &Input<'_>) -> String {
    let name = input.path.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.strip_suffix(".gz").unwrap_or(&name);
    let plain = match stem.strip_suffix(".HDR") {
        Some(stem) => format!("{stem}.IMG"),
        None => format!("{}.img", stem.strip_suffix(".hdr").unwrap_or(stem)),
    };
    let zipped = format!("{plain}.gz");
    let exists = |name: &str| input.wanted.folder.is_some_and(|folder| folder.join(name).is_file());
    if exists(&zipped) && !exists(&plain) { zipped } else { plain }
}

/// The bytes in which the header lies, inflated if need be.
fn start(bytes: &[u8]) -> Cow<'_, [u8]> {
    if !bytes.starts_with(GZIP) {
        return Cow::Borrowed(&bytes[..bytes.len().min(LONGEST)]);
    }
    let mut start = Vec::new();
    // What could be inflated before an error is still there.
    drop(MultiGzDecoder::new(bytes).take(LONGEST as u64).read_to_end(&mut start));
    Cow::Owned(start)
}

/// Where the fields of a header begin; those not named follow the others of their kind.
pub(super) struct Layout {
    bytes: usize,
    magic: usize,
    dim: usize,
    datatype: usize,
    pub(super) pixdim: usize,
    offset: usize,
    slope: usize,
    pub(super) units: usize,
    codes: usize,
    pub(super) quaternion: usize,
    pub(super) rows: usize,
}

const FIRST: Layout = Layout {
    bytes: 348,
    magic: 344,
    dim: 40,
    datatype: 70,
    pixdim: 76,
    offset: 108,
    slope: 112,
    units: 123,
    codes: 252,
    quaternion: 256,
    rows: 280,
};

const SECOND: Layout = Layout {
    bytes: 540,
    magic: 4,
    dim: 16,
    datatype: 12,
    pixdim: 104,
    offset: 168,
    slope: 176,
    units: 500,
    codes: 344,
    quaternion: 352,
    rows: 400,
};

/// A header of known version and byte order.
pub(super) struct Words<'a> {
    bytes: &'a [u8],
    pub(super) layout: Layout,
    pub(super) is_big_endian: bool,
}

impl<'a> Words<'a> {
    fn new(bytes: &'a [u8]) -> Option<Self> {
        let first = bytes.get(..4)?.try_into().ok()?;
        let [little, big] = [i32::from_le_bytes(first), i32::from_be_bytes(first)];
        let is_big_endian = !matches!(little, 348 | 540);
        let layout = match if is_big_endian { big } else { little } {
            348 => FIRST,
            540 => SECOND,
            _ => return None,
        };
        (bytes.len() >= layout.bytes).then_some(Self { bytes, layout, is_big_endian })
    }

    pub(super) fn array<const N: usize>(&self, at: usize) -> [u8; N] {
        let mut array = [0; N];
        array.copy_from_slice(&self.bytes[at..at + N]);
        if self.is_big_endian {
            array.reverse();
        }
        array
    }

    fn short(&self, at: usize) -> i64 {
        i64::from(i16::from_le_bytes(self.array(at)))
    }

    pub(super) fn is_second(&self) -> bool {
        self.layout.bytes == SECOND.bytes
    }

    /// A float, of which there are `index` before it.
    pub(super) fn float(&self, at: usize, index: usize) -> f64 {
        if self.is_second() {
            f64::from_le_bytes(self.array(at + 8 * index))
        } else {
            f64::from(f32::from_le_bytes(self.array(at + 4 * index)))
        }
    }

    fn dim(&self, index: usize) -> i64 {
        let at = self.layout.dim;
        if self.is_second() {
            i64::from_le_bytes(self.array(at + 8 * index))
        } else {
            self.short(at + 2 * index)
        }
    }

    /// The codes of the qform (0) and of the sform (1).
    pub(super) fn code(&self, index: usize) -> i64 {
        let at = self.layout.codes;
        if self.is_second() {
            i64::from(i32::from_le_bytes(self.array(at + 4 * index)))
        } else {
            self.short(at + 2 * index)
        }
    }

    fn offset(&self) -> f64 {
        let at = self.layout.offset;
        if self.is_second() { i64::from_le_bytes(self.array(at)) as f64 } else { self.float(at, 0) }
    }

    fn magic(&self) -> &[u8] {
        &self.bytes[self.layout.magic..][..4]
    }

    /// Whether the numbers lie in the file of the header.
    fn is_whole(&self) -> bool {
        self.magic()[1] == b'+'
    }

    /// The header of numbers that are not compressed.
    fn header(&self) -> Result<Header, String> {
        if !matches!(self.magic(), b"n+1\0" | b"n+2\0" | b"ni1\0" | b"ni2\0") {
            return Err("a header of Analyze, which says not how the axes lie".to_owned());
        }
        let sizes = self.sizes()?;
        let space = sizes.len().min(3);
        let (sample, channels) = self.sample_type()?;
        let skip = self.offset().max(0.0) as u64;
        let scale = Scale {
            slope: self.float(self.layout.slope, 0),
            intercept: self.float(self.layout.slope, 1),
        };
        let is_scaled = channels == 1
            && scale.slope.is_finite()
            && scale.slope != 0.0
            && scale.intercept.is_finite();
        Ok(Header {
            size: sizes[..space].to_vec(),
            channels,
            is_colour: channels > 1,
            frames: product(&sizes[space..]),
            sample,
            is_big_endian: self.is_big_endian,
            encoding: Encoding::Raw,
            // Some leave it out.
            skip: if skip == 0 && self.is_whole() { self.layout.bytes as u64 + 4 } else { skip },
            scale: if is_scaled { scale } else { Scale::default() },
            geometry: Some(nifti_place::geometry(self, space)?),
        })
    }

    fn sizes(&self) -> Result<Vec<u64>, String> {
        let axes = self.dim(0);
        if !(2..=7).contains(&axes) {
            return Err(format!("{axes} axes; 2 to 7 are accepted"));
        }
        let size = |axis| u64::try_from(self.dim(axis)).unwrap_or(0);
        Ok((1..=axes as usize).map(size).collect())
    }

    fn sample_type(&self) -> Result<(SampleType, u64), String> {
        Ok(match self.short(self.layout.datatype) {
            2 => (SampleType::U8, 1),
            4 => (SampleType::I16, 1),
            8 => (SampleType::I32, 1),
            16 => (SampleType::F32, 1),
            64 => (SampleType::F64, 1),
            128 => (SampleType::U8, 3),
            256 => (SampleType::I8, 1),
            512 => (SampleType::U16, 1),
            768 => (SampleType::U32, 1),
            1024 => (SampleType::I64, 1),
            1280 => (SampleType::U64, 1),
            2304 => (SampleType::U8, 4),
            other => {
                return Err(format!(
                    "samples of the type numbered {other}; integers and floats of up to 64 bits and \
                     colours of 8 are accepted"
                ));
            }
        })
    }
}
