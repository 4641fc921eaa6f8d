//! Where a point lies on a face.

use super::sides::Sides;
use crate::mesh::{SurfacePoint, TriMesh};

/// Points whose weight is less than this lie on the side opposite.
const ON_SIDE: f64 = 1e-14;

/// A point on a face, by weights that are exactly zero on sides and add up to one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) face: u32,
    pub(super) weights: [f64; 3],
}

impl Place {
    pub(super) fn new(point: &SurfacePoint) -> Self {
        let weights = point.weights.map(|weight| if weight < ON_SIDE { 0.0 } else { weight });
        let sum: f64 = weights.iter().sum();
        Self { face: point.face, weights: weights.map(|weight| weight / sum) }
    }

    /// A corner of a face, from the side opposite.
    pub(super) fn at_apex(side: u32) -> Self {
        let mut weights = [0.0; 3];
        weights[side as usize % 3] = 1.0;
        Self { face: side / 3, weights }
    }

    /// The point of a side at a distance from its first end.
    pub(super) fn on_side(sides: &Sides, side: u32, at: f64) -> Self {
        let on = sides.get(side);
        let (part, mut weights) = (at / on.length, [0.0; 3]);
        weights[on.next[1] as usize % 3] = 1.0 - part;
        weights[on.next[0] as usize % 3] = part;
        Self::new(&SurfacePoint { face: side / 3, weights })
    }

    /// The same point on every face that has it: on a side all faces at the edge, otherwise this one.
    pub(super) fn all(self, mesh: &TriMesh) -> Vec<Self> {
        let zero = |&i: &usize| self.weights[i] == 0.0;
        let mut zeros = (0..3).filter(zero);
        let (Some(i), None) = (zeros.next(), zeros.next()) else { return vec![self] };
        let edge = mesh.adjacency().face_edges()[self.face as usize][i];
        let faces = mesh.adjacency().edge_faces().of(edge as usize);
        faces.iter().map(|&face| self.on(mesh, face)).collect()
    }

    /// The same point on another face at its edge.
    fn on(self, mesh: &TriMesh, face: u32) -> Self {
        let corners = mesh.faces()[self.face as usize];
        let weight = |vertex: u32| {
            corners.iter().position(|&corner| corner == vertex).map_or(0.0, |i| self.weights[i])
        };
        Self { face, weights: mesh.faces()[face as usize].map(weight) }
    }

    /// The vertex that the point is, if it is one.
    pub(super) fn vertex(&self, sides: &Sides) -> Option<u32> {
        let corner = self.weights.iter().position(|&weight| weight == 1.0)?;
        Some(sides.get(3 * self.face + corner as u32).vertex)
    }

    /// The sides of the face.
    pub(super) fn sides(&self) -> std::ops::Range<u32> {
        3 * self.face..3 * self.face + 3
    }

    /// Whether the point does not lie on this side of its face.
    pub(super) fn is_off(&self, side: u32) -> bool {
        self.weights[side as usize % 3] > 0.0
    }

    /// Where the point lies in the plane of one of its face's sides.
    pub(super) fn seen_from(&self, sides: &Sides, side: u32) -> [f64; 2] {
        let at = sides.get(side);
        let apex = self.weights[side as usize % 3];
        // The side from the first end to the apex is opposite the other end.
        let last = self.weights[at.next[0] as usize % 3];
        [last * at.length + apex * at.apex[0], apex * at.apex[1]]
    }
}
