//! Ways around a vertex.

use crate::mesh::spot::Spot;
use crate::mesh::{TriMesh, vector};
use std::collections::BTreeSet;
use std::f64::consts::PI;

/// A way around a vertex is shorter if its angle is less than half a turn by more than this.
const LEAST_BEND: f64 = 1e-7;

/// The edges that a shorter way than that over `vertex` crosses, if there is one: the smallest angle
/// between the ways to two spots beside the vertex, over the faces around it, is below pi.
pub(super) fn shorter_around(
    mesh: &TriMesh,
    before: &Spot,
    vertex: u32,
    after: &Spot,
) -> Option<Vec<u32>> {
    let edges = mesh.adjacency().vertex_edges().of(vertex as usize);
    let number = |edge: u32| edges.binary_search(&edge).unwrap_or(0);
    let mut angles = vec![(f64::INFINITY, None); edges.len()];
    let mut front = BTreeSet::new();
    for (edge, angle) in spokes_beside(mesh, vertex, before) {
        angles[number(edge)].0 = angle;
        front.insert((angle.to_bits(), edge));
    }
    // === The angle of each spoke (Dijkstra 1959)
    while let Some((angle, edge)) = front.pop_first() {
        for &face in mesh.adjacency().edge_faces().of(edge as usize) {
            let (next, more) = across(mesh, vertex, face, edge);
            let sum = f64::from_bits(angle) + more;
            let known = &mut angles[number(next)];
            if sum < known.0 {
                front.remove(&(known.0.to_bits(), next));
                *known = (sum, Some(edge));
                front.insert((sum.to_bits(), next));
            }
        }
    }
    // === The last spoke of the smallest angle, and those before it
    let whole = |&(edge, angle): &(u32, f64)| angles[number(edge)].0 + angle;
    let beside = spokes_beside(mesh, vertex, after);
    let last = beside.iter().min_by(|a, b| whole(a).total_cmp(&whole(b)))?;
    if whole(last) >= PI - LEAST_BEND {
        return None;
    }
    let back = |&edge: &u32| angles[number(edge)].1;
    let mut crossed: Vec<u32> = std::iter::successors(Some(last.0), back).collect();
    crossed.reverse();
    Some(crossed)
}

/// The edges from `vertex` that are sides of a face with the spot, and the angles between them and
/// the way to it.
fn spokes_beside(mesh: &TriMesh, vertex: u32, spot: &Spot) -> Vec<(u32, f64)> {
    let Some(face) = Spot::Vertex(vertex).shared_face(spot, mesh) else { return Vec::new() };
    let (corners, weights) = (mesh.faces()[face as usize], spot.weights(mesh, face));
    let edges = mesh.adjacency().face_edges()[face as usize];
    let place = |corner: u32| mesh.points()[corner as usize];
    let away = mesh.position(&crate::mesh::SurfacePoint { face, weights });
    let away = vector::subtract(away, place(vertex));
    let spokes = (0..3).filter(|&i| corners[i] != vertex).map(|i| {
        // The edge to corner i is opposite the third corner, on which all weight lies but for spots of
        // that edge.
        let third = 3 - i - corners.iter().position(|&c| c == vertex).unwrap_or(0);
        let angle = angle(vector::subtract(place(corners[i]), place(vertex)), away);
        (edges[third], if weights[third] == 0.0 { 0.0 } else { angle })
    });
    let spokes: Vec<(u32, f64)> = spokes.collect();
    match spokes.iter().position(|&(_, angle)| angle == 0.0) {
        Some(on) => vec![spokes[on]],
        None => spokes,
    }
}

/// The other edge from `vertex` of a face, and the angle between both.
fn across(mesh: &TriMesh, vertex: u32, face: u32, edge: u32) -> (u32, f64) {
    let corners = mesh.faces()[face as usize];
    let at = corners.iter().position(|&corner| corner == vertex).unwrap_or(0);
    let edges = mesh.adjacency().face_edges()[face as usize];
    let [a, b] = [(at + 1) % 3, (at + 2) % 3];
    let place = |i: usize| mesh.points()[corners[i] as usize];
    let [to_a, to_b] = [a, b].map(|i| vector::subtract(place(i), place(at)));
    (if edges[a] == edge { edges[b] } else { edges[a] }, angle(to_a, to_b))
}

/// The angle between two vectors; none between a vector and none.
fn angle(a: vector::Vector, b: vector::Vector) -> f64 {
    vector::length(vector::cross(a, b)).atan2(vector::dot(a, b))
}
