//! Values of vertices as tables.

use super::{PointArray, check_arrays};
use crate::WriteError;
use crate::output::{known_format, write_atomically};
use npyz::WriterBuilder;
use std::io::{self, Write};
use std::path::Path;

/// Writes values of vertices that lie at `points`, without the faces, in the given format, or else in the one that the
/// ending of `path` stands for.
///
/// - `.csv`: one row a vertex with the columns `vertex,x,y,z` and those of the arrays; infinities are
///   `inf`;
/// - `.npy`: 64-bit floats of shape (vertices,) if there is one array, else (vertices, arrays).
///
/// # Errors
/// The format is unknown, an array has more or fewer values than there are vertices, the folder is
/// missing, the file exists and `overwrite` is not set, or the operating system refuses.
pub fn write_mesh_values(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    points: &[[f64; 3]],
    arrays: &[PointArray<'_>],
) -> Result<(), WriteError> {
    let path = path.as_ref();
    let format = known_format(path, format, &["csv", "npy"])?;
    check_arrays(path, points.len(), arrays)?;
    write_atomically(path, overwrite, |out| match format {
        "csv" => write_csv(out, points, arrays),
        _ => write_npy(out, points.len(), arrays),
    })
}

fn write_csv(
    out: &mut dyn Write,
    points: &[[f64; 3]],
    arrays: &[PointArray<'_>],
) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let names = arrays.iter().map(|(name, _)| *name);
    writer.write_record(["vertex", "x", "y", "z"].into_iter().chain(names))?;
    for (vertex, point) in points.iter().enumerate() {
        let values = arrays.iter().map(|(_, values)| values[vertex]);
        let numbers = point.iter().copied().chain(values).map(|value| value.to_string());
        writer.write_record([vertex.to_string()].into_iter().chain(numbers))?;
    }
    writer.flush()
}

fn write_npy(out: &mut dyn Write, vertices: usize, arrays: &[PointArray<'_>]) -> io::Result<()> {
    let shape = [vertices as u64, arrays.len() as u64];
    let shape = if arrays.len() == 1 { &shape[..1] } else { &shape[..] };
    let options = npyz::WriteOptions::<f64>::new().default_dtype().shape(shape);
    let mut writer = options.writer(out).begin_nd()?;
    for vertex in 0..vertices {
        writer.extend(arrays.iter().map(|(_, values)| values[vertex]))?;
    }
    writer.finish()
}
