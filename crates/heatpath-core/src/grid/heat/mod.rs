//! Heat: `u_t = k div(D grad u)` from point sources.
//!
//! [`Explicit`] marches in time; [`Implicit`] solves for a time at once, many sources at a time. The
//! result, [`Heat`], holds two fields in logarithms, because heat decays like `exp(-distance^2 / 4t)` and leaves every floating-point range behind: the
//! temperature u at the end, and the exposure, which is u added up over all steps.
//!
//! D is a number or a symmetric matrix per cell (eq. 12). The matrix is the diffusion tensor, large
//! along the directions in which heat is fast; the metric tensor by which lengths are measured,
//! `sqrt(dx' (k D)^-1 dx)`, is its inverse over k. Heat stays positive whatever the anisotropy:
//! matrices are written as sums of squares along the lattice (Fehrenbach & Mirebeau, "Sparse
//! non-negative stencils for anisotropic diffusion", 2014), with offsets of several cells where D
//! slants.
//!
//! Time and step are given in cell units: multiples of the smallest spacing squared, so that they
//! do not depend on the unit of length.

mod explicit;
mod implicit;
mod links;
mod operator;

pub use explicit::{Duration, Explicit, HeatError, HeatOptions, Step};
pub(crate) use implicit::{Elimination, check_memory, faces};
pub use implicit::{Implicit, ImplicitError, ImplicitOptions};
pub use operator::FaceMean;

use super::source::shares;
use super::{Grid, Mask, Shape, Sources};
use crate::Exec;
use thiserror::Error;

/// How heat was made to flow, and so what its logarithm says about distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// In many small steps: u is close to the heat kernel, `exp(-distance^2 / 4t)`.
    Explicit,
    /// In one or a few implicit steps: u is the resolvent, `exp(-distance / sqrt(step))`.
    Implicit,
}

/// Heat in a prepared medium, from any sources: [`Explicit`] and [`Implicit`].
pub trait HeatSolver<const D: usize> {
    /// Why heat cannot flow.
    type Error;

    /// Lets heat flow from `sources`; with amounts that make them equally strong if `balanced`, as
    /// distances by [`normalized`](super::distance::normalized) ask for.
    ///
    /// # Errors
    /// The caller cancelled.
    fn flow_from(
        &self,
        sources: &Sources<D>,
        balanced: bool,
        exec: &Exec,
    ) -> Result<Heat<D>, Self::Error>;

    /// Lets heat flow from each of several sets of sources by itself.
    ///
    /// # Errors
    /// The caller cancelled.
    fn flow_each(&self, sets: &[Sources<D>], exec: &Exec) -> Result<Vec<Heat<D>>, Self::Error>;
}

impl<const D: usize> HeatSolver<D> for Explicit<'_, D> {
    type Error = HeatError;

    fn flow_from(
        &self,
        sources: &Sources<D>,
        balanced: bool,
        exec: &Exec,
    ) -> Result<Heat<D>, HeatError> {
        if balanced { self.flow_balanced(sources, exec) } else { self.flow(sources, exec) }
    }

    fn flow_each(&self, sets: &[Sources<D>], exec: &Exec) -> Result<Vec<Heat<D>>, HeatError> {
        sets.iter().map(|sources| self.flow(sources, exec)).collect()
    }
}

impl<const D: usize> HeatSolver<D> for Implicit<'_, D> {
    type Error = ImplicitError;

    fn flow_from(
        &self,
        sources: &Sources<D>,
        balanced: bool,
        exec: &Exec,
    ) -> Result<Heat<D>, ImplicitError> {
        if balanced { self.flow_balanced(sources, exec) } else { self.flow(sources, exec) }
    }

    fn flow_each(&self, sets: &[Sources<D>], exec: &Exec) -> Result<Vec<Heat<D>>, ImplicitError> {
        self.flow_many(sets, exec)
    }
}

/// Heat was made without its exposure.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("the heat was made without its exposure, which paths follow: ask for it in the options")]
pub struct NoExposure;

/// What the heat has done.
#[derive(Clone, Debug)]
pub struct Heat<const D: usize> {
    pub(crate) scheme: Scheme,
    pub(crate) sources: Sources<D>,
    pub(crate) mask: Mask<D>,
    /// The amount of heat that each source began with.
    pub(crate) amounts: Vec<f64>,
    /// The squared speed at each source.
    pub(crate) speeds_sq: Vec<f64>,
    pub(crate) ln_temperature: Grid<f64, D>,
    /// `None` if it was not kept, and if it is the temperature of implicit heat.
    pub(crate) ln_exposure: Option<Grid<f64, D>>,
    pub(crate) iterations: usize,
    pub(crate) step: f64,
}

impl<const D: usize> Heat<D> {
    /// How the heat was made to flow.
    #[must_use]
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// The size and spacing.
    #[must_use]
    pub fn shape(&self) -> &Shape<D> {
        self.mask.shape()
    }

    /// The sources.
    #[must_use]
    pub fn sources(&self) -> &Sources<D> {
        &self.sources
    }

    /// Which cells are open.
    #[must_use]
    pub fn mask(&self) -> &Mask<D> {
        &self.mask
    }

    /// The natural logarithm of the temperature u at the end, minus infinity where no heat is.
    #[must_use]
    pub fn ln_temperature(&self) -> &Grid<f64, D> {
        &self.ln_temperature
    }

    /// The natural logarithm of the exposure, the sum of u over the start and every step.
    ///
    /// Unlike the temperature, whose maximum drifts away from the source into the fastest or
    /// narrowest region, the exposure E has no maximum but the sources: adding up the scheme
    /// `u' = u + step L u` over all steps gives `step L E = u_end - u_start`, with one step more in
    /// the end, which is positive away from the sources. A cell with `L E > 0` is below the mean of
    /// its neighbours, so each has a neighbour with more exposure. Paths climb it and cannot stop
    /// short. Its logarithm has the same limit as that of u in Varadhan's formula.
    ///
    /// Of implicit heat the start does not
    /// count: `u' - step L u' = u` gives `step L E = u_end - u_start` for the sum over the steps
    /// alone. After one step it is the temperature itself.
    ///
    /// # Errors
    /// It was not kept ([`HeatOptions::exposure`]).
    pub fn ln_exposure(&self) -> Result<&Grid<f64, D>, NoExposure> {
        match (&self.ln_exposure, self.scheme) {
            (Some(exposure), _) => Ok(exposure),
            (None, Scheme::Implicit) => Ok(&self.ln_temperature),
            (None, Scheme::Explicit) => Err(NoExposure),
        }
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

    /// The end time in cell units.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.step * self.iterations as f64
    }

    /// The logarithm of what u is compared with: of explicit heat the temperature at the warmest
    /// source, of implicit heat the factor in front of the Matérn function around the strongest one,
    /// `amount / (step speed^2)^(N/2)`.
    pub(crate) fn ln_reference(&self) -> f64 {
        match self.scheme {
            Scheme::Explicit => {
                self.ln_temperature_at_sources().into_iter().fold(f64::NEG_INFINITY, f64::max)
            }
            Scheme::Implicit => self.ln_strength(),
        }
    }

    fn ln_strength(&self) -> f64 {
        let (shape, unit) = (self.shape(), self.shape().smallest_spacing());
        let dimension = shape.dimension() as f64;
        // Axes with one cell do not count.
        let ln_volume: f64 = (0..D)
            .filter(|&axis| shape.size()[axis] > 1)
            .map(|axis| (shape.spacing()[axis] / unit).ln())
            .sum();
        let sources = self.amounts.iter().zip(&self.speeds_sq);
        sources
            .map(|(amount, speed_sq)| amount.ln() - 0.5 * dimension * (self.step * speed_sq).ln())
            .fold(f64::NEG_INFINITY, f64::max)
            + ln_volume
    }

    /// The logarithm of the temperature at each source.
    #[must_use]
    pub fn ln_temperature_at_sources(&self) -> Vec<f64> {
        self.sources.points().iter().map(|&point| self.ln_temperature_at(point)).collect()
    }

    /// The logarithm of the temperature at `point`, interpolated to second order.
    ///
    /// Around a source `ln u` is a paraboloid, which linear interpolation would put too low by
    /// half the second difference times `f (1 - f)` along each axis.
    fn ln_temperature_at(&self, point: [f64; D]) -> f64 {
        let field = self.ln_temperature.values();
        let linear: f64 =
            shares(&self.mask, point).into_iter().map(|(cell, weight)| weight * field[cell]).sum();
        let index = self.shape().cell_at(point);
        let centre = self.shape().position(index);
        let bend: f64 = (0..D)
            .map(|axis| {
                let fraction = point[axis] - point[axis].floor();
                let inside = index[axis] > 0 && index[axis] + 1 < self.shape().size()[axis];
                if !inside || fraction == 0.0 {
                    return 0.0;
                }
                let stride = self.shape().stride(axis);
                let second = field[centre - stride] - 2.0 * field[centre] + field[centre + stride];
                if second.is_finite() { 0.5 * fraction * (1.0 - fraction) * second } else { 0.0 }
            })
            .sum();
        linear - bend
    }
}
