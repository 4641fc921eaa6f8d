//! JPEG 2000, lossless and lossy.

use super::layout::Layout;
use super::pixels::WAY_OUT;
use hayro_jpeg2000::{ComponentData, DecodeSettings, DecoderContext, Image};

/// Beyond this the decoder's single floats could round.
const MOST_BITS: u32 = 16;

/// Where a codestream says how many components it has, and of what type the first one is
/// (ISO 15444-1, A.5.1).
const COMPONENTS: usize = 40;

/// Where it says how wide and how high tiles are.
const TILES: usize = 24;

/// Tiles and precincts that cover fewer pixels along a side take far more memory than these pixels do.
const LEAST_SIDE: u64 = 64;

/// For each change of the order of packets the decoder lists all precincts.
const MOST_CHANGES: usize = 32;

pub(super) fn decoded(data: &[u8], layout: &Layout) -> Result<Vec<u8>, String> {
    let (bits, is_signed) = component_type(data, layout)?;
    let settings =
        DecodeSettings { resolve_palette_indices: false, strict: true, target_resolution: None };
    let image = Image::new(data, &settings).map_err(|e| e.to_string())?;
    layout.check_size("JPEG 2000", [image.width(), image.height()])?;
    check_parts(data, layout)?;
    let mut context = DecoderContext::default();
    let decoded = image.decode(&mut context).map_err(|e| e.to_string())?;
    let planes: Vec<&[f32]> = decoded.components().iter().map(ComponentData::samples).collect();
    let pixels = usize::from(layout.columns) * usize::from(layout.rows);
    if planes.iter().any(|plane| plane.len() != pixels) {
        return Err("the components of its JPEG 2000 differ in size".to_owned());
    }
    // The decoder lifts signed samples by half of their range.
    let (white, lift) = ((1_u32 << bits) - 1, if is_signed { 1_u32 << (bits - 1) } else { 0 });
    let sample = |value: f32| (value.round() as u32).min(white).wrapping_sub(lift).to_le_bytes();
    let samples = (0..pixels).flat_map(|i| planes.iter().map(move |plane| sample(plane[i])));
    let length = usize::from(layout.bytes);
    Ok(samples.flat_map(|bytes| bytes.into_iter().take(length)).collect())
}

/// The bits of the components and whether they are signed; all are alike.
fn component_type(data: &[u8], layout: &Layout) -> Result<(u32, bool), String> {
    let header =
        data.get(COMPONENTS..COMPONENTS + 3).filter(|_| data.starts_with(b"\xff\x4f\xff\x51"));
    let Some(&[high, low, kind]) = header else {
        return Err("the pixels are no codestream of JPEG 2000".to_owned());
    };
    let (count, bits) = (u16::from_be_bytes([high, low]), u32::from(kind & 0x7f) + 1);
    let (channels, most) = (layout.channels, MOST_BITS.min(8 * u32::from(layout.bytes)));
    if count != channels || bits > most {
        return Err(format!(
            "its JPEG 2000 has {count} components of {bits} bits; {channels} of up to {most} bits are \
             accepted"
        ));
    }
    let others = data[COMPONENTS + 2..].chunks_exact(3).take(usize::from(count));
    if !others.eq((0..count).map(|_| [kind, 1, 1])) {
        return Err(format!("the {count} components of its JPEG 2000 differ in type or size"));
    }
    Ok((bits, kind & 0x80 != 0))
}

/// Refuses what takes far more memory than the size of the picture says.
///
/// Tiles may have styles of their own, and lengths of segments need not be true: markers are looked for
/// everywhere. What looks like one in compressed data is rarer than one in 10^12 bytes.
fn check_parts(data: &[u8], layout: &Layout) -> Result<(), String> {
    let rests = || (0..data.len()).map(|at| &data[at..]);
    if has_small_tiles(data, layout) || rests().any(|rest| has_small_precincts(rest, layout)) {
        return Err(format!(
            "its JPEG 2000 has tiles or precincts of less than {LEAST_SIDE} x {LEAST_SIDE} pixels: \
             {WAY_OUT}"
        ));
    }
    let changes: usize = rests().map(changes_of_order).sum();
    if changes > MOST_CHANGES {
        return Err(format!(
            "its JPEG 2000 changes the order of packets {changes} times; up to {MOST_CHANGES} are \
             accepted: {WAY_OUT}"
        ));
    }
    Ok(())
}

/// Whether a part covers too little of a side of the picture.
fn is_small(covered: u64, side: u16) -> bool {
    covered < LEAST_SIDE.min(u64::from(side))
}

fn has_small_tiles(data: &[u8], layout: &Layout) -> bool {
    let side = |at: usize| data[at..at + 4].iter().fold(0, |n, &byte| n << 8 | u64::from(byte));
    is_small(side(TILES), layout.columns) || is_small(side(TILES + 4), layout.rows)
}

/// Whether a coding style, of all components or of one (A.6.1 and A.6.2), begins here and has small
/// precincts.
fn has_small_precincts(rest: &[u8], layout: &Layout) -> bool {
    let (flags, style) = match rest {
        // Length, flags, order, layers, transformation of colours.
        [0xff, 0x52, _, _, flags, 0..=4, 0, 1..=32, _, style @ ..] => (flags, style),
        // Length, component, flags.
        [0xff, 0x53, _, _, 0..=2, flags, style @ ..] => (flags, style),
        _ => return false,
    };
    // Decompositions, the sides of blocks, their style, the wavelet.
    let [levels @ 0..=32, width @ 0..=8, height @ 0..=8, _, 0..=1, sizes @ ..] = style else {
        return false;
    };
    let are_given = flags & 1 == 1 && width + height <= 8;
    let mut precincts = sizes.iter().zip((0..=*levels).rev());
    are_given
        && precincts.any(|(size, halvings)| {
            is_small(1 << ((size & 15) + halvings), layout.columns)
                || is_small(1 << ((size >> 4) + halvings), layout.rows)
        })
}

/// How many changes of the order of packets begin here (A.6.6).
fn changes_of_order(rest: &[u8]) -> usize {
    let [0xff, 0x5f, high, low, entries @ ..] = rest else { return 0 };
    let count = usize::from(u16::from_be_bytes([*high, *low])).saturating_sub(2) / 7;
    let entries = entries.get(..7 * count).unwrap_or_default();
    if entries.chunks_exact(7).all(|entry| entry[6] <= 4) { count.min(entries.len()) } else { 0 }
}
