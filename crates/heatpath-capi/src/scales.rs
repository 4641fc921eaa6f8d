//! The widths of tubes, from the image.

use crate::buffer::hp_buffer;
use crate::options::hp_options;
use crate::recipe::Recipe;
use crate::scene::Scene;
use crate::settings::Settings;
use crate::status::{Failure, HP_NO_ANSWER, guard, hp_status};
use crate::view::{self, View};
use heatpath_core::grid::{Structure, tube_scales};

/// The most scales that hp_tube_scales() finds.
pub const HP_MOST_TUBE_SCALES: u64 = 3;

/// Finds the scales for HP_MEDIUM_VESSELNESS from the tubes that the image shows.
///
/// Tubes are looked for at scales from 1 to an eighth of the shortest side. Along the middle of what is
/// long and strong each pixel votes for the scale of its strongest response; the scales have a sixth, a half
/// and five sixths of the votes below them. Uneven light looks like a wide tube: set hp_options.normalize.
///
/// image, mask and options are those of hp_distance(). The medium must be HP_MEDIUM_VESSELNESS; its polarity
/// counts, its scales do not.
///
/// scales: room for HP_MOST_TUBE_SCALES numbers. Receives the scales in ascending order, to be set as
/// hp_options.scales; need not be aligned.
///
/// count: receives how many there are, from 1. Need not be aligned.
///
/// HP_NO_ANSWER is returned if the image shows nothing long.
///
/// # Safety
/// As hp_distance(). scales and count must be NULL or point to memory that can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_tube_scales(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    options: *const hp_options,
    scales: *mut f64,
    count: *mut u64,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        if scales.is_null() || count.is_null() {
            return Err(Failure::argument("scales or count is NULL"));
        }
        let found = match view::dimension(image)? {
            2 => find::<2>(image, mask, options)?,
            _ => find::<3>(image, mask, options)?,
        };
        let most = HP_MOST_TUBE_SCALES as usize;
        for (number, &scale) in found.iter().enumerate().take(most) {
            scales.add(number).write_unaligned(scale);
        }
        count.write_unaligned(found.len().min(most) as u64);
        Ok(())
    })
}

/// # Safety
/// As [`hp_tube_scales`].
unsafe fn find<const D: usize>(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    options: *const hp_options,
) -> Result<Vec<f64>, Failure> {
    // SAFETY: the caller's promise, for each of the pointers.
    let (image, settings) = unsafe { (View::<D>::read(image, "image")?, Settings::read(options)?) };
    let Recipe::Vesselness(vesselness) = &settings.recipe else {
        return Err(Failure::argument("options: medium must be HP_MEDIUM_VESSELNESS"));
    };
    // SAFETY: the caller's promise.
    let scene = unsafe { Scene::read(&image, mask, &settings)? };
    let exec = settings.run.exec()?;
    let grey = scene.grey(&exec.part(0.0, 0.3))?;
    let extent = Structure::usual_extent(&image.shape);
    let exec = exec.part(0.3, 1.0);
    let found = tube_scales(&grey, &vesselness.tubes, &scene.mask, extent, &exec);
    let found = found.map_err(|error| Failure::from(error).of("options"))?;
    settings.run.finish()?;
    found.ok_or_else(|| {
        let message = format!("the image shows no tube that is {extent:.1} pixels long");
        Failure::new(HP_NO_ANSWER, message)
    })
}
