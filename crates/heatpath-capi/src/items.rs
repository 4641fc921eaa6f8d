//! The caller's lists of numbers, checked.

use crate::array::{HP_I64, HP_U64, hp_array};
use crate::buffer::{HP_F32, HP_F64, HP_I8, HP_I16, HP_I32, HP_U8, HP_U16, HP_U32};
use crate::status::{Failure, HP_INVALID_BUFFER};
use crate::structs;

/// A list whose description makes sense: items of `N` numbers each, in one or more rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Items<const N: usize> {
    pub(crate) name: &'static str,
    data: *mut u8,
    pub(crate) kind: u32,
    pub(crate) count: usize,
    /// The bytes from an item to the next.
    stride: isize,
    /// The bytes from a row to the next.
    row_stride: isize,
}

/// The bytes of a number.
fn bytes_of(kind: u32) -> Option<usize> {
    match kind {
        HP_U8 | HP_I8 => Some(1),
        HP_U16 | HP_I16 => Some(2),
        HP_U32 | HP_I32 | HP_F32 => Some(4),
        HP_F64 | HP_I64 | HP_U64 => Some(8),
        _ => None,
    }
}

pub(crate) fn invalid(message: impl Into<String>) -> Failure {
    Failure::new(HP_INVALID_BUFFER, message)
}

impl<const N: usize> Items<N> {
    /// Reads and checks the description of an input; `name` stands in messages.
    ///
    /// # Safety
    /// `array` is NULL, misaligned, or points to as many readable bytes as its `struct_size` says.
    pub(crate) unsafe fn read(array: *const hp_array, name: &'static str) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let array = unsafe { structs::read(array, name)? };
        Self::new(&array, name).map_err(|failure| failure.of(name))
    }

    /// Reads and checks the description of a result: `rows` rows of `count` numbers, floats unless
    /// `integers`; the rows are `row_stride` apart, packed if that is 0.
    ///
    /// # Safety
    /// As [`read`](Self::read).
    pub(crate) unsafe fn target(
        array: *const hp_array,
        name: &'static str,
        integers: bool,
        count: usize,
        (rows, row_stride): (usize, i64),
    ) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let items = unsafe { Self::read(array, name)? };
        let checked = || {
            items.check_kind(integers)?;
            if items.count != count {
                return Err(invalid(format!("count is {}; it must be {count}", items.count)));
            }
            items.in_rows(rows, row_stride)
        };
        checked().map_err(|failure| failure.of(name))
    }

    fn new(array: &hp_array, name: &'static str) -> Result<Self, Failure> {
        let Some(bytes) = bytes_of(array.r#type) else {
            return Err(invalid(format!(
                "type is {}; it must be one of HP_U8 ({HP_U8}) to HP_F64 ({HP_F64}), HP_I64 \
                 ({HP_I64}) or HP_U64 ({HP_U64})",
                array.r#type
            )));
        };
        if array.data.is_null() && array.count > 0 {
            return Err(invalid("data is NULL; it must point to the first item"));
        }
        let count = usize::try_from(array.count).map_err(|_| outside())?;
        let stride = match isize::try_from(array.byte_stride) {
            Ok(0) => (N * bytes) as isize,
            Ok(stride) => stride,
            Err(_) => return Err(outside()),
        };
        let (data, kind) = (array.data.cast(), array.r#type);
        let items = Self { name, data, kind, count, stride, row_stride: 0 };
        items.check_extent(1)?;
        Ok(items)
    }

    /// The same list as the first of some rows.
    fn in_rows(self, rows: usize, row_stride: i64) -> Result<Self, Failure> {
        let packed = self.stride.unsigned_abs().checked_mul(self.count);
        let row_stride = match row_stride {
            0 => packed.and_then(|bytes| isize::try_from(bytes).ok()),
            given => isize::try_from(given).ok(),
        };
        let items = Self { row_stride: row_stride.ok_or_else(outside)?, ..self };
        items.check_extent(rows)?;
        // === Rows beside rows, or items of all rows side by side
        let mut axes = [(items.stride, self.count), (items.row_stride, rows)];
        axes.sort_by_key(|(stride, _)| stride.unsigned_abs());
        let mut taken = items.bytes();
        for (stride, count) in axes.into_iter().filter(|&(_, count)| count > 1) {
            if stride.unsigned_abs() < taken {
                return Err(invalid(format!(
                    "a stride is {stride} bytes, but it must be at least {taken} or items would \
                     overlap"
                )));
            }
            taken += stride.unsigned_abs() * (count - 1);
        }
        Ok(items)
    }

    /// The bytes of an item.
    fn bytes(&self) -> usize {
        N * bytes_of(self.kind).unwrap_or(0)
    }

    /// Refuses items that would lie outside of all memory.
    fn check_extent(&self, rows: usize) -> Result<(), Failure> {
        let axes = [(self.stride, self.count), (self.row_stride, rows)];
        let (mut below, mut above) = (0_usize, self.bytes());
        for (stride, count) in axes {
            let reach = stride.unsigned_abs().checked_mul(count.saturating_sub(1));
            let side = if stride < 0 { &mut below } else { &mut above };
            *side = reach.and_then(|reach| side.checked_add(reach)).ok_or_else(outside)?;
        }
        let extent = below.checked_add(above).filter(|&bytes| bytes <= isize::MAX as usize);
        let address = self.data.addr();
        let fits = below <= address && address.checked_add(above).is_some();
        if extent.is_some() && (fits || self.count == 0) { Ok(()) } else { Err(outside()) }
    }

    fn check_kind(&self, integers: bool) -> Result<(), Failure> {
        let (fits, right) = match integers {
            true => {
                let kinds = [HP_I32, HP_U32, HP_I64, HP_U64];
                (kinds.contains(&self.kind), "HP_I32, HP_U32, HP_I64 or HP_U64")
            }
            false => ([HP_F32, HP_F64].contains(&self.kind), "HP_F32 or HP_F64"),
        };
        if fits { Ok(()) } else { Err(invalid(format!("its type must be {right}"))) }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Where an item lies.
    pub(crate) fn item(&self, row: usize, place: usize) -> *mut u8 {
        let offset = self.row_stride * row as isize + self.stride * place as isize;
        self.data.wrapping_offset(offset)
    }
}

fn outside() -> Failure {
    invalid("the strides lead to items outside of all memory")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structs::Versioned;

    fn array<T>(numbers: &mut [T], kind: u32, count: u64, byte_stride: i64) -> hp_array {
        let data = numbers.as_mut_ptr().cast();
        hp_array { r#type: kind, data, count, byte_stride, ..hp_array::defaults() }
    }

    fn message<T>(result: Result<T, Failure>) -> String {
        result.map(|_| ()).unwrap_err().message
    }

    #[test]
    fn items_are_read_wherever_they_lie() {
        let mut numbers: Vec<f32> = (0..12).map(|i| i as f32).collect();
        let read = |array: &hp_array| {
            // SAFETY: within the vector above.
            unsafe { Items::<2>::new(array, "x").unwrap().values().unwrap() }
        };
        let packed = array(&mut numbers, HP_F32, 3, 0);
        assert_eq!(read(&packed), [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]]);
        let apart = array(&mut numbers[1..], HP_F32, 3, 16);
        assert_eq!(read(&apart), [[1.0, 2.0], [5.0, 6.0], [9.0, 10.0]]);
        let back = array(&mut numbers[8..], HP_F32, 3, -16);
        assert_eq!(read(&back), [[8.0, 9.0], [4.0, 5.0], [0.0, 1.0]]);
    }

    #[test]
    fn rows_may_be_columns_but_not_overlap() {
        let mut numbers = [0.0_f64; 12];
        let rows = |stride, row_stride| {
            let items = Items::<1>::new(&array(&mut [0.0_f64; 12], HP_F64, 4, stride), "x")?;
            items.in_rows(3, row_stride)
        };
        let columns = Items::<1>::new(&array(&mut numbers, HP_F64, 4, 24), "x").unwrap();
        let columns = columns.in_rows(3, 8).unwrap();
        // SAFETY: within the array above.
        unsafe { columns.write(1, [[1.0], [2.0], [3.0], [4.0]].into_iter()) };
        assert_eq!(numbers, [0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 4.0, 0.0]);
        assert_eq!(rows(0, 0).unwrap().row_stride, 32);
        assert_eq!(rows(16, 0).unwrap().row_stride, 64);
        for (stride, row_stride) in [(8, 16), (16, 16), (4, 0), (24, 4), (-8, 24)] {
            assert!(message(rows(stride, row_stride)).contains("overlap"), "{stride} {row_stride}");
        }
    }

    #[test]
    fn items_outside_of_memory_are_refused() {
        let one = &mut [0.0_f64];
        for (count, stride) in [
            (u64::MAX, 0),
            (1 << 61, 0),
            (2, i64::MAX),
            (2, i64::MIN),
            (1 << 40, -4096),
            (3, i64::MAX / 2),
        ] {
            let list = array(one, HP_F64, count, stride);
            assert!(message(Items::<1>::new(&list, "x")).contains("outside"), "{count} {stride}");
        }
        let items = || Items::<1>::new(&array(&mut [0.0_f64; 4], HP_F64, 4, 0), "x").unwrap();
        for (rows, stride) in [(2, i64::MIN), (3, i64::MAX), (usize::MAX, 0), (1 << 50, -4096)] {
            assert!(message(items().in_rows(rows, stride)).contains("outside"), "{rows} {stride}");
        }
    }

    #[test]
    fn types_are_what_they_should_be() {
        let list = array(&mut [0.5_f64], HP_F64, 1, 0);
        // SAFETY: one number.
        let integers = unsafe { Items::<1>::new(&list, "faces").unwrap().integers() };
        assert!(message(integers).starts_with("faces: its type must be one of integers"));
        for kind in [0, 11, u32::MAX] {
            let list = array(&mut [0.5_f64], kind, 1, 0);
            assert!(message(Items::<1>::new(&list, "x")).starts_with(&format!("type is {kind}")));
        }
        let mut largest = [u64::MAX];
        let list = array(&mut largest, HP_U64, 1, 0);
        // SAFETY: one number.
        let read = unsafe { Items::<1>::new(&list, "x").unwrap().integers().unwrap() };
        assert_eq!(read, [[i128::from(u64::MAX)]]);
    }
}
