//! Derivatives of the distance that stay exact at a source.

use super::seed::Seed;
use super::stencil::Stencil;
use super::update::{Difference, Differences, larger_root};
use super::value::choose;
use crate::grid::tensor::apply;
use wide::f64x2;

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

    #[inline(always)]
    pub(super) fn solve(&self, upwinds: &[Upwind; N], second_order: bool) -> Option<f64> {
        // Of the six directions of a tensor in space seldom all count.
        let with_all = if N > 3 { None } else { self.solve_with_all(upwinds, second_order) };
        with_all.or_else(|| self.solve_with_some(upwinds, second_order))
    }

    /// The distance in the usual case that it comes from all known neighbours and from nothing else;
    /// `None` in others. It neither sorts nor jumps, nor do the functions that it is made of pass
    /// numbers through memory: each of these takes longer than the sums.
    #[inline(always)]
    fn solve_with_all(&self, upwinds: &[Upwind; N], second_order: bool) -> Option<f64> {
        let nearest = upwinds.iter().map(|upwind| upwind.near).fold(f64::INFINITY, f64::min);
        let mut farthest = nearest;
        let (mut any_missing, mut any_alone) = (false, false);
        let mut differences = [Difference::default(); N];
        for (direction, upwind) in upwinds.iter().enumerate() {
            let is_missing = upwind.near == f64::INFINITY;
            any_missing |= is_missing;
            any_alone |= is_missing & self.counts_alone(direction, upwind);
            let near = choose(is_missing, nearest, upwind.near);
            farthest = farthest.max(near);
            let found = self.difference(direction, &Upwind { near, ..*upwind }, second_order);
            let weight = choose(is_missing, 0.0, found.weight);
            differences[direction] = Difference { weight, ..found };
        }
        if any_alone || (any_missing && self.stencil.has_closed_side(self.place)) {
            return None;
        }
        let distance = larger_root(&differences, nearest)?;
        let counts = differences.iter().fold(distance >= farthest, |counts, d| {
            counts & ((d.weight == 0.0) | ((d.slope > 0.0) & (d.slope * distance >= d.rest)))
        });
        counts.then_some(distance)
    }

    /// The distance from the neighbours in one direction, if no other direction counts.
    #[inline(always)]
    pub(super) fn solve_with_one(
        &self,
        direction: usize,
        upwind: &Upwind,
        second_order: bool,
    ) -> Option<f64> {
        if (0..N).any(|other| other != direction && self.is_beside(other)) {
            return None;
        }
        let difference = self.difference(direction, upwind, second_order);
        let distance = larger_root(&[difference], upwind.near)?;
        let Difference { slope, rest, .. } = difference;
        (slope > 0.0 && slope * distance >= rest).then_some(distance)
    }

    /// The distance in any case.
    fn solve_with_some(&self, upwinds: &[Upwind; N], second_order: bool) -> Option<f64> {
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

    /// The derivative of r, in a direction that counts by it alone.
    pub(super) fn of_r_alone(
        &self,
        direction: usize,
        upwind: &Upwind,
        near: f64,
    ) -> Option<Difference> {
        self.counts_alone(direction, upwind).then(|| {
            let along = self.stencil.along(self.place, direction, &self.covector);
            let slope = along.abs() * self.per_r_sq;
            let weight = self.stencil.weight(self.place, direction);
            Difference { weight, slope, rest: slope * self.seed.initial, near }
        })
    }

    /// Whether no neighbour of this source is known in a direction although the source lies there: less
    /// than a step away, or behind a neighbour that another source is nearer to.
    #[inline]
    fn counts_alone(&self, direction: usize, upwind: &Upwind) -> bool {
        let along = self.stencil.along(self.place, direction, &self.covector);
        self.is_beside(direction) | (upwind.is_foreign & ((along > 0.0) == (upwind.side < 0)))
    }

    /// Whether the source lies less than a step away in a direction, and not level.
    #[inline]
    fn is_beside(&self, direction: usize) -> bool {
        let along = self.stencil.along(self.place, direction, &self.covector);
        let step_sq = self.stencil.length_sq(self.place, direction, &self.seed.metric);
        (along != 0.0) & (along.abs() < step_sq)
    }

    /// With `T = r tau`, the derivative away from the neighbour is `T (n + r'/r) - r rest(tau)`,
    /// where n is 1 or 3/2 by the order of the difference of tau.
    #[inline(always)]
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
        let is_factored = (away > 0.0) | (away * away < 0.25 * self.r_sq * step_sq);
        let growth = if is_factored { away * self.per_r_sq } else { 0.0 };
        let is_second = second_order & (next < near);
        let distances = [near, choose(is_second, next, near)].map(|distance| distance - initial);
        // r times the factor tau of the neighbours one and two steps back.
        let [first, second] =
            if is_factored { self.carried(distances, away, step_sq) } else { distances };
        let (steps, rest) =
            (choose(is_second, 1.5, 1.0), choose(is_second, 2.0 * first - 0.5 * second, first));
        let slope = steps + growth;
        Difference { weight, slope, rest: rest + slope * initial, near }
    }

    /// `T r / r'` of the neighbours one and two steps back.
    #[inline(always)]
    fn carried(&self, distances: [f64; 2], away: f64, step_sq: f64) -> [f64; 2] {
        // A root or a quotient of two numbers takes no longer than one.
        let number = f64x2::splat;
        let (one, two) = (number(2.0 * away), number(step_sq));
        let steps = f64x2::from([1.0, 2.0]);
        let shares = number(1.0) - (steps * one - steps * steps * two) * number(self.per_r_sq);
        // r'^2 over r^2
        let least = 1e-9 * self.per_r_sq * step_sq;
        if shares.simd_gt(number(least)).all() {
            return (f64x2::from(distances) / shares.sqrt()).to_array();
        }
        let shares = shares.to_array();
        // At the source itself tau is 1.
        let carried = |i: usize| {
            if shares[i] > least { distances[i] / shares[i].sqrt() } else { self.r_sq.sqrt() }
        };
        [carried(0), carried(1)]
    }
}
