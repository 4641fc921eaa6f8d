//! Points of the surface by the part of it that they lie in.

use super::plane::{self, corners, weighted};
use super::{Medium, SurfacePoint, TriMesh};

/// A vertex, a point inside an edge, or a point inside a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Spot {
    Vertex(u32),
    /// `part` is the weight of the edge's second end, above 0 and below 1.
    Edge {
        edge: u32,
        part: f64,
    },
    Face(SurfacePoint),
}

/// Parts this near to 0 or 1 are those of a vertex.
const SNAP: f64 = 1e-12;

impl Spot {
    /// The part of the surface that a point lies in.
    pub(crate) fn of(mesh: &TriMesh, point: &SurfacePoint) -> Self {
        let (corners, weights) = (mesh.faces()[point.face as usize], point.weights);
        if let Some(corner) = weights.iter().position(|&weight| weight >= 1.0 - SNAP) {
            return Self::Vertex(corners[corner]);
        }
        let Some(side) = weights.iter().position(|&weight| weight <= SNAP) else {
            return Self::Face(*point);
        };
        let edge = mesh.adjacency().face_edges()[point.face as usize][side];
        let [first, _] = mesh.adjacency().edges()[edge as usize];
        let [a, b] = [(side + 1) % 3, (side + 2) % 3];
        let (low, high) = if corners[a] == first { (a, b) } else { (b, a) };
        Self::on_edge(mesh, edge, weights[high] / (weights[low] + weights[high]))
    }

    /// The point of an edge whose second end has the weight `part`.
    pub(crate) fn on_edge(mesh: &TriMesh, edge: u32, part: f64) -> Self {
        let [a, b] = mesh.adjacency().edges()[edge as usize];
        match part {
            _ if part <= SNAP => Self::Vertex(a),
            _ if part >= 1.0 - SNAP => Self::Vertex(b),
            _ => Self::Edge { edge, part },
        }
    }

    /// The faces that the spot lies on.
    pub(crate) fn faces<'a>(&'a self, mesh: &'a TriMesh) -> &'a [u32] {
        match self {
            Self::Vertex(vertex) => mesh.adjacency().vertex_faces().of(*vertex as usize),
            Self::Edge { edge, .. } => mesh.adjacency().edge_faces().of(*edge as usize),
            Self::Face(point) => std::slice::from_ref(&point.face),
        }
    }

    /// The weights of the corners of a face that the spot lies on.
    pub(crate) fn weights(&self, mesh: &TriMesh, face: u32) -> [f64; 3] {
        let corners = mesh.faces()[face as usize];
        match *self {
            Self::Vertex(vertex) => corners.map(|corner| f64::from(u8::from(corner == vertex))),
            Self::Edge { edge, part } => {
                let [a, b] = mesh.adjacency().edges()[edge as usize];
                corners.map(|corner| match corner {
                    _ if corner == a => 1.0 - part,
                    _ if corner == b => part,
                    _ => 0.0,
                })
            }
            Self::Face(point) => point.weights,
        }
    }

    /// The spot as a point on the first of its faces.
    pub(crate) fn point(&self, mesh: &TriMesh) -> SurfacePoint {
        let face = self.faces(mesh)[0];
        SurfacePoint { face, weights: self.weights(mesh, face) }
    }

    /// The first face that both spots lie on.
    pub(crate) fn shared_face(&self, other: &Self, mesh: &TriMesh) -> Option<u32> {
        let (mine, others) = (self.faces(mesh), other.faces(mesh));
        mine.iter().copied().find(|face| others.binary_search(face).is_ok())
    }

    /// The value at the spot of a function that is linear on each face.
    pub(crate) fn value(&self, mesh: &TriMesh, values: &[f64]) -> f64 {
        match *self {
            Self::Vertex(vertex) => values[vertex as usize],
            Self::Edge { edge, part } => {
                let [a, b] =
                    mesh.adjacency().edges()[edge as usize].map(|end| values[end as usize]);
                ((1.0 - part) * a + part * b).clamp(a.min(b), a.max(b))
            }
            Self::Face(point) => {
                let corners = mesh.faces()[point.face as usize].map(|c| values[c as usize]);
                let sum: f64 = (0..3).map(|i| point.weights[i] * corners[i]).sum();
                sum.max(corners.into_iter().fold(f64::INFINITY, f64::min))
            }
        }
    }
}

/// What it costs to go straight from one spot of a face to another.
pub(crate) fn cost(medium: &Medium, face: u32, from: &Spot, to: &Spot) -> f64 {
    let corners = corners(medium.sides(face as usize));
    let [from, to] = [from, to].map(|spot| weighted(corners, spot.weights(medium.mesh(), face)));
    medium.slowness()[face as usize] * plane::length(plane::minus(to, from))
}
