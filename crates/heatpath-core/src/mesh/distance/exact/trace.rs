//! Distances and paths at any point, from the windows.

use super::place::Place;
use super::propagation::Propagation;
use super::reached::{Origin, Reached};
use super::window::{NONE, Window, hypotenuse};
use super::{DistanceMap, Exact, NO_LABEL, NOT_REACHED, base};
use crate::mesh::path::{Ending, Path};
use crate::mesh::{Lists, PointError, Source, Sources, SurfacePoint};

/// Exact distances with their windows: gives the distance and the shortest path at any point of the
/// surface.
#[derive(Clone, Debug)]
pub struct ExactPaths<'a> {
    exact: &'a Exact,
    sources: Vec<Source>,
    /// The sources inside faces and edges with their numbers, by face.
    places: Vec<(Place, u32)>,
    vertices: Vec<Reached>,
    windows: Vec<Window>,
    /// The windows through which paths enter a face across each side.
    at_side: Lists,
    map: DistanceMap,
    farthest: f64,
}

/// The last part of a path: what lies before a point.
#[derive(Clone, Copy, Debug)]
enum Before {
    /// This source, on the same face.
    Source(u32),
    /// This corner of the face.
    Vertex(u32),
    /// This window, crossed so far from the first end of its side.
    Window(u32, f64),
}

impl<'a> ExactPaths<'a> {
    pub(super) fn new(
        exact: &'a Exact,
        sources: &Sources,
        propagation: Propagation<'_>,
        map: DistanceMap,
        farthest: f64,
    ) -> Self {
        let Propagation { vertices, windows, .. } = propagation;
        let at_side = Lists::new(exact.sides.len(), || {
            let used = windows.iter().zip(0..).filter(|(window, _)| window.side != NONE);
            used.map(|(window, number)| (window.side, number))
        });
        let sources = sources.list().to_vec();
        let mut places = Vec::new();
        for (source, number) in sources.iter().zip(0..) {
            let here = Place::new(&source.point).all(&exact.mesh);
            places.extend(here.into_iter().map(|place| (place, number)));
        }
        places.sort_by_key(|&(place, number)| (place.face, number));
        Self { exact, sources, places, vertices, windows, at_side, map, farthest }
    }

    /// The distance of each vertex.
    #[must_use]
    pub fn map(&self) -> &DistanceMap {
        &self.map
    }

    /// The number of windows.
    #[must_use]
    pub fn windows(&self) -> usize {
        self.windows.iter().filter(|window| window.side != NONE).count()
    }

    /// The distance at a point of the surface, [`NOT_REACHED`] where there is none.
    ///
    /// Unlike [`DistanceMap::at`] this is exact inside faces and edges too: the shortest of the
    /// straight lines to the corners, to sources on the same face, and through the windows of the
    /// three sides.
    ///
    /// # Errors
    /// The point, called end 0, is not on the mesh.
    pub fn distance_at(&self, point: &SurfacePoint) -> Result<f64, PointError> {
        self.exact.mesh.check_points("end", [*point])?;
        Ok(self.outside(self.nearest(&Place::new(point)).0))
    }

    /// The label of the source nearest to a point of the surface, [`NO_LABEL`] where there is none.
    ///
    /// # Errors
    /// The point, called end 0, is not on the mesh.
    pub fn label_at(&self, point: &SurfacePoint) -> Result<u32, PointError> {
        Ok(match self.path(point)?.ending {
            Ending::Source(label) => label,
            Ending::Unreachable | Ending::Stuck => NO_LABEL,
        })
    }

    /// The shortest path from a point of the surface to its source: straight inside faces and across
    /// edges, bent at vertices alone.
    ///
    /// Where there are several, any of them. Points farther than [`farthest`](super::ExactOptions::farthest)
    /// are unreachable.
    ///
    /// # Errors
    /// The point, called end 0, is not on the mesh.
    pub fn path(&self, end: &SurfacePoint) -> Result<Path, PointError> {
        let mesh = &self.exact.mesh;
        mesh.check_points("end", [*end])?;
        let (distance, mut before) = self.nearest(&Place::new(end));
        let (distance, mut points) = (self.outside(distance), vec![*end]);
        if distance == NOT_REACHED {
            return Ok(Path::new(mesh, points, Ending::Unreachable, distance));
        }
        let source = loop {
            let next = match before {
                Before::Source(source) => break source,
                Before::Vertex(vertex) => Place::at_apex(self.exact.sides.opposite(vertex)[0]),
                Before::Window(number, at) => {
                    Place::on_side(&self.exact.sides, self.windows[number as usize].from, at)
                }
            };
            let next = SurfacePoint { face: next.face, weights: next.weights };
            if !points.last().is_some_and(|last| self.is_same(last, &next)) {
                points.push(next);
            }
            before = self.before(before);
        };
        let Source { point, label, .. } = self.sources[source as usize];
        points.pop_if(|last| self.is_same(last, &point));
        points.push(point);
        Ok(Path::new(mesh, points, Ending::Source(label), distance))
    }

    /// Whether two points are the same vertex, or the same by face and weights.
    fn is_same(&self, a: &SurfacePoint, b: &SurfacePoint) -> bool {
        let vertex = |point: &SurfacePoint| Place::new(point).vertex(&self.exact.sides);
        a == b || vertex(a).is_some_and(|a| vertex(b) == Some(a))
    }

    /// A distance in the units of the caller.
    fn outside(&self, distance: f64) -> f64 {
        let value = base(&self.sources) + distance * self.exact.unit;
        if value <= self.farthest && distance.is_finite() { value } else { NOT_REACHED }
    }

    /// The distance of a place, and what its path comes from.
    fn nearest(&self, place: &Place) -> (f64, Before) {
        let sides = &self.exact.sides;
        let mut nearest = (f64::INFINITY, Before::Source(NONE));
        let mut consider = |distance: f64, before: Before| {
            if distance < nearest.0 {
                nearest = (distance, before);
            }
        };
        for side in place.sides() {
            let (at, [x, y]) = (sides.get(side), place.seen_from(sides, side));
            let corner = self.vertices[at.vertex as usize].distance;
            let to_corner = hypotenuse(at.apex[0] - x, at.apex[1] - y);
            consider(corner + to_corner, Before::Vertex(at.vertex));
            for &number in self.at_side.of(side as usize) {
                let window = &self.windows[number as usize];
                let at = crossing(window, [x, y]);
                let distance = window.to(at) + hypotenuse(x - at, y);
                consider(distance, Before::Window(number, at));
            }
        }
        let first = self.places.partition_point(|(other, _)| other.face < place.face);
        for (other, source) in &self.places[first..] {
            if other.face != place.face {
                break;
            }
            let side = 3 * place.face;
            let (a, b) = (place.seen_from(sides, side), other.seen_from(sides, side));
            let offset =
                (self.sources[*source as usize].offset - base(&self.sources)) / self.exact.unit;
            consider(offset + hypotenuse(a[0] - b[0], a[1] - b[1]), Before::Source(*source));
        }
        nearest
    }

    /// What comes before a vertex or a window.
    fn before(&self, here: Before) -> Before {
        match here {
            Before::Source(_) => here,
            Before::Vertex(vertex) => match self.vertices[vertex as usize].origin {
                Origin::Source(source) => Before::Source(source),
                Origin::Vertex(other) => Before::Vertex(other),
                Origin::Window(number) => {
                    let window = &self.windows[number as usize];
                    let apex = self.exact.sides.get(window.side).apex;
                    Before::Window(number, crossing(window, apex))
                }
                Origin::Nowhere => Before::Source(NONE),
            },
            Before::Window(number, at) => self.before_window(&self.windows[number as usize], at),
        }
    }

    fn before_window(&self, window: &Window, at: f64) -> Before {
        let vertices = self.vertices.len() as u32;
        if window.parent == NONE {
            return match window.root.checked_sub(vertices) {
                Some(source) => Before::Source(source),
                None => Before::Vertex(window.root),
            };
        }
        let sides = &self.exact.sides;
        let parent = &self.windows[window.parent as usize];
        let point = Place::on_side(sides, window.from, at).seen_from(sides, parent.side);
        Before::Window(window.parent, crossing(parent, point))
    }
}

/// Where a path to a point above the side crosses a window.
fn crossing(window: &Window, point: [f64; 2]) -> f64 {
    window.crossing(point).clamp(window.span[0], window.span[1])
}
