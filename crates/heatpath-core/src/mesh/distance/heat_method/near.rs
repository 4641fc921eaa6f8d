//! Distances around the sources, where heat is least exact.

use super::group::Group;
use super::unfold::visible;
use crate::mesh::{Lists, Medium, Source, Triangulation};
use std::collections::{BTreeMap, BTreeSet};

/// How many rings of faces around a source are corrected.
const RINGS: usize = 4;

/// What is known without heat: the distances of the vertices around the sources.
#[derive(Debug)]
pub(super) struct Near {
    /// Faces whose corners are all known.
    pub(super) faces: BTreeSet<u32>,
    pub(super) distances: BTreeMap<u32, f64>,
}

impl Near {
    pub(super) fn new(
        medium: &Medium,
        triangulation: &Triangulation,
        vertex_faces: &Lists,
        group: &Group,
    ) -> Self {
        let mut near = Self { faces: BTreeSet::new(), distances: BTreeMap::new() };
        for source in &group.sources {
            for (vertex, distance) in visible(medium, source) {
                let known = near.distances.entry(vertex).or_insert(f64::INFINITY);
                *known = known.min(distance);
            }
            near.faces.extend(rings(medium, triangulation, vertex_faces, source));
        }
        let known = &near.distances;
        near.faces.retain(|&face| {
            triangulation.faces()[face as usize].iter().all(|vertex| known.contains_key(vertex))
        });
        let corners = near.faces.iter().flat_map(|&face| triangulation.faces()[face as usize]);
        let points = group.sources.iter().flat_map(|source| medium.mesh().shares(&source.point));
        let around: BTreeSet<u32> = corners.chain(points.map(|(vertex, _)| vertex)).collect();
        near.distances.retain(|vertex, _| around.contains(vertex));
        near
    }
}

/// The faces around a source.
fn rings(
    medium: &Medium,
    triangulation: &Triangulation,
    vertex_faces: &Lists,
    source: &Source,
) -> BTreeSet<u32> {
    let shares = medium.mesh().shares(&source.point).into_iter();
    let mut vertices: BTreeSet<u32> = shares.map(|(vertex, _)| vertex).collect();
    let mut faces = BTreeSet::new();
    for _ in 0..RINGS {
        for &vertex in &vertices {
            faces.extend(vertex_faces.of(vertex as usize));
        }
        vertices.extend(faces.iter().flat_map(|&face| triangulation.faces()[face as usize]));
    }
    faces
}
