//! What a file says of each frame: for all of them, or for each in functional groups.

use super::elements::{DataSet, Tag};
use crate::decode::volume::Scale;
use crate::placement::{Geometry, Placement, Vector, cross, dot};

/// Functional groups (DICOM PS3.3, C.7.6.16): those of all frames and those of each.
const SHARED: Tag = 0x5200_9229;
const PER_FRAME: Tag = 0x5200_9230;

/// The groups that hold a position, a direction, a spacing, a slope.
const PLANE_POSITION: Tag = 0x0020_9113;
const PLANE_ORIENTATION: Tag = 0x0020_9116;
const PIXEL_MEASURES: Tag = 0x0028_9110;
const PIXEL_VALUES: Tag = 0x0028_9145;

/// What nuclear medicine says of its detectors; of a tomography there is one.
const DETECTORS: Tag = 0x0054_0022;

/// By which element the frames follow one another, and those by which they are slices: of nuclear
/// medicine and of captures.
const FRAME_ORDER: Tag = 0x0028_0009;
const BY_SLICE: [[u16; 2]; 2] = [[0x0054, 0x0080], [0x0018, 0x2005]];

const POSITION: Tag = 0x0020_0032;
const ORIENTATION: Tag = 0x0020_0037;
const SPACING: Tag = 0x0028_0030;
const DETECTOR_SPACING: Tag = 0x0018_1164;
const BETWEEN_SLICES: Tag = 0x0018_0088;
const GRID_OFFSETS: Tag = 0x3004_000c;
const SLOPE: Tag = 0x0028_1053;
const INTERCEPT: Tag = 0x0028_1052;

pub(super) struct Descriptions<'a> {
    file: &'a DataSet<'a>,
    frames: Vec<DataSet<'a>>,
    /// The groups of all frames.
    shared: Vec<(Tag, Vec<DataSet<'a>>)>,
    detectors: Vec<DataSet<'a>>,
    /// How far along the normal the frames lie, if a list says so.
    offsets: Option<Vec<f64>>,
    /// How far each frame lies from the one before it, if they are that regular.
    between: Option<f64>,
}

impl<'a> Descriptions<'a> {
    /// Of a file of `count` frames.
    pub(super) fn new(file: &'a DataSet<'a>, count: usize) -> Result<Self, String> {
        let is_single = count == 1;
        let between = file.array(BETWEEN_SLICES)?.map(|[distance]| distance);
        let mut shared = Vec::new();
        for groups in file.items(SHARED)?.iter().take(1) {
            for tag in [PLANE_POSITION, PLANE_ORIENTATION, PIXEL_MEASURES, PIXEL_VALUES] {
                shared.push((tag, groups.items(tag)?));
            }
        }
        Ok(Self {
            file,
            frames: file.items(PER_FRAME)?,
            shared,
            detectors: file.items(DETECTORS)?,
            offsets: file.numbers(GRID_OFFSETS)?.filter(|_| !is_single),
            between: between.filter(|_| !is_single && follow_by_slice(file)),
        })
    }

    /// Whether the frames are slices with a place each.
    pub(super) fn are_slices(&self) -> Result<bool, String> {
        let has_position = match self.frames.first() {
            Some(frame) => !frame.items(PLANE_POSITION)?.is_empty(),
            None => self.offsets.is_some() || self.between.is_some(),
        };
        Ok(has_position && self.spacing(0)?.is_some())
    }

    /// Where the pixels of a frame lie, and whether the file says where the first one is.
    pub(super) fn geometry(
        &self,
        frame: usize,
    ) -> Result<Option<(Geometry, Option<Vector>)>, String> {
        let Some([rows, columns]) = self.spacing(frame)? else { return Ok(None) };
        let direction = match self.array::<6>(frame, PLANE_ORIENTATION, ORIENTATION)? {
            None => Placement::default().direction,
            Some([a, b, c, d, e, f]) => {
                let [x, y] =
                    [[a, b, c], [d, e, f]].map(|v: Vector| v.map(|part| part / dot(v, v).sqrt()));
                [x, y, cross(x, y)]
            }
        };
        let given = self.array::<3>(frame, PLANE_POSITION, POSITION)?;
        let position = match self.offset(frame)? {
            None => given,
            Some(offset) => {
                let first = given.unwrap_or_default();
                Some(std::array::from_fn(|row| first[row] + offset * direction[2][row]))
            }
        };
        let origin = position.unwrap_or_default();
        let geometry = Geometry::new([columns, rows, 1.0], origin, direction)?;
        Ok(Some((geometry, position)))
    }

    /// How stored numbers become values.
    pub(super) fn scale(&self, frame: usize) -> Result<Scale, String> {
        let number = |tag, usual| {
            let found = self.array::<1>(frame, PIXEL_VALUES, tag)?;
            Ok::<_, String>(found.map_or(usual, |[number]| number))
        };
        Ok(Scale { slope: number(SLOPE, 1.0)?, intercept: number(INTERCEPT, 0.0)? })
    }

    /// Between rows and between columns.
    fn spacing(&self, frame: usize) -> Result<Option<[f64; 2]>, String> {
        match self.array(frame, PIXEL_MEASURES, SPACING)? {
            None => self.file.array(DETECTOR_SPACING),
            given => Ok(given),
        }
    }

    /// How far along the normal a frame lies from the position of the file; none if it has its own.
    fn offset(&self, frame: usize) -> Result<Option<f64>, String> {
        if !self.frames.is_empty() {
            return Ok(None);
        }
        let Some(offsets) = &self.offsets else {
            return Ok(self.between.map(|distance| distance * frame as f64));
        };
        let (count, number) = (offsets.len(), frame + 1);
        let offset = offsets.get(frame).map(|offset| Some(offset - offsets[0]));
        offset.ok_or_else(|| {
            format!("the offsets of frames end with {count}; there is none {number}")
        })
    }

    /// Numbers of a functional group of a frame or of all frames, else of the detector, else of the file.
    fn array<const N: usize>(
        &self,
        frame: usize,
        group: Tag,
        tag: Tag,
    ) -> Result<Option<[f64; N]>, String> {
        let own = self.frames.get(frame).map_or_else(|| Ok(Vec::new()), |set| set.items(group))?;
        let shared = self.shared.iter().filter(|(name, _)| *name == group);
        let items = own.iter().chain(shared.flat_map(|(_, items)| items)).chain(&self.detectors);
        for item in items {
            if let Some(found) = item.array(tag)? {
                return Ok(Some(found));
            }
        }
        self.file.array(tag)
    }
}

/// Whether nothing but the place differs from frame to frame, as far as the file says.
fn follow_by_slice(file: &DataSet<'_>) -> bool {
    let order: Vec<u16> = file.shorts(FRAME_ORDER).collect();
    order.is_empty() || BY_SLICE.iter().any(|by| order == by)
}
