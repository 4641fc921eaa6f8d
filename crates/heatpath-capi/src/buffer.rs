//! How callers describe their pixels.

use crate::status::{guard, hp_status};
use crate::structs::{self, Versioned};
use std::ffi::c_void;
use std::mem::size_of;

/// Pixels are uint8_t.
pub const HP_U8: u32 = 1;
/// Pixels are int8_t.
pub const HP_I8: u32 = 2;
/// Pixels are uint16_t.
pub const HP_U16: u32 = 3;
/// Pixels are int16_t.
pub const HP_I16: u32 = 4;
/// Pixels are uint32_t.
pub const HP_U32: u32 = 5;
/// Pixels are int32_t.
pub const HP_I32: u32 = 6;
/// Pixels are float.
pub const HP_F32: u32 = 7;
/// Pixels are double.
pub const HP_F64: u32 = 8;

/// The caller's pixels, described but never owned or kept: one number per pixel.
///
/// Fill it with hp_buffer_init(), then set data, type, size, and where needed the rest. The pixel
/// at column x, row y and slice z is found at `data + x * byte_stride[0] + y * byte_stride[1] + z *
/// byte_stride[2]`. With that rule a buffer can be a part of a larger picture or volume, one channel
/// of a coloured one, or upside down. Pixels need not be aligned, but must not overlap.
///
/// Any number of threads may read the same buffer at once. Functions that take an input only
/// read it, although data is not const.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_buffer {
    /// sizeof(hp_buffer).
    pub struct_size: u32,
    /// HP_U8, HP_I8, HP_U16, HP_I16, HP_U32, HP_I32, HP_F32 or HP_F64, in the byte order of the
    /// machine. There is no default.
    pub r#type: u32,
    /// The number of axes: 2, the default, for a picture; 3 for a volume. With 2 the third entry of
    /// the arrays below is ignored.
    pub dimension: u32,
    /// 0.
    pub reserved: u32,
    /// The first pixel: column 0, row 0, slice 0.
    pub data: *mut c_void,
    /// The pixels along each axis: columns, rows, slices.
    pub size: [u64; 3],
    /// The bytes from a pixel to the next one along each axis; negative if that one lies before it
    /// in memory. 0, the default, means that pixels, rows or slices follow each other without gaps.
    pub byte_stride: [i64; 3],
    /// The physical distance of neighbouring pixels along each axis, positive; 1 by default.
    /// Only that of the image counts.
    pub spacing: [f64; 3],
}

// SAFETY: integers, floats and pointers, 8-byte numbers at the end.
unsafe impl Versioned for hp_buffer {
    const NAME: &'static str = "hp_buffer";
    const SHORTEST: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            r#type: 0,
            dimension: 2,
            reserved: 0,
            data: std::ptr::null_mut(),
            size: [0; 3],
            byte_stride: [0; 3],
            spacing: [1.0; 3],
        }
    }
}

/// Fills *buffer with the defaults; struct_size is sizeof(hp_buffer).
///
/// # Safety
/// `buffer` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_buffer_init(buffer: *mut hp_buffer, struct_size: u32) -> hp_status {
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(buffer, struct_size, &hp_buffer::defaults(), "buffer") })
}
