//! Meshes of known shape, on which distances are known too: for tests, benchmarks and examples.

use super::TriMesh;
use super::vector::{add, cross, distance, dot, length, scale, subtract};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// The unit sphere: an icosahedron whose faces were divided into four `level` times, 10 * 4^level + 2
/// vertices.
#[must_use]
pub fn icosphere(level: usize) -> TriMesh {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let mut points = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        points.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]].map(unit));
    }
    // Faces are the triples of mutual neighbours, turned outwards.
    let near = |a: [f64; 3], b: [f64; 3]| distance(a, b) < 1.1;
    let mut faces = Vec::new();
    for a in 0..12_usize {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|vertex| points[vertex]);
                if near(p, q) && near(q, r) && near(r, p) {
                    let outside = dot(cross(p, q), r) > 0.0;
                    let [b, c] = if outside { [b, c] } else { [c, b] };
                    faces.push([a, b, c].map(|vertex| vertex as u32));
                }
            }
        }
    }
    for _ in 0..level {
        faces = divided(&mut points, &faces);
    }
    built(points, faces)
}

/// Each face in four, with new points in the middle of the edges, on the unit sphere.
fn divided(points: &mut Vec<[f64; 3]>, faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            points.push(unit(add(points[a as usize], points[b as usize])));
            points.len() as u32 - 1
        })
    };
    let four = |&[a, b, c]: &[u32; 3]| {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    faces.iter().flat_map(four).collect()
}

fn unit(point: [f64; 3]) -> [f64; 3] {
    scale(point, 1.0 / length(point))
}

/// A rectangle of `columns` x `rows` squares, each cut in two; `place` says where the vertex of a
/// column and a row lies. Vertices are numbered row by row.
///
/// # Panics
/// There are no columns, no rows, or too many for 32 bits; or a place is not finite.
#[must_use]
pub fn sheet(columns: usize, rows: usize, place: impl Fn(usize, usize) -> [f64; 3]) -> TriMesh {
    let number = |column: usize, row: usize| (row * (columns + 1) + column) as u32;
    let places = (0..=rows).flat_map(|row| (0..=columns).map(move |column| (column, row)));
    let points = places.map(|(column, row)| place(column, row)).collect();
    let squares = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let halves = |(x, y): (usize, usize)| {
        let [a, b, c, d] =
            [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|(x, y)| number(x, y));
        [[a, b, d], [a, d, c]]
    };
    built(points, squares.flat_map(halves).collect())
}

/// The torus around the z axis with the radii `large` (of the circle in the middle) and `small` (of
/// the tube), with `around` x `along` vertices: vertex `j * around + i` lies at the angle i around
/// the axis and the angle j around the tube.
///
/// # Panics
/// There are fewer than three vertices around or along, or too many for 32 bits.
#[must_use]
pub fn torus(large: f64, small: f64, around: usize, along: usize) -> TriMesh {
    let number = |i: usize, j: usize| (j % along * around + i % around) as u32;
    let mut points = Vec::with_capacity(around * along);
    let mut faces = Vec::with_capacity(2 * around * along);
    for j in 0..along {
        let (up, out) = (TAU * j as f64 / along as f64).sin_cos();
        for i in 0..around {
            let (y, x) = (TAU * i as f64 / around as f64).sin_cos();
            let radius = large + small * out;
            points.push([radius * x, radius * y, small * up]);
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| number(i, j));
            faces.extend([[a, b, d], [a, d, c]]);
        }
    }
    built(points, faces)
}

/// A block and its sharp edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The block, closed, of genus 0.
    pub mesh: TriMesh,
    /// The edges between faces of different planes, each by its two vertices, the smaller first.
    pub sharp_edges: Vec<[u32; 2]>,
}

/// The division that makes [`block`] as fine as the one of the paper's Fig. 11, which has 57,184
/// faces: 56,448.
pub const BLOCK_DIVISION: usize = 28;

/// A wedge-like block with sharp convex and concave edges, 4 x 2 x 2 units: a lower half whose top
/// falls off to one side, and on the other side of it an upper half with a slanting flank, which
/// meets that top in a concave edge. A unit is cut into `division` squares, `72 division^2` faces in all,
/// whose vertices lie exactly on the edges.
///
/// # Panics
/// `division` is 0 or too large for 32 bits.
#[must_use]
pub fn block(division: usize) -> Block {
    let n = division as i64;
    let is_solid = |[i, j, k]: [i64; 3]| {
        let length = if k < n { 4 * n } else { 2 * n };
        (0..length).contains(&i) && (0..2 * n).contains(&j) && (0..2 * n).contains(&k)
    };
    let place = |at: [i64; 3]| {
        let [x, y, z] = at.map(|i| i as f64 / division as f64);
        [x * (1.0 - 0.3 * (z - 1.0).max(0.0)), y, z * (1.0 - 0.15 * (x - 2.0).max(0.0))]
    };
    let (mut numbers, mut points, mut faces) = (HashMap::new(), Vec::new(), Vec::new());
    let mut number = |at: [i64; 3]| {
        *numbers.entry(at).or_insert_with(|| {
            points.push(place(at));
            points.len() as u32 - 1
        })
    };
    let columns = (0..2 * n).flat_map(|k| (0..2 * n).map(move |j| [j, k]));
    let cells = columns.flat_map(|[j, k]| (0..4 * n).map(move |i| [i, j, k]));
    for square in cells.filter(|&cell| is_solid(cell)).flat_map(|cell| outside(cell, is_solid)) {
        faces.extend(halves(square, place).map(|face| face.map(&mut number)));
    }
    let mesh = built(points, faces);
    let sharp_edges = sharp_edges(&mesh);
    Block { mesh, sharp_edges }
}

/// The sides of a cell that no other cell covers, counter-clockwise from outside.
fn outside(cell: [i64; 3], is_solid: impl Fn([i64; 3]) -> bool) -> Vec<[[i64; 3]; 4]> {
    let mut squares = Vec::new();
    for (axis, up) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
        let (mut beyond, mut low) = (cell, cell);
        beyond[axis] += 2 * up - 1;
        low[axis] += up;
        if !is_solid(beyond) {
            let [u, w] = [(axis + 1) % 3, (axis + 2) % 3];
            let [a, b, c, d] = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[along, across]| {
                let mut corner = low;
                corner[u] += along;
                corner[w] += across;
                corner
            });
            squares.push(if up == 1 { [a, b, c, d] } else { [a, d, c, b] });
        }
    }
    squares
}

/// A square cut along its shorter diagonal.
fn halves([a, b, c, d]: [[i64; 3]; 4], place: impl Fn([i64; 3]) -> [f64; 3]) -> [[[i64; 3]; 3]; 2] {
    let long = |a, b| distance(place(a), place(b));
    if long(a, c) <= long(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
}

/// The edges at which the normal turns by more than a twentieth of a right angle.
fn sharp_edges(mesh: &TriMesh) -> Vec<[u32; 2]> {
    let normal = |face: u32| {
        let [a, b, c] = mesh.corners(face as usize);
        unit(cross(subtract(b, a), subtract(c, a)))
    };
    let adjacency = mesh.adjacency();
    let is_sharp = |edge: &usize| {
        let normals: Vec<_> = adjacency.edge_faces().of(*edge).iter().map(|&f| normal(f)).collect();
        dot(normals[0], normals[1]) < 0.997
    };
    (0..adjacency.edges().len()).filter(is_sharp).map(|edge| adjacency.edges()[edge]).collect()
}

fn built(points: Vec<[f64; 3]>, faces: Vec<[u32; 3]>) -> TriMesh {
    TriMesh::new(points, faces).unwrap_or_else(|error| panic!("this shape is no mesh: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sphere_is_closed_and_round() {
        let sphere = icosphere(3);
        assert_eq!(sphere.points().len(), 642);
        assert_eq!(sphere.faces().len(), 1280);
        assert!(sphere.points().iter().all(|&point| (length(point) - 1.0).abs() < 1e-15));
        assert!((0..1920).all(|edge| sphere.adjacency().edge_faces().of(edge).len() == 2));
    }

    #[test]
    fn the_torus_is_closed() {
        let torus = torus(2.0, 1.0, 16, 8);
        assert_eq!(torus.adjacency().edges().len(), 3 * 128);
        assert!((0..384).all(|edge| torus.adjacency().edge_faces().of(edge).len() == 2));
    }

    #[test]
    fn the_block_is_closed_and_has_its_edges() {
        let Block { mesh, sharp_edges } = block(4);
        let [points, edges, faces] =
            [mesh.points().len(), mesh.adjacency().edges().len(), mesh.faces().len()];
        assert_eq!(faces, 72 * 16);
        assert_eq!(points + faces, edges + 2, "genus 0");
        assert!((0..edges).all(|edge| mesh.adjacency().edge_faces().of(edge).len() == 2));
        let volume: f64 = (0..faces)
            .map(|face| mesh.corners(face))
            .map(|[a, b, c]| dot(a, cross(b, c)) / 6.0)
            .sum();
        // Twice the area of a rectangle and two trapezoids.
        assert!((volume - 2.0 * (2.0 + 1.7 + 1.7)).abs() < 1e-12, "{volume}");
        // The profile's six edges run through, and its six sides are there twice.
        assert_eq!(sharp_edges.len(), 6 * 8 + 2 * (16 + 4 + 8 + 4 + 8 + 8));
        assert_eq!(72 * BLOCK_DIVISION * BLOCK_DIVISION, 56_448);
    }
}
