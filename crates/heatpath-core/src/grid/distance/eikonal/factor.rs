//! Derivatives of the distance that stay exact at a source.

use super::seed::Seed;
use super::stencil::Stencil;
use super::update::{Difference, Differences};
use crate::grid::tensor::apply;

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
    pub(super) stencil: &'a S,
    seed: &'a Seed<D>,
    pub(super) place: usize,
    pub(super) index: [f64; D],
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

    /// The derivative of r, in a direction from which no neighbour of this source is known although the
    /// source lies there: less than a step away, or behind a neighbour that another source is nearer
    /// to.
    #[inline]
    pub(super) fn of_r_alone(
        &self,
        direction: usize,
        upwind: &Upwind,
        near: f64,
    ) -> Option<Difference> {
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
    pub(super) fn difference(
        &self,
        direction: usize,
        upwind: &Upwind,
        second_order: bool,
    ) -> Difference {
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
