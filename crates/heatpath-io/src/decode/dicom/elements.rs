//! The data elements of a DICOM file: tags and the bytes of their values.
//!
//! DICOM PS3.5, section 7, and PS3.10, section 7. No length is believed before the file is long
//! enough for it.

use std::collections::HashMap;

/// A group and an element in one number: `0x0028_0010` is (0028,0010).
pub(super) type Tag = u32;

pub(super) const PIXEL_DATA: Tag = 0x7fe0_0010;
const TRANSFER_SYNTAX: Tag = 0x0002_0010;
const ITEM: Tag = 0xfffe_e000;
const ITEM_END: Tag = 0xfffe_e00d;
const SEQUENCE_END: Tag = 0xfffe_e0dd;

/// A length that says: up to the next end mark.
const UNDEFINED: u32 = u32::MAX;

/// Sequences nest this deep at most.
const DEEPEST: usize = 32;

/// Where the mark `DICM` stands.
pub(super) const PREAMBLE: usize = 128;

const IMPLICIT: &str = "1.2.840.10008.1.2";
const DEFLATED: &str = "1.2.840.10008.1.2.1.99";
const BIG_ENDIAN: &str = "1.2.840.10008.1.2.2";

/// Value representations whose length takes four bytes after two that are zero.
const LONG: [&[u8; 2]; 13] =
    [b"OB", b"OD", b"OF", b"OL", b"OV", b"OW", b"SQ", b"SV", b"UC", b"UN", b"UR", b"UT", b"UV"];

/// The elements of a file outside of sequences, up to the pixels.
pub(super) struct Elements<'a> {
    values: HashMap<Tag, &'a [u8]>,
    /// The pixels in pieces, if they are compressed.
    pub(super) fragments: Option<Vec<&'a [u8]>>,
    pub(super) transfer_syntax: String,
    pub(super) is_big_endian: bool,
}

impl<'a> Elements<'a> {
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, String> {
        let start = bytes.get(PREAMBLE + 4..).ok_or("the file is truncated")?;
        let mut meta = Reader { rest: start, is_implicit: false, is_big_endian: false };
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
        let mut reader = Reader {
            rest: meta.rest,
            is_implicit: transfer_syntax == IMPLICIT,
            is_big_endian: transfer_syntax == BIG_ENDIAN,
        };
        let is_big_endian = reader.is_big_endian;
        let fragments = reader.dataset(&mut values)?;
        Ok(Self { values, fragments, transfer_syntax, is_big_endian })
    }

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
        let array = self.get(tag)?.get(..2)?.try_into().ok()?;
        Some(if self.is_big_endian { u16::from_be_bytes(array) } else { u16::from_le_bytes(array) })
    }

    pub(super) fn need_short(&self, tag: Tag) -> Result<u16, String> {
        self.short(tag).ok_or_else(|| format!("{} is missing", name(tag)))
    }
}

/// A tag as standards write it.
fn name(tag: Tag) -> String {
    format!("({:04x},{:04x})", tag >> 16, tag & 0xffff)
}

/// Text without what fills it up.
fn text_of(value: &[u8]) -> String {
    String::from_utf8_lossy(value).trim_matches(['\0', ' ']).to_owned()
}

/// The head of an element.
#[derive(Clone, Copy)]
struct Element {
    tag: Tag,
    /// Whether undefined lengths are those of a sequence in implicit form.
    is_unknown: bool,
    length: u32,
}

struct Reader<'a> {
    rest: &'a [u8],
    is_implicit: bool,
    is_big_endian: bool,
}

impl<'a> Reader<'a> {
    /// Collects the elements; the fragments of the pixels, with which it ends.
    fn dataset(
        &mut self,
        values: &mut HashMap<Tag, &'a [u8]>,
    ) -> Result<Option<Vec<&'a [u8]>>, String> {
        while !self.rest.is_empty() {
            let element = self.element()?;
            match (element.tag, element.length) {
                (PIXEL_DATA, UNDEFINED) => return self.fragments().map(Some),
                (_, UNDEFINED) => self.skip_sequence(element, 0)?,
                (tag, _) => {
                    let value = self.bytes(element)?;
                    values.insert(tag, value);
                    if tag == PIXEL_DATA {
                        return Ok(None);
                    }
                }
            }
        }
        Ok(None)
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8], String> {
        match self.rest.split_at_checked(length) {
            Some((taken, rest)) => {
                self.rest = rest;
                Ok(taken)
            }
            None => Err("the file is truncated".to_owned()),
        }
    }

    fn u16(&mut self) -> Result<u16, String> {
        let bytes = self.take(2)?;
        let array = [bytes[0], bytes[1]];
        Ok(if self.is_big_endian { u16::from_be_bytes(array) } else { u16::from_le_bytes(array) })
    }

    fn u32(&mut self) -> Result<u32, String> {
        let (a, b) = (u32::from(self.u16()?), u32::from(self.u16()?));
        Ok(if self.is_big_endian { a << 16 | b } else { b << 16 | a })
    }

    fn element(&mut self) -> Result<Element, String> {
        let tag = u32::from(self.u16()?) << 16 | u32::from(self.u16()?);
        if self.is_implicit || tag >> 16 == ITEM >> 16 {
            return Ok(Element { tag, is_unknown: false, length: self.u32()? });
        }
        let kind = self.take(2)?;
        if !kind.iter().all(u8::is_ascii_uppercase) {
            return Err(format!("{} has no value representation", name(tag)));
        }
        let is_long = LONG.iter().any(|long| *long == kind);
        let length = if is_long {
            self.take(2)?;
            self.u32()?
        } else {
            u32::from(self.u16()?)
        };
        Ok(Element { tag, is_unknown: kind == b"UN", length })
    }

    fn bytes(&mut self, element: Element) -> Result<&'a [u8], String> {
        let (tag, found) = (name(element.tag), self.rest.len());
        self.take(element.length as usize).map_err(|_| {
            format!(
                "the file is truncated: {tag} has {} bytes, but {found} are left",
                element.length
            )
        })
    }

    /// Passes the items of a sequence of undefined length.
    fn skip_sequence(&mut self, sequence: Element, depth: usize) -> Result<(), String> {
        if depth > DEEPEST {
            return Err("sequences are nested too deep".to_owned());
        }
        let is_implicit = self.is_implicit;
        self.is_implicit |= sequence.is_unknown;
        loop {
            let item = self.element()?;
            match (item.tag, item.length) {
                (SEQUENCE_END, _) => break,
                (ITEM, UNDEFINED) => self.skip_item(depth)?,
                (ITEM, _) => drop(self.bytes(item)?),
                (tag, _) => return Err(format!("{} stands between items", name(tag))),
            }
        }
        self.is_implicit = is_implicit;
        Ok(())
    }

    fn skip_item(&mut self, depth: usize) -> Result<(), String> {
        loop {
            let element = self.element()?;
            match (element.tag, element.length) {
                (ITEM_END, _) => return Ok(()),
                (_, UNDEFINED) => self.skip_sequence(element, depth + 1)?,
                _ => drop(self.bytes(element)?),
            }
        }
    }

    /// The pieces of compressed pixels, without the table of offsets before them.
    fn fragments(&mut self) -> Result<Vec<&'a [u8]>, String> {
        let mut fragments = Vec::new();
        loop {
            let item = self.element()?;
            match item.tag {
                SEQUENCE_END => break,
                ITEM => fragments.push(self.bytes(item)?),
                tag => return Err(format!("{} stands between pieces of pixels", name(tag))),
            }
        }
        if fragments.is_empty() {
            return Err("the pixels have no pieces".to_owned());
        }
        fragments.remove(0);
        Ok(fragments)
    }
}
