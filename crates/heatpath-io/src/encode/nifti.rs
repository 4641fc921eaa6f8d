//! `NIfTI`-1 headers.

use super::{Numbers, Volume};
use crate::placement::ras_to_lps;
use std::io::{self, Write};

/// Where the numbers begin.
const OFFSET: usize = 352;

/// The place goes into the sform, as "scanner" and in RAS. It is of single floats.
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
        let side = volume.size.get(axis).copied().unwrap_or(1);
        let side = i16::try_from(side).map_err(|_| too_long(side))?;
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
    let axes = volume.placement.direction.iter().zip(volume.spacing);
    let axes = axes.map(|(axis, spacing)| axis.map(|part| part * spacing));
    for (column, vector) in axes.chain([volume.placement.origin]).enumerate() {
        for (row, part) in ras_to_lps(vector).into_iter().enumerate() {
            put(280 + 16 * row + 4 * column, &(part as f32).to_le_bytes());
        }
    }
    put(344, b"n+1\0");
    out.write_all(&header)
}

fn too_long(side: usize) -> io::Error {
    let most = i16::MAX;
    io::Error::other(format!("{side} cells along an axis; NIfTI-1 holds at most {most}"))
}
