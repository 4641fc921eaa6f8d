//! The slices of a series in a folder, in order of their places.

use super::elements::{Elements, PREAMBLE};
use super::frame::Frames;
use super::is_dicom;
use super::stack::{Slice, stacked};
use crate::decode::{Format, Input, MOST_PIXELS, Raster, Wanted};
use crate::picture::read_bytes;
use crate::{ReadError, memory};
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// All files of DICOM in a folder, which must be the slices of one volume; other files are left out.
pub(crate) fn decode(folder: &Path, wanted: Wanted<'_>) -> Result<Raster, ReadError> {
    stacked(read(folder, wanted)?).map_err(|reason| broken(folder, &reason))
}

fn broken(path: &Path, reason: &str) -> ReadError {
    let (path, format, reason) = (path.to_owned(), Format::Dicom, reason.to_owned());
    ReadError::Decode { path, format, reason }
}

fn read(folder: &Path, wanted: Wanted<'_>) -> Result<Vec<Slice>, ReadError> {
    let open = |source| ReadError::Open { path: folder.to_owned(), source };
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(open)? {
        let path = entry.map_err(open)?.path();
        if path.is_file() {
            paths.push(path);
        }
    }
    // The order of a folder is that of chance; messages should not be.
    paths.sort();
    let files = paths.len();
    let mut slices = Vec::new();
    for path in paths {
        if !has_mark(&path)? {
            continue;
        }
        let bytes = read_bytes(&path)?;
        let input = Input { bytes: &bytes, path: &path, format: Format::Dicom, wanted };
        let elements = Elements::parse(&bytes).map_err(|e| input.broken(e))?;
        // A directory of the medium, a report.
        if elements.data.short(0x0028_0010).is_none() {
            continue;
        }
        let frames = Frames::new(&elements).map_err(|e| input.broken(e))?;
        let frame = frames.chosen(&input)?.ok_or_else(|| frames.choice(&input))?;
        let [columns, rows] = frame.size.map(|side| side as u64);
        let size = vec![columns, rows, slices.len() as u64 + 1];
        let cells = size.iter().fold(1_u64, |cells, &side| cells.saturating_mul(side));
        if cells > MOST_PIXELS {
            return Err(ReadError::TooLarge { path: folder.to_owned(), size, most: MOST_PIXELS });
        }
        memory::check(folder, cells.saturating_mul(8))?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        slices.push(Slice::new(name, frame));
    }
    if slices.is_empty() {
        let reason = format!("there are no pictures of DICOM in this folder of {files} files");
        return Err(broken(folder, &reason));
    }
    Ok(slices)
}

/// Whether a file begins as DICOM does; others may be of any size, and are not read.
fn has_mark(path: &Path) -> Result<bool, ReadError> {
    let open = |source| ReadError::Open { path: path.to_owned(), source };
    let mut start = Vec::new();
    let file = File::open(path).map_err(open)?;
    file.take(PREAMBLE as u64 + 4).read_to_end(&mut start).map_err(open)?;
    Ok(is_dicom(&start))
}
