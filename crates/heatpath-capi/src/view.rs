//! The caller's description of pixels, checked.

use crate::buffer::{HP_F32, HP_F64, HP_I8, HP_I16, HP_I32, HP_U8, HP_U16, HP_U32, hp_buffer};
use crate::status::{Failure, HP_INVALID_BUFFER, HP_INVALID_IMAGE};
use crate::structs;
use heatpath_core::grid::Shape;

/// The type of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sample {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F32,
    F64,
}

impl Sample {
    fn new(number: u32) -> Option<Self> {
        Some(match number {
            HP_U8 => Self::U8,
            HP_I8 => Self::I8,
            HP_U16 => Self::U16,
            HP_I16 => Self::I16,
            HP_U32 => Self::U32,
            HP_I32 => Self::I32,
            HP_F32 => Self::F32,
            HP_F64 => Self::F64,
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value that stands for white, where the type alone says it.
    pub(crate) fn white(self) -> Option<f64> {
        match self {
            Self::U8 => Some(f64::from(u8::MAX)),
            Self::U16 => Some(f64::from(u16::MAX)),
            _ => None,
        }
    }
}

/// A buffer whose description makes sense.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<const D: usize> {
    pub(crate) name: &'static str,
    pub(crate) data: *mut u8,
    pub(crate) sample: Sample,
    pub(crate) shape: Shape<D>,
    /// In bytes.
    pub(crate) stride: [isize; D],
}

/// The dimension of the image, which that of everything else must be: 2 or 3.
///
/// # Safety
/// `image` is NULL, misaligned, or points to as many readable bytes as its `struct_size` says.
pub(crate) unsafe fn dimension(image: *const hp_buffer) -> Result<u32, Failure> {
    // SAFETY: the caller's promise.
    let image = unsafe { structs::read(image, "image")? };
    check_dimension(image.dimension).map_err(|failure| failure.of("image"))?;
    Ok(image.dimension)
}

fn check_dimension(dimension: u32) -> Result<(), Failure> {
    if matches!(dimension, 2 | 3) {
        return Ok(());
    }
    let message = format!("dimension is {dimension}; it must be 2 or 3");
    Err(Failure::new(HP_INVALID_BUFFER, message))
}

impl<const D: usize> View<D> {
    /// Reads and checks a description; `name` stands in messages.
    ///
    /// # Safety
    /// `buffer` is NULL, misaligned, or points to as many readable bytes as its `struct_size` says.
    pub(crate) unsafe fn read(
        buffer: *const hp_buffer,
        name: &'static str,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let buffer = unsafe { structs::read(buffer, name)? };
        Self::new(&buffer, name).map_err(|failure| failure.of(name))
    }

    /// The buffer for a result that may not be wanted.
    ///
    /// # Safety
    /// As [`read`](Self::read).
    pub(crate) unsafe fn optional(
        buffer: *const hp_buffer,
        name: &'static str,
    ) -> Result<Option<Self>, Failure> {
        if buffer.is_null() {
            return Ok(None);
        }
        // SAFETY: the caller's promise.
        unsafe { Self::read(buffer, name).map(Some) }
    }

    fn new(buffer: &hp_buffer, name: &'static str) -> Result<Self, Failure> {
        let invalid = |message: String| Failure::new(HP_INVALID_BUFFER, message);
        check_dimension(buffer.dimension)?;
        if buffer.dimension as usize != D {
            let dimension = buffer.dimension;
            return Err(invalid(format!("dimension is {dimension}, but that of the image is {D}")));
        }
        if buffer.reserved != 0 {
            return Err(invalid(format!("reserved is {}; it must be 0", buffer.reserved)));
        }
        let Some(sample) = Sample::new(buffer.r#type) else {
            return Err(invalid(format!(
                "type is {}; it must be one of HP_U8 ({HP_U8}) to HP_F64 ({HP_F64})",
                buffer.r#type
            )));
        };
        // A number that no usize holds is refused as too large in any case.
        let size =
            std::array::from_fn(|axis| usize::try_from(buffer.size[axis]).unwrap_or(usize::MAX));
        let spacing = std::array::from_fn(|axis| buffer.spacing[axis]);
        let shape = Shape::with_spacing(size, spacing)?;
        let stride = strides(buffer, sample, size)?;
        let view = Self { name, data: buffer.data.cast(), sample, shape, stride };
        view.check_extent()?;
        Ok(view)
    }

    /// Refuses NULL for pixels that are needed.
    pub(crate) fn check_data(&self) -> Result<(), Failure> {
        if self.data.is_null() {
            let message = "data is NULL; it must point to the first pixel";
            return Err(Failure::new(HP_INVALID_BUFFER, message).of(self.name));
        }
        Ok(())
    }

    /// Refuses a result of another size than the image.
    pub(crate) fn check_size(&self, image: &Shape<D>) -> Result<(), Failure> {
        let (size, expected) = (self.shape.size(), image.size());
        if size == expected {
            return Ok(());
        }
        let message = format!("it has {size:?} pixels, but the image has {expected:?}");
        Err(Failure::new(HP_INVALID_BUFFER, message).of(self.name))
    }

    /// The bytes from this map to the next of `count`, worked out if `given` as 0.
    pub(crate) fn map_stride(&self, given: i64, count: usize) -> Result<isize, Failure> {
        let size = self.shape.size();
        let packed = (0..D).try_fold(self.sample.bytes(), |most, axis| {
            Some(most.max(self.stride[axis].unsigned_abs().checked_mul(size[axis])?))
        });
        let stride = match given {
            0 => packed.and_then(|bytes| isize::try_from(bytes).ok()),
            _ => isize::try_from(given).ok(),
        };
        let invalid = |message: String| Failure::new(HP_INVALID_BUFFER, message);
        let far = || invalid("the maps lead to pixels outside of all memory".to_owned());
        let (stride, extent) = (stride.ok_or_else(far)?, self.extent());
        if count > 1 && stride.unsigned_abs() < extent {
            return Err(invalid(format!(
                "the stride of maps is {stride}, but that must be at least {extent} bytes or maps would \
                 overlap"
            )));
        }
        let others = stride.unsigned_abs().checked_mul(count.saturating_sub(1));
        let all = others.and_then(|bytes| bytes.checked_add(extent)).ok_or_else(far)?;
        let address = self.data.addr();
        let reaches_below = || self.reach_below() + if stride < 0 { all - extent } else { 0 };
        let fits = all <= isize::MAX as usize
            && address.checked_add(all).is_some()
            && reaches_below() <= address;
        if fits { Ok(stride) } else { Err(far()) }
    }

    /// The bytes from the lowest to the highest pixel.
    fn extent(&self) -> usize {
        let steps = self.stride.iter().zip(self.shape.size());
        let steps = steps.map(|(stride, side)| stride.unsigned_abs() * (side - 1));
        steps.sum::<usize>() + self.sample.bytes()
    }

    /// The same view of another place in memory.
    pub(crate) fn moved(&self, bytes: isize) -> Self {
        Self { data: self.data.wrapping_offset(bytes), ..*self }
    }

    /// Refuses pixels that overlap, and those that would lie outside of all memory.
    fn check_extent(&self) -> Result<(), Failure> {
        let (size, stride) = (self.shape.size(), self.stride.map(isize::unsigned_abs));
        let mut axes: [usize; D] = std::array::from_fn(|axis| axis);
        axes.sort_by_key(|&axis| stride[axis]);
        let outside =
            || Failure::new(HP_INVALID_BUFFER, "the strides lead to pixels outside of all memory");
        // === How many bytes the pixels of one line take, those of all lines, those of all slices
        let mut extent = self.sample.bytes();
        for axis in axes.into_iter().filter(|&axis| size[axis] > 1) {
            if stride[axis] < extent {
                return Err(Failure::new(
                    HP_INVALID_BUFFER,
                    format!(
                        "byte_stride[{axis}] is {}, but that must be at least {extent} bytes or \
                         pixels would overlap",
                        self.stride[axis]
                    ),
                ));
            }
            let steps = stride[axis].checked_mul(size[axis] - 1);
            extent = steps.and_then(|n| n.checked_add(extent)).ok_or_else(outside)?;
        }
        // === Pixels lie on both sides of the first one if strides differ in sign
        let address = self.data.addr();
        let room = isize::MAX as usize;
        let fits = extent <= room
            && (self.data.is_null()
                || (address.checked_add(extent).is_some() && self.reach_below() <= address));
        if fits { Ok(()) } else { Err(outside()) }
    }

    /// How many bytes before the first pixel the lowest one lies.
    fn reach_below(&self) -> usize {
        let negative = (0..D).filter(|&axis| self.stride[axis] < 0);
        negative.map(|axis| self.stride[axis].unsigned_abs() * (self.shape.size()[axis] - 1)).sum()
    }

    /// A failure at the pixel stored as number `position`.
    pub(crate) fn bad_pixel(&self, position: usize, value: f64) -> Failure {
        let index = self.shape.index(position);
        let message = format!("the value at {index:?} is {value}; it must be a number");
        Failure::new(HP_INVALID_IMAGE, message).of(self.name)
    }
}

/// The strides in bytes, those left at zero worked out.
fn strides<const D: usize>(
    buffer: &hp_buffer,
    sample: Sample,
    size: [usize; D],
) -> Result<[isize; D], Failure> {
    let too_far = |axis: usize| {
        let message = format!("byte_stride[{axis}] is {}, too far", buffer.byte_stride[axis]);
        Failure::new(HP_INVALID_BUFFER, message)
    };
    let mut strides = [0_isize; D];
    for axis in 0..D {
        let given = isize::try_from(buffer.byte_stride[axis]).map_err(|_| too_far(axis))?;
        // What the axes before take up.
        let packed = || -> Result<isize, Failure> {
            (0..axis).try_fold(sample.bytes() as isize, |packed, near| {
                let line = strides[near].checked_abs();
                let line = line.and_then(|stride| stride.checked_mul(size[near] as isize));
                Ok(packed.max(line.ok_or_else(|| too_far(near))?))
            })
        };
        strides[axis] = if given == 0 { packed()? } else { given };
    }
    Ok(strides)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structs::Versioned;

    fn buffer<const D: usize>(size: [u64; D], stride: [i64; D]) -> hp_buffer {
        let mut buffer = hp_buffer { r#type: HP_U16, ..hp_buffer::defaults() };
        buffer.dimension = D as u32;
        buffer.data = std::ptr::without_provenance_mut(4096);
        buffer.size[..D].copy_from_slice(&size);
        buffer.byte_stride[..D].copy_from_slice(&stride);
        buffer
    }

    fn strides_of<const D: usize>(size: [u64; D], stride: [i64; D]) -> Result<[isize; D], String> {
        let view = View::<D>::new(&buffer(size, stride), "image");
        view.map(|view| view.stride).map_err(|failure| failure.message)
    }

    #[test]
    fn strides_left_at_zero_are_packed() {
        assert_eq!(strides_of([5, 3], [0, 0]), Ok([2, 10]));
        assert_eq!(strides_of([5, 3], [6, 0]), Ok([6, 30]));
        assert_eq!(strides_of([5, 3], [-2, 0]), Ok([-2, 10]));
        assert_eq!(strides_of([5, 3], [0, -64]), Ok([2, -64]));
        assert_eq!(strides_of([5, 3], [6, 2]), Ok([6, 2]), "columns as rows");
    }

    #[test]
    fn slices_left_at_zero_are_packed() {
        let size = [5, 3, 4];
        assert_eq!(strides_of(size, [0, 0, 0]), Ok([2, 10, 30]));
        assert_eq!(strides_of(size, [0, 16, 0]), Ok([2, 16, 48]));
        assert_eq!(strides_of(size, [0, 0, 64]), Ok([2, 10, 64]));
        assert_eq!(strides_of(size, [0, -10, 0]), Ok([2, -10, 30]));
        assert_eq!(strides_of(size, [6, 2, 0]), Ok([6, 2, 30]), "columns as rows");
        assert_eq!(strides_of(size, [24, 8, 2]), Ok([24, 8, 2]), "slices next to each other");
        assert_eq!(strides_of([5, 1, 4], [0, 1, 0]), Ok([2, 1, 10]), "a single row");
    }

    #[test]
    fn wrong_slices_are_refused() {
        let size = [5, 3, 4];
        for stride in [[0, 0, 29], [0, 0, -29], [0, 0, 8], [0, 16, 40]] {
            let message = strides_of(size, stride).unwrap_err();
            assert!(message.contains("overlap"), "{stride:?}: {message}");
        }
        for far in [i64::MAX, i64::MIN, i64::MAX / 2, -4096] {
            assert!(strides_of(size, [0, 0, far]).is_err(), "{far}");
            assert!(strides_of(size, [0, far, 0]).is_err(), "{far}");
        }
        for size in [[0, 1, 1], [1, 0, 1], [1, 1, 0], [1 << 21, 1 << 21, 1 << 21], [u64::MAX; 3]] {
            assert!(strides_of(size, [0, 0, 0]).is_err(), "{size:?}");
        }
        let message = View::<2>::new(&buffer(size, [0; 3]), "mask").unwrap_err().message;
        assert_eq!(message, "dimension is 3, but that of the image is 2");
    }

    #[test]
    fn maps_follow_each_other() {
        let view = View::<2>::new(&buffer([5, 3], [0, 16]), "maps").unwrap();
        let stride = |given: i64, count| view.map_stride(given, count).map_err(|f| f.message);
        assert_eq!(stride(0, 3), Ok(48), "with the gap after the last row");
        assert_eq!(stride(42, 3), Ok(42));
        assert_eq!(stride(-42, 3), Ok(-42));
        assert_eq!(stride(4, 1), Ok(4), "a single map has no neighbours");
        for near in [41, -41, 2] {
            assert!(stride(near, 2).unwrap_err().contains("at least 42 bytes"), "{near}");
        }
        for (given, count) in
            [(i64::MAX, 2), (i64::MIN, 2), (-4096, 3), (48, usize::MAX), (0, usize::MAX / 48)]
        {
            assert!(stride(given, count).unwrap_err().contains("outside"), "{given} {count}");
        }
    }

    #[test]
    fn overlapping_pixels_are_refused() {
        for (stride, bad) in [([1, 0], 0), ([2, 5], 1), ([4, 2], 0), ([-2, -8], 1)] {
            let message = strides_of([5, 3], stride).unwrap_err();
            assert!(message.starts_with(&format!("byte_stride[{bad}]")), "{stride:?}: {message}");
        }
        assert!(strides_of([1, 3], [1, 0]).is_ok(), "a single column has no neighbours");
    }

    #[test]
    fn pixels_outside_of_memory_are_refused() {
        for stride in [[i64::MAX, 0], [i64::MIN, 0], [2, i64::MAX], [2, i64::MIN], [-2000, 0]] {
            assert!(strides_of([5, 3], stride).is_err(), "{stride:?}");
        }
        assert!(strides_of([u64::MAX, u64::MAX], [0, 0]).is_err());
        assert!(strides_of([1 << 62, 1], [0, 0]).is_err());
    }
}
