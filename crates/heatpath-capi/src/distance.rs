//! Distance maps.

use crate::buffer::hp_buffer;
use crate::options::hp_options;
use crate::pixels;
use crate::problem::{Arguments, Problem};
use crate::settings::Settings;
use crate::status::{Failure, guard, hp_status};
use crate::view::{self, View};

/// Computes the distance of every pixel from the nearest source, by letting heat flow or, with
/// HP_EIKONAL, exactly.
///
/// image: the picture or volume that makes the medium, see hp_options; any type of pixel. Its
/// dimension, 2 or 3, is that of all other arguments.
///
/// mask: pixels that are 0 are walls, all others are open; of the same size. NULL for no walls.
///
/// sources: source_count points of as many coordinates as the image has dimensions, x, y or
/// x, y, z, in pixels: 0, 0, 0 is the centre of the first one, x runs along the row, y from row to
/// row, z from slice to slice; fractions are allowed.
///
/// options: NULL for the defaults.
///
/// distance: receives the result; of the same size, HP_F32 or HP_F64, with any strides; it may be
/// the memory of the image. Distances are in physical units (those of the image's spacing) where
/// the medium is 1, and infinite in walls, wherever no heat has arrived and beyond
/// hp_options.farthest. It is written only if HP_OK is returned.
///
/// # Safety
/// The structs are as large as their `struct_size` says, and buffers and points are as large as
/// their description. The result is not used by another thread meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_distance(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    sources: *const f64,
    source_count: u64,
    options: *const hp_options,
    distance: *const hp_buffer,
) -> hp_status {
    let arguments = Arguments { image, mask, sources, source_count, options };
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        match view::dimension(image)? {
            2 => write_distance::<2>(&arguments, distance),
            _ => write_distance::<3>(&arguments, distance),
        }
    })
}

/// # Safety
/// As [`hp_distance`].
unsafe fn write_distance<const D: usize>(
    arguments: &Arguments,
    distance: *const hp_buffer,
) -> Result<(), Failure> {
    // SAFETY: the caller's promise.
    let target = unsafe { View::<D>::read(distance, "distance")? };
    pixels::check_writable(&target)?;
    // SAFETY: the caller's promise.
    let settings = unsafe { Settings::read(arguments.options)? };
    let exec = settings.run.exec()?;
    // SAFETY: the caller's promise.
    let problem = unsafe { Problem::<D>::read(arguments, &settings, &exec)? };
    target.check_size(problem.mask().shape())?;
    let (prepared, rest) = problem.prepare(settings.approach, &exec)?;
    let solved = prepared.solve(&problem.sources, &[], settings.readout, &rest)?;
    settings.run.finish()?;
    // SAFETY: the caller promises that the pixels can be written; their type was checked.
    unsafe { pixels::write(&target, solved.distances.field().values()) };
    Ok(())
}
