//! Branches that begin in the middle of the tube that they leave.
//!
//! Heat takes the shortest way around the corner between a branch and the tube that it leaves, and so
//! does a path: it comes to the curve in that tube too late, on the side of the key point where it
//! ends, and the first piece of the branch is missing. Here the branch goes straight on instead, as it
//! came, from its mouth to the curve, and from there along the curve to the key point.

use super::growth::straight;
use super::search::Search;
use super::surroundings::{Foot, Surroundings};
use super::{KeyPointError, Link};
use crate::Exec;
use crate::grid::path::Path;

/// The direction of a branch is taken this far from its mouth, in cells and in radii of the tube that
/// it leaves: nearer, its path turns to the corner already.
const FROM_MOUTH: (f64, f64) = (1.0, 0.5);

/// And over this length.
const STRETCH: (f64, f64) = (4.0, 1.5);

/// It goes straight on over this length at most.
const LONGEST: (f64, f64) = (1.0, 4.0);

/// The curve may be missed by this, or a cell.
const MISS: f64 = 0.5;

/// Ways that are no further apart than this are the same, in cells.
const SAME: f64 = 1.0;

/// Leads every branch straight into the middle of the tube that it leaves. Each is judged by the others
/// as they were found, so that their order is of no account.
pub(super) fn straighten<const D: usize>(
    search: &Search<'_, D>,
    links: &mut [Link<D>],
    exec: &Exec,
) -> Result<(), KeyPointError> {
    let ends: Vec<[f64; D]> = links.iter().map(end).collect();
    let found =
        search.each(&ends, exec, |number| Ok(Joint::new(search, links, number).led_on()))?;
    for (link, points) in links.iter_mut().zip(found) {
        if let Some(points) = points {
            link.path = Path::new(points, link.path.ending, link.path.distance, search.medium);
        }
    }
    Ok(())
}

fn end<const D: usize>(link: &Link<D>) -> [f64; D] {
    link.path.points[link.path.points.len() - 1]
}

/// A link, and the others around it.
struct Joint<'a, 'm, const D: usize> {
    search: &'a Search<'m, D>,
    links: &'a [Link<D>],
    link: &'a Link<D>,
    /// The only link that goes on from its beginning.
    before: Option<&'a Link<D>>,
    /// The other links around, without those that go on from its beginning.
    others: Vec<usize>,
}

/// Where a branch leaves a tube.
struct Mouth {
    /// The number of the last point of the branch that is not in the tube.
    point: usize,
    /// The radius of the tube.
    radius: f64,
}

impl<'a, 'm, const D: usize> Joint<'a, 'm, D> {
    fn new(search: &'a Search<'m, D>, links: &'a [Link<D>], number: usize) -> Self {
        let link = &links[number];
        let reach = 3.0 * search.options.radius;
        let is_near = |&other: &usize| {
            let other = &links[other];
            search.apart(end(other), end(link)) < reach
                || search.apart(other.path.points[0], end(link)) < reach
        };
        let near = (0..links.len()).filter(|&other| other != number).filter(is_near);
        let (after, others): (Vec<usize>, Vec<usize>) =
            near.partition(|&other| links[other].to == link.from);
        let before = if let [one] = after[..] { Some(&links[one]) } else { None };
        Self { search, links, link, before, others }
    }

    /// The points of the path, led straight on, if that makes a difference.
    fn led_on(&self) -> Option<Vec<[f64; D]>> {
        if !self.has_company() {
            return None;
        }
        let own = &self.link.path.points;
        let mouth = self.mouth()?;
        let (kept, step) = self.direction(&mouth)?;
        let (straight_on, foot) = self.straight_on(own[kept], step, mouth.radius)?;
        let mut points = own[..=kept].to_vec();
        points.extend(straight_on);
        let way = self.along(foot)?;
        points.extend(straight(points[points.len() - 1], way[0]));
        points.extend(way);
        points.dedup();
        let is_new =
            |&point: &[f64; D]| own.iter().all(|&other| self.search.apart(point, other) > SAME);
        let differs = points[kept + 1..].iter().any(is_new);
        let mask = self.search.medium.mask();
        let is_open = || points.windows(2).all(|pair| mask.segment_is_open(pair[0], pair[1]));
        (differs && self.search.runs_inside(&points) && is_open()).then_some(points)
    }

    /// Whether several links come so near that one may leave the tube of another.
    fn has_company(&self) -> bool {
        let own = &self.link.path.points;
        let reach = 0.5 * self.search.options.radius;
        let is_beside = |&&other: &&usize| {
            let points = &self.links[other].path.points;
            points.iter().any(|&a| own.iter().any(|&b| self.search.apart(a, b) < reach))
        };
        self.others.iter().filter(is_beside).nth(1).is_some()
    }

    fn foot(&self, point: [f64; D]) -> Option<Foot> {
        self.search.foot(self.links, &self.others, point)
    }

    fn mouth(&self) -> Option<Mouth> {
        let own = &self.link.path.points;
        let surroundings = Surroundings::new(self.search, end(self.link));
        let found = own.iter().enumerate().rev().find_map(|(number, &point)| {
            let foot = self.foot(point)?;
            let radius = surroundings.radius(self.links[foot.link].path.points[foot.point]);
            (foot.distance >= radius).then_some(Mouth { point: number, radius })
        });
        found.filter(|mouth| mouth.point + 1 < own.len())
    }

    /// The number of the last point that is kept, and the step of half a cell on from there.
    fn direction(&self, mouth: &Mouth) -> Option<(usize, [f64; D])> {
        let own = &self.link.path.points[..=mouth.point];
        let before = self.before.map_or(&[][..], |link| &link.path.points[..]);
        let way: Vec<[f64; D]> = own.iter().rev().chain(before.iter().rev()).copied().collect();
        let mut length = 0.0;
        let lengths = way.windows(2).map(|pair| {
            length += self.search.apart(pair[0], pair[1]);
            length
        });
        let lengths: Vec<f64> = lengths.collect();
        let cells = |(cells, radii): (f64, f64)| cells + radii * mouth.radius;
        let at = |least: f64| lengths.iter().position(|&length| length >= least);
        let first = at(cells(FROM_MOUTH))?.min(mouth.point);
        let last = at(cells(FROM_MOUTH) + cells(STRETCH)).unwrap_or(lengths.len());
        let (here, there) = (way[first], way[last]);
        let apart = self.search.apart(here, there);
        let step = std::array::from_fn(|axis| 0.5 * (here[axis] - there[axis]) / apart);
        (apart > 0.5 * STRETCH.0).then_some((mouth.point - first, step))
    }

    /// The points straight on from one to where the others are nearest, and the nearest point there.
    fn straight_on(
        &self,
        start: [f64; D],
        step: [f64; D],
        radius: f64,
    ) -> Option<(Vec<[f64; D]>, Foot)> {
        let steps = (2.0 * (LONGEST.0 + LONGEST.1 * radius)) as usize;
        let next = |here: &[f64; D]| Some(std::array::from_fn(|axis| here[axis] + step[axis]));
        let mut points: Vec<[f64; D]> = (std::iter::successors(Some(start), next).skip(1))
            .take(steps)
            .take_while(|&point| self.search.medium.shape().contains(point))
            .collect();
        let feet = points.iter().enumerate().filter_map(|(i, &point)| Some((i, self.foot(point)?)));
        let (last, foot) = feet.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance))?;
        points.truncate(last + 1);
        (foot.distance <= (MISS * radius).max(1.0)).then_some((points, foot))
    }

    /// The way along one link, or two, from a point of one to the key point where this link ends.
    fn along(&self, foot: Foot) -> Option<Vec<[f64; D]>> {
        let first = &self.links[foot.link];
        let on = first.path.points[foot.point..].to_vec();
        let back = first.path.points[..=foot.point].iter().rev().copied().collect();
        let to = self.link.to;
        let mut ways: [(usize, Vec<[f64; D]>); 2] = [(first.to, on), (first.from, back)];
        if let Some((_, way)) = ways.iter_mut().find(|(end, _)| *end == to) {
            return Some(std::mem::take(way));
        }
        ways.into_iter().find_map(|(end, mut way)| {
            let points = self.others.iter().find_map(|&other| {
                let Link { from, to: last, path } = &self.links[other];
                let reversed = || path.points.iter().rev().copied().collect();
                match (*from, *last) {
                    pair if pair == (end, to) => Some(path.points.clone()),
                    pair if pair == (to, end) => Some(reversed()),
                    _ => None,
                }
            });
            let points: Vec<[f64; D]> = points?;
            way.extend(&points[1..]);
            Some(way)
        })
    }
}
