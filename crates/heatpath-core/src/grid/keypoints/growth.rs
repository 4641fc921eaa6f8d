//! The list of key points and how it grows.

use super::ends::rest;
use super::joints::straighten;
use super::region::Region;
use super::search::{APART, Branch, Search, Visit, cells_between, passes};
use super::{KeyPoint, KeyPointError, KeyPoints, Link, Stop};
use crate::Exec;
use crate::grid::distance::NOT_REACHED;
use crate::grid::path::{Ending, Path};
use crate::grid::{Grid, Sources};

/// What has been found so far.
pub(super) struct Growth<'a, 'm, const D: usize> {
    search: &'a Search<'m, D>,
    points: Vec<KeyPoint<D>>,
    links: Vec<Link<D>>,
    /// Those of the key points of state 1.
    regions: Vec<Region<D>>,
    /// What may be a tip once all else is known.
    tips: Vec<Branch<D>>,
    /// What may have been missed: peaks in other regions or beside other key points, to which no path
    /// may lead in the end, and those beyond holes.
    missed: Vec<Branch<D>>,
    travelling: Grid<f64, D>,
}

/// Key points whose turn has come are looked around together, that many a thread.
const BATCH: usize = 4;

impl<'a, 'm, const D: usize> Growth<'a, 'm, D> {
    pub(super) fn new(search: &'a Search<'m, D>, seeds: &Sources<D>) -> Self {
        let seed = |&point: &[f64; D]| KeyPoint { point, parent: None, ln_temperature: None };
        Self {
            search,
            points: seeds.points().iter().map(seed).collect(),
            links: Vec::new(),
            regions: Vec::new(),
            tips: Vec::new(),
            missed: Vec::new(),
            travelling: Grid::from_fn(*search.medium.shape(), |_| NOT_REACHED),
        }
    }

    /// Looks around one key point after the other until there is none of state 0.
    ///
    /// What heat finds around a key point does not depend on the others, so several can be looked
    /// around at a time; what of it is new is decided one by one, in the order of the list.
    pub(super) fn run(mut self, exec: &Exec) -> Result<KeyPoints<D>, KeyPointError> {
        while self.regions.len() < self.points.len() && !self.is_full() {
            let first = self.regions.len();
            exec.report(first as f64 / self.points.len() as f64)?;
            let last = self.points.len().min(first + BATCH * exec.threads());
            let points: Vec<[f64; D]> = self.points[first..last].iter().map(|p| p.point).collect();
            let visits = self
                .search
                .each(&points, exec, |number| self.search.visit(points[number], first + number))?;
            for visit in visits {
                if !self.is_full() {
                    self.take(visit)?;
                }
            }
            if self.regions.len() == self.points.len() {
                let missed = std::mem::take(&mut self.missed);
                self.add_unknown(missed);
            }
        }
        let stop = if self.is_full() { Stop::Most } else { Stop::Complete };
        let tips = std::mem::take(&mut self.tips);
        self.add_unknown(tips);
        straighten(self.search, &mut self.links, exec)?;
        if self.search.options.tips {
            self.add_ends(exec)?;
        }
        exec.report(1.0)?;
        let Self { points, links, travelling, .. } = self;
        Ok(KeyPoints { points, links, travelling, iterations: self.search.iterations, stop })
    }

    fn is_full(&self) -> bool {
        self.points.len() >= self.search.options.most
    }

    /// Adds what was found around the first key point of state 0, whose state becomes 1.
    fn take(&mut self, visit: Visit<D>) -> Result<(), KeyPointError> {
        let number = self.regions.len();
        self.travel(&visit);
        for branch in visit.peaks {
            match self.owner(number, branch.point()) {
                Some(owner) => {
                    self.close(number, owner, &branch)?;
                    self.missed.push(branch);
                }
                None => match self.twin(number, branch.point()) {
                    Some(twin) => {
                        let rest = straight(branch.point(), self.points[twin].point);
                        self.join(number, twin, &branch.path, &rest);
                        self.missed.push(branch);
                    }
                    None if self.is_full() => {}
                    None => self.add(branch.path, Some(branch.ln_temperature)),
                },
            }
        }
        self.regions.push(visit.region);
        self.tips.extend(visit.tips);
        self.missed.extend(visit.beyond);
        Ok(())
    }

    /// Adds a key point and the path to its parent.
    fn add(&mut self, path: Path<D>, ln_temperature: Option<f64>) {
        let Ending::Source(parent) = path.ending else { return };
        let (from, point) = (self.points.len(), path.points[0]);
        self.points.push(KeyPoint { point, parent: Some(parent), ln_temperature });
        self.links.push(Link { from, to: parent, path });
    }

    /// The key point of state 1, other than `number`, in whose region a point lies; of several the
    /// nearest.
    fn owner(&self, number: usize, point: [f64; D]) -> Option<usize> {
        let others = (0..self.regions.len()).filter(|&other| other != number);
        let owners = others.filter(|&other| self.regions[other].contains(point));
        self.nearest(owners, point)
    }

    /// A key point of state 0 so near that a new one would find what it finds.
    fn twin(&self, number: usize, point: [f64; D]) -> Option<usize> {
        let near = |&other: &usize| {
            let other = self.points[other].point;
            let cells = cells_between(point, other);
            cells < 0.5 * self.search.options.radius
                && self.search.medium.mask().segment_is_open(point, other)
                && self.search.runs_inside(&straight(point, other))
        };
        self.nearest((number + 1..self.points.len()).filter(near), point)
    }

    fn nearest(&self, numbers: impl Iterator<Item = usize>, point: [f64; D]) -> Option<usize> {
        let distance = |other: usize| cells_between(self.points[other].point, point);
        numbers.min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
    }

    /// Joins the key point `number` with the `owner` of a region that its heat has come to, if the
    /// structure leads from one to the other on a way that is not known yet.
    fn close(
        &mut self,
        number: usize,
        owner: usize,
        branch: &Branch<D>,
    ) -> Result<(), KeyPointError> {
        if self.are_linked(number, owner) {
            return Ok(());
        }
        let flow = self.search.flow(self.points[owner].point)?;
        let Some(descent) = flow.descent() else { return Ok(()) };
        let Some(path) = flow.path(&descent, branch.point(), owner) else { return Ok(()) };
        if self.search.runs_inside(&path.points) {
            self.join(number, owner, &branch.path, &path.points);
        }
        Ok(())
    }

    /// Links the key points `to` and `from` by a `path` that ends at `to` and a `rest` that begins where
    /// it begins, unless that way is known. What the two have in common, where the one key point lies
    /// on the way to the other, is left out.
    fn join(&mut self, to: usize, from: usize, path: &Path<D>, rest: &[[f64; D]]) {
        let (own, other) = parting(&path.points, rest);
        let mut points: Vec<[f64; D]> = rest[other..].iter().rev().copied().collect();
        points.extend(&path.points[own..]);
        points.dedup();
        let path = Path::new(points, Ending::Source(to), path.distance, self.search.medium);
        if self.is_new(to, from, &path) {
            self.links.push(Link { from, to, path });
        }
    }

    /// Whether a path joins what is far apart along all others, or closes a loop hardly larger than a
    /// circle: then half a radius of it at least is not near any other. (Heat cuts the corner between two
    /// branches of a fork: that way is no longer than the one along them, and near them.)
    fn is_new(&self, to: usize, from: usize, path: &Path<D>) -> bool {
        let radius = self.search.options.radius;
        let limit = path.length + 3.0 * radius;
        if self.length_between(to, from, limit) > limit {
            return true;
        }
        let near: Vec<&Link<D>> = (self.links.iter())
            .filter(|link| cells_between(self.points[link.to].point, path.points[0]) < 4.0 * radius)
            .collect();
        let is_known =
            |point: [f64; D]| near.iter().any(|link| passes(&link.path.points, point, APART));
        let steps = path.points.windows(2).filter(|pair| !is_known(pair[0]));
        steps.map(|pair| cells_between(pair[0], pair[1])).sum::<f64>() > 0.5 * radius
    }

    fn are_linked(&self, a: usize, b: usize) -> bool {
        self.links.iter().any(|link| [[a, b], [b, a]].contains(&[link.from, link.to]))
    }

    /// The length in cells of the way along links, infinite beyond a limit.
    fn length_between(&self, from: usize, to: usize, limit: f64) -> f64 {
        let mut lengths = vec![f64::INFINITY; self.points.len()];
        lengths[from] = 0.0;
        let mut open = vec![from];
        while let Some(here) = open.pop() {
            for link in &self.links {
                let [a, b] = [link.from, link.to];
                let next = if a == here { b } else { a };
                let length = lengths[here] + link.path.length;
                if (a == here || b == here) && length < lengths[next] && length <= limit {
                    lengths[next] = length;
                    open.push(next);
                }
            }
        }
        lengths[to]
    }

    /// The map of each cell's distance from the key point whose circle comes to it first.
    fn travel(&mut self, visit: &Visit<D>) {
        let shape = *self.travelling.shape();
        let centre = self.points[self.regions.len()].point;
        let radius = self.search.options.radius * shape.smallest_spacing();
        let field = visit.flow.distances.field();
        for cell in 0..field.shape().cells() {
            let point = visit.flow.window.outside(field.shape().centre(cell));
            let value = &mut self.travelling[point.map(|part| part as usize)];
            if *value == NOT_REACHED && shape.physical_distance(centre, point) <= radius {
                *value = field.values()[cell];
            }
        }
    }

    /// Adds those of some branches where no path passes by.
    fn add_unknown(&mut self, branches: Vec<Branch<D>>) {
        for branch in branches {
            if !self.is_full() && !self.is_known(branch.point(), None) {
                self.add(branch.path, Some(branch.ln_temperature));
            }
        }
    }

    /// Whether a path passes by a point, other than that `from` a key point.
    fn is_known(&self, point: [f64; D], from: Option<usize>) -> bool {
        let reach = 2.0 * self.search.options.radius;
        self.links.iter().filter(|link| Some(link.from) != from).any(|link| {
            cells_between(self.points[link.to].point, point) < reach
                && passes(&link.path.points, point, APART)
        })
    }

    /// Adds the ends of branches that go on beyond their last key point.
    fn add_ends(&mut self, exec: &Exec) -> Result<(), KeyPointError> {
        let mut links_at = vec![0; self.points.len()];
        self.links.iter().flat_map(|link| [link.from, link.to]).for_each(|n| links_at[n] += 1);
        let is_last = |link: &&Link<D>| links_at[link.from] == 1;
        let last: Vec<&Link<D>> = self.links.iter().filter(is_last).collect();
        let points: Vec<[f64; D]> = last.iter().map(|link| link.path.points[0]).collect();
        let rests = self.search.each(&points, exec, |number| {
            Ok((last[number].from, rest(self.search, &last[number].path.points)))
        })?;
        for (to, mut points) in rests {
            points.reverse();
            points.push(self.points[to].point);
            let goes_on = points.len() > 2 && !self.is_known(points[0], Some(to));
            if goes_on && !self.is_full() {
                let medium = self.search.medium;
                let cost = medium.cost(&points);
                self.add(Path::new(points, Ending::Source(to), cost, medium), None);
            }
        }
        Ok(())
    }
}

/// Where two paths from one point part: the numbers of their last points less than two cells apart.
fn parting<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> (usize, usize) {
    let beside = |point: [f64; D]| b.iter().rposition(|&other| cells_between(point, other) < 2.0);
    let last = (0..a.len()).rev().find_map(|own| Some((own, beside(a[own])?)));
    last.unwrap_or((0, 0))
}

/// The straight way between two points, in steps of half a cell.
pub(super) fn straight<const D: usize>(a: [f64; D], b: [f64; D]) -> Vec<[f64; D]> {
    let steps = (2.0 * cells_between(a, b)).ceil().max(1.0) as usize;
    let at = |step: usize| {
        let part = step as f64 / steps as f64;
        std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]))
    };
    (0..=steps).map(at).collect()
}
