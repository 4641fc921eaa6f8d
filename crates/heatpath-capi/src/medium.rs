//! The medium alone, to look at.

use crate::buffer::hp_buffer;
use crate::options::hp_options;
use crate::pixels;
use crate::problem::read_points;
use crate::scene::Scene;
use crate::settings::Settings;
use crate::status::{Failure, guard, hp_status};
use crate::view::{self, View};
use heatpath_core::grid::check_points;

/// Writes the medium that the options make of an image, without letting heat flow in it.
///
/// image, mask, sources, source_count and options are those of hp_distance(). Sources are needed only
/// by HP_MEDIUM_CONDUCTIVITY and HP_MEDIUM_COMBINED without a reference; else they may be NULL.
///
/// squared_speed: receives k D, the square of the speed; of the same size, HP_F32 or HP_F64. Where D is
/// a matrix it is the geometric mean over its principal directions. 0 in walls.
///
/// # Safety
/// As hp_distance().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_medium(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    sources: *const f64,
    source_count: u64,
    options: *const hp_options,
    squared_speed: *const hp_buffer,
) -> hp_status {
    let scene = (image, mask, options);
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        match view::dimension(image)? {
            2 => write::<2>(scene, &read_points(sources, source_count, "sources")?, squared_speed),
            _ => write::<3>(scene, &read_points(sources, source_count, "sources")?, squared_speed),
        }
    })
}

/// # Safety
/// As [`hp_medium`].
unsafe fn write<const D: usize>(
    (image, mask, options): (*const hp_buffer, *const hp_buffer, *const hp_options),
    sources: &[[f64; D]],
    squared_speed: *const hp_buffer,
) -> Result<(), Failure> {
    // SAFETY: the caller's promise, for each of the pointers.
    let (target, image, settings) = unsafe {
        let target = View::<D>::read(squared_speed, "squared_speed")?;
        (target, View::<D>::read(image, "image")?, Settings::read(options)?)
    };
    pixels::check_writable(&target)?;
    target.check_size(&image.shape)?;
    // SAFETY: the caller's promise.
    let scene = unsafe { Scene::read(&image, mask, &settings)? };
    if !sources.is_empty() {
        check_points("source", sources, &scene.mask)?;
    }
    let medium = scene.medium(&settings.recipe, sources, &settings.run.exec()?)?;
    settings.run.finish()?;
    // SAFETY: the caller promises that the pixels can be written; their type was checked.
    unsafe { pixels::write(&target, medium.speed_sq_field().values()) };
    Ok(())
}
