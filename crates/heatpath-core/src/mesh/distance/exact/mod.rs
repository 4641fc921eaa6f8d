//! Exact distances: windows of straight paths propagate across the faces.

mod crowd;
mod filter;
mod place;
mod propagation;
mod queue;
mod reached;
mod sides;
mod trace;
mod window;

pub use self::trace::ExactPaths;

use self::place::Place;
use self::propagation::Propagation;
use self::sides::Sides;
use super::{DistanceMap, NO_LABEL, NOT_REACHED};
use crate::error::{ParameterError, check};
use crate::exec::{Cancelled, Exec};
use crate::mesh::{Medium, Source, Sources, TriMesh};
use std::sync::Arc;
use thiserror::Error;

/// The parameters of [`Exact::distance`].
#[derive(Clone, Debug, PartialEq)]
pub struct ExactOptions {
    /// The propagation ends at this distance; everything beyond is not reached. Positive; default
    /// infinity.
    pub farthest: f64,
}

impl Default for ExactOptions {
    fn default() -> Self {
        Self { farthest: f64::INFINITY }
    }
}

/// Why there is no exact distance.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ExactError {
    /// Paths are straight only where the slowness is the same on all faces.
    #[error("the slowness goes from {low} to {high}; exact distances need the same on all faces")]
    Slowness {
        /// The smallest.
        low: f64,
        /// The largest.
        high: f64,
    },
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The faces lie in each other in so many ways that windows do not end.
    #[error(
        "{windows} windows were not enough: the faces of this mesh lie in each other; weld it, or use \
         fast marching"
    )]
    Windows {
        /// How many there were.
        windows: usize,
    },
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Exact distances and shortest paths on the faces of a mesh, prepared for any sources.
///
/// The distance on the polyhedral surface itself, to rounding, where heat and fast marching have
/// errors of their mesh: the reference that they are compared with, and the choice for meshes of up to
/// some 100,000 vertices when time matters less than the last digits.
///
/// Paths that cross the same edges are straight lines in the plane in which their faces are unfolded.
/// A *window* is an interval of an edge with the image of the source in the plane of the next face; it
/// is carried across that face to one or two other sides. This is the improved algorithm of Chen and
/// Han (1990; Xin and Wang 2009):
///
/// - *One angle, one split.* Of all windows that see the corner of a face across the opposite side, only
///   the one with the shortest path to it goes on through both other sides.
/// - *Filter.* A window is given up if paths over one of the vertices around are shorter than all of its own.
/// - *Order.* Windows near the source go first, in slots of distance (Xu et al. 2015).
/// - *Vertices at which paths can bend* (saddles, flat ones, all on borders or with faces that
///   are no disk) are sources themselves, for the faces behind them alone.
///
/// All comes from the lengths of edges ([`Medium::lengths`]), so it serves metrics that depend on
/// direction too. The orientation of faces does not matter. At an edge with more than two faces, a window
/// goes on into all others.
///
/// # Rounding
/// Windows are not cut by one another, so there are no gaps between them that rounding could open:
/// the rays that bound a window all pass through vertices. Behind a vertex the windows of both sides
/// overlap, or the vertex is a source; which one is decided at an angle of 1e-8, that is far above the
/// rounding of an angle. And a window is given up only for a path that is shorter by a part of 1e-12.
/// What rounding can do is keep windows that are not needed, and lose some across needles; the distances
/// of vertices go on along the edges too, so none is left out. Expect relative errors of 1e-12; of needles,
/// lengths alone leave fewer digits of what lies across them. Only at edges with more than two
/// faces windows are cut, where others are shorter by the same margin: layers of faces would take exponential time.
///
/// # Cost
/// From n to n^1.5 windows on usual meshes. A window has 56 bytes; those that are done are forgotten by
/// [`distance`](Self::distance) and kept by [`paths`](Self::paths). One thread.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::mesh::distance::{Exact, ExactOptions};
/// use heatpath_core::mesh::{Medium, Sources, shapes};
///
/// let medium = Medium::uniform(shapes::sheet(4, 3, |x, y| [x as f64, y as f64, 0.0]))?;
/// let sources = Sources::at_vertices(medium.mesh(), &[0])?;
/// let exec = Exec::single_threaded();
/// let exact = Exact::new(&medium)?;
/// let map = exact.distance(&sources, &ExactOptions::default(), &exec)?;
/// assert!((map.values()[19] - 5.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Exact {
    mesh: Arc<TriMesh>,
    sides: Sides,
    /// Whether shortest paths can bend at each vertex.
    can_bend: Vec<bool>,
    /// The distance across the mean edge: 1 inside this room.
    unit: f64,
}

impl Exact {
    /// Lays out the faces of a medium.
    ///
    /// # Errors
    /// The slowness is not the same on all faces.
    pub fn new(medium: &Medium) -> Result<Self, ExactError> {
        let slowness = medium.slowness();
        let [low, high] =
            slowness.iter().fold([f64::INFINITY, 0.0], |[low, high], &x| [x.min(low), x.max(high)]);
        if low < high {
            return Err(ExactError::Slowness { low, high });
        }
        let lengths = medium.lengths();
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        let sides = Sides::new(medium, mean);
        let mesh = Arc::clone(medium.mesh());
        let can_bend = (0..mesh.points().len() as u32).map(|v| sides.can_bend(v)).collect();
        Ok(Self { mesh, sides, can_bend, unit: mean * low })
    }

    /// The distance of each vertex from the nearest source.
    ///
    /// # Errors
    /// `farthest` is not positive, windows do not end, or the caller cancelled.
    pub fn distance(
        &self,
        sources: &Sources,
        options: &ExactOptions,
        exec: &Exec<'_>,
    ) -> Result<DistanceMap, ExactError> {
        let propagation = self.propagate(sources, options, false, exec)?;
        Ok(self.map(&propagation, sources.list()))
    }

    /// The same with all windows, for distances and paths from any point of the surface.
    ///
    /// # Errors
    /// `farthest` is not positive, windows do not end, or the caller cancelled.
    pub fn paths(
        &self,
        sources: &Sources,
        options: &ExactOptions,
        exec: &Exec<'_>,
    ) -> Result<ExactPaths<'_>, ExactError> {
        let propagation = self.propagate(sources, options, true, exec)?;
        let map = self.map(&propagation, sources.list());
        Ok(ExactPaths::new(self, sources, propagation, map, options.farthest))
    }

    fn propagate(
        &self,
        sources: &Sources,
        options: &ExactOptions,
        keeps: bool,
        exec: &Exec<'_>,
    ) -> Result<Propagation<'_>, ExactError> {
        check("farthest", options.farthest, options.farthest > 0.0, "a positive distance")?;
        let inside = |distance: f64| (distance - base(sources.list())) / self.unit;
        let farthest = inside(options.farthest);
        let mut propagation = Propagation::new(&self.sides, &self.can_bend, farthest, keeps);
        for (source, number) in sources.list().iter().zip(0..) {
            let places = Place::new(&source.point).all(&self.mesh);
            propagation.start(number, &places, inside(source.offset));
        }
        propagation.run(exec)?;
        Ok(propagation)
    }

    fn map(&self, propagation: &Propagation<'_>, sources: &[Source]) -> DistanceMap {
        let base = base(sources);
        let reached = &propagation.vertices;
        let value = |distance: f64| {
            if distance.is_finite() { base + distance * self.unit } else { NOT_REACHED }
        };
        let label = |source: u32| sources.get(source as usize).map_or(NO_LABEL, |s| s.label);
        DistanceMap::new(
            reached.iter().map(|vertex| value(vertex.distance)).collect(),
            reached.iter().map(|vertex| label(vertex.source)).collect(),
        )
    }
}

/// The smallest offset: inside this room, distances count from it.
fn base(sources: &[Source]) -> f64 {
    sources.iter().map(|source| source.offset).fold(f64::INFINITY, f64::min)
}
