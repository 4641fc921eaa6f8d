//! Pictures as files: the same pixels as DICOM (explicit VR, little endian) and as arrays of numpy.

use heatpath_ffi_tests::npy;

/// A picture of 40 columns and 30 rows, 0.25 mm wide and 0.5 mm high each.
pub(crate) struct Pixels {
    /// As numpy calls the type: `<u2`, `<i2` or `|u1`.
    pub(crate) kind: &'static str,
    /// 1, or 3 for red, green and blue.
    pub(crate) samples: u16,
    pub(crate) bytes: Vec<u8>,
}

pub(crate) const SIZE: [usize; 2] = [40, 30];

/// What names a type of pixels, here and there.
const SECONDARY_CAPTURE: &str = "1.2.840.10008.5.1.4.1.1.7";
const EXPLICIT_LITTLE_ENDIAN: &str = "1.2.840.10008.1.2.1";

impl Pixels {
    /// Grey values without symmetry, from -1000 to 1000 around `middle`.
    pub(crate) fn grey(kind: &'static str, middle: f64) -> Self {
        let value = |i: usize| (middle + 1000.0 * wave(i)) as i32 as u16;
        let bytes = (0..SIZE[0] * SIZE[1]).flat_map(|i| value(i).to_le_bytes()).collect();
        Self { kind, samples: 1, bytes }
    }

    /// Colours, each channel another one.
    pub(crate) fn colours() -> Self {
        let channels = |i: usize| [128.0 + 90.0 * wave(i), 40.0, 128.0 - 90.0 * wave(i)];
        let bytes = (0..SIZE[0] * SIZE[1]).flat_map(|i| channels(i).map(|value| value as u8));
        Self { kind: "|u1", samples: 3, bytes: bytes.collect() }
    }

    /// Zeros in a wall with a gap, 255 elsewhere.
    pub(crate) fn wall() -> Self {
        let is_wall = |i: usize| i % SIZE[0] == 20 && i / SIZE[0] < 25;
        let bytes = (0..SIZE[0] * SIZE[1]).map(|i| if is_wall(i) { 0 } else { 255 }).collect();
        Self { kind: "|u1", samples: 1, bytes }
    }

    pub(crate) fn npy(&self) -> Vec<u8> {
        let [columns, rows] = SIZE;
        let colours = if self.samples == 3 { &[3][..] } else { &[] };
        npy(self.kind, &[&[rows, columns], colours].concat(), &self.bytes)
    }

    /// The file of an instance; `number` tells it from others.
    pub(crate) fn dicom(&self, number: u16) -> Vec<u8> {
        let instance = format!("1.2.826.0.1.3680043.2.1143.{number}");
        let meta = [
            element(0x0002, 0x0001, "OB", &[0, 1]),
            text(0x0002, 0x0002, "UI", SECONDARY_CAPTURE),
            text(0x0002, 0x0003, "UI", &instance),
            text(0x0002, 0x0010, "UI", EXPLICIT_LITTLE_ENDIAN),
            text(0x0002, 0x0012, "UI", "1.2.826.0.1.3680043.2.1143"),
        ]
        .concat();
        let length = element(0x0002, 0x0000, "UL", &(meta.len() as u32).to_le_bytes());
        [vec![0; 128], b"DICM".to_vec(), length, meta, self.dataset(&instance)].concat()
    }

    fn dataset(&self, instance: &str) -> Vec<u8> {
        let number =
            |group, name, value: usize| element(group, name, "US", &u16::to_le_bytes(value as u16));
        let bits = if self.kind == "|u1" { 8 } else { 16 };
        let colour = if self.samples == 3 { "RGB" } else { "MONOCHROME2" };
        let mut elements = vec![
            text(0x0008, 0x0016, "UI", SECONDARY_CAPTURE),
            text(0x0008, 0x0018, "UI", instance),
            text(0x0008, 0x0060, "CS", "MR"),
            text(0x0010, 0x0020, "LO", "heatpath"),
            text(0x0020, 0x000d, "UI", "1.2.826.0.1.3680043.2.1143.1.1"),
            text(0x0020, 0x000e, "UI", "1.2.826.0.1.3680043.2.1143.1.2"),
            number(0x0028, 0x0002, usize::from(self.samples)),
            text(0x0028, 0x0004, "CS", colour),
            number(0x0028, 0x0010, SIZE[1]),
            number(0x0028, 0x0011, SIZE[0]),
            // The distance of rows comes first.
            text(0x0028, 0x0030, "DS", "0.5\\0.25"),
            number(0x0028, 0x0100, bits),
            number(0x0028, 0x0101, bits),
            number(0x0028, 0x0102, bits - 1),
            number(0x0028, 0x0103, usize::from(self.kind == "<i2")),
            element(0x7fe0, 0x0010, if bits == 8 { "OB" } else { "OW" }, &self.bytes),
        ];
        if self.samples == 3 {
            // Red, green and blue of a pixel follow each other.
            elements.insert(8, number(0x0028, 0x0006, 0));
        }
        elements.concat()
    }
}

fn wave(i: usize) -> f64 {
    let [x, y] = [i % SIZE[0], i / SIZE[0]].map(|n| n as f64);
    (0.3 * x + 0.05 * y).sin() * (0.2 * y + 1.0).cos()
}

fn text(group: u16, name: u16, kind: &str, text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    if bytes.len() % 2 == 1 {
        bytes.push(if kind == "UI" { 0 } else { b' ' });
    }
    element(group, name, kind, &bytes)
}

fn element(group: u16, name: u16, kind: &str, value: &[u8]) -> Vec<u8> {
    let mut bytes = [group.to_le_bytes(), name.to_le_bytes()].concat();
    bytes.extend(kind.as_bytes());
    if matches!(kind, "OB" | "OW") {
        bytes.extend([0, 0]);
        bytes.extend((value.len() as u32).to_le_bytes());
    } else {
        bytes.extend((value.len() as u16).to_le_bytes());
    }
    bytes.extend(value);
    bytes
}
