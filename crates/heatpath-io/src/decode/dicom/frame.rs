//! One frame of a DICOM file: its samples and its place.

use super::elements::Elements;
use super::pixels::{Compression, Layout};
use crate::ReadError;
use crate::decode::Input;
use crate::decode::volume::{Scale, samples};
use crate::placement::{Geometry, Placement, Vector, cross, dot};
use crate::sample::{SampleType, Samples};

/// A decoded frame.
pub(super) struct Frame {
    /// Columns and rows.
    pub(super) size: [usize; 2],
    pub(super) channels: usize,
    pub(super) sample: SampleType,
    /// As stored.
    pub(super) samples: Samples,
    pub(super) scale: Scale,
    /// The largest stored value, if that is known.
    pub(super) white: Option<f64>,
    pub(super) geometry: Option<Geometry>,
    /// Where the first pixel lies in the patient.
    pub(super) position: Option<Vector>,
    pub(super) series: String,
}

impl Frame {
    /// The frame that is wanted of a file that has been parsed.
    pub(super) fn decode(input: &Input<'_>, elements: &Elements<'_>) -> Result<Self, ReadError> {
        let broken = |reason: String| input.broken(reason);
        let layout = Layout::new(elements).map_err(broken)?;
        let compression = Compression::new(&elements.transfer_syntax).map_err(broken)?;
        let frame = choose(input, &layout)?;
        let claimed = [u64::from(layout.columns), u64::from(layout.rows)];
        let size = input.check_size(&claimed, layout.least_bytes(compression))?;
        let size = [size[0], size[1]];
        let bytes = compression.frame(elements, &layout, frame).map_err(broken)?;
        let samples = samples(
            &bytes,
            layout.sample(),
            elements.is_big_endian && elements.fragments.is_none(),
        )
        .map_err(broken)?;
        let geometry = geometry(elements).map_err(broken)?;
        Ok(Self {
            size,
            channels: usize::from(layout.channels),
            sample: layout.sample(),
            samples: layout.unused_bits_cleared(samples),
            scale: scale(elements).map_err(broken)?,
            white: layout.white(),
            geometry: geometry.map(|(geometry, _)| geometry),
            position: geometry.and_then(|(_, position)| position),
            series: elements.text(0x0020_000e).unwrap_or_default(),
        })
    }

    /// The unit vector on the plane of the frame.
    pub(super) fn normal(&self) -> Option<Vector> {
        Some(self.geometry?.placement.direction[2])
    }

    /// Whether both can be slices of one volume.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let alike = |a: &Geometry, b: &Geometry| {
            let [spacing, other] = [a.spacing, b.spacing];
            let same_size = (0..2).all(|i| (spacing[i] - other[i]).abs() <= 1e-3 * spacing[i]);
            let axes = a.placement.direction.iter().zip(b.placement.direction);
            same_size && axes.into_iter().all(|(x, y)| dot(*x, y) > 1.0 - 1e-5)
        };
        let places = self.geometry.as_ref().zip(other.geometry.as_ref());
        (self.size, self.channels, self.sample) == (other.size, other.channels, other.sample)
            && places.is_some_and(|(a, b)| alike(a, b))
    }
}

fn choose(input: &Input<'_>, layout: &Layout) -> Result<usize, ReadError> {
    match input.wanted.component {
        None if layout.frames == 1 => Ok(0),
        Some(component) if component < layout.frames => Ok(component),
        _ => {
            let (path, count) = (input.path.to_owned(), layout.frames as u64);
            Err(ReadError::Component { path, count })
        }
    }
}

fn scale(elements: &Elements<'_>) -> Result<Scale, String> {
    let [slope, intercept] = [0x0028_1053, 0x0028_1052].map(|tag| elements.array::<1>(tag));
    let slope = slope?.map_or(1.0, |[slope]| slope);
    let intercept = intercept?.map_or(0.0, |[intercept]| intercept);
    Ok(Scale { slope, intercept })
}

/// Where the pixels lie, and whether the file says where the first one is.
fn geometry(elements: &Elements<'_>) -> Result<Option<(Geometry, Option<Vector>)>, String> {
    let spacing = match elements.array::<2>(0x0028_0030)? {
        None => elements.array::<2>(0x0018_1164)?,
        given => given,
    };
    let Some([rows, columns]) = spacing else { return Ok(None) };
    let position = elements.array::<3>(0x0020_0032)?;
    let direction = match elements.array::<6>(0x0020_0037)? {
        None => Placement::default().direction,
        Some([a, b, c, d, e, f]) => {
            let [x, y] =
                [[a, b, c], [d, e, f]].map(|v: Vector| v.map(|part| part / dot(v, v).sqrt()));
            [x, y, cross(x, y)]
        }
    };
    let origin = position.unwrap_or_default();
    let geometry = Geometry::new([columns, rows, 1.0], origin, direction)?;
    Ok(Some((geometry, position)))
}
