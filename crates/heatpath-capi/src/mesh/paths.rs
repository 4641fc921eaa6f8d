//! Curves on meshes: paths, paths through points, isolines.

use super::handle::{hp_mesh, surface_of};
use super::options::hp_mesh_options;
use super::points::{hp_surface_points, read_points, read_sources};
use super::prepared::Prepared;
use super::settings::Settings;
use super::solver::hp_mesh_solver;
use crate::array::hp_array;
use crate::handles::{borrow, hand_out};
use crate::numbers::reals;
use crate::paths::{
    HP_ENDED_CLOSED, HP_ENDED_NOT_REACHED, HP_ENDED_OPEN, HP_ENDED_SOURCE, HP_ENDED_STEP_LIMIT,
    HP_ENDED_UNREACHABLE, Traced, hp_path_info, hp_paths,
};
use crate::run::rounds;
use crate::status::{Failure, guard, hp_status};
use crate::structs::Versioned;
use heatpath_core::Exec;
use heatpath_core::mesh::path::{Ending, Path, isolines, length, shorten};
use heatpath_core::mesh::{Method, Sources, SurfacePoint, TriMesh};

/// Traces the shortest path from each end point to a source.
///
/// sources: one set of them; see hp_surface_points.
///
/// ends: the end points.
///
/// options: shorten, threads and progress count. NULL for the defaults.
///
/// paths: receives the paths, in the order of the ends, to be freed with hp_paths_free(), or NULL
/// if anything but HP_OK is returned. Their points are x, y, z, from the end to the source; two
/// neighbours share a face. hp_path_info.source is the label of the source, and both lengths are
/// that in space; the distance is that of the solver, also if the path was shortened.
///
/// An end point from which no source can be reached is not an error: hp_path_info tells.
///
/// # Safety
/// `solver` is NULL or comes from hp_mesh_solver_create(). The structs are as large as their
/// `struct_size` says, and lists are as large as their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_paths_create(
    solver: *const hp_mesh_solver,
    sources: *const hp_surface_points,
    ends: *const hp_surface_points,
    options: *const hp_mesh_options,
    paths: *mut *mut hp_paths,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        let (tracer, sources, ends) = unsafe {
            let tracer = Tracer::read(solver, options)?;
            let sources = read_sources(&tracer.prepared.surface, sources)?;
            let ends = read_points(&tracer.prepared.surface, ends, ["end", "ends"])?;
            (tracer, sources, ends)
        };
        let legs = tracer.legs(&sources, &ends, &tracer.settings.run.exec()?)?;
        tracer.settings.run.finish()?;
        Ok(hp_paths { paths: legs.into_iter().map(Leg::traced).collect() })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(paths, "paths", make) })
}

/// Traces the path through some points in their order.
///
/// points: two or more. The path goes from the first one to the last one and passes through the
/// others; each piece is the shortest one, and hp_mesh_options.shorten straightens each by itself.
///
/// paths: receives one path as hp_mesh_paths_create() makes them; its source is the number of the
/// last point. Where a piece does not reach its point the path ends, and hp_path_info tells.
///
/// options: as for hp_mesh_paths_create().
///
/// # Safety
/// As hp_mesh_paths_create().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_paths_through(
    solver: *const hp_mesh_solver,
    points: *const hp_surface_points,
    options: *const hp_mesh_options,
    paths: *mut *mut hp_paths,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        let (tracer, points) = unsafe {
            let tracer = Tracer::read(solver, options)?;
            let points = read_points(&tracer.prepared.surface, points, ["point", "points"])?;
            (tracer, points)
        };
        if points.len() < 2 {
            return Err(Failure::argument("points: a path needs at least two"));
        }
        let path = tracer.through(&points)?;
        tracer.settings.run.finish()?;
        Ok(hp_paths { paths: vec![path.traced()] })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(paths, "paths", make) })
}

/// Finds the curves along which a function of the vertices has one of some values.
///
/// values: the function, one value for each vertex, finite or infinite where it has none; linear on
/// each face.
///
/// levels: the values to look for; finite.
///
/// isolines: receives the curves, those of the first level first, to be freed with hp_paths_free(),
/// or NULL if anything but HP_OK is returned. There can be any number for a level. Of
/// hp_path_info, ending is HP_ENDED_CLOSED, where the last point is joined to the first, or
/// HP_ENDED_OPEN; source is the number of the level, and distance the level.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create(). The lists are as large as their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_isolines_create(
    mesh: *const hp_mesh,
    values: *const hp_array,
    levels: *const hp_array,
    isolines: *mut *mut hp_paths,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        let (surface, values, levels) =
            unsafe { (surface_of(mesh)?, reals(values, "values")?, reals(levels, "levels")?) };
        let missing = |name: &str| Failure::argument(format!("{name} is NULL"));
        let values = surface.own_values(&values.ok_or_else(|| missing("values"))?)?;
        let levels = levels.ok_or_else(|| missing("levels"))?;
        if let Some(number) = levels.iter().position(|level| !level.is_finite()) {
            let level = levels[number];
            let message = format!("levels: level {number} is {level}; it must be finite");
            return Err(Failure::argument(message));
        }
        Ok(hp_paths { paths: curves(surface.mesh(), &values, &levels)? })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(isolines, "isolines", make) })
}

fn curves(mesh: &TriMesh, values: &[f64], levels: &[f64]) -> Result<Vec<Traced>, Failure> {
    let found =
        isolines(mesh, values, levels).map_err(|error| Failure::from(error).of("values"))?;
    let mut curves = Vec::new();
    for (number, (lines, &level)) in found.iter().zip(levels).enumerate() {
        curves.extend(lines.iter().map(|line| {
            let ending = if line.is_closed { HP_ENDED_CLOSED } else { HP_ENDED_OPEN };
            curve(mesh, &line.points, (ending, number as i64), level)
        }));
    }
    Ok(curves)
}

/// A curve that is no path.
pub(super) fn curve(
    mesh: &TriMesh,
    places: &[SurfacePoint],
    (ending, source): (u32, i64),
    distance: f64,
) -> Traced {
    let positions: Vec<_> = places.iter().map(|point| mesh.position(point)).collect();
    let around = positions.first().filter(|_| ending == HP_ENDED_CLOSED);
    let closed: Vec<_> = positions.iter().chain(around).copied().collect();
    let length = length(&closed);
    let places = places.to_vec();
    Leg { positions, places, ending, source, length, distance }.traced()
}

/// A path, or a piece of one, as the caller sees it.
struct Leg {
    positions: Vec<[f64; 3]>,
    places: Vec<SurfacePoint>,
    ending: u32,
    source: i64,
    length: f64,
    distance: f64,
}

impl Leg {
    fn traced(self) -> Traced {
        let Self { positions, places, ending, source, length, distance } = self;
        let point_count = positions.len() as u64;
        let lengths = hp_path_info { length, physical_length: length, ..hp_path_info::defaults() };
        let info = hp_path_info { ending, source, point_count, distance, ..lengths };
        Traced { info, coordinates: positions.as_flattened().to_vec(), places }
    }
}

/// What traces paths.
struct Tracer<'a> {
    prepared: &'a Prepared,
    settings: Settings,
}

impl Tracer<'_> {
    /// # Safety
    /// As [`hp_mesh_paths_create`].
    unsafe fn read(
        solver: *const hp_mesh_solver,
        options: *const hp_mesh_options,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let (solver, settings) = unsafe { (borrow(solver, "solver")?, Settings::read(options)?) };
        let prepared = &solver.prepared;
        if settings.shortens && !prepared.is_uniform {
            let message = "options: shorten is for HP_MESH_UNIFORM; in other media the shortest \
                           path is not the nearest";
            return Err(Failure::argument(message));
        }
        Ok(Self { prepared, settings })
    }

    /// Traces paths to `sources`.
    fn legs(
        &self,
        sources: &Sources,
        ends: &[SurfacePoint],
        exec: &Exec,
    ) -> Result<Vec<Leg>, Failure> {
        let (_, paths) = self.prepared.geodesics.paths(sources, ends, exec)?;
        paths.into_iter().map(|path| self.leg(sources, path)).collect()
    }

    fn leg(&self, sources: &Sources, path: Path) -> Result<Leg, Failure> {
        if path.distance.is_finite() && path.distance > self.prepared.farthest {
            // The source lies on the same face.
            return Ok(Leg::none(self.mesh(), path.points[0], HP_ENDED_NOT_REACHED));
        }
        let (ending, source) = match path.ending {
            Ending::Source(label) => (HP_ENDED_SOURCE, i64::from(label)),
            Ending::Stuck => (HP_ENDED_STEP_LIMIT, -1),
            Ending::Unreachable if self.is_far(sources, &path) => (HP_ENDED_NOT_REACHED, -1),
            Ending::Unreachable => (HP_ENDED_UNREACHABLE, -1),
        };
        let path = if self.settings.shortens { shorten(self.mesh(), &path)? } else { path };
        let Path { positions, points: places, length, distance, .. } = path;
        Ok(Leg { positions, places, ending, source, length, distance })
    }

    fn mesh(&self) -> &TriMesh {
        self.prepared.surface.mesh()
    }

    /// Whether a source would be reached if distances, or the time of heat, did not end.
    fn is_far(&self, sources: &Sources, path: &Path) -> bool {
        let is_explicit = self.prepared.geodesics.method() == Method::Explicit;
        if self.prepared.farthest == f64::INFINITY && !is_explicit {
            return false;
        }
        let mesh = self.mesh();
        let components = mesh.adjacency().components();
        let of = |point: &SurfacePoint| components[mesh.faces()[point.face as usize][0] as usize];
        sources.list().iter().any(|source| of(&source.point) == of(&path.points[0]))
    }

    fn through(&self, points: &[SurfacePoint]) -> Result<Leg, Failure> {
        let (mesh, count) = (self.mesh(), points.len() - 1);
        let mut whole = Leg { distance: 0.0, ..Leg::none(mesh, points[0], HP_ENDED_SOURCE) };
        let exec = self.settings.run.exec()?;
        for (pair, round) in points.windows(2).zip(rounds(&exec, count, 1)) {
            let (_, exec) = round?;
            let sources = Sources::new(mesh, &pair[1..])?;
            for leg in self.legs(&sources, &pair[..1], &exec)? {
                whole = whole.then(&leg);
            }
            if whole.ending != HP_ENDED_SOURCE {
                return Ok(whole);
            }
        }
        Ok(Leg { source: count as i64, ..whole })
    }
}

impl Leg {
    /// A path that leads nowhere.
    fn none(mesh: &TriMesh, place: SurfacePoint, ending: u32) -> Self {
        let (positions, places) = (vec![mesh.position(&place)], vec![place]);
        Self { positions, places, ending, source: -1, length: 0.0, distance: f64::INFINITY }
    }

    /// This one and the one that begins where it ends.
    fn then(mut self, next: &Self) -> Self {
        self.positions.extend(&next.positions[1..]);
        self.places.extend(&next.places[1..]);
        let (ending, source) = (next.ending, next.source);
        let (length, distance) = (self.length + next.length, self.distance + next.distance);
        Self { ending, source, length, distance, ..self }
    }
}
