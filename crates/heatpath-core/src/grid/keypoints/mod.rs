//! Key points: curves and trees from a single point, piece by piece (Yang & Cohen, section 4.2).

mod circle;
mod ends;
mod growth;
mod joints;
mod length;
mod region;
mod search;
mod surroundings;
mod window;

pub use self::length::{LengthOptions, key_points_by_length};

use self::growth::Growth;
use self::search::Search;
use super::distance::EikonalError;
use super::heat::HeatError;
use super::medium::Medium;
use super::path::Path;
use super::{Grid, PointError, Sources, check_points, half_width, structure};
use crate::error::{self, ParameterError};
use crate::exec::{Cancelled, Exec};
use std::ops::RangeInclusive;
use thiserror::Error;

/// How warm a peak on a circle must be (epsilon 1 of Algorithm 2), measured by the first circles, those
/// around the seeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// At least this part of the highest temperature on the first circles: the paper's rule, with 0.8.
    ///
    /// Temperature falls like `exp(-distance^2 / 4t)`: at a radius of 30 and after 50 steps a fifth of it
    /// is lost over a seventh of a cell, and branches that are a little slower than the first do not
    /// pass. Of a generated tree it finds 0.20, where a speed of 0.5 finds 0.98 (conductivity, radius
    /// 15).
    Temperature(f64),
    /// The way there was made at this part of the highest speed on the first circles at least: the
    /// least [`normalized`](super::distance::normalized) distance on these, over that of the peak.
    Speed(f64),
}

/// The parameters of [`key_points`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeyPointOptions {
    /// The radius r of the circle, or sphere, around a key point, in cell units (multiples of the
    /// smallest spacing). At least 4; default 30, as in the paper.
    ///
    /// A closed curve is found if it does not fit into a circle, and of branches those that leave one or
    /// end in one as a tip.
    pub radius: f64,
    /// The steps of heat for each key point. Default 50, as in the paper; as heat moves one cell a step
    /// along an axis, the number is raised until it comes to all of the circle, if it is less
    /// ([`KeyPoints::iterations`] says what it was).
    pub iterations: usize,
    /// How warm a peak must be.
    pub threshold: Threshold,
    /// The squared speed `k D` of the medium (alpha of eq. 6, for example) that counts as part of the
    /// structure (epsilon 2): all of a path must run there, not only the key point lie in it. Not
    /// negative; default 0.1, which suits grey values scaled to `[0, 1]` and vesselness alike. Too low,
    /// and paths leave the structure; too high, and they end at a dim piece.
    pub least_speed_sq: f64,
    /// Whether to look inside the circles for the ends of branches, which come to no circle. Default
    /// true.
    pub tips: bool,
    /// The largest number of key points, seeds included; default 10000.
    pub most: usize,
}

impl Default for KeyPointOptions {
    fn default() -> Self {
        Self {
            radius: 30.0,
            iterations: 50,
            threshold: Threshold::Speed(0.5),
            least_speed_sq: 0.1,
            tips: true,
            most: 10_000,
        }
    }
}

impl KeyPointOptions {
    /// The options for the [`structure`](super::structure()) of a medium from `least_speed_sq` on: a
    /// radius of 4 times its half width, from 10 to 30 cells, so that circles are wider than tubes and
    /// few branches end inside them; and half that speed for epsilon 2, as paths must run in the
    /// structure all the way, also where it is faint.
    #[must_use]
    pub fn of_structure<const D: usize>(medium: &Medium<D>, least_speed_sq: f64) -> Self {
        let unit = medium.shape().smallest_spacing();
        let half_width = half_width(&structure(medium, least_speed_sq));
        let usual = Self::default();
        let radius = half_width.map_or(usual.radius, |half| (4.0 * half / unit).clamp(10.0, 30.0));
        Self { radius, least_speed_sq: 0.5 * least_speed_sq, ..usual }
    }
}

/// Why there are no key points.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum KeyPointError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A seed lies outside the grid or in a wall.
    #[error(transparent)]
    Point(#[from] PointError),
    /// Heat cannot flow.
    #[error(transparent)]
    Heat(#[from] HeatError),
    /// Fast marching is not possible.
    #[error(transparent)]
    Eikonal(#[from] EikonalError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A point on the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeyPoint<const D: usize> {
    /// In pixel coordinates.
    pub point: [f64; D],
    /// The number of the key point on whose circle it was found, or beyond which its branch ends; `None`
    /// for seeds.
    pub parent: Option<usize>,
    /// The logarithm of the temperature there, of heat from the parent; `None` for seeds, for ends that
    /// no circle has found, and without heat.
    pub ln_temperature: Option<f64>,
}

/// A piece of curve between two key points.
#[derive(Clone, Debug, PartialEq)]
pub struct Link<const D: usize> {
    /// The number of the key point where the path begins.
    pub from: usize,
    /// The number of the key point where it ends, as its [`Ending`](super::path::Ending) says too.
    pub to: usize,
    /// The path.
    pub path: Path<D>,
}

/// Why the search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// No circle has a peak left that is new.
    Complete,
    /// There were as many key points as allowed.
    Most,
}

/// Key points and the curves between them.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyPoints<const D: usize> {
    /// The seeds, in the order in which they were given, and then what was found, in that order.
    pub points: Vec<KeyPoint<D>>,
    /// From each key point but the seeds the path to its parent; and those between key points neither
    /// of which is the parent of the other, which close a curve.
    pub links: Vec<Link<D>>,
    /// The travelling map (Fig. 19 h): the distance of each cell from the first key point in whose
    /// circle it lies, [`NOT_REACHED`](super::distance::NOT_REACHED) where there is none.
    pub travelling: Grid<f64, D>,
    /// The steps of heat for each key point.
    pub iterations: usize,
    /// Why the search ended.
    pub stop: Stop,
}

impl<const D: usize> KeyPoints<D> {
    /// The links that close a curve.
    pub fn closing(&self) -> impl Iterator<Item = &Link<D>> {
        self.links.iter().filter(|link| self.points[link.from].parent != Some(link.to))
    }
}

/// Finds the key points of a structure in a `medium` that lets heat run in it, and the paths between
/// them (Algorithm 2), from `seeds` on the structure.
///
/// Where the paper leaves a choice:
///
/// - *Order.* Key points have their turn in the order of the list, breadth first. A circle without a new
///   peak ends its branch, not the search, which ends when none is left: Algorithm 2 as printed would
///   `break` at the first end of a branch and lose the others.
/// - *Peaks* are maxima of `ln u` on the circle between which u falls to a half at least, each centred in
///   the arc or patch that is at least half as warm: across the tube, whatever the noise on its plateau.
/// - *The region R* of a key point is what of the structure lies inside its circle, is connected with it
///   there and is as warm as a peak must be. Without the last two, an arm of a spiral would hide the next.
///   A peak in an earlier region is no key point; the two are linked if the way between them runs in the
///   structure and joins what is far apart otherwise. So closed curves are closed, and several seeds
///   joined.
/// - *Missed branches.* Once no circle has a new peak, those that were left out because they lie in an
///   earlier region or beside another key point are looked at again: where no path passes by, they
///   are key points after all. So are peaks beyond a hole of two cells at most, or of four on a straight
///   way, such as vesselness often has at forks and crossings, if the structure goes on beyond it for
///   half a radius and is a third as strong there as that of any other peak.
/// - *Joints.* Heat, and the path with it, takes the shortest way around the corner between a branch and
///   the tube that it leaves. The path of a branch goes straight on instead, as it came, from the mouth of
///   the branch to the curve in that tube, and then along it to the parent.
/// - *Ends.* With [`KeyPointOptions::tips`], a branch that goes on beyond its last key point for a few cells,
///   too few for a circle, has one more at its end.
/// - *Windows.* Heat moves one cell a step, so it flows in the box that it can reach: a key point costs the
///   same in any picture. Where D is a tensor, whose offsets are longer, the box cuts off what has no
///   bearing on the circle.
/// - *Threads* look around several key points at a time; what is new is decided in order, so that the
///   result does not depend on them.
///
/// # Errors
/// A parameter out of range, a seed outside the grid or in a wall, heat that cannot flow, or the caller
/// cancelled.
pub fn key_points<const D: usize>(
    medium: &Medium<D>,
    seeds: &Sources<D>,
    options: &KeyPointOptions,
    exec: &Exec,
) -> Result<KeyPoints<D>, KeyPointError> {
    check(options)?;
    check_points("source", seeds.points(), medium.mask())?;
    let search = Search::new(medium, seeds, options, exec)?;
    Growth::new(&search, seeds).run(exec)
}

fn check(options: &KeyPointOptions) -> Result<(), ParameterError> {
    let part = match options.threshold {
        Threshold::Temperature(part) | Threshold::Speed(part) => part,
    };
    check_range("radius", options.radius, 4.0..=1e4, "from 4 to 10000 cells")?;
    check_range("threshold", part, f64::MIN_POSITIVE..=1.0, "above 0 and at most 1")?;
    let range = "finite and not negative";
    check_range("least squared speed", options.least_speed_sq, 0.0..=f64::MAX, range)?;
    check_range("number of key points", options.most as f64, 1.0..=f64::MAX, "at least 1")?;
    check_range("number of steps", options.iterations as f64, 1.0..=1e6, "from 1 to 1000000")
}

fn check_range(
    name: &'static str,
    value: f64,
    allowed: RangeInclusive<f64>,
    range: &'static str,
) -> Result<(), ParameterError> {
    error::check(name, value, allowed.contains(&value), range)
}
