//! Heat on meshes.
//!
//! [`Explicit`] is the scheme of the paper (eqs. 15 and 16), step by step.

mod explicit;
mod operator;

pub use explicit::{Explicit, HeatError, HeatOptions, SPREAD, Step};
pub use operator::Weights;

use super::vector::distance;
use super::{Sources, SurfacePoint, TriMesh};
use std::sync::Arc;

/// What the heat has done.
#[derive(Clone, Debug)]
pub struct Heat {
    pub(super) mesh: Arc<TriMesh>,
    pub(super) sources: Sources,
    pub(super) ln_density: Vec<f64>,
    pub(super) ln_temperature: Vec<f64>,
    pub(super) ln_exposure: Vec<f64>,
    pub(super) speed_sq: Vec<f64>,
    pub(super) kappa: f64,
    pub(super) step: f64,
    pub(super) iterations: usize,
    pub(super) missed: usize,
    pub(super) negative_weights: usize,
}

impl Heat {
    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &Arc<TriMesh> {
        &self.mesh
    }

    /// The sources.
    #[must_use]
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// The natural logarithm of the u of eq. (16) at each vertex, minus infinity where no heat is.
    ///
    /// It is the density of the walkers, who stay longer where P is small: u is *lower* on ridges.
    #[must_use]
    pub fn ln_density(&self) -> &[f64] {
        &self.ln_density
    }

    /// The natural logarithm of `P u`, minus infinity where no heat is.
    ///
    /// It is the temperature v of eq. (1), `v_t = -P L~ v`, of which Varadhan's formula speaks.
    #[must_use]
    pub fn ln_temperature(&self) -> &[f64] {
        &self.ln_temperature
    }

    /// The natural logarithm of the exposure, the sum of `P u` over the start and every step, minus
    /// infinity where no heat has been.
    ///
    /// Unlike the temperature, whose maximum drifts away from the source to where P is large, the
    /// exposure E has no maximum but the sources where no weight is negative: adding up eq. (16) over
    /// all steps gives `-step L~ E = u_end - u_start`, with one step more in the end, which is not
    /// negative away from the sources. So E is not above the weighted mean of its neighbours
    /// there, and paths that climb it cannot stop short.
    #[must_use]
    pub fn ln_exposure(&self) -> &[f64] {
        &self.ln_exposure
    }

    /// The logarithm of `P u` at each source.
    #[must_use]
    pub fn ln_temperature_at_sources(&self) -> Vec<f64> {
        self.at_sources(&self.ln_temperature)
    }

    /// The values of a logarithm at the sources, interpolated to second order: around a source it is a
    /// paraboloid, `-distance^2 / 4 kappa P t`.
    pub(crate) fn at_sources(&self, ln: &[f64]) -> Vec<f64> {
        let four_t = 4.0 * self.kappa * self.time();
        let at = |point: &SurfacePoint| {
            let position = self.mesh.position(point);
            let shares = self.mesh.shares(point).into_iter().map(|(vertex, weight)| {
                let vertex = vertex as usize;
                let away = distance(self.mesh.points()[vertex], position);
                weight * (ln[vertex] + away * away / (four_t * self.speed_sq[vertex]))
            });
            shares.sum()
        };
        self.sources.list().iter().map(|source| at(&source.point)).collect()
    }

    /// The vertices with a part in a source, and its label.
    pub(crate) fn labelled_corners(&self) -> impl Iterator<Item = (usize, u32)> + '_ {
        let list = self.sources.list().iter();
        list.flat_map(|source| {
            let shares = self.mesh.shares(&source.point).into_iter();
            shares.map(|(vertex, _)| (vertex as usize, source.label))
        })
    }

    /// The squared length, in units of the mesh, that stands for one unit of time: the median of
    /// `2 A / D` with the area A of a third of the faces at a vertex and its sum D of weights. On
    /// equilateral meshes and right grids it is a quarter of the squared edge.
    #[must_use]
    pub fn kappa(&self) -> f64 {
        self.kappa
    }

    /// The end time, in hops where P is 1.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.step * self.iterations as f64
    }

    /// The time step.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The number of steps.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// How many vertices heat has not reached though edges lead there from a source: there were too few
    /// steps, or negative weights made u negative.
    #[must_use]
    pub fn missed(&self) -> usize {
        self.missed
    }

    /// How many edges have negative weights by eq. (15), whatever was done with them: where there are
    /// some, distances around them are wrong.
    #[must_use]
    pub fn negative_weights(&self) -> usize {
        self.negative_weights
    }
}
