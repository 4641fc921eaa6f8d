//! Distances on meshes, prepared for many sources.

use super::handle::{hp_mesh, surface_of};
use super::options::{
    HP_MESH_EIKONAL, HP_MESH_EXACT, HP_MESH_EXPLICIT, HP_MESH_HEAT, hp_mesh_options,
};
use super::points::{hp_surface_points, read_sets};
use super::prepared::Prepared;
use super::settings::Settings;
use crate::array::hp_array;
use crate::handles::{borrow, free, hand_out};
use crate::items::Items;
use crate::run::rounds;
use crate::status::{Failure, guard, hp_status};
use crate::structs::check_pointer;
use heatpath_core::mesh::distance::{DistanceMap, NO_LABEL, NOT_REACHED};
use heatpath_core::mesh::{Method, Sources};

/// A medium on a mesh, prepared for distances and paths from any sources.
///
/// Made by hp_mesh_solver_create() and freed by hp_mesh_solver_free(). It does not change, so any
/// number of threads may use it at once, and any thread may free it once the others are done.
pub struct hp_mesh_solver {
    pub(crate) prepared: Prepared,
}

/// Prepares distances on a mesh from sources that are not known yet; with HP_MESH_HEAT, analyses and
/// factors the systems.
///
/// mesh: may be freed before the solver.
///
/// options: all but weld and shorten count. NULL for the defaults.
///
/// solver: receives the solver, to be freed with hp_mesh_solver_free(), or NULL if anything but
/// HP_OK is returned. HP_OUT_OF_MEMORY means that the mesh is too large for HP_MESH_HEAT; the
/// message names the memory that it needs.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create(). The structs are as large as their `struct_size`
/// says, and lists are as large as their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_solver_create(
    mesh: *const hp_mesh,
    options: *const hp_mesh_options,
    solver: *mut *mut hp_mesh_solver,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        let (settings, surface) = unsafe { (Settings::read(options)?, surface_of(mesh)?) };
        // SAFETY: the caller's promise.
        let prepared = unsafe { Prepared::new(surface, &settings)? };
        settings.run.finish()?;
        Ok(hp_mesh_solver { prepared })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(solver, "solver", make) })
}

/// Frees a solver; NULL is fine.
///
/// # Safety
/// `solver` is NULL or comes from hp_mesh_solver_create() and was not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_solver_free(solver: *mut hp_mesh_solver) {
    // SAFETY: the caller's promise.
    guard(|| unsafe { free(solver, "solver") });
}

/// Writes the method of a solver to *method: HP_MESH_HEAT, HP_MESH_EIKONAL, HP_MESH_EXACT or
/// HP_MESH_EXPLICIT.
///
/// # Safety
/// `solver` is NULL or comes from hp_mesh_solver_create(); `method` is NULL or points to a uint32_t.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_solver_method(
    solver: *const hp_mesh_solver,
    method: *mut u32,
) -> hp_status {
    guard(|| {
        check_pointer(method, "method")?;
        // SAFETY: the caller's promise; the pointers are checked.
        unsafe {
            method.write(match borrow(solver, "solver")?.prepared.geodesics.method() {
                Method::Exact => HP_MESH_EXACT,
                Method::Eikonal => HP_MESH_EIKONAL,
                Method::Explicit => HP_MESH_EXPLICIT,
                _ => HP_MESH_HEAT,
            });
        }
        Ok(())
    })
}

/// Computes the distance of every vertex from the nearest source of a set, for one or more sets.
///
/// sources: the sets of sources, see hp_surface_points.sets.
///
/// options: threads and progress count; the results do not depend on the number of threads. NULL for the defaults.
///
/// distances: receives the distances of the first set, one for each vertex; HP_F32 or HP_F64.
/// Distances are in units of the points times slowness, and infinite where there is no way, beyond
/// hp_mesh_options.farthest, and at vertices that no face uses.
///
/// map_stride: the bytes from the distances of a set to those of the next one. 0 means that they
/// follow each other without gaps.
///
/// labels: receives the label of the nearest source for each vertex, -1 where there is none; HP_I32,
/// HP_U32, HP_I64 or HP_U64, the bits of -1 set in all of them. NULL if they are not wanted.
///
/// label_stride: as map_stride, for labels.
///
/// If the call is cancelled some of the maps may have been written; after any other failure none
/// was.
///
/// # Safety
/// `solver` is NULL or comes from hp_mesh_solver_create(). The structs are as large as their
/// `struct_size` says, and lists are as large as their description. The results are not used by
/// another thread meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_solver_distances(
    solver: *const hp_mesh_solver,
    sources: *const hp_surface_points,
    options: *const hp_mesh_options,
    distances: *const hp_array,
    map_stride: i64,
    labels: *const hp_array,
    label_stride: i64,
) -> hp_status {
    // SAFETY: the caller's promise; types and counts of results are checked.
    guard(|| unsafe {
        let prepared = &borrow(solver, "solver")?.prepared;
        let settings = Settings::read(options)?;
        let sets = read_sets(&prepared.surface, sources)?;
        let count = prepared.surface.vertex_count();
        let rows = (sets.len(), map_stride);
        let distances = Items::<1>::target(distances, "distances", false, count, rows)?;
        let rows = (sets.len(), label_stride);
        let labels = match labels.is_null() {
            true => None,
            false => Some(Items::<1>::target(labels, "labels", true, count, rows)?),
        };
        each_map(prepared, &sets, &settings, |row, map| {
            write_distances(prepared, map, (&distances, row));
            if let Some(labels) = &labels {
                write_labels(prepared, map, (labels, row));
            }
        })
    })
}

/// Computes the distances between all vertices: row i of the matrix holds those from vertex i.
///
/// They are those of hp_mesh_solver_distances() with every vertex as a set; they agree with their
/// counterparts on the other side of the diagonal up to the error of the method.
///
/// options: threads and progress count; the results do not depend on the number of threads. NULL for the defaults.
///
/// distances: receives the first row, one number for each vertex; HP_F32 or HP_F64.
///
/// row_stride: the bytes from a row to the next one. 0 means that rows follow each other without
/// gaps.
///
/// If the call is cancelled a part may have been written; after any other failure nothing was.
///
/// # Safety
/// As hp_mesh_solver_distances().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_solver_matrix(
    solver: *const hp_mesh_solver,
    options: *const hp_mesh_options,
    distances: *const hp_array,
    row_stride: i64,
) -> hp_status {
    // SAFETY: the caller's promise; type and count of the result are checked.
    guard(|| unsafe {
        let prepared = &borrow(solver, "solver")?.prepared;
        let settings = Settings::read(options)?;
        let (surface, count) = (&prepared.surface, prepared.surface.vertex_count());
        let rows = (count, row_stride);
        let target = Items::<1>::target(distances, "distances", false, count, rows)?;
        let (used, unused): (Vec<_>, Vec<_>) = (0..count).partition(|&row| surface.is_used(row));
        let source = |&vertex: &usize| {
            let point = surface.at_vertex("source", vertex, vertex as i128)?;
            Ok(Sources::new(surface.mesh(), &[point])?)
        };
        let sets = used.iter().map(source).collect::<Result<Vec<_>, Failure>>()?;
        let far = || std::iter::repeat_n([NOT_REACHED], count);
        unused.iter().for_each(|&row| target.write(row, far()));
        each_map(prepared, &sets, &settings, |place, map| {
            write_distances(prepared, map, (&target, used[place]));
        })
    })
}

/// So many maps are made together for each thread.
const AT_ONCE: usize = 8;

/// Makes the maps of all sets, a few at a time so that they need little memory.
fn each_map(
    prepared: &Prepared,
    sets: &[Sources],
    settings: &Settings,
    mut write: impl FnMut(usize, &DistanceMap),
) -> Result<(), Failure> {
    let exec = settings.run.exec()?;
    for round in rounds(&exec, sets.len(), AT_ONCE * exec.threads()) {
        let (places, exec) = round?;
        let maps = prepared.geodesics.distances(&sets[places.clone()], &exec)?;
        places.zip(&maps).for_each(|(place, map)| write(place, map));
    }
    settings.run.finish()
}

/// # Safety
/// The items can be written.
unsafe fn write_distances(
    prepared: &Prepared,
    map: &DistanceMap,
    (target, row): (&Items<1>, usize),
) {
    let values = prepared.surface.in_order(|own| [map.values()[own]]);
    // SAFETY: the caller's promise.
    unsafe { target.write(row, values) };
}

/// # Safety
/// The items can be written.
unsafe fn write_labels(prepared: &Prepared, map: &DistanceMap, (target, row): (&Items<1>, usize)) {
    let label = |own: usize| match map.labels()[own] {
        NO_LABEL => -1,
        label => label as i32,
    };
    let labels = prepared.surface.in_order(|own| [label(own)]);
    // SAFETY: the caller's promise.
    unsafe { target.write_integers(row, labels) };
}

#[cfg(test)]
mod tests {
    use super::hp_mesh_solver;

    #[test]
    fn threads_may_share_a_solver() {
        fn shared<T: Send + Sync>() {}
        shared::<hp_mesh_solver>();
    }
}
