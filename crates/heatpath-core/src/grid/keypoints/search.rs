//! What is found around one key point, whatever else is found elsewhere.

use super::circle::{Circle, Peak};
use super::region::Region;
use super::window::Flow;
use super::{KeyPointError, KeyPointOptions, Threshold};
use crate::Exec;
use crate::grid::heat::{Duration, Explicit, HeatOptions};
use crate::grid::medium::Medium;
use crate::grid::path::Path;
use crate::grid::sample::corners;
use crate::grid::{Shape, Sources};

/// A search that is prepared for any key point.
#[derive(Debug)]
pub(super) struct Search<'a, const D: usize> {
    pub(super) medium: &'a Medium<D>,
    pub(super) options: KeyPointOptions,
    pub(super) iterations: usize,
    step: f64,
    /// From the radius down to the shortest tip, in cells.
    circles: Vec<(f64, Circle<D>)>,
    /// What the first circles are measured by: the highest `ln u` and the least distance on them.
    first: (f64, f64),
}

/// A peak, with the way back from it.
#[derive(Clone, Debug)]
pub(super) struct Branch<const D: usize> {
    pub(super) ln_temperature: f64,
    pub(super) path: Path<D>,
}

impl<const D: usize> Branch<D> {
    pub(super) fn point(&self) -> [f64; D] {
        self.path.points[0]
    }
}

/// What is found around one key point.
#[derive(Debug)]
pub(super) struct Visit<const D: usize> {
    pub(super) flow: Flow<D>,
    /// The peaks on the circle, warmest first.
    pub(super) peaks: Vec<Branch<D>>,
    /// Peaks inside the circle to which none of the other paths leads, outermost first.
    pub(super) tips: Vec<Branch<D>>,
    /// Peaks beyond a hole in the structure.
    pub(super) beyond: Vec<Branch<D>>,
    pub(super) region: Region<D>,
}

/// Two paths that are no further apart than this, in cells, are in the same tube.
pub(super) const APART: f64 = 5.0;

/// A hole in the structure may be this long on a path, in cells. At 3, key points jump from one line
/// to another 7 cells beside it.
const HOLE: f64 = 2.0;

/// And this long if the path is straight.
const STRAIGHT_HOLE: f64 = 4.0;

/// A path is straight whose ends are at least this part of its length apart. From one line to another
/// 7 cells beside it 0.91 are.
const STRAIGHT: f64 = 0.95;

/// How far apart points straight on are, in cells.
pub(super) const STRAIGHT_STEP: f64 = 0.5;

/// The direction of a branch is that of its last cells, as many.
pub(super) const STRETCH: f64 = 6.0;

/// The least strength beyond a hole, as part of that of any other branch. At forks of generated trees it
/// is 0.5 or more, of the edge of a shadow beside a catheter 0.2.
const WEAKEST: f64 = 1.0 / 3.0;

/// By how many cells the circles for tips shrink.
pub(super) const TIP_STEP: f64 = 2.0;

impl<'a, const D: usize> Search<'a, D> {
    pub(super) fn new(
        medium: &'a Medium<D>,
        seeds: &Sources<D>,
        options: &KeyPointOptions,
        exec: &Exec,
    ) -> Result<Self, KeyPointError> {
        let iterations = options.iterations.max(steps_across::<D>(options.radius));
        let heat = HeatOptions {
            duration: Duration::Iterations(iterations),
            exposure: false,
            ..HeatOptions::default()
        };
        let step = Explicit::new(medium, heat)?.step();
        let shrink = |radius: &f64| Some(radius - TIP_STEP);
        let radii = std::iter::successors(Some(options.radius), shrink);
        let circles = radii
            .take_while(|&radius| radius == options.radius || options.tips && radius > APART)
            .map(|radius| (radius, Circle::new(radius)))
            .collect();
        let first = (f64::NEG_INFINITY, f64::INFINITY);
        let options = *options;
        let mut search = Self { medium, options, iterations, step, circles, first };
        search.first = search.first_circles(seeds.points(), exec)?;
        Ok(search)
    }

    /// The highest `ln u` and the least distance on the circles around the seeds.
    fn first_circles(&self, seeds: &[[f64; D]], exec: &Exec) -> Result<(f64, f64), KeyPointError> {
        let (radius, circle) = &self.circles[0];
        let firsts = self.each(seeds, exec, |number| {
            let flow = self.flow(seeds[number])?;
            let points =
                circle.directions.iter().map(|&d| self.on_circle(seeds[number], d, *radius));
            Ok(points.fold((f64::NEG_INFINITY, f64::INFINITY), |(ln_u, distance), point| {
                (ln_u.max(flow.ln_temperature(point)), distance.min(flow.distance(point)))
            }))
        })?;
        Ok(firsts.into_iter().fold((f64::NEG_INFINITY, f64::INFINITY), |first, other| {
            (first.0.max(other.0), first.1.min(other.1))
        }))
    }

    /// What `work` makes of the numbers of `points`, in parallel.
    pub(super) fn each<T: Send>(
        &self,
        points: &[[f64; D]],
        exec: &Exec,
        work: impl Fn(usize) -> Result<T, KeyPointError> + Sync + Send,
    ) -> Result<Vec<T>, KeyPointError> {
        let mut results: Vec<(usize, Option<Result<T, KeyPointError>>)> =
            (0..points.len()).map(|number| (number, None)).collect();
        exec.for_each(&mut results, |(number, result)| *result = Some(work(*number)));
        results.into_iter().filter_map(|(_, result)| result).collect()
    }

    pub(super) fn flow(&self, point: [f64; D]) -> Result<Flow<D>, KeyPointError> {
        let exec = Exec::single_threaded();
        Flow::new(self.medium, point, self.iterations, self.step, &exec)
    }

    /// Looks around a key point whose number is `number`.
    pub(super) fn visit(&self, point: [f64; D], number: usize) -> Result<Visit<D>, KeyPointError> {
        let flow = self.flow(point)?;
        let mut peaks = Vec::new();
        let mut on_first = 0;
        let mut beyond = Vec::new();
        if let Some(descent) = flow.descent() {
            for (level, (radius, circle)) in self.circles.iter().enumerate() {
                let at = |&d: &[f64; D]| self.on_circle(point, d, *radius);
                let values: Vec<f64> =
                    circle.directions.iter().map(|d| flow.ln_temperature(at(d))).collect();
                for Peak { direction, value } in circle.peaks(&values) {
                    let end = at(&direction);
                    let is_new = level == 0 || !leads_to(&peaks, end);
                    if is_new && self.is_warm(&flow, end, radius / self.options.radius) {
                        let Some(path) = flow.path(&descent, end, number) else { continue };
                        let branch = Branch { ln_temperature: value, path };
                        if self.runs_inside(&branch.path.points) {
                            peaks.push(branch);
                        } else if self.jumps_a_hole(&branch.path.points) {
                            beyond.push(branch);
                        }
                    }
                }
                on_first = if level == 0 { peaks.len() } else { on_first };
            }
        }
        let strengths = peaks[..on_first].iter().map(|peak| self.strength(&peak.path.points));
        let weakest = strengths.fold(f64::INFINITY, f64::min);
        beyond.retain(|peak| self.strength(&peak.path.points) >= WEAKEST * weakest);
        let tips = peaks.split_off(on_first);
        let region = Region::new(self, &flow, point, &peaks);
        Ok(Visit { flow, peaks, tips, region, beyond })
    }

    /// A point on the circle around a key point, in pixel coordinates.
    fn on_circle(&self, centre: [f64; D], direction: [f64; D], radius: f64) -> [f64; D] {
        let shape = self.medium.shape();
        let radius = radius * shape.smallest_spacing();
        std::array::from_fn(|axis| centre[axis] + radius * direction[axis] / shape.spacing()[axis])
    }

    /// Whether enough heat has come to a point, at that part of the radius (epsilon 1).
    pub(super) fn is_warm(&self, flow: &Flow<D>, point: [f64; D], part: f64) -> bool {
        match self.options.threshold {
            Threshold::Temperature(least) => {
                flow.ln_temperature(point) >= self.first.0 + least.ln()
            }
            Threshold::Speed(least) => flow.distance(point) * least <= self.first.1 * part,
        }
    }

    /// Whether a path stays where the medium is fast (epsilon 2), all the way.
    pub(super) fn runs_inside(&self, points: &[[f64; D]]) -> bool {
        points.iter().all(|&point| self.is_inside(point))
    }

    /// Whether a path crosses small holes only of the structure, such as vesselness has at forks and
    /// crossings, and the structure goes on for half a radius beyond them: on the path, or, if that is
    /// straight, beyond the circle too.
    fn jumps_a_hole(&self, points: &[[f64; D]]) -> bool {
        let (mut first, mut hole, mut longest) = (f64::INFINITY, 0.0, 0.0_f64);
        let mut length = 0.0;
        for pair in points.windows(2) {
            let step = self.apart(pair[0], pair[1]);
            if self.is_inside(pair[0]) {
                hole = 0.0;
            } else {
                first = first.min(length);
                hole += step;
                longest = longest.max(hole);
            }
            length += step;
        }
        let needed = 0.5 * self.options.radius - first;
        let is_straight = self.apart(points[0], points[points.len() - 1]) >= STRAIGHT * length;
        if is_straight {
            let steps = (needed / STRAIGHT_STEP).ceil().max(0.0) as usize;
            longest <= STRAIGHT_HOLE && self.straight_on(points).take(steps).count() == steps
        } else {
            longest <= HOLE && needed <= 0.0
        }
    }

    /// How strong a structure is at its end: the mean squared speed on the last half radius of the
    /// path to it.
    fn strength(&self, points: &[[f64; D]]) -> f64 {
        let last = self.within(points, 0.5 * self.options.radius);
        last.iter().map(|&point| self.speed_sq(point)).sum::<f64>() / last.len() as f64
    }

    /// The first points of a path, which are no further than some cells from where it begins.
    pub(super) fn within<'p>(&self, points: &'p [[f64; D]], cells: f64) -> &'p [[f64; D]] {
        let is_far = |&point: &[f64; D]| self.apart(point, points[0]) > cells;
        &points[..points.iter().position(is_far).unwrap_or(points.len())]
    }

    /// The points straight on from where a path begins, as far as the structure goes.
    pub(super) fn straight_on(&self, points: &[[f64; D]]) -> impl Iterator<Item = [f64; D]> {
        let last = self.within(points, STRETCH);
        let (end, far) = (points[0], last[last.len() - 1]);
        let part = STRAIGHT_STEP / self.apart(far, end);
        let step: [f64; D] = std::array::from_fn(|axis| part * (end[axis] - far[axis]));
        let next = move |here: &[f64; D]| {
            let next = std::array::from_fn(|axis| here[axis] + step[axis]);
            let goes_on = self.medium.shape().contains(next)
                && self.medium.mask().segment_is_open(*here, next)
                && self.is_inside(next);
            goes_on.then_some(next)
        };
        std::iter::successors(Some(end), next).skip(1)
    }

    pub(super) fn is_inside(&self, point: [f64; D]) -> bool {
        self.speed_sq(point) >= self.options.least_speed_sq
    }

    fn speed_sq(&self, point: [f64; D]) -> f64 {
        let shape: &Shape<D> = self.medium.shape();
        corners(shape, point).map(|(cell, weight)| weight * self.medium.speed_sq(cell)).sum()
    }
}

/// Whether one of the branches passes by a point.
pub(super) fn leads_to<const D: usize>(branches: &[Branch<D>], point: [f64; D]) -> bool {
    branches.iter().any(|branch| passes(&branch.path.points, point, APART))
}

/// Whether some points pass another within a distance in cells.
pub(super) fn passes<const D: usize>(points: &[[f64; D]], point: [f64; D], cells: f64) -> bool {
    points.iter().any(|&other| cells_between(other, point) < cells)
}

pub(super) fn cells_between<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// The steps after which heat from a point has come to every side of a circle: it moves one cell a
/// step, and a diagonal is `sqrt(D)` times as long that way.
fn steps_across<const D: usize>(radius: f64) -> usize {
    ((D as f64).sqrt() * radius).ceil() as usize + D
}
