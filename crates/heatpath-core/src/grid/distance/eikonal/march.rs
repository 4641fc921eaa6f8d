//! Fast marching: cells in the order of their distance, each from those before it.

use super::queue::{Entry, Queue};
use super::stencil::Stencil;
use super::update::{Difference, Differences};
use crate::exec::{Cancelled, Exec};
use crate::grid::tensor::{Matrix, apply};

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

/// What is to be known of the march.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits<'a> {
    /// No cell beyond this distance is needed.
    pub(super) farthest: f64,
    /// If there are any places here, no cell farther than all of them is needed.
    pub(super) targets: &'a [usize],
    pub(super) second_order: bool,
}

/// The distances so far, place by place.
pub(super) struct Front<'a, const D: usize, const N: usize, S> {
    stencil: &'a S,
    seeds: &'a [Seed<D>],
    second_order: bool,
    values: Vec<Value>,
    /// The number of the seed that each known distance counts from; nothing if there is only one.
    pub(super) nearest: Vec<u32>,
    queue: Queue,
}

/// What is known of a cell's distance: itself if it is final, minus itself as long as it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Value(f64);

impl Value {
    /// Not yet reached.
    const FAR: Self = Self(f64::NEG_INFINITY);
    /// Never to be reached.
    const WALL: Self = Self(f64::INFINITY);

    fn known(distance: f64) -> Self {
        Self(distance.abs())
    }

    fn trial(distance: f64) -> Self {
        Self(-distance)
    }

    #[inline]
    fn is_known(self) -> bool {
        self.0.is_sign_positive()
    }

    #[inline]
    fn is_trial(self, distance: f64) -> bool {
        self.0.to_bits() == (-distance).to_bits()
    }

    #[inline]
    fn is_improved_by(self, distance: f64) -> bool {
        !self.is_known() && distance < -self.0
    }

    #[inline]
    fn or_infinite(self) -> f64 {
        if self.is_known() { self.0 } else { f64::INFINITY }
    }
}

/// The known neighbours in one direction, on the side where they are nearer.
#[derive(Clone, Copy, Default)]
struct Upwind {
    /// -1 or 1.
    side: isize,
    place: usize,
    near: f64,
    /// The distance one step further; both are infinite where they are not known.
    next: f64,
}

/// How often a watch is asked, in cells.
const REPORT_EVERY: usize = 1 << 15;

impl<'a, const D: usize, const N: usize, S: Stencil<D, N>> Front<'a, D, N, S> {
    pub(super) fn new(stencil: &'a S, seeds: &'a [Seed<D>], second_order: bool, width: f64) -> Self {
        let places = stencil.places();
        let value = |place| if stencil.is_open(place) { Value::FAR } else { Value::WALL };
        Self {
            stencil,
            seeds,
            second_order,
            values: (0..places).map(value).collect(),
            nearest: if seeds.len() > 1 { vec![0; places] } else { Vec::new() },
            queue: Queue::new(width),
        }
    }

    /// Marches until every cell that can be reached, or all that is needed, is known.
    pub(super) fn march(&mut self, limits: Limits, exec: &Exec) -> Result<(), Cancelled> {
        for (number, seed) in self.seeds.iter().enumerate() {
            for &(place, distance) in &seed.cells {
                self.offer(place, distance, number as u32);
            }
        }
        let mut targets = limits.targets.len();
        let mut known = 0_usize;
        while let Some(entry) = self.pop() {
            let Entry { distance, place } = entry;
            let place = place as usize;
            if !self.values[place].is_trial(distance) {
                continue;
            }
            if distance > limits.farthest {
                break;
            }
            self.values[place] = Value::known(distance);
            if limits.targets.contains(&place) {
                targets -= 1;
                if targets == 0 {
                    break;
                }
            }
            self.spread(place, distance);
            known += 1;
            if known.is_multiple_of(REPORT_EVERY) {
                exec.report(known as f64 / self.stencil.shape().cells() as f64)?;
            }
        }
        Ok(())
    }

    fn pop(&mut self) -> Option<Entry> {
        let values = &self.values;
        self.queue.pop(|entry| values[entry.place as usize].is_trial(entry.distance))
    }

    /// The distance of the cell at a place, infinite if it is not known.
    #[inline]
    pub(super) fn distance(&self, place: usize) -> f64 {
        self.values[place].or_infinite()
    }

    /// Renews all cells that the cell at `place`, whose distance is now known, makes nearer.
    #[inline]
    fn spread(&mut self, place: usize, distance: f64) {
        let stencil = self.stencil;
        stencil.for_dependents(place, |cell, index, opposite| {
            let is_nearest = opposite.is_none_or(|opposite| distance < self.distance(opposite));
            if is_nearest && !self.values[cell].is_known() {
                let (trial, nearest) = self.update(cell, index);
                self.offer(cell, trial, nearest);
            }
        });
    }

    #[inline]
    fn offer(&mut self, place: usize, distance: f64, nearest: u32) {
        if self.values[place].is_improved_by(distance) {
            self.values[place] = Value::trial(distance);
            if let Some(number) = self.nearest.get_mut(place) {
                *number = nearest;
            }
            self.queue.push(Entry { distance, place: place as u32 });
        }
    }

    /// The distance of a cell from its known neighbours, and the seed that it counts from.
    #[inline]
    fn update(&self, place: usize, index: [usize; D]) -> (f64, u32) {
        let mut upwinds = [Upwind::default(); N];
        for (direction, upwind) in upwinds.iter_mut().enumerate() {
            *upwind = self.upwind(place, direction);
        }
        let nearest = self.nearest_of(&upwinds);
        let seed = &self.seeds[nearest as usize];
        let factor = Factor::new(self.stencil, seed, place, index);
        let distance = (if self.second_order { factor.solve(&upwinds, true) } else { None })
            .or_else(|| factor.solve(&upwinds, false))
            .or_else(|| self.solve_plainly(place, &upwinds))
            .unwrap_or(f64::INFINITY);
        (distance, nearest)
    }

    /// The seed that the nearest of a cell's neighbours counts from.
    #[inline]
    fn nearest_of(&self, upwinds: &[Upwind; N]) -> u32 {
        if self.nearest.is_empty() {
            return 0;
        }
        let least = upwinds.iter().fold(upwinds[0], |a, &b| if b.near < a.near { b } else { a });
        self.nearest[least.place]
    }

    #[inline]
    fn upwind(&self, place: usize, direction: usize) -> Upwind {
        let neighbour = |steps| {
            let place = self.stencil.neighbour(place, direction, steps)?;
            Some((place, self.distance(place)))
        };
        let unknown = (place, f64::INFINITY);
        let (behind, ahead) = (neighbour(-1).unwrap_or(unknown), neighbour(1).unwrap_or(unknown));
        let (side, (place, near)) = if ahead.1 < behind.1 { (1, ahead) } else { (-1, behind) };
        let next = neighbour(2 * side).map_or(f64::INFINITY, |(_, distance)| distance);
        Upwind { side, place, near, next }
    }

    /// The distance without factor, to first order: there always is one.
    #[cold]
    fn solve_plainly(&self, place: usize, upwinds: &[Upwind; N]) -> Option<f64> {
        let mut differences = Differences::<N>::new();
        for (direction, upwind) in upwinds.iter().enumerate() {
            let weight = self.stencil.weight(place, direction);
            differences.insert(Difference { weight, slope: 1.0, rest: upwind.near, near: upwind.near });
        }
        differences.solve()
    }
}

/// The distance as a product `T = r tau` of the distance r in the constant metric of the source and a
/// smooth factor tau: derivatives of r are exact, only those of tau are differences (Luo and Qian,
/// 2012; Treister and Haber, 2016).
struct Factor<'a, const D: usize, const N: usize, S> {
    stencil: &'a S,
    seed: &'a Seed<D>,
    place: usize,
    /// `metric d`, where d leads from the source to the cell.
    covector: [f64; D],
    /// `d' metric d`, and one over it.
    r_sq: f64,
    per_r_sq: f64,
}

impl<'a, const D: usize, const N: usize, S: Stencil<D, N>> Factor<'a, D, N, S> {
    #[inline]
    fn new(stencil: &'a S, seed: &'a Seed<D>, place: usize, index: [usize; D]) -> Self {
        let d: [f64; D] = std::array::from_fn(|axis| index[axis] as f64 - seed.point[axis]);
        let covector = apply(&seed.metric, d);
        let r_sq = (0..D).map(|axis| d[axis] * covector[axis]).sum::<f64>();
        Self { stencil, seed, place, covector, r_sq, per_r_sq: 1.0 / r_sq }
    }

    #[inline]
    fn solve(&self, upwinds: &[Upwind; N], second_order: bool) -> Option<f64> {
        let nearest = upwinds.iter().map(|upwind| upwind.near).fold(f64::INFINITY, f64::min);
        let mut differences = Differences::<N>::new();
        for (direction, upwind) in upwinds.iter().enumerate() {
            if upwind.near < f64::INFINITY {
                differences.insert(self.difference(direction, upwind, second_order));
            } else if let Some(difference) = self.beside_the_source(direction, nearest) {
                differences.insert(difference);
            }
        }
        differences.solve()
    }

    /// The derivative in a direction from which nothing comes because the source lies less than a
    /// step away from the cell: that of r alone.
    #[inline]
    fn beside_the_source(&self, direction: usize, near: f64) -> Option<Difference> {
        let along = self.stencil.along(self.place, direction, &self.covector).abs();
        let step_sq = self.stencil.length_sq(self.place, direction, &self.seed.metric);
        let initial = self.seed.initial;
        (0.0 < along && along < step_sq).then(|| {
            let slope = along * self.per_r_sq;
            let weight = self.stencil.weight(self.place, direction);
            Difference { weight, slope, rest: slope * initial, near }
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
        // r times the factor tau of the neighbour that many steps back.
        let carried = |distance: f64, steps: f64| {
            // r'^2 = (1 - x) r^2
            let x = (2.0 * steps * away - steps * steps * step_sq) * self.per_r_sq;
            if 1.0 - x > 1e-9 * self.per_r_sq * step_sq {
                (distance - initial) * one_over_sqrt_one_minus(x)
            } else {
                // At the source itself tau is 1.
                self.r_sq.sqrt()
            }
        };
        let growth = away * self.per_r_sq;
        let (slope, rest) = if second_order && next <= near {
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
