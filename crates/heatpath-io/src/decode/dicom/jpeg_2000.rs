//! JPEG 2000, lossless and lossy.

use super::layout::Layout;
use hayro_jpeg2000::{ComponentData, DecodeSettings, DecoderContext, Image};

/// Beyond this the decoder's single floats could round.
const MOST_BITS: u32 = 16;

/// Where a codestream says how many components it has, and of what type the first one is
/// (ISO 15444-1, A.5.1).
const COMPONENTS: usize = 40;

pub(super) fn decoded(data: &[u8], layout: &Layout) -> Result<Vec<u8>, String> {
    let (bits, is_signed) = component_type(data, layout)?;
    let settings =
        DecodeSettings { resolve_palette_indices: false, strict: true, target_resolution: None };
    let image = Image::new(data, &settings).map_err(|e| e.to_string())?;
    layout.check_size("JPEG 2000", [image.width(), image.height()])?;
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
