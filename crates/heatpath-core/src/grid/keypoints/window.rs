//! The part of a medium around a key point, and the heat in it.

use super::KeyPointError;
use crate::Exec;
use crate::grid::distance::{DistanceMap, NOT_REACHED, interpolated, normalized};
use crate::grid::heat::{Duration, Explicit, Heat, HeatOptions, Step};
use crate::grid::medium::Medium;
use crate::grid::path::{Descent, Ending, Path, PathOptions};
use crate::grid::{Shape, Sources};

/// The cells at most some cells away from a point along every axis, as a medium of their own.
#[derive(Clone, Debug)]
pub(super) struct Window<const D: usize> {
    pub(super) low: [usize; D],
    pub(super) medium: Medium<D>,
}

impl<const D: usize> Window<D> {
    pub(super) fn around(medium: &Medium<D>, point: [f64; D], cells: usize) -> Self {
        let (low, size) = box_around(medium.shape(), point, cells);
        Self { low, medium: medium.cropped(low, size) }
    }

    /// A point of the whole in the pixel coordinates of the window.
    pub(super) fn inside(&self, point: [f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| point[axis] - self.low[axis] as f64)
    }

    pub(super) fn outside(&self, point: [f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| point[axis] + self.low[axis] as f64)
    }

    /// A path in the window, in the pixel coordinates of the whole, to the key point `parent`.
    pub(super) fn outward(&self, path: Path<D>, parent: usize) -> Path<D> {
        let points = path.points.into_iter().map(|point| self.outside(point)).collect();
        Path { points, ending: Ending::Source(parent), ..path }
    }
}

/// The first cell and the size of the box of cells at most so many `cells` away from those around a
/// point.
pub(super) fn box_around<const D: usize>(
    shape: &Shape<D>,
    point: [f64; D],
    cells: usize,
) -> ([usize; D], [usize; D]) {
    let last = shape.size().map(|n| n - 1);
    let low: [usize; D] = std::array::from_fn(|axis| {
        (point[axis].floor().max(0.0) as usize).min(last[axis]).saturating_sub(cells)
    });
    let size = std::array::from_fn(|axis| {
        (point[axis].ceil().max(0.0) as usize + cells).min(last[axis]) + 1 - low[axis]
    });
    (low, size)
}

/// Heat from one key point. Cells that it cannot reach in its time are left out, and change nothing.
#[derive(Debug)]
pub(super) struct Flow<const D: usize> {
    pub(super) window: Window<D>,
    heat: Heat<D>,
    pub(super) distances: DistanceMap<D>,
}

impl<const D: usize> Flow<D> {
    pub(super) fn new(
        medium: &Medium<D>,
        point: [f64; D],
        iterations: usize,
        step: f64,
        exec: &Exec,
    ) -> Result<Self, KeyPointError> {
        let window = Window::around(medium, point, iterations);
        let options = HeatOptions {
            duration: Duration::Iterations(iterations),
            step: Step::Fixed(step),
            ..HeatOptions::default()
        };
        let source = Sources::new(&[window.inside(point)], window.medium.mask())?;
        let heat = Explicit::new(&window.medium, options)?.flow(&source, exec)?;
        let distances = normalized(&heat);
        Ok(Self { window, heat, distances })
    }

    /// `ln u` at a point of the whole, interpolated between cells that heat has reached; minus
    /// infinity beyond the border, in walls and where there is none.
    pub(super) fn ln_temperature(&self, point: [f64; D]) -> f64 {
        let (field, inside) = (self.heat.ln_temperature(), self.window.inside(point));
        if !field.shape().contains(inside) {
            return f64::NEG_INFINITY;
        }
        -interpolated(field.shape(), inside, |cell| -field.values()[cell])
    }

    /// The distance of a point from the key point, not reached beyond the border.
    pub(super) fn distance(&self, point: [f64; D]) -> f64 {
        let inside = self.window.inside(point);
        let is_on_grid = self.distances.shape().contains(inside);
        if is_on_grid { self.distances.at(inside) } else { NOT_REACHED }
    }

    pub(super) fn descent(&self) -> Option<Descent<'_, D>> {
        Descent::new(&self.heat, &self.window.medium).ok()
    }

    /// The path from a point down to the key point, whose number is `parent`; `None` if there is none.
    pub(super) fn path(
        &self,
        descent: &Descent<'_, D>,
        point: [f64; D],
        parent: usize,
    ) -> Option<Path<D>> {
        let inside = self.window.inside(point);
        let path = descent.path(inside, &self.distances, PathOptions::default()).ok()?;
        let reached = matches!(path.ending, Ending::Source(_));
        reached.then(|| self.window.outward(path, parent))
    }
}
