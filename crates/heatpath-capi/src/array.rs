//! How callers describe lists of numbers.

use crate::status::{guard, hp_status};
use crate::structs::{self, Versioned};
use std::ffi::c_void;
use std::mem::size_of;

/// Numbers are int64_t; in hp_array only.
pub const HP_I64: u32 = 9;
/// Numbers are uint64_t; in hp_array only.
pub const HP_U64: u32 = 10;

/// The caller's list of items, described but never owned or kept. An item is one number (the number
/// of a vertex, a distance) or a few that follow each other (x, y, z; the three corners of a face).
///
/// Fill it with hp_array_init(), then set type, data and count. Item i is found at `data + i *
/// byte_stride`, so a list can be a part of larger structs: the positions of vertices that have
/// colours too, say. Items need not be aligned; those that are written must not overlap.
///
/// Any number of threads may read the same list at once. Functions that take an input only read it,
/// although data is not const.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_array {
    /// sizeof(hp_array).
    pub struct_size: u32,
    /// HP_U8 to HP_F64, HP_I64 or HP_U64, in the byte order of the machine. Numbers of vertices and
    /// faces can have any type of integers, coordinates and values any type; results that are reals are
    /// HP_F32 or HP_F64, numbers of faces and labels integers of at least 32 bits. There is no default.
    pub r#type: u32,
    /// The first item.
    pub data: *mut c_void,
    /// The number of items.
    pub count: u64,
    /// The bytes from an item to the next one; negative if that one lies before it in memory. 0, the
    /// default, means that items follow each other without gaps.
    pub byte_stride: i64,
}

// SAFETY: integers and pointers, an 8-byte number at the end.
unsafe impl Versioned for hp_array {
    const NAME: &'static str = "hp_array";
    const SHORTEST: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            r#type: 0,
            data: std::ptr::null_mut(),
            count: 0,
            byte_stride: 0,
        }
    }
}

/// Fills *array with the defaults; struct_size is sizeof(hp_array).
///
/// # Safety
/// `array` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_array_init(array: *mut hp_array, struct_size: u32) -> hp_status {
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(array, struct_size, &hp_array::defaults(), "array") })
}
