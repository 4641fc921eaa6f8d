//! The arrays of VTK's XML files.

use super::cursor::{Cursor, Kind, Order, truncated};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read;

/// No stream of zlib grows by more than this factor.
const MOST_GROWTH: usize = 1032;

/// How a file writes its arrays, and the piece that all of them share.
pub(super) struct Storage<'a> {
    pub(super) order: Order,
    /// The type of the numbers of bytes that stand before data.
    pub(super) header: Kind,
    pub(super) is_compressed: bool,
    pub(super) appended: &'a [u8],
    pub(super) appended_is_base64: bool,
    /// How many bytes all arrays together may still have.
    pub(super) budget: usize,
}

/// An array as its tag describes it.
#[derive(Clone, Debug, Default)]
pub(super) struct DataArray {
    pub(super) name: String,
    pub(super) kind: String,
    pub(super) components: usize,
    pub(super) format: String,
    pub(super) offset: usize,
    pub(super) text: Vec<u8>,
}

impl<'a> Storage<'a> {
    pub(super) fn new(length: usize) -> Self {
        Self {
            order: Order::Little,
            header: Kind::U32,
            is_compressed: false,
            appended: &[],
            appended_is_base64: false,
            budget: length.saturating_mul(MOST_GROWTH),
        }
    }

    /// The numbers of an array.
    pub(super) fn numbers(&mut self, array: &DataArray) -> Result<Vec<f64>, String> {
        let kind = kind(&array.kind)?;
        let bytes = match &array.format[..] {
            "binary" => self.decoded(&array.text, true)?,
            "appended" => {
                let data = self.appended.get(array.offset..).ok_or_else(truncated)?;
                self.decoded(data, self.appended_is_base64)?
            }
            _ => {
                let (mut cursor, mut numbers) = (Cursor::new(&array.text), Vec::new());
                while !cursor.rest().trim_ascii_start().is_empty() {
                    numbers.push(cursor.number()?);
                }
                return Ok(numbers);
            }
        };
        Ok(bytes.chunks_exact(kind.size()).map(|bytes| kind.decode(bytes, self.order)).collect())
    }

    /// The bytes of an array, without header and compression.
    fn decoded(&mut self, data: &[u8], is_base64: bool) -> Result<Vec<u8>, String> {
        let bytes = if self.is_compressed {
            self.inflated(data, is_base64)?
        } else {
            let mut stream = Stream { data, is_base64 };
            // Base64 is one piece: header and data.
            let size = self.header.size();
            let [length] = self.counts(&stream.clone().take(size)?)[..] else {
                return Err(truncated());
            };
            self.spend(length)?;
            stream.take(size.saturating_add(length))?.split_off(size)
        };
        Ok(bytes)
    }

    /// Blocks of zlib: their number, their size, that of the last one (0 if it is the same), and
    /// the compressed size of each.
    fn inflated(&mut self, data: &[u8], is_base64: bool) -> Result<Vec<u8>, String> {
        let (mut stream, size) = (Stream { data, is_base64 }, self.header.size());
        let head = stream.clone().take(3 * size)?;
        let [blocks, block, last] = self.counts(&head)[..] else { return Err(truncated()) };
        let head = stream.take(blocks.saturating_add(3).saturating_mul(size))?;
        let packed_sizes = &self.counts(&head)[3..];
        let total = packed_sizes.iter().fold(0_usize, |sum, &size| sum.saturating_add(size));
        let packed = stream.take(total)?;
        let (mut packed, mut bytes) = (Cursor::new(&packed), Vec::new());
        for (number, &size) in packed_sizes.iter().enumerate() {
            let length = if number + 1 == blocks && last > 0 { last } else { block };
            self.spend(length)?;
            let start = bytes.len();
            let mut decoder = ZlibDecoder::new(packed.take(size)?).take(length as u64);
            decoder.read_to_end(&mut bytes).map_err(|error| format!("zlib: {error}"))?;
            if bytes.len() - start < length {
                return Err(truncated());
            }
        }
        Ok(bytes)
    }

    fn counts(&self, bytes: &[u8]) -> Vec<usize> {
        let numbers = bytes.chunks_exact(self.header.size());
        numbers.map(|bytes| self.header.decode(bytes, self.order) as usize).collect()
    }

    fn spend(&mut self, bytes: usize) -> Result<(), String> {
        self.budget =
            self.budget.checked_sub(bytes).ok_or("its arrays are larger than it can hold")?;
        Ok(())
    }
}

/// Bytes as they are, or as base64 in pieces.
#[derive(Clone)]
struct Stream<'a> {
    data: &'a [u8],
    is_base64: bool,
}

impl Stream<'_> {
    /// The next piece, of so many bytes.
    fn take(&mut self, length: usize) -> Result<Vec<u8>, String> {
        if !self.is_base64 {
            let (taken, rest) = self.data.split_at_checked(length).ok_or_else(truncated)?;
            self.data = rest;
            return Ok(taken.to_vec());
        }
        self.data = self.data.trim_ascii_start();
        let coded = length.div_ceil(3).saturating_mul(4);
        let (taken, rest) = self.data.split_at_checked(coded).ok_or_else(truncated)?;
        self.data = rest;
        let mut bytes = STANDARD.decode(taken).map_err(|error| format!("base64: {error}"))?;
        bytes.truncate(length);
        if bytes.len() < length { Err(truncated()) } else { Ok(bytes) }
    }
}

fn kind(name: &str) -> Result<Kind, String> {
    Ok(match name {
        "Int8" => Kind::I8,
        "UInt8" => Kind::U8,
        "Int16" => Kind::I16,
        "UInt16" => Kind::U16,
        "Int32" => Kind::I32,
        "UInt32" => Kind::U32,
        "Int64" => Kind::I64,
        "UInt64" => Kind::U64,
        "Float32" => Kind::F32,
        "Float64" => Kind::F64,
        _ => return Err(format!("has an array of type {name:?}")),
    })
}
