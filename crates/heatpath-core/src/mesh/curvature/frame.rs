//! Tangent planes, and vectors carried from one to another.

use crate::mesh::TriMesh;
use crate::mesh::vector::{Vector, add, cross, dot, length, scale, subtract};

/// A tangent plane: orthonormal vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) normal: Vector,
    axes: [Vector; 2],
}

impl Frame {
    /// The plane across a unit normal; none if that is zero.
    pub(super) fn new(normal: Vector) -> Option<Self> {
        let size = normal.map(f64::abs);
        let least = (1..3).fold(0, |best, axis| if size[axis] < size[best] { axis } else { best });
        let mut axis = [0.0; 3];
        axis[least] = 1.0;
        let first = unit(cross(normal, axis))?;
        Some(Self { normal, axes: [first, cross(normal, first)] })
    }

    /// The vector with these coordinates.
    pub(super) fn vector(&self, [u, w]: [f64; 2]) -> Vector {
        add(scale(self.axes[0], u), scale(self.axes[1], w))
    }

    /// The coordinates of a vector's part in the plane.
    pub(super) fn coordinates(&self, vector: Vector) -> [f64; 2] {
        self.axes.map(|axis| dot(axis, vector))
    }

    /// The coordinates of a vector in the plane across `normal`, carried over here by the smallest
    /// turn that takes normal to normal. (Projected instead, curvature would come out too small
    /// by the mean of the squared cosine.)
    pub(super) fn carried(&self, vector: Vector, normal: Vector) -> [f64; 2] {
        let from_opposite = 1.0 + dot(normal, self.normal);
        let vector = if from_opposite > 1e-9 {
            let part = dot(self.normal, vector) / from_opposite;
            subtract(vector, scale(add(normal, self.normal), part))
        } else {
            vector
        };
        self.coordinates(vector)
    }
}

/// The vector at length 1; none if it is zero.
pub(super) fn unit(vector: Vector) -> Option<Vector> {
    let length = length(vector);
    (length > 0.0).then(|| scale(vector, 1.0 / length))
}

/// The unit normal of a face; none if it has no area.
pub(super) fn face_normal(mesh: &TriMesh, face: usize) -> Option<Vector> {
    let [a, b, c] = mesh.corners(face);
    unit(cross(unit(subtract(b, a))?, unit(subtract(c, a))?))
}

/// The unit normal at each vertex, zero where there is none: of the faces' normals the mean with the
/// weights that are exact on spheres (Max, Weights for computing vertex normals from facet
/// normals, 1999), `sin(angle) / (side * side)`.
pub(super) fn vertex_normals(mesh: &TriMesh) -> Vec<Vector> {
    let mut sums = vec![[0.0; 3]; mesh.points().len()];
    let lengths = mesh.edge_lengths();
    let unit_length = lengths.iter().copied().fold(0.0, f64::max);
    for (face, vertices) in mesh.faces().iter().enumerate() {
        let corners = mesh.corners(face);
        for (i, &vertex) in vertices.iter().enumerate() {
            let sides = [(i + 1) % 3, (i + 2) % 3].map(|j| subtract(corners[j], corners[i]));
            let [Some(a), Some(b)] = sides.map(unit) else { continue };
            let weight = sides.iter().map(|&side| unit_length / length(side)).product::<f64>();
            let sum = &mut sums[vertex as usize];
            *sum = add(*sum, scale(cross(a, b), weight));
        }
    }
    sums.into_iter().map(|sum| unit(sum).unwrap_or_default()).collect()
}
