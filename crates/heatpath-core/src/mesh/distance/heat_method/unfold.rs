//! Straight lines from a source, by unfolding the faces around it into the plane.

use crate::mesh::plane::{Vector2, corners, cross, length, minus, weighted};
use crate::mesh::triangle::third_corner;
use crate::mesh::{Medium, Source};
use std::collections::BTreeMap;

/// Lines are followed through so many faces.
const DEPTH: usize = 10;

/// The distances of the vertices that straight lines from `source` reach within a few faces, the
/// source's offset included, but for those that ways along edges reach sooner. Exact where the slowness
/// is the same all around; else it is taken as the mean of both ends.
pub(super) fn visible(medium: &Medium, source: &Source) -> BTreeMap<u32, f64> {
    let adjacency = medium.mesh().adjacency();
    let shares = medium.mesh().shares(&source.point);
    let faces: Vec<u32> = match shares[..] {
        [(vertex, _)] => adjacency.vertex_faces().of(vertex as usize).to_vec(),
        [(a, _), (b, _)] => match adjacency.edge_between(a, b) {
            Some(edge) => adjacency.edge_faces().of(edge as usize).to_vec(),
            None => vec![source.point.face],
        },
        _ => vec![source.point.face],
    };
    let slowness = medium.slowness()[source.point.face as usize];
    let mut unfolding = Unfolding { medium, source, slowness, found: BTreeMap::new() };
    faces.into_iter().for_each(|face| unfolding.start(face, &shares));
    let sooner = along_edges(medium, &unfolding.found);
    let is_corner = |vertex: u32| shares.iter().any(|&(corner, _)| corner == vertex);
    unfolding.found.retain(|&vertex, distance| {
        let is_straight = *distance <= sooner[&vertex] * (1.0 + 1e-9);
        *distance = distance.min(sooner[&vertex]);
        is_straight || is_corner(vertex)
    });
    unfolding.found
}

/// The distances of the same vertices if ways along edges between them count too.
fn along_edges(medium: &Medium, found: &BTreeMap<u32, f64>) -> BTreeMap<u32, f64> {
    let adjacency = medium.mesh().adjacency();
    let cost = |edge: u32| {
        let faces = adjacency.edge_faces().of(edge as usize).iter();
        let slowness = faces.map(|&face| medium.slowness()[face as usize]);
        medium.lengths()[edge as usize] * slowness.fold(f64::INFINITY, f64::min)
    };
    let mut distances = found.clone();
    let mut changed: Vec<u32> = found.keys().copied().collect();
    while let Some(vertex) = changed.pop() {
        let here = distances[&vertex];
        for &edge in adjacency.vertex_edges().of(vertex as usize) {
            let other = adjacency.other_end(edge, vertex);
            let by = here + cost(edge);
            if let Some(there) = distances.get_mut(&other)
                && by < *there * (1.0 - 1e-12)
            {
                *there = by;
                changed.push(other);
            }
        }
    }
    distances
}

struct Unfolding<'a> {
    medium: &'a Medium,
    source: &'a Source,
    /// That of the source's face.
    slowness: f64,
    found: BTreeMap<u32, f64>,
}

/// A part of an edge that lines from the source cross.
struct Window {
    /// The face that they leave, and the edge.
    face: u32,
    edge: u32,
    /// The ends of the edge with their vertices.
    ends: [(u32, Vector2); 2],
    /// The outermost lines, through the first and the second end or nearer.
    lines: [Vector2; 2],
}

impl Unfolding<'_> {
    /// Begins with a face that the source, with these shares of its vertices, lies on.
    fn start(&mut self, face: u32, shares: &[(u32, f64)]) {
        let vertices = self.medium.mesh().faces()[face as usize];
        let share = |vertex| shares.iter().find(|&&(v, _)| v == vertex).map_or(0.0, |&(_, w)| w);
        let weights = vertices.map(share);
        let sides = self.medium.sides(face as usize);
        let corners = corners(sides);
        let origin = weighted(corners, weights);
        let places = corners.map(|corner| minus(corner, origin));
        for i in 0..3 {
            self.see(vertices[i], places[i], face);
        }
        // Lines leave through the sides that the source does not lie on.
        for i in (0..3).filter(|&i| weights[i] > 0.0) {
            let [a, b] = [(i + 1) % 3, (i + 2) % 3];
            let edge = self.medium.mesh().adjacency().face_edges()[face as usize][i];
            let ends = [(vertices[a], places[a]), (vertices[b], places[b])];
            self.go_on(&Window { face, edge, ends, lines: [places[a], places[b]] }, DEPTH);
        }
    }

    /// Goes on behind an edge.
    fn go_on(&mut self, window: &Window, depth: usize) {
        if depth == 0 {
            return;
        }
        let adjacency = self.medium.mesh().adjacency();
        for &face in adjacency.edge_faces().of(window.edge as usize) {
            if face == window.face {
                continue;
            }
            let [a, b] = window.ends;
            let edges = adjacency.face_edges()[face as usize];
            let Some(i) = edges.iter().position(|&edge| edge == window.edge) else { continue };
            let vertices = self.medium.mesh().faces()[face as usize];
            let apex = (vertices[i], self.apex(face, i, a, b));
            // Counter-clockwise, the first line comes before the second.
            let is_right = cross(window.lines[0], apex.1) <= 0.0;
            let is_left = cross(apex.1, window.lines[1]) <= 0.0;
            if !is_right && !is_left {
                self.see(apex.0, apex.1, face);
            }
            let edge_at = |vertex: u32| {
                let corner = vertices.iter().position(|&other| other == vertex);
                edges[corner.unwrap_or(i)]
            };
            if !is_right {
                let line = if is_left { window.lines[1] } else { apex.1 };
                let (edge, ends) = (edge_at(b.0), [a, apex]);
                self.go_on(&Window { face, edge, ends, lines: [window.lines[0], line] }, depth - 1);
            }
            if !is_left {
                let line = if is_right { window.lines[0] } else { apex.1 };
                let (edge, ends) = (edge_at(a.0), [apex, b]);
                self.go_on(&Window { face, edge, ends, lines: [line, window.lines[1]] }, depth - 1);
            }
        }
    }

    /// Where the corner i of a face lies, beyond its side from `a` to `b`.
    fn apex(&self, face: u32, i: usize, a: (u32, Vector2), b: (u32, Vector2)) -> Vector2 {
        let vertices = self.medium.mesh().faces()[face as usize];
        let sides = self.medium.sides(face as usize);
        let side_at = |vertex: u32| sides[vertices.iter().position(|&v| v == vertex).unwrap_or(i)];
        let [x, y] = third_corner([side_at(a.0), side_at(b.0), sides[i]]);
        let along = [(b.1[0] - a.1[0]) / sides[i], (b.1[1] - a.1[1]) / sides[i]];
        // The source lies on the left of the way from a to b, the apex on the right.
        [a.1[0] + x * along[0] + y * along[1], a.1[1] + x * along[1] - y * along[0]]
    }

    fn see(&mut self, vertex: u32, place: Vector2, face: u32) {
        let slowness = 0.5 * (self.slowness + self.medium.slowness()[face as usize]);
        let distance = self.source.offset + slowness * length(place);
        let known = self.found.entry(vertex).or_insert(f64::INFINITY);
        *known = known.min(distance);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::sheet;
    use crate::mesh::vector::distance;
    use crate::mesh::{SurfacePoint, TriMesh};

    fn source(point: SurfacePoint) -> Source {
        Source { point, offset: 0.0, label: 0 }
    }

    #[test]
    fn lines_in_the_plane_bend_at_no_edge() {
        let mesh = sheet(8, 8, |x, y| [x as f64 + 0.3 * y as f64, 0.8 * y as f64, 0.0]);
        let medium = Medium::uniform(mesh.clone()).unwrap();
        for weights in [[1.0, 0.0, 0.0], [0.0, 0.6, 0.4], [0.2, 0.5, 0.3]] {
            let point = SurfacePoint { face: 71, weights };
            let found = visible(&medium, &source(point));
            assert!(found.len() > 20, "{}", found.len());
            for (vertex, length) in found {
                let right = distance(mesh.position(&point), mesh.points()[vertex as usize]);
                assert!((length - right).abs() < 1e-12, "{vertex}: {length} for {right}");
            }
        }
    }

    #[test]
    fn around_the_edge_of_a_cube() {
        // Two squares at a right angle, each cut in two.
        let points = vec![
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
        ];
        let faces = vec![[0, 2, 3], [0, 3, 1], [0, 1, 5], [0, 5, 4]];
        let mesh = TriMesh::new(points, faces).unwrap();
        let point = mesh.at_vertex("source", 0, 2).unwrap();
        let found = visible(&Medium::uniform(mesh).unwrap(), &source(point));
        assert!((found[&5] - 5.0_f64.sqrt()).abs() < 1e-15, "{}", found[&5]);
        assert!(found.get(&4).is_none_or(|length| (length - 2.0).abs() < 1e-15));
    }
}
