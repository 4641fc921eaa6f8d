//! The types of numbers that picture files hold.

use serde::{Serialize, Serializer};
use std::fmt;

/// The type of a file's samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SampleType {
    /// One bit or a truth value: 0 or 1.
    Bool,
    /// Unsigned, 8 bits; also the 2 and 4 bit samples of PNG and TIFF.
    U8,
    /// Unsigned, 16 bits.
    U16,
    /// Unsigned, 32 bits.
    U32,
    /// Unsigned, 64 bits; beyond 2^53 values are rounded when read.
    U64,
    /// Signed, 8 bits.
    I8,
    /// Signed, 16 bits.
    I16,
    /// Signed, 32 bits.
    I32,
    /// Signed, 64 bits; beyond 2^53 values are rounded when read.
    I64,
    /// Floating point, 16 bits (TIFF only).
    F16,
    /// Floating point, 32 bits.
    F32,
    /// Floating point, 64 bits.
    F64,
}

impl SampleType {
    /// The name as in numpy: `bool`, `uint8`, `float32`, ...
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bool => "bool",
            Self::U8 => "uint8",
            Self::U16 => "uint16",
            Self::U32 => "uint32",
            Self::U64 => "uint64",
            Self::I8 => "int8",
            Self::I16 => "int16",
            Self::I32 => "int32",
            Self::I64 => "int64",
            Self::F16 => "float16",
            Self::F32 => "float32",
            Self::F64 => "float64",
        }
    }

    /// The bytes of one sample.
    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::Bool | Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 | Self::F16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    /// The largest value of small unsigned types.
    pub(crate) fn white(self) -> Option<f64> {
        match self {
            Self::Bool => Some(1.0),
            Self::U8 => Some(f64::from(u8::MAX)),
            Self::U16 => Some(f64::from(u16::MAX)),
            _ => None,
        }
    }
}

impl fmt::Display for SampleType {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}

impl Serialize for SampleType {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// The samples of a decoded file in the type in which they were stored.
#[derive(Clone, Debug)]
pub(crate) enum Samples {
    U8(Vec<u8>),
    U16(Vec<u16>),
    U32(Vec<u32>),
    U64(Vec<u64>),
    I8(Vec<i8>),
    I16(Vec<i16>),
    I32(Vec<i32>),
    I64(Vec<i64>),
    F32(Vec<f32>),
    F64(Vec<f64>),
}

/// Evaluates `$body` for the vector inside, whatever its type.
macro_rules! with_vector {
    ($samples:expr, $vector:ident => $body:expr) => {
        match $samples {
            Samples::U8($vector) => $body,
            Samples::U16($vector) => $body,
            Samples::U32($vector) => $body,
            Samples::U64($vector) => $body,
            Samples::I8($vector) => $body,
            Samples::I16($vector) => $body,
            Samples::I32($vector) => $body,
            Samples::I64($vector) => $body,
            Samples::F32($vector) => $body,
            Samples::F64($vector) => $body,
        }
    };
}

impl Samples {
    /// How many samples there are.
    pub(crate) fn len(&self) -> usize {
        with_vector!(self, vector => vector.len())
    }

    /// The samples at the given positions, as numbers.
    pub(crate) fn values(&self, positions: impl Iterator<Item = usize>) -> Vec<f64> {
        with_vector!(self, vector => positions.map(|i| as_number(vector[i])).collect())
    }

    /// Calls `visit` with each sample and its position.
    pub(crate) fn for_each(&self, mut visit: impl FnMut(usize, f64)) {
        with_vector!(self, vector => {
            vector.iter().enumerate().for_each(|(i, &value)| visit(i, as_number(value)));
        });
    }

    /// Adds samples of the same type at the end; others are left out.
    pub(crate) fn append(&mut self, more: Self) {
        macro_rules! arms {
            ($($kind:ident),*) => {
                match (self, more) {
                    $((Self::$kind(all), Self::$kind(more)) => all.extend(more),)*
                    _ => {}
                }
            };
        }
        arms!(U8, U16, U32, U64, I8, I16, I32, I64, F32, F64);
    }

    /// The same samples in another order: the new sample `i` is the old one at `source(i)`.
    pub(crate) fn reordered(self, source: impl Fn(usize) -> usize) -> Self {
        /// One arm for each type: the result has the type of the input.
        macro_rules! arms {
            ($($kind:ident),*) => {
                match self {
                    $(Self::$kind(old) => {
                        Self::$kind((0..old.len()).map(|i| old[source(i)]).collect())
                    })*
                }
            };
        }
        arms!(U8, U16, U32, U64, I8, I16, I32, I64, F32, F64)
    }
}

/// Numbers of every stored type as `f64`.
trait Number: Copy {
    fn number(self) -> f64;
}

macro_rules! numbers {
    ($($kind:ty),*; $convert:expr) => {
        $(impl Number for $kind {
            fn number(self) -> f64 {
                $convert(self)
            }
        })*
    };
}

numbers!(u8, u16, u32, i8, i16, i32, f32, f64; f64::from);
numbers!(u64; |value| value as f64);
numbers!(i64; |value| value as f64);

fn as_number(value: impl Number) -> f64 {
    value.number()
}
