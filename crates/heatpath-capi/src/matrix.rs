//! Distances between many points.

use crate::array::hp_array;
use crate::items::Items;
use crate::options::hp_options;
use crate::prepared::Prepared;
use crate::problem::read_points;
use crate::run::rounds;
use crate::settings::Settings;
use crate::solver::{hp_solver, in_medium};
use crate::status::{Failure, guard, hp_status};
use heatpath_core::grid::{Sources, check_points};

/// Computes the distance from each of some points to each of others: a row for each of `from`, with a
/// number for each of `to`.
///
/// from, to: from_count and to_count points, as for hp_distance().
///
/// options: as for hp_solver_distances(). With HP_SOLVER_IMPLICIT points are shared between the
/// threads; the results do not depend on how many there are.
///
/// distances: describes the first row: to_count numbers, HP_F32 or HP_F64. They are infinite where no
/// heat arrives, in the pixels around a point or at all.
///
/// row_stride: the bytes from a row to the next one. 0 means that rows follow each other without
/// gaps.
///
/// From a to b is as far as from b to a up to the error of the method. If the call is cancelled a part
/// may have been written; after any other failure nothing was.
///
/// # Safety
/// `solver` is NULL or comes from hp_solver_create() and was not freed yet. The structs are as
/// large as their `struct_size` says, and the points and the list are as large as their description.
/// The results are not used by another thread meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_solver_matrix(
    solver: *const hp_solver,
    from: *const f64,
    from_count: u64,
    to: *const f64,
    to_count: u64,
    options: *const hp_options,
    distances: *const hp_array,
    row_stride: i64,
) -> hp_status {
    let rows = (distances, row_stride);
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let settings = Settings::read(options)?;
        in_medium!(solver, prepared => {
            let from = read_points(from, from_count, "from")?;
            write_rows(prepared, &from, &read_points(to, to_count, "to")?, &settings, rows)
        })
    })
}

/// # Safety
/// As [`hp_solver_matrix`].
unsafe fn write_rows<const D: usize>(
    prepared: &Prepared<D>,
    from: &[[f64; D]],
    to: &[[f64; D]],
    settings: &Settings,
    (distances, row_stride): (*const hp_array, i64),
) -> Result<(), Failure> {
    let mask = prepared.medium().mask();
    check_points("from", from, mask)?;
    check_points("to", to, mask)?;
    let to = Sources::new(to, mask)?;
    // SAFETY: the caller's promise.
    let target = unsafe {
        let rows = (from.len(), row_stride);
        Items::<1>::target(distances, "distances", false, to.points().len(), rows)?
    };
    let exec = settings.run.exec()?;
    for round in rounds(&exec, from.len(), prepared.round(exec.threads())) {
        let (places, exec) = round?;
        let from = Sources::new(&from[places.clone()], mask)?;
        let rows = prepared.matrix(&from, &to, settings.readout, &exec)?;
        for (place, row) in places.zip(rows) {
            // SAFETY: the caller promises that the items can be written; type and count were checked.
            unsafe { target.write(place, row.into_iter().map(|distance| [distance])) };
        }
    }
    settings.run.finish()
}
