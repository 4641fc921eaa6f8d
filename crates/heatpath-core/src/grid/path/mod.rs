//! Minimal paths: from an end point down to a source (Yang & Cohen, eq. 4).
//!
//! A path descends a potential that decreases towards the sources, against its gradient in the metric
//! of the medium: `-k D grad`. Of a distance the potential is its square. Of heat it is made
//! of the exposure ([`Heat::ln_exposure`]), not of the temperature: the warmest point drifts away
//! from the source while heat flows, and a descent of the temperature ends there. The exposure has
//! no maximum but the sources, whatever the medium and the walls, so a path that can reach a source
//! does.

mod near;
mod potential;

use self::near::NearSources;
use super::distance::{DistanceMap, NOT_REACHED};
use super::heat::{Heat, NoExposure};
use super::medium::Medium;
use super::sample::corners;
use super::tensor::apply;
use super::{Grid, Mask, PointError, Shape, Sources, check_points};
use std::iter;
use std::sync::OnceLock;

/// How a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At the source with this number, counted from 0 in the order in which they were given.
    Source(usize),
    /// Nowhere: walls separate the end point from every source.
    Unreachable,
    /// Nowhere: no heat has arrived at the end point; more iterations would bring it there.
    NotReached,
    /// On the way: the tracer gave up after its largest number of steps, or found no way down.
    StepLimit,
}

/// A minimal path from an end point to a source.
#[derive(Clone, Debug, PartialEq)]
pub struct Path<const D: usize> {
    /// The points in pixel coordinates, from the end point to the source.
    ///
    /// At least the end point; the last one is exactly the source if [`Self::ending`] says so.
    pub points: Vec<[f64; D]>,
    /// How the path ended.
    pub ending: Ending,
    /// The length of the polyline in pixels.
    pub length: f64,
    /// The length of the polyline in physical units.
    pub physical_length: f64,
    /// The distance of the end point from its source, [`NOT_REACHED`] where there is none.
    pub distance: f64,
    /// The length of the polyline in the metric of the medium ([`Medium::cost`]).
    ///
    /// Of a shortest path it is the distance. A cost well above the distance says that one of the two
    /// is wrong. Heat in media of strong contrast does not measure their metric: in few steps it comes
    /// no further than their number, in many it is lost to slow cells, which stay cold. In very many
    /// it fills the grid, and distances become too short.
    /// [`Eikonal`](super::distance::Eikonal) finds both.
    pub cost: f64,
}

impl<const D: usize> Path<D> {
    pub(crate) fn new(
        points: Vec<[f64; D]>,
        ending: Ending,
        distance: f64,
        medium: &Medium<D>,
    ) -> Self {
        let shape = medium.shape();
        Self {
            length: length(&points, &shape.unit_spacing()),
            physical_length: length(&points, shape),
            distance,
            cost: medium.cost(&points),
            points,
            ending,
        }
    }
}

/// The length of a polyline in the units of `shape`.
pub(crate) fn length<const D: usize>(points: &[[f64; D]], shape: &Shape<D>) -> f64 {
    points.windows(2).fold(0.0, |sum, pair| sum + shape.physical_distance(pair[0], pair[1]))
}

/// The parameters of [`Descent::path`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathOptions {
    /// The length of a step in cell units (multiples of the smallest spacing). From above 0 to 1;
    /// default 0.5.
    pub step: f64,
    /// The largest number of steps; `None` (the default) allows any path that a grid of this size
    /// can hold.
    pub largest_steps: Option<usize>,
}

impl Default for PathOptions {
    fn default() -> Self {
        Self { step: 0.5, largest_steps: None }
    }
}

/// A valley has a kink if the potential bends less than this part of its bend on both sides of it.
const KINK: f64 = 0.5;

/// A potential to descend, with its sources and walls: traces any number of paths.
#[derive(Clone, Debug)]
pub struct Descent<'a, const D: usize> {
    /// Infinite where nothing has arrived.
    potential: Grid<f64, D>,
    medium: &'a Medium<D>,
    sources: Sources<D>,
    near: NearSources,
    /// The cells that are connected to a source, once somebody asks.
    connected: OnceLock<Grid<bool, D>>,
    /// Whether the potential has kinks, as that of a distance.
    has_kinks: bool,
}

impl<'a, const D: usize> Descent<'a, D> {
    /// The descent towards the sources of `heat`, which has flowed in `medium`.
    ///
    /// # Errors
    /// The heat was made without its exposure.
    pub fn new(heat: &Heat<D>, medium: &'a Medium<D>) -> Result<Self, NoExposure> {
        Ok(Self::down(potential::of_heat(heat)?, false, heat.sources(), medium))
    }

    /// The descent of the `distances` from `sources` in `medium`, such as those of
    /// [`Eikonal`](super::distance::Eikonal).
    #[must_use]
    pub fn of_distances(
        distances: &DistanceMap<D>,
        sources: &Sources<D>,
        medium: &'a Medium<D>,
    ) -> Self {
        // Smooth at the sources, where the distance itself has a kink.
        let potential = distances.field().map(|distance| distance * distance);
        Self::down(potential, true, sources, medium)
    }

    fn down(
        potential: Grid<f64, D>,
        has_kinks: bool,
        sources: &Sources<D>,
        medium: &'a Medium<D>,
    ) -> Self {
        let near = NearSources::new(medium.shape(), sources);
        let connected = OnceLock::new();
        Self { potential, medium, sources: sources.clone(), near, connected, has_kinks }
    }

    /// Traces the path from `end` (pixel coordinates) to a source.
    ///
    /// `distances` are those that the path's `distance` is read from.
    ///
    /// # Errors
    /// The end (called number 0) lies outside the grid or inside a wall. A path that does not reach a source is no
    /// error: its [`Ending`] says why.
    pub fn path(
        &self,
        end: [f64; D],
        distances: &DistanceMap<D>,
        options: PathOptions,
    ) -> Result<Path<D>, PointError> {
        check_points("end", &[end], self.mask())?;
        let (points, ending) = self.trace(end, options);
        let reached = matches!(ending, Ending::Source(_));
        let distance = if reached { distances.at(end) } else { NOT_REACHED };
        Ok(Path::new(points, ending, distance, self.medium))
    }

    pub(crate) fn medium(&self) -> &'a Medium<D> {
        self.medium
    }

    fn shape(&self) -> &Shape<D> {
        self.medium.shape()
    }

    fn mask(&self) -> &Mask<D> {
        self.medium.mask()
    }

    /// Whether open cells connect `cell` to a source.
    fn is_connected(&self, cell: usize) -> bool {
        let reachable = || self.mask().reachable_from(self.source_cells());
        self.connected.get_or_init(reachable).values()[cell]
    }

    /// The points from `end`, which lies in an open cell, to a source, and how they end.
    pub(crate) fn trace(&self, end: [f64; D], options: PathOptions) -> (Vec<[f64; D]>, Ending) {
        let mut points = vec![end];
        let cell = self.shape().position(self.shape().cell_at(end));
        if self.at(cell).is_infinite() {
            let is_connected = self.is_connected(cell);
            let ending = if is_connected { Ending::NotReached } else { Ending::Unreachable };
            return (points, ending);
        }
        let step = options.step.clamp(1e-3, 1.0);
        let longest = self.shape().cells() as f64 * D as f64 / step;
        let limit = options.largest_steps.unwrap_or(longest as usize + 64);
        let mut here = end;
        while points.len() <= limit {
            if let Some(number) = self.source_at(here) {
                let source = self.sources.points()[number];
                if source != here {
                    points.push(source);
                }
                return (points, Ending::Source(number));
            }
            match self.smooth_step(here, step) {
                Some(next) => points.push(next),
                None => self.walk_below(self.value(here), here, &mut points),
            }
            let last = points[points.len() - 1];
            if last == here {
                break;
            }
            here = last;
        }
        (points, Ending::StepLimit)
    }

    /// The cells in which sources lie, in the order of their numbers.
    pub(crate) fn source_cells(&self) -> impl Iterator<Item = usize> {
        let points = self.sources.points().iter();
        points.map(|&point| self.shape().position(self.shape().cell_at(point)))
    }

    /// The nearest source less than one cell away along every axis and in plain sight.
    fn source_at(&self, point: [f64; D]) -> Option<usize> {
        let source = |number: usize| self.sources.points()[number];
        let distance = |number: usize| self.shape().physical_distance(point, source(number));
        let in_sight = |&number: &usize| {
            (0..D).all(|axis| (point[axis] - source(number)[axis]).abs() < 1.0)
                && self.mask().segment_is_open(point, source(number))
        };
        let cell = self.shape().position(self.shape().cell_at(point));
        let sources = self.near.around(self.shape(), cell).filter(in_sight);
        sources.min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)))
    }

    /// One step of the midpoint rule down the gradient; `None` unless it gets somewhere, ends lower
    /// and crosses no wall.
    fn smooth_step(&self, here: [f64; D], step: f64) -> Option<[f64; D]> {
        let middle = self.moved(here, self.direction(here)?, 0.5 * step);
        let next = self.moved(here, self.direction(middle)?, step);
        // A step against the border is cut short.
        let moved = self.shape().physical_distance(here, next) / self.shape().smallest_spacing();
        let fine = moved > 0.25 * step
            && self.value(next) < self.value(here)
            && self.mask().segment_is_open(here, next);
        fine.then_some(next)
    }

    /// `point` moved along `direction`, kept between the outermost cell centres.
    fn moved(&self, point: [f64; D], direction: [f64; D], step: f64) -> [f64; D] {
        let size = self.shape().size();
        std::array::from_fn(|axis| {
            (point[axis] + step * direction[axis]).clamp(0.0, (size[axis] - 1) as f64)
        })
    }

    /// Walks from cell to neighbouring cell, each time to the lowest, until below `level`.
    ///
    /// This is the way out wherever the interpolated potential has no descent: the cells
    /// themselves always have one, to a neighbour or along the lattice.
    fn walk_below(&self, level: f64, here: [f64; D], points: &mut Vec<[f64; D]>) {
        let mut cell = self.shape().position(self.shape().cell_at(here));
        loop {
            let Some(next) = self.lower(cell) else {
                // Only a source has no lower cell around it.
                points.push(self.shape().centre(cell));
                return;
            };
            cell = next;
            points.push(self.shape().centre(cell));
            if self.at(cell) < level || self.source_at(self.shape().centre(cell)).is_some() {
                return;
            }
        }
    }

    /// A cell that is lower than a cell: the lowest of its neighbours, or if none of these is lower, of
    /// those in sight in a box around it, as large as it takes. In an anisotropic medium heat comes
    /// along the lattice's offsets, which may lead past the neighbours.
    fn lower(&self, cell: usize) -> Option<usize> {
        let (shape, mask) = (self.shape(), self.mask());
        let here = shape.centre(cell);
        let is_lower = |next: &usize| self.at(*next) < self.at(cell) && mask.is_open(*next);
        let lowest = |a: &usize, b: &usize| self.at(*a).total_cmp(&self.at(*b));
        shape.neighbours(cell).filter(is_lower).min_by(lowest).or_else(|| {
            let in_sight = |next: &usize| mask.segment_is_open(here, shape.centre(*next));
            let mut radii = iter::successors(Some(1), |&radius| Some(2 * radius))
                .take_while(|&radius| radius < 2 * shape.longest_side());
            radii.find_map(|radius| {
                let around = shape.box_around(cell, radius).filter(is_lower).filter(in_sight);
                around.min_by(lowest)
            })
        })
    }

    /// The potential of a cell, infinite where nothing has arrived.
    pub(crate) fn at(&self, cell: usize) -> f64 {
        self.potential.values()[cell]
    }

    /// The potential at `point`, interpolated between the cells that heat has reached.
    fn value(&self, point: [f64; D]) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (cell, weight) in self.reached_corners(point) {
            sum += weight * self.at(cell);
            weights += weight;
        }
        sum / weights
    }

    /// The direction of steepest descent at `point` in pixel coordinates per cell unit of physical
    /// length; `None` where the potential is flat.
    fn direction(&self, point: [f64; D]) -> Option<[f64; D]> {
        let mut gradient = [0.0; D];
        let tensors = self.medium.diffusion().tensor();
        for (cell, weight) in self.reached_corners(point) {
            let slopes = self.slopes(cell);
            let slopes = tensors.map_or(slopes, |tensors| apply(&tensors.at(cell), slopes));
            (0..D).for_each(|axis| gradient[axis] += weight * slopes[axis]);
        }
        // === From physical slopes to a unit of physical length, in pixel coordinates
        let spacing = self.shape().spacing().map(|h| h / self.shape().smallest_spacing());
        let length = gradient.iter().map(|slope| slope * slope).sum::<f64>().sqrt();
        let direction = std::array::from_fn(|axis| -gradient[axis] / (length * spacing[axis]));
        (length > 0.0 && length.is_finite()).then_some(direction)
    }

    fn reached_corners(&self, point: [f64; D]) -> impl Iterator<Item = (usize, f64)> + '_ {
        corners(self.shape(), point).filter(|&(cell, _)| self.at(cell).is_finite())
    }

    /// The slopes of the potential in a cell, per cell unit, by central differences.
    ///
    /// No flux passes a wall or the border, so the potential beyond is that of the cell itself. Along a
    /// fast line a distance has a valley with a kink, of which the two sides are not equally steep:
    /// there the slope across is 0, so that paths run in the valley and not beside it.
    fn slopes(&self, cell: usize) -> [f64; D] {
        let (shape, index) = (self.shape(), self.shape().index(cell));
        std::array::from_fn(|axis| {
            let at = |steps: isize, or: f64| {
                let there =
                    index[axis].checked_add_signed(steps).filter(|&i| i < shape.size()[axis]);
                let offset = steps * shape.stride(axis) as isize;
                let value = there.map_or(or, |_| self.at(cell.wrapping_add_signed(offset)));
                if value.is_finite() { value } else { or }
            };
            let here = self.at(cell);
            let (before, after) = (at(-1, here), at(1, here));
            let bend = before - 2.0 * here + after;
            let bends = [here - 2.0 * before + at(-2, before), here - 2.0 * after + at(2, after)];
            let is_valley = self.has_kinks && before > here && after > here;
            if is_valley && bends.into_iter().all(|other| other < KINK * bend) {
                return 0.0;
            }
            0.5 * (after - before) * shape.smallest_spacing() / shape.spacing()[axis]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::medium::uniform;

    /// The potential `x^2 + 3 y^2` around a source in the middle: its curves of steepest descent
    /// are `y = c x^3`.
    fn paraboloid(medium: &Medium<2>) -> Descent<'_, 2> {
        let potential = Grid::from_fn(*medium.shape(), |[x, y]| {
            let (x, y) = (x as f64 - 60.0, y as f64 - 60.0);
            x * x + 3.0 * y * y
        });
        let sources = Sources::new(&[[60.0, 60.0]], medium.mask()).unwrap();
        Descent::down(potential, false, &sources, medium)
    }

    #[test]
    fn the_tracer_is_of_second_order() {
        let medium = uniform(Shape::new([121, 121]).unwrap());
        let descent = paraboloid(&medium);
        let straying = |step: f64| {
            let options = PathOptions { step, ..PathOptions::default() };
            let (points, ending) = descent.trace([100.0, 90.0], options);
            assert_eq!(ending, Ending::Source(0));
            let exact = |x: f64| 30.0 * (x / 40.0).powi(3);
            let off = |p: &[f64; 2]| (p[1] - 60.0 - exact(p[0] - 60.0)).abs();
            points.iter().filter(|p| p[0] > 70.0).map(off).fold(0.0, f64::max)
        };
        let errors = [1.0, 0.5, 0.25].map(straying);
        println!("straying for steps 1, 1/2, 1/4: {errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 1.8, "order {order}: {errors:?}");
        }
        assert!(errors[1] < 2e-3, "a path strays by a five-hundredth of a cell");
    }
}
