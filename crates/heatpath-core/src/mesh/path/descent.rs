//! Down the distance, face by face.

use super::{Ending, Path, ValuesError, check_values};
use crate::lists::Lists;
use crate::mesh::distance::NOT_REACHED;
use crate::mesh::plane::{self, corners, gradient, weight_rates};
use crate::mesh::spot::{Spot, cost};
use crate::mesh::{Medium, PointError, Source, Sources, SurfacePoint, TriMesh};
use std::collections::{BTreeMap, BTreeSet};
use std::iter;

/// The descent of a distance to its sources: traces any number of paths.
///
/// Between the vertices the distance is linear on each face, and a path goes against its gradient,
/// in the metric of the medium: straight across a face, along an edge into which both sides lead
/// (a valley), and from a vertex into the face or along the edge of the steepest descent per cost.
/// On a face with a source it goes straight there.
///
/// Each step ends lower than it began, so that every path ends. Where a face leads nowhere, as a
/// flat one, the next step is to the lowest corner around; and from a vertex lower than all around
/// it, which a distance has beside obtuse corners, along edges to the nearest that is lower still.
///
/// ```
/// use heatpath_core::mesh::path::{Descent, Ending};
/// use heatpath_core::mesh::{Medium, Sources, shapes};
///
/// let sheet = shapes::sheet(8, 8, |i, j| [i as f64, j as f64, 0.0]);
/// let distances: Vec<f64> = sheet.points().iter().map(|p| p[0].hypot(p[1])).collect();
/// let medium = Medium::uniform(sheet)?;
/// let sources = Sources::at_vertices(medium.mesh(), &[0])?;
/// let descent = Descent::new(&medium, &distances, &sources)?;
/// let path = descent.path(medium.mesh().at_vertex("end", 0, 80)?)?;
/// assert_eq!(path.ending, Ending::Source(0));
/// assert!((path.length - 128.0_f64.sqrt()).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Descent<'a> {
    medium: &'a Medium,
    values: &'a [f64],
    sources: &'a Sources,
    /// The numbers of the sources on each face, but for those that lie nearer to others.
    near: Lists,
}

/// A path goes straight to a source on its face if the distance is at least this part of the cost of
/// that; otherwise there is a cheaper way around.
const PLAUSIBLE: f64 = 0.75;

/// A place to go, and how fast the distance falls on the way there.
type Step = (f64, Spot);

impl<'a> Descent<'a> {
    /// Prepares the descent of the values of a [`DistanceMap`](crate::mesh::distance::DistanceMap)
    /// from `sources` in `medium`, or of any other function of the vertices that falls towards
    /// sources.
    ///
    /// # Errors
    /// There is not one value for each vertex, or one is neither finite nor positive infinity.
    pub fn new(
        medium: &'a Medium,
        values: &'a [f64],
        sources: &'a Sources,
    ) -> Result<Self, ValuesError> {
        let mesh = medium.mesh();
        check_values(mesh, values)?;
        let spots: Vec<Spot> =
            sources.list().iter().map(|source| Spot::of(mesh, &source.point)).collect();
        let pairs = || {
            let is_heard = |&(number, spot): &(usize, &Spot)| {
                sources.list()[number].offset <= spot.value(mesh, values)
            };
            let faces = |(number, spot): (usize, &'_ Spot)| {
                spot.faces(mesh).to_vec().into_iter().map(move |face| (face, number as u32))
            };
            spots.iter().enumerate().filter(is_heard).flat_map(faces)
        };
        let near = Lists::new(mesh.faces().len(), pairs);
        Ok(Self { medium, values, sources, near })
    }

    /// Traces the path from `end` to a source.
    ///
    /// # Errors
    /// The end is not on the mesh. A path that does not reach a source is no error: its [`Ending`]
    /// says why.
    pub fn path(&self, end: SurfacePoint) -> Result<Path, PointError> {
        let mesh = self.mesh();
        mesh.check_points("end", [end])?;
        let (spots, ending, source) = self.trace(Spot::of(mesh, &end));
        let mut points: Vec<SurfacePoint> = spots.iter().map(|spot| spot.point(mesh)).collect();
        points[0] = end;
        if let Some(source) = source {
            if spots.last() == Some(&Spot::of(mesh, &source.point)) {
                points.pop();
            }
            points.push(source.point);
        }
        let distance = if source.is_some() { self.distance(&spots[0]) } else { NOT_REACHED };
        Ok(Path::new(mesh, points, ending, distance))
    }

    fn mesh(&self) -> &'a TriMesh {
        self.medium.mesh()
    }

    fn value(&self, spot: &Spot) -> f64 {
        spot.value(self.mesh(), self.values)
    }

    /// The distance at a spot, also beside a source that lies inside its face.
    fn distance(&self, spot: &Spot) -> f64 {
        let direct = self.sources_near(spot).map(|(cost, _)| cost);
        direct.fold(self.value(spot), f64::min)
    }

    fn trace(&self, start: Spot) -> (Vec<Spot>, Ending, Option<&'a Source>) {
        let mut spots = vec![start];
        let steps = 4 * self.mesh().faces().len() + 64;
        loop {
            let here = spots[spots.len() - 1];
            let value = self.value(&here);
            if let Some(source) = self.arrival(&here, PLAUSIBLE) {
                return (spots, Ending::Source(source.label), Some(source));
            }
            if value == NOT_REACHED {
                return (spots, Ending::Unreachable, None);
            }
            // A spiral into a vertex may take too many steps; along edges there are few.
            let step = if spots.len() < steps { self.steepest(&here) } else { None };
            let step = step.filter(|next| self.value(next) < value);
            if let Some(next) = step.or_else(|| self.lowest_corner(&here)) {
                spots.push(next);
                continue;
            }
            if let Some(source) = self.arrival(&here, 0.0) {
                return (spots, Ending::Source(source.label), Some(source));
            }
            let way = self.way_out(&here);
            let Some(&beyond) = way.last() else { return (spots, Ending::Stuck, None) };
            spots.extend(way);
            // The lowest vertex of all may lie beside the face of a source.
            if self.value(&beyond) >= value
                && let Some(source) = self.arrival(&beyond, 0.0)
            {
                return (spots, Ending::Source(source.label), Some(source));
            }
        }
    }

    /// The sources on the faces of a spot, and the distance of each if the path goes straight there.
    fn sources_near(&self, here: &Spot) -> impl Iterator<Item = (f64, &'a Source)> {
        let on_face = |&face: &u32| {
            self.near.of(face as usize).iter().map(move |&number| {
                let source = &self.sources.list()[number as usize];
                (
                    source.offset
                        + cost(self.medium, face, here, &Spot::of(self.mesh(), &source.point)),
                    source,
                )
            })
        };
        here.faces(self.mesh()).iter().flat_map(on_face).collect::<Vec<_>>().into_iter()
    }

    /// The source to go to straight, if the distance here is at least the part `plausible` of what
    /// that costs.
    fn arrival(&self, here: &Spot, plausible: f64) -> Option<&'a Source> {
        let value = self.value(here);
        let fits = |(cost, source): &(f64, &Source)| {
            value - source.offset >= plausible * (cost - source.offset)
        };
        let nearest = self.sources_near(here).filter(fits).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, source)| source)
    }

    /// Where the steepest descent from a spot leads, if there is one.
    fn steepest(&self, here: &Spot) -> Option<Spot> {
        let across = here.faces(self.mesh()).iter().filter_map(|&face| self.across(face, here));
        let along = self.edges(here).iter().filter_map(|&edge| self.along(edge, here));
        let steepest = across.chain(along).max_by(|a, b| a.0.total_cmp(&b.0));
        steepest.map(|(_, spot)| spot)
    }

    /// The edges that a spot lies on.
    fn edges<'b>(&'b self, here: &'b Spot) -> &'b [u32] {
        match here {
            Spot::Vertex(vertex) => self.mesh().adjacency().vertex_edges().of(*vertex as usize),
            Spot::Edge { edge, .. } => std::slice::from_ref(edge),
            Spot::Face(_) => &[],
        }
    }

    /// The step along an edge to its lower end.
    fn along(&self, edge: u32, here: &Spot) -> Option<Step> {
        let value = |vertex: u32| self.values[vertex as usize];
        let [a, b] = self.mesh().adjacency().edges()[edge as usize];
        let [low, high] = if value(a) < value(b) { [a, b] } else { [b, a] };
        if Spot::Vertex(low) == *here || value(high) == NOT_REACHED {
            return None;
        }
        Some(((value(high) - value(low)) / self.edge_cost(edge), Spot::Vertex(low)))
    }

    /// The step across a face against the gradient, if that leads into the face.
    fn across(&self, face: u32, here: &Spot) -> Option<Step> {
        let mesh = self.mesh();
        let values = mesh.faces()[face as usize].map(|vertex| self.values[vertex as usize]);
        let layout = corners(self.medium.sides(face as usize));
        let slope = gradient(layout, values);
        let steepness = plane::length(slope);
        if !(steepness > 0.0 && steepness.is_finite()) {
            return None;
        }
        let weights = here.weights(mesh, face);
        let rates = weight_rates(layout, plane::times(slope, -1.0 / steepness));
        if (0..3).any(|i| weights[i] == 0.0 && rates[i] <= 0.0) {
            return None;
        }
        let length = |i: usize| -weights[i] / rates[i];
        let leaving = (0..3).filter(|&i| rates[i] < 0.0);
        let side = leaving.min_by(|&a, &b| length(a).total_cmp(&length(b)))?;
        let mut next: [f64; 3] =
            std::array::from_fn(|i| (weights[i] + length(side) * rates[i]).max(0.0));
        next[side] = 0.0;
        let sum: f64 = next.iter().sum();
        let point = SurfacePoint { face, weights: next.map(|weight| weight / sum) };
        Some((steepness / self.medium.slowness()[face as usize], Spot::of(mesh, &point)))
    }

    /// The lowest corner of the faces here, if it is lower, or if it is as low and the spot is no
    /// vertex.
    fn lowest_corner(&self, here: &Spot) -> Option<Spot> {
        let mesh = self.mesh();
        let value = |vertex: u32| self.values[vertex as usize];
        let corners = here.faces(mesh).iter().flat_map(|&face| mesh.faces()[face as usize]);
        let lowest = corners.min_by(|&a, &b| value(a).total_cmp(&value(b)).then(a.cmp(&b)))?;
        let is_lower = match here {
            Spot::Vertex(_) => value(lowest) < self.value(here),
            _ => value(lowest) <= self.value(here),
        };
        is_lower.then_some(Spot::Vertex(lowest))
    }

    /// The way along edges from a vertex to the nearest that is lower or beside a source (Dijkstra
    /// 1959), without the vertex itself; empty if there is none.
    fn way_out(&self, here: &Spot) -> Vec<Spot> {
        let &Spot::Vertex(start) = here else { return Vec::new() };
        let level = self.values[start as usize];
        let mut from = BTreeMap::from([(start, (0.0, start))]);
        let mut front = BTreeSet::from([(0, start)]);
        // Costs are not negative, so that their bits have their order.
        while let Some((cost, vertex)) = front.pop_first() {
            let cost = f64::from_bits(cost);
            let value = self.values[vertex as usize];
            let source = || self.arrival(&Spot::Vertex(vertex), 0.0);
            let is_source =
                || vertex != start && source().is_some_and(|source| source.offset <= level);
            if value < level || is_source() {
                let back = |&vertex: &u32| from.get(&vertex).map(|&(_, before)| before);
                let way = iter::successors(Some(vertex), back).take_while(|&v| v != start);
                let mut way: Vec<Spot> = way.map(Spot::Vertex).collect();
                way.reverse();
                return way;
            }
            for &edge in self.mesh().adjacency().vertex_edges().of(vertex as usize) {
                let next = self.mesh().adjacency().other_end(edge, vertex);
                let further = cost + self.edge_cost(edge);
                let old = from.get(&next).map_or(NOT_REACHED, |&(old, _)| old);
                if further < old {
                    front.remove(&(old.to_bits(), next));
                    front.insert((further.to_bits(), next));
                    from.insert(next, (further, vertex));
                }
            }
        }
        Vec::new()
    }

    /// What it costs to go along an edge, on the faster of its faces.
    fn edge_cost(&self, edge: u32) -> f64 {
        let faces = self.mesh().adjacency().edge_faces().of(edge as usize).iter();
        let slowness = faces.map(|&face| self.medium.slowness()[face as usize]);
        self.medium.lengths()[edge as usize] * slowness.fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{shapes, vector};

    /// Lengths are those of `5 dx^2 + 4 dx dy + dy^2`.
    #[test]
    fn paths_are_straight_in_a_metric_that_depends_on_direction() {
        let sheet = shapes::sheet(40, 40, |i, j| [i as f64, j as f64, 0.0]);
        let length = |a: [f64; 3], b: [f64; 3]| {
            let [x, y, _] = vector::subtract(a, b);
            (5.0 * x * x + 4.0 * x * y + y * y).sqrt()
        };
        let points = sheet.points().to_vec();
        let at = |vertex: u32| points[vertex as usize];
        let lengths = sheet.adjacency().edges().iter().map(|&[a, b]| length(at(a), at(b)));
        let (lengths, slowness) = (lengths.collect(), vec![1.0; sheet.faces().len()]);
        let values: Vec<f64> = points.iter().map(|&p| length(p, at(450))).collect();
        let medium = Medium::from_parts(sheet.into(), lengths, slowness).unwrap();
        let sources = Sources::at_vertices(medium.mesh(), &[450]).unwrap();
        let descent = Descent::new(&medium, &values, &sources).unwrap();
        for end in [0, 40, 1000, 1680, 1333] {
            let path = descent.path(medium.mesh().at_vertex("end", 0, end).unwrap()).unwrap();
            assert_eq!(path.ending, Ending::Source(0));
            let straight = vector::subtract(at(end), at(450));
            for position in path.positions {
                let aside = vector::cross(vector::subtract(position, at(450)), straight);
                let aside = vector::length(aside) / vector::length(straight);
                assert!(aside < 1.5, "from {end}: {aside} beside the straight line");
            }
        }
    }
}
