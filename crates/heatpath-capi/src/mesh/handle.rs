//! Meshes.

use super::options::hp_mesh_options;
use super::report::hp_mesh_report;
use super::settings::Settings;
use super::surface::Surface;
use crate::array::hp_array;
use crate::handles::{borrow, free, hand_out};
use crate::items::Items;
use crate::status::{Failure, guard, hp_status};
use crate::structs;
use std::sync::Arc;

/// A triangle mesh: a copy of the caller's points and faces, cleaned.
///
/// Made by hp_mesh_create() and freed by hp_mesh_free(), even while solvers that were made from it
/// live on. It does not change, so any number of threads may use it at once, and any thread may free
/// it once the others are done.
pub struct hp_mesh {
    pub(crate) surface: Arc<Surface>,
}

/// Makes a mesh from the caller's points and faces, which are not needed any more when this returns.
///
/// Vertices are always those of the caller, counted from 0: all results have one number for each of
/// them, also if some were joined. Borders, edges with more than two faces, several components,
/// faces of any orientation and vertices without faces are all fine. Faces with the same vertex
/// twice, and all but the first of faces with the same three vertices, are dropped. Faces are
/// counted in the mesh: if some were dropped or cut, hp_mesh_faces() tells which there are.
///
/// points: x, y, z of each vertex, finite, up to 1e100; any type.
///
/// faces: three vertices each, counter-clockwise as seen from outside; any type of integers. With
/// `starts`, one vertex each: the corners of all polygons, one polygon after the other.
///
/// starts: NULL for triangles. For polygons, where the corners of each one begin in faces, and,
/// last, where those of the last one end: one more number than there are polygons (the offsets of a
/// vtkCellArray). Polygons are cut into triangles.
///
/// options: weld counts. NULL for the defaults.
///
/// mesh: receives the mesh, to be freed with hp_mesh_free(), or NULL if anything but HP_OK is
/// returned.
///
/// # Safety
/// The structs are as large as their `struct_size` says, and lists are as large as their
/// description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_create(
    points: *const hp_array,
    faces: *const hp_array,
    starts: *const hp_array,
    options: *const hp_mesh_options,
    mesh: *mut *mut hp_mesh,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        unsafe {
            let settings = Settings::read(options)?;
            let surface = Surface::read(points, faces, starts, settings.clean)?;
            settings.run.finish()?;
            Ok(hp_mesh { surface: Arc::new(surface) })
        }
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(mesh, "mesh", make) })
}

/// Frees a mesh; NULL is fine.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create() and was not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_free(mesh: *mut hp_mesh) {
    // SAFETY: the caller's promise.
    guard(|| unsafe { free(mesh, "mesh") });
}

/// Writes what a mesh is like to *report, whose struct_size must be set.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create(); `report` is NULL or points to as many bytes as
/// its `struct_size` says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_describe(
    mesh: *const hp_mesh,
    report: *mut hp_mesh_report,
) -> hp_status {
    guard(|| {
        // SAFETY: the caller's promise.
        unsafe { structs::answer(report, &surface_of(mesh)?.report(), "report") }
    })
}

/// Copies the faces of a mesh.
///
/// faces: receives the three vertices of each face; hp_mesh_report.faces items of HP_I32, HP_U32,
/// HP_I64 or HP_U64. Of joined vertices it is the first one.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create(); the list is as large as its description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_faces(mesh: *const hp_mesh, faces: *const hp_array) -> hp_status {
    guard(|| {
        // SAFETY: the caller's promise; type and count are checked.
        unsafe {
            let surface = surface_of(mesh)?;
            let count = surface.mesh().faces().len();
            let target = Items::<3>::target(faces, "faces", true, count, (1, 0))?;
            target.write_integers(0, surface.faces());
        }
        Ok(())
    })
}

/// # Safety
/// `mesh` is NULL or points to a mesh that lives as long as it is borrowed.
pub(crate) unsafe fn surface_of<'a>(mesh: *const hp_mesh) -> Result<&'a Arc<Surface>, Failure> {
    // SAFETY: the caller's promise.
    Ok(unsafe { &borrow(mesh, "mesh")?.surface })
}

#[cfg(test)]
mod tests {
    use super::hp_mesh;

    #[test]
    fn threads_may_share_a_mesh() {
        fn shared<T: Send + Sync>() {}
        shared::<hp_mesh>();
    }
}
