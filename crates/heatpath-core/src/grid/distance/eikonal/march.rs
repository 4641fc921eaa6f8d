//! Fast marching: cells in the order of their distance, each from those before it.

use super::Order;
use super::factor::{Factor, Upwind};
use super::pair::solve_two;
use super::queue::{Entry, Queue};
use super::seed::Seed;
use super::stencil::{Dependent, Stencil};
use super::update::{Difference, Differences};
use super::value::{Value, choose};
use crate::exec::{Cancelled, Exec};
use std::collections::BTreeSet;
use std::hint::select_unpredictable;

/// The distances so far, place by place.
pub(super) struct Front<'a, const D: usize, const N: usize, S> {
    stencil: &'a S,
    seeds: &'a [Seed<D>],
    second_order: bool,
    values: Vec<Value>,
    /// The number of the seed that each known distance counts from; nothing if there is only one.
    nearest: Vec<u32>,
    queue: Queue,
}

/// How often a watch is asked, in cells.
pub(super) const REPORT_EVERY: usize = 1 << 15;

/// The most that a step from a neighbour may cost, over what it costs in the cell, squared. A tenth
/// more leaves room for smooth media; in mazes and rough media, where T / r is far from smooth, it
/// catches what would overshoot.
const LARGEST_STEP_SQ: f64 = 1.21;

impl<'a, const D: usize, const N: usize, S: Stencil<D, N>> Front<'a, D, N, S> {
    pub(super) fn new(stencil: &'a S, seeds: &'a [Seed<D>], order: Order, width: f64) -> Self {
        let places = stencil.places();
        let value = |place| if stencil.is_open(place) { Value::FAR } else { Value::WALL };
        Self {
            stencil,
            seeds,
            second_order: order == Order::Second,
            values: (0..places).map(value).collect(),
            nearest: if seeds.len() > 1 { vec![0; places] } else { Vec::new() },
            queue: Queue::new(width),
        }
    }

    /// Marches until every cell up to the distance `farthest` is known, or all `targets` if there are
    /// any.
    pub(super) fn march(
        &mut self,
        farthest: f64,
        mut targets: BTreeSet<usize>,
        exec: &Exec,
    ) -> Result<(), Cancelled> {
        for (number, seed) in self.seeds.iter().enumerate() {
            for &(place, distance) in &seed.cells {
                self.offer(place, distance, number as u32);
            }
        }
        let mut known = 0_usize;
        while let Some(Entry { distance, place }) = self.pop() {
            let place = place as usize;
            if !self.values[place].is_trial(distance) {
                continue;
            }
            if distance > farthest {
                break;
            }
            self.values[place] = Value::known(distance);
            if targets.remove(&place) && targets.is_empty() {
                break;
            }
            self.spread(place, distance);
            known += 1;
            if known.is_multiple_of(REPORT_EVERY) {
                exec.report(known as f64 / self.values.len() as f64)?;
            }
        }
        Ok(())
    }

    fn pop(&mut self) -> Option<Entry> {
        let values = &self.values;
        let stencil = self.stencil;
        let distance = |place| values[place as usize].as_trial();
        self.queue.pop(distance, |place| stencil.prefetch_around(place as usize, values))
    }

    /// The distance of the cell at a place, infinite if it is not known.
    #[inline]
    pub(super) fn distance(&self, place: usize) -> f64 {
        self.values[place].or_infinite()
    }

    /// The number of the seed that the distance of the cell at a place counts from, if it is known.
    pub(super) fn nearest(&self, place: usize) -> u32 {
        self.nearest.get(place).copied().unwrap_or(0)
    }

    /// Renews all cells that the cell at `place`, whose distance is now known, makes nearer.
    #[inline]
    fn spread(&mut self, place: usize, distance: f64) {
        let stencil = self.stencil;
        if D == 2 && N == D && self.seeds.len() == 1 && self.second_order {
            return self.spread_in_pairs(place, distance);
        }
        stencil.for_dependents(place, |cell| {
            let is_nearest = cell.opposite.is_none_or(|place| distance < self.distance(place));
            if is_nearest && !self.values[cell.place].is_known() {
                let first = if N == D { self.first_distance(&cell) } else { None };
                debug_assert!(
                    first.is_none_or(|first| first == self.update(cell.place, cell.index))
                );
                let (trial, nearest) = first.unwrap_or_else(|| self.update(cell.place, cell.index));
                // No cell may come nearer than one that is known already.
                self.offer(cell.place, trial.max(distance), nearest);
            }
        });
    }

    /// The same along the axes of a picture, from one seed: the cells are listed without a jump, and two
    /// at a time are solved for.
    #[inline]
    fn spread_in_pairs(&mut self, place: usize, distance: f64) {
        // At most four stay; one more may be written behind them.
        let mut cells = [(0, [0; D]); 8];
        let mut count = 0;
        self.stencil.for_dependents(place, |cell| {
            let is_nearest = cell.opposite.is_none_or(|place| distance < self.distance(place));
            cells[count % 8] = (cell.place, cell.index);
            count += usize::from(is_nearest & !self.values[cell.place].is_known());
        });
        for at in (0..count).step_by(2) {
            let two = [cells[at], cells[(at + 1).min(count - 1)]];
            let upwind = |place, direction| self.upwind(place, direction);
            let seed = &self.seeds[0];
            let found = solve_two(self.stencil, seed, &two, upwind, LARGEST_STEP_SQ);
            for ((cell, index), found) in two.into_iter().zip(found).take(count - at) {
                let trial = found.unwrap_or_else(|| self.update(cell, index).0);
                self.offer(cell, trial.max(distance), 0);
            }
        }
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

    /// The distance of a cell from its known neighbours, and the seed that it counts from: the least
    /// over the seeds that its neighbours count from.
    #[inline]
    fn update(&self, place: usize, index: [usize; D]) -> (f64, u32) {
        let mut upwinds = [Upwind::default(); N];
        for (direction, upwind) in upwinds.iter_mut().enumerate() {
            *upwind = self.upwind(place, direction);
        }
        let best = if self.seeds.len() == 1 {
            (self.distance_from(0, place, index, &upwinds), 0)
        } else {
            self.least_over_seeds(place, index, &upwinds)
        };
        match self.stencil.nearest_along_axes(place, |other| self.distance(other)) {
            Some((distance, other)) if distance < best.0 => (distance, self.nearest(other)),
            _ => best,
        }
    }

    /// The same along the axes for a cell without a distance so far: only the one neighbour of it is known,
    /// and no other is looked at. `None` for other cells, and where more is to be considered.
    #[inline(always)]
    fn first_distance(&self, cell: &Dependent<D>) -> Option<(f64, u32)> {
        let &Dependent { place, index, direction, .. } = cell;
        let direction = direction.filter(|_| self.values[place] == Value::FAR)?;
        let upwind = self.upwind(place, direction);
        let factor = Factor::new(self.stencil, &self.seeds[upwind.seed as usize], place, index);
        let distance = factor.solve_with_one(direction, &upwind, self.second_order)?;
        self.is_plausible(distance, place, direction, &upwind).then_some((distance, upwind.seed))
    }

    fn least_over_seeds(
        &self,
        place: usize,
        index: [usize; D],
        upwinds: &[Upwind; N],
    ) -> (f64, u32) {
        let mut best = (f64::INFINITY, 0);
        for upwind in upwinds.iter().filter(|upwind| upwind.near < f64::INFINITY) {
            let own = upwinds.map(|other| other.seen_from(upwind.seed));
            let distance = self.distance_from(upwind.seed, place, index, &own);
            if distance < best.0 {
                best = (distance, upwind.seed);
            }
        }
        best
    }

    #[inline(always)]
    fn distance_from(
        &self,
        seed: u32,
        place: usize,
        index: [usize; D],
        upwinds: &[Upwind; N],
    ) -> f64 {
        let factor = Factor::new(self.stencil, &self.seeds[seed as usize], place, index);
        let is_plausible = |distance: &f64| {
            upwinds.iter().enumerate().fold(true, |is_plausible, (direction, upwind)| {
                is_plausible & self.is_plausible(*distance, place, direction, upwind)
            })
        };
        (if self.second_order { factor.solve(upwinds, true) } else { None })
            .filter(is_plausible)
            .or_else(|| factor.solve(upwinds, false).filter(is_plausible))
            .or_else(|| self.solve_plainly(place, upwinds))
            .unwrap_or(f64::INFINITY)
    }

    /// Whether the step from a neighbour costs what it may.
    #[inline(always)]
    fn is_plausible(&self, distance: f64, place: usize, direction: usize, upwind: &Upwind) -> bool {
        let step = (distance - upwind.near).max(0.0);
        self.stencil.weight(place, direction) * step * step <= LARGEST_STEP_SQ
    }

    /// The known neighbours of a cell in one direction, on the nearer side. Those of both sides are
    /// read: where they come from memory, all are under way at once.
    #[inline(always)]
    fn upwind(&self, place: usize, direction: usize) -> Upwind {
        let neighbour = |steps| match self.stencil.neighbour(place, direction, steps) {
            Some(place) => (place, self.distance(place)),
            None => (place, f64::INFINITY),
        };
        let (behind, ahead) = ([neighbour(-1), neighbour(-2)], [neighbour(1), neighbour(2)]);
        let is_ahead = ahead[0].1 < behind[0].1;
        let places = [0, 1].map(|i| select_unpredictable(is_ahead, ahead[i].0, behind[i].0));
        let [near, next] = [0, 1].map(|i| choose(is_ahead, ahead[i].1, behind[i].1));
        let seed = self.nearest(places[0]);
        let next = if self.nearest(places[1]) == seed { next } else { f64::INFINITY };
        Upwind { side: 2 * isize::from(is_ahead) - 1, near, next, seed, is_foreign: false }
    }

    /// The distance without factor, to first order: there always is one.
    #[cold]
    fn solve_plainly(&self, place: usize, upwinds: &[Upwind; N]) -> Option<f64> {
        let mut differences = Differences::<N>::new();
        for (direction, upwind) in upwinds.iter().enumerate() {
            let weight = self.stencil.weight(place, direction);
            differences.insert(Difference {
                weight,
                slope: 1.0,
                rest: upwind.near,
                near: upwind.near,
            });
        }
        differences.solve()
    }
}
