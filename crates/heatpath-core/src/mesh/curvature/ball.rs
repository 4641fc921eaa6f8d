//! What of the surface lies around a vertex.

use super::clip::{area_inside, length_inside};
use crate::mesh::TriMesh;
use crate::mesh::vector::{scale, subtract};

/// The faces and edges around a vertex, and how much of each is inside the ball. Lengths and areas
/// are in units of the radius.
///
/// The ball grows from face to face across the edges that are inside.
#[derive(Debug)]
pub(super) struct Ball<'a> {
    mesh: &'a TriMesh,
    radius: Option<f64>,
    faces: Vec<(u32, f64)>,
    edges: Vec<(u32, f64)>,
    /// When each face and edge was last met.
    faces_met: Vec<u32>,
    edges_met: Vec<u32>,
    now: u32,
}

impl<'a> Ball<'a> {
    /// Balls of this radius; without one, the faces at the vertex.
    pub(super) fn new(mesh: &'a TriMesh, radius: Option<f64>) -> Self {
        let (faces_met, edges_met) =
            (vec![0; mesh.faces().len()], vec![0; mesh.adjacency().edges().len()]);
        Self { mesh, radius, faces: Vec::new(), edges: Vec::new(), faces_met, edges_met, now: 0 }
    }

    /// The unit of lengths.
    pub(super) fn unit(&self) -> f64 {
        self.radius.unwrap_or(1.0)
    }

    /// The faces and their areas inside.
    pub(super) fn faces(&self) -> &[(u32, f64)] {
        &self.faces
    }

    /// The edges and their lengths inside.
    pub(super) fn edges(&self) -> &[(u32, f64)] {
        &self.edges
    }

    /// Puts the ball around a vertex.
    pub(super) fn grow(&mut self, vertex: usize) {
        let mesh = self.mesh;
        let around = mesh.adjacency().vertex_faces().of(vertex);
        self.now += 1;
        self.edges.clear();
        self.faces.clear();
        self.faces.extend(around.iter().map(|&face| (face, 0.0)));
        around.iter().for_each(|&face| self.faces_met[face as usize] = self.now);
        let Some(radius) = self.radius else {
            self.faces.iter_mut().for_each(|face| face.1 = area(mesh.corners(face.0 as usize)));
            return;
        };
        let centre = mesh.points()[vertex];
        let local = |point: [f64; 3]| scale(subtract(point, centre), 1.0 / radius);
        let mut next = 0;
        while next < self.faces.len() {
            let face = self.faces[next].0 as usize;
            self.faces[next].1 = area_inside(mesh.corners(face).map(local));
            next += 1;
            for edge in mesh.adjacency().face_edges()[face] {
                if std::mem::replace(&mut self.edges_met[edge as usize], self.now) == self.now {
                    continue;
                }
                let ends = mesh.adjacency().edges()[edge as usize];
                let [a, b] = ends.map(|end| local(mesh.points()[end as usize]));
                let length = length_inside(a, b);
                if length > 0.0 {
                    self.edges.push((edge, length));
                    self.add_faces_at(edge);
                }
            }
        }
    }

    fn add_faces_at(&mut self, edge: u32) {
        for &face in self.mesh.adjacency().edge_faces().of(edge as usize) {
            if std::mem::replace(&mut self.faces_met[face as usize], self.now) != self.now {
                self.faces.push((face, 0.0));
            }
        }
    }
}

fn area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    use crate::mesh::vector::{cross, length};
    0.5 * length(cross(subtract(b, a), subtract(c, a)))
}
