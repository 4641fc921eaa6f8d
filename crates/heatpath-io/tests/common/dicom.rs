//! Small DICOM files, made in memory.

/// A DICOM file by hand, of 3 x 2 pixels from 0 to 5.
#[derive(Clone)]
pub(crate) struct Dicom {
    pub(crate) syntax: &'static str,
    pub(crate) colours: &'static str,
    /// Columns and rows.
    pub(crate) size: [u16; 2],
    /// Of a pixel, and those of them that count.
    pub(crate) bits: [u16; 2],
    pub(crate) is_signed: bool,
    /// Tags, their value representations and values; a sequence has no end of its own.
    pub(crate) more: Vec<(u32, [u8; 2], Vec<u8>)>,
    /// Raw, or the pieces of what is compressed.
    pub(crate) pixels: Vec<Vec<u8>>,
}

impl Default for Dicom {
    fn default() -> Self {
        let pixels = (0..6_u16).flat_map(u16::to_le_bytes).collect();
        Self {
            syntax: "1.2.840.10008.1.2.1",
            colours: "MONOCHROME2 ",
            size: [3, 2],
            bits: [16, 16],
            is_signed: false,
            more: Vec::new(),
            pixels: vec![pixels],
        }
    }
}

impl Dicom {
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut out = [&[0; 128][..], b"DICM"].concat();
        let plain = Writer { is_implicit: false, is_big_endian: false };
        plain.element(&mut out, 0x0002_0010, *b"UI", self.syntax.as_bytes());
        let body = Writer {
            is_implicit: self.syntax == "1.2.840.10008.1.2",
            is_big_endian: self.syntax == "1.2.840.10008.1.2.2",
        };
        let is_grey = self.colours.starts_with(['M', 'P']);
        let mut elements = vec![(0x0028_0004, *b"CS", self.colours.as_bytes().to_vec())];
        for (tag, value) in [
            (0x0028_0002, if is_grey { 1 } else { 3 }),
            (0x0028_0010, self.size[1]),
            (0x0028_0011, self.size[0]),
            (0x0028_0100, self.bits[0]),
            (0x0028_0101, self.bits[1]),
            (0x0028_0102, self.bits[1] - 1),
            (0x0028_0103, u16::from(self.is_signed)),
        ] {
            elements.push((tag, *b"US", body.order(value.to_le_bytes().to_vec())));
        }
        elements.extend(self.more.iter().cloned());
        elements.sort();
        for (tag, kind, value) in elements {
            body.element(&mut out, tag, kind, &value);
        }
        self.write_pixels(&body, &mut out);
        out
    }

    fn write_pixels(&self, body: &Writer, out: &mut Vec<u8>) {
        let tail = self.syntax.strip_prefix("1.2.840.10008.1.2").unwrap();
        if matches!(tail, "" | ".1" | ".2" | ".1.99") {
            let words = self.pixels[0].chunks(2).flat_map(|word| body.order(word.to_vec()));
            return body.element(out, 0x7fe0_0010, *b"OW", &words.collect::<Vec<_>>());
        }
        out.extend(b"\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff\xfe\xff\0\xe0\0\0\0\0");
        for piece in &self.pixels {
            out.extend(b"\xfe\xff\0\xe0");
            out.extend((piece.len() as u32).to_le_bytes());
            out.extend(piece);
        }
        out.extend(b"\xfe\xff\xdd\xe0\0\0\0\0");
    }
}

struct Writer {
    is_implicit: bool,
    is_big_endian: bool,
}

impl Writer {
    fn order(&self, mut little: Vec<u8>) -> Vec<u8> {
        if self.is_big_endian {
            little.reverse();
        }
        little
    }

    fn element(&self, out: &mut Vec<u8>, tag: u32, kind: [u8; 2], value: &[u8]) {
        for half in [(tag >> 16) as u16, tag as u16] {
            out.extend(self.order(half.to_le_bytes().to_vec()));
        }
        let length = if kind == *b"SQ" { u32::MAX } else { value.len() as u32 };
        let is_long = matches!(&kind, b"OW" | b"SQ");
        if !self.is_implicit {
            out.extend(kind);
        }
        if self.is_implicit || is_long {
            out.extend(vec![0; if self.is_implicit { 0 } else { 2 }]);
            out.extend(self.order(length.to_le_bytes().to_vec()));
        } else {
            out.extend(self.order((length as u16).to_le_bytes().to_vec()));
        }
        out.extend(value);
    }
}

/// An item of a sequence of defined length, of little-endian elements with their representations.
pub(crate) fn item(elements: &[(u32, [u8; 2], &[u8])]) -> Vec<u8> {
    let writer = Writer { is_implicit: false, is_big_endian: false };
    let mut content = Vec::new();
    for (tag, kind, value) in elements {
        writer.element(&mut content, *tag, *kind, value);
        if kind == b"SQ" {
            content.extend(SEQUENCE_END);
        }
    }
    let mut out = b"\xfe\xff\0\xe0".to_vec();
    out.extend((content.len() as u32).to_le_bytes());
    [out, content].concat()
}

/// The end of a sequence of undefined length.
pub(crate) const SEQUENCE_END: [u8; 8] = *b"\xfe\xff\xdd\xe0\0\0\0\0";

/// A file of 3 x 2 x n pixels from 0 on, whose frames say at which height they lie.
pub(crate) fn frames(heights: &[f64]) -> Dicom {
    let measures = item(&[(0x0028_0030, *b"DS", b"0.5\\0.25")]);
    let turn = item(&[(0x0020_0037, *b"DS", b"1\\0\\0\\0\\1\\0 ")]);
    let shared = item(&[(0x0020_9116, *b"SQ", &turn), (0x0028_9110, *b"SQ", &measures)]);
    let frame = |height: &f64| {
        let position = item(&[(0x0020_0032, *b"DS", format!("1\\2\\{height:<4}").as_bytes())]);
        item(&[(0x0020_9113, *b"SQ", &position)])
    };
    let frames: Vec<u8> = heights.iter().flat_map(frame).chain(SEQUENCE_END).collect();
    Dicom {
        more: vec![
            (0x0028_0008, *b"IS", format!("{:<2}", heights.len()).into_bytes()),
            (0x5200_9229, *b"SQ", [shared, SEQUENCE_END.to_vec()].concat()),
            (0x5200_9230, *b"SQ", frames),
        ],
        pixels: vec![(0..6 * heights.len() as u16).flat_map(u16::to_le_bytes).collect()],
        ..Dicom::default()
    }
}
