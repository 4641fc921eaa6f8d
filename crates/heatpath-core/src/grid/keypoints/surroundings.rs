//! The tubes around a key point, and the curves in them.

use super::Link;
use super::search::Search;
use super::window::box_around;
use crate::grid::skeleton::radii;
use crate::grid::{Grid, structure};

/// The structure around a point: how far its edge is, at most half a radius, as circles are wider than
/// tubes. All lengths are in cell units.
pub(super) struct Surroundings<const D: usize> {
    low: [usize; D],
    radii: Grid<f64, D>,
}

/// The point of some links that is nearest to another.
#[derive(Clone, Copy)]
pub(super) struct Foot {
    pub(super) link: usize,
    /// Its number on the path of the link.
    pub(super) point: usize,
    pub(super) distance: f64,
}

/// How many cells a path may lie beside the middle of its tube.
const BESIDE: usize = 3;

impl<const D: usize> Surroundings<D> {
    /// Of a point as far as a circle around it, and as far as its tube may be wide.
    pub(super) fn new(search: &Search<'_, D>, point: [f64; D]) -> Self {
        let radius = search.options.radius;
        let (low, size) = box_around(search.medium.shape(), point, (1.5 * radius).ceil() as usize);
        let medium = search.medium.cropped(low, size);
        let unit = medium.shape().smallest_spacing();
        let radii = radii(&structure(&medium, search.options.least_speed_sq))
            .map(|depth| (depth / unit).min(0.5 * radius));
        Self { low, radii }
    }

    /// How far the edge of the structure is from a point, 0 outside of it.
    pub(super) fn depth(&self, point: [f64; D]) -> f64 {
        let inside = self.inside(point);
        if self.radii.shape().contains(inside) { self.radii.sample(inside) } else { 0.0 }
    }

    /// The radius of the tube in which a curve passes by a point.
    pub(super) fn radius(&self, point: [f64; D]) -> f64 {
        let (shape, inside) = (self.radii.shape(), self.inside(point));
        if !shape.contains(inside) {
            return 0.0;
        }
        let around = shape.box_around(shape.position(shape.cell_at(inside)), BESIDE);
        around.map(|cell| self.radii.values()[cell]).fold(0.0, f64::max)
    }

    fn inside(&self, point: [f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| point[axis] - self.low[axis] as f64)
    }
}

impl<const D: usize> Search<'_, D> {
    /// The physical distance of two points in cell units.
    pub(super) fn apart(&self, a: [f64; D], b: [f64; D]) -> f64 {
        let shape = self.medium.shape();
        shape.physical_distance(a, b) / shape.smallest_spacing()
    }

    /// The nearest point of the `links` with some `numbers`.
    pub(super) fn foot(
        &self,
        links: &[Link<D>],
        numbers: &[usize],
        point: [f64; D],
    ) -> Option<Foot> {
        let of_link = |&link: &usize| {
            let points = links[link].path.points.iter().enumerate();
            points.map(move |(number, &other)| (link, number, self.apart(point, other)))
        };
        let feet = numbers.iter().flat_map(of_link);
        let nearest = feet.min_by(|a, b| a.2.total_cmp(&b.2))?;
        Some(Foot { link: nearest.0, point: nearest.1, distance: nearest.2 })
    }
}
