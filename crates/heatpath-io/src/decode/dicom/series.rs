//! The slices of a series in a folder, in order of their places.

use super::elements::{Elements, PREAMBLE};
use super::frame::Frame;
use super::is_dicom;
use crate::decode::volume::Scale;
use crate::decode::{Format, Input, MOST_PIXELS, Raster, Wanted};
use crate::picture::read_bytes;
use crate::placement::{Geometry, Vector, dot};
use crate::sample::Samples;
use crate::{ReadError, memory};
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Slices may lie beside their even places by this part of their distance: positions are often
/// rounded to a tenth of a millimetre.
const UNEVENNESS: f64 = 0.25;

/// A slice, where it came from, and how far along the normal it lies.
struct Slice {
    path: PathBuf,
    frame: Frame,
    height: f64,
}

/// All files of DICOM in a folder, which must be the slices of one volume; other files are left out.
pub(crate) fn decode(folder: &Path, wanted: Wanted<'_>) -> Result<Raster, ReadError> {
    let mut slices = read(folder, wanted)?;
    slices.sort_by(|a, b| a.height.total_cmp(&b.height));
    check(folder, &slices)?;
    let geometry = geometry(&slices).map_err(|reason| broken(folder, &reason))?;
    let [columns, rows] = slices[0].frame.size;
    let (sample, channels) = (slices[0].frame.sample, slices[0].frame.channels);
    let is_scaled = slices.iter().any(|slice| slice.frame.scale != Scale::default());
    let white = slices[0].frame.white.filter(|_| !is_scaled);
    let size = match slices.len() {
        1 => vec![columns, rows],
        count => vec![columns, rows, count],
    };
    let mut parts = slices.into_iter().map(|slice| {
        let (samples, _) = slice.frame.scale.apply(slice.frame.samples);
        if is_scaled { Samples::F64(samples.values(0..samples.len())) } else { samples }
    });
    let mut samples = parts.next().unwrap_or(Samples::U8(Vec::new()));
    parts.for_each(|part| samples.append(part));
    let (format, pages) = (Format::Dicom, size.get(2).copied().unwrap_or(1));
    Ok(Raster {
        format,
        size,
        channels,
        sample,
        samples,
        white,
        pages,
        channel_axis: false,
        geometry,
    })
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
    let mut slices = Vec::new();
    for path in paths {
        if !has_mark(&path)? {
            continue;
        }
        let bytes = read_bytes(&path)?;
        let input = Input { bytes: &bytes, path: &path, format: Format::Dicom, wanted };
        let elements = Elements::parse(&bytes).map_err(|e| input.broken(e))?;
        // A directory of the medium, a report.
        if elements.short(0x0028_0010).is_none() {
            continue;
        }
        let frame = Frame::decode(&input, &elements)?;
        let [columns, rows] = frame.size.map(|side| side as u64);
        let size = vec![columns, rows, slices.len() as u64 + 1];
        let cells = size.iter().fold(1_u64, |cells, &side| cells.saturating_mul(side));
        if cells > MOST_PIXELS {
            return Err(ReadError::TooLarge { path: folder.to_owned(), size, most: MOST_PIXELS });
        }
        memory::check(folder, cells.saturating_mul(8))?;
        let height = frame.normal().zip(frame.position).map_or(0.0, |(n, p)| dot(n, p));
        slices.push(Slice { path, frame, height });
    }
    if slices.is_empty() {
        return Err(broken(folder, "there are no pictures of DICOM in this folder"));
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

/// Refuses what makes no volume; with one slice there is nothing to check.
fn check(folder: &Path, slices: &[Slice]) -> Result<(), ReadError> {
    let first = &slices[0];
    for slice in &slices[1..] {
        let name = slice.path.file_name().unwrap_or_default().to_string_lossy();
        let other = first.path.file_name().unwrap_or_default().to_string_lossy();
        if slice.frame.series != first.frame.series {
            let reason = format!("{other} and {name} belong to two series; one is accepted");
            return Err(broken(folder, &reason));
        }
        if slice.frame.position.is_none() || first.frame.position.is_none() {
            return Err(broken(folder, &format!("{other} and {name}: one has no position")));
        }
        if !slice.frame.is_like(&first.frame) {
            let reason = format!("{other} and {name} differ in size, type, spacing or direction");
            return Err(broken(folder, &reason));
        }
    }
    let distance = mean_distance(slices);
    for (number, slice) in slices.iter().enumerate() {
        let even = first.height + number as f64 * distance;
        // Whatever is not a number is refused too.
        if slices.len() > 1
            && !((slice.height - even).abs() <= UNEVENNESS * distance && distance > 0.0)
        {
            let reason = format!(
                "the slices are not evenly spaced: number {number}, {}, lies at {:.3} along the \
                 normal, not at {even:.3}; one is missing, or there are several volumes",
                slice.path.display(),
                slice.height
            );
            return Err(broken(folder, &reason));
        }
    }
    Ok(())
}

fn mean_distance(slices: &[Slice]) -> f64 {
    let last = slices[slices.len() - 1].height;
    (last - slices[0].height) / (slices.len().max(2) - 1) as f64
}

/// The place of the volume: that of its first slice, and the way from there to the last one.
fn geometry(slices: &[Slice]) -> Result<Option<Geometry>, String> {
    let (first, last) = (&slices[0].frame, &slices[slices.len() - 1].frame);
    let (Some(flat), Some(start), Some(end)) = (first.geometry, first.position, last.position)
    else {
        return Ok(first.geometry);
    };
    if slices.len() == 1 {
        return Ok(Some(flat));
    }
    let gaps = (slices.len() - 1) as f64;
    let between: Vector = std::array::from_fn(|row| (end[row] - start[row]) / gaps);
    let length = dot(between, between).sqrt();
    let [x, y, _] = flat.placement.direction;
    let [width, height, _] = flat.spacing;
    Geometry::new([width, height, length], start, [x, y, between.map(|part| part / length)])
        .map(Some)
}
