//! `NIfTI`-1 headers.

use super::{Numbers, Volume};
use std::io::{self, Write};

/// Where the numbers begin.
const OFFSET: usize = 352;

/// World coordinates of the format are RAS.
const FROM_LPS: [f64; 3] = [-1.0, -1.0, 1.0];

/// The place goes into the sform, as "scanner". It is of single floats.
pub(super) fn write_header(out: &mut dyn Write, volume: &Volume<'_>) -> io::Result<()> {
    let mut header = vec![0_u8; OFFSET];
    let mut put = |at: usize, bytes: &[u8]| header[at..at + bytes.len()].copy_from_slice(bytes);
    let (code, bits) = match volume.numbers {
        Numbers::U8(_) => (2_i16, 8_i16),
        Numbers::F64(_) => (64, 64),
    };
    put(0, &348_i32.to_le_bytes());
    put(40, &(volume.size.len() as i16).to_le_bytes());
    for axis in 0..7 {
        let side = i16::try_from(volume.size.get(axis).copied().unwrap_or(1)).map_err(|_| {
            io::Error::other(format!("NIfTI holds at most {} cells along an axis", i16::MAX))
        })?;
        put(42 + 2 * axis, &side.to_le_bytes());
        let spacing = volume.spacing.get(axis).copied().unwrap_or(1.0) as f32;
        put(80 + 4 * axis, &spacing.to_le_bytes());
    }
    put(70, &code.to_le_bytes());
    put(72, &bits.to_le_bytes());
    put(76, &1_f32.to_le_bytes());
    put(108, &(OFFSET as f32).to_le_bytes());
    put(112, &1_f32.to_le_bytes());
    // Millimetres.
    put(123, &[2]);
    put(254, &1_i16.to_le_bytes());
    for (row, sign) in FROM_LPS.into_iter().enumerate() {
        for axis in 0..3 {
            let part = sign * volume.placement.direction[axis][row] * volume.spacing[axis];
            put(280 + 16 * row + 4 * axis, &(part as f32 + 0.0).to_le_bytes());
        }
        let origin = sign * volume.placement.origin[row];
        put(280 + 16 * row + 12, &(origin as f32 + 0.0).to_le_bytes());
    }
    put(344, b"n+1\0");
    out.write_all(&header)
}
