//! What a front moves on.

use super::front::{Arrival, Triangle};
use crate::lists::Lists;
use crate::mesh::triangle;
use std::f64::consts::{PI, TAU};

/// Triangles by the lengths of their edges: those of a mesh, or an intrinsic triangulation of its
/// vertices.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    faces: Vec<[u32; 3]>,
    /// Edge i of a face is opposite its corner i.
    face_edges: Vec<[u32; 3]>,
    lengths: Vec<f64>,
    slowness: Vec<f64>,
    vertex_faces: Lists,
    chords: Vec<Chord>,
    /// The chords at each vertex.
    vertex_chords: Lists,
    /// The smallest slowness of the faces at each edge.
    along: Vec<f64>,
    /// The Gaussian curvature at each vertex; 0 at borders and sharp corners.
    curvature: Vec<f64>,
    /// Whether shortest ways bend at a vertex: the angles there exceed a full turn, or half a turn at
    /// a border.
    is_saddle: Vec<bool>,
}

/// A straight way between two vertices that is no edge: an edge of the mesh that was flipped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chord {
    pub(crate) ends: [u32; 2],
    pub(crate) length: f64,
    pub(crate) slowness: f64,
}

/// Vertices whose angles lack, or exceed, a full turn by more than this are corners of the surface:
/// fronts pass them by on both sides.
const CORNER: f64 = 0.3;

impl Surface {
    pub(crate) fn new(
        vertices: usize,
        faces: Vec<[u32; 3]>,
        face_edges: Vec<[u32; 3]>,
        lengths: Vec<f64>,
        slowness: Vec<f64>,
        chords: Vec<Chord>,
    ) -> Self {
        let vertex_chords = Lists::new(vertices, || {
            let numbered = chords.iter().enumerate();
            numbered.flat_map(|(number, chord)| chord.ends.map(|end| (end, number as u32)))
        });
        let corners = || {
            let numbered = faces.iter().enumerate();
            numbered.flat_map(|(face, corners)| corners.map(|corner| (corner, face as u32)))
        };
        let vertex_faces = Lists::new(vertices, corners);
        let mut along = vec![f64::INFINITY; lengths.len()];
        for (edges, &slow) in face_edges.iter().zip(&slowness) {
            edges.iter().for_each(|&edge| along[edge as usize] = slow.min(along[edge as usize]));
        }
        let (curvature, is_saddle) = (Vec::new(), Vec::new());
        let mut surface = Self {
            faces,
            face_edges,
            lengths,
            slowness,
            chords,
            vertex_chords,
            vertex_faces,
            along,
            curvature,
            is_saddle,
        };
        surface.bend();
        surface
    }

    pub(super) fn vertices(&self) -> usize {
        self.vertex_faces.len()
    }

    /// What the longest edge costs.
    pub(super) fn longest(&self) -> f64 {
        let cost = |(length, slowness): (&f64, &f64)| length * slowness;
        let costs = self.lengths.iter().zip(&self.along).map(cost);
        costs.filter(|cost| cost.is_finite()).fold(0.0, f64::max)
    }

    fn sides(&self, face: usize) -> [f64; 3] {
        self.face_edges[face].map(|edge| self.lengths[edge as usize])
    }

    /// Measures the angles at each vertex.
    fn bend(&mut self) {
        let (mut lack, mut areas) = (vec![TAU; self.vertices()], vec![0.0; self.vertices()]);
        let mut sides_at = vec![0_u32; self.lengths.len()];
        for (face, corners) in self.faces.iter().enumerate() {
            let (sides, area) = (self.sides(face), triangle::area(self.sides(face)));
            for (i, &corner) in corners.iter().enumerate() {
                let [a, b, c] = [sides[i], sides[(i + 1) % 3], sides[(i + 2) % 3]];
                let projected = 0.5 * (b * b + (c - a) * (c + a));
                lack[corner as usize] -= (2.0 * area).atan2(projected);
                areas[corner as usize] += area / 3.0;
                sides_at[self.face_edges[face][i] as usize] += 1;
            }
        }
        // === Borders, and edges where more than two faces meet
        let mut is_border = vec![false; self.vertices()];
        for (corners, edges) in self.faces.iter().zip(&self.face_edges) {
            for i in (0..3).filter(|&i| sides_at[edges[i] as usize] != 2) {
                is_border[corners[(i + 1) % 3] as usize] = true;
                is_border[corners[(i + 2) % 3] as usize] = true;
            }
        }
        let vertices = || lack.iter().zip(&areas).zip(&is_border);
        let curvature = |((&lack, &area), &is_border): ((&f64, &f64), &bool)| {
            let is_smooth = !is_border && lack.abs() < CORNER && area > 0.0;
            if is_smooth { lack / area } else { 0.0 }
        };
        self.curvature = vertices().map(curvature).collect();
        let is_saddle = |((&lack, _), &is_border): ((&f64, &f64), &bool)| {
            lack < if is_border { PI - CORNER } else { -CORNER }
        };
        self.is_saddle = vertices().map(is_saddle).collect();
    }

    /// Offers arrivals to the other corners of the faces at `vertex`: along edges, and across faces whose
    /// third corner is `known`.
    pub(super) fn spread(
        &self,
        vertex: u32,
        arrivals: &[Arrival],
        known: impl Fn(u32) -> bool,
        mut offer: impl FnMut(u32, Arrival),
    ) {
        let old = arrivals[vertex as usize];
        let here = if self.is_saddle[vertex as usize] { old.anew(vertex) } else { old };
        for &chord in self.vertex_chords.of(vertex as usize) {
            let Chord { ends: [a, b], length, slowness } = self.chords[chord as usize];
            offer(if a == vertex { b } else { a }, here.along(length, slowness));
        }
        for &face in self.vertex_faces.of(vertex as usize) {
            let face = face as usize;
            let (corners, edges) = (self.faces[face], self.face_edges[face]);
            let at = corners.iter().position(|&corner| corner == vertex).unwrap_or(0);
            for (target, other) in [(1, 2), (2, 1)] {
                let [target, other] = [(at + target) % 3, (at + other) % 3];
                let side = edges[other] as usize;
                offer(corners[target], here.along(self.lengths[side], self.along[side]));
                if !known(corners[other]) {
                    continue;
                }
                let sides = [at, other, target].map(|i| self.lengths[edges[i] as usize]);
                let triangle =
                    Triangle::new(sides, self.slowness[face], self.mean_curvature(corners));
                let there = arrivals[corners[other] as usize];
                // A front that began at one of both is a circle around that.
                let from = match (old.centre, there.centre) {
                    (_, Some(centre)) if centre == vertex => [old.anew(vertex), there],
                    (Some(centre), _) if centre == corners[other] => [old, there.anew(centre)],
                    _ => [old, there],
                };
                if let Some(arrival) = triangle.cross([&from[0], &from[1]]) {
                    offer(corners[target], arrival);
                }
            }
        }
    }

    fn mean_curvature(&self, corners: [u32; 3]) -> f64 {
        corners.iter().map(|&corner| self.curvature[corner as usize]).sum::<f64>() / 3.0
    }
}
