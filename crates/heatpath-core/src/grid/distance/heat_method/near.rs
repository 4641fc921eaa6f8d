//! Circles around the sources, where differences across faces are far from slopes times lengths.

use crate::grid::{Mask, Shape, Sources};

/// How far around a source its circles count, in cells.
const RADIUS: f64 = 12.0;

/// Up to this many cells around a source its circles are all that counts.
const CLOSEST: f64 = 2.5;

/// The source nearest to each cell, around the sources.
pub(super) struct Near<'a, const D: usize> {
    shape: Shape<D>,
    points: &'a [[f64; D]],
    /// The number of the nearest source, if it is near and there are no walls in the box between.
    nearest: Vec<u32>,
}

/// No source is near.
const NONE: u32 = u32::MAX;

impl<'a, const D: usize> Near<'a, D> {
    pub(super) fn new(mask: &Mask<D>, sources: &'a Sources<D>) -> Self {
        let (shape, points) = (*mask.shape(), sources.points());
        let (mut nearest, mut lengths) =
            (vec![NONE; shape.cells()], vec![f64::INFINITY; shape.cells()]);
        let mut seen = vec![NONE; shape.cells()];
        for (number, &point) in (0..).zip(points) {
            let source = shape.cell_at(point);
            for index in outwards(&shape, point) {
                let cell = shape.position(index);
                // Towards the source along each axis.
                let mut before = (0..D)
                    .filter(|&axis| index[axis] != source[axis])
                    .map(|axis| towards(&shape, cell, axis, index[axis] > source[axis]));
                if !mask.is_open(cell) || !before.all(|cell| seen[cell] == number) {
                    continue;
                }
                seen[cell] = number;
                let length = shape.physical_distance(point, shape.centre(cell));
                if length < lengths[cell] {
                    (lengths[cell], nearest[cell]) = (length, number);
                }
            }
        }
        Self { shape, points, nearest }
    }

    /// How much longer the straight way from the source to the second of two neighbours is than to
    /// the first, given what its slopes along `axis` in both make of that: corrected close to a
    /// source, exact next to it.
    pub(super) fn corrected(&self, axis: usize, ends: [usize; 2], difference: f64) -> f64 {
        let [source, other] = ends.map(|cell| self.nearest[cell]);
        if source != other || source == NONE {
            return difference;
        }
        let from = self.points[source as usize];
        let lengths = ends.map(|cell| self.shape.physical_distance(from, self.shape.centre(cell)));
        let exact = lengths[1] - lengths[0];
        if ends.iter().all(|&cell| self.is_closest(from, cell)) {
            return exact;
        }
        let spacing = self.shape.spacing()[axis];
        let slope = |end: usize| {
            let along = (self.shape.centre(ends[end])[axis] - from[axis]) * spacing;
            if lengths[end] > 0.0 { along / lengths[end] } else { 0.0 }
        };
        difference + exact - 0.5 * spacing * (slope(0) + slope(1))
    }

    fn is_closest(&self, from: [f64; D], cell: usize) -> bool {
        let centre = self.shape.centre(cell);
        (0..D).all(|axis| (centre[axis] - from[axis]).abs() <= CLOSEST)
    }
}

fn towards<const D: usize>(shape: &Shape<D>, cell: usize, axis: usize, down: bool) -> usize {
    if down { cell - shape.stride(axis) } else { cell + shape.stride(axis) }
}

/// The cells in a box around a point, each after those between it and the point.
fn outwards<const D: usize>(shape: &Shape<D>, point: [f64; D]) -> Vec<[usize; D]> {
    let low = shape.cell_at(point.map(|x| x - RADIUS));
    let high = shape.cell_at(point.map(|x| x + RADIUS));
    let centre = shape.cell_at(point);
    let around = shape.with_size(std::array::from_fn(|axis| high[axis] - low[axis] + 1));
    let steps = (0..around.cells()).map(|cell| around.index(cell));
    let mut cells: Vec<[usize; D]> =
        steps.map(|step| std::array::from_fn(|axis| low[axis] + step[axis])).collect();
    cells.sort_by_key(|index| -> usize {
        (0..D).map(|axis| index[axis].abs_diff(centre[axis])).sum()
    });
    cells
}
