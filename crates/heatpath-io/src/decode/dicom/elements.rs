//! The data elements of a DICOM file: tags and the bytes of their values.
//!
//! DICOM PS3.10, section 7.

use super::reader::{Encoding, Reader};
use std::collections::HashMap;

/// A group and an element in one number: `0x0028_0010` is (0028,0010).
pub(super) type Tag = u32;

pub(super) const PIXEL_DATA: Tag = 0x7fe0_0010;
const TRANSFER_SYNTAX: Tag = 0x0002_0010;

/// Where the mark `DICM` stands.
pub(super) const PREAMBLE: usize = 128;

const IMPLICIT: &str = "1.2.840.10008.1.2";
const DEFLATED: &str = "1.2.840.10008.1.2.1.99";
const BIG_ENDIAN: &str = "1.2.840.10008.1.2.2";

/// What a file says of its pixels, and the pixels.
pub(super) struct Elements<'a> {
    /// The elements outside of sequences, up to the pixels.
    pub(super) data: DataSet<'a>,
    /// The pixels in pieces, if they are compressed.
    pub(super) fragments: Option<Vec<&'a [u8]>>,
    pub(super) transfer_syntax: String,
}

impl<'a> Elements<'a> {
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, String> {
        let start = bytes.get(PREAMBLE + 4..).ok_or("the file is truncated")?;
        let plain = Encoding { is_implicit: false, is_big_endian: false };
        let mut meta = Reader { rest: start, encoding: plain };
        let mut values = HashMap::new();
        while meta.rest.starts_with(&[2, 0]) {
            let element = meta.element()?;
            values.insert(element.tag, meta.bytes(element)?);
        }
        let transfer_syntax = values.get(&TRANSFER_SYNTAX).map(|value| text_of(value));
        let transfer_syntax = transfer_syntax.ok_or("no transfer syntax (0002,0010)")?;
        if transfer_syntax == DEFLATED {
            return Err("the file is deflated as a whole, which is not supported".to_owned());
        }
        let encoding = Encoding {
            is_implicit: transfer_syntax == IMPLICIT,
            is_big_endian: transfer_syntax == BIG_ENDIAN,
        };
        let fragments = Reader { rest: meta.rest, encoding }.dataset(&mut values)?;
        Ok(Self { data: DataSet { values, encoding }, fragments, transfer_syntax })
    }
}

/// Elements by their tags: of a file, or of an item of a sequence.
pub(super) struct DataSet<'a> {
    values: HashMap<Tag, &'a [u8]>,
    pub(super) encoding: Encoding,
}

impl<'a> DataSet<'a> {
    pub(super) fn get(&self, tag: Tag) -> Option<&'a [u8]> {
        self.values.get(&tag).copied()
    }

    /// A value of text.
    pub(super) fn text(&self, tag: Tag) -> Option<String> {
        self.get(tag).map(text_of)
    }

    /// The decimal numbers of a text, if there are any.
    pub(super) fn numbers(&self, tag: Tag) -> Result<Option<Vec<f64>>, String> {
        let Some(text) = self.text(tag).filter(|text| !text.is_empty()) else { return Ok(None) };
        let parsed = text.split('\\').map(|word| word.trim().parse());
        let parsed: Result<Vec<f64>, _> = parsed.collect();
        parsed.map(Some).map_err(|_| format!("{} is {text:?}, no number", name(tag)))
    }

    /// As many decimal numbers.
    pub(super) fn array<const N: usize>(&self, tag: Tag) -> Result<Option<[f64; N]>, String> {
        let Some(numbers) = self.numbers(tag)? else { return Ok(None) };
        let found = numbers.len();
        let array = <[f64; N]>::try_from(numbers);
        array.map(Some).map_err(|_| format!("{} has {found} numbers, not {N}", name(tag)))
    }

    /// A number of 16 bits.
    pub(super) fn short(&self, tag: Tag) -> Option<u16> {
        self.shorts(tag).next()
    }

    /// The numbers of 16 bits of a value.
    pub(super) fn shorts(&self, tag: Tag) -> impl Iterator<Item = u16> {
        let number = match self.encoding.is_big_endian {
            true => u16::from_be_bytes,
            false => u16::from_le_bytes,
        };
        let pairs = self.get(tag).unwrap_or_default().chunks_exact(2);
        pairs.map(move |pair| number([pair[0], pair[1]]))
    }

    pub(super) fn need_short(&self, tag: Tag) -> Result<u16, String> {
        self.short(tag).ok_or_else(|| format!("{} is missing", name(tag)))
    }

    /// The items of a sequence; none if there is no such sequence.
    pub(super) fn items(&self, tag: Tag) -> Result<Vec<Self>, String> {
        let encoding = self.encoding;
        let rest = self.get(tag).unwrap_or_default();
        let items = Reader { rest, encoding }.items()?;
        let set = |rest| {
            let mut values = HashMap::new();
            Reader { rest, encoding }.dataset(&mut values)?;
            Ok(Self { values, encoding })
        };
        items.into_iter().map(set).collect()
    }
}

/// A tag as standards write it.
pub(super) fn name(tag: Tag) -> String {
    format!("({:04x},{:04x})", tag >> 16, tag & 0xffff)
}

/// Text without what fills it up.
fn text_of(value: &[u8]) -> String {
    String::from_utf8_lossy(value).trim_matches(['\0', ' ']).to_owned()
}
