//! Edges, and which faces meet where.

use crate::lists::Lists;

/// How the faces of a mesh hang together.
///
/// Edges are numbered by their ends, the smaller end first.
#[derive(Clone, Debug, PartialEq)]
pub struct Adjacency {
    edges: Vec<[u32; 2]>,
    face_edges: Vec<[u32; 3]>,
    edge_faces: Lists,
    vertex_faces: Lists,
    vertex_edges: Lists,
}

impl Adjacency {
    pub(super) fn new(points: usize, faces: &[[u32; 3]]) -> Self {
        // === The sides of all faces, by their smaller end
        let sides = || {
            let side = |(face, corners): (usize, &[u32; 3])| {
                let corners = *corners;
                (0..3).map(move |i| {
                    (corners[(i + 1) % 3].min(corners[(i + 2) % 3]), (3 * face + i) as u32)
                })
            };
            faces.iter().enumerate().flat_map(side)
        };
        let by_end = Lists::new(points, sides);
        // === The sides with the same larger end are an edge
        let (mut edges, mut face_edges) = (Vec::new(), vec![[0; 3]; faces.len()]);
        let mut here: Vec<(u32, u32)> = Vec::new();
        for low in 0..points {
            here.clear();
            here.extend(by_end.of(low).iter().map(|&side| {
                let (corners, i) = (faces[side as usize / 3], side as usize % 3);
                (corners[(i + 1) % 3].max(corners[(i + 2) % 3]), side)
            }));
            here.sort_unstable();
            for (place, &(high, side)) in here.iter().enumerate() {
                if place == 0 || here[place - 1].0 != high {
                    edges.push([low as u32, high]);
                }
                face_edges[side as usize / 3][side as usize % 3] = edges.len() as u32 - 1;
            }
        }
        let edge_faces = Lists::new(edges.len(), || numbered(&face_edges));
        let vertex_faces = Lists::new(points, || numbered(faces));
        let vertex_edges = Lists::new(points, || {
            edges.iter().enumerate().flat_map(|(edge, ends)| ends.map(|end| (end, edge as u32)))
        });
        Self { edges, face_edges, edge_faces, vertex_faces, vertex_edges }
    }

    /// The two ends of each edge, the smaller first.
    #[must_use]
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The edges of each face: the first one is opposite its first corner, and so on.
    #[must_use]
    pub fn face_edges(&self) -> &[[u32; 3]] {
        &self.face_edges
    }

    /// The faces at each edge: one at a border, more than two where the mesh is not a manifold.
    #[must_use]
    pub fn edge_faces(&self) -> &Lists {
        &self.edge_faces
    }

    /// The faces at each vertex.
    #[must_use]
    pub fn vertex_faces(&self) -> &Lists {
        &self.vertex_faces
    }

    /// The edges at each vertex.
    #[must_use]
    pub fn vertex_edges(&self) -> &Lists {
        &self.vertex_edges
    }

    /// The edge between two vertices, if there is one.
    #[must_use]
    pub fn edge_between(&self, a: u32, b: u32) -> Option<u32> {
        let ends = [a.min(b), a.max(b)];
        self.vertex_edges
            .of(a as usize)
            .iter()
            .copied()
            .find(|&edge| self.edges[edge as usize] == ends)
    }

    /// The vertex of an edge that is not `vertex`.
    #[inline]
    #[must_use]
    pub fn other_end(&self, edge: u32, vertex: u32) -> u32 {
        let [a, b] = self.edges[edge as usize];
        if a == vertex { b } else { a }
    }

    /// Whether each vertex lies on a border.
    #[must_use]
    pub fn border_vertices(&self) -> Vec<bool> {
        let mut border = vec![false; self.vertex_faces.len()];
        for (edge, ends) in self.edges.iter().enumerate() {
            if self.edge_faces.of(edge).len() == 1 {
                ends.iter().for_each(|&end| border[end as usize] = true);
            }
        }
        border
    }

    /// The component of each vertex, named by its smallest vertex. Vertices without faces are
    /// components of their own.
    #[must_use]
    pub fn components(&self) -> Vec<u32> {
        let mut components = vec![u32::MAX; self.vertex_faces.len()];
        let mut stack = Vec::new();
        for seed in 0..components.len() as u32 {
            if components[seed as usize] != u32::MAX {
                continue;
            }
            components[seed as usize] = seed;
            stack.push(seed);
            while let Some(vertex) = stack.pop() {
                for &edge in self.vertex_edges.of(vertex as usize) {
                    let next = self.other_end(edge, vertex);
                    if components[next as usize] == u32::MAX {
                        components[next as usize] = seed;
                        stack.push(next);
                    }
                }
            }
        }
        components
    }
}

/// Each part of each face with the number of the face.
pub(super) fn numbered(faces: &[[u32; 3]]) -> impl Iterator<Item = (u32, u32)> {
    let parts = |(face, parts): (usize, &[u32; 3])| parts.map(|part| (part, face as u32));
    faces.iter().enumerate().flat_map(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_and_a_vertex_of_its_own() {
        let adjacency = Adjacency::new(5, &[[0, 1, 2], [2, 1, 4]]);
        assert_eq!(adjacency.edges(), [[0, 1], [0, 2], [1, 2], [1, 4], [2, 4]]);
        assert_eq!(adjacency.face_edges(), [[2, 1, 0], [3, 4, 2]]);
        assert_eq!(adjacency.edge_faces().of(2), [0, 1]);
        assert_eq!(adjacency.edge_faces().of(0), [0]);
        assert_eq!(adjacency.vertex_faces().of(1), [0, 1]);
        assert_eq!(adjacency.vertex_faces().of(3), [0; 0]);
        assert_eq!(adjacency.vertex_edges().of(4), [3, 4]);
        assert_eq!(adjacency.components(), [0, 0, 0, 3, 0]);
        assert_eq!(adjacency.edge_between(4, 2), Some(4));
        assert_eq!(adjacency.edge_between(4, 0), None);
    }
}
