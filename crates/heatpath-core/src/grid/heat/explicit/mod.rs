//! Explicit Euler: `u' = u + step k div(D grad u)`.
//!
//! What is computed stands in `kernel.rs`, one row at a time, and where D is a tensor in
//! `gather.rs` and `gathering.rs`. In which order, on which thread and in which range of numbers
//! stands in `schedule.rs` and `scaled.rs`, and changes no bit of u.

mod gather;
mod gathering;
mod kernel;
mod scaled;
mod schedule;
mod stencil;

use super::operator::{FaceMean, Operator};
use super::{Heat, Scheme, shares};
use crate::exec::{Cancelled, Exec};
use crate::grid::medium::Medium;
use crate::grid::{Grid, Sources};
use schedule::{Fields, MOST_DEPTH, Steps, Tiles, Tiling};
use stencil::Stencil;
use thiserror::Error;

/// How long heat flows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Duration {
    /// As many steps as the longest side has cells, times the dimension: twice that side in images,
    /// the paper's choice for voting, three times in volumes. Heat moves one cell a step, so it can
    /// cross any open grid, from corner to corner.
    #[default]
    Usual,
    /// This many steps.
    Iterations(usize),
    /// This much time, in cell units (multiples of the smallest spacing squared); the step is
    /// shortened so that a whole number of steps fills it.
    Time(f64),
}

/// The length of a time step, in cell units (multiples of the smallest spacing squared).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Step {
    /// [`Step::usual`]: 0.2 in images, the paper's choice, and 0.1333 in volumes. Where D is a
    /// tensor and that is too large, [`Step::SAFE_FRACTION`] of the largest stable step: the usual
    /// one is stable where a constant D has no eigenvalue above 1, but where its directions turn,
    /// more may flow into a cell, and tensors come in any unit.
    #[default]
    Usual,
    /// Exactly this.
    Fixed(f64),
    /// [`Step::SAFE_FRACTION`] of the largest stable step of the medium.
    Auto,
}

impl Step {
    /// The part of the largest stable step that [`Step::Auto`] takes, and [`Step::Usual`] of that of
    /// the uniform medium.
    pub const SAFE_FRACTION: f64 = 0.8;

    /// The usual step in `dimension` dimensions: [`Self::SAFE_FRACTION`] of `1 / (2 dimension)`, the
    /// largest stable one for k = D = 1 in cells of equal sides.
    ///
    /// That is 0.2 in images, as in the paper, and 0.1333 in volumes. It depends on nothing else, so
    /// that results from several images can be compared.
    #[must_use]
    pub const fn usual(dimension: usize) -> f64 {
        Self::SAFE_FRACTION / (2 * dimension) as f64
    }
}

/// The parameters of [`Explicit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatOptions {
    /// How long heat flows.
    pub duration: Duration,
    /// The length of a time step.
    pub step: Step,
    /// How the diffusion coefficient of a face is made from its two cells, where it is a number.
    pub face_mean: FaceMean,
    /// Whether to keep the exposure ([`Heat::ln_exposure`]), which paths follow. It takes a quarter of
    /// the time and 8 bytes a cell; distances alone do not need it. The default is true.
    pub exposure: bool,
}

impl Default for HeatOptions {
    fn default() -> Self {
        Self {
            duration: Duration::default(),
            step: Step::default(),
            face_mean: FaceMean::default(),
            exposure: true,
        }
    }
}

/// Why heat cannot flow as asked.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HeatError {
    /// The step would make the scheme unstable.
    #[error(
        "the time step {step} is too large: the largest stable step in this medium is \
         {largest_stable}"
    )]
    StepTooLarge {
        /// The step asked for, in cell units.
        step: f64,
        /// The largest stable step, in cell units.
        largest_stable: f64,
    },
    /// The step is not a positive number, or absurdly small.
    #[error("the time step is {0}; it must be a positive number, at least 1e-100")]
    Step(f64),
    /// The time is not a positive number.
    #[error("the time is {0}; it must be a positive finite number")]
    Time(f64),
    /// There are no iterations, or more than anybody could wait for.
    #[error("the number of iterations is {0:?}; it must be from 1 to 1e12")]
    Iterations(f64),
    /// u falls by more than 578 powers of ten within a few cells.
    #[error(
        "the heat falls by more than 578 powers of ten within some 8 cells, or from one side of a \
         wall to the other: the medium is too slow there; raise its floor, or make slow cells walls"
    )]
    Range,
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The smallest step and the most iterations that make sense.
const SMALLEST_STEP: f64 = 1e-100;
const MOST_ITERATIONS: f64 = 1e12;

/// How far below a level heat does not count, in logarithms: e^-100 of it, even from every cell at
/// every step, is nothing.
const MARGIN: f64 = 100.0;

/// Explicit heat in one medium, prepared once for any number of sources.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::heat::{Explicit, HeatOptions};
/// use heatpath_core::grid::{Shape, Sources, medium};
///
/// let medium = medium::uniform(Shape::new([64, 48])?);
/// let explicit = Explicit::new(&medium, HeatOptions::default())?;
/// let sources = Sources::new(&[[20.0, 20.0]], medium.mask())?;
/// let heat = explicit.flow(&sources, &Exec::single_threaded())?;
/// assert_eq!(heat.iterations(), 128);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Memory while heat flows, beyond the medium, in numbers of 8 bytes a cell: two for u before and
/// after a visit, one for the exposure if it is kept, and one for the conductances across each axis
/// if D varies or there are walls. So 2 to 5 in a picture and 2 to 6 in a volume. Where D is a
/// tensor the conductances take some 6 to 12 in a picture and 12 to 30 in a volume, the more the
/// faster its directions turn, and about twice that while they are prepared.
#[derive(Debug)]
pub struct Explicit<'a, const D: usize> {
    medium: &'a Medium<D>,
    stencil: Stencil<D>,
    iterations: usize,
    step: f64,
    exposure: bool,
    /// How many powers of two below the hottest tile heat is let go; `None` keeps all.
    depth: Option<i32>,
}

impl<'a, const D: usize> Explicit<'a, D> {
    /// Prepares heat in `medium`.
    ///
    /// # Errors
    /// A step above the largest stable one, or a step, time or number of iterations that is not
    /// positive.
    pub fn new(medium: &'a Medium<D>, options: HeatOptions) -> Result<Self, HeatError> {
        let operator = Operator::new(medium, options.face_mean);
        let largest_stable = operator.largest_stable_step();
        let step = match options.step {
            Step::Usual if operator.links().is_some() => {
                Step::usual(D).min(Step::SAFE_FRACTION * largest_stable)
            }
            Step::Usual => Step::usual(D),
            Step::Fixed(step) => step,
            // Where nothing can flow any step does.
            Step::Auto if largest_stable.is_infinite() => Step::usual(D),
            Step::Auto => Step::SAFE_FRACTION * largest_stable,
        };
        if step > largest_stable {
            return Err(HeatError::StepTooLarge { step, largest_stable });
        }
        let usual = (D * medium.shape().longest_side()) as f64;
        let (iterations, step) = steps(options.duration, step, usual)?;
        let (stencil, exposure) = (Stencil::new(&operator, step), options.exposure);
        Ok(Self { medium, stencil, iterations, step, exposure, depth: None })
    }

    /// Lets heat go that is far below `level`, for those who want to know no more than where
    /// `-ln(u / u_max)` is below it, and the exposure there: these are the same in all but the last
    /// bits, and heat may fall by any number of powers of ten.
    pub(crate) fn down_to(self, level: f64) -> Self {
        let depth = ((level + MARGIN) / std::f64::consts::LN_2).ceil() as i32;
        Self { depth: (depth <= MOST_DEPTH).then_some(depth), ..self }
    }

    /// The number of time steps.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// The time step in cell units.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Lets heat flow from `sources`, which all begin with u = 1 (shared between cells if a source
    /// lies between them).
    ///
    /// # Errors
    /// The medium is slower in places than any range of numbers, or the caller cancelled.
    pub fn flow(&self, sources: &Sources<D>, exec: &Exec) -> Result<Heat<D>, HeatError> {
        let heat = self.flow_reporting(sources, &mut |finished| exec.report(finished), exec)?;
        exec.report(1.0)?;
        Ok(heat)
    }

    /// [`flow`](Self::flow) as a part of something longer, told of its progress by `report`.
    pub(crate) fn flow_reporting(
        &self,
        sources: &Sources<D>,
        report: &mut dyn FnMut(f64) -> Result<(), Cancelled>,
        exec: &Exec,
    ) -> Result<Heat<D>, HeatError> {
        let amounts = vec![1.0; sources.points().len()];
        self.flow_amounts(sources, amounts, self.exposure, report, exec)
    }

    /// Lets heat flow from `sources` with amounts that make them equally warm at the end.
    ///
    /// A source in a fast medium loses its heat sooner than one in a slow medium; with equal
    /// amounts it would end up colder and seem further away. With one source this is
    /// [`flow`](Self::flow); with several, heat flows twice: the first time to find the amounts.
    ///
    /// # Errors
    /// The medium is slower in places than any range of numbers, or the caller cancelled.
    pub fn flow_balanced(&self, sources: &Sources<D>, exec: &Exec) -> Result<Heat<D>, HeatError> {
        let count = sources.points().len();
        if count == 1 {
            return self.flow(sources, exec);
        }
        let first_half = &mut |finished: f64| exec.report(0.5 * finished);
        let heat = self.flow_amounts(sources, vec![1.0; count], false, first_half, exec)?;
        let ln_temperatures = heat.ln_temperature_at_sources();
        let hottest = ln_temperatures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let amounts = ln_temperatures.iter().map(|ln| (hottest - ln).exp()).collect();
        let second_half = &mut |finished: f64| exec.report(0.5 + 0.5 * finished);
        let heat = self.flow_amounts(sources, amounts, self.exposure, second_half, exec)?;
        exec.report(1.0)?;
        Ok(heat)
    }

    fn flow_amounts(
        &self,
        sources: &Sources<D>,
        amounts: Vec<f64>,
        exposure: bool,
        report: &mut dyn FnMut(f64) -> Result<(), Cancelled>,
        exec: &Exec,
    ) -> Result<Heat<D>, HeatError> {
        let (shape, mask) = (*self.medium.shape(), self.medium.mask());
        let shares: Vec<(usize, f64)> = sources
            .points()
            .iter()
            .zip(&amounts)
            .flat_map(|(&point, amount)| {
                shares(mask, point).into_iter().map(move |(cell, weight)| (cell, amount * weight))
            })
            .collect();
        let steps = Steps {
            stencil: &self.stencil,
            factor: match self.stencil {
                Stencil::Faces(_) => self.medium.factor(),
                Stencil::Gather(_) => None,
            },
            step: self.step,
            iterations: self.iterations,
            exposure,
            spare: self.spare(&shares),
            depth: self.depth,
        };
        let tilings = Tiling::all(&self.stencil, &shape);
        let (ln_temperature, ln_exposure) = self.march(tilings, &steps, &shares, report, exec)?;
        let cell = |&point: &[f64; D]| shape.position(shape.cell_at(point));
        Ok(Heat {
            scheme: Scheme::Explicit,
            sources: sources.clone(),
            mask: mask.clone(),
            amounts,
            speeds_sq: sources.points().iter().map(|p| self.medium.speed_sq(cell(p))).collect(),
            ln_temperature,
            ln_exposure,
            iterations: self.iterations,
            step: self.step,
        })
    }

    /// Tries ever smaller tiles until they hold the range of the values.
    fn march(
        &self,
        mut tilings: impl Iterator<Item = Tiling<D>>,
        steps: &Steps<'_, D>,
        shares: &[(usize, f64)],
        report: &mut dyn FnMut(f64) -> Result<(), Cancelled>,
        exec: &Exec,
    ) -> Result<Fields<D>, HeatError> {
        let shape = self.medium.shape();
        while let Some(tiling) = tilings.next() {
            let mut heat = Tiles::new(shape, tiling);
            shares.iter().for_each(|&(cell, amount)| heat.add(cell, amount));
            match heat.march(steps, &mut tilings, report, exec)? {
                Some(fields) if self.depth.is_some() || !self.has_lost_heat(&fields, shares) => {
                    return Ok(fields);
                }
                _ => {}
            }
        }
        Err(HeatError::Range)
    }

    /// Whether a cell within reach has no heat: its tile had to hold too wide a range of values.
    fn has_lost_heat(&self, fields: &Fields<D>, shares: &[(usize, f64)]) -> bool {
        let mask = self.medium.mask();
        let (temperature, exposure) = (fields.0.values(), fields.1.as_ref().map(Grid::values));
        let cold = |cell: usize| {
            temperature[cell] == f64::NEG_INFINITY
                || exposure.is_some_and(|exposure| exposure[cell] == f64::NEG_INFINITY)
        };
        (0..temperature.len()).any(|cell| cold(cell) && mask.is_open(cell))
            && self.fronts(shares).take(self.iterations + 1).flatten().any(cold)
    }

    /// How many steps heat has in reserve when it comes to the furthest cell, if there are no walls.
    fn spare(&self, shares: &[(usize, f64)]) -> Option<usize> {
        if !self.medium.mask().is_all_open() {
            return None;
        }
        let shape = self.medium.shape();
        let furthest_from = |&(cell, _): &(usize, f64)| -> usize {
            shape.index(cell).iter().zip(shape.size()).map(|(&i, n)| i.max(n - 1 - i)).sum()
        };
        let furthest = shares.iter().map(furthest_from).min().unwrap_or(0);
        Some(self.iterations.saturating_sub(furthest))
    }

    /// The cells where heat is at first, and those to which it comes at each step.
    fn fronts(&self, shares: &[(usize, f64)]) -> impl Iterator<Item = Vec<usize>> {
        let (shape, mask) = (self.medium.shape(), self.medium.mask());
        let mut met = vec![false; shape.cells()];
        let first: Vec<usize> = shares.iter().map(|&(cell, _)| cell).collect();
        first.iter().for_each(|&cell| met[cell] = true);
        std::iter::successors(Some(first), move |front| {
            let mut next: Vec<usize> = match &self.stencil {
                Stencil::Faces(_) => {
                    front.iter().flat_map(|&cell| shape.neighbours(cell)).collect()
                }
                Stencil::Gather(gather) => {
                    front.iter().flat_map(|&cell| gather.neighbours(cell)).collect()
                }
            };
            next.retain(|&cell| mask.is_open(cell) && !std::mem::replace(&mut met[cell], true));
            (!next.is_empty()).then_some(next)
        })
    }
}

/// The number of steps, which usually is `usual`, and their length.
fn steps(duration: Duration, step: f64, usual: f64) -> Result<(usize, f64), HeatError> {
    let usable = |step: f64| step.is_finite() && step >= SMALLEST_STEP;
    if !usable(step) {
        return Err(HeatError::Step(step));
    }
    let (iterations, step) = match duration {
        Duration::Usual => (usual, step),
        Duration::Iterations(iterations) => (iterations as f64, step),
        Duration::Time(time) if !(time.is_finite() && time > 0.0) => {
            return Err(HeatError::Time(time));
        }
        Duration::Time(time) => {
            let iterations = (time / step).ceil();
            (iterations, time / iterations)
        }
    };
    if !usable(step) {
        return Err(HeatError::Step(step));
    }
    if !(1.0..=MOST_ITERATIONS).contains(&iterations) {
        return Err(HeatError::Iterations(iterations));
    }
    Ok((iterations as usize, step))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod tests {
    use super::*;
    use crate::grid::{Shape, TensorField, medium};

    /// Large tiles are cut on the way: heat that just comes to the far corner falls by thousands of
    /// powers of ten.
    #[test]
    fn the_temperature_does_not_depend_on_tiles() {
        let shape = Shape::new([640, 420]).unwrap();
        let field = Grid::from_fn(shape, |[x, y]| {
            let lane = if y / 12 % 2 == 0 { 2e-3 } else { 1.0 };
            lane * (1.0 + (x * 7919 + y * 104_729) as f64 % 13.0) / 14.0
        });
        let medium = medium::given(field, medium::Form::Divergence).unwrap();
        same_in_all_tiles(&medium, 1100, 4);
    }

    /// Heat moves up to three cells a step, and what lies around a tile is wrong after as many.
    #[test]
    fn the_temperature_does_not_depend_on_tiles_where_heat_moves_further_than_a_cell() {
        let shape = Shape::new([330, 270]).unwrap();
        let field = TensorField::from_fn(shape, |[x, y]| {
            let (sin, cos) = (0.011 * (x + 2 * y) as f64).sin_cos();
            let along = [cos, sin];
            let part =
                |i: usize, j: usize| 0.95 * along[i] * along[j] + if i == j { 0.05 } else { 0.0 };
            std::array::from_fn(|i| std::array::from_fn(|j| part(i, j)))
        });
        let medium = medium::given_tensor(field).unwrap();
        for skipped in [1, 3, 5] {
            same_in_all_tiles(&medium, 131, skipped);
        }
    }

    /// Compares the largest tiles with smaller ones.
    fn same_in_all_tiles(medium: &Medium<2>, iterations: usize, skipped: usize) {
        let shape = *medium.shape();
        let duration = Duration::Iterations(iterations);
        let explicit =
            Explicit::new(medium, HeatOptions { duration, ..Default::default() }).unwrap();
        let shares = [(shape.position([2, 3]), 1.0)];
        let steps = Steps {
            stencil: &explicit.stencil,
            factor: None,
            step: explicit.step,
            iterations: explicit.iterations,
            exposure: true,
            spare: explicit.spare(&shares),
            depth: None,
        };
        let exec = Exec::single_threaded();
        let from = |skipped: usize| {
            let tilings = Tiling::all(&explicit.stencil, &shape).skip(skipped);
            explicit.march(tilings, &steps, &shares, &mut |_| Ok(()), &exec).unwrap()
        };
        let (large, small) = (from(0), from(skipped));
        assert_eq!(large.0, small.0);
        assert!(iterations < 600 || large.0.values().iter().all(|ln| ln.is_finite()));
        let (large, small) = (large.1.unwrap(), small.1.unwrap());
        for (a, b) in large.values().iter().zip(small.values()) {
            assert!(a == b || (a - b).abs() <= 1e-12 * a.abs().max(1.0), "{a} {b}");
        }
    }
}
