//! Small valid files of every format, made in memory.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]
#![allow(dead_code, reason = "each test program uses a part of this")]

pub(crate) mod codecs;
pub(crate) mod dicom;
pub(crate) mod volumes;

use heatpath_core::grid::{Grid, Mask};
use heatpath_io::{ImageFile, Info, PictureOptions, ReadError};
use image::{ExtendedColorType, ImageEncoder};
use std::io::Cursor;
use tiff::encoder::{Compression, TiffEncoder, colortype};

/// Bytes as a picture or volume, as a field, as a mask.
pub(crate) fn picture<const D: usize>(
    bytes: &[u8],
    name: &str,
    options: &PictureOptions<D>,
) -> Result<Grid<f64, D>, ReadError> {
    ImageFile::from_bytes(bytes, name)?.into_picture(options)
}

pub(crate) fn field<const D: usize>(bytes: &[u8], name: &str) -> Result<Grid<f64, D>, ReadError> {
    ImageFile::from_bytes(bytes, name)?.into_field([1.0; D])
}

pub(crate) fn mask<const D: usize>(bytes: &[u8], name: &str) -> Result<Mask<D>, ReadError> {
    ImageFile::from_bytes(bytes, name)?.into_mask([1.0; D])
}

pub(crate) fn info(bytes: &[u8], name: &str) -> Result<Info, ReadError> {
    Ok(ImageFile::from_bytes(bytes, name)?.info())
}

/// A PNG of one of the colour types of the `image` crate.
pub(crate) fn png(bytes: &[u8], size: [u32; 2], kind: ExtendedColorType) -> Vec<u8> {
    let mut out = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut out);
    encoder.write_image(bytes, size[0], size[1], kind).unwrap();
    out
}

/// A JPEG of high quality.
pub(crate) fn jpeg(bytes: &[u8], size: [u32; 2], kind: ExtendedColorType) -> Vec<u8> {
    let mut out = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut out, 100);
    encoder.write_image(bytes, size[0], size[1], kind).unwrap();
    out
}

/// A TIFF with the given pages, all of one type and size.
pub(crate) fn tiff<C: colortype::ColorType>(
    size: [u32; 2],
    pages: &[&[C::Inner]],
    compression: Compression,
) -> Vec<u8>
where
    [C::Inner]: tiff::encoder::TiffValue,
{
    let mut out = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut out).unwrap().with_compression(compression);
    for page in pages {
        encoder.write_image::<C>(size[0], size[1], page).unwrap();
    }
    out.into_inner()
}

/// An entry of a TIFF directory: tag, type (3 for 16, 4 for 32 bits), count, value.
pub(crate) type Entry = (u16, u16, u32, u32);

/// A big-endian TIFF by hand, of one strip of raw samples, for what the encoder cannot do.
pub(crate) fn raw_tiff(size: [u32; 2], data: &[u8], entries: &[Entry], more: &[u8]) -> Vec<u8> {
    let mut entries = entries.to_vec();
    entries.extend([(256, 4, 1, size[0]), (257, 4, 1, size[1]), (273, 4, 1, 8)]);
    entries.extend([(278, 4, 1, size[1]), (279, 4, 1, data.len() as u32)]);
    entries.sort_unstable();
    let mut out = b"MM\0\x2a".to_vec();
    out.extend(((8 + data.len() + more.len()) as u32).to_be_bytes());
    out.extend([data, more].concat());
    out.extend((entries.len() as u16).to_be_bytes());
    for (tag, kind, count, value) in entries {
        out.extend([tag.to_be_bytes(), kind.to_be_bytes()].concat());
        out.extend(count.to_be_bytes());
        match (kind, count) {
            (3, 1) => out.extend([(value as u16).to_be_bytes(), [0, 0]].concat()),
            _ => out.extend(value.to_be_bytes()),
        }
    }
    out.extend([0; 4]);
    out
}

/// A 2-bit palette TIFF: black, red, grey of 16 bits, white.
pub(crate) fn palette_tiff() -> Vec<u8> {
    let colours: [u16; 12] =
        [0, 0xffff, 0x1234, 0xffff, 0, 0, 0x1234, 0xffff, 0, 0, 0x1234, 0xffff];
    let more: Vec<u8> = colours.iter().flat_map(|c| c.to_be_bytes()).collect();
    let entries =
        [(258, 3, 1, 2), (259, 3, 1, 1), (262, 3, 1, 3), (277, 3, 1, 1), (320, 3, 12, 10)];
    raw_tiff([3, 2], &[0b0001_1000, 0b1111_0100], &entries, &more)
}

/// An NPY file with the given header and data.
pub(crate) fn npy(descr: &str, fortran: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let fortran = if fortran { "True" } else { "False" };
    let text = format!("{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, }}\n");
    let mut out = b"\x93NUMPY\x01\0".to_vec();
    out.extend((text.len() as u16).to_le_bytes());
    out.extend(text.as_bytes());
    out.extend(data);
    out
}

/// A small valid file of every format and many types, with a name each.
pub(crate) fn zoo() -> Vec<(&'static str, Vec<u8>)> {
    let ramp: Vec<u8> = (0..60).map(|i| i * 4).collect();
    let floats = [0.0_f32, -1.5, 2.25, 1e9, 3.0, 4.0];
    let mut zoo = vec![
        ("png l8", png(&ramp[..20], [5, 4], ExtendedColorType::L8)),
        ("png la8", png(&ramp[..40], [5, 4], ExtendedColorType::La8)),
        ("png rgb16", png(&ramp[..36], [3, 2], ExtendedColorType::Rgb16)),
        ("jpeg grey", jpeg(&ramp[..20], [5, 4], ExtendedColorType::L8)),
        ("jpeg colour", jpeg(&ramp, [5, 4], ExtendedColorType::Rgb8)),
        ("tiff raw", tiff::<colortype::Gray8>([5, 4], &[&ramp[..20]], Compression::Uncompressed)),
        ("tiff lzw", tiff::<colortype::RGB8>([5, 4], &[&ramp], Compression::Lzw)),
        ("tiff float", tiff::<colortype::Gray32Float>([3, 2], &[&floats], Compression::Packbits)),
        (
            "tiff pages",
            tiff::<colortype::Gray8>(
                [5, 2],
                &[&ramp[..10], &ramp[10..20]],
                Compression::Deflate(Default::default()),
            ),
        ),
        ("tiff palette", palette_tiff()),
        ("pbm text", b"P1\n# ink\n3 2\n1 0 1\n0 1 0\n".to_vec()),
        ("pgm text", b"P2\n3 2\n15\n0 1 2\n3 4 15\n".to_vec()),
        ("ppm text", b"P3\n1 2\n255\n255 0 0\n0 0 255\n".to_vec()),
        ("pbm", b"P4\n3 2\n\xa0\x40".to_vec()),
        ("pgm", b"P5\n3 2\n255\nabcdef".to_vec()),
        ("ppm", b"P6\n1 2\n255\nabcdef".to_vec()),
        ("npy", npy("'|u1'", false, "(2, 3)", &ramp[..6])),
        ("npy colour", npy("'<u2'", false, "(1, 2, 3)", &ramp[..12])),
        ("npy volume", npy("'<u2'", true, "(2, 3, 2)", &ramp[..24])),
    ];
    zoo.extend(volumes::zoo());
    zoo
}
