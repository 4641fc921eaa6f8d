//! Paths made locally shortest.

use super::fan::shorter_around;
use super::strip::Strip;
use super::{Path, length};
use crate::mesh::spot::Spot;
use crate::mesh::{PointError, SurfacePoint, TriMesh};
use std::ops::Range;
use thiserror::Error;

/// Why points are no path.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ChainError {
    /// There is none, or one is not on the mesh.
    #[error(transparent)]
    Point(#[from] PointError),
    /// Two neighbours lie on no common face.
    #[error("points {number} and {} lie on no common face (counted from 0)", .number + 1)]
    Gap {
        /// The first of them.
        number: usize,
    },
}

/// A path or loop must become shorter by this part of its length, or it is as short as it gets.
const LEAST_GAIN: f64 = 1e-14;

/// Loops that came to this part of their length are points.
const POINT: f64 = 1e-9;

/// A loop is turned to another beginning at most so often.
const MOST_TURNS: usize = 1000;

/// The path made locally shortest on the surface, its two ends fixed: a geodesic, straight across
/// each edge, with at least half a turn on both sides of each vertex that it passes.
///
/// The faces along the path are laid out in the plane, where the shortest way through them is found
/// (Lee and Preparata 1984); where that touches a vertex around which another way is shorter, because
/// the angle on that side is below pi, the faces on that side take the place of the others
/// (Xin and Wang 2007). Each round makes the path shorter, until nothing does. Lengths are
/// those in space, whatever the slowness that led to the path. A path stays on its side of handles
/// and holes: there may be a shorter one elsewhere.
///
/// # Errors
/// A point is not on the mesh, or two neighbours do not share a face.
pub fn shorten(mesh: &TriMesh, path: &Path) -> Result<Path, ChainError> {
    let spots = spots(mesh, &path.points)?;
    let mut points: Vec<SurfacePoint> =
        shortest(mesh, spots).iter().map(|spot| spot.point(mesh)).collect();
    let last = points.len() - 1;
    (points[0], points[last]) = (path.points[0], path.points[path.points.len() - 1]);
    let shorter = Path::new(mesh, points, path.ending, path.distance);
    Ok(if shorter.length < path.length { shorter } else { path.clone() })
}

/// A closed curve made locally shortest: a closed geodesic, or none if it contracts to a point. The
/// last point is joined to the first, in the argument as in the result.
///
/// The curve is shortened as a path from one of its points back to it, again and again from a point
/// half a turn on (Birkhoff 1917).
///
/// # Errors
/// A point is not on the mesh, or two neighbours do not share a face.
pub fn shorten_loop(
    mesh: &TriMesh,
    points: &[SurfacePoint],
) -> Result<Option<Vec<SurfacePoint>>, ChainError> {
    let closed: Vec<SurfacePoint> = points.iter().chain(points.first()).copied().collect();
    let mut spots = spots(mesh, &closed)?;
    let start = spots_length(mesh, &spots);
    let (mut last, mut idle) = (start, 0);
    for _ in 0..MOST_TURNS {
        spots = shortest(mesh, spots);
        let now = spots_length(mesh, &spots);
        if spots.len() < 3 || now <= POINT * start {
            return Ok(None);
        }
        // Both halves must have had their turn.
        idle = if now < last * (1.0 - LEAST_GAIN) { 0 } else { idle + 1 };
        if idle == 2 {
            break;
        }
        last = now;
        spots = turned(mesh, spots);
    }
    spots.pop();
    Ok(Some(spots.iter().map(|spot| spot.point(mesh)).collect()))
}

/// A closed chain, its first spot repeated at its end, that begins half its length further on.
fn turned(mesh: &TriMesh, mut spots: Vec<Spot>) -> Vec<Spot> {
    let half = 0.5 * spots_length(mesh, &spots);
    let part = |&end: &usize| spots_length(mesh, &spots[..=end]);
    let inner = 1..spots.len() - 1;
    let nearest = inner.min_by(|a, b| (part(a) - half).abs().total_cmp(&(part(b) - half).abs()));
    spots.pop();
    spots.rotate_left(nearest.unwrap_or(0));
    spots.push(spots[0]);
    spots
}

fn spots(mesh: &TriMesh, points: &[SurfacePoint]) -> Result<Vec<Spot>, ChainError> {
    mesh.check_points("path", points.iter().copied())?;
    let spots: Vec<Spot> = points.iter().map(|point| Spot::of(mesh, point)).collect();
    let is_gap = |pair: &[Spot]| pair[0].shared_face(&pair[1], mesh).is_none();
    match spots.windows(2).position(is_gap) {
        Some(number) => Err(ChainError::Gap { number }),
        None => Ok(spots),
    }
}

fn spots_length(mesh: &TriMesh, spots: &[Spot]) -> f64 {
    let place = |spot: &Spot| mesh.position(&spot.point(mesh));
    length(&spots.iter().map(place).collect::<Vec<_>>())
}

/// The locally shortest way that a chain of spots contracts to.
fn shortest(mesh: &TriMesh, spots: Vec<Spot>) -> Vec<Spot> {
    let mut best = straightened(mesh, spots);
    while let Some(shorter) = shorter(mesh, &best) {
        best = shorter;
    }
    best
}

/// The chain led around all vertices where that is shorter; or, as flat faces may deceive, around the
/// first of them where it is; or straightened once more; or none.
fn shorter(mesh: &TriMesh, spots: &[Spot]) -> Option<Vec<Spot>> {
    let most = spots_length(mesh, spots) * (1.0 - LEAST_GAIN);
    let gain = |chain: Vec<Spot>| {
        let chain = straightened(mesh, chain);
        (spots_length(mesh, &chain) < most).then_some(chain)
    };
    let one = |number: usize| rerouted(mesh, spots, number..number + 1).and_then(gain);
    let led_around = rerouted(mesh, spots, 0..spots.len())
        .and_then(|all| gain(all).or_else(|| (1..spots.len()).find_map(one)));
    led_around.or_else(|| gain(spots.to_vec()))
}

/// The chain led around those of some spots that are vertices with a shorter way around them, or none
/// if there is no such. Of two vertices side by side only one is left at a time.
fn rerouted(mesh: &TriMesh, spots: &[Spot], some: Range<usize>) -> Option<Vec<Spot>> {
    let mut chain = vec![spots[0]];
    let (mut is_new, mut left) = (false, false);
    for (before, three) in spots.windows(3).enumerate() {
        let around = match three[1] {
            Spot::Vertex(vertex) if !left && some.contains(&(before + 1)) => {
                shorter_around(mesh, &three[0], vertex, &three[2])
            }
            _ => None,
        };
        left = around.is_some();
        is_new |= left;
        match around {
            Some(edges) => chain.extend(edges.iter().map(|&edge| Spot::Edge { edge, part: 0.5 })),
            None => chain.push(three[1]),
        }
    }
    chain.push(spots[spots.len() - 1]);
    is_new.then_some(chain)
}

/// The shortest chain through the same faces: straight between the vertices that it bends at.
fn straightened(mesh: &TriMesh, spots: Vec<Spot>) -> Vec<Spot> {
    let spots = tidied(mesh, spots);
    let mut chain = vec![spots[0]];
    let mut edges = Vec::new();
    let mut from = spots[0];
    for (number, spot) in spots.iter().enumerate().skip(1) {
        match *spot {
            Spot::Edge { edge, .. } if number + 1 < spots.len() => edges.push(edge),
            to => {
                if !edges.is_empty() {
                    chain.extend(Strip::new(mesh, &from, &edges, &to).shortest());
                    edges.clear();
                }
                chain.push(to);
                from = to;
            }
        }
    }
    tidied(mesh, chain)
}

/// The chain without the spots that share a face with both their neighbours: straight across it is
/// never longer.
fn tidied(mesh: &TriMesh, spots: Vec<Spot>) -> Vec<Spot> {
    let mut chain: Vec<Spot> = Vec::with_capacity(spots.len());
    for spot in spots {
        while let [.., before, between] = chain[..]
            && has_common_face(mesh, [&before, &between, &spot])
        {
            chain.pop();
        }
        chain.push(spot);
    }
    chain
}

fn has_common_face(mesh: &TriMesh, [a, b, c]: [&Spot; 3]) -> bool {
    let on = |spot: &Spot, face: &u32| spot.faces(mesh).binary_search(face).is_ok();
    b.faces(mesh).iter().any(|face| on(a, face) && on(c, face))
}
