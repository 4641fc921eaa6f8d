//! OFF.

use super::cursor::{Cursor, excerpt, truncated};
use super::{Found, Reading, Soup, vertex};
use std::collections::VecDeque;

/// The words of the file without comments, line by line.
struct Words<'a> {
    cursor: Cursor<'a>,
    line: VecDeque<&'a [u8]>,
}

impl<'a> Words<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self { cursor: Cursor::new(bytes), line: VecDeque::new() }
    }

    /// The next word, on this line or a later one.
    fn next(&mut self) -> Result<&'a [u8], String> {
        loop {
            if let Some(word) = self.line.pop_front() {
                return Ok(word);
            }
            let line = self.cursor.line().ok_or_else(truncated)?;
            let text = line.split(|&c| c == b'#').next().unwrap_or_default();
            self.line = text.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty()).collect();
        }
    }

    fn number<T: std::str::FromStr>(&mut self) -> Result<T, String> {
        super::cursor::parse(self.next()?)
    }
}

/// Normals, colours and texture coordinates follow the position, and colours follow the corners, on
/// the same line: the rest of each line is passed over.
pub(super) fn read(bytes: &[u8]) -> Reading {
    let mut words = Words::new(bytes);
    let first = words.next()?;
    if first.ends_with(b"OFF") {
        if first.contains(&b'4') || first.contains(&b'n') {
            return Err(format!("{} has points of other dimensions than 3", excerpt(first)));
        }
        if words.line.front() == Some(&&b"BINARY"[..]) {
            return Err("binary files are not read; text is".to_owned());
        }
    } else {
        words.line.push_front(first);
    }
    let [points, faces]: [usize; 2] = [words.number()?, words.number()?];
    words.line.clear();
    let mut soup = Soup::default();
    for _ in 0..points {
        soup.push_point([words.number()?, words.number()?, words.number()?]);
        words.line.clear();
    }
    let mut corners = Vec::new();
    for _ in 0..faces {
        corners.clear();
        for _ in 0..words.number::<usize>()? {
            corners.push(vertex(words.number()?)?);
        }
        soup.push(corners.iter().copied());
        words.line.clear();
    }
    Ok(Found::new(soup))
}
