//! JPEG-LS, lossless and nearly so, of one value a pixel.

use super::layout::Layout;
use super::pixels::WAY_OUT;
use jpegls::CodecError;

pub(super) fn decoded(data: &[u8], layout: &Layout) -> Result<Vec<u8>, String> {
    let size = [layout.columns, layout.rows].map(u32::from);
    let (values, ..) = jpegls::decode(data, size[0], size[1]).map_err(|error| reason(&error))?;
    let length = usize::from(layout.bytes);
    if let Some(wide) = values.iter().find(|&&value| length == 1 && value > u16::from(u8::MAX)) {
        return Err(format!("its JPEG-LS has the value {wide} where 8 bits are stored"));
    }
    let wide = values.into_iter().map(|value| u32::from(value).to_le_bytes());
    Ok(wide.flat_map(|bytes| bytes.into_iter().take(length)).collect())
}

fn reason(error: &CodecError) -> String {
    match error {
        CodecError::Unsupported(_) => format!("{error}: {WAY_OUT}"),
        CodecError::DimensionMismatch { .. } => {
            "its JPEG-LS has other rows and columns than the file says".to_owned()
        }
        _ => format!("its JPEG-LS: {error}"),
    }
}
