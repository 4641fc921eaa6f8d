//! Derivatives of the distance that stay exact at a source.

use super::stencil::Stencil;
use super::update::{Difference, Differences};
use crate::grid::Matrix;
use crate::grid::medium::Medium;
use crate::grid::source::shares;
use crate::grid::tensor::{apply, determinant, inverse};

/// A source as the cells around it see it.
#[derive(Clone, Debug)]
pub(super) struct Seed<const D: usize> {
    /// In pixel coordinates.
    pub(super) point: [f64; D],
    /// The metric there, per squared pixel: near the source the distance is `sqrt(d' metric d)`.
    pub(super) metric: Matrix<D>,
    /// The distance at the source itself.
    pub(super) initial: f64,
    /// The cells around it and their distances.
    pub(super) cells: Vec<(usize, f64)>,
}

impl<const D: usize> Seed<D> {
    /// The seed of a source at `point`; in the cells that share it the distance is the mean of what it
    /// would be in the metric there and in that of the source.
    pub(super) fn new<const N: usize>(
        medium: &Medium<D>,
        stencil: &impl Stencil<D, N>,
        point: [f64; D],
        initial: f64,
    ) -> Self {
        let shape = medium.shape();
        let shares = shares(medium.mask(), point);
        let mut metric = [[0.0; D]; D];
        for &(cell, weight) in &shares {
            let there = metric_of(medium, cell);
            (0..D).for_each(|i| (0..D).for_each(|j| metric[i][j] += weight * there[i][j]));
        }
        let cells = shares.into_iter().map(|(cell, _)| {
            let centre = shape.centre(cell);
            let d = std::array::from_fn(|axis| centre[axis] - point[axis]);
            let mean = 0.5 * (length(&metric, d) + length(&metric_of(medium, cell), d));
            (stencil.place(shape.index(cell)), initial + mean)
        });
        Self { point, metric, initial, cells: cells.collect() }
    }
}

/// The metric in a cell, per squared pixel.
fn metric_of<const D: usize>(medium: &Medium<D>, cell: usize) -> Matrix<D> {
    let (shape, metric) = (medium.shape(), inverse(&medium.speed_sq_tensor(cell)));
    let step = shape.spacing().map(|h| h / shape.smallest_spacing());
    std::array::from_fn(|i| std::array::from_fn(|j| metric[i][j] * step[i] * step[j]))
}

/// The length of a vector in a metric.
fn length<const D: usize>(metric: &Matrix<D>, vector: [f64; D]) -> f64 {
    let covector = apply(metric, vector);
    (0..D).map(|axis| vector[axis] * covector[axis]).sum::<f64>().sqrt()
}

/// The known neighbours in one direction, on the side where they are nearer.
#[derive(Clone, Copy, Default)]
pub(super) struct Upwind {
    /// -1 or 1.
    pub(super) side: isize,
    pub(super) near: f64,
    /// The distance one step further; both are infinite where they are not known.
    pub(super) next: f64,
    /// The number of the seed that they count from.
    pub(super) seed: u32,
    /// Whether there are neighbours, but of another seed than the one in question.
    pub(super) is_foreign: bool,
}

impl Upwind {
    /// The same, unknown if it is that of another seed.
    #[inline]
    pub(super) fn seen_from(self, seed: u32) -> Self {
        if self.seed == seed {
            return self;
        }
        let is_foreign = self.near < f64::INFINITY;
        Self { near: f64::INFINITY, next: f64::INFINITY, is_foreign, ..self }
    }
}

/// The distance as a product `T = r tau` of the distance r in the constant metric of the source and a
/// smooth factor tau: derivatives of r are exact, only those of tau are differences (Luo and Qian,
/// 2012; Treister and Haber, 2016).
pub(super) struct Factor<'a, const D: usize, const N: usize, S> {
    stencil: &'a S,
    seed: &'a Seed<D>,
    place: usize,
    index: [f64; D],
    /// `metric d`, where d leads from the source to the cell.
    covector: [f64; D],
    /// `d' metric d`, and one over it.
    r_sq: f64,
    per_r_sq: f64,
}

impl<'a, const D: usize, const N: usize, S: Stencil<D, N>> Factor<'a, D, N, S> {
    #[inline]
    pub(super) fn new(stencil: &'a S, seed: &'a Seed<D>, place: usize, index: [usize; D]) -> Self {
        let index = index.map(|i| i as f64);
        let d: [f64; D] = std::array::from_fn(|axis| index[axis] - seed.point[axis]);
        let covector = apply(&seed.metric, d);
        let r_sq = (0..D).map(|axis| d[axis] * covector[axis]).sum::<f64>();
        Self { stencil, seed, place, index, covector, r_sq, per_r_sq: 1.0 / r_sq }
    }

    #[inline]
    pub(super) fn solve(&self, upwinds: &[Upwind; N], second_order: bool) -> Option<f64> {
        let nearest = upwinds.iter().map(|upwind| upwind.near).fold(f64::INFINITY, f64::min);
        let mut differences = Differences::<N>::new();
        for (direction, upwind) in upwinds.iter().enumerate() {
            if upwind.near < f64::INFINITY {
                differences.insert(self.difference(direction, upwind, second_order));
            } else if let Some(difference) = self.of_r_alone(direction, upwind, nearest) {
                differences.insert(difference);
            }
        }
        let distance = differences.solve();
        if differences.len() < N && self.stencil.has_closed_side(self.place) {
            return self.solve_with_closed_sides(upwinds, differences, second_order, distance?);
        }
        distance
    }

    /// The same with the derivatives along directions of which the nearer side is closed, so that no
    /// neighbour tells them: those of the gradient that the others imply.
    #[cold]
    fn solve_with_closed_sides(
        &self,
        upwinds: &[Upwind; N],
        mut differences: Differences<N>,
        second_order: bool,
        distance: f64,
    ) -> Option<f64> {
        let nearest = upwinds.iter().map(|upwind| upwind.near).fold(f64::INFINITY, f64::min);
        let Some(gradient) = self.gradient(upwinds, second_order) else { return Some(distance) };
        if !self.comes_from_inside(gradient, distance) {
            return Some(distance);
        }
        let mut missing = false;
        let unknown = |(direction, upwind): &(usize, &Upwind)| {
            upwind.near == f64::INFINITY && self.of_r_alone(*direction, upwind, nearest).is_none()
        };
        for (direction, _) in upwinds.iter().enumerate().filter(unknown) {
            let [slope, rest] =
                gradient.map(|covector| self.stencil.along(self.place, direction, &covector));
            let side = if slope * distance > rest { -1 } else { 1 };
            let weight = self.stencil.weight(self.place, direction);
            if weight > 0.0 && self.stencil.neighbour(self.place, direction, side).is_none() {
                let sign = -side as f64;
                differences.insert(Difference {
                    weight,
                    slope: sign * slope,
                    rest: sign * rest,
                    near: nearest,
                });
                missing = true;
            }
        }
        if missing { differences.solve().or(Some(distance)) } else { Some(distance) }
    }

    /// Whether the geodesic with that gradient reaches the cell through open cells, not along the wall
    /// or the border.
    fn comes_from_inside(&self, [slopes, rests]: [[f64; D]; 2], distance: f64) -> bool {
        let mut velocity = [0.0; D];
        for direction in 0..N {
            let along = |covector| self.stencil.along(self.place, direction, covector);
            let flow = self.stencil.weight(self.place, direction)
                * (along(&slopes) * distance - along(&rests));
            let vector = self.stencil.vector(self.place, direction);
            (0..D).for_each(|axis| velocity[axis] += flow * vector[axis]);
        }
        let largest = velocity.iter().fold(0.0, |largest, part| part.abs().max(largest));
        (1..=4).all(|cells| {
            let back = f64::from(cells) / largest;
            self.stencil
                .is_open_at(std::array::from_fn(|axis| self.index[axis] - back * velocity[axis]))
        })
    }

    /// The gradient as a function of the distance T, `slopes T - rests`, by least squares from the
    /// differences; `None` if they are too few.
    fn gradient(&self, upwinds: &[Upwind; N], second_order: bool) -> Option<[[f64; D]; 2]> {
        let mut normal = [[0.0; D]; D];
        let (mut slopes, mut rests) = ([0.0; D], [0.0; D]);
        for (direction, upwind) in upwinds.iter().enumerate() {
            if upwind.near == f64::INFINITY {
                continue;
            }
            let difference = self.difference(direction, upwind, second_order);
            let away =
                self.stencil.vector(self.place, direction).map(|part| -(upwind.side as f64) * part);
            for i in 0..D {
                (0..D).for_each(|j| normal[i][j] += away[i] * away[j]);
                slopes[i] += away[i] * difference.slope;
                rests[i] += away[i] * difference.rest;
            }
        }
        // Of whole numbers.
        if determinant(&normal) < 0.5 {
            return None;
        }
        let inverse = inverse(&normal);
        Some([apply(&inverse, slopes), apply(&inverse, rests)])
    }

    /// The derivative of r, in a direction from which no neighbour of this source is known although the
    /// source lies there: less than a step away, or behind a neighbour that another source is nearer
    /// to.
    #[inline]
    fn of_r_alone(&self, direction: usize, upwind: &Upwind, near: f64) -> Option<Difference> {
        let along = self.stencil.along(self.place, direction, &self.covector);
        let step_sq = self.stencil.length_sq(self.place, direction, &self.seed.metric);
        let is_beside = along != 0.0 && along.abs() < step_sq;
        let is_behind = upwind.is_foreign && (along > 0.0) == (upwind.side < 0);
        (is_beside || is_behind).then(|| {
            let slope = along.abs() * self.per_r_sq;
            let weight = self.stencil.weight(self.place, direction);
            Difference { weight, slope, rest: slope * self.seed.initial, near }
        })
    }

    /// With `T = r tau`, the derivative away from the neighbour is `T (n + r'/r) - r rest(tau)`,
    /// where n is 1 or 3/2 by the order of the difference of tau.
    #[inline]
    fn difference(&self, direction: usize, upwind: &Upwind, second_order: bool) -> Difference {
        let Upwind { near, next, .. } = *upwind;
        let (stencil, place) = (self.stencil, self.place);
        let initial = self.seed.initial;
        let weight = stencil.weight(place, direction);
        let away = -(upwind.side as f64) * stencil.along(place, direction, &self.covector);
        let step_sq = stencil.length_sq(place, direction, &self.seed.metric);
        // Where T grows towards the source (within 60 degrees), on the way around a wall, tau is not
        // smooth: T itself is.
        let is_factored = away > 0.0 || away * away < 0.25 * self.r_sq * step_sq;
        let growth = if is_factored { away * self.per_r_sq } else { 0.0 };
        // r times the factor tau of the neighbour that many steps back.
        let carried = |distance: f64, steps: f64| {
            if !is_factored {
                return distance - initial;
            }
            // r'^2 = (1 - x) r^2
            let x = (2.0 * steps * away - steps * steps * step_sq) * self.per_r_sq;
            if 1.0 - x > 1e-9 * self.per_r_sq * step_sq {
                (distance - initial) * one_over_sqrt_one_minus(x)
            } else {
                // At the source itself tau is 1.
                self.r_sq.sqrt()
            }
        };
        let (slope, rest) = if second_order && next < near {
            (1.5 + growth, 2.0 * carried(near, 1.0) - 0.5 * carried(next, 2.0))
        } else {
            (1.0 + growth, carried(near, 1.0))
        };
        Difference { weight, slope, rest: rest + slope * initial, near }
    }
}

/// `1 / sqrt(1 - x)`; far from the source, where x is small, by its series, which is faster.
#[inline]
fn one_over_sqrt_one_minus(x: f64) -> f64 {
    if x.abs() < 1.0 / 64.0 {
        1.0 + x * (0.5 + x * (0.375 + x * (0.3125 + x * (0.2734375 + x * 0.24609375))))
    } else {
        1.0 / (1.0 - x).sqrt()
    }
}
