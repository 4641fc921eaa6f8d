//! The frames of a DICOM file: their samples and their places.

use super::descriptions::Descriptions;
use super::elements::Elements;
use super::layout::Layout;
use super::palette::Palette;
use super::pixels::Compression;
use crate::ReadError;
use crate::decode::Input;
use crate::decode::palette::{Coloured, coloured};
use crate::decode::volume::{Scale, samples};
use crate::memory;
use crate::placement::{Geometry, Vector, dot};
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
    /// The unit vector on the plane of the frame.
    pub(super) fn normal(&self) -> Option<Vector> {
        Some(self.geometry?.placement.direction[2])
    }

    /// Whether both can be slices of one volume.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let alike = |a: &Geometry, b: &Geometry| {
            let [one, two] = [a.spacing, b.spacing];
            let same_size = (0..2).all(|i| (one[i] - two[i]).abs() <= 1e-3 * one[i]);
            let axes = a.placement.direction.iter().zip(b.placement.direction);
            same_size && axes.into_iter().all(|(x, y)| dot(*x, y) > 1.0 - 1e-5)
        };
        let places = self.geometry.as_ref().zip(other.geometry.as_ref());
        (self.size, self.channels, self.sample) == (other.size, other.channels, other.sample)
            && places.is_some_and(|(a, b)| alike(a, b))
    }
}

/// The frames of a file that has been parsed.
pub(super) struct Frames<'a> {
    elements: &'a Elements<'a>,
    descriptions: Descriptions<'a>,
    compression: Compression,
    layout: Layout,
    palette: Option<Palette>,
}

impl<'a> Frames<'a> {
    pub(super) fn new(elements: &'a Elements<'a>) -> Result<Self, String> {
        let compression = Compression::new(&elements.transfer_syntax)?;
        let layout = Layout::new(&elements.data, compression)?;
        let palette = layout.is_palette.then(|| Palette::new(&elements.data, layout.is_signed));
        let descriptions = Descriptions::new(&elements.data, layout.frames)?;
        Ok(Self { elements, descriptions, compression, layout, palette: palette.transpose()? })
    }

    /// The slices of a volume; none if the frames do not say where they lie.
    pub(super) fn slices(&self, input: &Input<'_>) -> Result<Option<Vec<Frame>>, ReadError> {
        if !self.descriptions.are_slices().map_err(|e| input.broken(e))? {
            return Ok(None);
        }
        self.check_size(input, self.layout.frames)?;
        (0..self.layout.frames)
            .map(|frame| self.decode(input, frame))
            .collect::<Result<_, _>>()
            .map(Some)
    }

    /// The one that is wanted; none if there are several and none is.
    pub(super) fn chosen(&self, input: &Input<'_>) -> Result<Option<Frame>, ReadError> {
        match input.wanted.component {
            None if self.layout.frames > 1 => Ok(None),
            None => self.decode(input, 0).map(Some),
            Some(frame) if frame < self.layout.frames => self.decode(input, frame).map(Some),
            Some(_) => Err(self.choice(input)),
        }
    }

    /// That one must be chosen.
    pub(super) fn choice(&self, input: &Input<'_>) -> ReadError {
        ReadError::Component { path: input.path.to_owned(), count: self.layout.frames as u64 }
    }

    fn check_size(&self, input: &Input<'_>, frames: usize) -> Result<Vec<usize>, ReadError> {
        let mut size = vec![u64::from(self.layout.columns), u64::from(self.layout.rows)];
        if frames > 1 {
            size.push(frames as u64);
        }
        input.check_size(&size, self.layout.least_bytes(self.compression))
    }

    fn decode(&self, input: &Input<'_>, frame: usize) -> Result<Frame, ReadError> {
        let size = self.check_size(input, 1)?;
        let working = self.compression.working_bytes();
        memory::check(input.path, self.layout.frame_samples().saturating_mul(working))?;
        let (samples, scale) = self.samples(frame).map_err(|e| input.broken(e))?;
        let place = self.descriptions.geometry(frame).map_err(|e| input.broken(e))?;
        Ok(Frame {
            size: [size[0], size[1]],
            channels: samples.channels,
            sample: samples.sample,
            samples: samples.samples,
            scale,
            white: samples.white,
            geometry: place.map(|(geometry, _)| geometry),
            position: place.and_then(|(_, position)| position),
            series: self.elements.data.text(0x0020_000e).unwrap_or_default(),
        })
    }

    fn samples(&self, frame: usize) -> Result<(Coloured, Scale), String> {
        let layout = &self.layout;
        let bytes = self.compression.frame(self.elements, layout, frame)?;
        let is_big_endian =
            self.elements.data.encoding.is_big_endian && self.elements.fragments.is_none();
        let samples = layout.unused_bits_cleared(samples(&bytes, layout.stored(), is_big_endian)?);
        if let Some(palette) = &self.palette {
            let places =
                samples.values(0..samples.len()).into_iter().map(|pixel| palette.place(pixel));
            return Ok((coloured(places, &palette.colours), Scale::default()));
        }
        let (channels, sample, white) =
            (usize::from(layout.channels), layout.sample(), layout.white());
        Ok((Coloured { channels, sample, samples, white }, self.descriptions.scale(frame)?))
    }
}
