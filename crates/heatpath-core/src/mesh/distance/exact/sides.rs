//! The faces of a mesh, each seen across each of its sides.

use crate::mesh::triangle::third_corner;
use crate::mesh::{Lists, Medium, TriMesh};
use std::f64::consts::PI;

/// Vertices whose total angle falls short of a full turn by no more than this count as flat, and
/// directions short of a half turn by no more than this as straight on.
///
/// Far above what rounding does to an angle (1e-12 in needles), and so small that only vertices of
/// truly flat regions are concerned: a sphere of a million vertices misses 1e-5 at each.
const FLAT: f64 = 1e-8;

/// A side of a face with the face laid out in the plane of the side: the side runs from the origin
/// along the first axis, and the face lies above it.
///
/// The direction is that of the edge, so all faces at an edge agree on the first axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) length: f64,
    /// The corner opposite the side; its second coordinate is positive.
    pub(super) apex: [f64; 2],
    /// The vertex at `apex`.
    pub(super) vertex: u32,
    /// The vertices at the ends.
    pub(super) ends: [u32; 2],
    /// The sides from these ends to the apex.
    pub(super) next: [u32; 2],
    pub(super) edge: u32,
}

impl Side {
    /// The angle of the face at the apex.
    fn angle(&self) -> f64 {
        self.angles_from(self.end(0))[1]
    }

    /// Where an end lies.
    pub(super) fn end(&self, end: usize) -> [f64; 2] {
        [[0.0, 0.0], [self.length, 0.0]][end]
    }

    /// The angles at the apex between a point and the two ends.
    fn angles_from(&self, point: [f64; 2]) -> [f64; 2] {
        let from_apex = |p: [f64; 2]| [p[0] - self.apex[0], p[1] - self.apex[1]];
        let a = from_apex(point);
        [0, 1].map(|end| {
            let b = from_apex(self.end(end));
            (a[0] * b[1] - a[1] * b[0]).abs().atan2(a[0] * b[0] + a[1] * b[1])
        })
    }
}

/// How a shortest path comes to a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival {
    /// The side opposite the vertex in the last face of the path.
    side: u32,
    /// The angles between the path and the two other sides of this face.
    angles: [f64; 2],
}

/// All sides of all faces; side i of face f has the number 3 f + i.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    list: Vec<Side>,
    /// The sides at each edge.
    at_edge: Lists,
    /// The sides opposite each vertex.
    at_vertex: Lists,
}

impl Sides {
    /// Lays out all faces with their lengths divided by `unit`.
    pub(super) fn new(medium: &Medium, unit: f64) -> Self {
        let mesh = medium.mesh();
        let numbers = 0..3 * mesh.faces().len() as u32;
        let list: Vec<Side> =
            numbers.map(|number| side(mesh, medium.lengths(), number, unit)).collect();
        let numbered = || list.iter().zip(0..);
        let at_edge = Lists::new(medium.lengths().len(), || {
            numbered().map(|(side, number)| (side.edge, number))
        });
        let at_vertex = Lists::new(mesh.points().len(), || {
            numbered().map(|(side, number)| (side.vertex, number))
        });
        Self { list, at_edge, at_vertex }
    }

    #[inline]
    pub(super) fn get(&self, side: u32) -> &Side {
        &self.list[side as usize]
    }

    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    /// The sides of other faces at the same edge.
    #[inline]
    pub(super) fn across(&self, side: u32) -> impl Iterator<Item = u32> {
        let edge = self.get(side).edge as usize;
        self.at_edge.of(edge).iter().copied().filter(move |&other| other != side)
    }

    /// Whether more than two faces meet at the edge of a side.
    #[inline]
    pub(super) fn is_crowded(&self, side: u32) -> bool {
        self.at_edge.range(self.get(side).edge as usize).len() > 2
    }

    /// The sides opposite a vertex.
    pub(super) fn opposite(&self, vertex: u32) -> &[u32] {
        self.at_vertex.of(vertex as usize)
    }

    /// Whether shortest paths can bend at a vertex: it is a saddle or flat ([`FLAT`]), on a border, or
    /// its faces are no disk.
    pub(super) fn can_bend(&self, vertex: u32) -> bool {
        let opposite = self.opposite(vertex);
        let Some(&first) = opposite.first() else { return false };
        let total: f64 = opposite.iter().map(|&side| self.get(side).angle()).sum();
        let around = self.fan(first, 0).take_while(|&side| side != first).count();
        let closed = self.fan(first, 0).nth(around).is_some();
        total >= 2.0 * PI - FLAT || !closed || around + 1 < opposite.len()
    }

    /// The faces around the apex of a side, by their sides opposite it: from the face of `side` across its
    /// edge at `end` and on, up to a border or a crowded edge, or around and around.
    fn fan(&self, side: u32, end: usize) -> impl Iterator<Item = u32> {
        let vertex = self.get(side).vertex;
        let mut here = (side, end);
        std::iter::from_fn(move || {
            let next = self.get(here.0).next[here.1];
            let mut others = self.across(next);
            let (other, None) = (others.next()?, others.next()) else { return None };
            let first = other - other % 3;
            let found = (first..first + 3).find(|&side| self.get(side).vertex == vertex)?;
            let shared = self.get(here.0).ends[here.1];
            here = (found, usize::from(self.get(found).ends[0] == shared));
            Some(found)
        })
    }

    /// How a path comes to the apex of `side` from a point in the plane of the side.
    pub(super) fn arrival(&self, side: u32, from: [f64; 2]) -> Arrival {
        Arrival { side, angles: self.get(side).angles_from(from) }
    }

    /// How a path comes to the apex of `side` along the edge from another vertex of its face.
    pub(super) fn arrival_along(&self, side: u32, vertex: u32) -> Arrival {
        let at = self.get(side);
        self.arrival(side, at.end(usize::from(at.ends[1] == vertex)))
    }

    /// The faces behind a vertex, by their sides opposite it: those that a path from `arrival` can
    /// go on into, because it bends by no more than a half turn on either side.
    pub(super) fn behind(&self, vertex: u32, arrival: Option<Arrival>) -> Vec<u32> {
        let mut before = Vec::new();
        if let Some(Arrival { side, angles }) = arrival {
            before.push(side);
            for (end, mut angle) in angles.into_iter().enumerate() {
                before.extend(self.fan(side, end).take_while(|&other| {
                    angle += self.get(other).angle();
                    angle < PI - FLAT && other != side
                }));
            }
        }
        self.opposite(vertex).iter().copied().filter(|side| !before.contains(side)).collect()
    }
}

fn side(mesh: &TriMesh, lengths: &[f64], number: u32, unit: f64) -> Side {
    let (face, i) = (number as usize / 3, number as usize % 3);
    let (corners, edges) = (mesh.faces()[face], mesh.adjacency().face_edges()[face]);
    let edge = edges[i];
    let ends = mesh.adjacency().edges()[edge as usize];
    let second = (i + 1) % 3;
    // The corners of the face at the first and at the last end.
    let [a, b] =
        if corners[second] == ends[0] { [second, (i + 2) % 3] } else { [(i + 2) % 3, second] };
    let sides = [a, b, i].map(|corner| lengths[edges[corner] as usize] / unit);
    let next = [b, a].map(|corner| (3 * face + corner) as u32);
    Side { length: sides[2], apex: third_corner(sides), vertex: corners[i], ends, next, edge }
}
