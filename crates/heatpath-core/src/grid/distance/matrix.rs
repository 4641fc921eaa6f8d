//! Distances between many points.

use super::varadhan::normalized_at;
use crate::exec::Exec;
use crate::grid::Sources;
use crate::grid::heat::HeatSolver;

/// The distances from each of some points to each of others: a row for each of `from`, with a column
/// for each of `to`.
///
/// Heat flows once from each point of `from` alone, and is read as by
/// [`normalized`](super::normalized) at the points `to` only. With
/// [`Implicit`](crate::grid::heat::Implicit) heat this is the fast way to many distances in one
/// medium. Points that heat does not reach are at [`NOT_REACHED`](super::NOT_REACHED). Memory: the
/// heat of 8 sources for each thread at a time.
///
/// From a to b is as far as from b to a, to the last few bits, for implicit heat in the medium
/// `k laplace(u)` of a picture and points on cell centres; otherwise to the accuracy of the
/// distances.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::distance::distance_matrix;
/// use heatpath_core::grid::heat::{Implicit, ImplicitOptions};
/// use heatpath_core::grid::{Shape, Sources, medium};
///
/// let medium = medium::uniform(Shape::new([64, 48])?);
/// let exec = Exec::single_threaded();
/// let implicit = Implicit::new(&medium, ImplicitOptions::default(), &exec)?;
/// let points = Sources::new(&[[12.0, 20.0], [42.0, 20.0], [42.0, 30.0]], medium.mask())?;
/// let distances = distance_matrix(&implicit, &points, &points, &exec)?;
/// assert!((distances[0][1] - 30.0).abs() < 0.15);
/// assert!((distances[1][2] - 10.0).abs() < 0.15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of the solver: the caller cancelled.
pub fn distance_matrix<S: HeatSolver<D>, const D: usize>(
    solver: &S,
    from: &Sources<D>,
    to: &Sources<D>,
    exec: &Exec,
) -> Result<Vec<Vec<f64>>, S::Error> {
    let mut rows = Vec::with_capacity(from.points().len());
    for round in from.each().chunks(8 * exec.threads()) {
        let heats = solver.flow_each(round, exec)?;
        rows.extend(heats.iter().map(|heat| normalized_at(heat, to.points())));
    }
    Ok(rows)
}
