//! Arrays of numpy, through the `npyz` crate.

use super::{Input, Raster, npy_header};
use crate::ReadError;
use crate::sample::{SampleType, Samples};
use npyz::{DType, Deserialize, NpyFile, Order, TypeChar};

type Array<'a> = NpyFile<&'a [u8]>;

/// Both byte orders, C and Fortran order; shape (rows, columns) or (rows, columns, 3 or 4).
pub(super) fn decode(input: &Input<'_>) -> Result<Raster, ReadError> {
    npy_header::check(input.bytes).map_err(|e| input.broken(e))?;
    let array = NpyFile::new(input.bytes).map_err(|e| input.broken(e))?;
    let sample = sample_type(input, &array.dtype())?;
    let (size, channels) = check_shape(input, &array)?;
    let (fortran, [columns, rows]) = (array.order() == Order::Fortran, size);
    let mut samples = read(input, array, sample)?;
    if fortran {
        // The first index runs fastest: row, then column, then channel.
        samples = samples.reordered(|i| {
            let (pixel, channel) = (i / channels, i % channels);
            pixel / columns + rows * (pixel % columns + columns * channel)
        });
    }
    let white = white(sample);
    Ok(Raster { format: input.format, size, channels, sample, samples, white, pages: 1 })
}

fn check_shape(input: &Input<'_>, array: &Array<'_>) -> Result<([usize; 2], usize), ReadError> {
    let (rows, columns, channels) = match *array.shape() {
        [rows, columns] if rows > 0 && columns > 0 => (rows, columns, 1),
        [rows, columns, channels @ (1 | 3 | 4)] if rows > 0 && columns > 0 => {
            (rows, columns, channels)
        }
        _ => {
            let shape = array.shape().to_vec();
            return Err(ReadError::Shape { path: input.path.to_owned(), shape });
        }
    };
    let item = array.dtype().num_bytes().unwrap_or(1) as u64;
    let size = input.check_size([columns, rows], array.len().saturating_mul(item))?;
    Ok((size, channels as usize))
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

fn white(sample: SampleType) -> Option<f64> {
    match sample {
        SampleType::Bool => Some(1.0),
        SampleType::U8 => Some(255.0),
        SampleType::U16 => Some(65535.0),
        _ => None,
    }
}
