//! Implicit Euler: `(1 - step k div(D grad)) u' = u`, solved directly.
//!
//! Written as `(1/k + step L) u' = u / k` with `L = -div(D grad)` the matrix is symmetric and
//! positive definite, and none of its entries off the diagonal is positive (an M-matrix). Nothing
//! cancels in its factorisation or in the solution, so u is positive and accurate to its last bits
//! in every cell, however small. That is what logarithms need: iterative solvers, whose residual is
//! small, leave most cells without a correct digit.

mod elimination;
mod options;
mod order;
mod system;

pub(crate) use elimination::{Elimination, faces};
pub use options::{ImplicitError, ImplicitOptions};
pub(crate) use system::check_memory;

use super::links::Links;
use super::operator::{FaceMean, Operator};
use super::{Heat, Scheme, shares};
use crate::exec::Exec;
use crate::grid::medium::Medium;
use crate::grid::{Grid, Sources};
use crate::linear::{Cholesky, Entries, Wide};
use options::{explained, step};
use std::borrow::Cow;
use system::{couplings, matrix};

/// Implicit heat in one medium, borrowed or owned, factored once for any number of sources.
///
/// One step of any length costs one pass through the factor, whatever the medium, and there is no
/// stable step to keep: distances from many sources in one picture are much cheaper than by
/// [`Explicit`](super::Explicit) heat. The factor takes memory, some 550 bytes a cell for a picture
/// of 512 x 512 cells and growing with the logarithm of its side, and much more for volumes.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::distance::normalized;
/// use heatpath_core::grid::heat::{Implicit, ImplicitOptions};
/// use heatpath_core::grid::{Shape, Sources, medium};
///
/// let medium = medium::uniform(Shape::new([64, 48])?);
/// let exec = Exec::single_threaded();
/// let implicit = Implicit::new(&medium, ImplicitOptions::default(), &exec)?;
/// let sources = Sources::new(&[[20.0, 20.0]], medium.mask())?;
/// let distances = normalized(&implicit.flow(&sources, &exec)?);
/// assert!((distances.at([50.0, 20.0]) - 30.0).abs() < 0.15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Implicit<'a, const D: usize> {
    medium: Cow<'a, Medium<D>>,
    face_mean: FaceMean,
    /// The open cells in the order of elimination.
    cells: Vec<usize>,
    /// The place of each cell in that order.
    places: Vec<usize>,
    cholesky: Cholesky,
    step: f64,
    steps: usize,
}

impl<'a, const D: usize> Implicit<'a, D> {
    /// Prepares heat in `medium`: analyses and factors the system.
    ///
    /// # Errors
    /// A time or number of steps out of range; more memory than allowed, in which case the message
    /// names both and nothing of that size was allocated; or the caller cancelled.
    pub fn new(
        medium: impl Into<Cow<'a, Medium<D>>>,
        options: ImplicitOptions,
        exec: &Exec,
    ) -> Result<Self, ImplicitError> {
        let (medium, face_mean) = (medium.into(), options.face_mean);
        check_memory(&medium, options.memory_limit)?;
        let operator = Operator::new(&medium, face_mean);
        let step = step(options.time, options.steps, operator.largest_stable_step())?;
        let reach = operator.links().map_or([1; D], Links::reach);
        let pairs = couplings(&operator).into_iter();
        let elimination = Elimination::new(medium.mask(), reach, pairs, options.memory_limit)?;
        let (diagonal, couplings) = matrix(&operator, &elimination.cells, step);
        let cholesky = elimination.factor(&diagonal, &couplings, exec)?;
        let Elimination { cells, places, .. } = elimination;
        Ok(Self { medium, face_mean, cells, places, cholesky, step, steps: options.steps })
    }

    /// The same medium with another time (in cell units) and number of steps.
    ///
    /// The system is factored again in the same memory, but not analysed again.
    ///
    /// # Errors
    /// As for [`new`](Self::new); nothing is left then.
    pub fn with_time(
        mut self,
        time: f64,
        steps: usize,
        exec: &Exec,
    ) -> Result<Self, ImplicitError> {
        let operator = Operator::new(&self.medium, self.face_mean);
        self.step = step(time, steps, operator.largest_stable_step())?;
        self.steps = steps;
        let (diagonal, couplings) = matrix(&operator, &self.cells, self.step);
        self.cholesky.refactor(&diagonal, &couplings, exec).map_err(explained)?;
        Ok(self)
    }

    /// The medium.
    #[must_use]
    pub fn medium(&self) -> &Medium<D> {
        &self.medium
    }

    /// The number of time steps.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.steps
    }

    /// The time step in cell units.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The memory that the factorisation takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.cholesky.analysis().bytes()
    }

    /// How many entries of the factor are too small for f64, across half of a large grid or slow
    /// medium.
    ///
    /// If there are any, heat is corrected until nothing is missing: right all the same, but
    /// several times slower.
    #[must_use]
    pub fn lost(&self) -> usize {
        self.cholesky.lost()
    }

    /// Lets heat flow from `sources`, which all begin with u = 1 (shared between cells if a source
    /// lies between them).
    ///
    /// # Errors
    /// The caller cancelled.
    pub fn flow(&self, sources: &Sources<D>, exec: &Exec) -> Result<Heat<D>, ImplicitError> {
        self.flow_amounts(&[(sources, vec![1.0; sources.points().len()])], exec)
            .map(|mut heats| heats.remove(0))
    }

    /// Lets heat flow from each of several sets of sources, as [`flow`](Self::flow) would from one
    /// after the other.
    ///
    /// The sets are shared between the threads, and several at a time go through the factor
    /// together. Memory: 8 bytes a cell for each result (16 after several steps), and some 30 for
    /// each set in work, 8 for each thread.
    ///
    /// # Errors
    /// The caller cancelled.
    pub fn flow_many(
        &self,
        sets: &[Sources<D>],
        exec: &Exec,
    ) -> Result<Vec<Heat<D>>, ImplicitError> {
        let amounts = |sources: &Sources<D>| vec![1.0; sources.points().len()];
        let sets: Vec<_> = sets.iter().map(|sources| (sources, amounts(sources))).collect();
        self.flow_amounts(&sets, exec)
    }

    /// Lets heat flow from `sources`, with amounts that make them equally strong.
    ///
    /// Heat from a source in a fast region is spread thin and would seem further away. Around a
    /// source the heat is its amount over the N-th power of the speed there, times a function of
    /// the distance: so the amounts are chosen as that power. With one source this is
    /// [`flow`](Self::flow).
    ///
    /// # Errors
    /// The caller cancelled.
    pub fn flow_balanced(
        &self,
        sources: &Sources<D>,
        exec: &Exec,
    ) -> Result<Heat<D>, ImplicitError> {
        let speeds_sq = self.speeds_sq(sources);
        let fastest = speeds_sq.iter().copied().fold(0.0, f64::max);
        let power = 0.5 * self.medium.shape().dimension() as f64;
        let amounts = speeds_sq.iter().map(|speed| (speed / fastest).powf(power)).collect();
        self.flow_amounts(&[(sources, amounts)], exec).map(|mut heats| heats.remove(0))
    }

    fn speeds_sq(&self, sources: &Sources<D>) -> Vec<f64> {
        let shape = self.medium.shape();
        let cell = |&point: &[f64; D]| shape.position(shape.cell_at(point));
        sources.points().iter().map(|point| self.medium.speed_sq(cell(point))).collect()
    }

    fn flow_amounts(
        &self,
        sets: &[(&Sources<D>, Vec<f64>)],
        exec: &Exec,
    ) -> Result<Vec<Heat<D>>, ImplicitError> {
        let mut heats = Vec::with_capacity(sets.len());
        for round in sets.chunks(8 * exec.threads()) {
            let finished = heats.len() as f64 / sets.len() as f64;
            exec.report(finished)?;
            heats.extend(self.flow_round(round, exec));
        }
        exec.report(1.0)?;
        Ok(heats)
    }

    /// All steps of several sets of sources together.
    fn flow_round(&self, sets: &[(&Sources<D>, Vec<f64>)], exec: &Exec) -> Vec<Heat<D>> {
        let mut sides: Vec<Entries> =
            sets.iter().map(|(sources, amounts)| self.start(sources, amounts)).collect();
        let mut exposures = vec![Vec::new(); sets.len()];
        for _ in 1..self.steps {
            let solutions = self.cholesky.solve(&sides, exec);
            for ((side, exposure), u) in sides.iter_mut().zip(&mut exposures).zip(solutions) {
                add(exposure, &u);
                *side = u.iter().enumerate().map(|(i, &u)| (i, self.over_factor(i, u))).collect();
            }
        }
        let solutions = self.cholesky.solve(&sides, exec);
        // === Logarithms, and nothing twice
        let mut fields: Vec<_> = solutions.into_iter().zip(exposures).map(|f| (f, None)).collect();
        exec.for_each(&mut fields, |((u, exposure), ln)| {
            let several = !exposure.is_empty();
            if several {
                add(exposure, u);
            }
            *ln = Some((self.ln(u), several.then(|| self.ln(exposure))));
            (*u, *exposure) = (Vec::new(), Vec::new());
        });
        let fields = fields.into_iter().filter_map(|(_, ln)| ln);
        let heats = sets.iter().zip(fields);
        heats.map(|((sources, amounts), fields)| self.heat(sources, amounts, fields)).collect()
    }

    /// The right-hand side of the first step.
    fn start(&self, sources: &Sources<D>, amounts: &[f64]) -> Entries {
        let mut entries = Entries::new();
        for (&point, &amount) in sources.points().iter().zip(amounts) {
            for (cell, weight) in shares(self.medium.mask(), point) {
                let place = self.places[cell];
                entries.push((place, self.over_factor(place, Wide::from(amount * weight))));
            }
        }
        entries
    }

    /// `u / k` at a place.
    fn over_factor(&self, place: usize, u: Wide) -> Wide {
        self.medium.factor().map_or(u, |factor| u.times(1.0 / factor.values()[self.cells[place]]))
    }

    /// The logarithms of values in the order of elimination, as a grid.
    fn ln(&self, values: &[Wide]) -> Grid<f64, D> {
        let mut grid = Grid::from_fn(*self.medium.shape(), |_| f64::NEG_INFINITY);
        self.cells.iter().zip(values).for_each(|(&cell, u)| grid.values_mut()[cell] = u.ln());
        grid
    }

    fn heat(
        &self,
        sources: &Sources<D>,
        amounts: &[f64],
        (ln_temperature, ln_exposure): (Grid<f64, D>, Option<Grid<f64, D>>),
    ) -> Heat<D> {
        Heat {
            scheme: Scheme::Implicit,
            sources: sources.clone(),
            mask: self.medium.mask().clone(),
            amounts: amounts.to_vec(),
            speeds_sq: self.speeds_sq(sources),
            ln_temperature,
            ln_exposure,
            iterations: self.steps,
            step: self.step,
        }
    }
}

/// Adds `u` to a sum, which may be empty.
fn add(sum: &mut Vec<Wide>, u: &[Wide]) {
    if sum.is_empty() {
        sum.extend_from_slice(u);
    } else {
        sum.iter_mut().zip(u).for_each(|(sum, &u)| *sum = sum.plus(u));
    }
}
