//! Run lengths (DICOM PS3.5, annex G).

use super::layout::Layout;

/// Run lengths: a plane for each byte of a sample, the most significant one first.
pub(super) fn decoded(data: &[u8], layout: &Layout) -> Result<Vec<u8>, String> {
    let planes = layout.pixel_bytes();
    let number = |i: usize| {
        let array = data.get(4 * i..4 * i + 4)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(array)).ok()
    };
    if number(0) != Some(planes) {
        return Err(format!("the run lengths have no {planes} planes"));
    }
    let pixels = layout.frame_bytes() / planes;
    let mut bytes = vec![0; layout.frame_bytes()];
    for plane in 0..planes {
        let start = number(plane + 1).and_then(|start| data.get(start..));
        let values = unpacked(start.ok_or("a plane of run lengths is missing")?, pixels)?;
        // Samples come out with the least significant byte first.
        let (channel, byte) =
            (plane / usize::from(layout.bytes), plane % usize::from(layout.bytes));
        let place = (channel + 1) * usize::from(layout.bytes) - 1 - byte;
        bytes.iter_mut().skip(place).step_by(planes).zip(values).for_each(|(to, from)| *to = from);
    }
    Ok(bytes)
}

/// The first `length` bytes of run lengths.
fn unpacked(data: &[u8], length: usize) -> Result<Vec<u8>, String> {
    let mut values = Vec::new();
    let mut rest = data;
    while values.len() < length {
        let [control, tail @ ..] = rest else { return Err("the run lengths end early".to_owned()) };
        let (control, count) = (*control, usize::from(*control));
        rest = match (control, tail) {
            (0..128, _) if count < tail.len() => {
                values.extend(&tail[..=count]);
                &tail[count + 1..]
            }
            (129.., [value, tail @ ..]) => {
                values.extend(std::iter::repeat_n(*value, 257 - count));
                tail
            }
            (128, tail) => tail,
            _ => return Err("the run lengths end early".to_owned()),
        };
    }
    values.truncate(length);
    Ok(values)
}
