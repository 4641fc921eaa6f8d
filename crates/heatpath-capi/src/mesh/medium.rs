//! What makes ways short on a mesh.

use super::settings::{Recipe, Settings};
use super::surface::Surface;
use crate::array::hp_array;
use crate::items::Items;
use crate::numbers::reals;
use crate::status::Failure;
use heatpath_core::Exec;
use heatpath_core::mesh::{Curvature, Medium};
use std::sync::Arc;

/// Makes the medium that the options ask for.
///
/// # Safety
/// The values of the settings are NULL, misaligned, or point to the description of readable items.
pub(crate) unsafe fn read_medium(
    surface: &Surface,
    settings: &Settings,
    exec: &Exec,
) -> Result<Medium, Failure> {
    let mesh = Arc::clone(surface.mesh());
    // SAFETY: the caller's promise.
    let of_vertices = |values| unsafe { surface.own_values(&read_values(values)?) };
    let medium = match settings.recipe {
        Recipe::Uniform => return Ok(Medium::uniform(mesh)?),
        Recipe::Curvature(options) => {
            let medium = Medium::curvature(mesh, &curvature(surface, settings, exec)?, options);
            return medium.map_err(|error| Failure::from(error).of("options"));
        }
        Recipe::Crease(options) => {
            let medium = Medium::crease(mesh, &curvature(surface, settings, exec)?, options);
            return medium.map_err(|error| Failure::from(error).of("options"));
        }
        Recipe::SpeedSq(values) => Medium::given(mesh, &of_vertices(values)?),
        Recipe::Scalars(values, reference, options) => {
            Medium::scalars(mesh, &of_vertices(values)?, &[reference], options)
        }
        // SAFETY: the caller's promise.
        Recipe::Slowness(values) => Medium::given_slowness(mesh, &unsafe { read_values(values)? }),
        // SAFETY: the caller's promise.
        Recipe::Metric(values) => Medium::tensor(mesh, &unsafe { read_metrics(values)? }),
    };
    medium.map_err(|error| Failure::from(error).of("values"))
}

fn curvature(surface: &Surface, settings: &Settings, exec: &Exec) -> Result<Curvature, Failure> {
    Ok(Curvature::new(surface.mesh(), settings.curvature, exec)?)
}

/// # Safety
/// `values` is NULL, misaligned, or points to the description of readable items.
unsafe fn read_values(values: *const hp_array) -> Result<Vec<f64>, Failure> {
    // SAFETY: the caller's promise.
    unsafe { reals(values, "values")? }.ok_or_else(missing)
}

/// # Safety
/// As [`read_values`].
unsafe fn read_metrics(values: *const hp_array) -> Result<Vec<[[f64; 3]; 3]>, Failure> {
    if values.is_null() {
        return Err(missing());
    }
    // SAFETY: the caller's promise.
    let values = unsafe { Items::<6>::read(values, "values")?.values()? };
    let matrix = |[xx, xy, xz, yy, yz, zz]: [f64; 6]| [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    Ok(values.into_iter().map(matrix).collect())
}

fn missing() -> Failure {
    Failure::argument("options: values is NULL, but the medium is made from them")
}
