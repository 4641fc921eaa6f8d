//! Small medical volumes, made in memory.

use super::codecs::{JPEG_2000, JPEG_LS};
use super::dicom::{Dicom, frames};
use flate2::Compression;
use flate2::write::{GzEncoder, ZlibEncoder};
use heatpath_io::ImageFile;
use std::io::Write;

/// The one line that explains why bytes are no volume.
pub(crate) fn text_error(bytes: &[u8]) -> String {
    let text = ImageFile::from_bytes(bytes, "odd.file").unwrap_err().to_string();
    assert!(text.starts_with("odd.file: ") && !text.contains(char::is_control), "{text}");
    text
}

pub(crate) fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

pub(crate) fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// A raw NRRD of 3 x 2 x 2 bytes with further fields.
pub(crate) fn nrrd(fields: &str) -> Vec<u8> {
    let head = format!("NRRD0004\n{fields}\ndimension: 3\nsizes: 3 2 2\nencoding: raw\n\n");
    [head.as_bytes(), b"abcdefghijkl"].concat()
}

/// A `MetaImage` of 3 x 2 x 2 with further fields, one a line.
pub(crate) fn meta_image(fields: &str, data: &[u8]) -> Vec<u8> {
    let head = format!("ObjectType = Image\nNDims = 3\nDimSize = 3 2 2\n{fields}");
    [head.as_bytes(), b"ElementDataFile = LOCAL\n", data].concat()
}

/// A `NIfTI` file by hand, of 12 numbers of 16 bits from 0 on.
#[derive(Clone)]
pub(crate) struct Nifti {
    pub(crate) size: Vec<u64>,
    pub(crate) is_second: bool,
    pub(crate) is_big_endian: bool,
    pub(crate) kind: i16,
    pub(crate) scale: [f64; 2],
    pub(crate) unit: u8,
    pub(crate) handed: f64,
    /// b, c, d of the quaternion and the origin.
    pub(crate) qform: Option<[f64; 6]>,
    pub(crate) sform: Option<[[f64; 4]; 3]>,
    pub(crate) magic: &'static [u8; 4],
    /// Where the numbers are said to begin after the header; 0 if in another file.
    pub(crate) offset: u16,
}

impl Default for Nifti {
    fn default() -> Self {
        Self {
            size: vec![3, 2, 2],
            is_second: false,
            is_big_endian: false,
            kind: 4,
            scale: [1.0, 0.0],
            unit: 2,
            handed: 1.0,
            qform: None,
            sform: None,
            magic: b"n+1\0",
            offset: 4,
        }
    }
}

impl Nifti {
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut out = vec![0; if self.is_second { 544 } else { 352 }];
        let at = |first: usize, second: usize| if self.is_second { second } else { first };
        self.put(&mut out, 0, &i32::to_le_bytes(at(348, 540) as i32));
        self.dim(&mut out, 0, self.size.len() as u64);
        self.size.iter().enumerate().for_each(|(i, &n)| self.dim(&mut out, i + 1, n));
        self.put(&mut out, at(70, 12), &self.kind.to_le_bytes());
        let end = at(348, 540) as i64;
        let offset = if self.offset == 0 { 0 } else { end + i64::from(self.offset) };
        for (i, spacing) in [self.handed, 1.0, 2.0, 4.0].into_iter().enumerate() {
            self.float(&mut out, at(76, 104), i, spacing);
        }
        match self.is_second {
            true => self.put(&mut out, 168, &offset.to_le_bytes()),
            false => self.float(&mut out, 108, 0, offset as f64),
        }
        for (i, value) in self.scale.into_iter().enumerate() {
            self.float(&mut out, at(112, 176), i, value);
        }
        match self.is_second {
            true => self.put(&mut out, 500, &i32::from(self.unit).to_le_bytes()),
            false => out[123] = self.unit,
        }
        for (i, is_given) in [self.qform.is_some(), self.sform.is_some()].into_iter().enumerate() {
            match self.is_second {
                true => self.put(&mut out, 344 + 4 * i, &i32::from(is_given).to_le_bytes()),
                false => self.put(&mut out, 252 + 2 * i, &i16::from(is_given).to_le_bytes()),
            }
        }
        for (i, value) in self.qform.iter().flatten().enumerate() {
            self.float(&mut out, at(256, 352), i, *value);
        }
        for (i, value) in self.sform.iter().flatten().flatten().enumerate() {
            self.float(&mut out, at(280, 400), i, *value);
        }
        out[at(344, 4)..][..4].copy_from_slice(self.magic);
        (0..12_i16).for_each(|n| {
            let end = out.len();
            out.extend([0; 2]);
            self.put(&mut out, end, &n.to_le_bytes());
        });
        out
    }

    fn put(&self, out: &mut [u8], at: usize, little: &[u8]) {
        let mut bytes = little.to_vec();
        if self.is_big_endian {
            bytes.reverse();
        }
        out[at..at + bytes.len()].copy_from_slice(&bytes);
    }

    fn dim(&self, out: &mut [u8], index: usize, size: u64) {
        match self.is_second {
            true => self.put(out, 16 + 8 * index, &size.to_le_bytes()),
            false => self.put(out, 40 + 2 * index, &(size as u16).to_le_bytes()),
        }
    }

    fn float(&self, out: &mut [u8], at: usize, index: usize, value: f64) {
        match self.is_second {
            true => self.put(out, at + 8 * index, &value.to_le_bytes()),
            false => self.put(out, at + 4 * index, &(value as f32).to_le_bytes()),
        }
    }
}

/// A small valid file of every format and compression, with a name each.
pub(crate) fn zoo() -> Vec<(&'static str, Vec<u8>)> {
    let place = "space: RAS\nspace directions: (0,1,0) (2,0,0) (0,0,3)\nspace origin: (1,2,3)";
    let meta = "ElementType = MET_UCHAR\nOffset = 1 2 3\nElementSpacing = 1 2 3\n";
    let rows = [[0.0, 3.0, 0.0, 10.0], [2.0, 0.0, 0.0, 20.0], [0.0, 0.0, 4.0, 30.0]];
    let nifti = Nifti { sform: Some(rows), ..Nifti::default() };
    let second =
        Nifti { is_second: true, qform: Some([0.1, 0.2, 0.3, 1.0, 2.0, 3.0]), ..Nifti::default() };
    let jpeg = super::jpeg(&[77; 6], [3, 2], image::ExtendedColorType::L8);
    let mut rle = [&[2, 0, 0, 0, 64, 0, 0, 0, 66][..], &[0; 55]].concat();
    rle.extend([251, 0, 5, 0, 1, 2, 3, 4, 5]);
    let dicom = |syntax, bits: u16, pixels| Dicom {
        syntax,
        bits: [bits; 2],
        pixels: vec![pixels],
        ..Dicom::default()
    };
    let whole =
        |syntax, frame: &[u8]| Dicom { size: [32, 32], ..dicom(syntax, 16, frame.to_vec()) };
    vec![
        ("nrrd", nrrd("type: uint8")),
        ("nrrd placed", nrrd(&format!("type: uint8\n{place}"))),
        ("mha", meta_image(meta, b"abcdefghijkl")),
        (
            "mha compressed",
            meta_image(&format!("{meta}CompressedData = True\n"), &zlib(b"abcdefghijkl")),
        ),
        ("nifti", nifti.bytes()),
        ("nifti-2", second.bytes()),
        ("nifti gzipped", gzip(&nifti.bytes())),
        ("dicom", Dicom::default().bytes()),
        ("dicom implicit", Dicom { syntax: "1.2.840.10008.1.2", ..Dicom::default() }.bytes()),
        ("dicom rle", dicom("1.2.840.10008.1.2.5", 16, rle).bytes()),
        ("dicom jpeg", dicom("1.2.840.10008.1.2.4.50", 8, jpeg).bytes()),
        ("dicom jpeg-ls", whole("1.2.840.10008.1.2.4.80", JPEG_LS).bytes()),
        ("dicom jpeg 2000", whole("1.2.840.10008.1.2.4.90", JPEG_2000).bytes()),
        ("dicom frames", frames(&[1.0, 2.0, 3.0]).bytes()),
    ]
}
