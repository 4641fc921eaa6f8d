//! Minimal paths: from an end point down to a source (Yang & Cohen, eq. 4).
//!
//! A path descends a potential that decreases towards the sources. For heat the potential is made
//! of the exposure ([`Heat::ln_exposure`]), not of the temperature: the warmest point drifts away
//! from the source while heat flows, and a descent of the temperature ends there. The exposure has
//! no maximum but the sources, whatever the medium and the walls, so a path that can reach a source
//! does.

use super::distance::matern::{Inverse, Matern, lowest};
use super::distance::{DistanceMap, NOT_REACHED};
use super::heat::{Heat, NoExposure, Scheme};
use super::sample::corners;
use super::{Grid, Mask, PointError, Shape, Sources, check_points};
use std::f64::consts::PI;

/// How a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At the source with this number, counted from 0 in the order in which they were given.
    Source(usize),
    /// Nowhere: walls separate the end point from every source.
    Unreachable,
    /// Nowhere: no heat has arrived at the end point; more iterations would bring it there.
    NotReached,
    /// On the way: the tracer gave up after its largest number of steps.
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

/// A potential to descend, with its sources and walls: traces any number of paths.
#[derive(Clone, Debug)]
pub struct Descent<const D: usize> {
    /// Infinite where nothing has arrived.
    potential: Grid<f64, D>,
    mask: Mask<D>,
    sources: Sources<D>,
    /// The cells that are connected to a source.
    connected: Grid<bool, D>,
}

impl<const D: usize> Descent<D> {
    /// The descent towards the sources of `heat`.
    ///
    /// # Errors
    /// The heat was made without its exposure.
    pub fn new(heat: &Heat<D>) -> Result<Self, NoExposure> {
        let potential = potential(heat)?;
        let (mask, sources) = (heat.mask().clone(), heat.sources().clone());
        let shape = *mask.shape();
        let cells = sources.points().iter().map(|&point| shape.position(shape.cell_at(point)));
        let connected = mask.reachable_from(cells);
        Ok(Self { potential, mask, sources, connected })
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
        check_points("end", &[end], &self.mask)?;
        let (points, ending) = self.trace(end, options);
        let pairs = || points.windows(2).map(|pair| (pair[0], pair[1]));
        let pixels = self.shape().unit_spacing();
        let reached = matches!(ending, Ending::Source(_));
        Ok(Path {
            length: pairs().map(|(a, b)| pixels.physical_distance(a, b)).sum(),
            physical_length: pairs().map(|(a, b)| self.shape().physical_distance(a, b)).sum(),
            distance: if reached { distances.at(end) } else { NOT_REACHED },
            points,
            ending,
        })
    }

    fn shape(&self) -> &Shape<D> {
        self.mask.shape()
    }

    fn trace(&self, end: [f64; D], options: PathOptions) -> (Vec<[f64; D]>, Ending) {
        let mut points = vec![end];
        let cell = self.shape().position(self.shape().cell_at(end));
        if !self.connected.values()[cell] {
            return (points, Ending::Unreachable);
        }
        if self.potential.values()[cell].is_infinite() {
            return (points, Ending::NotReached);
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
            here = points[points.len() - 1];
        }
        (points, Ending::StepLimit)
    }

    /// The nearest source less than one cell away along every axis and in plain sight.
    fn source_at(&self, point: [f64; D]) -> Option<usize> {
        let distance = |source: [f64; D]| self.shape().physical_distance(point, source);
        let in_sight = |source: [f64; D]| {
            (0..D).all(|axis| (point[axis] - source[axis]).abs() < 1.0)
                && self.mask.segment_is_open(point, source)
        };
        let sources = self.sources.points().iter().enumerate();
        sources
            .filter(|&(_, &source)| in_sight(source))
            .min_by(|a, b| distance(*a.1).total_cmp(&distance(*b.1)))
            .map(|(number, _)| number)
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
            && self.mask.segment_is_open(here, next);
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
    /// themselves always have one.
    fn walk_below(&self, level: f64, here: [f64; D], points: &mut Vec<[f64; D]>) {
        let mut cell = self.shape().position(self.shape().cell_at(here));
        loop {
            let lowest = self
                .shape()
                .neighbours(cell)
                .filter(|&next| self.mask.is_open(next))
                .min_by(|&a, &b| self.at(a).total_cmp(&self.at(b)));
            let Some(next) = lowest.filter(|&next| self.at(next) < self.at(cell)) else {
                // Only a source has no lower neighbour.
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

    fn at(&self, cell: usize) -> f64 {
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
        for (cell, weight) in self.reached_corners(point) {
            let slopes = self.slopes(cell);
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
    /// No flux passes a wall or the border, so the potential beyond is that of the cell itself.
    fn slopes(&self, cell: usize) -> [f64; D] {
        let shape = self.shape();
        let (index, size) = (shape.index(cell), shape.size());
        let here = self.at(cell);
        std::array::from_fn(|axis| {
            let stride = shape.stride(axis);
            let finite = |value: f64| if value.is_finite() { value } else { here };
            let before = if index[axis] > 0 { finite(self.at(cell - stride)) } else { here };
            let inside = index[axis] + 1 < size[axis];
            let after = if inside { finite(self.at(cell + stride)) } else { here };
            0.5 * (after - before) * shape.smallest_spacing() / shape.spacing()[axis]
        })
    }
}

/// Exposure as a potential that is lowest at the sources.
///
/// In the uniform plane the exposure from a unit source is `E1(r^2 / 4t) / 4 pi`, in space it is
/// `erfc(r / sqrt(4t)) / 4 pi r`. The functions of the exposure used here are monotone, so they
/// change no path, but they are close to `r^2 / 4t` near the source as well as far from it: central
/// differences and interpolation are nearly exact for such a function, and paths come straight into
/// the source.
///
/// Of implicit heat the potential is the square of the distance at which it would be as large in a
/// uniform medium.
fn potential<const D: usize>(heat: &Heat<D>) -> Result<Grid<f64, D>, NoExposure> {
    let exposure = heat.ln_exposure()?;
    if heat.scheme() == Scheme::Implicit {
        return Ok(implicit_potential(heat, exposure));
    }
    let speeds = heat.speeds_sq.iter().zip(&heat.amounts);
    let scale =
        speeds.map(|(speed_sq, amount)| 4.0 * PI * speed_sq / amount).fold(f64::MAX, f64::min);
    let unit =
        if D < 3 { scale * heat.step } else { scale * heat.step * (4.0 * heat.time()).sqrt() };
    // Where heat is trapped around its source, exp(-exposure) would leave the range of numbers.
    let highest = exposure.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let ln_unit = unit.ln().min(30_f64.ln() - highest);
    Ok(exposure.map(|&ln_exposure| {
        let ln = ln_exposure + ln_unit;
        if ln == f64::NEG_INFINITY {
            f64::INFINITY
        } else if D < 3 {
            minus_ln_of_one_minus_exp_of_minus(ln)
        } else if ln < -30.0 {
            -2.0 * ln
        } else {
            (-2.0 * ln).exp().ln_1p()
        }
    }))
}

fn implicit_potential<const D: usize>(heat: &Heat<D>, exposure: &Grid<f64, D>) -> Grid<f64, D> {
    let dimension = heat.shape().dimension();
    let matern = Matern { dimension, steps: heat.iterations(), sum: true };
    let highest = exposure.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Where heat is trapped around its source, there would be no such distance.
    let strength = heat.ln_reference().max(highest - matern.ln(1e-4).0);
    let inverse = Inverse::new(matern, lowest(exposure) - strength);
    exposure.map(|&ln_exposure| {
        if ln_exposure == f64::NEG_INFINITY {
            f64::INFINITY
        } else {
            inverse.distance(ln_exposure - strength).powi(2)
        }
    })
}

/// `-ln(1 - exp(-a))` for `a = exp(ln_a)`, accurate for all of them: it is close to `exp(-a)` for
/// large a and to `-ln(a)` for small a.
fn minus_ln_of_one_minus_exp_of_minus(ln_a: f64) -> f64 {
    let a = ln_a.exp();
    if ln_a < -30.0 {
        -ln_a
    } else if a < 0.5 {
        -(-(-a).exp_m1()).ln()
    } else {
        -(-(-a).exp()).ln_1p()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The potential `x^2 + 3 y^2` around a source in the middle: its curves of steepest descent
    /// are `y = c x^3`.
    fn paraboloid() -> Descent<2> {
        let shape = Shape::new([121, 121]).unwrap();
        let mask = Mask::all_open(shape);
        let potential = Grid::from_fn(shape, |[x, y]| {
            let (x, y) = (x as f64 - 60.0, y as f64 - 60.0);
            x * x + 3.0 * y * y
        });
        let sources = Sources::new(&[[60.0, 60.0]], &mask).unwrap();
        Descent { potential, connected: Grid::from_fn(shape, |_| true), mask, sources }
    }

    #[test]
    fn the_tracer_is_of_second_order() {
        let descent = paraboloid();
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
