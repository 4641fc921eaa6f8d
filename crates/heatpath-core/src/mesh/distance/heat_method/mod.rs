//! The heat method (Crane, Weischedel and Wardetzky 2013).

mod direction;
mod group;
mod laplacian;
mod near;
mod poisson;
mod time;
mod unfold;

use super::DistanceMap;
use crate::error::{ParameterError, check_positive};
use crate::exec::{Cancelled, Exec};
use crate::linear::{Cholesky, Entries, LinearError, Wide};
use crate::mesh::{Lists, Medium, PointError, Sources, Triangulation};
use group::Group;
use laplacian::Laplacian;
use near::Near;
use poisson::Poisson;
use std::sync::Arc;
use thiserror::Error;
pub use time::usual_time;

/// The parameters of [`HeatMethod`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatMethodOptions {
    /// How long heat flows, in multiples of the mean squared side of a face, by its slowness. Above 0;
    /// default [`usual_time`].
    pub time: Option<f64>,
    /// The most memory that each of the factorisations may take, in bytes; default 4 GiB. There are
    /// two, on surfaces with a border three.
    pub memory_limit: usize,
}

impl Default for HeatMethodOptions {
    fn default() -> Self {
        Self { time: None, memory_limit: 4 << 30 }
    }
}

/// Why the heat method cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HeatMethodError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A system cannot be solved.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// A source is not on this mesh.
    #[error(transparent)]
    Point(#[from] PointError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Distances by the heat method in one medium, prepared once for any sources.
#[derive(Debug)]
pub struct HeatMethod {
    medium: Arc<Medium>,
    triangulation: Triangulation,
    vertex_faces: Lists,
    laplacian: Laplacian,
    /// Heat that borders reflect, and, if there are any, heat that they swallow.
    heats: Vec<Cholesky>,
    poisson: Poisson,
    is_border: Vec<bool>,
    /// The square root of the time: heat falls by e over this distance.
    reach: f64,
}

/// So many groups of sources are solved for together by each thread.
const BATCH: usize = 8;

impl HeatMethod {
    /// Prepares distances in `medium`: finds the triangulation, analyses and factors two or three
    /// systems, at the same time if `exec` has threads.
    ///
    /// # Errors
    /// A time out of range, more memory than allowed; or the caller cancelled.
    pub fn new(
        medium: impl Into<Arc<Medium>>,
        options: HeatMethodOptions,
        exec: &Exec,
    ) -> Result<Self, HeatMethodError> {
        let medium = medium.into();
        let time = options.time.unwrap_or_else(|| usual_time(medium.mesh()));
        check_positive("time", time)?;
        let triangulation = Triangulation::delaunay(&medium, true);
        exec.report(0.1)?;
        let laplacian = Laplacian::new(&triangulation, options.memory_limit)?;
        exec.report(0.3)?;
        let is_border = triangulation.border_vertices();
        let time = time * mean_side(&triangulation).powi(2);
        let components = triangulation.components();
        let mut heats = factors(&laplacian, &components, &is_border, time, exec)?;
        let poisson = Poisson::new(heats.remove(0), components);
        exec.report(1.0)?;
        let (vertex_faces, reach) = (triangulation.vertex_faces(), time.sqrt());
        Ok(Self {
            medium,
            triangulation,
            vertex_faces,
            laplacian,
            heats,
            poisson,
            is_border,
            reach,
        })
    }

    /// The medium.
    #[must_use]
    pub fn medium(&self) -> &Arc<Medium> {
        &self.medium
    }

    /// The triangulation that the equations are solved on.
    #[must_use]
    pub fn triangulation(&self) -> &Triangulation {
        &self.triangulation
    }

    /// The memory that the factorisations take, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        (self.heats.len() + 1) * self.laplacian.bytes()
    }

    /// The distances from the nearest of `sources`.
    ///
    /// # Errors
    /// A source is not on this mesh, or the caller cancelled.
    pub fn distance(&self, sources: &Sources, exec: &Exec) -> Result<DistanceMap, HeatMethodError> {
        self.distances(std::slice::from_ref(sources), exec).map(|mut maps| maps.remove(0))
    }

    /// The distances from each of several sets of sources by itself. The threads of `exec` share
    /// them; a map takes one solution of each system for each label, with several points to a label
    /// some more.
    ///
    /// # Errors
    /// A source is not on this mesh, or the caller cancelled.
    pub fn distances(
        &self,
        sets: &[Sources],
        exec: &Exec,
    ) -> Result<Vec<DistanceMap>, HeatMethodError> {
        let mesh = self.medium.mesh();
        for sources in sets {
            mesh.check_points("source", sources.list().iter().map(|source| source.point))?;
        }
        let groups = Group::all(sets);
        let mut maps = vec![DistanceMap::none(mesh.points().len()); sets.len()];
        let mut finished = 0;
        for round in groups.chunks(BATCH * exec.threads()) {
            exec.report(finished as f64 / groups.len() as f64)?;
            for (group, values) in round.iter().zip(self.round(round, exec)) {
                maps[group.set].merge(&values, group.label);
            }
            finished += round.len();
        }
        exec.report(1.0)?;
        Ok(maps)
    }

    /// The distances of each vertex of the triangulation from each group.
    fn round(&self, groups: &[Group], exec: &Exec) -> Vec<Vec<f64>> {
        let mesh = self.medium.mesh();
        // === Heat for a short time
        let heats = self.heat(groups, exec);
        // === The divergence of its direction
        let mut jobs: Vec<_> = groups
            .iter()
            .zip(heats)
            .map(|(group, heat)| {
                let near = Near::new(&self.medium, &self.triangulation, &self.vertex_faces, group);
                let pins = group.pins(mesh, &near, self.poisson.components());
                ((group, heat, near), (pins, Vec::new()))
            })
            .collect();
        exec.for_each(&mut jobs, |((_, heat, near), (_, side))| {
            *side = self.divergence(heat, near);
        });
        // === The distances with that divergence
        let (known, systems): (Vec<_>, Vec<_>) = jobs.into_iter().unzip();
        let mut fields = self.poisson.solve(&self.laplacian, systems, exec);
        for (field, (group, _, near)) in fields.iter_mut().zip(&known) {
            let least = group.least_offset();
            field.iter_mut().for_each(|value| *value = value.max(least));
            near.distances.iter().for_each(|(&vertex, &known)| field[vertex as usize] = known);
        }
        fields
    }

    /// The heat of each group at each vertex.
    ///
    /// Borders that reflect bend its direction one way, borders that swallow the other way: the sum is
    /// better than either. A source on the border would be swallowed.
    fn heat(&self, groups: &[Group], exec: &Exec) -> Vec<Vec<Wide>> {
        let sides: Vec<Entries> = groups.iter().map(|group| self.side(group)).collect();
        let mut sums: Vec<Vec<Wide>> = self.heats[0].solve_near(&sides, exec);
        let inside: Vec<usize> =
            (0..groups.len()).filter(|&group| !self.touches_border(&groups[group])).collect();
        let sides: Vec<Entries> = inside.iter().map(|&group| sides[group].clone()).collect();
        for heat in &self.heats[1..] {
            for (&group, more) in inside.iter().zip(heat.solve_near(&sides, exec)) {
                sums[group].iter_mut().zip(more).for_each(|(sum, more)| *sum = sum.plus(more));
            }
        }
        sums.iter().map(|sum| self.laplacian.restored(sum)).collect()
    }

    fn side(&self, group: &Group) -> Entries {
        let charges = group.charges(self.medium.mesh(), self.reach).into_iter();
        charges.map(|(vertex, heat)| (self.laplacian.places()[vertex as usize], heat)).collect()
    }

    fn touches_border(&self, group: &Group) -> bool {
        let charges = group.charges(self.medium.mesh(), self.reach);
        charges.iter().any(|&(vertex, _)| self.is_border[vertex as usize])
    }

    /// The divergence that the distances should have.
    fn divergence(&self, heat: &[Wide], near: &Near) -> Vec<f64> {
        let mut targets = direction::targets(&self.triangulation, heat);
        for &face in &near.faces {
            let corners = self.triangulation.faces()[face as usize];
            targets[face as usize] = corners.map(|vertex| near.distances[&vertex]);
        }
        self.laplacian.divergence(&self.triangulation, &targets)
    }
}

/// The mean side of the faces, times their slowness.
fn mean_side(triangulation: &Triangulation) -> f64 {
    let slowness = triangulation.slowness().iter().enumerate();
    let sides = slowness.map(|(face, slow)| slow * triangulation.sides(face).iter().sum::<f64>());
    sides.sum::<f64>() / (3 * triangulation.faces().len()) as f64
}

/// The factors of the Poisson equation and of heat, in this order.
fn factors(
    laplacian: &Laplacian,
    components: &[usize],
    is_border: &[bool],
    time: f64,
    exec: &Exec,
) -> Result<Vec<Cholesky>, LinearError> {
    let count = if is_border.contains(&true) { 3 } else { 2 };
    let mut factors: Vec<_> = (0..count).map(|system| (system, None)).collect();
    exec.for_each(&mut factors, |(system, factor)| {
        let exec = Exec::single_threaded();
        *factor = Some(match system {
            0 => laplacian.poisson(|vertex| components[vertex] == vertex, &exec),
            1 => laplacian.heat(time, |_| false, &exec),
            _ => laplacian.heat(time, |vertex| is_border[vertex], &exec),
        });
    });
    factors.into_iter().filter_map(|(_, factor)| factor).collect()
}
