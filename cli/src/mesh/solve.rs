//! Distances and paths by any method.

use super::args::{MeshMethodArg, MeshMethodArgs};
use super::idle::refuse_idle;
use crate::failure::Failure;
use heatpath_core::Exec;
use heatpath_core::mesh::distance::{DistanceMap, HeatMethodOptions};
use heatpath_core::mesh::heat::{HeatOptions, Step, Weights};
use heatpath_core::mesh::path::{Ending, Path, shorten};
use heatpath_core::mesh::{
    Geodesics, GeodesicsOptions, Medium, Method, Sources, SurfacePoint, TriMesh,
};
use std::time::Instant;

/// Where the medium ends in the progress of a command that begins with it, and the preparation after it.
pub(super) const MEDIUM_END: f64 = 0.2;
pub(super) const PREPARE_END: f64 = 0.6;

/// What the options of a command ask for.
pub(super) struct Plan(GeodesicsOptions);

/// Distances in one medium, prepared.
pub(super) struct Solver {
    geodesics: Geodesics,
    pub(super) prepare_seconds: f64,
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
        let usual = HeatMethodOptions::default();
        Ok(Self(GeodesicsOptions {
            method: match args.method {
                Auto => Method::Auto,
                Heat => Method::Heat,
                Eikonal => Method::Eikonal,
                Exact => Method::Exact,
                Paper => Method::Explicit,
            },
            heat: HeatMethodOptions {
                time: args.time,
                memory_limit: memory_limit(args.memory, usual.memory_limit)?,
            },
            explicit: HeatOptions {
                step: args.step.map_or(Step::Usual, Step::Fixed),
                iterations: args.iterations,
                weights: Weights::Literal,
            },
            farthest: args.farthest.unwrap_or(f64::INFINITY),
        }))
    }

    pub(super) fn prepare(&self, medium: Medium, exec: &Exec) -> Result<Solver, Failure> {
        let start = Instant::now();
        let geodesics = Geodesics::new(medium, self.0, exec)?;
        Ok(Solver { geodesics, prepare_seconds: start.elapsed().as_secs_f64() })
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
    /// The name of the method.
    pub(super) fn method(&self) -> &'static str {
        match self.geodesics.method() {
            Method::Exact => "exact",
            Method::Eikonal => "eikonal",
            Method::Explicit => "paper",
            _ => "heat",
        }
    }

    pub(super) fn distance(&self, sources: &Sources, exec: &Exec) -> Result<DistanceMap, Failure> {
        Ok(self.geodesics.distance(sources, exec)?)
    }

    /// The distances from `sources`, and the path along `route` from each of its ends.
    pub(super) fn paths(
        &self,
        sources: &Sources,
        route: &Route<'_>,
        exec: &Exec,
    ) -> Result<(DistanceMap, Vec<Path>), Failure> {
        let mesh = self.geodesics.medium().mesh();
        let legs = route.via.len() + 1;
        let leg = |number: usize, sources: &Sources, starts: &[SurfacePoint]| {
            let (map, paths) = self.geodesics.paths(sources, starts, &exec.piece(number, legs))?;
            let paths = paths.into_iter().map(|path| shortened(mesh, path, route.shorten));
            Ok::<_, Failure>((map, paths.collect::<Result<Vec<Path>, Failure>>()?))
        };
        let mut paths: Option<Vec<Path>> = None;
        let mut starts = route.ends;
        for (number, way_point) in route.via.chunks(1).enumerate() {
            let pieces = leg(number, &Sources::new(mesh, way_point)?, starts)?.1;
            paths = Some(joined(mesh, paths, pieces));
            starts = way_point;
        }
        let (map, pieces) = leg(legs - 1, sources, starts)?;
        Ok((map, joined(mesh, paths, pieces)))
    }
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
