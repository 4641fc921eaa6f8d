//! What callers hold without seeing into it.

use crate::status::Failure;
use crate::structs::check_pointer;

/// Makes a handle and gives it to the caller, or NULL if that fails.
///
/// # Safety
/// `target` is NULL, misaligned, or points to room for a pointer.
pub(crate) unsafe fn hand_out<T>(
    target: *mut *mut T,
    name: &str,
    make: impl FnOnce() -> Result<T, Failure>,
) -> Result<(), Failure> {
    check_pointer(target, name)?;
    // SAFETY: the caller promises room for a pointer; it is aligned.
    unsafe { target.write(std::ptr::null_mut()) };
    let handle = Box::into_raw(Box::new(make()?));
    // SAFETY: as above.
    unsafe { target.write(handle) };
    Ok(())
}

/// Looks into a handle.
///
/// # Safety
/// `handle` is NULL, misaligned, or comes from [`hand_out`] and lives as long as it is borrowed.
pub(crate) unsafe fn borrow<'a, T>(handle: *const T, name: &str) -> Result<&'a T, Failure> {
    check_pointer(handle, name)?;
    // SAFETY: not NULL, aligned, and the caller's promise.
    Ok(unsafe { &*handle })
}

/// Frees a handle; NULL is fine.
///
/// # Safety
/// `handle` is NULL, misaligned, or comes from [`hand_out`] and was not freed yet.
pub(crate) unsafe fn free<T>(handle: *mut T, name: &str) -> Result<(), Failure> {
    if !handle.is_null() {
        check_pointer(handle, name)?;
        // SAFETY: made by `Box::into_raw`, and freed once, as the caller promises.
        drop(unsafe { Box::from_raw(handle) });
    }
    Ok(())
}
