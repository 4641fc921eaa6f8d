//! Frames one above another as a volume.

use super::frame::Frame;
use crate::decode::volume::Scale;
use crate::decode::{Format, Raster};
use crate::placement::{Geometry, Vector, dot};
use crate::sample::Samples;

/// Slices may lie beside their even places by this part of their distance: positions are often
/// rounded to a tenth of a millimetre.
const UNEVENNESS: f64 = 0.25;

/// A slice, what it is called in messages, and how far along the normal it lies.
pub(super) struct Slice {
    name: String,
    frame: Frame,
    height: f64,
}

impl Slice {
    pub(super) fn new(name: String, frame: Frame) -> Self {
        let height = frame.normal().zip(frame.position).map_or(0.0, |(n, p)| dot(n, p));
        Self { name, frame, height }
    }
}

/// The volume of one or more slices, in order of their places; of one slice a picture.
pub(super) fn stacked(mut slices: Vec<Slice>) -> Result<Raster, String> {
    slices.sort_by(|a, b| a.height.total_cmp(&b.height));
    check(&slices)?;
    let geometry = geometry(&slices)?;
    let first = &slices[0].frame;
    let (mut size, channels, sample) = (first.size.to_vec(), first.channels, first.sample);
    if slices.len() > 1 {
        size.push(slices.len());
    }
    let is_scaled = slices.iter().any(|slice| slice.frame.scale != Scale::default());
    let white = first.white.filter(|_| !is_scaled);
    let pages = slices.len();
    let mut parts = slices.into_iter().map(|slice| {
        let (samples, _) = slice.frame.scale.apply(slice.frame.samples);
        if is_scaled { Samples::F64(samples.values(0..samples.len())) } else { samples }
    });
    let mut samples = parts.next().unwrap_or(Samples::U8(Vec::new()));
    parts.for_each(|part| samples.append(part));
    let raster = Raster::new(Format::Dicom, size, channels, (sample, samples), white);
    Ok(Raster { pages, geometry, ..raster })
}

/// Refuses what makes no volume; with one slice there is nothing to check.
fn check(slices: &[Slice]) -> Result<(), String> {
    let first = &slices[0];
    for slice in &slices[1..] {
        let (name, other) = (&slice.name, &first.name);
        if slice.frame.series != first.frame.series {
            return Err(format!("{other} and {name} belong to two series; one is accepted"));
        }
        if slice.frame.position.is_none() || first.frame.position.is_none() {
            return Err(format!("{other} and {name}: one has no position"));
        }
        if !slice.frame.is_like(&first.frame) {
            return Err(format!("{other} and {name} differ in size, type, spacing or direction"));
        }
    }
    let distance = mean_distance(slices);
    for (number, slice) in slices.iter().enumerate() {
        let even = first.height + number as f64 * distance;
        // Whatever is not a number is refused too.
        let is_even = (slice.height - even).abs() <= UNEVENNESS * distance && distance > 0.0;
        if slices.len() > 1 && !is_even {
            return Err(format!(
                "the slices are not evenly spaced: number {number}, {}, lies at {:.3} along the \
                 normal, not at {even:.3}; one is missing, or there are several volumes",
                slice.name, slice.height
            ));
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
