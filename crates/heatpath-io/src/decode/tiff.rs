//! TIFF, through the `tiff` crate.

use super::{Input, Raster, palette};
use crate::ReadError;
use crate::error::pixels;
use crate::sample::{SampleType, Samples};
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffResult};

type File<'a> = Decoder<Cursor<&'a [u8]>>;

/// LZW and deflate turn one byte into at most this many (LZW: codes of 12 bits for up to 3,840
/// bytes each).
const EXPANSION: u64 = 2600;

/// The compressions of fax machines spend one bit on a row that is like the one above it.
const ROWS_A_BYTE: u64 = 8;

/// The number of a picture whose samples are places in a list of colours.
const PALETTE: u16 = 3;

/// Grey (1 to 64 bits), colour or palette; with or without alpha; strips or tiles. Several pages of
/// grey are the slices of a volume if the first two are alike; else the first page is the picture.
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    let mut file = open(input)?;
    if file.find_tag_unsigned(Tag::PhotometricInterpretation).ok().flatten() == Some(PALETTE) {
        return decode_palette(input, &mut file);
    }
    decode_file(input, file)
}

fn decode_file(input: &Input<'_>, mut file: File<'_>) -> Result<Raster, ReadError> {
    let first = Page::describe(&mut file).map_err(|e| input.broken(e))?;
    let channels = channels(input, &mut file, first.colour)?;
    let further = further_pages(&mut file);
    let size = size(input, &first, &further)?;
    let mut file = file.with_limits(limits(input, first.raw_bytes));
    file.seek_to_image(0).map_err(|e| input.broken(e))?;
    let (mut samples, sample) = read(input, &mut file, &first)?;
    for number in 2..=size.get(2).copied().unwrap_or(1) {
        file.next_image().map_err(|e| on_page(number, input.broken(e)))?;
        let (slice, other) =
            read(input, &mut file, &first).map_err(|error| on_page(number, error))?;
        if other != sample {
            let reason = format!("samples of type {other}, but those of page 1 are {sample}");
            return Err(on_page(number, input.broken(reason)));
        }
        samples.append(slice);
    }
    if samples.len() != size.iter().product::<usize>() * channels {
        return Err(input.broken("the number of samples does not fit the size"));
    }
    let white = white(sample, first.colour.bit_depth());
    let pages = 1 + further.iter().filter(|page| page.is_ok()).count();
    let raster = Raster::new(input.format, size, channels, (sample, samples), white);
    Ok(Raster { pages, ..raster })
}

/// A page before it is decoded.
struct Page {
    /// Columns and rows.
    size: [u64; 2],
    colour: ColorType,
    /// The bytes of all samples.
    raw_bytes: u64,
    /// What a file with this page cannot do without.
    least_bytes: u64,
}

impl Page {
    /// The page that the decoder is at.
    fn describe(file: &mut File<'_>) -> TiffResult<Self> {
        let (colour, (width, height)) = (file.colortype()?, file.dimensions()?);
        let size = [u64::from(width), u64::from(height)];
        let row_bits = size[0].saturating_mul(u64::from(colour.num_samples()));
        let row_bytes = row_bits.saturating_mul(u64::from(colour.bit_depth())).div_ceil(8);
        let raw_bytes = size[1].saturating_mul(row_bytes);
        let compression = file.find_tag_unsigned::<u16>(Tag::Compression).ok().flatten();
        let least_bytes = match compression.unwrap_or(1) {
            1 => raw_bytes,
            2..=4 => size[1].div_ceil(ROWS_A_BYTE),
            _ => raw_bytes.div_ceil(EXPANSION),
        };
        Ok(Self { size, colour, raw_bytes, least_bytes })
    }

    fn is_like(&self, other: &Self) -> bool {
        self.size == other.size && self.colour == other.colour
    }
}

/// The pages after the first one.
fn further_pages(file: &mut File<'_>) -> Vec<TiffResult<Page>> {
    let mut pages = Vec::new();
    while file.more_images() {
        pages.push(file.next_image().and_then(|()| Page::describe(file)));
    }
    pages
}

/// The size of the picture, or of the volume if there are several pages of grey like the first one.
///
/// Pages that differ from the second one on are thumbnails or the levels of a pyramid; a volume
/// with a page that differs is damaged.
fn size(
    input: &Input<'_>,
    first: &Page,
    further: &[TiffResult<Page>],
) -> Result<Vec<usize>, ReadError> {
    let grey = matches!(first.colour, ColorType::Gray(_));
    let second = further.first();
    if !grey || second.is_none_or(|page| page.as_ref().is_ok_and(|page| !page.is_like(first))) {
        return input.check_size(&first.size, first.least_bytes);
    }
    let mut least_bytes = first.least_bytes;
    for (number, page) in (2..).zip(further) {
        match page {
            Ok(page) if page.is_like(first) => {
                least_bytes = least_bytes.saturating_add(page.least_bytes);
            }
            Ok(page) => {
                let [found, needed] =
                    [page, first].map(|p| format!("{:?} {}", p.colour, pixels(&p.size)));
                let reason = format!("has {found}, but page 1 has {needed}");
                return Err(on_page(number, input.broken(reason)));
            }
            Err(error) => return Err(on_page(number, input.broken(error))),
        }
    }
    let [width, height] = first.size;
    input.check_size(&[width, height, 1 + further.len() as u64], least_bytes)
}

/// The same error with the number of the page, counted from 1.
fn on_page(number: usize, error: ReadError) -> ReadError {
    match error {
        ReadError::Decode { path, format, reason } => {
            ReadError::Decode { path, format, reason: format!("page {number}: {reason}") }
        }
        other => other,
    }
}

/// The crate knows no palettes: a copy of the file that claims to be grey gives the places in the
/// list, and the list of colours is a tag like others.
fn decode_palette(input: &Input<'_>, file: &mut File<'_>) -> Result<Raster, ReadError> {
    let colours = file.find_tag_unsigned_vec(Tag::ColorMap).map_err(|e| input.broken(e))?;
    let colours = colours.ok_or_else(|| input.broken("the palette is missing"))?;
    let bytes =
        palette::as_grey(input.bytes).ok_or_else(|| input.broken("the directory is damaged"))?;
    let grey = Input { bytes: &bytes, ..*input };
    let raster = decode_file(&grey, open(&grey)?)?;
    palette::resolved(&raster, &colours).map_err(|e| input.broken(e))
}

fn open<'a>(input: &Input<'a>) -> Result<File<'a>, ReadError> {
    let file = Decoder::new(Cursor::new(input.bytes)).map_err(|e| input.broken(e))?;
    Ok(file.with_limits(limits(input, 0)))
}

/// What the decoder may allocate for a picture of `bytes` bytes, or for tags only if that is 0.
/// Decoded tags take 32 bytes a number, of which the file has one at least.
fn limits(input: &Input<'_>, bytes: u64) -> Limits {
    let mut limits = Limits::unlimited();
    let length = input.bytes.len();
    limits.ifd_value_size = length.saturating_mul(32);
    limits.decoding_buffer_size =
        length.saturating_mul(32).max(usize::try_from(bytes).unwrap_or(usize::MAX));
    limits.intermediate_buffer_size = length.saturating_mul(EXPANSION as usize);
    limits
}

/// How many of the samples make a pixel, if it is grey or colour, with or without alpha.
fn channels(input: &Input<'_>, file: &mut File<'_>, colour: ColorType) -> Result<usize, ReadError> {
    match colour {
        ColorType::Gray(_) => Ok(1),
        ColorType::GrayA(_) => Ok(2),
        ColorType::RGB(_) => Ok(3),
        ColorType::RGBA(_) => Ok(4),
        ColorType::Multiband { num_samples: 2, .. } if second_is_alpha(file) => Ok(2),
        ColorType::Multiband { num_samples, .. } => Err(input.broken(format!(
            "{num_samples} bands; grey or red-green-blue, with or without alpha, is accepted"
        ))),
        other => Err(input.broken(format!(
            "colours as {other:?}; grey or red-green-blue, with or without alpha, is accepted"
        ))),
    }
}

fn second_is_alpha(file: &mut File<'_>) -> bool {
    let extra = file.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples);
    matches!(extra, Ok(Some(extra)) if matches!(extra[..], [1 | 2]))
}

/// Decodes a page, unpacks samples of less than a byte, and puts the channels of a pixel side by
/// side.
fn read(
    input: &Input<'_>,
    file: &mut File<'_>,
    page: &Page,
) -> Result<(Samples, SampleType), ReadError> {
    let (size, colour) = (page.size.map(|n| n as usize), page.colour);
    let mut result = DecodingResult::U8(Vec::new());
    let layout = file.read_image_to_buffer(&mut result).map_err(|e| input.broken(e))?;
    let (bits, per_pixel) = (colour.bit_depth(), usize::from(colour.num_samples()));
    let (samples, sample) = match (result, bits) {
        (DecodingResult::U8(packed), 1 | 2 | 4) if layout.planes == 1 => {
            let sample = if bits == 1 { SampleType::Bool } else { SampleType::U8 };
            (Samples::U8(unpacked(&packed, size[0] * per_pixel, bits)), sample)
        }
        (result, 8 | 16 | 32 | 64) => typed(result),
        _ => return Err(input.wrong_type(format!("{colour:?}"))),
    };
    if layout.planes == per_pixel && per_pixel > 1 && samples.len() == size[0] * size[1] * per_pixel
    {
        let plane = size[0] * size[1];
        return Ok((samples.reordered(|i| i / per_pixel + plane * (i % per_pixel)), sample));
    }
    Ok((samples, sample))
}

/// Rows of `row` samples of a few bits each, most significant bits first; each row fills bytes.
fn unpacked(packed: &[u8], row: usize, bits: u8) -> Vec<u8> {
    let (in_a_byte, bits) = (8 / usize::from(bits), usize::from(bits));
    let bytes_a_row = row.div_ceil(in_a_byte).max(1);
    let sample = |bytes: &[u8], i: usize| {
        bytes[i / in_a_byte] >> (8 - bits * (i % in_a_byte + 1)) & ((1 << bits) - 1)
    };
    packed
        .chunks_exact(bytes_a_row)
        .flat_map(|bytes| (0..row).map(move |i| sample(bytes, i)))
        .collect()
}

fn typed(result: DecodingResult) -> (Samples, SampleType) {
    match result {
        DecodingResult::U8(v) => (Samples::U8(v), SampleType::U8),
        DecodingResult::U16(v) => (Samples::U16(v), SampleType::U16),
        DecodingResult::U32(v) => (Samples::U32(v), SampleType::U32),
        DecodingResult::U64(v) => (Samples::U64(v), SampleType::U64),
        DecodingResult::I8(v) => (Samples::I8(v), SampleType::I8),
        DecodingResult::I16(v) => (Samples::I16(v), SampleType::I16),
        DecodingResult::I32(v) => (Samples::I32(v), SampleType::I32),
        DecodingResult::I64(v) => (Samples::I64(v), SampleType::I64),
        DecodingResult::F16(v) => {
            (Samples::F32(v.into_iter().map(f32::from).collect()), SampleType::F16)
        }
        DecodingResult::F32(v) => (Samples::F32(v), SampleType::F32),
        DecodingResult::F64(v) => (Samples::F64(v), SampleType::F64),
    }
}

fn white(sample: SampleType, bits: u8) -> Option<f64> {
    match sample {
        SampleType::Bool => Some(1.0),
        SampleType::U8 | SampleType::U16 => Some(f64::from((1_u32 << bits) - 1)),
        _ => None,
    }
}
