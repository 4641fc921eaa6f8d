//! The baseline: key points by the Euclidean length of minimal paths.

use super::window::{Window, box_around};
use super::{KeyPoint, KeyPointError, KeyPoints, Link, Stop, check_range};
use crate::Exec;
use crate::grid::distance::{Arrival, Eikonal};
use crate::grid::medium::Medium;
use crate::grid::path::{Descent, Ending, PathOptions};
use crate::grid::{Sources, check_points};

/// The parameters of [`key_points_by_length`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthOptions {
    /// The length gamma of the paths between key points, in cell units. At least 4; default 30.
    pub length: f64,
    /// The march ends where a key point would be slower than this: the front has left the structure.
    /// A squared speed, not negative; default 0.1.
    pub least_speed_sq: f64,
    /// The largest number of key points, seeds included; default 10000.
    pub most: usize,
}

impl Default for LengthOptions {
    fn default() -> Self {
        Self { length: 30.0, least_speed_sq: 0.1, most: 10_000 }
    }
}

/// Finds key points by fast marching (Benmansour & Cohen, "Fast object segmentation by growing minimal
/// paths from a single point on 2D or 3D images", 2009): the first point to which a minimal path of the
/// given Euclidean length leads is a key point, and one more source from which the front goes on.
///
/// Closed curves stay open between the last two key points, and branches end at theirs: this is the
/// method that [`key_points`](super::key_points) is compared with. The travelling map is the distance
/// from the nearest key point, where the front has come; [`KeyPoints::iterations`] is 0.
///
/// # Errors
/// A parameter out of range, a seed outside the grid or in a wall, a grid too large for fast marching, or
/// the caller cancelled.
pub fn key_points_by_length<const D: usize>(
    medium: &Medium<D>,
    seeds: &Sources<D>,
    options: &LengthOptions,
    exec: &Exec,
) -> Result<KeyPoints<D>, KeyPointError> {
    check_range("length", options.length, 4.0..=1e9, "from 4 to 1e9 cells")?;
    let range = "finite and not negative";
    check_range("least squared speed", options.least_speed_sq, 0.0..=f64::MAX, range)?;
    check_range("number of key points", options.most as f64, 1.0..=f64::MAX, "at least 1")?;
    check_points("source", seeds.points(), medium.mask())?;
    let seed = |&point: &[f64; D]| KeyPoint { point, parent: None, ln_temperature: None };
    let mut points: Vec<KeyPoint<D>> = seeds.points().iter().map(seed).collect();
    let (mut links, mut stop) = (Vec::new(), Stop::Complete);
    let eikonal = Eikonal::new(medium, exec)?;
    let mut join = |arrival: Arrival<'_, D>| {
        if points.len() >= options.most {
            stop = Stop::Most;
            return false;
        }
        let cell = medium.shape().position(arrival.index);
        if medium.speed_sq(cell) < options.least_speed_sq {
            return false;
        }
        let Some(link) = link(medium, &points, &arrival, options.length) else { return false };
        let point = arrival.index.map(|i| i as f64);
        points.push(KeyPoint { point, parent: Some(link.to), ln_temperature: None });
        links.push(link);
        true
    };
    let distances = eikonal.grow(seeds.points(), options.length, &mut join, exec)?;
    Ok(KeyPoints { points, links, travelling: distances.into_field(), iterations: 0, stop })
}

/// The path from a new key point down to the nearest of those before it.
fn link<const D: usize>(
    medium: &Medium<D>,
    points: &[KeyPoint<D>],
    arrival: &Arrival<'_, D>,
    length: f64,
) -> Option<Link<D>> {
    let point = arrival.index.map(|i| i as f64);
    // No path leads further away than its length.
    let cells = length.ceil() as usize + 3;
    let window = Window::around(medium, point, cells);
    let (low, size) = box_around(medium.shape(), point, cells);
    let distances = arrival.distances(low, size);
    let (numbers, inside): (Vec<usize>, Vec<[f64; D]>) = (points.iter().enumerate())
        .map(|(number, other)| (number, window.inside(other.point)))
        .filter(|(_, other)| window.medium.shape().contains(*other))
        .unzip();
    let sources = Sources::new(&inside, window.medium.mask()).ok()?;
    let descent = Descent::of_distances(&distances, &sources, &window.medium);
    let path = descent.path(window.inside(point), &distances, PathOptions::default()).ok()?;
    let Ending::Source(parent) = path.ending else { return None };
    let to = numbers[parent];
    Some(Link { from: points.len(), to, path: window.outward(path, to) })
}
