//! Distances and paths by whichever method suits.

use super::distance::{
    DistanceMap, Eikonal, EikonalError, EikonalOptions, Exact, ExactError, ExactOptions,
    HeatMethod, HeatMethodError, HeatMethodOptions, NOT_REACHED, Of, VaradhanOptions, varadhan,
};
use super::heat::{Explicit, Heat, HeatError, HeatOptions};
use super::path::{Descent, Ending, Path, ValuesError};
use super::{Medium, PointError, Sources, SurfacePoint};
use crate::error::{ParameterError, check};
use crate::exec::{Cancelled, Exec};
use std::sync::Arc;
use thiserror::Error;

/// How distances are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// [`Exact`](Self::Exact) for up to 20,000 faces if all are equally slow and at most two meet in
    /// each edge, else [`Eikonal`](Self::Eikonal); also where windows do not end, because faces lie in
    /// each other.
    #[default]
    Auto,
    /// The heat method: prepared once, then faster than all others, for many sources. Smooth, and so
    /// too short by some 3 % in the mean where the surface is coarse or narrow. Not for media whose
    /// slowness jumps.
    Heat,
    /// Fast marching with round fronts: nothing to prepare, any slowness; exact on flat surfaces, within
    /// 0.1 % in the mean on fine meshes of others and 0.6 % on coarse ones.
    Eikonal,
    /// Windows of straight paths: exact to rounding, for one slowness everywhere.
    Exact,
    /// The explicit heat of the paper, eqs. (15), (16) and (3), as [`varadhan`] reads it: right where
    /// all edges are about equally long, and to compare with. Sources must have no offsets.
    Explicit,
}

/// The parameters of [`Geodesics`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeodesicsOptions {
    /// How distances are found; default [`Method::Auto`].
    pub method: Method,
    /// The parameters of the heat method, if it is that.
    pub heat: HeatMethodOptions,
    /// The parameters of explicit heat, if it is that.
    pub explicit: HeatOptions,
    /// Vertices beyond this distance are not reached, which saves time in all methods but those of
    /// heat. Positive; default infinity.
    pub farthest: f64,
}

impl Default for GeodesicsOptions {
    fn default() -> Self {
        Self {
            method: Method::default(),
            heat: HeatMethodOptions::default(),
            explicit: HeatOptions::default(),
            farthest: f64::INFINITY,
        }
    }
}

/// Why there are no distances or paths.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GeodesicsError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The heat method cannot be used.
    #[error(transparent)]
    Heat(#[from] HeatMethodError),
    /// Fast marching was refused or cancelled.
    #[error(transparent)]
    Eikonal(#[from] EikonalError),
    /// Exact distances cannot be had.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// Explicit heat was refused or cancelled.
    #[error(transparent)]
    Explicit(#[from] HeatError),
    /// A source or an end is not on this mesh.
    #[error(transparent)]
    Point(#[from] PointError),
    /// Distances cannot be descended.
    #[error(transparent)]
    Values(#[from] ValuesError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Distances and paths in one medium, prepared once for any sources.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::mesh::path::Ending;
/// use heatpath_core::mesh::{Geodesics, Medium, Sources, shapes};
///
/// let sphere = shapes::icosphere(4);
/// let exec = Exec::new(0)?;
/// let geodesics = Geodesics::new(Medium::uniform(sphere)?, Default::default(), &exec)?;
/// let mesh = geodesics.medium().mesh();
/// let sources = Sources::at_vertices(mesh, &[0])?;
/// let ends = [mesh.at_vertex("end", 0, 1000)?];
/// let (distances, paths) = geodesics.paths(&sources, &ends, &exec)?;
/// assert_eq!(paths[0].ending, Ending::Source(0));
/// assert!((paths[0].length / distances.values()[1000] - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Geodesics {
    medium: Arc<Medium>,
    solver: Solver,
    farthest: f64,
}

#[derive(Debug)]
enum Solver {
    Heat(Box<HeatMethod>),
    Eikonal(Eikonal),
    /// With what takes over where windows do not end, if nobody asked for them.
    Exact(Box<Exact>, Option<Eikonal>),
    Explicit(Box<Explicit>),
}

/// Windows are for meshes of so many faces at most: they take 0.1 to 0.3 s.
const MOST_EXACT: usize = 20_000;

impl Geodesics {
    /// Prepares distances in `medium`.
    ///
    /// # Errors
    /// The method cannot be used in this medium or not with these parameters; or the caller
    /// cancelled.
    pub fn new(
        medium: impl Into<Arc<Medium>>,
        options: GeodesicsOptions,
        exec: &Exec,
    ) -> Result<Self, GeodesicsError> {
        let (medium, farthest) = (medium.into(), options.farthest);
        check("farthest", farthest, farthest > 0.0, "a positive distance")?;
        let solver = match chosen(options.method, &medium) {
            Method::Exact => {
                let is_auto = options.method == Method::Auto;
                let instead = is_auto.then(|| Eikonal::new(Arc::clone(&medium)));
                Solver::Exact(Box::new(Exact::new(&medium)?), instead)
            }
            Method::Eikonal => Solver::Eikonal(Eikonal::new(Arc::clone(&medium))),
            Method::Explicit => {
                Solver::Explicit(Box::new(Explicit::new(&medium, options.explicit)?))
            }
            _ => Solver::Heat(Box::new(HeatMethod::new(Arc::clone(&medium), options.heat, exec)?)),
        };
        Ok(Self { medium, solver, farthest })
    }

    /// The medium.
    #[must_use]
    pub fn medium(&self) -> &Arc<Medium> {
        &self.medium
    }

    /// The method that is used, or tried first: not [`Method::Auto`].
    #[must_use]
    pub fn method(&self) -> Method {
        match self.solver {
            Solver::Heat(_) => Method::Heat,
            Solver::Eikonal(_) => Method::Eikonal,
            Solver::Exact(..) => Method::Exact,
            Solver::Explicit(_) => Method::Explicit,
        }
    }

    /// The distances from the nearest of `sources`.
    ///
    /// # Errors
    /// A source is not on this mesh, or the caller cancelled.
    pub fn distance(&self, sources: &Sources, exec: &Exec) -> Result<DistanceMap, GeodesicsError> {
        self.distances(std::slice::from_ref(sources), exec).map(|mut maps| maps.remove(0))
    }

    /// The distances from each of several sets of sources by itself, which the threads of `exec`
    /// share.
    ///
    /// # Errors
    /// A source is not on this mesh, or the caller cancelled.
    pub fn distances(
        &self,
        sets: &[Sources],
        exec: &Exec,
    ) -> Result<Vec<DistanceMap>, GeodesicsError> {
        sets.iter().try_for_each(|sources| self.check_sources(sources))?;
        match &self.solver {
            Solver::Heat(method) => {
                let mut maps = method.distances(sets, exec)?;
                maps.iter_mut().for_each(|map| map.cut(self.farthest));
                Ok(maps)
            }
            Solver::Eikonal(eikonal) => {
                each(sets, exec, |sources, exec| self.march(eikonal, sources, exec))
            }
            Solver::Exact(exact, instead) => {
                let options = ExactOptions { farthest: self.farthest };
                each(sets, exec, |sources, exec| {
                    match (exact.distance(sources, &options, exec), instead) {
                        (Err(ExactError::Windows { .. }), Some(eikonal)) => {
                            self.march(eikonal, sources, exec)
                        }
                        (result, _) => Ok(result?),
                    }
                })
            }
            Solver::Explicit(explicit) => each(sets, exec, |sources, exec| {
                Ok(self.read(&explicit.flow_balanced(sources, exec)?))
            }),
        }
    }

    fn check_sources(&self, sources: &Sources) -> Result<(), PointError> {
        let points = sources.list().iter().map(|source| source.point);
        self.medium.mesh().check_points("source", points)
    }

    /// The distances of explicit heat.
    fn read(&self, heat: &Heat) -> DistanceMap {
        let mut map = varadhan(heat, VaradhanOptions::default());
        map.cut(self.farthest);
        map
    }

    /// The distances from the nearest of `sources`, and the paths to it from each of `ends`.
    ///
    /// Exact paths are as long as the distance. Others descend it; where lengths are not weighted,
    /// [`shorten`](super::path::shorten) makes them locally shortest.
    ///
    /// # Errors
    /// A source or an end is not on this mesh, or the caller cancelled.
    pub fn paths(
        &self,
        sources: &Sources,
        ends: &[SurfacePoint],
        exec: &Exec,
    ) -> Result<(DistanceMap, Vec<Path>), GeodesicsError> {
        self.check_sources(sources)?;
        self.medium.mesh().check_points("end", ends.iter().copied())?;
        let map = match &self.solver {
            Solver::Exact(exact, instead) => {
                let options = ExactOptions { farthest: self.farthest };
                match (exact.paths(sources, &options, exec), instead) {
                    (Err(ExactError::Windows { .. }), Some(eikonal)) => {
                        self.march(eikonal, sources, exec)?
                    }
                    (found, _) => {
                        let found = found?;
                        let paths =
                            ends.iter().map(|end| found.path(end)).collect::<Result<_, _>>()?;
                        return Ok((found.map().clone(), paths));
                    }
                }
            }
            Solver::Explicit(explicit) => {
                let heat = explicit.flow_balanced(sources, exec)?;
                return self.paths_of_heat(&heat, sources, ends);
            }
            Solver::Heat(_) | Solver::Eikonal(_) => self.distance(sources, exec)?,
        };
        let descent = Descent::new(&self.medium, map.values(), sources)?;
        let paths = ends.iter().map(|&end| descent.path(end)).collect::<Result<_, _>>()?;
        Ok((map, paths))
    }

    /// The distances and paths of explicit heat: the minima of the exposure are the sources, those of
    /// the distance need not be.
    fn paths_of_heat(
        &self,
        heat: &Heat,
        sources: &Sources,
        ends: &[SurfacePoint],
    ) -> Result<(DistanceMap, Vec<Path>), GeodesicsError> {
        let map = self.read(heat);
        let exposure = VaradhanOptions { of: Of::Exposure, ..VaradhanOptions::default() };
        let slope = varadhan(heat, exposure);
        let descent = Descent::new(&self.medium, slope.values(), sources)?;
        let mesh = self.medium.mesh();
        let path = |&end: &SurfacePoint| match map.at(mesh, &end) {
            NOT_REACHED => Ok(Path::new(mesh, vec![end], Ending::Unreachable, NOT_REACHED)),
            distance => Ok(Path { distance, ..descent.path(end)? }),
        };
        let paths = ends.iter().map(path).collect::<Result<_, GeodesicsError>>()?;
        Ok((map, paths))
    }

    fn march(
        &self,
        eikonal: &Eikonal,
        sources: &Sources,
        exec: &Exec,
    ) -> Result<DistanceMap, GeodesicsError> {
        let options = EikonalOptions { farthest: self.farthest };
        Ok(eikonal.distance(sources, &options, exec)?)
    }

    /// The path from the first of `points` through all others, in their order, to the last, which has the
    /// label 0: a path from each point to the next. It ends where one of these does.
    ///
    /// # Errors
    /// There are less than two points, one is not on this mesh, or the caller cancelled.
    pub fn through(&self, points: &[SurfacePoint], exec: &Exec) -> Result<Path, GeodesicsError> {
        let mesh = self.medium.mesh();
        mesh.check_points("end", points.first().copied())?;
        mesh.check_points("way", points[1..].iter().copied())?;
        let mut whole: Option<Path> = None;
        for (number, pair) in points.windows(2).enumerate() {
            let sources = Sources::new(mesh, &pair[1..])?;
            let exec = exec.piece(number, points.len() - 1);
            let (_, mut pieces) = self.paths(&sources, &pair[..1], &exec)?;
            let piece = pieces.remove(0);
            let is_there = matches!(piece.ending, Ending::Source(_));
            whole = Some(whole.map_or_else(|| piece.clone(), |path| path.then(mesh, &piece)));
            if !is_there {
                break;
            }
        }
        whole.ok_or(GeodesicsError::Point(PointError::Missing { role: "way" }))
    }
}

/// The method itself.
fn chosen(method: Method, medium: &Medium) -> Method {
    match method {
        Method::Auto if suits_windows(medium) => Method::Exact,
        Method::Auto => Method::Eikonal,
        method => method,
    }
}

/// Whether windows are quick here. Where many faces meet in edges they may not be.
fn suits_windows(medium: &Medium) -> bool {
    let edge_faces = medium.mesh().adjacency().edge_faces();
    medium.mesh().faces().len() <= MOST_EXACT
        && medium.contrast() == 1.0
        && (0..edge_faces.len()).all(|edge| edge_faces.of(edge).len() <= 2)
}

/// A map for each set, on all threads.
fn each(
    sets: &[Sources],
    exec: &Exec,
    map: impl Fn(&Sources, &Exec) -> Result<DistanceMap, GeodesicsError> + Sync,
) -> Result<Vec<DistanceMap>, GeodesicsError> {
    let part = |done: usize| done as f64 / sets.len() as f64;
    // One thread can be watched.
    if sets.len() == 1 || exec.threads() == 1 {
        let one = |(number, sources)| map(sources, &exec.piece(number, sets.len()));
        return sets.iter().enumerate().map(one).collect();
    }
    let mut maps = Vec::with_capacity(sets.len());
    for round in sets.chunks(exec.threads()) {
        exec.report(part(maps.len()))?;
        let mut jobs: Vec<_> = round.iter().map(|sources| (sources, None)).collect();
        exec.for_each(&mut jobs, |(sources, done)| {
            *done = Some(map(sources, &Exec::single_threaded()));
        });
        for done in jobs.into_iter().filter_map(|(_, done)| done) {
            maps.push(done?);
        }
    }
    exec.report(1.0)?;
    Ok(maps)
}
