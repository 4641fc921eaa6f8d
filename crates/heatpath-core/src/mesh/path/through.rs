//! Paths through given points.

use super::{Descent, Ending, Path, ValuesError};
use crate::mesh::distance::{DistanceMap, NOT_REACHED};
use crate::mesh::{Medium, PointError, Sources, SurfacePoint};

/// The path from the first of `points` through all others, in their order, to the last, which has the
/// label 0.
///
/// It is made of a descent from each point to the next; `distance` makes the distances from one
/// source in the medium. The path ends where one of these does not reach its source.
///
/// # Errors
/// There are less than two points, one is not on the mesh, or `distance` fails.
pub fn through<E: From<PointError> + From<ValuesError>>(
    medium: &Medium,
    points: &[SurfacePoint],
    mut distance: impl FnMut(&Sources) -> Result<DistanceMap, E>,
) -> Result<Path, E> {
    let mesh = medium.mesh();
    mesh.check_points("end", points.first().copied())?;
    mesh.check_points("way", points[1..].iter().copied())?;
    let (mut whole, mut sum) = (vec![points[0]], 0.0);
    for pair in points.windows(2) {
        let sources = Sources::new(mesh, &pair[1..])?;
        let distances = distance(&sources)?;
        let piece = Descent::new(medium, distances.values(), &sources)?.path(pair[0])?;
        whole.extend(&piece.points[1..]);
        if !matches!(piece.ending, Ending::Source(_)) {
            return Ok(Path::new(mesh, whole, piece.ending, NOT_REACHED));
        }
        sum += piece.distance;
    }
    Ok(Path::new(mesh, whole, Ending::Source(0), sum))
}
