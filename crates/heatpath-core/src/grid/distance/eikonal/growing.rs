//! Fast marching with the length of each path carried along, in which sources may join on the way.

use super::queue::Entry;
use super::seed::Seed;
use super::stencil::{Dependent, Stencil};
use super::update::{Difference, Differences};
use super::{AnyStencil, Eikonal};
use crate::exec::{Cancelled, Exec};
use crate::grid::distance::DistanceMap;
use crate::grid::{Grid, Shape};
use std::collections::BinaryHeap;
use std::iter;

/// The first cell whose path has become so long.
pub(crate) struct Arrival<'a, const D: usize> {
    pub(crate) index: [usize; D],
    shape: Shape<D>,
    distance: &'a dyn Fn([usize; D]) -> f64,
}

impl<const D: usize> Arrival<'_, D> {
    /// The distances so far in a box of `size` cells that begins at the cell `low`.
    pub(crate) fn distances(&self, low: [usize; D], size: [usize; D]) -> DistanceMap<D> {
        let outside = |index: [usize; D]| std::array::from_fn(|axis| low[axis] + index[axis]);
        let shape = self.shape.with_size(size);
        let unit = shape.smallest_spacing();
        let distance = |index| unit * (self.distance)(outside(index));
        DistanceMap { field: Grid::from_fn(shape, distance) }
    }
}

impl<const D: usize> Eikonal<'_, D> {
    /// Marches from `seeds`, to first order and without factor. Each time that the Euclidean length of
    /// a minimal path comes to `length`, in cell units, the cell becomes one more source as long as
    /// `join` agrees, and the march goes on from there; or else it ends. The distances at the end are
    /// those from the nearest of all sources.
    pub(crate) fn grow(
        &self,
        seeds: &[[f64; D]],
        length: f64,
        join: &mut dyn FnMut(Arrival<'_, D>) -> bool,
        exec: &Exec,
    ) -> Result<DistanceMap<D>, Cancelled> {
        match &self.stencil {
            AnyStencil::Axes(axes) => self.grow_on(axes, seeds, length, join, exec),
            AnyStencil::Plane(lattice) => self.grow_on(lattice, seeds, length, join, exec),
            AnyStencil::Space(lattice) => self.grow_on(lattice, seeds, length, join, exec),
        }
    }

    fn grow_on<const N: usize>(
        &self,
        stencil: &impl Stencil<D, N>,
        seeds: &[[f64; D]],
        length: f64,
        join: &mut dyn FnMut(Arrival<'_, D>) -> bool,
        exec: &Exec,
    ) -> Result<DistanceMap<D>, Cancelled> {
        let shape = *self.medium.shape();
        let mut growing = Growing::new(stencil, shape);
        for &point in seeds {
            growing.join(&Seed::new(&self.medium, stencil, point, 0.0));
        }
        let mut known = 0_usize;
        while let Some(place) = growing.next() {
            if growing.lengths[place] >= length {
                let index = shape.index(growing.cells[place] as usize);
                let distance = |index| growing.distances[stencil.place(index)];
                if !join(Arrival { index, shape, distance: &distance }) {
                    break;
                }
                let point = index.map(|i| i as f64);
                growing.join(&Seed::new(&self.medium, stencil, point, 0.0));
                continue;
            }
            growing.spread(place);
            known += 1;
            if known.is_multiple_of(super::march::REPORT_EVERY) {
                exec.report((known as f64 / shape.cells() as f64).min(1.0))?;
            }
        }
        let unit = shape.smallest_spacing();
        let distance = |index| unit * growing.known(stencil.place(index)).unwrap_or(f64::INFINITY);
        Ok(DistanceMap { field: Grid::from_fn(shape, distance) })
    }
}

/// The distances and lengths so far, place by place.
struct Growing<'a, const D: usize, const N: usize, S> {
    stencil: &'a S,
    /// The spacing in cell units.
    spacing: [f64; D],
    distances: Vec<f64>,
    lengths: Vec<f64>,
    is_known: Vec<bool>,
    /// The cell at each place.
    cells: Vec<u32>,
    queue: BinaryHeap<Entry>,
}

impl<'a, const D: usize, const N: usize, S: Stencil<D, N>> Growing<'a, D, N, S> {
    fn new(stencil: &'a S, shape: Shape<D>) -> Self {
        let places = stencil.places();
        let mut cells = vec![0; places];
        for cell in 0..shape.cells() {
            cells[stencil.place(shape.index(cell))] = cell as u32;
        }
        Self {
            stencil,
            spacing: shape.spacing().map(|spacing| spacing / shape.smallest_spacing()),
            distances: vec![f64::INFINITY; places],
            lengths: vec![0.0; places],
            is_known: vec![false; places],
            cells,
            queue: BinaryHeap::new(),
        }
    }

    fn join(&mut self, seed: &Seed<D>) {
        for &(place, distance) in &seed.cells {
            self.offer(place, distance, 0.0);
        }
    }

    /// The next cell whose distance is known.
    fn next(&mut self) -> Option<usize> {
        let Self { queue, is_known, distances, .. } = self;
        let entry = iter::from_fn(|| queue.pop()).find(|&Entry { distance, place }| {
            !is_known[place as usize] && distance == distances[place as usize]
        })?;
        is_known[entry.place as usize] = true;
        Some(entry.place as usize)
    }

    /// A source that has joined makes cells nearer that were known: they are looked at again.
    fn offer(&mut self, place: usize, distance: f64, length: f64) {
        if distance < self.distances[place] {
            self.distances[place] = distance;
            self.lengths[place] = length;
            self.is_known[place] = false;
            self.queue.push(Entry { distance, place: place as u32 });
        }
    }

    fn known(&self, place: usize) -> Option<f64> {
        self.is_known[place].then(|| self.distances[place])
    }

    fn spread(&mut self, place: usize) {
        let stencil = self.stencil;
        stencil.for_dependents(place, |Dependent { place, .. }| {
            if stencil.is_open(place) {
                let (distance, length) = self.update(place);
                self.offer(place, distance, length);
            }
        });
    }

    /// The distance of a cell by its known neighbours, and the length of the path there.
    fn update(&self, place: usize) -> (f64, f64) {
        let neighbours: [Option<(usize, f64, isize)>; N] =
            std::array::from_fn(|direction| self.nearer(place, direction));
        let mut differences = Differences::<N>::new();
        for (direction, &(_, near, _)) in
            neighbours.iter().enumerate().filter_map(|(i, n)| Some((i, n.as_ref()?)))
        {
            let weight = self.stencil.weight(place, direction);
            differences.insert(Difference { weight, slope: 1.0, rest: near, near });
        }
        let along_axes = self
            .stencil
            .nearest_along_axes(place, |other| self.known(other).unwrap_or(f64::INFINITY));
        let distance = differences.solve().unwrap_or(f64::INFINITY);
        match along_axes {
            Some((least, other)) if least < distance => (least, self.lengths[other] + 1.0),
            _ => (distance, self.length(place, distance, &neighbours)),
        }
    }

    /// The nearer of the two known neighbours along a direction, its distance and its side.
    fn nearer(&self, place: usize, direction: usize) -> Option<(usize, f64, isize)> {
        let neighbour = |side| {
            let other = self.stencil.neighbour(place, direction, side)?;
            Some((other, self.known(other)?, side))
        };
        [neighbour(-1), neighbour(1)].into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The length L of the path to a cell: along it, in the direction of `v = k D grad T`, L grows by
    /// `|v|` as T grows by 1, so `v . grad L = |v|`, with the differences that T has.
    fn length(
        &self,
        place: usize,
        distance: f64,
        neighbours: &[Option<(usize, f64, isize)>; N],
    ) -> f64 {
        let (mut sum, mut weights, mut velocity) = (0.0, 0.0, [0.0; D]);
        for (direction, neighbour) in neighbours.iter().enumerate() {
            let Some((other, near, side)) = *neighbour else { continue };
            let weight = self.stencil.weight(place, direction) * (distance - near).max(0.0);
            let vector = self.stencil.vector(place, direction);
            sum += weight * self.lengths[other];
            weights += weight;
            (0..D).for_each(|axis| {
                velocity[axis] -= side as f64 * weight * vector[axis] * self.spacing[axis];
            });
        }
        let speed = velocity.iter().map(|part| part * part).sum::<f64>().sqrt();
        if weights > 0.0 { (sum + speed) / weights } else { 0.0 }
    }
}
