//! Least squares of the changes of normals over each face (Rusinkiewicz 2004).

use super::Form;
use super::ball::Ball;
use super::frame::{Frame, face_normal};
use crate::mesh::TriMesh;
use crate::mesh::vector::{Vector, length, scale, subtract};

/// The second fundamental form of each face.
#[derive(Debug)]
pub(super) struct LeastSquares {
    faces: Vec<Option<(Frame, Form)>>,
}

/// Below this part of the squared trace of a face's moments its sides are all but parallel.
const FLATTEST: f64 = 1e-14;

impl LeastSquares {
    /// The forms of all faces, from the normals of the vertices.
    pub(super) fn new(mesh: &TriMesh, normals: &[Vector]) -> Self {
        let form = |face| {
            let frame = Frame::new(face_normal(mesh, face)?)?;
            Some((frame, face_form(mesh, normals, face, &frame)?))
        };
        Self { faces: (0..mesh.faces().len()).map(form).collect() }
    }

    /// The mean of the forms in the ball, by area.
    pub(super) fn form(&self, ball: &Ball<'_>, frame: &Frame) -> Form {
        let (mut sum, mut whole) = ([[0.0; 2]; 2], 0.0);
        for &(face, area) in ball.faces() {
            let Some((from, form)) = &self.faces[face as usize] else { continue };
            // The face's axes as seen from the frame: the form is turned as they are.
            let axes =
                [[1.0, 0.0], [0.0, 1.0]].map(|axis| frame.carried(from.vector(axis), from.normal));
            for (row, entry) in (0..2).flat_map(|i| (0..2).map(move |j| (i, j))) {
                let terms = (0..2).flat_map(|i| (0..2).map(move |j| (i, j)));
                sum[row][entry] += area
                    * terms.map(|(i, j)| form[i][j] * axes[i][row] * axes[j][entry]).sum::<f64>();
            }
            whole += area;
        }
        if whole > 0.0 { sum.map(|row| row.map(|entry| entry / whole)) } else { sum }
    }
}

/// The form `[[a, b], [b, c]]` that best turns each side (u, w) of the face into the change of normals along
/// it (p, q): `S a + M b = sum u p`, `M a + (S + V) b + M c = sum (w p + u q)`, `M b + V c = sum w q`
/// with the moments `S = sum u u`, `M = sum u w`, `V = sum w w`.
fn face_form(mesh: &TriMesh, normals: &[Vector], face: usize, frame: &Frame) -> Option<Form> {
    let (corners, vertices) = (mesh.corners(face), mesh.faces()[face]);
    let sides: [Vector; 3] =
        std::array::from_fn(|i| subtract(corners[(i + 2) % 3], corners[(i + 1) % 3]));
    let unit_length = sides.iter().map(|&side| length(side)).fold(0.0, f64::max);
    let [mut s, mut m, mut v] = [0.0; 3];
    let mut right = [0.0; 3];
    for (i, &side) in sides.iter().enumerate() {
        let [from, to] = [(i + 1) % 3, (i + 2) % 3].map(|j| normals[vertices[j] as usize]);
        let [u, w] = frame.coordinates(scale(side, 1.0 / unit_length));
        let [p, q] = frame.coordinates(subtract(to, from));
        (s, m, v) = (s + u * u, m + u * w, v + w * w);
        right = [right[0] + u * p, right[1] + w * p + u * q, right[2] + w * q];
    }
    // === Cramer's rule
    let (trace, flat) = (s + v, s * v - m * m);
    if flat <= FLATTEST * trace * trace {
        return None;
    }
    let [p, q, r] = right.map(|x| x / (trace * flat * unit_length));
    let a = (trace * v - m * m) * p - m * v * q + m * m * r;
    let b = -m * v * p + s * v * q - s * m * r;
    let c = m * m * p - s * m * q + (s * trace - m * m) * r;
    Some([[a, b], [b, c]])
}
