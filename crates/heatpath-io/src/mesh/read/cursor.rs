//! Words and numbers, one after the other.

use std::str::FromStr;

/// A place in a file, from which words, lines or binary numbers are taken.
#[derive(Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
}

/// The type of a binary number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    Little,
    Big,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// What is left.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes
    }

    /// The next bytes.
    pub(super) fn take(&mut self, length: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = self.bytes.split_at_checked(length).ok_or_else(truncated)?;
        self.bytes = rest;
        Ok(taken)
    }

    /// The rest of this line, without its end; none at the end of the file.
    pub(super) fn line(&mut self) -> Option<&'a [u8]> {
        if self.bytes.is_empty() {
            return None;
        }
        let end = self.bytes.iter().position(|c| matches!(c, b'\n' | b'\r'));
        let (line, rest) = self.bytes.split_at(end.unwrap_or(self.bytes.len()));
        self.bytes = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..)).unwrap_or_default();
        Some(line)
    }

    /// The next word, on this line or a later one; none at the end of the file.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        let text = self.bytes.trim_ascii_start();
        let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
        let (word, rest) = text.split_at(end);
        self.bytes = rest;
        Some(word).filter(|word| !word.is_empty())
    }

    /// The next word as a number.
    pub(super) fn number<T: FromStr>(&mut self) -> Result<T, String> {
        parse(self.word().ok_or_else(truncated)?)
    }

    /// The next binary number.
    pub(super) fn binary(&mut self, kind: Kind, order: Order) -> Result<f64, String> {
        Ok(kind.decode(self.take(kind.size())?, order))
    }
}

/// A word as a number.
pub(super) fn parse<T: FromStr>(word: &[u8]) -> Result<T, String> {
    let text = std::str::from_utf8(word).ok();
    text.and_then(|text| text.parse().ok())
        .ok_or_else(|| format!("expected a number, found {:?}", excerpt(word)))
}

/// The start of a word, for messages.
pub(super) fn excerpt(word: &[u8]) -> String {
    String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned()
}

pub(super) fn truncated() -> String {
    "the file ends too early".to_owned()
}

impl Kind {
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// A number from as many bytes as [`size`](Self::size) says.
    pub(super) fn decode(self, bytes: &[u8], order: Order) -> f64 {
        // The bytes from the least to the most significant one.
        let mut little = [0; 8];
        little[..bytes.len()].copy_from_slice(bytes);
        if order == Order::Big {
            little[..bytes.len()].reverse();
        }
        let bits = u64::from_le_bytes(little);
        match self {
            Self::I8 => f64::from(bits as i8),
            Self::U8 => f64::from(bits as u8),
            Self::I16 => f64::from(bits as i16),
            Self::U16 => f64::from(bits as u16),
            Self::I32 => f64::from(bits as i32),
            Self::U32 => f64::from(bits as u32),
            Self::I64 => bits as i64 as f64,
            Self::U64 => bits as f64,
            Self::F32 => f64::from(f32::from_bits(bits as u32)),
            Self::F64 => f64::from_bits(bits),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_words() {
        let mut cursor = Cursor::new(b"a b\r\nc\n\n  7 x");
        assert_eq!(cursor.word(), Some(&b"a"[..]));
        assert_eq!(cursor.line(), Some(&b" b"[..]));
        assert_eq!((cursor.line(), cursor.line()), (Some(&b"c"[..]), Some(&b""[..])));
        assert_eq!(cursor.number(), Ok(7));
        assert_eq!(cursor.clone().number::<i32>().unwrap_err(), "expected a number, found \"x\"");
        assert!(cursor.take(3).is_err() && cursor.take(2) == Ok(b" x"));
        assert_eq!((cursor.line(), cursor.word()), (None, None));
    }

    #[test]
    fn numbers_of_all_kinds() {
        let big = |kind: Kind, bytes: &[u8]| Cursor::new(bytes).binary(kind, Order::Big);
        assert_eq!(big(Kind::I8, &[0xff]), Ok(-1.0));
        assert_eq!(big(Kind::U16, &[1, 2]), Ok(258.0));
        assert_eq!(big(Kind::I16, &[0xff, 0xfe]), Ok(-2.0));
        assert_eq!(big(Kind::I32, &[0xff, 0xff, 0xff, 0xfd]), Ok(-3.0));
        assert_eq!(big(Kind::F32, &1.5_f32.to_be_bytes()), Ok(1.5));
        assert_eq!(big(Kind::I64, &(-9_i64).to_be_bytes()), Ok(-9.0));
        let little = Cursor::new(&0.1_f64.to_le_bytes()).binary(Kind::F64, Order::Little);
        assert_eq!(little, Ok(0.1));
    }
}
