//! Points and curves by faces and weights, which hp_surface_points takes.

use super::handle::{hp_mesh, surface_of};
use super::paths::curve;
use super::points::{hp_surface_points, read_points};
use crate::array::hp_array;
use crate::handles::hand_out;
use crate::items::Items;
use crate::paths::{HP_ENDED_CLOSED, hp_paths, one_of};
use crate::status::{Failure, guard, hp_status};
use heatpath_core::mesh::SurfacePoint;
use heatpath_core::mesh::path::shorten_loop;

/// Tells where points lie on the surface of a mesh: of positions in space the nearest point of it.
///
/// points: see hp_surface_points; no curve.
///
/// faces: receives the number of a face for each point; HP_I32, HP_U32, HP_I64 or HP_U64. NULL if it
/// is not wanted.
///
/// weights: receives the weights of the three corners of that face; HP_F32 or HP_F64. NULL if they are
/// not wanted.
///
/// positions: receives x, y, z in space; HP_F32 or HP_F64. NULL if they are not wanted.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create(). The structs are as large as their `struct_size`
/// says, and lists are as large as their description. The results are not used by another thread
/// meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_locate(
    mesh: *const hp_mesh,
    points: *const hp_surface_points,
    faces: *const hp_array,
    weights: *const hp_array,
    positions: *const hp_array,
) -> hp_status {
    // SAFETY: the caller's promise; types and counts of results are checked.
    guard(|| unsafe {
        let surface = surface_of(mesh)?;
        let points = read_points(surface, points, ["point", "points"])?;
        let target = Target::read((faces, weights), points.len())?;
        let positions = optional(positions, "positions", false, points.len())?;
        target.write(&points);
        if let Some(positions) = positions {
            positions.write(0, points.iter().map(|point| surface.mesh().position(point)));
        }
        Ok(())
    })
}

/// Copies the points of a path or curve on a mesh as places on its faces, which hp_surface_points
/// takes again.
///
/// faces, weights: as for hp_mesh_locate(), hp_path_info.point_count items each.
///
/// # Safety
/// `paths` is NULL or comes from one of the functions that make paths; the lists are as large as
/// their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_paths_places(
    paths: *const hp_paths,
    index: u64,
    faces: *const hp_array,
    weights: *const hp_array,
) -> hp_status {
    // SAFETY: the caller's promise; types and counts of results are checked.
    guard(|| unsafe {
        let path = one_of(paths, index)?;
        if path.places.is_empty() {
            let message = format!("paths: path {index} lies on an image, which has no faces");
            return Err(Failure::argument(message));
        }
        Target::read((faces, weights), path.places.len())?.write(&path.places);
        Ok(())
    })
}

/// Makes a closed curve on a mesh locally shortest: a closed geodesic, such as around a handle or a
/// neck.
///
/// points: the curve, by its points in their order; two neighbours share a face, and so do the last
/// and the first. hp_paths_places() gives such points of an isoline, or of a path through points that
/// comes back to its first one.
///
/// loops: receives one curve, whose ending is HP_ENDED_CLOSED, or none if it contracts to a point; to
/// be freed with hp_paths_free(), or NULL if anything but HP_OK is returned.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create(). The structs are as large as their `struct_size`
/// says, and lists are as large as their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_loop_create(
    mesh: *const hp_mesh,
    points: *const hp_surface_points,
    loops: *mut *mut hp_paths,
) -> hp_status {
    let make = || {
        // SAFETY: the caller's promise.
        let (surface, points) = unsafe {
            let surface = surface_of(mesh)?;
            (surface, read_points(surface, points, ["point", "points"])?)
        };
        let shortest = shorten_loop(surface.mesh(), &points);
        let shortest = shortest.map_err(|error| Failure::from(error).of("points"))?;
        let closed = (HP_ENDED_CLOSED, -1);
        let traced = shortest.map(|places| curve(surface.mesh(), &places, closed, f64::INFINITY));
        Ok(hp_paths { paths: traced.into_iter().collect() })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(loops, "loops", make) })
}

/// The caller's lists for faces and weights.
struct Target {
    faces: Option<Items<1>>,
    weights: Option<Items<3>>,
}

impl Target {
    /// # Safety
    /// The pointers are NULL, misaligned, or point to descriptions.
    unsafe fn read(
        (faces, weights): (*const hp_array, *const hp_array),
        count: usize,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        unsafe {
            let faces = optional(faces, "faces", true, count)?;
            Ok(Self { faces, weights: optional(weights, "weights", false, count)? })
        }
    }

    /// # Safety
    /// The items can be written.
    unsafe fn write(&self, points: &[SurfacePoint]) {
        // SAFETY: the caller's promise.
        unsafe {
            if let Some(faces) = &self.faces {
                faces.write_integers(0, points.iter().map(|point| [point.face as i32]));
            }
            if let Some(weights) = &self.weights {
                weights.write(0, points.iter().map(|point| point.weights));
            }
        }
    }
}

/// The list for a result that may not be wanted.
///
/// # Safety
/// `array` is NULL, misaligned, or points to a description.
pub(super) unsafe fn optional<const N: usize>(
    array: *const hp_array,
    name: &'static str,
    integers: bool,
    count: usize,
) -> Result<Option<Items<N>>, Failure> {
    if array.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    Ok(Some(unsafe { Items::target(array, name, integers, count, (1, 0))? }))
}
