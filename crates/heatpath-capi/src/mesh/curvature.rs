//! The curvature of meshes.

use super::handle::{hp_mesh, surface_of};
use super::options::hp_mesh_options;
use super::places::optional;
use super::settings::Settings;
use crate::array::hp_array;
use crate::status::{guard, hp_status};
use heatpath_core::mesh::Curvature;

/// Computes the principal curvatures at each vertex, in 1 / unit of the points: positive where the
/// surface is convex as seen from outside, where faces are counter-clockwise.
///
/// options: curvature, radius, threads and progress count. NULL for the defaults.
///
/// smallest, largest: receive the smaller and the larger one, with their signs; one number for each
/// vertex, HP_F32 or HP_F64. NULL for what is not wanted.
///
/// smallest_directions, largest_directions: receive the unit tangents in which the surface bends so,
/// x, y, z for each vertex; zero where there is no tangent plane. A crease runs along the direction
/// of the curvature of smaller size. NULL for what is not wanted.
///
/// # Safety
/// `mesh` is NULL or comes from hp_mesh_create(). The structs are as large as their `struct_size`
/// says, and lists are as large as their description. The results are not used by another thread
/// meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_curvature(
    mesh: *const hp_mesh,
    options: *const hp_mesh_options,
    smallest: *const hp_array,
    largest: *const hp_array,
    smallest_directions: *const hp_array,
    largest_directions: *const hp_array,
) -> hp_status {
    // SAFETY: the caller's promise; types and counts of results are checked.
    guard(|| unsafe {
        let (surface, settings) = (surface_of(mesh)?, Settings::read(options)?);
        let count = surface.vertex_count();
        let values = [
            optional::<1>(smallest, "smallest", false, count)?,
            optional::<1>(largest, "largest", false, count)?,
        ];
        let directions = [
            optional::<3>(smallest_directions, "smallest_directions", false, count)?,
            optional::<3>(largest_directions, "largest_directions", false, count)?,
        ];
        let exec = settings.run.exec()?;
        let curvature = Curvature::new(surface.mesh(), settings.curvature, &exec)?;
        settings.run.finish()?;
        let vertices = curvature.vertices();
        for (place, target) in values.iter().enumerate() {
            if let Some(target) = target {
                target.write(0, surface.in_order(|own| [vertices[own].values[place]]));
            }
        }
        for (place, target) in directions.iter().enumerate() {
            if let Some(target) = target {
                target.write(0, surface.in_order(|own| vertices[own].directions[place]));
            }
        }
        Ok(())
    })
}
