//! Varadhan's formula (eq. 3) on meshes.

use super::{DistanceMap, NO_LABEL, NOT_REACHED};
use crate::mesh::heat::Heat;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What the formula is applied to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Of {
    /// `P u`, which obeys the heat equation (1).
    #[default]
    Pu,
    /// The sum of `P u` over all steps: less exact than [`Pu`](Self::Pu), but its only minima are the
    /// sources where no weight is negative, and paths that descend it always arrive.
    Exposure,
    /// The u of eq. (16), as it stands there. Where P varies it is lower on ridges than beside them,
    /// and paths run into minima away from the sources.
    U,
}

/// The unit of distances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// That of the mesh, by [`Heat::kappa`].
    #[default]
    Length,
    /// That of the random walk, as eq. (3) has it: an edge of an equilateral mesh or a right grid is 2.
    Walk,
}

/// The parameters of [`varadhan`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VaradhanOptions {
    /// What the formula is applied to; default [`Of::Pu`].
    pub of: Of,
    /// The unit of distances; default [`Scale::Length`].
    pub scale: Scale,
}

/// The distance `sqrt(-4 t log (v / v0))` (eq. 3) of explicit heat, with the v0 of the warmest source.
///
/// Dividing by v0 removes the factor in front of the heat kernel. The walk of eq. (16) takes as long
/// over a short edge as over a long one: distances are right where all edges are about equally
/// long, and wrong by as much as lengths of edges vary elsewhere. After the usual number of steps the mean
/// error is 0.7 % in a uniform sheet, 3.6 % on a sphere (whose heat kernel has another factor in front),
/// and 25 % in a sheet with edges from half to one and a half units. Heat that has come to borders is
/// reflected, and distances there are too short. Where P varies strongly expect the order of
/// distances to be right, and their values not. With several sources use
/// [`flow_balanced`](crate::mesh::heat::Explicit::flow_balanced).
///
/// Labels spread from the sources like water, to the nearest vertex on the shore first. Vertices
/// warmer than the source have distance 0.
#[must_use]
pub fn varadhan(heat: &Heat, options: VaradhanOptions) -> DistanceMap {
    let ln = match options.of {
        Of::Pu => heat.ln_temperature(),
        Of::Exposure => heat.ln_exposure(),
        Of::U => heat.ln_density(),
    };
    let kappa = match options.scale {
        Scale::Length => heat.kappa(),
        Scale::Walk => 1.0,
    };
    let (four_t, unit) = (4.0 * heat.time(), kappa.sqrt());
    let reference = heat.at_sources(ln).into_iter().fold(f64::NEG_INFINITY, f64::max);
    let is_reached = |ln: f64| ln > f64::NEG_INFINITY && reference > f64::NEG_INFINITY;
    let distance = |&ln: &f64| match is_reached(ln) {
        true => unit * (four_t * (reference - ln)).max(0.0).sqrt(),
        false => NOT_REACHED,
    };
    let values: Vec<f64> = ln.iter().map(distance).collect();
    let labels = labels(heat, &values);
    DistanceMap::new(values, labels)
}

/// A vertex on the shore: the nearest first, and of equally near ones the one with the smaller number.
#[derive(PartialEq)]
struct Shore(f64, usize);

impl Eq for Shore {}

impl Ord for Shore {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0).then(other.1.cmp(&self.1))
    }
}

impl PartialOrd for Shore {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The labels of the sources, flooded from the nearest vertex on.
fn labels(heat: &Heat, values: &[f64]) -> Vec<u32> {
    let adjacency = heat.mesh().adjacency();
    let mut labels = vec![NO_LABEL; values.len()];
    let mut shore = BinaryHeap::new();
    for (vertex, label) in heat.labelled_corners() {
        if labels[vertex] == NO_LABEL {
            labels[vertex] = label;
            shore.push(Shore(values[vertex], vertex));
        }
    }
    while let Some(Shore(_, vertex)) = shore.pop() {
        for &edge in adjacency.vertex_edges().of(vertex) {
            let next = adjacency.other_end(edge, vertex as u32) as usize;
            if labels[next] == NO_LABEL {
                labels[next] = labels[vertex];
                shore.push(Shore(values[next], next));
            }
        }
    }
    let unreached = values.iter().zip(&mut labels).filter(|(value, _)| **value == NOT_REACHED);
    unreached.for_each(|(_, label)| *label = NO_LABEL);
    labels
}
