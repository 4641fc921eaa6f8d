//! Points on the surface.

use super::TriMesh;
use super::vector::{Vector, add, cross, dot, length, scale, subtract};
use std::ops::Range;
use thiserror::Error;

/// A point on a face, by its weights (barycentric coordinates).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The face.
    pub face: u32,
    /// The weights of the face's corners: not negative, adding up to 1.
    pub weights: [f64; 3],
}

/// Why a point cannot be a source or an end of a path.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PointError {
    /// There is no point at all.
    #[error("no {role} point was given; at least one is needed")]
    Missing {
        /// What the point is for: `source` or `end`.
        role: &'static str,
    },
    /// The mesh has no such vertex.
    #[error("{role} {number} is vertex {vertex}, but the mesh has {vertices} (counted from 0)")]
    Vertex {
        /// What the point is for.
        role: &'static str,
        /// Which of them, counted from 0.
        number: usize,
        /// The vertex.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// No face uses the vertex, so it is not on the surface.
    #[error("{role} {number} is vertex {vertex}, which no face uses")]
    Unused {
        /// What the point is for.
        role: &'static str,
        /// Which of them, counted from 0.
        number: usize,
        /// The vertex.
        vertex: u32,
    },
    /// The mesh has no such face.
    #[error("{role} {number} lies on face {face}, but the mesh has {faces} (counted from 0)")]
    Face {
        /// What the point is for.
        role: &'static str,
        /// Which of them, counted from 0.
        number: usize,
        /// The face.
        face: u32,
        /// How many there are.
        faces: usize,
    },
    /// The weights are not those of a point of the face.
    #[error(
        "{role} {number} has the weights {weights:?}; they must be positive or zero and add up to 1"
    )]
    Weights {
        /// What the point is for.
        role: &'static str,
        /// Which of them, counted from 0.
        number: usize,
        /// The weights.
        weights: [f64; 3],
    },
    /// A coordinate or an offset is infinite or not a number.
    #[error("{role} {number} has {value}; it must be finite")]
    NotFinite {
        /// What the point is for.
        role: &'static str,
        /// Which of them, counted from 0.
        number: usize,
        /// The value.
        value: f64,
    },
}

impl SurfacePoint {
    /// The corner of the face that the point is, if it is one.
    #[must_use]
    pub fn corner(&self) -> Option<usize> {
        self.weights.iter().position(|&weight| weight == 1.0)
    }
}

impl TriMesh {
    /// A vertex as a point of the surface, on the first of its faces; `role` and `number` are those
    /// of the error.
    ///
    /// # Errors
    /// There is no such vertex, or no face uses it.
    pub fn at_vertex(
        &self,
        role: &'static str,
        number: usize,
        vertex: u32,
    ) -> Result<SurfacePoint, PointError> {
        let vertices = self.points().len();
        if vertex as usize >= vertices {
            return Err(PointError::Vertex { role, number, vertex, vertices });
        }
        let Some(&face) = self.adjacency().vertex_faces().of(vertex as usize).first() else {
            return Err(PointError::Unused { role, number, vertex });
        };
        let weights =
            self.faces()[face as usize].map(|corner| f64::from(u8::from(corner == vertex)));
        Ok(SurfacePoint { face, weights })
    }

    /// Where a point of the surface lies in space.
    #[must_use]
    pub fn position(&self, point: &SurfacePoint) -> [f64; 3] {
        let corners = self.corners(point.face as usize);
        let parts =
            corners.iter().zip(point.weights).map(|(&corner, weight)| scale(corner, weight));
        parts.fold([0.0; 3], add)
    }

    /// The vertices that a point lies between, with their weights: a vertex alone, the two ends of an
    /// edge, or the three corners of a face.
    #[must_use]
    pub fn shares(&self, point: &SurfacePoint) -> Vec<(u32, f64)> {
        let corners = self.faces()[point.face as usize].into_iter().zip(point.weights);
        corners.filter(|&(_, weight)| weight > 0.0).collect()
    }

    /// The value at a point of a function that is linear on each face, with these `values` at the
    /// vertices: infinite if that of a vertex with a part in the point is.
    #[must_use]
    pub fn value_at(&self, values: &[f64], point: &SurfacePoint) -> f64 {
        let shares = self.shares(point).into_iter();
        shares.map(|(vertex, weight)| weight * values[vertex as usize]).sum()
    }

    /// Checks that `points` exist and lie on this mesh.
    ///
    /// # Errors
    /// The first of them that does not.
    pub fn check_points(
        &self,
        role: &'static str,
        points: impl IntoIterator<Item = SurfacePoint>,
    ) -> Result<(), PointError> {
        let mut number = 0;
        for SurfacePoint { face, weights } in points {
            let faces = self.faces().len();
            if face as usize >= faces {
                return Err(PointError::Face { role, number, face, faces });
            }
            let sum: f64 = weights.iter().sum();
            if !(weights.iter().all(|&weight| weight >= 0.0) && (sum - 1.0).abs() < 1e-6) {
                return Err(PointError::Weights { role, number, weights });
            }
            number += 1;
        }
        if number == 0 { Err(PointError::Missing { role }) } else { Ok(()) }
    }
}

/// So many faces at most are not worth a division.
const LEAF: usize = 4;

/// A line passes a vertex if it comes nearer to it than this part of half a mean edge.
const PASSED: f64 = 1e-6;

/// A piece of a polyline is cut into so many parts at most.
const MOST_PARTS: f64 = 1e6;

/// Finds the point of the surface nearest to a point in space: a tree of boxes, each halved across
/// its longest side.
#[derive(Clone, Debug)]
pub struct Locator<'a> {
    mesh: &'a TriMesh,
    /// The faces in the order of the leaves.
    faces: Vec<u32>,
    /// A node's first child follows it.
    nodes: Vec<Node>,
}

#[derive(Clone, Debug)]
struct Node {
    low: Vector,
    high: Vector,
    faces: Range<usize>,
    /// The second child; none in a leaf.
    second: Option<usize>,
}

/// The nearest point so far.
struct Nearest {
    point: SurfacePoint,
    distance_sq: f64,
}

impl<'a> Locator<'a> {
    /// Prepares the search, in about n log n steps.
    #[must_use]
    pub fn new(mesh: &'a TriMesh) -> Self {
        let faces = (0..mesh.faces().len() as u32).collect();
        let mut locator = Self { mesh, faces, nodes: Vec::new() };
        locator.divide(0..mesh.faces().len());
        locator
    }

    /// The point of the surface nearest to `point`, and how far it is from there. Of equally near
    /// faces any may be the one.
    #[must_use]
    pub fn nearest(&self, point: [f64; 3]) -> (SurfacePoint, f64) {
        let none = SurfacePoint { face: 0, weights: [1.0, 0.0, 0.0] };
        let mut best = Nearest { point: none, distance_sq: f64::INFINITY };
        self.search(0, point, &mut best);
        (best.point, best.distance_sq.sqrt())
    }

    /// The points of the surface nearest to those of a polyline, at most half a mean edge apart from
    /// each other where the polyline is on the surface; and all vertices that it passes.
    #[must_use]
    pub fn along(&self, polyline: &[[f64; 3]]) -> Vec<SurfacePoint> {
        let lengths = self.mesh.edge_lengths();
        let step = 0.5 * lengths.iter().sum::<f64>() / lengths.len() as f64;
        let mut points: Vec<SurfacePoint> =
            polyline.first().map(|&first| self.nearest(first).0).into_iter().collect();
        for pair in polyline.windows(2) {
            let along = subtract(pair[1], pair[0]);
            let parts = (length(along) / step).ceil().clamp(1.0, MOST_PARTS) as usize;
            for part in 1..=parts {
                let place = add(pair[0], scale(along, part as f64 / parts as f64));
                let point = self.nearest(place).0;
                points.extend(self.passed([pair[0], place], &point, step));
                points.push(point);
            }
        }
        points.dedup();
        points
    }

    /// The corners of the face of `point` that a straight line passes.
    fn passed(&self, line: [Vector; 2], point: &SurfacePoint, step: f64) -> Vec<SurfacePoint> {
        let along = subtract(line[1], line[0]);
        let is_passed = |&corner: &usize| {
            let place = subtract(self.mesh.corners(point.face as usize)[corner], line[0]);
            let part = (dot(place, along) / dot(along, along)).clamp(0.0, 1.0);
            length(subtract(place, scale(along, part))) < PASSED * step
        };
        let corner = |corner| {
            let mut weights = [0.0; 3];
            weights[corner] = 1.0;
            SurfacePoint { face: point.face, weights }
        };
        (0..3).filter(is_passed).map(corner).collect()
    }

    fn divide(&mut self, range: Range<usize>) {
        let (low, high) = self.bounds(range.clone());
        let place = self.nodes.len();
        self.nodes.push(Node { low, high, faces: range.clone(), second: None });
        if range.len() <= LEAF {
            return;
        }
        let longer = |a: &usize, b: &usize| (high[*a] - low[*a]).total_cmp(&(high[*b] - low[*b]));
        let axis = (0..3).max_by(longer).unwrap_or(0);
        let mesh = self.mesh;
        let middle =
            |face: u32| mesh.corners(face as usize).iter().map(|corner| corner[axis]).sum::<f64>();
        let half = range.len() / 2;
        self.faces[range.clone()]
            .select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)));
        self.divide(range.start..range.start + half);
        self.nodes[place].second = Some(self.nodes.len());
        self.divide(range.start + half..range.end);
    }

    fn bounds(&self, range: Range<usize>) -> (Vector, Vector) {
        let corners = self.faces[range].iter().flat_map(|&face| self.mesh.corners(face as usize));
        corners.fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(low, high), corner| {
            (
                std::array::from_fn(|axis| low[axis].min(corner[axis])),
                std::array::from_fn(|axis| high[axis].max(corner[axis])),
            )
        })
    }

    fn search(&self, place: usize, point: Vector, best: &mut Nearest) {
        let node = &self.nodes[place];
        let Some(second) = node.second else {
            for &face in &self.faces[node.faces.clone()] {
                let weights = nearest_in_triangle(self.mesh.corners(face as usize), point);
                let candidate = SurfacePoint { face, weights };
                let away = subtract(self.mesh.position(&candidate), point);
                let distance_sq = dot(away, away);
                if distance_sq < best.distance_sq {
                    *best = Nearest { point: candidate, distance_sq };
                }
            }
            return;
        };
        let mut children =
            [place + 1, second].map(|child| (self.box_distance_sq(child, point), child));
        children.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (distance_sq, child) in children {
            if distance_sq < best.distance_sq {
                self.search(child, point, best);
            }
        }
    }

    fn box_distance_sq(&self, place: usize, point: Vector) -> f64 {
        let node = &self.nodes[place];
        let outside: Vector = std::array::from_fn(|axis| {
            (node.low[axis] - point[axis]).max(point[axis] - node.high[axis]).max(0.0)
        });
        dot(outside, outside)
    }
}

/// The weights of the point of a triangle that is nearest to `point`.
fn nearest_in_triangle(corners: [Vector; 3], point: Vector) -> [f64; 3] {
    let [a, b, c] = corners;
    let (ab, ac) = (subtract(b, a), subtract(c, a));
    let normal = cross(ab, ac);
    let area_sq = dot(normal, normal);
    if area_sq > 0.0 {
        let from_a = subtract(point, a);
        let of_b = dot(cross(from_a, ac), normal) / area_sq;
        let of_c = dot(cross(ab, from_a), normal) / area_sq;
        let inside = [1.0 - of_b - of_c, of_b, of_c];
        if inside.iter().all(|&weight| weight >= 0.0) {
            return inside;
        }
    }
    // Outside, or the triangle is flat: on the nearest of its sides.
    let side = |i: usize| {
        let [from, to] = [(i + 1) % 3, (i + 2) % 3];
        let along = subtract(corners[to], corners[from]);
        let part = dot(subtract(point, corners[from]), along) / dot(along, along);
        let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
        let mut weights = [0.0; 3];
        (weights[from], weights[to]) = (1.0 - part, part);
        let foot = add(corners[from], scale(along, part));
        (length(subtract(point, foot)), weights)
    };
    let nearest = (0..3).map(side).min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map_or([1.0, 0.0, 0.0], |(_, weights)| weights)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A strip of triangles that bends into the third dimension.
    fn strip() -> TriMesh {
        let points = (0..20).map(|i| {
            let x = f64::from(i / 2);
            [x, f64::from(i % 2), 0.1 * x * x]
        });
        let faces = (0..18).map(|i| if i % 2 == 0 { [i, i + 2, i + 1] } else { [i, i + 1, i + 2] });
        TriMesh::new(points.collect(), faces.collect()).unwrap()
    }

    proptest! {
        #[test]
        fn the_nearest_of_all_faces(point in prop::array::uniform3(-2.0..12.0_f64)) {
            let mesh = strip();
            let (found, away) = Locator::new(&mesh).nearest(point);
            prop_assert!(mesh.check_points("source", [found]).is_ok());
            let position = mesh.position(&found);
            prop_assert!((length(subtract(position, point)) - away).abs() < 1e-12);
            for face in 0..mesh.faces().len() as u32 {
                for [u, v] in [[0.0, 0.0], [0.3, 0.3], [0.0, 1.0], [1.0, 0.0], [0.5, 0.0], [0.2, 0.7]] {
                    let other = SurfacePoint { face, weights: [1.0 - u - v, u, v] };
                    prop_assert!(length(subtract(mesh.position(&other), point)) >= away - 1e-12);
                }
            }
        }
    }

    #[test]
    fn points_off_the_mesh_are_named() {
        let mesh = strip();
        let text = mesh.at_vertex("source", 2, 20).unwrap_err().to_string();
        assert_eq!(text, "source 2 is vertex 20, but the mesh has 20 (counted from 0)");
        let outside = SurfacePoint { face: 3, weights: [1.5, -0.5, 0.0] };
        let text = mesh.check_points("end", [outside]).unwrap_err().to_string();
        assert!(text.starts_with("end 0 has the weights [1.5, -0.5, 0.0]"), "{text}");
        assert_eq!(mesh.check_points("end", []), Err(PointError::Missing { role: "end" }));
        let vertex = mesh.at_vertex("source", 0, 7).unwrap();
        assert_eq!(mesh.position(&vertex), mesh.points()[7]);
    }
}
