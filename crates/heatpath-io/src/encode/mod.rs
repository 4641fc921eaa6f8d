//! Fields and masks as medical volumes, with their place in the world.

mod meta_image;
mod nifti;
mod nrrd;

use crate::output::{check_free, companion, write_atomically};
use crate::placement::Vector;
use crate::{FieldFormat, Placement, WriteError};
use flate2::Compression;
use flate2::write::GzEncoder;
use heatpath_core::grid::Shape;
use std::io::{self, Write};
use std::path::Path;

/// Numbers turned into bytes at once.
const CHUNK: usize = 8192;

/// The numbers of a grid, x running fastest.
#[derive(Clone, Copy)]
pub(crate) enum Numbers<'a> {
    F64(&'a [f64]),
    U8(&'a [u8]),
}

impl Numbers<'_> {
    /// Little-endian bytes.
    fn write(self, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::U8(bytes) => out.write_all(bytes),
            Self::F64(values) => values.chunks(CHUNK).try_for_each(|chunk| {
                let bytes: Vec<u8> = chunk.iter().flat_map(|value| value.to_le_bytes()).collect();
                out.write_all(&bytes)
            }),
        }
    }
}

/// A grid of two or three axes in the world.
pub(crate) struct Volume<'a> {
    size: Vec<usize>,
    /// Of a picture the third one is 1.
    spacing: Vector,
    placement: Placement,
    numbers: Numbers<'a>,
}

impl<'a> Volume<'a> {
    /// Without a placement: at the origin, along the axes of the world. A picture that does not lie
    /// in the plane z = 0 becomes a volume of one slice: ITK knows no others in space.
    pub(crate) fn new<const D: usize>(
        shape: &Shape<D>,
        placement: Option<Placement>,
        numbers: Numbers<'a>,
    ) -> Self {
        let (spacing, placement) = (shape.spacing(), placement.unwrap_or_default());
        let mut size = shape.size().to_vec();
        if !placement.is_flat() {
            size.resize(3, 1);
        }
        let spacing = std::array::from_fn(|axis| spacing.get(axis).copied().unwrap_or(1.0));
        Self { size, spacing, placement, numbers }
    }

    /// Writes the file in one of the formats of volumes; for `.nhdr` and `.mhd` the numbers go to a
    /// file beside it, `a.mhd.raw`.
    pub(crate) fn write(
        &self,
        path: &Path,
        format: FieldFormat,
        overwrite: bool,
    ) -> Result<(), WriteError> {
        let Some(data) =
            matches!(format, FieldFormat::Nhdr | FieldFormat::Mhd).then(|| companion(path))
        else {
            return write_atomically(path, overwrite, |out| self.write_whole(out, format));
        };
        check_free(path, overwrite)?;
        write_atomically(&data, overwrite, |out| self.numbers.write(out))?;
        let name = data.file_name().unwrap_or_default().to_string_lossy();
        let header =
            write_atomically(path, overwrite, |out| self.write_header(out, format, Some(&name)));
        if header.is_err() && !overwrite {
            // Numbers without a header are nobody's; that they cannot be removed says less.
            drop(std::fs::remove_file(&data));
        }
        header
    }

    fn write_whole(&self, out: &mut dyn Write, format: FieldFormat) -> io::Result<()> {
        if format == FieldFormat::NiftiGz {
            let mut zipped = GzEncoder::new(out, Compression::fast());
            self.write_header(&mut zipped, format, None)?;
            self.numbers.write(&mut zipped)?;
            return zipped.finish().map(drop);
        }
        self.write_header(out, format, None)?;
        self.numbers.write(out)
    }

    fn write_header(
        &self,
        out: &mut dyn Write,
        format: FieldFormat,
        data: Option<&str>,
    ) -> io::Result<()> {
        match format {
            FieldFormat::Nifti | FieldFormat::NiftiGz => nifti::write_header(out, self),
            FieldFormat::Mha | FieldFormat::Mhd => meta_image::write_header(out, self, data),
            _ => nrrd::write_header(out, self, data),
        }
    }
}
