//! Pixels that are places in a list of colours (DICOM PS3.3, C.7.6.3.1.5).

use super::elements::{DataSet, Tag, name};

/// Where the lists of red, green and blue are described, and where they are.
const DESCRIPTORS: [Tag; 3] = [0x0028_1101, 0x0028_1102, 0x0028_1103];
const COLOURS: [Tag; 3] = [0x0028_1201, 0x0028_1202, 0x0028_1203];

/// A list of colours.
pub(super) struct Palette {
    /// All reds, all greens and all blues, of 16 bits.
    pub(super) colours: Vec<u16>,
    /// The pixel that stands for the first colour.
    first: f64,
}

impl Palette {
    pub(super) fn new(data: &DataSet<'_>, is_signed: bool) -> Result<Self, String> {
        let [red, green, blue] = DESCRIPTORS.map(|tag| data.shorts(tag).collect::<Vec<_>>());
        let &[count, first, bits @ (8 | 16)] = &red[..] else {
            return Err(format!("the palette is described as {red:?}; 8 and 16 bits are accepted"));
        };
        if green != red || blue != red {
            return Err("the lists of the palette differ in length or type".to_owned());
        }
        let count = if count == 0 { 1 << 16 } else { usize::from(count) };
        let mut colours = Vec::new();
        for tag in COLOURS {
            colours.extend(list(data, tag, count, bits)?);
        }
        let first = if is_signed { f64::from(first as i16) } else { f64::from(first) };
        Ok(Self { colours, first })
    }

    /// The place of a pixel; those beyond the ends have the colours there.
    pub(super) fn place(&self, pixel: f64) -> usize {
        ((pixel - self.first) as usize).min(self.colours.len() / 3 - 1)
    }
}

/// The colours of one list; those of 8 bits stand in a byte or in two.
fn list(data: &DataSet<'_>, tag: Tag, count: usize, bits: u16) -> Result<Vec<u16>, String> {
    let bytes = data.get(tag).unwrap_or_default();
    let is_packed = bits == 8 && bytes.len() < 2 * count;
    let words: Vec<u16> = match is_packed {
        true => bytes.iter().take(count).map(|&byte| u16::from(byte)).collect(),
        false => data.shorts(tag).take(count).collect(),
    };
    if words.len() < count {
        return Err(format!("{} has {} colours of {count}", name(tag), words.len()));
    }
    Ok(match bits {
        8 => words.into_iter().map(|word| 257 * (word & 0xff)).collect(),
        _ => words,
    })
}
