//! Where heat passes on its way between two points.

use crate::buffer::hp_buffer;
use crate::options::hp_options;
use crate::pixels;
use crate::prepared::Prepared;
use crate::problem::read_points;
use crate::settings::Settings;
use crate::solver::{hp_solver, in_medium};
use crate::status::{Failure, guard, hp_status};
use crate::view::View;
use heatpath_core::grid::bridge::bridge;
use heatpath_core::grid::{Sources, check_points};

/// Computes where heat passes on its way from one end to the other: a path with a width. Where there are
/// several ways, all show.
///
/// solver: one of heat, without HP_EIKONAL and HP_HEAT_METHOD.
///
/// from, to: the two ends, from_count and to_count points, as for hp_distance(); usually one each.
///
/// options: threads, progress and user count. NULL for the defaults.
///
/// ln_density: receives the logarithm of the time that a particle of heat that goes from one end to the
/// other spends in a pixel, in units of the time step: it is largest along the minimal path, and
/// minus infinity where no heat of both ends comes. Of the same size, HP_F32 or HP_F64. It is
/// written only if HP_OK is returned.
///
/// HP_NO_ANSWER is returned if no heat from one end reaches the other.
///
/// # Safety
/// As hp_solver_distances().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_solver_bridge(
    solver: *const hp_solver,
    from: *const f64,
    from_count: u64,
    to: *const f64,
    to_count: u64,
    options: *const hp_options,
    ln_density: *const hp_buffer,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let settings = Settings::read(options)?;
        in_medium!(solver, prepared => {
            let from = read_points(from, from_count, "from")?;
            let ends = [from, read_points(to, to_count, "to")?];
            write_bridge(prepared, &ends, &settings, ln_density)
        })
    })
}

/// # Safety
/// As [`hp_solver_bridge`].
unsafe fn write_bridge<const D: usize>(
    prepared: &Prepared<D>,
    [from, to]: &[Vec<[f64; D]>; 2],
    settings: &Settings,
    ln_density: *const hp_buffer,
) -> Result<(), Failure> {
    // SAFETY: the caller's promise.
    let target = unsafe { View::<D>::read(ln_density, "ln_density")? };
    pixels::check_writable(&target)?;
    target.check_size(prepared.medium().shape())?;
    let mask = prepared.medium().mask();
    check_points("from", from, mask)?;
    check_points("to", to, mask)?;
    let Prepared::Heat(heat) = prepared else {
        let message = "solver: a bridge is of heat; this one was made with HP_EIKONAL or \
                       HP_HEAT_METHOD";
        return Err(Failure::argument(message));
    };
    let exec = settings.run.exec()?;
    let from = heat.exposure(&Sources::new(from, mask)?, &exec.part(0.0, 0.5))?;
    let to = heat.exposure(&Sources::new(to, mask)?, &exec.part(0.5, 1.0))?;
    let ln_density = bridge(&from, &to)?;
    settings.run.finish()?;
    // SAFETY: the caller promises that the pixels can be written; their type was checked.
    unsafe { pixels::write(&target, ln_density.values()) };
    Ok(())
}
