//! The tubes around a key point, and the curves in them.

use super::Link;
use super::search::Search;
use super::window::box_around;
use crate::grid::sample::corners;
use crate::grid::skeleton::radii;
use crate::grid::{Grid, structure};

/// The structure around a point: how far its edge is. All lengths are in cell units.
pub(super) struct Surroundings<'a, 'm, const D: usize> {
    search: &'a Search<'m, D>,
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

impl<'a, 'm, const D: usize> Surroundings<'a, 'm, D> {
    /// Of a point as far as a circle around it, and as far as its tube may be wide.
    pub(super) fn new(search: &'a Search<'m, D>, point: [f64; D]) -> Self {
        let radius = search.options.radius;
        let (low, size) = box_around(search.medium.shape(), point, (1.5 * radius).ceil() as usize);
        let medium = search.medium.cropped(low, size);
        let radii = radii(&structure(&medium, search.options.least_speed_sq));
        Self { search, low, radii }
    }

    /// How far the edge of the structure is from a point, 0 outside of it.
    pub(super) fn depth(&self, point: [f64; D]) -> f64 {
        let inside = self.inside(point);
        if !self.radii.shape().contains(inside) {
            return 0.0;
        }
        let parts = corners(self.radii.shape(), inside)
            .map(|(cell, weight)| weight * self.limited(self.radii.values()[cell]));
        parts.sum()
    }

    /// The radius of the tube in which a curve passes by a point.
    pub(super) fn radius(&self, point: [f64; D]) -> f64 {
        let (shape, inside) = (self.radii.shape(), self.inside(point));
        if !shape.contains(inside) {
            return 0.0;
        }
        let around = shape.box_around(shape.position(shape.cell_at(inside)), BESIDE);
        around.map(|cell| self.limited(self.radii.values()[cell])).fold(0.0, f64::max)
    }

    /// In cell units; circles are wider than tubes.
    fn limited(&self, radius: f64) -> f64 {
        let cells = radius / self.radii.shape().smallest_spacing();
        cells.min(0.5 * self.search.options.radius)
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
