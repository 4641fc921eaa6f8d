//! Explicit Euler of eq. (16), as the paper has it: `u' = u - step L~ (P u)` with `L~ = I - D^-1 W`.

use super::Heat;
use super::operator::{Operator, Weights};
use crate::error::{ParameterError, check};
use crate::exec::{Cancelled, Exec};
use crate::linear::{Wide, power_of_two};
use crate::mesh::{Medium, Sources, TriMesh};
use std::sync::Arc;
use thiserror::Error;

/// The length of a time step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Step {
    /// 0.2, the paper's, or [`Step::SAFE_FRACTION`] of the largest stable step where that is less:
    /// with negative weights, or where P is above 4. It is meant for a P up to 1; where P is far
    /// below 1 everywhere, heat hardly spreads.
    #[default]
    Usual,
    /// Exactly this.
    Fixed(f64),
    /// [`Step::SAFE_FRACTION`] of the largest stable step.
    Auto,
}

impl Step {
    /// The part of the largest stable step that is taken.
    pub const SAFE_FRACTION: f64 = 0.8;
    /// The paper's step.
    pub const PAPER: f64 = 0.2;
}

/// The parameters of [`Explicit`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeatOptions {
    /// The time step, in hops of the random walk; default [`Step::Usual`].
    pub step: Step,
    /// The number of steps, from 1 to 1e9. Default: [`Explicit::usual_iterations`].
    pub iterations: Option<usize>,
    /// What is done with negative weights; default [`Weights::Literal`].
    pub weights: Weights,
}

/// Why heat cannot flow.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HeatError {
    /// The scheme would oscillate and blow up.
    #[error(
        "the time step is {step}, but on this mesh and medium it is stable only up to \
         {largest_stable:.4}"
    )]
    StepTooLarge {
        /// The step asked for.
        step: f64,
        /// The largest stable one.
        largest_stable: f64,
    },
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// So many iterations would take days on the smallest mesh.
const MOST_ITERATIONS: usize = 1_000_000_000;

/// A source is at most so much stronger than another one, in logarithms.
const MOST_LN: f64 = 600.0;

/// How far heat has spread after the usual time, as a part of the way to the furthest vertex: in uniform
/// sheets and spheres distances are best then.
pub const SPREAD: f64 = 0.14;

/// So many vertices at a time are one piece of work.
const PIECE: usize = 1024;

/// The explicit heat of eqs. (15) and (16) on one mesh, prepared once for any number of sources.
///
/// Each step is `u' = (1 - step P) u + step D^-1 W (P u)`: heat walks from vertex to vertex, a hop at a
/// time, and has done `step * iterations` hops on average where P is 1. It measures lengths in
/// edges, not in units: [`varadhan`](crate::mesh::distance::varadhan) says how they are
/// converted, and on which meshes that is wrong.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::mesh::distance::{VaradhanOptions, varadhan};
/// use heatpath_core::mesh::heat::{Explicit, HeatOptions};
/// use heatpath_core::mesh::{Medium, Sources, shapes};
///
/// let sheet = shapes::sheet(64, 64, |column, row| [column as f64, row as f64, 0.0]);
/// let medium = Medium::uniform(sheet)?;
/// let centre = 32 * 65 + 32;
/// let sources = Sources::at_vertices(medium.mesh(), &[centre])?;
/// let explicit = Explicit::new(&medium, HeatOptions::default())?;
/// let heat = explicit.flow(&sources, &Exec::single_threaded())?;
/// let map = varadhan(&heat, VaradhanOptions::default());
/// assert!((map.values()[centre as usize + 20] / 20.0 - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Every u has an exponent of its own, so it does not underflow however far heat has come. Memory
/// is 48 bytes a vertex for u and its sum, and 20 a neighbour for the weights.
#[derive(Clone, Debug)]
pub struct Explicit {
    mesh: Arc<TriMesh>,
    speed_sq: Vec<f64>,
    operator: Operator,
    /// What each neighbour hands over in a step: `step P w`.
    handed: Vec<f64>,
    step: f64,
    iterations: Option<usize>,
}

impl Explicit {
    /// Prepares heat in `medium`, by its lengths and its P at the vertices.
    ///
    /// # Errors
    /// A step that is not positive or above the largest stable one, or a number of iterations that is
    /// out of range.
    pub fn new(medium: &Medium, options: HeatOptions) -> Result<Self, HeatError> {
        let operator = Operator::new(medium, options.weights);
        let speed_sq = medium.speed_sq().into_owned();
        let largest_stable = operator.largest_stable_step(&speed_sq);
        let step = match options.step {
            Step::Usual => Step::PAPER.min(Step::SAFE_FRACTION * largest_stable),
            Step::Fixed(step) => step,
            Step::Auto => Step::SAFE_FRACTION * largest_stable,
        };
        check("time step", step, step.is_finite() && step > 0.0, "a positive finite number")?;
        if step > largest_stable {
            return Err(HeatError::StepTooLarge { step, largest_stable });
        }
        if let Some(iterations) = options.iterations {
            let is_right = (1..=MOST_ITERATIONS).contains(&iterations);
            check("number of iterations", iterations as f64, is_right, "from 1 to 1e9")?;
        }
        let rows = (0..speed_sq.len()).flat_map(|vertex| operator.row(vertex));
        let handed = rows.map(|(next, weight)| step * speed_sq[next] * weight).collect();
        let (mesh, iterations) = (medium.mesh().clone(), options.iterations);
        Ok(Self { mesh, speed_sq, operator, handed, step, iterations })
    }

    /// The time step.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The number of steps from `sources` if none is asked for: enough to reach the vertex that is most
    /// hops away, and for a deviation of [`SPREAD`] of the way there where P is 1.
    #[must_use]
    pub fn usual_iterations(&self, sources: &Sources) -> usize {
        let hops = self.hops(sources).into_iter().flatten().max().unwrap_or(0) as usize;
        // The variance of a walk is 2 kappa t, and kappa is a quarter of a squared edge.
        let spread = 2.0 * (SPREAD * hops as f64).powi(2) / self.step;
        hops.max(spread.ceil() as usize).clamp(1, MOST_ITERATIONS)
    }

    /// Lets heat flow from `sources`, which all begin with u = 1 (shared between the corners of its face
    /// if a source lies on none of them).
    ///
    /// # Errors
    /// A source has an offset, or the caller cancelled.
    pub fn flow(&self, sources: &Sources, exec: &Exec) -> Result<Heat, HeatError> {
        let amounts = vec![1.0; sources.list().len()];
        let heat = self.flow_amounts(sources, &amounts, [0.0, 1.0], exec)?;
        exec.report(1.0)?;
        Ok(heat)
    }

    /// Lets heat flow from `sources` with amounts that make `P u` equal at all of them in the end.
    ///
    /// A source at a fast place loses its heat sooner than one at a slow place, and with equal amounts
    /// it would seem further away. With one source this is [`flow`](Self::flow); with several,
    /// heat flows twice: the first time to find the amounts.
    ///
    /// # Errors
    /// A source has an offset, or the caller cancelled.
    pub fn flow_balanced(&self, sources: &Sources, exec: &Exec) -> Result<Heat, HeatError> {
        let count = sources.list().len();
        if count == 1 {
            return self.flow(sources, exec);
        }
        let heat = self.flow_amounts(sources, &vec![1.0; count], [0.0, 0.5], exec)?;
        let ln_warmth = heat.ln_temperature_at_sources();
        let warmest = ln_warmth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // Nothing can be made of a source without heat, which negative weights may have taken.
        let amount =
            |&ln: &f64| if ln.is_finite() { (warmest - ln).min(MOST_LN).exp() } else { 1.0 };
        let amounts: Vec<f64> = ln_warmth.iter().map(amount).collect();
        let heat = self.flow_amounts(sources, &amounts, [0.5, 1.0], exec)?;
        exec.report(1.0)?;
        Ok(heat)
    }

    fn flow_amounts(
        &self,
        sources: &Sources,
        amounts: &[f64],
        [from, to]: [f64; 2],
        exec: &Exec,
    ) -> Result<Heat, HeatError> {
        for source in sources.list() {
            check("source offset", source.offset, source.offset == 0.0, "0: heat has no offsets")?;
        }
        let iterations = self.iterations.unwrap_or_else(|| self.usual_iterations(sources));
        let mut u = self.start(sources, amounts);
        let (mut next, mut exposure) = (u.clone(), u.clone());
        for iteration in 0..iterations {
            exec.report(from + (to - from) * iteration as f64 / iterations as f64)?;
            self.advance(&u, &mut next, &mut exposure, exec);
            std::mem::swap(&mut u, &mut next);
        }
        Ok(self.heat(sources, &u, &exposure, iterations))
    }

    /// What has become of the heat: u and its sum over all steps.
    fn heat(&self, sources: &Sources, u: &[Wide], exposure: &[Wide], iterations: usize) -> Heat {
        let ln = |u: &Wide| if u.parts().0 > 0.0 { u.ln() } else { f64::NEG_INFINITY };
        let ln_density: Vec<f64> = u.iter().map(ln).collect();
        let with_speed = |u: &[Wide]| -> Vec<f64> {
            u.iter().zip(&self.speed_sq).map(|(u, speed_sq)| ln(u) + speed_sq.ln()).collect()
        };
        let hops = self.hops(sources);
        let within = || (0..hops.len()).filter(|&vertex| hops[vertex].is_some());
        Heat {
            mesh: self.mesh.clone(),
            sources: sources.clone(),
            missed: within().filter(|&vertex| ln_density[vertex] == f64::NEG_INFINITY).count(),
            ln_temperature: with_speed(u),
            ln_exposure: with_speed(exposure),
            ln_density,
            speed_sq: self.speed_sq.clone(),
            kappa: median(within().map(|vertex| self.operator.kappa()[vertex]).collect()),
            step: self.step,
            iterations,
            negative_weights: self.operator.negative(),
        }
    }

    fn start(&self, sources: &Sources, amounts: &[f64]) -> Vec<Wide> {
        let mut u = vec![Wide::ZERO; self.speed_sq.len()];
        for (source, &amount) in sources.list().iter().zip(amounts) {
            for (vertex, weight) in self.mesh.shares(&source.point) {
                let vertex = vertex as usize;
                u[vertex] = u[vertex].plus(Wide::from(weight * amount));
            }
        }
        u
    }

    /// One step of eq. (16), added to the exposure.
    fn advance(&self, u: &[Wide], next: &mut [Wide], exposure: &mut [Wide], exec: &Exec) {
        let pieces = next.chunks_mut(PIECE).zip(exposure.chunks_mut(PIECE)).enumerate();
        let mut pieces: Vec<_> = pieces.collect();
        exec.for_each(&mut pieces, |(piece, (next, exposure))| {
            let vertices = *piece * PIECE..;
            for ((vertex, next), exposure) in vertices.zip(next.iter_mut()).zip(&mut **exposure) {
                *next = self.after_step(vertex, u);
                *exposure = exposure.plus(*next);
            }
        });
    }

    #[inline]
    fn after_step(&self, vertex: usize, u: &[Wide]) -> Wide {
        let mut sum = Sum::default();
        sum.add(1.0 - self.step * self.speed_sq[vertex], u[vertex]);
        let handed = &self.handed[self.operator.range(vertex)];
        for (&next, &factor) in self.operator.neighbours(vertex).iter().zip(handed) {
            sum.add(factor, u[next as usize]);
        }
        Wide::new(sum.value, sum.exponent)
    }

    /// How many edges with a weight each vertex is away from the nearest source.
    fn hops(&self, sources: &Sources) -> Vec<Option<u32>> {
        let mut hops = vec![None; self.speed_sq.len()];
        let mut front: Vec<usize> = sources
            .list()
            .iter()
            .flat_map(|source| self.mesh.shares(&source.point))
            .map(|(vertex, _)| vertex as usize)
            .collect();
        front.iter().for_each(|&vertex| hops[vertex] = Some(0));
        for distance in 1.. {
            let mut next = Vec::new();
            for vertex in front {
                for (neighbour, weight) in self.operator.row(vertex) {
                    if weight != 0.0 && hops[neighbour].is_none() {
                        hops[neighbour] = Some(distance);
                        next.push(neighbour);
                    }
                }
            }
            if next.is_empty() {
                break;
            }
            front = next;
        }
        hops
    }
}

/// A sum `value * 2^exponent` of numbers of any size.
#[derive(Default)]
struct Sum {
    value: f64,
    exponent: i32,
}

impl Sum {
    #[inline]
    fn add(&mut self, factor: f64, number: Wide) {
        if number.is_zero() {
            return;
        }
        let (value, exponent) = number.parts();
        let term = factor * value;
        let above = exponent - self.exponent;
        if self.value == 0.0 {
            *self = Self { value: term, exponent };
        } else if above <= 0 {
            self.value += term * power_of_two(above.max(-1023));
        } else {
            *self = Self { value: self.value * power_of_two((-above).max(-1023)) + term, exponent };
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
