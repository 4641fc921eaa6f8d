//! A first look at the header of an NPY file, before it is parsed as the Python literal it is.

/// Numpy itself refuses longer headers.
const LONGEST: usize = 10_000;

/// A structured type nests to 4 levels; deeper brackets could exhaust the parser's stack.
const DEEPEST: usize = 6;

/// Checks that the header is complete, short, flat and free of numbers whose product does not fit
/// into 64 bits: what the parser behind this takes for granted.
pub(super) fn check(bytes: &[u8]) -> Result<(), String> {
    let text = text(bytes)?;
    let odd = |c: &u8| matches!(c, b'\\' | b'+' | b'-');
    if text.windows(3).any(|w| w == b"'''" || w == b"\"\"\"")
        || outside_quotes(text).any(|c| odd(&c))
    {
        return Err("the header is not one that numpy writes".to_owned());
    }
    check_depth(text)?;
    check_numbers(text)
}

/// The header's text.
fn text(bytes: &[u8]) -> Result<&[u8], String> {
    let (start, length) = match bytes {
        [_, _, _, _, _, _, 1, _, low, high, ..] => {
            (10, usize::from(u16::from_le_bytes([*low, *high])))
        }
        [_, _, _, _, _, _, 2 | 3, _, a, b, c, d, ..] => {
            (12, u32::from_le_bytes([*a, *b, *c, *d]) as usize)
        }
        _ => return Err("the header is truncated or of an unknown version".to_owned()),
    };
    if length > LONGEST {
        return Err(format!(
            "a header of {length} bytes is too large; at most {LONGEST} are accepted"
        ));
    }
    bytes.get(start..start + length).ok_or_else(|| "the header is truncated".to_owned())
}

/// The text with what stands in quotes left out (and a backslash, wherever it is, kept).
fn outside_quotes(text: &[u8]) -> impl Iterator<Item = u8> {
    let mut quote = None;
    text.iter().copied().filter(move |&c| match quote {
        None => {
            quote = matches!(c, b'\'' | b'"').then_some(c);
            true
        }
        Some(open) => {
            if c == open {
                quote = None;
            }
            c == b'\\'
        }
    })
}

fn check_depth(text: &[u8]) -> Result<(), String> {
    let mut depth = 0_usize;
    for &c in text {
        match c {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            return Err("the header has too many nested brackets".to_owned());
        }
    }
    Ok(())
}

/// All numbers outside quotes are sizes.
fn check_numbers(text: &[u8]) -> Result<(), String> {
    let plain: Vec<u8> = outside_quotes(text).collect();
    let words = plain.split(|c| !(c.is_ascii_alphanumeric() || matches!(c, b'_' | b'.')));
    let mut product = 1_u64;
    for word in words.filter(|word| word.iter().any(u8::is_ascii_digit)) {
        let word = str::from_utf8(word).unwrap_or_default();
        let number: u64 =
            word.parse().map_err(|_| format!("{word} in the header is not a size"))?;
        product = product
            .checked_mul(number.max(1))
            .ok_or("the array's size in the header is too large: beyond 2^64 bytes")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(text: &str) -> Vec<u8> {
        let length = u16::try_from(text.len()).unwrap().to_le_bytes();
        [b"\x93NUMPY\x01\x00".as_slice(), &length, text.as_bytes()].concat()
    }

    #[test]
    fn headers_of_numpy_pass() {
        for good in [
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }\n",
            "{'descr': [('a', '<f4', (2, 2)), ('b', '|u1')], 'fortran_order': True, 'shape': (3,), }",
        ] {
            assert_eq!(check(&header(good)), Ok(()));
        }
    }

    #[test]
    fn headers_that_would_upset_the_parser_are_refused() {
        for bad in [
            "{'shape': (4294967296, 4294967296), }",
            "{'shape': (0, 18446744073709551615, 2), }",
            "{'shape': (0x10, 2), }",
            "{'shape': (1_0, 2), }",
            "{'shape': (1 + 1, 2), }",
            "{'a\\'': 1}",
            "{'''x'y''': 1}",
            "((((((((((",
            "{{{{{{{{{{",
        ] {
            assert!(check(&header(bad)).is_err(), "{bad}");
        }
        assert!(check(&header("{}")[..11]).is_err());
        assert!(check(b"\x93NUMPY\x02\x00\xff\xff\xff\xff{}").is_err());
        assert!(check(b"\x93NUMPY\x09\x00\x02\x00{}").is_err());
    }
}
