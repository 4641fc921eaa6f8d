//! Distances and paths by any method.

use super::args::{MeshMethodArg, MeshMethodArgs};
use super::idle::refuse_idle;
use crate::failure::Failure;
use heatpath_core::Exec;
use heatpath_core::mesh::distance::{
    DistanceMap, HeatMethodOptions, Of, VaradhanOptions, varadhan,
};
use heatpath_core::mesh::heat::{Explicit, Heat, HeatOptions, Step, Weights};
use heatpath_core::mesh::path::{Descent, Ending, Path, shorten};
use heatpath_core::mesh::{
    Geodesics, GeodesicsOptions, Medium, Method, Sources, SurfacePoint, TriMesh,
};
use std::sync::Arc;
use std::time::Instant;

/// What the options of a command ask for.
pub(super) enum Plan {
    Geodesics(GeodesicsOptions),
    /// Explicit heat, eqs. (15), (16) and (3).
    Paper(HeatOptions),
}

/// Distances in one medium, prepared.
pub(super) struct Solver {
    kind: Kind,
    /// The name of the method.
    pub(super) method: &'static str,
    pub(super) prepare_seconds: f64,
}

enum Kind {
    Geodesics(Geodesics),
    Paper(Arc<Medium>, Explicit),
}

impl Plan {
    /// Refuses options that would do nothing.
    pub(super) fn new(args: &MeshMethodArgs) -> Result<Self, Failure> {
        use MeshMethodArg::{Auto, Eikonal, Exact, Heat, Paper};
        let needs = [
            (args.farthest.is_some(), "--farthest", &[Auto, Heat, Eikonal, Exact][..]),
            (args.time.is_some(), "--time", &[Heat][..]),
            (args.memory.is_some(), "--memory", &[Heat][..]),
            (args.iterations.is_some(), "--iterations", &[Paper][..]),
            (args.step.is_some(), "--step", &[Paper][..]),
        ];
        refuse_idle("--method", &args.method, &needs)?;
        let method = match args.method {
            Auto => Method::Auto,
            Heat => Method::Heat,
            Eikonal => Method::Eikonal,
            Exact => Method::Exact,
            Paper => {
                let step = args.step.map_or(Step::Usual, Step::Fixed);
                let (iterations, weights) = (args.iterations, Weights::Literal);
                return Ok(Self::Paper(HeatOptions { step, iterations, weights }));
            }
        };
        let usual = HeatMethodOptions::default();
        let heat = HeatMethodOptions {
            time: args.time,
            memory_limit: memory_limit(args.memory, usual.memory_limit)?,
        };
        let farthest = args.farthest.unwrap_or(f64::INFINITY);
        Ok(Self::Geodesics(GeodesicsOptions { method, heat, farthest }))
    }

    pub(super) fn prepare(&self, medium: Medium, exec: &Exec) -> Result<Solver, Failure> {
        let start = Instant::now();
        let medium = Arc::new(medium);
        let (kind, method) = match self {
            Self::Geodesics(options) => {
                let geodesics = Geodesics::new(medium, *options, exec)?;
                let method = match geodesics.method() {
                    Method::Exact => "exact",
                    Method::Eikonal => "eikonal",
                    _ => "heat",
                };
                (Kind::Geodesics(geodesics), method)
            }
            Self::Paper(options) => {
                let explicit = Explicit::new(&medium, *options)?;
                (Kind::Paper(medium, explicit), "paper")
            }
        };
        Ok(Solver { kind, method, prepare_seconds: start.elapsed().as_secs_f64() })
    }
}

/// Where paths lead from their ends to the sources.
pub(super) struct Route<'a> {
    pub(super) ends: &'a [SurfacePoint],
    /// The points that each path passes first, in this order.
    pub(super) via: &'a [SurfacePoint],
    /// Whether the pieces between these points are made locally shortest.
    pub(super) shorten: bool,
}

impl Solver {
    pub(super) fn distance(&self, sources: &Sources, exec: &Exec) -> Result<DistanceMap, Failure> {
        match &self.kind {
            Kind::Geodesics(geodesics) => Ok(geodesics.distance(sources, exec)?),
            Kind::Paper(_, explicit) => {
                let heat = flow(explicit, sources, exec)?;
                Ok(varadhan(&heat, VaradhanOptions::default()))
            }
        }
    }

    /// The distances from `sources`, and the path along `route` from each of its ends.
    pub(super) fn paths(
        &self,
        sources: &Sources,
        route: &Route<'_>,
        exec: &Exec,
    ) -> Result<(DistanceMap, Vec<Path>), Failure> {
        let mesh = self.medium().mesh();
        let leg = |sources: &Sources, starts: &[SurfacePoint]| {
            let (map, paths) = self.direct_paths(sources, starts, exec)?;
            let paths = paths.into_iter().map(|path| shortened(mesh, path, route.shorten));
            Ok::<_, Failure>((map, paths.collect::<Result<Vec<Path>, Failure>>()?))
        };
        let mut paths: Option<Vec<Path>> = None;
        let mut starts = route.ends;
        for way_point in route.via.chunks(1) {
            let pieces = leg(&Sources::new(mesh, way_point)?, starts)?.1;
            paths = Some(joined(mesh, paths, pieces));
            starts = way_point;
        }
        let (map, pieces) = leg(sources, starts)?;
        Ok((map, joined(mesh, paths, pieces)))
    }

    fn direct_paths(
        &self,
        sources: &Sources,
        ends: &[SurfacePoint],
        exec: &Exec,
    ) -> Result<(DistanceMap, Vec<Path>), Failure> {
        match &self.kind {
            Kind::Geodesics(geodesics) => Ok(geodesics.paths(sources, ends, exec)?),
            Kind::Paper(medium, explicit) => {
                let heat = flow(explicit, sources, exec)?;
                let map = varadhan(&heat, VaradhanOptions::default());
                // Its minima are the sources, those of the distance are not.
                let exposure = VaradhanOptions { of: Of::Exposure, ..Default::default() };
                let slope = varadhan(&heat, exposure);
                let descent = Descent::new(medium, slope.values(), sources)?;
                let path = |&end: &SurfacePoint| {
                    let distance = map.at(medium.mesh(), &end);
                    Ok::<_, Failure>(Path { distance, ..descent.path(end)? })
                };
                let paths = ends.iter().map(path).collect::<Result<_, _>>()?;
                Ok((map, paths))
            }
        }
    }

    pub(super) fn medium(&self) -> &Medium {
        match &self.kind {
            Kind::Geodesics(geodesics) => geodesics.medium(),
            Kind::Paper(medium, _) => medium,
        }
    }
}

fn flow(explicit: &Explicit, sources: &Sources, exec: &Exec) -> Result<Heat, Failure> {
    Ok(if sources.list().len() == 1 {
        explicit.flow(sources, exec)?
    } else {
        explicit.flow_balanced(sources, exec)?
    })
}

fn shortened(mesh: &TriMesh, path: Path, is_asked: bool) -> Result<Path, Failure> {
    match path.ending {
        Ending::Source(_) if is_asked => Ok(shorten(mesh, &path)?),
        _ => Ok(path),
    }
}

/// Paths and what follows at their way point: a path each, or the same for all.
fn joined(mesh: &TriMesh, paths: Option<Vec<Path>>, next: Vec<Path>) -> Vec<Path> {
    let Some(paths) = paths else { return next };
    let joined = |path: Path| match path.ending {
        Ending::Source(_) => path.then(mesh, &next[0]),
        Ending::Unreachable | Ending::Stuck => path,
    };
    paths.into_iter().map(joined).collect()
}

/// --memory in bytes.
fn memory_limit(gibibytes: Option<f64>, usual: usize) -> Result<usize, Failure> {
    match gibibytes {
        None => Ok(usual),
        Some(gibibytes) if gibibytes > 0.0 && gibibytes.is_finite() => {
            Ok((gibibytes * f64::from(1 << 30)) as usize)
        }
        Some(gibibytes) => Err(Failure::usage(format!(
            "--memory is {gibibytes}; it must be a positive number of GiB"
        ))),
    }
}
