//! Blocks of numbers: raw, compressed or as text.

use crate::sample::{SampleType, Samples};
use flate2::bufread::{MultiGzDecoder, ZlibDecoder};
use std::borrow::Cow;
use std::io::{self, Read};

/// Deflate turns one byte into at most this many.
const EXPANSION: u64 = 1032;

/// How a file holds its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Raw,
    Gzip,
    Zlib,
    /// Decimal numbers between white space.
    Text,
}

impl Encoding {
    /// What a file with so many numbers cannot do without.
    pub(super) fn least_bytes(self, numbers: u64, sample: SampleType, skip: u64) -> u64 {
        let bytes = numbers.saturating_mul(sample.bytes() as u64).saturating_add(skip);
        match self {
            Self::Raw => bytes,
            Self::Gzip | Self::Zlib => bytes.div_ceil(EXPANSION),
            Self::Text => numbers.saturating_add(skip),
        }
    }
}

/// The wanted part of a file's numbers.
pub(super) struct Block {
    pub(super) sample: SampleType,
    pub(super) is_big_endian: bool,
    /// The bytes before all numbers.
    pub(super) skip: usize,
    /// The first number.
    pub(super) first: usize,
    /// How many numbers.
    pub(super) length: usize,
}

impl Block {
    /// The numbers or, of each so many, only the one `taken`: (which, of how many).
    pub(super) fn read(
        &self,
        encoding: Encoding,
        data: &[u8],
        taken: Option<(usize, usize)>,
    ) -> Result<Samples, String> {
        if encoding == Encoding::Text {
            return self.read_text(data, taken);
        }
        let item = self.sample.bytes();
        let (first, length) = (self.skip + self.first * item, self.length * item);
        let bytes = match encoding {
            Encoding::Gzip => inflated(MultiGzDecoder::new(data), first, length)?,
            Encoding::Zlib => inflated(ZlibDecoder::new(data), first, length)?,
            _ => data
                .get(first..first + length)
                .map(Cow::Borrowed)
                .ok_or_else(|| ends(data.len().saturating_sub(first), length))?,
        };
        let bytes = match taken {
            None => bytes,
            Some((which, count)) => {
                let groups = bytes.chunks_exact(item * count);
                Cow::Owned(
                    groups.flat_map(|group| &group[item * which..][..item]).copied().collect(),
                )
            }
        };
        samples(&bytes, self.sample, self.is_big_endian)
    }

    fn read_text(&self, data: &[u8], taken: Option<(usize, usize)>) -> Result<Samples, String> {
        let (which, count) = taken.unwrap_or((0, 1));
        let is_gap = |c: &u8| c.is_ascii_whitespace() || *c == b',';
        let data = data.get(self.skip..).unwrap_or_default();
        let words = data.split(is_gap).filter(|word| !word.is_empty());
        let chosen = words.skip(self.first).take(self.length).skip(which).step_by(count);
        let numbers = chosen.map(|word| {
            let text = String::from_utf8_lossy(word);
            text.parse::<f64>().map_err(|_| format!("{text:?} is not a number"))
        });
        let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
        if numbers.len() != self.length / count {
            return Err(ends(numbers.len(), self.length / count));
        }
        Ok(Samples::F64(numbers))
    }
}

fn ends(found: usize, needed: usize) -> String {
    format!("the data end early: {found} of {needed} are there")
}

/// `length` bytes after the first ones. What follows is only checked for damage, and may be missing.
fn inflated(
    mut reader: impl Read,
    first: usize,
    length: usize,
) -> Result<Cow<'static, [u8]>, String> {
    let damaged = |error: io::Error| format!("the compressed data are damaged: {error}");
    io::copy(&mut reader.by_ref().take(first as u64), &mut io::sink()).map_err(damaged)?;
    let mut bytes = Vec::new();
    reader.by_ref().take(length as u64).read_to_end(&mut bytes).map_err(damaged)?;
    if bytes.len() < length {
        return Err(ends(bytes.len(), length));
    }
    // The check sum stands at the end.
    io::copy(&mut reader.take(1), &mut io::sink()).map_err(damaged)?;
    Ok(Cow::Owned(bytes))
}

/// Bytes as numbers of a type.
pub(in crate::decode) fn samples(
    bytes: &[u8],
    sample: SampleType,
    is_big_endian: bool,
) -> Result<Samples, String> {
    macro_rules! numbers {
        ($kind:ident, $number:ty) => {{
            let items = bytes.chunks_exact(size_of::<$number>()).map(|item| {
                let mut array = [0; size_of::<$number>()];
                array.copy_from_slice(item);
                array
            });
            Samples::$kind(if is_big_endian {
                items.map(<$number>::from_be_bytes).collect()
            } else {
                items.map(<$number>::from_le_bytes).collect()
            })
        }};
    }
    Ok(match sample {
        SampleType::U8 => Samples::U8(bytes.to_vec()),
        SampleType::I8 => numbers!(I8, i8),
        SampleType::U16 => numbers!(U16, u16),
        SampleType::I16 => numbers!(I16, i16),
        SampleType::U32 => numbers!(U32, u32),
        SampleType::I32 => numbers!(I32, i32),
        SampleType::U64 => numbers!(U64, u64),
        SampleType::I64 => numbers!(I64, i64),
        SampleType::F32 => numbers!(F32, f32),
        SampleType::F64 => numbers!(F64, f64),
        SampleType::Bool | SampleType::F16 => return Err(format!("samples of type {sample}")),
    })
}
