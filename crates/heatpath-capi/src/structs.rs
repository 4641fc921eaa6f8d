//! Structs that begin with their size and grow at the end.
//!
//! A caller compiled with an older header passes a shorter struct: the fields it does not know get
//! their defaults. A caller compiled with a newer header passes a longer one: that is fine as long
//! as the fields this library does not know are zero, which always means "as before".

use crate::status::Failure;
use std::mem::{align_of, size_of};

/// No struct will ever be larger; what claims to be was never initialised.
const LARGEST: usize = 4096;

/// A struct of the header that begins with `uint32_t struct_size`.
///
/// # Safety
/// The type is `repr(C)` without padding at its end, its first field is `struct_size: u32`, and any
/// bytes make a valid value.
pub(crate) unsafe trait Versioned: Copy {
    /// Its name in the header.
    const NAME: &'static str;
    /// The size of the shortest struct that makes sense.
    const SHORTEST: usize;

    /// What the fields are set to before the caller's are looked at.
    fn defaults() -> Self;
}

/// Refuses a pointer that is NULL or not aligned for its type.
pub(crate) fn check_pointer<T>(pointer: *const T, name: &str) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(format!("{name} is NULL")));
    }
    if !pointer.is_aligned() {
        let alignment = align_of::<T>();
        return Err(Failure::argument(format!(
            "{name} points to {pointer:p}, which is no multiple of {alignment} bytes"
        )));
    }
    Ok(())
}

fn check_size<T: Versioned>(size: u32) -> Result<usize, Failure> {
    let (bytes, name, alignment) = (size as usize, T::NAME, align_of::<T>());
    if (T::SHORTEST..=LARGEST).contains(&bytes) && bytes.is_multiple_of(alignment) {
        return Ok(bytes);
    }
    let shortest = T::SHORTEST;
    Err(Failure::argument(format!(
        "struct_size of {name} is {size}; it must be sizeof({name}), here {}, or at least a \
         multiple of {alignment} from {shortest} to {LARGEST}",
        size_of::<T>()
    )))
}

/// Reads a struct from a caller.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to as many readable bytes as its `struct_size` says.
pub(crate) unsafe fn read<T: Versioned>(pointer: *const T, name: &str) -> Result<T, Failure> {
    check_pointer(pointer, name)?;
    let bytes = pointer.cast::<u8>();
    // SAFETY: the struct begins with its size and is aligned.
    let size = unsafe { pointer.cast::<u32>().read() };
    let size = check_size::<T>(size).map_err(|failure| failure.of(name))?;
    let known = size.min(size_of::<T>());
    // SAFETY: the caller promises `size` readable bytes, and `known` is not more.
    if (known..size).any(|i| unsafe { bytes.add(i).read() } != 0) {
        return Err(Failure::argument(format!(
            "{name}: {} has {size} bytes, and one after the first {known} is not zero: this \
             version of heatpath does not know that field",
            T::NAME
        )));
    }
    let mut value = T::defaults();
    // SAFETY: as above, `value` has room for `known` bytes, and any bytes make a valid value.
    unsafe { bytes.copy_to_nonoverlapping((&raw mut value).cast(), known) };
    Ok(value)
}

/// Reads a struct from a caller; NULL stands for the defaults.
///
/// # Safety
/// As [`read`].
pub(crate) unsafe fn read_or_defaults<T: Versioned>(
    pointer: *const T,
    name: &str,
) -> Result<T, Failure> {
    if pointer.is_null() {
        return Ok(T::defaults());
    }
    // SAFETY: the caller's promise.
    unsafe { read(pointer, name) }
}

/// Writes `value` to a struct of the caller that has room for `size` bytes; sets its `struct_size`.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to `size` writable bytes.
pub(crate) unsafe fn write<T: Versioned>(
    pointer: *mut T,
    size: u32,
    value: &T,
    name: &str,
) -> Result<(), Failure> {
    check_pointer(pointer, name)?;
    let bytes = check_size::<T>(size).map_err(|failure| failure.of(name))?;
    let known = bytes.min(size_of::<T>());
    // SAFETY: the caller promises `bytes` writable bytes; `value` has at least `known`.
    unsafe {
        pointer.cast::<u8>().write_bytes(0, bytes);
        pointer.cast::<u8>().copy_from_nonoverlapping((&raw const *value).cast(), known);
        pointer.cast::<u32>().write(size);
    }
    Ok(())
}

/// Writes `value` to a struct of the caller that says itself how large it is.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to as many writable bytes as its `struct_size` says.
pub(crate) unsafe fn answer<T: Versioned>(
    pointer: *mut T,
    value: &T,
    name: &str,
) -> Result<(), Failure> {
    check_pointer(pointer, name)?;
    // SAFETY: the struct begins with its size and is aligned; the caller promises the bytes.
    unsafe { write(pointer, pointer.cast::<u32>().read(), value, name) }
}
