//! From the caller's pixels to numbers and back, row by row.

use crate::status::{Failure, HP_INVALID_BUFFER, HP_PANIC};
use crate::view::{Sample, View};
use heatpath_core::grid::Grid;
use std::mem::size_of;

/// The pixels as numbers.
///
/// # Safety
/// All pixels that the view describes can be read.
pub(crate) unsafe fn read<const D: usize>(view: &View<D>) -> Result<Grid<f64, D>, Failure> {
    view.check_data()?;
    // SAFETY: the caller's promise, and the type that the view names.
    let values = unsafe {
        match view.sample {
            Sample::U8 => read_as::<u8, D>(view),
            Sample::I8 => read_as::<i8, D>(view),
            Sample::U16 => read_as::<u16, D>(view),
            Sample::I16 => read_as::<i16, D>(view),
            Sample::U32 => read_as::<u32, D>(view),
            Sample::I32 => read_as::<i32, D>(view),
            Sample::F32 => read_as::<f32, D>(view),
            Sample::F64 => read_as::<f64, D>(view),
        }
    };
    Grid::from_values(view.shape, values).map_err(|error| Failure::new(HP_PANIC, error.to_string()))
}

/// # Safety
/// All pixels that the view describes can be read, and are of type `T`.
unsafe fn read_as<T: Copy + Into<f64>, const D: usize>(view: &View<D>) -> Vec<f64> {
    let columns = view.shape.size()[0];
    let mut values = Vec::with_capacity(view.shape.cells());
    for number in 0..view.shape.cells() / columns {
        let row = row(view, number);
        if view.stride[0] == size_of::<T>() as isize {
            let row = row.cast::<T>();
            // SAFETY: a pixel of this row, as the caller promises; a load that needs no alignment.
            values.extend((0..columns).map(|x| unsafe { row.add(x).read_unaligned() }.into()));
        } else {
            let at = |x: usize| row.wrapping_offset(x as isize * view.stride[0]).cast::<T>();
            // SAFETY: as above.
            values.extend((0..columns).map(|x| unsafe { at(x).read_unaligned() }.into()));
        }
    }
    values
}

/// Refuses a buffer that distances cannot be written to.
pub(crate) fn check_writable<const D: usize>(view: &View<D>) -> Result<(), Failure> {
    view.check_data()?;
    if matches!(view.sample, Sample::F32 | Sample::F64) {
        return Ok(());
    }
    let message = "its type must be HP_F32 or HP_F64";
    Err(Failure::new(HP_INVALID_BUFFER, message).of(view.name))
}

/// Stores `values`, x fastest, into the caller's pixels, which passed [`check_writable`].
///
/// # Safety
/// All pixels that the view describes can be written.
pub(crate) unsafe fn write<const D: usize>(view: &View<D>, values: &[f64]) {
    // SAFETY: the caller's promise, and the type that the view names.
    unsafe {
        if view.sample == Sample::F32 {
            write_as(view, values, |value| value as f32);
        } else {
            write_as(view, values, |value| value);
        }
    }
}

/// Stores 255 where `values` are true and 0 elsewhere, into the caller's HP_U8 pixels.
///
/// # Safety
/// All pixels that the view describes can be written.
pub(crate) unsafe fn write_mask<const D: usize>(view: &View<D>, values: &[bool]) {
    // SAFETY: the caller's promise, and the type that `check_mask` saw.
    unsafe { write_as(view, values, |value| if value { u8::MAX } else { 0 }) };
}

/// Refuses a buffer that a mask cannot be written to.
pub(crate) fn check_mask<const D: usize>(view: &View<D>) -> Result<(), Failure> {
    view.check_data()?;
    if view.sample == Sample::U8 {
        return Ok(());
    }
    Err(Failure::new(HP_INVALID_BUFFER, "its type must be HP_U8").of(view.name))
}

/// Stores `values` into the caller's pixels, which passed [`check_labels`].
///
/// # Safety
/// All pixels that the view describes can be written.
pub(crate) unsafe fn write_labels<const D: usize>(view: &View<D>, values: &[i32]) {
    // SAFETY: the caller's promise, and the types that `check_labels` saw.
    unsafe { write_as(view, values, |value| value) };
}

/// Refuses a buffer that numbers of sources cannot be written to.
pub(crate) fn check_labels<const D: usize>(view: &View<D>) -> Result<(), Failure> {
    view.check_data()?;
    if matches!(view.sample, Sample::I32 | Sample::U32) {
        return Ok(());
    }
    Err(Failure::new(HP_INVALID_BUFFER, "its type must be HP_I32 or HP_U32").of(view.name))
}

/// # Safety
/// All pixels that the view describes can be written, and are of type `T`.
unsafe fn write_as<S: Copy, T, const D: usize>(
    view: &View<D>,
    values: &[S],
    convert: impl Fn(S) -> T,
) {
    for (number, values) in values.chunks_exact(view.shape.size()[0]).enumerate() {
        let row = row(view, number);
        for (x, &value) in values.iter().enumerate() {
            let pixel = row.wrapping_offset(x as isize * view.stride[0]).cast::<T>();
            // SAFETY: a pixel of this row, as the caller promises; a store that needs no alignment.
            unsafe { pixel.write_unaligned(convert(value)) };
        }
    }
}

/// The first pixel of a row, counted through all slices.
fn row<const D: usize>(view: &View<D>, number: usize) -> *mut u8 {
    let index = view.shape.index(number * view.shape.size()[0]);
    let offset: isize = (1..D).map(|axis| index[axis] as isize * view.stride[axis]).sum();
    view.data.wrapping_offset(offset)
}
