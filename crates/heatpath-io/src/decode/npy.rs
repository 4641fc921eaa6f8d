//! Arrays of numpy, through the `npyz` crate.

use super::{Input, Raster, npy_header};
use crate::ReadError;
use crate::sample::{SampleType, Samples};
use npyz::{DType, Deserialize, NpyFile, Order, TypeChar};

type Array<'a> = NpyFile<&'a [u8]>;

/// Both byte orders, C and Fortran order; shape (rows, columns), (rows, columns, 3 or 4) in colour,
/// (slices, rows, columns), or (slices, rows, columns, 6) of tensors.
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    npy_header::check(input.bytes).map_err(|e| input.broken(e))?;
    let array = NpyFile::new(input.bytes).map_err(|e| input.broken(e))?;
    let sample = sample_type(input, &array.dtype())?;
    let (size, channels) = check_shape(input, &array)?;
    let channel_axis = size.len() < array.shape().len();
    let fortran = (array.order() == Order::Fortran).then(|| array.shape().to_vec());
    let mut samples = read(input, array, sample)?;
    if let Some(shape) = fortran {
        samples = samples.reordered(|i| fortran_position(&shape, i));
    }
    let raster = Raster::new(input.format, size, channels, (sample, samples), sample.white());
    Ok(Raster { channel_axis, ..raster })
}

/// An array of shape (values,) or (values, 1).
pub(super) fn vector(input: &Input<'_>) -> Result<Vec<f64>, ReadError> {
    npy_header::check(input.bytes).map_err(|e| input.broken(e))?;
    let array = NpyFile::new(input.bytes).map_err(|e| input.broken(e))?;
    let sample = sample_type(input, &array.dtype())?;
    let (&[length] | &[length, 1]) = array.shape() else {
        let (path, shape) = (input.path.to_owned(), array.shape().to_vec());
        return Err(ReadError::Vector { path, shape });
    };
    let item = array.dtype().num_bytes().unwrap_or(1) as u64;
    input.check_size(&[length], length.saturating_mul(item))?;
    let samples = read(input, array, sample)?;
    Ok(samples.values(0..samples.len()))
}

/// Where the element at position `i` of C order, in which the last index runs fastest, stands in
/// Fortran order, in which the first one does.
fn fortran_position(shape: &[u64], i: usize) -> usize {
    let mut rest = i;
    shape.iter().rev().fold(0, |position, &side| {
        let index = rest % side as usize;
        rest /= side as usize;
        position * side as usize + index
    })
}

fn check_shape(input: &Input<'_>, array: &Array<'_>) -> Result<(Vec<usize>, usize), ReadError> {
    let shape = array.shape().to_vec();
    let (size, channels) = match *shape {
        _ if shape.contains(&0) => (Vec::new(), 0),
        [rows, columns] => (vec![columns, rows], 1),
        [rows, columns, channels @ (1 | 3 | 4)] => (vec![columns, rows], channels as usize),
        [slices, rows, columns] => (vec![columns, rows, slices], 1),
        [slices, rows, columns, 6] => (vec![columns, rows, slices], 6),
        _ => (Vec::new(), 0),
    };
    if size.is_empty() {
        return Err(ReadError::Shape { path: input.path.to_owned(), shape });
    }
    let item = array.dtype().num_bytes().unwrap_or(1) as u64;
    let size = input.check_size(&size, array.len().saturating_mul(item))?;
    Ok((size, channels))
}

fn sample_type(input: &Input<'_>, dtype: &DType) -> Result<SampleType, ReadError> {
    let DType::Plain(plain) = dtype else {
        return Err(input.wrong_type(format!("{} (structured)", dtype.descr())));
    };
    Ok(match (plain.type_char(), plain.size_field()) {
        (TypeChar::Bool, 1) => SampleType::Bool,
        (TypeChar::Uint, 1) => SampleType::U8,
        (TypeChar::Uint, 2) => SampleType::U16,
        (TypeChar::Uint, 4) => SampleType::U32,
        (TypeChar::Uint, 8) => SampleType::U64,
        (TypeChar::Int, 1) => SampleType::I8,
        (TypeChar::Int, 2) => SampleType::I16,
        (TypeChar::Int, 4) => SampleType::I32,
        (TypeChar::Int, 8) => SampleType::I64,
        (TypeChar::Float, 4) => SampleType::F32,
        (TypeChar::Float, 8) => SampleType::F64,
        _ => return Err(input.wrong_type(dtype.descr())),
    })
}

fn read(input: &Input<'_>, array: Array<'_>, sample: SampleType) -> Result<Samples, ReadError> {
    Ok(match sample {
        SampleType::Bool => {
            Samples::U8(elements::<bool>(input, array)?.into_iter().map(u8::from).collect())
        }
        SampleType::U8 => Samples::U8(elements(input, array)?),
        SampleType::U16 => Samples::U16(elements(input, array)?),
        SampleType::U32 => Samples::U32(elements(input, array)?),
        SampleType::U64 => Samples::U64(elements(input, array)?),
        SampleType::I8 => Samples::I8(elements(input, array)?),
        SampleType::I16 => Samples::I16(elements(input, array)?),
        SampleType::I32 => Samples::I32(elements(input, array)?),
        SampleType::I64 => Samples::I64(elements(input, array)?),
        SampleType::F32 => Samples::F32(elements(input, array)?),
        SampleType::F64 => Samples::F64(elements(input, array)?),
        SampleType::F16 => return Err(input.wrong_type(sample)),
    })
}

fn elements<T: Deserialize>(input: &Input<'_>, array: Array<'_>) -> Result<Vec<T>, ReadError> {
    array.into_vec().map_err(|e| input.broken(e))
}
