//! The numbers of the caller's lists, read and written.

use crate::array::{HP_I64, HP_U64, hp_array};
use crate::buffer::{HP_F32, HP_I8, HP_I16, HP_I32, HP_U8, HP_U16, HP_U32};
use crate::items::{Items, invalid};
use crate::status::{Failure, HP_OUT_OF_MEMORY};

impl<const N: usize> Items<N> {
    /// The items as numbers of any kind.
    ///
    /// # Safety
    /// All items that are described can be read.
    pub(crate) unsafe fn values(&self) -> Result<Vec<[f64; N]>, Failure> {
        // SAFETY: the caller's promise, and the type that the description names.
        unsafe {
            match self.kind {
                HP_U8 => self.read_as::<u8, _>(f64::from),
                HP_I8 => self.read_as::<i8, _>(f64::from),
                HP_U16 => self.read_as::<u16, _>(f64::from),
                HP_I16 => self.read_as::<i16, _>(f64::from),
                HP_U32 => self.read_as::<u32, _>(f64::from),
                HP_I32 => self.read_as::<i32, _>(f64::from),
                HP_F32 => self.read_as::<f32, _>(f64::from),
                HP_I64 => self.read_as::<i64, _>(|number| number as f64),
                HP_U64 => self.read_as::<u64, _>(|number| number as f64),
                _ => self.read_as::<f64, _>(|number| number),
            }
        }
    }

    /// The items as whole numbers.
    ///
    /// # Safety
    /// As [`values`](Self::values).
    pub(crate) unsafe fn integers(&self) -> Result<Vec<[i128; N]>, Failure> {
        // SAFETY: as above.
        unsafe {
            match self.kind {
                HP_U8 => self.read_as::<u8, _>(i128::from),
                HP_I8 => self.read_as::<i8, _>(i128::from),
                HP_U16 => self.read_as::<u16, _>(i128::from),
                HP_I16 => self.read_as::<i16, _>(i128::from),
                HP_U32 => self.read_as::<u32, _>(i128::from),
                HP_I32 => self.read_as::<i32, _>(i128::from),
                HP_I64 => self.read_as::<i64, _>(i128::from),
                HP_U64 => self.read_as::<u64, _>(i128::from),
                _ => {
                    let failure = invalid("its type must be one of integers, not HP_F32 or HP_F64");
                    Err(failure.of(self.name))
                }
            }
        }
    }

    /// # Safety
    /// As [`values`](Self::values), and the numbers are of type `T`.
    unsafe fn read_as<T: Copy, U>(&self, convert: impl Fn(T) -> U) -> Result<Vec<[U; N]>, Failure> {
        let mut values = Vec::new();
        values.try_reserve_exact(self.count).map_err(|_| {
            let message = format!("{}: there is no memory for {} items", self.name, self.count);
            Failure::new(HP_OUT_OF_MEMORY, message)
        })?;
        for place in 0..self.count {
            let item = self.item(0, place).cast::<T>();
            // SAFETY: a number of this item, as the caller promises; a load that needs no alignment.
            let number = |i| convert(unsafe { item.wrapping_add(i).read_unaligned() });
            values.push(std::array::from_fn(number));
        }
        Ok(values)
    }

    /// Stores a row of reals.
    ///
    /// # Safety
    /// This is a [`target`](Self::target) of reals with such a row, and all its items can be written.
    pub(crate) unsafe fn write(&self, row: usize, values: impl Iterator<Item = [f64; N]>) {
        // SAFETY: the caller's promise, and the type that the description names.
        unsafe {
            match self.kind {
                HP_F32 => self.write_as(row, values, |value| value as f32),
                _ => self.write_as(row, values, |value| value),
            }
        }
    }

    /// Stores a row of integers.
    ///
    /// # Safety
    /// This is a [`target`](Self::target) of integers with such a row, and all its items can be
    /// written.
    pub(crate) unsafe fn write_integers(&self, row: usize, values: impl Iterator<Item = [i32; N]>) {
        // SAFETY: the caller's promise, and the type that the description names.
        unsafe {
            match self.kind {
                HP_I32 | HP_U32 => self.write_as(row, values, |number| number),
                _ => self.write_as(row, values, i64::from),
            }
        }
    }

    /// # Safety
    /// All items of the row can be written, and their numbers have the size of `T`.
    unsafe fn write_as<S, T>(
        &self,
        row: usize,
        values: impl Iterator<Item = [S; N]>,
        convert: impl Fn(S) -> T,
    ) {
        for (place, value) in (0..self.count).zip(values) {
            let item = self.item(row, place).cast::<T>();
            for (i, number) in value.into_iter().enumerate() {
                // SAFETY: a number of this item, as the caller promises; a store that needs no
                // alignment.
                unsafe { item.wrapping_add(i).write_unaligned(convert(number)) };
            }
        }
    }
}

/// Reads a list of single numbers; of NULL none.
///
/// # Safety
/// `array` is NULL, misaligned, or points to the description of readable items.
pub(crate) unsafe fn reals(
    array: *const hp_array,
    name: &'static str,
) -> Result<Option<Vec<f64>>, Failure> {
    if array.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    let items = unsafe { Items::<1>::read(array, name)?.values()? };
    Ok(Some(items.into_iter().flatten().collect()))
}

/// Reads a list of single integers; of NULL none.
///
/// # Safety
/// As [`reals`].
pub(crate) unsafe fn integers(
    array: *const hp_array,
    name: &'static str,
) -> Result<Option<Vec<i128>>, Failure> {
    if array.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    let items = unsafe { Items::<1>::read(array, name)?.integers()? };
    Ok(Some(items.into_iter().flatten().collect()))
}
