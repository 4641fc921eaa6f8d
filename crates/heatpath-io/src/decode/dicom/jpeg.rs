//! JPEG of 8 bits, and lossless JPEG of up to 16.

use super::layout::Layout;
use super::pixels::WAY_OUT;
use jpeg_decoder::{CodingProcess, ColorTransform, Decoder, Error, UnsupportedFeature};

pub(super) fn decoded(data: &[u8], layout: &Layout) -> Result<Vec<u8>, String> {
    let mut decoder = Decoder::new(data);
    let transform = match (layout.channels, layout.is_ybr) {
        (3, true) => ColorTransform::YCbCr,
        (3, false) => ColorTransform::RGB,
        _ => ColorTransform::Grayscale,
    };
    decoder.set_color_transform(transform);
    decoder.read_info().map_err(reason)?;
    let info = decoder.info().ok_or("no JPEG header")?;
    layout.check_size("JPEG", [info.width, info.height].map(u32::from))?;
    if layout.is_ybr && info.coding_process == CodingProcess::Lossless {
        return Err(format!("lossless JPEG of YBR colours; RGB is accepted: {WAY_OUT}"));
    }
    let (found, needed) = (info.pixel_format.pixel_bytes(), layout.pixel_bytes());
    if found != needed {
        return Err(format!("its JPEG has pixels of {found} bytes, not {needed}"));
    }
    let pixels = decoder.decode().map_err(reason)?;
    let words = layout.bytes == 2 && cfg!(target_endian = "big");
    Ok(if words { pixels.chunks(2).flat_map(|word| [word[1], word[0]]).collect() } else { pixels })
}

fn reason(error: Error) -> String {
    match error {
        Error::Unsupported(UnsupportedFeature::SamplePrecision(bits)) => {
            format!(
                "JPEG of {bits} bits; 8 bits, and any if it is lossless, are accepted: {WAY_OUT}"
            )
        }
        other => other.to_string(),
    }
}
