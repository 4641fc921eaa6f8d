//! The bytes of a DICOM file as data elements, one after another.
//!
//! DICOM PS3.5, section 7. No length is believed before the file is long enough for it.

use super::elements::{PIXEL_DATA, Tag, name};
use std::collections::HashMap;

const ITEM: Tag = 0xfffe_e000;
const ITEM_END: Tag = 0xfffe_e00d;
const SEQUENCE_END: Tag = 0xfffe_e0dd;

/// The bytes of the mark at the end of a sequence or an item.
const MARK: usize = 8;

/// A length that says: up to the next end mark.
const UNDEFINED: u32 = u32::MAX;

/// Sequences nest this deep at most.
const DEEPEST: usize = 32;

/// Value representations whose length takes four bytes after two that are zero.
const LONG: [&[u8; 2]; 13] =
    [b"OB", b"OD", b"OF", b"OL", b"OV", b"OW", b"SQ", b"SV", b"UC", b"UN", b"UR", b"UT", b"UV"];

/// How elements are written.
#[derive(Clone, Copy)]
pub(super) struct Encoding {
    /// Whether value representations are left out.
    pub(super) is_implicit: bool,
    pub(super) is_big_endian: bool,
}

/// The head of an element.
#[derive(Clone, Copy)]
pub(super) struct Element {
    pub(super) tag: Tag,
    /// Whether undefined lengths are those of a sequence in implicit form.
    is_unknown: bool,
    length: u32,
}

pub(super) struct Reader<'a> {
    pub(super) rest: &'a [u8],
    pub(super) encoding: Encoding,
}

impl<'a> Reader<'a> {
    /// Collects the elements; the fragments of the pixels, with which it ends.
    pub(super) fn dataset(
        &mut self,
        values: &mut HashMap<Tag, &'a [u8]>,
    ) -> Result<Option<Vec<&'a [u8]>>, String> {
        while !self.rest.is_empty() {
            let element = self.element()?;
            if (element.tag, element.length) == (PIXEL_DATA, UNDEFINED) {
                return self.fragments().map(Some);
            }
            let value = self.value(element, 0)?;
            // Items of an unknown kind are not written as those around them.
            if !(element.is_unknown && element.length == UNDEFINED) {
                values.insert(element.tag, value);
            }
            if element.tag == PIXEL_DATA {
                break;
            }
        }
        Ok(None)
    }

    /// The data elements of each item, of which this reads all.
    pub(super) fn items(mut self) -> Result<Vec<&'a [u8]>, String> {
        let mut items = Vec::new();
        while !self.rest.is_empty() {
            items.push(self.item(0)?.ok_or("a sequence ends before its length")?);
        }
        Ok(items)
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
        Ok(if self.encoding.is_big_endian {
            u16::from_be_bytes(array)
        } else {
            u16::from_le_bytes(array)
        })
    }

    fn u32(&mut self) -> Result<u32, String> {
        let (a, b) = (u32::from(self.u16()?), u32::from(self.u16()?));
        Ok(if self.encoding.is_big_endian { a << 16 | b } else { b << 16 | a })
    }

    pub(super) fn element(&mut self) -> Result<Element, String> {
        let tag = u32::from(self.u16()?) << 16 | u32::from(self.u16()?);
        if self.encoding.is_implicit || tag >> 16 == ITEM >> 16 {
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

    pub(super) fn bytes(&mut self, element: Element) -> Result<&'a [u8], String> {
        let (tag, found) = (name(element.tag), self.rest.len());
        self.take(element.length as usize).map_err(|_| {
            format!(
                "the file is truncated: {tag} has {} bytes, but {found} are left",
                element.length
            )
        })
    }

    /// The bytes of a value; of a sequence those of its items.
    fn value(&mut self, element: Element, depth: usize) -> Result<&'a [u8], String> {
        if element.length != UNDEFINED {
            return self.bytes(element);
        }
        if depth >= DEEPEST {
            return Err(format!(
                "sequences are nested {} deep; at most {DEEPEST} are accepted",
                depth + 1
            ));
        }
        let (outer, start) = (self.encoding, self.rest);
        self.encoding.is_implicit |= element.is_unknown;
        while self.item(depth)?.is_some() {}
        self.encoding = outer;
        Ok(&start[..start.len() - self.rest.len() - MARK])
    }

    /// The elements of the next item; none at the end of a sequence.
    fn item(&mut self, depth: usize) -> Result<Option<&'a [u8]>, String> {
        let item = self.element()?;
        match (item.tag, item.length) {
            (SEQUENCE_END, _) => return Ok(None),
            (ITEM, UNDEFINED) => {}
            (ITEM, _) => return self.bytes(item).map(Some),
            (tag, _) => return Err(format!("{} stands between items", name(tag))),
        }
        let start = self.rest;
        loop {
            let element = self.element()?;
            if element.tag == ITEM_END {
                return Ok(Some(&start[..start.len() - self.rest.len() - MARK]));
            }
            self.value(element, depth + 1)?;
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
