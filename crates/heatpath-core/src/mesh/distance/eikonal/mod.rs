//! The exact weighted distance: the eikonal equation, by fast marching.

mod front;
mod march;
mod surface;

use surface::{Chord, Surface};

use self::front::Arrival;
use self::march::march;
use super::{DistanceMap, NO_LABEL};
use crate::error::{ParameterError, check};
use crate::exec::{Cancelled, Exec};
use crate::mesh::spot::{Spot, cost};
use crate::mesh::{Medium, Sources, Triangulation};
use std::sync::Arc;
use thiserror::Error;

/// The parameters of [`Eikonal::distance`].
#[derive(Clone, Debug, PartialEq)]
pub struct EikonalOptions {
    /// The march ends at this distance; vertices beyond are not reached. Positive; default infinity.
    pub farthest: f64,
}

impl Default for EikonalOptions {
    fn default() -> Self {
        Self { farthest: f64::INFINITY }
    }
}

/// Why there is no distance.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EikonalError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The exact weighted distance in one medium: the viscosity solution of the eikonal equation
/// `|grad T| = slowness`, prepared for any sources.
///
/// Heat measures the same metric, but in media that vary its readouts differ from the distance by
/// several per cent; and for a single source this is faster. It is fast marching on triangles
/// (Kimmel and Sethian 1998), and more:
///
/// - *Fronts are round.* Between two vertices a front is taken for the circle that arrives there when it
///   did, rather than for a straight line (in the manner of Novotni and Klein 2002), so that distances
///   are exact to rounding on any flat surface. The radius of the circle is kept at each vertex: it
///   grows with the way; where slowness changes it is refracted (the lens equation); the Gaussian
///   curvature `K` of the surface changes it by `d(1/r)/ds = -1/r^2 - K` (Jacobi's equation); and at
///   vertices around which ways bend, as at the corners of holes, it begins anew.
/// - *Obtuse corners.* A front may reach a vertex through two others of which one is farther away. A
///   vertex that comes nearer after it was done is done again, so that no such way is missed.
///
/// Fronts move on the intrinsic Delaunay triangulation ([`Triangulation::delaunay`]), whose triangles are
/// better than those of the mesh, and along the edges of both.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::mesh::distance::{Eikonal, EikonalOptions};
/// use heatpath_core::mesh::{Medium, Sources, shapes};
///
/// let sheet = shapes::sheet(30, 40, |i, j| [i as f64, j as f64, 0.0]);
/// let medium = Medium::uniform(sheet)?;
/// let sources = Sources::at_vertices(medium.mesh(), &[0])?;
/// let eikonal = Eikonal::new(medium);
/// let exec = Exec::single_threaded();
/// let distances = eikonal.distance(&sources, &EikonalOptions::default(), &exec)?;
/// assert!((distances.values()[31 * 41 - 1] - 50.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Eikonal {
    medium: Arc<Medium>,
    surface: Surface,
}

impl Eikonal {
    /// Prepares a medium.
    #[must_use]
    pub fn new(medium: impl Into<Arc<Medium>>) -> Self {
        let medium = medium.into();
        let triangulation = Triangulation::delaunay(&medium, false);
        let surface = Surface::new(
            triangulation.points().len(),
            triangulation.faces().to_vec(),
            triangulation.face_edges().to_vec(),
            triangulation.lengths().to_vec(),
            triangulation.slowness().to_vec(),
            chords(&medium, &triangulation),
        );
        Self { medium, surface }
    }

    /// The medium.
    #[must_use]
    pub fn medium(&self) -> &Arc<Medium> {
        &self.medium
    }

    /// The distance of each vertex from the nearest source.
    ///
    /// # Errors
    /// The farthest distance is not positive, or the caller cancelled.
    pub fn distance(
        &self,
        sources: &Sources,
        options: &EikonalOptions,
        exec: &Exec,
    ) -> Result<DistanceMap, EikonalError> {
        let farthest = options.farthest;
        check("farthest", farthest, farthest > 0.0, "a positive distance")?;
        let arrivals = march(&self.surface, &seeds(&self.medium, sources), farthest, exec)?;
        let label = |arrival: &Arrival| {
            sources.list().get(arrival.source as usize).map_or(NO_LABEL, |source| source.label)
        };
        let arrivals = &arrivals[..self.medium.mesh().points().len()];
        let labels = arrivals.iter().map(label).collect();
        Ok(DistanceMap::new(arrivals.iter().map(|arrival| arrival.time).collect(), labels))
    }
}

/// The edges of the mesh that the triangulation lacks.
fn chords(medium: &Medium, triangulation: &Triangulation) -> Vec<Chord> {
    let adjacency = medium.mesh().adjacency();
    let edges = adjacency.edges().iter().zip(medium.lengths()).enumerate();
    // A flipped or split edge has another length.
    let lacking = edges.filter(|&(edge, (_, &length))| triangulation.lengths()[edge] != length);
    let chord = |(edge, (&ends, &length)): (usize, (&[u32; 2], &f64))| {
        let faces = adjacency.edge_faces().of(edge).iter();
        let slowness = faces.map(|&face| medium.slowness()[face as usize]);
        Chord { ends, length, slowness: slowness.fold(f64::INFINITY, f64::min) }
    };
    lacking.map(chord).collect()
}

/// The arrivals at the corners of the faces with sources, straight from there.
fn seeds(medium: &Medium, sources: &Sources) -> Vec<(u32, Arrival)> {
    let mesh = medium.mesh();
    let mut seeds = Vec::new();
    for (number, source) in sources.list().iter().enumerate() {
        let spot = Spot::of(mesh, &source.point);
        for &face in spot.faces(mesh) {
            let slowness = medium.slowness()[face as usize];
            for corner in mesh.faces()[face as usize] {
                let radius = cost(medium, face, &spot, &Spot::Vertex(corner)) / slowness;
                let time = source.offset + slowness * radius;
                let (source, began) = (number as u32, source.offset);
                let arrival = Arrival { time, radius, slowness, source, began, centre: None };
                seeds.push((corner, arrival));
            }
        }
    }
    seeds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{TriMesh, shapes, vector};

    /// The mean and the largest relative error of the distances from a vertex.
    fn errors(medium: &Medium, source: u32, exact: impl Fn([f64; 3]) -> f64) -> [f64; 2] {
        let sources = Sources::at_vertices(medium.mesh(), &[source]).unwrap();
        let exec = Exec::single_threaded();
        let distances =
            Eikonal::new(medium.clone()).distance(&sources, &EikonalOptions::default(), &exec);
        let distances = distances.unwrap();
        let points = medium.mesh().points().iter().enumerate();
        let others = points.filter(|&(vertex, _)| vertex != source as usize);
        let errors = others.map(|(vertex, &point)| {
            let exact = exact(point);
            (distances.values()[vertex] - exact).abs() / exact
        });
        let errors: Vec<f64> = errors.collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        [mean, errors.into_iter().fold(0.0, f64::max)]
    }

    fn square(cells: usize, jitter: f64) -> TriMesh {
        let any = |seed: usize| {
            (((seed as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20) % 100_003) as f64
                / 100_003.0
        };
        shapes::sheet(cells, cells, |i, j| {
            let moved = |k: usize, seed: usize| {
                let inside = i > 0 && j > 0 && i < cells && j < cells;
                let by = if inside {
                    jitter * (2.0 * any(2 * (i * 97 + j * 1013) + seed) - 1.0)
                } else {
                    0.0
                };
                (k as f64 + by) / cells as f64
            };
            [moved(i, 0), moved(j, 1), 0.0]
        })
    }

    fn with_slowness(mesh: TriMesh, slowness: impl Fn([f64; 3]) -> f64) -> Medium {
        let third = |face: usize| {
            let [a, b, c] = mesh.corners(face);
            vector::scale(vector::add(a, vector::add(b, c)), 1.0 / 3.0)
        };
        let slowness = (0..mesh.faces().len()).map(|face| slowness(third(face))).collect();
        let lengths = mesh.edge_lengths();
        Medium::from_parts(mesh.into(), lengths, slowness).unwrap()
    }

    /// From the middle of the left side; `y` is counted from the middle of the band.
    fn beside_a_band(k: f64, w: f64, x: f64, y: f64) -> f64 {
        if y <= w {
            return k * x.hypot(y);
        }
        let time = |a: f64| k * a.hypot(w) + (x - a).hypot(y - w);
        // Golden sections: the time is convex.
        let (mut low, mut high) = (0.0, x + 1.0);
        for _ in 0..100 {
            let [a, b] = [low + 0.382 * (high - low), low + 0.618 * (high - low)];
            if time(a) < time(b) { high = b } else { low = a }
        }
        time(low)
    }

    #[test]
    fn a_fast_band() {
        // Half the width of the band, in cells; its middle is at y = 1/2.
        for (contrast, cells, half) in
            [(10.0, 64, 4), (100.0, 64, 4), (10.0, 128, 8), (100.0, 128, 8), (100.0, 64, 1)]
        {
            let (k, w) = (1.0 / contrast, f64::from(half) / cells as f64);
            let mesh = square(cells, 0.0);
            let medium = with_slowness(mesh, |p| if (p[1] - 0.5).abs() < w { k } else { 1.0 });
            let source = (cells / 2 * (cells + 1)) as u32;
            let exact = |p: [f64; 3]| beside_a_band(k, w, p[0], (p[1] - 0.5).abs());
            let [mean, max] = errors(&medium, source, exact);
            println!(
                "| band of contrast {contrast}, {half} of {cells} cells | {mean:.1e} | {max:.1e} |"
            );
            assert!(mean < 1e-3 && max < 0.03, "contrast {contrast}: {mean}, {max}");
        }
    }

    #[test]
    fn a_metric_that_depends_on_direction() {
        for (ratio, angle) in [(2.0, 0.3), (5.0, 0.7), (10.0, 1.1)] {
            let mesh = square(64, 0.3);
            let (sin, cos) = f64::sin_cos(angle);
            let norm = move |v: [f64; 3]| {
                let [along, across] = [v[0] * cos + v[1] * sin, v[1] * cos - v[0] * sin];
                along.hypot(ratio * across)
            };
            let between = |[a, b]: [u32; 2]| {
                norm(vector::subtract(mesh.points()[a as usize], mesh.points()[b as usize]))
            };
            let lengths = mesh.adjacency().edges().iter().map(|&ends| between(ends)).collect();
            let slowness = vec![1.0; mesh.faces().len()];
            let centre = mesh.points()[32 * 65 + 32];
            let medium = Medium::from_parts(mesh.into(), lengths, slowness).unwrap();
            let [mean, max] = errors(&medium, 32 * 65 + 32, |p| norm(vector::subtract(p, centre)));
            println!("| tensor of ratio {ratio} | {mean:.1e} | {max:.1e} |");
            // Beyond that, corners are so obtuse that fronts pass over several faces at once.
            assert!(mean < if ratio < 10.0 { 1e-9 } else { 4e-3 }, "ratio {ratio}: {mean}");
        }
    }
}
