//! The mesh itself.

use super::adjacency::Adjacency;
use super::vector::{Vector, distance};
use thiserror::Error;

/// A triangle mesh: points, faces, and how they hang together.
///
/// Any triangles will do: borders, edges with more than two faces, vertices without faces, several
/// components and flat triangles are all allowed. What a file holds beyond that (polygons, faces
/// that use a vertex twice, the same point many times) cleaning turns into a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct TriMesh {
    points: Vec<[f64; 3]>,
    faces: Vec<[u32; 3]>,
    adjacency: Adjacency,
}

/// Why points and faces are no mesh.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshError {
    /// There is no face.
    #[error("the mesh has no faces")]
    Empty,
    /// More vertices or corners of faces than 32 bits can count.
    #[error("the mesh has {points} points and {faces} faces; at most {} of either fit", u32::MAX / 3)]
    TooLarge {
        /// The number of points.
        points: usize,
        /// The number of faces.
        faces: usize,
    },
    /// A face uses a vertex that does not exist.
    #[error("face {face} uses vertex {vertex}, but there are {points} (counted from 0)")]
    Vertex {
        /// The first such face.
        face: usize,
        /// The vertex.
        vertex: u64,
        /// How many there are.
        points: usize,
    },
    /// A face uses a vertex twice.
    #[error("face {face} uses vertex {vertex} twice; it has no area and must be left out")]
    Repeated {
        /// The first such face.
        face: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A coordinate is infinite, not a number, or too large to be squared.
    #[error("vertex {vertex} lies at {point:?}; coordinates must be finite, up to 1e100")]
    NotFinite {
        /// The first such vertex.
        vertex: usize,
        /// Its coordinates.
        point: [f64; 3],
    },
}

/// Larger coordinates overflow when areas are computed.
const LARGEST_COORDINATE: f64 = 1e100;

impl TriMesh {
    /// The mesh of `faces`, each three numbers of `points`, counter-clockwise from outside.
    ///
    /// # Errors
    /// There are no faces, a number is not that of a point, a face uses a point twice, or a
    /// coordinate is not finite.
    pub fn new(points: Vec<[f64; 3]>, faces: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check(&points, &faces)?;
        let adjacency = Adjacency::new(points.len(), &faces);
        Ok(Self { points, faces, adjacency })
    }

    /// The coordinates of each vertex.
    #[must_use]
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The vertices of each face.
    #[must_use]
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The edges, and which faces meet where.
    #[must_use]
    pub fn adjacency(&self) -> &Adjacency {
        &self.adjacency
    }

    /// The corners of a face in space.
    #[must_use]
    pub fn corners(&self, face: usize) -> [[f64; 3]; 3] {
        self.faces[face].map(|vertex| self.points[vertex as usize])
    }

    /// The length of each edge.
    #[must_use]
    pub fn edge_lengths(&self) -> Vec<f64> {
        let length = |&[a, b]: &[u32; 2]| self.edge_vector_length(a, b);
        self.adjacency.edges().iter().map(length).collect()
    }

    fn edge_vector_length(&self, a: u32, b: u32) -> f64 {
        distance(self.points[a as usize], self.points[b as usize])
    }

    /// The lowest and the highest coordinates of all vertices that faces use.
    #[must_use]
    pub fn bounds(&self) -> [Vector; 2] {
        let corners = self.faces.iter().flatten().map(|&vertex| self.points[vertex as usize]);
        corners.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], point| {
            [
                std::array::from_fn(|axis| low[axis].min(point[axis])),
                std::array::from_fn(|axis| high[axis].max(point[axis])),
            ]
        })
    }
}

fn check(points: &[[f64; 3]], faces: &[[u32; 3]]) -> Result<(), MeshError> {
    if faces.is_empty() {
        return Err(MeshError::Empty);
    }
    if points.len().max(faces.len()) > u32::MAX as usize / 3 {
        return Err(MeshError::TooLarge { points: points.len(), faces: faces.len() });
    }
    check_points(points)?;
    for (face, &[a, b, c]) in faces.iter().enumerate() {
        let vertex = a.max(b).max(c);
        if vertex as usize >= points.len() {
            return Err(MeshError::Vertex { face, vertex: vertex.into(), points: points.len() });
        }
        if a == b || b == c || c == a {
            return Err(MeshError::Repeated { face, vertex: if a == b { a } else { c } });
        }
    }
    Ok(())
}

/// Checks that all coordinates are finite and can be squared.
pub(super) fn check_points(points: &[[f64; 3]]) -> Result<(), MeshError> {
    let fits = |x: &f64| x.abs() <= LARGEST_COORDINATE;
    match points.iter().position(|point| !point.iter().all(fits)) {
        Some(vertex) => Err(MeshError::NotFinite { vertex, point: points[vertex] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_mesh_is_named() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let text = |points: &[[f64; 3]], faces: &[[u32; 3]]| {
            TriMesh::new(points.to_vec(), faces.to_vec()).unwrap_err().to_string()
        };
        assert_eq!(text(&points, &[]), "the mesh has no faces");
        assert_eq!(
            text(&points, &[[0, 1, 2], [0, 1, 3]]),
            "face 1 uses vertex 3, but there are 3 (counted from 0)"
        );
        assert_eq!(
            text(&points, &[[0, 1, 0]]),
            "face 0 uses vertex 0 twice; it has no area and must be left out"
        );
        let far = [[0.0; 3], [f64::NAN, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(
            text(&far, &[[0, 1, 2]]),
            "vertex 1 lies at [NaN, 0.0, 0.0]; coordinates must be finite, up to 1e100"
        );
    }
}
