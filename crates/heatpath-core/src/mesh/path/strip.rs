//! The shortest way through a strip of faces.

use crate::mesh::plane::{Vector2, cross, length, minus, plus, times};
use crate::mesh::spot::Spot;
use crate::mesh::triangle::third_corner;
use crate::mesh::{TriMesh, vector};

/// Faces laid out in the plane one after the other, from a start in the first to a goal in the last.
#[derive(Debug)]
pub(super) struct Strip<'a> {
    mesh: &'a TriMesh,
    portals: Vec<Portal>,
    start: Vector2,
    goal: Vector2,
}

/// An edge between two faces of a strip, its left end first as seen from the start.
#[derive(Clone, Copy, Debug)]
struct Portal {
    edge: u32,
    ends: [u32; 2],
    places: [Vector2; 2],
}

/// An end of a portal: the number of the portal, and which end.
type Corner = (usize, usize);

impl<'a> Strip<'a> {
    /// The strip from one spot across `edges` to another; each shares a face with the next.
    pub(super) fn new(mesh: &'a TriMesh, from: &Spot, edges: &[u32], to: &Spot) -> Self {
        let spot = |&edge: &u32| Spot::Edge { edge, part: 0.5 };
        // === The first edge on the first axis, the start below it
        let ends = mesh.adjacency().edges()[edges[0] as usize];
        let places = [[0.0, 0.0], [edge_length(mesh, ends), 0.0]];
        let first = Portal { edge: edges[0], ends, places };
        let start = first.place(mesh, &spot(&edges[0]), from, -1.0).0;
        // === Each further face ahead of the edge before it
        let mut portals = vec![first];
        for pair in edges.windows(2) {
            let portal = portals[portals.len() - 1];
            let (_, third, apex) = portal.place(mesh, &spot(&pair[0]), &spot(&pair[1]), 1.0);
            let kept = mesh.adjacency().edges()[pair[1] as usize];
            let renewed = usize::from(kept.contains(&portal.ends[0]));
            let mut next = Portal { edge: pair[1], ..portal };
            (next.ends[renewed], next.places[renewed]) = (third, apex);
            portals.push(next);
        }
        let last = portals[portals.len() - 1];
        let goal = last.place(mesh, &spot(&last.edge), to, 1.0).0;
        Self { mesh, portals, start, goal }
    }

    /// The shortest way: where it crosses the portals, and the vertices at which it bends, without
    /// its ends.
    pub(super) fn shortest(&self) -> Vec<Spot> {
        let corners = self.corners();
        let mut spots = Vec::with_capacity(self.portals.len());
        let (mut from, mut next) = (self.start, 0);
        for &(portal, side) in &corners {
            let to = self.place((portal, side));
            spots.extend((next..portal).map(|k| self.crossing(k, from, to)));
            spots.push(Spot::Vertex(self.portals[portal].ends[side]));
            (from, next) = (to, portal + 1);
        }
        spots.extend((next..self.portals.len()).map(|k| self.crossing(k, from, self.goal)));
        spots
    }

    /// The corners at which the shortest way bends: the funnel of all straight ways from the last
    /// corner is narrowed portal by portal until it closes (Lee and Preparata 1984).
    fn corners(&self) -> Vec<Corner> {
        let (mut apex, mut found, mut next) = (self.start, Vec::new(), 1);
        let mut funnel = [(0, 0), (0, 1)];
        while next <= self.portals.len() {
            match self.narrow(apex, &mut funnel, next) {
                None => next += 1,
                // The goal is in sight.
                Some((portal, _)) if portal == self.portals.len() => break,
                Some(corner) => {
                    found.push(corner);
                    apex = self.place(corner);
                    funnel = [corner; 2];
                    next = corner.0 + 1;
                }
            }
        }
        found
    }

    /// Narrows the funnel by a portal, or finds the corner at which it closes.
    fn narrow(&self, apex: Vector2, funnel: &mut [Corner; 2], next: usize) -> Option<Corner> {
        for side in 0..2 {
            let inwards = if side == 0 { -1.0 } else { 1.0 };
            let to = minus(self.place((next, side)), apex);
            let turn = |corner: Corner| inwards * cross(minus(self.place(corner), apex), to);
            if turn(funnel[side]) < 0.0 {
                continue;
            }
            let other = funnel[1 - side];
            if self.place(funnel[side]) != apex && turn(other) >= 0.0 {
                return Some(other);
            }
            funnel[side] = (next, side);
        }
        None
    }

    /// Where an end of a portal lies; the goal is a portal too, the last one.
    fn place(&self, (portal, side): Corner) -> Vector2 {
        self.portals.get(portal).map_or(self.goal, |portal| portal.places[side])
    }

    /// Where a straight line crosses a portal; at an end of it if the line begins or ends there.
    fn crossing(&self, portal: usize, from: Vector2, to: Vector2) -> Spot {
        let Portal { edge, ends, places } = self.portals[portal];
        if let Some(end) = places.iter().position(|&place| place == from || place == to) {
            return Spot::Vertex(ends[end]);
        }
        let along = minus(to, from);
        let [left, right] = places.map(|place| cross(along, minus(place, from)));
        let part = (left / (left - right)).clamp(0.0, 1.0);
        let part = if part.is_nan() { 0.5 } else { part };
        let is_turned = ends != self.mesh.adjacency().edges()[edge as usize];
        Spot::on_edge(self.mesh, edge, if is_turned { 1.0 - part } else { part })
    }
}

impl Portal {
    /// Lays out the face between this portal (as a spot) and another spot, ahead (1) or behind (-1):
    /// where that spot lies, the third vertex of the face, and where that lies.
    fn place(&self, mesh: &TriMesh, own: &Spot, spot: &Spot, side: f64) -> (Vector2, u32, Vector2) {
        let face = own.shared_face(spot, mesh).unwrap_or(own.faces(mesh)[0]);
        let corners = mesh.faces()[face as usize];
        let third = corners.into_iter().find(|corner| !self.ends.contains(corner));
        let third = third.unwrap_or(corners[0]);
        let apex = self.apex(mesh, third, side);
        let places = corners.map(|corner| match corner {
            _ if corner == third => apex,
            _ if corner == self.ends[0] => self.places[0],
            _ => self.places[1],
        });
        (crate::mesh::plane::weighted(places, spot.weights(mesh, face)), third, apex)
    }

    fn apex(&self, mesh: &TriMesh, third: u32, side: f64) -> Vector2 {
        let [left, right] = self.ends;
        let base = edge_length(mesh, self.ends).max(f64::MIN_POSITIVE);
        let sides = [edge_length(mesh, [right, third]), edge_length(mesh, [left, third]), base];
        let [x, y] = third_corner(sides);
        let along = minus(self.places[1], self.places[0]);
        let along =
            if length(along) > 0.0 { times(along, 1.0 / length(along)) } else { [1.0, 0.0] };
        let ahead = times([-along[1], along[0]], side);
        plus(self.places[0], plus(times(along, x), times(ahead, y)))
    }
}

fn edge_length(mesh: &TriMesh, ends: [u32; 2]) -> f64 {
    let [a, b] = ends.map(|end| mesh.points()[end as usize]);
    vector::distance(a, b)
}
