//! Curves as they are compared: segments, and short elements that each count once.

use super::EvaluationError;
use crate::grid::skeleton::{Network, smoothed, thin};
use crate::grid::{Grid, Mask, Shape};
use std::collections::HashMap;

/// The longest element, in cell units.
const ELEMENT: f64 = 0.25;

/// The largest total length of curves, in cell units: more is not kept in memory.
const LONGEST: f64 = (1 << 23) as f64;

/// Points farther than this many cells from the origin are refused.
const FARTHEST: f64 = 1e9;

/// A set of curves of which the length and the distance from another set can be measured.
///
/// In memory all is physical: points and lengths are multiplied by the spacing.
#[derive(Clone, Debug)]
pub struct CurveSet<const D: usize> {
    pub(super) spacing: [f64; D],
    size: Option<[usize; D]>,
    curves: Vec<Vec<Segment<D>>>,
    /// In cell units.
    merge: f64,
}

/// A part of a curve.
#[derive(Clone, Copy, Debug)]
struct Segment<const D: usize> {
    ends: [[f64; D]; 2],
    /// What it counts.
    length: f64,
}

impl<const D: usize> CurveSet<D> {
    /// The distance in cell units within which two curves are one: see [`Self::with_merge`].
    pub const MERGE: f64 = 0.5;

    /// The curves whose points, in pixel coordinates, are joined by straight lines; `spacing` is the
    /// physical distance of neighbouring cell centres along each axis.
    ///
    /// Stretches that several curves share count once, as [`Self::with_merge`] says. A curve of a
    /// single point has no length, but one can be near it.
    ///
    /// # Errors
    /// A point is not finite or more than 1e9 cells away, the spacing is not positive and finite, or
    /// the curves are longer than 8 388 608 cells in all.
    pub fn of_polylines(
        polylines: &[impl AsRef<[[f64; D]]>],
        spacing: [f64; D],
    ) -> Result<Self, EvaluationError> {
        let shape = Shape::with_spacing([1; D], spacing)?;
        let mut curves = Vec::with_capacity(polylines.len());
        for (curve, points) in polylines.iter().enumerate() {
            let points = points.as_ref();
            if let Some(point) = points.iter().position(|point| !is_near(point)) {
                return Err(EvaluationError::Point { curve, point });
            }
            curves.push(segments(points, &shape));
        }
        let length: f64 = curves.iter().flatten().map(|segment| segment.length).sum();
        let length = length / shape.smallest_spacing();
        if length > LONGEST {
            return Err(EvaluationError::TooLong { length, longest: LONGEST });
        }
        Ok(Self { spacing, size: None, curves, merge: Self::MERGE })
    }

    /// The centreline of the cells that are true: [`thin`] finds it, unless they are one already.
    ///
    /// Its points are centres of cells, each joined to its neighbours. What a step counts is its length
    /// after smoothing as in [`Graph`](crate::grid::skeleton::Graph): the steps of the grid alone are up
    /// to 8 % longer than the line they stand for.
    #[must_use]
    pub fn of_mask(mask: &Grid<bool, D>) -> Self {
        let shape = *mask.shape();
        let network = Network::new(&thin(mask));
        let alone =
            network.nodes.iter().map(|&cell| vec![segment([shape.centre(cell); 2], &shape)]);
        let chains = network.chains.iter().map(|chain| {
            let centres: Vec<_> = chain.cells.iter().map(|&cell| shape.centre(cell)).collect();
            let lengths = segments(&smoothed(&centres), &shape);
            let steps = segments(&centres, &shape).into_iter().zip(lengths);
            steps.map(|(step, smooth)| Segment { length: smooth.length, ..step }).collect()
        });
        let curves = chains.chain(alone).collect();
        Self { spacing: shape.spacing(), size: Some(shape.size()), curves, merge: 0.0 }
    }

    /// The cells along each axis of the mask that the curves come from, if they do.
    #[must_use]
    pub fn size(&self) -> Option<[usize; D]> {
        self.size
    }

    /// The same curves, where a stretch counts only if it is farther than `merge`, in cell units, from
    /// all that counted of the curves before it.
    ///
    /// Paths to a common source share their way: that way is found once, not once a path. Where two
    /// curves cross or part, up to `merge` of the later one is lost on each side. 0 counts all
    /// curves in full. Default: [`Self::MERGE`] (half a cell) for polylines, and 0 for masks, whose
    /// cells are one curve. Below 1/4 the elements, which are as long, need not meet.
    #[must_use]
    pub fn with_merge(mut self, merge: f64) -> Self {
        self.merge = merge;
        self
    }

    /// Every segment, in physical units.
    pub(super) fn segments(&self) -> Vec<[[f64; D]; 2]> {
        self.curves.iter().flatten().map(|segment| segment.ends).collect()
    }

    /// The middle, in physical units, and the length of each element that counts.
    pub(super) fn elements(&self, view: Option<&Mask<D>>) -> Vec<([f64; D], f64)> {
        let unit = self.spacing.into_iter().fold(f64::INFINITY, f64::min);
        let mut counted = Counted::new(self.merge * unit);
        let mut elements = Vec::new();
        for curve in &self.curves {
            let first = elements.len();
            let parts = curve.iter().flat_map(|segment| segment.elements(ELEMENT * unit));
            let visible = parts.filter(|&(middle, _)| self.is_in(view, middle));
            elements.extend(visible.filter(|&(middle, _)| !counted.is_near(middle)));
            // A curve never merges with itself.
            elements[first..].iter().for_each(|&(middle, _)| counted.insert(middle));
        }
        elements
    }

    fn is_in(&self, view: Option<&Mask<D>>, point: [f64; D]) -> bool {
        let point = std::array::from_fn(|axis| point[axis] / self.spacing[axis]);
        view.is_none_or(|view| view.shape().contains(point) && view.is_open_at(point))
    }
}

impl<const D: usize> Segment<D> {
    /// The middle and the length of equal parts, none longer than `longest`.
    fn elements(self, longest: f64) -> impl Iterator<Item = ([f64; D], f64)> {
        let [from, to] = self.ends;
        let apart = (0..D).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt();
        let parts = (apart / longest).ceil();
        (0..parts as usize).map(move |part| {
            let along = (part as f64 + 0.5) / parts;
            let middle = std::array::from_fn(|axis| from[axis] + along * (to[axis] - from[axis]));
            (middle, self.length / parts)
        })
    }
}

/// The middles of elements that have counted, in buckets.
struct Counted<const D: usize> {
    radius: f64,
    buckets: HashMap<[i64; D], Vec<[f64; D]>>,
}

impl<const D: usize> Counted<D> {
    fn new(radius: f64) -> Self {
        Self { radius, buckets: HashMap::new() }
    }

    fn bucket(&self, point: [f64; D]) -> [i64; D] {
        point.map(|x| (x / (2.0 * self.radius)).floor() as i64)
    }

    fn insert(&mut self, point: [f64; D]) {
        if self.radius > 0.0 {
            self.buckets.entry(self.bucket(point)).or_default().push(point);
        }
    }

    /// Whether an element has counted within the radius: in the up to `2^D` buckets it reaches.
    fn is_near(&self, point: [f64; D]) -> bool {
        if self.buckets.is_empty() {
            return false;
        }
        let is_near = |other: &[f64; D]| {
            let apart_sq: f64 = (0..D).map(|axis| (point[axis] - other[axis]).powi(2)).sum();
            apart_sq <= self.radius * self.radius
        };
        (0..1_usize << D).any(|corner| {
            let bucket = self.bucket(std::array::from_fn(|axis| {
                point[axis] + if corner >> axis & 1 == 0 { -self.radius } else { self.radius }
            }));
            self.buckets.get(&bucket).is_some_and(|points| points.iter().any(is_near))
        })
    }
}

/// Whether a point can be measured.
fn is_near<const D: usize>(point: &[f64; D]) -> bool {
    point.iter().all(|x| x.abs() <= FARTHEST)
}

fn segments<const D: usize>(points: &[[f64; D]], shape: &Shape<D>) -> Vec<Segment<D>> {
    match points {
        [point] => vec![segment([*point; 2], shape)],
        _ => points.windows(2).map(|pair| segment([pair[0], pair[1]], shape)).collect(),
    }
}

fn segment<const D: usize>(ends: [[f64; D]; 2], shape: &Shape<D>) -> Segment<D> {
    let length = shape.physical_distance(ends[0], ends[1]);
    let physical =
        |point: [f64; D]| std::array::from_fn(|axis| point[axis] * shape.spacing()[axis]);
    Segment { ends: ends.map(physical), length }
}
