//! Media prepared for many sources.

use crate::buffer::hp_buffer;
use crate::handles::{free, hand_out};
use crate::options::hp_options;
use crate::paths::{Traced, hp_paths, trace_prepared};
use crate::pixels;
use crate::prepared::Prepared;
use crate::problem::read_points;
use crate::run::rounds;
use crate::scene::{MEDIUM_SHARE, Scene};
use crate::settings::Settings;
use crate::status::{Failure, guard, hp_status};
use crate::view::{self, View};
use heatpath_core::grid::{Sources, check_points};

/// A medium prepared for distances and paths from any sources.
///
/// Made by hp_solver_create() and freed by hp_solver_free(). It does not change, so any number of
/// threads may use it at once, and any thread may free it once the others are done.
pub struct hp_solver {
    pub(crate) medium: AnyDimension,
}

pub(crate) enum AnyDimension {
    Two(Prepared<'static, 2>),
    Three(Prepared<'static, 3>),
}

/// Works with the medium of a solver, whatever its dimension.
macro_rules! in_medium {
    ($solver:expr, $prepared:ident => $work:expr) => {
        match &$crate::handles::borrow($solver, "solver")?.medium {
            $crate::solver::AnyDimension::Two($prepared) => $work,
            $crate::solver::AnyDimension::Three($prepared) => $work,
        }
    };
}
pub(crate) use in_medium;

/// Prepares distances from sources that are not known yet; with HP_SOLVER_IMPLICIT, analyses and
/// factors the system.
///
/// image and mask are those of hp_distance(). They are not needed any more when this returns.
///
/// options: those of hp_distance(), but HP_MEDIUM_CONDUCTIVITY, the default, and
/// HP_MEDIUM_COMBINED need a reference, so NULL will not do. Of the estimator it counts whether it
/// is HP_EIKONAL, HP_HEAT_METHOD or another: a solver gives distances of its own kind only.
///
/// solver: receives the solver, to be freed with hp_solver_free(), or NULL if anything but HP_OK is
/// returned. HP_OUT_OF_MEMORY means that the image is too large for HP_SOLVER_IMPLICIT; the
/// message names the memory that it needs.
///
/// # Safety
/// The structs are as large as their `struct_size` says, and buffers are as large as their
/// description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_solver_create(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    options: *const hp_options,
    solver: *mut *mut hp_solver,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        let medium = unsafe {
            match view::dimension(image)? {
                2 => AnyDimension::Two(prepare(image, mask, options)?),
                _ => AnyDimension::Three(prepare(image, mask, options)?),
            }
        };
        Ok(hp_solver { medium })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(solver, "solver", make) })
}

/// # Safety
/// As [`hp_solver_create`].
unsafe fn prepare<const D: usize>(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    options: *const hp_options,
) -> Result<Prepared<'static, D>, Failure> {
    // SAFETY: the caller's promise.
    unsafe {
        let settings = Settings::read(options)?;
        let image = View::read(image, "image")?;
        let scene = Scene::read(&image, mask, &settings)?;
        let exec = settings.run.exec()?;
        let medium = scene.medium(&settings.recipe, &[], &exec.part(0.0, MEDIUM_SHARE))?;
        let rest = exec.part(MEDIUM_SHARE, 1.0);
        let prepared = Prepared::new(medium, settings.approach, &rest)?;
        settings.run.finish()?;
        Ok(prepared)
    }
}

/// Computes the distance of every pixel from each of several sources: one map for each of them.
///
/// sources: source_count points, as for hp_distance().
///
/// options: only estimator, threads, progress and user count here, and of a solver made with
/// HP_EIKONAL or HP_HEAT_METHOD the estimator does not; the rest was fixed when the solver was made. NULL
/// for the defaults. With HP_SOLVER_IMPLICIT sources are shared between the threads; the results do not
/// depend on how many there are.
///
/// distances: describes the first map, as for hp_distance().
///
/// map_stride: the bytes from the first pixel of a map to that of the next one; negative if that
/// lies before it. 0 means that maps follow each other without gaps. Maps must not lie in one
/// another.
///
/// If the call is cancelled some of the maps may have been written; after any other failure none
/// was.
///
/// # Safety
/// `solver` is NULL or comes from hp_solver_create() and was not freed yet. The structs are as
/// large as their `struct_size` says, and the maps and points are as large as their description.
/// The results are not used by another thread meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_solver_distances(
    solver: *const hp_solver,
    sources: *const f64,
    source_count: u64,
    options: *const hp_options,
    distances: *const hp_buffer,
    map_stride: i64,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let settings = Settings::read(options)?;
        in_medium!(solver, prepared => {
            let points = read_points(sources, source_count, "sources")?;
            write_maps(prepared, &points, &settings, (distances, map_stride))
        })
    })
}

/// # Safety
/// As [`hp_solver_distances`].
unsafe fn write_maps<const D: usize>(
    prepared: &Prepared<D>,
    points: &[[f64; D]],
    settings: &Settings,
    (distances, map_stride): (*const hp_buffer, i64),
) -> Result<(), Failure> {
    // SAFETY: the caller's promise.
    let first = unsafe { View::<D>::read(distances, "distances")? };
    pixels::check_writable(&first)?;
    first.check_size(prepared.medium().shape())?;
    let stride = first.map_stride(map_stride, points.len()).map_err(|f| f.of("distances"))?;
    let sources = Sources::new(points, prepared.medium().mask())?.each();
    // === A few at a time, so that they need little memory
    let exec = settings.run.exec()?;
    for round in rounds(&exec, sources.len(), prepared.round(exec.threads())) {
        let (places, exec) = round?;
        let maps = prepared.solve_each(&sources[places.clone()], settings.readout, &exec)?;
        for (place, map) in places.zip(&maps) {
            // SAFETY: the caller promises that the pixels can be written; their type was checked,
            // and that all maps lie within memory.
            unsafe { pixels::write(&first.moved(stride * place as isize), map.field().values()) };
        }
    }
    settings.run.finish()
}

/// Traces the minimal path from each end point to a source, as hp_paths_create() does, in a medium that
/// was prepared once.
///
/// sources, ends: source_count and end_count points, as for hp_paths_create().
///
/// options: as for hp_solver_distances().
///
/// paths: receives the paths, to be freed with hp_paths_free(), or NULL if anything but HP_OK is
/// returned.
///
/// # Safety
/// `solver` is NULL or comes from hp_solver_create() and was not freed yet. The structs are as
/// large as their `struct_size` says, and the points are as large as their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_solver_paths_create(
    solver: *const hp_solver,
    sources: *const f64,
    source_count: u64,
    ends: *const f64,
    end_count: u64,
    options: *const hp_options,
    paths: *mut *mut hp_paths,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        let paths = unsafe {
            let settings = Settings::read(options)?;
            in_medium!(solver, prepared => {
                let points = read_points(sources, source_count, "sources")?;
                trace(prepared, &points, &read_points(ends, end_count, "ends")?, &settings)?
            })
        };
        Ok(hp_paths { paths })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(paths, "paths", make) })
}

fn trace<const D: usize>(
    prepared: &Prepared<D>,
    sources: &[[f64; D]],
    ends: &[[f64; D]],
    settings: &Settings,
) -> Result<Vec<Traced>, Failure> {
    let mask = prepared.medium().mask();
    let sources = Sources::new(sources, mask)?;
    check_points("end", ends, mask)?;
    trace_prepared(prepared, &sources, ends, settings, &settings.run.exec()?)
}

/// Frees a solver; NULL is fine.
///
/// # Safety
/// `solver` is NULL or comes from hp_solver_create() and was not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_solver_free(solver: *mut hp_solver) {
    // SAFETY: the caller's promise.
    guard(|| unsafe { free(solver, "solver") });
}

#[cfg(test)]
mod tests {
    use super::hp_solver;

    #[test]
    fn threads_may_share_a_solver() {
        fn shared<T: Send + Sync>() {}
        shared::<hp_solver>();
    }
}
