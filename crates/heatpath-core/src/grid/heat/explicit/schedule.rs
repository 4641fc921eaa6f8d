//! In which order rows are computed: tiles, several steps a visit, threads, range.
//!
//! The grid is cut into tiles. A tile is advanced by several steps at a time in a small scratch
//! window: the tile is copied in with a margin as wide as the number of steps, and each step
//! computes a box one cell narrower on every side, until the tile itself is left. The cells of the
//! margin are computed by more than one tile; in return a tile is visited once for several steps
//! and stays in cache, tiles depend on nothing but the state before the visit, so they can run on
//! any thread in any order with the same result, and each tile keeps an exponent of its own.
//! Heat moves one cell a step, so a tile without heat in it or around it is passed over.

use super::super::operator::Operator;
use super::kernel::{Block, diffuse};
use super::scaled::{Scale, Scaled, exponent_for, largest, trusted};
use crate::exec::{Cancelled, Exec, SimdLevel};
use crate::grid::Shape;

/// The scheme and its time step.
pub(super) struct Steps<'a, const D: usize> {
    pub(super) operator: &'a Operator<D>,
    pub(super) step: f64,
    pub(super) simd: SimdLevel,
}

/// The cells along each side of a tile, in the order in which they are tried.
///
/// Larger tiles waste less work on margins but must hold a wider range of values, and in 3-D
/// outgrow the cache.
pub(super) fn tile_edges(dimension: usize) -> &'static [usize] {
    if dimension < 3 { &[64, 32, 16, 8] } else { &[32, 16, 8] }
}

/// How many cells of a tile's edge make one step of a visit.
const EDGE_PER_STEP: usize = 8;

/// The temperature of the whole grid, tile by tile.
pub(super) struct Tiles<const D: usize> {
    shape: Shape<D>,
    /// The cells along each side of a tile.
    edge: usize,
    /// How many steps a visit takes.
    steps: usize,
    /// The cells along each side of a thread's window: a tile, a margin of one cell a step, and a
    /// rim of one cell more that is read through faces without conductance.
    window: usize,
    /// How many tiles there are along each axis.
    tiles: Shape<D>,
    /// The temperature before a visit; empty where there is no heat yet.
    now: Vec<Scaled>,
    visited: Vec<Visited>,
}

/// What a visit writes.
#[derive(Clone, Default)]
struct Visited {
    number: usize,
    next: Scaled,
    exposure: Scaled,
}

/// The cells from `low` up to but not including `high`.
#[derive(Clone, Copy)]
struct Range<const D: usize> {
    low: [usize; D],
    high: [usize; D],
}

/// Where a thread advances its tile.
struct Scratch {
    now: Vec<f64>,
    next: Vec<f64>,
    sum: Vec<f64>,
}

impl<const D: usize> Tiles<D> {
    pub(super) fn new(shape: &Shape<D>, edge: usize) -> Self {
        let tiles = shape.with_size(shape.size().map(|n| n.div_ceil(edge)));
        let steps = edge / EDGE_PER_STEP;
        let visited = |number| Visited { number, ..Visited::default() };
        Self {
            shape: *shape,
            edge,
            steps,
            window: edge + 2 * steps + 2,
            tiles,
            now: vec![Scaled::default(); tiles.cells()],
            visited: (0..tiles.cells()).map(visited).collect(),
        }
    }

    /// Adds heat to the cell at a position of the grid.
    pub(super) fn add(&mut self, cell: usize, amount: f64) {
        let index = self.shape.index(cell);
        let tile = self.tiles.position(index.map(|i| i / self.edge));
        let place = self.place(index);
        let heat = &mut self.now[tile];
        if heat.values.is_empty() {
            *heat = Scaled::zeros(self.edge.pow(D as u32));
        }
        heat.add_at(place, amount);
    }

    /// Advances by `iterations` steps; returns the logarithms of u and of its sum over the start
    /// and all steps.
    pub(super) fn march(
        mut self,
        steps: &Steps<D>,
        iterations: usize,
        report: &mut dyn FnMut(f64) -> Result<(), Cancelled>,
        exec: &Exec,
    ) -> Result<(Vec<f64>, Vec<f64>), Cancelled> {
        for (visited, now) in self.visited.iter_mut().zip(&self.now) {
            visited.exposure = now.clone();
        }
        let mut done = 0;
        while done < iterations {
            report(done as f64 / iterations as f64)?;
            let count = self.steps.min(iterations - done);
            let mut visited = std::mem::take(&mut self.visited);
            let visit = |scratch: &mut Scratch, tile: &mut Visited| {
                self.visit(tile, steps, count, scratch);
            };
            exec.for_each(&mut visited, || self.scratch(), visit);
            for (visited, now) in visited.iter_mut().zip(&mut self.now) {
                std::mem::swap(&mut visited.next, now);
            }
            self.visited = visited;
            done += count;
        }
        let temperature = self.logarithms(|tile| &self.now[tile]);
        Ok((temperature, self.logarithms(|tile| &self.visited[tile].exposure)))
    }

    fn scratch(&self) -> Scratch {
        let window = vec![0.0; self.window.pow(D as u32)];
        let sum = vec![0.0; self.edge.pow(D as u32)];
        Scratch { now: window.clone(), next: window, sum }
    }

    /// Advances one tile by `count` steps.
    fn visit(&self, tile: &mut Visited, steps: &Steps<D>, count: usize, scratch: &mut Scratch) {
        let inside = self.range_of(tile.number);
        let Some(exponent) = self.load(self.widened(inside, count), inside.low, scratch) else {
            tile.next.values.clear();
            return;
        };
        scratch.sum.fill(0.0);
        for left in (0..count).rev() {
            self.advance(self.widened(inside, left), inside.low, steps, scratch);
            for row in inside.rows() {
                let (from, to) = (self.window_position(row, inside.low), self.place(row));
                let n = inside.row_length();
                let sums = scratch.sum[to..to + n].iter_mut();
                sums.zip(&scratch.now[from..from + n]).for_each(|(sum, u)| *sum += u);
            }
        }
        // === Store
        tile.next.exponent = exponent;
        tile.next.values.resize(scratch.sum.len(), 0.0);
        for row in inside.rows() {
            let (from, to) = (self.window_position(row, inside.low), self.place(row));
            let n = inside.row_length();
            let values = tile.next.values[to..to + n].iter_mut();
            values.zip(&scratch.now[from..from + n]).for_each(|(value, u)| *value = trusted(*u));
        }
        tile.exposure.add(&scratch.sum, exponent);
    }

    /// Copies a range into the window, scaled to a common exponent; `None` if there is no heat.
    fn load(&self, range: Range<D>, low: [usize; D], scratch: &mut Scratch) -> Option<i32> {
        let exponent = self
            .tiles_around(range)
            .filter_map(|tile| {
                let heat = &self.now[tile];
                let part = range.intersection(self.range_of(tile));
                let largest = part
                    .rows()
                    .map(|row| largest(&heat.values[self.place(row)..][..part.row_length()]))
                    .fold(0.0, f64::max);
                (largest > 0.0).then(|| exponent_for(largest, heat.exponent))
            })
            .max()?;
        for row in range.rows() {
            let to = self.window_position(row, low);
            scratch.now[to..to + range.row_length()].fill(0.0);
        }
        for tile in self.tiles_around(range) {
            let heat = &self.now[tile];
            let part = range.intersection(self.range_of(tile));
            let scale = Scale::new(heat.exponent - exponent);
            for row in part.rows() {
                let (from, to) = (self.place(row), self.window_position(row, low));
                let values = scratch.now[to..to + part.row_length()].iter_mut();
                values.zip(&heat.values[from..]).for_each(|(u, value)| *u = scale.apply(*value));
            }
        }
        Some(exponent)
    }

    /// Advances a range of the window by one step.
    fn advance(&self, range: Range<D>, low: [usize; D], steps: &Steps<D>, scratch: &mut Scratch) {
        let block = Block {
            size: std::array::from_fn(|axis| range.high[axis] - range.low[axis]),
            cell: self.shape.position(range.low),
            cell_strides: std::array::from_fn(|axis| self.shape.stride(axis)),
            place: self.window_position(range.low, low),
            place_strides: std::array::from_fn(|axis| self.window.pow(axis as u32)),
        };
        let Operator { faces, factor } = steps.operator;
        let (next, u, factor) = (&mut scratch.next, &scratch.now, factor.as_deref());
        steps.simd.run(
            #[inline(always)]
            || diffuse(next, u, faces, factor, steps.step, &block),
        );
        std::mem::swap(&mut scratch.now, &mut scratch.next);
    }

    /// The logarithms of one [`Scaled`] per tile, as one field.
    fn logarithms<'a>(&'a self, heat_of: impl Fn(usize) -> &'a Scaled) -> Vec<f64> {
        let mut field = vec![f64::NEG_INFINITY; self.shape.cells()];
        for tile in 0..self.tiles.cells() {
            let heat = heat_of(tile);
            let range = self.range_of(tile);
            for row in range.rows().filter(|_| !heat.values.is_empty()) {
                let (from, to) = (self.place(row), self.shape.position(row));
                for i in 0..range.row_length() {
                    field[to + i] = heat.ln(from + i);
                }
            }
        }
        field
    }

    /// The cells of a tile.
    fn range_of(&self, tile: usize) -> Range<D> {
        let low = self.tiles.index(tile).map(|i| i * self.edge);
        let high = std::array::from_fn(|axis| (low[axis] + self.edge).min(self.shape.size()[axis]));
        Range { low, high }
    }

    /// A range with a margin, as far as the grid goes.
    fn widened(&self, range: Range<D>, margin: usize) -> Range<D> {
        let size = self.shape.size();
        Range {
            low: range.low.map(|i| i.saturating_sub(margin)),
            high: std::array::from_fn(|axis| (range.high[axis] + margin).min(size[axis])),
        }
    }

    /// The tiles with heat that a range touches.
    fn tiles_around(&self, range: Range<D>) -> impl Iterator<Item = usize> {
        let high = range.high.map(|i| (i - 1) / self.edge + 1);
        let touched = Range { low: range.low.map(|i| i / self.edge), high };
        touched
            .rows()
            .flat_map(move |row| (0..touched.row_length()).map(move |i| (row, i)))
            .map(|(row, i)| self.tiles.position(row) + i)
            .filter(|&tile| !self.now[tile].values.is_empty())
    }

    /// Where a cell stands within its tile.
    fn place(&self, index: [usize; D]) -> usize {
        index.iter().rev().fold(0, |place, i| place * self.edge + i % self.edge)
    }

    /// Where a cell stands in the window around the tile that begins at `low`.
    fn window_position(&self, index: [usize; D], low: [usize; D]) -> usize {
        (0..D).rev().fold(0, |position, axis| {
            position * self.window + index[axis] + self.steps + 1 - low[axis]
        })
    }
}

impl<const D: usize> Range<D> {
    fn row_length(&self) -> usize {
        self.high[0] - self.low[0]
    }

    /// The first cell of each row along x.
    fn rows(self) -> impl Iterator<Item = [usize; D]> {
        let count: usize = (1..D).map(|axis| self.high[axis] - self.low[axis]).product();
        (0..count).map(move |number| {
            let mut rest = number;
            let mut row = self.low;
            for (axis, index) in row.iter_mut().enumerate().skip(1) {
                let length = self.high[axis] - self.low[axis];
                *index += rest % length;
                rest /= length;
            }
            row
        })
    }

    fn intersection(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|axis| self.low[axis].max(other.low[axis])),
            high: std::array::from_fn(|axis| self.high[axis].min(other.high[axis])),
        }
    }
}
