//! In which order rows are computed: tiles, several steps a visit, threads, range.
//!
//! The grid is cut into tiles. A tile is advanced by several steps at a time in a small scratch
//! window: the tile is copied in with a margin as wide as heat moves in those steps, of which each
//! step leaves less that is right, until the tile itself is left. It passes through the window plane
//! by plane (in 2-D: row by row), so that the window stays in cache. The cells of the margin are
//! computed by more than one tile; in return a tile is visited once for several steps and stays in
//! cache, tiles depend on nothing but the state before the visit, so they can run on any thread in
//! any order with the same result, and each tile keeps an exponent of its own. Heat moves one cell
//! a step (in tensor media as far as the longest offset), so a tile without heat in it or around it
//! is passed over.

use super::kernel::{Extent, Traffic, Window};
use super::scaled::{Largest, RANGE, Scale, Scaled, exponent_for, largest, nearly_lost, trusted};
use super::stencil::Stencil;
use crate::exec::{Cancelled, Exec};
use crate::grid::{Grid, Shape};
use crate::simd::{Lanes, WithLanes};
use std::sync::Mutex;

/// The scheme and its time step.
pub(super) struct Steps<'a, const D: usize> {
    pub(super) stencil: &'a Stencil<D>,
    /// k as far as it is not in the stencil, or `None` for 1.
    pub(super) factor: Option<&'a Grid<f64, D>>,
    pub(super) step: f64,
    pub(super) iterations: usize,
    /// Whether to add up u.
    pub(super) exposure: bool,
    /// How many steps heat has in reserve when it comes to the furthest cell, if that is known.
    pub(super) spare: Option<usize>,
    /// How many powers of two below the hottest tile heat may be lost, at most [`MOST_DEPTH`].
    pub(super) depth: Option<i32>,
}

/// How the grid is cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tiling<const D: usize> {
    /// The cells of a tile along each axis.
    edge: [usize; D],
    /// How many steps a visit takes.
    steps: usize,
    /// How many cells heat moves along each axis in one step at most.
    reach: [usize; D],
    /// Windows begin at a multiple of so many cells along x, where vectors of the stencil do.
    row_multiple: usize,
}

impl<const D: usize> Tiling<D> {
    /// The ways to cut a grid, in the order in which they are tried.
    ///
    /// Larger tiles are visited less often, have less margin and longer rows along x, which run
    /// faster, but they must hold a wider range of values and leave less to share between threads.
    /// Where heat moves further than a cell in a step, larger tiles have room for its margins, which
    /// are not wider than a quarter of a tile if one step is not; whole rows are best there, since
    /// what takes the time is reading the stencil from memory. In 3-D such tiles outgrow the cache,
    /// since windows of tensors hold them whole.
    pub(super) fn all(
        stencil: &Stencil<D>,
        shape: &Shape<D>,
    ) -> impl Iterator<Item = Self> + use<D> {
        let (reach, row_multiple) = (stencil.reach(), stencil.row_multiple());
        let furthest = reach.into_iter().max().unwrap_or(1);
        // Threads share tiles, so there should be some.
        let enough = if D == 2 { 8 * 256 * 128 } else { 4 * 128 * 64 * 64 };
        let is_large = shape.cells() >= enough;
        let (edges, most_steps): (&[usize], _) = match stencil {
            Stencil::Faces(_) if D == 3 && is_large => (&[64, 32, 16, SHORTEST_EDGE], 8),
            _ if D == 3 => (&[32, 16, SHORTEST_EDGE], 4),
            Stencil::Faces(_) if is_large => (&[128, 64, 32, 16, SHORTEST_EDGE], 16),
            Stencil::Gather(_) if furthest > 1 => (&[128, 64, 32, 16, SHORTEST_EDGE], 10),
            _ => (&[64, 32, 16, SHORTEST_EDGE], 8),
        };
        let longest = match stencil {
            _ if D == 3 => Some((4 * edges[0], edges[0])),
            Stencil::Gather(_) if furthest > 1 => Some((1024, edges[0])),
            _ => None,
        };
        let others = edges.iter().flat_map(|&edge| [(2 * edge, edge), (edge, edge)]);
        longest.into_iter().chain(others).map(move |(length, edge)| {
            let steps = (edge / 8).min(edge / 4 / furthest).clamp(1, most_steps);
            let edge = std::array::from_fn(|axis| if axis == 0 { length } else { edge });
            Self { edge, steps, reach, row_multiple }
        })
    }

    /// As many tiles, none larger than a grid needs: they hold memory for all of their cells.
    fn within(self, shape: &Shape<D>) -> Self {
        let needed = |axis: usize| {
            let side = shape.size()[axis];
            side.div_ceil(side.div_ceil(self.edge[axis])).next_multiple_of(SHORTEST_EDGE)
        };
        Self { edge: std::array::from_fn(needed), ..self }
    }

    /// The most steps that heat takes from any cell of a window to any other, if there are no walls.
    ///
    /// At every step it comes at least to all neighbours across faces.
    fn longest_way(&self) -> usize {
        self.edge.iter().zip(self.reach).map(|(edge, reach)| edge + 2 * reach * self.steps).sum()
    }

    /// The room that windows need along each axis.
    fn room(&self) -> [usize; D] {
        std::array::from_fn(|axis| {
            let margin = self.reach[axis] * self.steps;
            let around = if axis == 0 {
                // Tiles begin at a multiple of the shortest edge.
                2 * margin.next_multiple_of(self.row_multiple) + self.row_multiple - SHORTEST_EDGE
            } else {
                2 * margin
            };
            self.edge[axis] + around
        })
    }
}

/// The shortest edge of a tile.
const SHORTEST_EDGE: usize = 8;

/// How many powers of two the largest value of a window may lie above the top of a tile's range.
const HEADROOM: i32 = 32;

/// Less heat than this many powers of two below the hottest is lost in no tile.
pub(super) const MOST_DEPTH: i32 = RANGE - HEADROOM;

/// The temperature of the whole grid, tile by tile.
pub(super) struct Tiles<const D: usize> {
    shape: Shape<D>,
    tiling: Tiling<D>,
    /// How many tiles there are along each axis.
    tiles: Shape<D>,
    /// The temperature before a visit; empty where there is no heat yet.
    now: Vec<Temperature>,
    visited: Vec<Visited>,
}

/// The temperature of a tile.
#[derive(Clone, Default)]
struct Temperature {
    heat: Scaled,
    /// The largest of its values.
    largest: f64,
}

/// The logarithms of u and of its sum over the start and all steps.
pub(super) type Fields<const D: usize> = (Grid<f64, D>, Option<Grid<f64, D>>);

/// What a visit writes.
#[derive(Clone, Default)]
struct Visited {
    number: usize,
    next: Temperature,
    exposure: Scaled,
    lost: Lost,
}

/// What of the heat in a window was too small for its range.
#[derive(Clone, Default)]
struct Lost {
    /// Whether some of it was.
    some: bool,
    /// Whether some of it was nearly too small at the end of the visit.
    nearly: bool,
}

/// The cells from `low` up to but not including `high`.
#[derive(Clone, Copy)]
struct Range<const D: usize> {
    low: [usize; D],
    high: [usize; D],
}

impl<const D: usize> Tiles<D> {
    pub(super) fn new(shape: &Shape<D>, tiling: Tiling<D>) -> Self {
        let tiling = tiling.within(shape);
        let size = std::array::from_fn(|axis| shape.size()[axis].div_ceil(tiling.edge[axis]));
        let tiles = shape.with_size(size);
        let visited = |number| Visited { number, ..Visited::default() };
        Self {
            shape: *shape,
            tiling,
            tiles,
            now: vec![Temperature::default(); tiles.cells()],
            visited: (0..tiles.cells()).map(visited).collect(),
        }
    }

    /// The number of cells of a tile.
    fn tile_cells(&self) -> usize {
        self.tiling.edge.iter().product()
    }

    /// Adds heat to the cell at a position of the grid.
    pub(super) fn add(&mut self, cell: usize, amount: f64) {
        let index = self.shape.index(cell);
        let edge = self.tiling.edge;
        let tile = self.tiles.position(std::array::from_fn(|axis| index[axis] / edge[axis]));
        let (place, len) = (self.place(index), self.tile_cells());
        let Temperature { heat, largest } = &mut self.now[tile];
        if heat.values.is_empty() {
            *heat = Scaled::zeros(len);
        }
        heat.add_at(place, amount);
        *largest = largest.max(heat.values[place]);
    }

    /// Lets heat flow; `None` if a tile cannot hold the range of its values.
    ///
    /// A value that is lost below the range of a window is made up for within the steps that heat
    /// takes through the window, since it is nothing next to the heat in the same window. So no value
    /// may be lost in the last steps; and none at all if heat comes to some cell with no steps to
    /// spare, which then rests on the very first arrivals. Where a visit could be the first to lose
    /// such a value, the grid is cut into the next of the `finer` tilings before.
    pub(super) fn march(
        mut self,
        steps: &Steps<D>,
        finer: &mut impl Iterator<Item = Tiling<D>>,
        report: &mut dyn FnMut(f64) -> Result<(), Cancelled>,
        exec: &Exec,
    ) -> Result<Option<Fields<D>>, Cancelled> {
        for (visited, now) in self.visited.iter_mut().zip(&self.now) {
            if steps.exposure {
                visited.exposure = now.heat.clone();
            }
        }
        let mut windows = self.windows(steps, exec);
        let mut done = 0;
        while done < steps.iterations {
            report(done as f64 / steps.iterations as f64)?;
            let count = self.tiling.steps.min(steps.iterations - done);
            let lost = self.visit(steps, count, &windows, exec);
            done += count;
            if let Some(depth) = steps.depth {
                self.let_go_below(depth);
                continue;
            }
            if lost.some && self.may_lose_nothing(steps, done) {
                return Ok(None);
            }
            let next = done + self.tiling.steps;
            if (lost.some || lost.nearly)
                && done < steps.iterations
                && self.may_lose_nothing(steps, next)
                && let Some(tiling) = finer.next()
            {
                self = self.cut(tiling);
                windows = self.windows(steps, exec);
            }
        }
        let exposure: Vec<_> = self.visited.into_iter().map(|visited| visited.exposure).collect();
        let temperature = self.now.into_iter().map(|now| now.heat).collect();
        let (shape, tiling) = (self.shape, self.tiling);
        let exposure = steps.exposure.then(|| logarithms(shape, tiling, exposure, exec));
        Ok(Some((logarithms(shape, tiling, temperature, exec), exposure)))
    }

    /// Advances all tiles by `count` steps.
    fn visit(
        &mut self,
        steps: &Steps<D>,
        count: usize,
        windows: &[Mutex<Window<D>>],
        exec: &Exec,
    ) -> Lost {
        let mut visited = std::mem::take(&mut self.visited);
        exec.for_each_with(&mut visited, windows, |window, tile| {
            let tiles = &self;
            exec.simd().with_lanes(Visit { tiles, steps, count, tile, window });
        });
        for (visited, now) in visited.iter_mut().zip(&mut self.now) {
            std::mem::swap(&mut visited.next, now);
        }
        self.visited = visited;
        let lost = |which: fn(&Lost) -> bool| self.visited.iter().any(|tile| which(&tile.lost));
        Lost { some: lost(|lost| lost.some), nearly: lost(|lost| lost.nearly) }
    }

    /// Whether what is lost in a visit that ends after `done` steps is missing in the end.
    fn may_lose_nothing(&self, steps: &Steps<D>, done: usize) -> bool {
        let longest_way = self.tiling.longest_way();
        let is_late = done + longest_way > steps.iterations;
        is_late || steps.spare.is_some_and(|spare| spare < longest_way)
    }

    /// The same heat in other tiles. What is moved is let go of before the next is: the memory is that
    /// of a visit.
    fn cut(mut self, tiling: Tiling<D>) -> Self {
        let mut tiles = Self::new(&self.shape, tiling);
        self.visited.iter_mut().for_each(|visited| visited.next = Temperature::default());
        let now = std::mem::take(&mut self.now).into_iter();
        let held: Vec<Scaled> = now.map(|now| now.heat).collect();
        let moved = self.moved(&held, &tiles);
        drop(held);
        for (now, heat) in tiles.now.iter_mut().zip(moved) {
            *now = Temperature { largest: largest(&heat.values), heat };
        }
        let visited = std::mem::take(&mut self.visited).into_iter();
        let held: Vec<Scaled> = visited.map(|visited| visited.exposure).collect();
        let moved = self.moved(&held, &tiles);
        for (visited, exposure) in tiles.visited.iter_mut().zip(moved) {
            visited.exposure = exposure;
        }
        tiles
    }

    /// What the tiles held, in each of some other tiles.
    fn moved(&self, held: &[Scaled], others: &Self) -> Vec<Scaled> {
        let gathered = |number| self.gathered(held, others, number);
        (0..others.tiles.cells()).map(gathered).collect()
    }

    /// What the tiles held, in the cells of a tile of `others`.
    fn gathered(&self, held: &[Scaled], others: &Self, number: usize) -> Scaled {
        let mut all = Scaled::default();
        let range = others.range_of(number);
        for tile in self.tiles_around(range).filter(|&tile| !held[tile].values.is_empty()) {
            let heat = &held[tile];
            let part = range.intersection(self.range_of(tile));
            let row = |row| &heat.values[self.place(row)..][..part.row_length()];
            let most = part.rows().map(|first| largest(row(first))).fold(0.0, f64::max);
            if most > 0.0 {
                all.grow(exponent_for(most, heat.exponent), others.tile_cells());
                let scale = Scale::new(heat.exponent - all.exponent);
                for first in part.rows() {
                    let cells = all.values[others.place(first)..].iter_mut().zip(row(first));
                    cells.for_each(|(cell, &value)| *cell = scale.apply(value));
                }
            }
        }
        all
    }

    /// Takes the heat from tiles that are `depth` powers of two below the hottest one.
    fn let_go_below(&mut self, depth: i32) {
        let order = |tile: &Temperature| {
            (tile.largest > 0.0).then(|| exponent_for(tile.largest, tile.heat.exponent))
        };
        let hottest = self.now.iter().filter_map(order).max();
        let least = hottest.map(|hottest| hottest - depth);
        for tile in self.now.iter_mut().filter(|tile| order(tile) < least) {
            tile.heat.values.clear();
            tile.largest = 0.0;
        }
    }

    /// Where threads advance their tiles.
    fn windows(&self, steps: &Steps<D>, exec: &Exec) -> Vec<Mutex<Window<D>>> {
        let (room, count) = (self.tiling.room(), self.tiling.steps);
        let window = || {
            let mut window = Window::new(room, count, steps.stencil, steps.exposure);
            window.rate.fill(steps.step);
            window.rate_is_uniform = steps.factor.is_none();
            Mutex::new(window)
        };
        let threads = if self.visited.len() == 1 { 1 } else { exec.threads() };
        (0..threads).map(|_| window()).collect()
    }

    /// The cells of a tile.
    fn range_of(&self, tile: usize) -> Range<D> {
        let edge = self.tiling.edge;
        let index = self.tiles.index(tile);
        let low = std::array::from_fn(|axis| index[axis] * edge[axis]);
        let size = self.shape.size();
        let high = std::array::from_fn(|axis| (low[axis] + edge[axis]).min(size[axis]));
        Range { low, high }
    }

    /// The cells of a tile and a margin for `steps` steps, as far as the grid goes.
    fn around(&self, tile: Range<D>, steps: usize) -> Range<D> {
        let (size, margin) = (self.shape.size(), self.tiling.reach.map(|reach| reach * steps));
        Range {
            low: std::array::from_fn(|axis| tile.low[axis].saturating_sub(margin[axis])),
            high: std::array::from_fn(|axis| (tile.high[axis] + margin[axis]).min(size[axis])),
        }
    }

    /// What a window holds for a range around a tile.
    fn extent(&self, around: Range<D>) -> Extent<D> {
        let (mut low, high, size) = (around.low, around.high, self.shape.size());
        low[0] -= low[0] % self.tiling.row_multiple;
        Extent {
            low,
            size: std::array::from_fn(|axis| high[axis] - low[axis]),
            is_border: std::array::from_fn(|axis| (low[axis] == 0, high[axis] == size[axis])),
        }
    }

    /// The tiles that a range touches.
    #[inline(always)]
    fn tiles_around(&self, range: Range<D>) -> impl Iterator<Item = usize> {
        let edge = self.tiling.edge;
        let touched = Range {
            low: std::array::from_fn(|axis| range.low[axis] / edge[axis]),
            high: std::array::from_fn(|axis| (range.high[axis] - 1) / edge[axis] + 1),
        };
        touched
            .rows()
            .flat_map(move |row| (0..touched.row_length()).map(move |i| (row, i)))
            .map(|(row, i)| self.tiles.position(row) + i)
    }

    /// Where a cell stands within its tile.
    #[inline(always)]
    fn place(&self, index: [usize; D]) -> usize {
        let edge = self.tiling.edge;
        (0..D).rev().fold(0, |place, axis| place * edge[axis] + index[axis] % edge[axis])
    }
}

/// Advances one tile by `count` steps.
struct Visit<'a, const D: usize> {
    tiles: &'a Tiles<D>,
    steps: &'a Steps<'a, D>,
    count: usize,
    tile: &'a mut Visited,
    window: &'a mut Window<D>,
}

impl<const D: usize> WithLanes for Visit<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { tiles, steps, count, tile, window } = self;
        let inside = tiles.range_of(tile.number);
        let around = tiles.around(inside, count);
        let Some(exponent) = tiles.exponent(tile.number, around) else {
            tile.next.heat.values.clear();
            tile.next.largest = 0.0;
            tile.lost = Lost::default();
            return;
        };
        let extent = tiles.extent(around);
        tile.next.heat.exponent = exponent;
        tile.next.heat.values.resize(tiles.tile_cells(), 0.0);
        tile.lost = Lost::default();
        if steps.exposure {
            tile.exposure.grow(exponent, tiles.tile_cells());
        }
        let (low, most) = (extent.low, Largest::default());
        let mut passage = Passage { tiles, steps, low, inside, around, tile, most };
        window.advance(lanes, steps.stencil, &extent, count, &mut passage);
        passage.tile.next.largest = passage.most.value();
    }
}

/// The way of a tile and its margin through a window, plane by plane.
struct Passage<'a, const D: usize> {
    tiles: &'a Tiles<D>,
    steps: &'a Steps<'a, D>,
    /// Where the window begins.
    low: [usize; D],
    /// The tile.
    inside: Range<D>,
    /// The tile and its margin.
    around: Range<D>,
    tile: &'a mut Visited,
    /// The largest value of the tile after the steps.
    most: Largest,
}

impl<const D: usize> Traffic<D> for Passage<'_, D> {
    #[inline(always)]
    fn enter(&mut self, window: &mut Window<D>, plane: usize) {
        let range = self.around.plane(self.low[D - 1] + plane);
        self.tiles.clear(range, self.low, self.steps, window);
        let exponent = self.tile.next.heat.exponent;
        self.tile.lost.some |= self.tiles.load(range, self.low, exponent, window);
    }

    #[inline(always)]
    fn leave(&mut self, window: &Window<D>, plane: usize) {
        let plane = self.low[D - 1] + plane;
        if (self.inside.low[D - 1]..self.inside.high[D - 1]).contains(&plane) {
            let range = self.inside.plane(plane);
            self.tiles.store(range, self.low, window, self.tile, &mut self.most);
            if self.steps.exposure {
                self.tiles.add_exposure(range, self.low, window, self.tile);
            }
        }
    }
}

impl<const D: usize> Tiles<D> {
    /// The exponent for the heat of a tile and a range around it; `None` if there is no heat.
    ///
    /// Only the part of a neighbour that lies in the range counts: its other side may be hotter by
    /// more than a window can hold. It is looked at only if the neighbour is much hotter than the
    /// tile itself, which lies in the range as a whole.
    #[inline(always)]
    fn exponent(&self, number: usize, range: Range<D>) -> Option<i32> {
        let exponent_of = |largest: f64, heat: &Scaled| {
            if largest > 0.0 { Some(exponent_for(largest, heat.exponent)) } else { None }
        };
        let mut exponent = exponent_of(self.now[number].largest, &self.now[number].heat);
        for tile in self.tiles_around(range) {
            let Temperature { heat, largest: bound } = &self.now[tile];
            let bound = exponent_of(*bound, heat);
            if bound.is_none() || bound <= exponent.map(|exponent| exponent + HEADROOM) {
                continue;
            }
            let part = range.intersection(self.range_of(tile));
            let mut most = 0.0;
            for row in part.rows() {
                most = largest(&heat.values[self.place(row)..][..part.row_length()]).max(most);
            }
            exponent = exponent.max(exponent_of(most, heat));
        }
        exponent
    }

    /// Sets everything in the rows of a range but u in the range itself, in a window that begins at
    /// `low`.
    #[inline(always)]
    fn clear(&self, range: Range<D>, low: [usize; D], steps: &Steps<D>, window: &mut Window<D>) {
        for row in range.rows() {
            let (start, stride) = (window.row(offset(row, low)), window.row_stride());
            let (to, n) = (start + row[0] - low[0], range.row_length());
            window.u[start..to].fill(0.0);
            window.u[to + n..start + stride].fill(0.0);
            if steps.exposure {
                window.sum[start..start + stride].fill(0.0);
            }
            if let Some(factor) = steps.factor {
                // No factor beyond the range: with the faces there, any other could be unstable.
                window.rate[start..to].fill(0.0);
                window.rate[to + n..start + stride].fill(0.0);
                let factors = &factor.values()[self.shape.position(row)..];
                let rates = window.rate[to..to + n].iter_mut().zip(factors);
                rates.for_each(|(rate, k)| *rate = steps.step * k);
            }
        }
    }

    /// Copies u in a range into the window that begins at `low`, scaled to an exponent; says whether
    /// some values were too small for it.
    #[inline(always)]
    fn load(
        &self,
        range: Range<D>,
        low: [usize; D],
        exponent: i32,
        window: &mut Window<D>,
    ) -> bool {
        let mut has_lost = false;
        for tile in self.tiles_around(range) {
            let heat = &self.now[tile].heat;
            let part = range.intersection(self.range_of(tile));
            let scale = Scale::new(heat.exponent.saturating_sub(exponent));
            for row in part.rows() {
                let to = window.row(offset(row, low)) + row[0] - low[0];
                let cells = &mut window.u[to..to + part.row_length()];
                if heat.values.is_empty() {
                    cells.fill(0.0);
                } else {
                    for (u, &value) in cells.iter_mut().zip(&heat.values[self.place(row)..]) {
                        *u = trusted(scale.apply(value));
                        has_lost |= (value > 0.0) & (*u == 0.0);
                    }
                }
            }
        }
        has_lost
    }

    /// Adds what the window has summed up in a range to the exposure of a tile.
    #[inline(always)]
    fn add_exposure(
        &self,
        range: Range<D>,
        low: [usize; D],
        window: &Window<D>,
        tile: &mut Visited,
    ) {
        let scale = Scale::new(tile.next.heat.exponent - tile.exposure.exponent);
        for row in range.rows() {
            let from = window.row(offset(row, low)) + row[0] - low[0];
            let sums = &window.sum[from..from + range.row_length()];
            let values = tile.exposure.values[self.place(row)..].iter_mut();
            values.zip(sums).for_each(|(value, sum)| *value += scale.apply(*sum));
        }
    }

    /// Copies a range of a tile out of the window, and notes whether something was too small to be
    /// kept.
    #[inline(always)]
    fn store(
        &self,
        range: Range<D>,
        low: [usize; D],
        window: &Window<D>,
        tile: &mut Visited,
        most: &mut Largest,
    ) {
        let nearly_lost = nearly_lost(self.tiling.steps);
        let (next, lost) = (&mut tile.next, &mut tile.lost);
        for row in range.rows() {
            let from = window.row(offset(row, low)) + row[0] - low[0];
            let cells = &window.u[from..from + range.row_length()];
            let to = self.place(row);
            let values = &mut next.heat.values[to..to + cells.len()];
            for (value, u) in values.iter_mut().zip(cells) {
                *value = trusted(*u);
                lost.some |= *u > *value;
                lost.nearly |= (*u > 0.0) & (*u < nearly_lost);
            }
            most.take(values);
        }
    }
}

/// The logarithms of one [`Scaled`] per tile, as one field.
fn logarithms<const D: usize>(
    shape: Shape<D>,
    tiling: Tiling<D>,
    mut heat: Vec<Scaled>,
    exec: &Exec,
) -> Grid<f64, D> {
    let tiles = Tiles::<D>::new(&shape, tiling);
    let mut field = vec![f64::NEG_INFINITY; shape.cells()];
    // Layers of tiles, which are whole in the field as well.
    let cells = tiling.edge[D - 1] * shape.stride(D - 1);
    let layers = heat.chunks_mut(tiles.tiles.stride(D - 1)).zip(field.chunks_mut(cells));
    let mut layers: Vec<_> = layers.enumerate().collect();
    exec.for_each(&mut layers, |(layer, (heat, field))| {
        for (number, heat) in heat.iter_mut().enumerate() {
            let range = tiles.range_of(number + *layer * tiles.tiles.stride(D - 1));
            let heat = std::mem::take(heat);
            for row in range.rows().filter(|_| !heat.values.is_empty()) {
                let (from, to) = (tiles.place(row), shape.position(row) - *layer * cells);
                let n = range.row_length();
                heat.ln(from..from + n, &mut field[to..to + n]);
            }
        }
    });
    drop(layers);
    Grid::from_parts(shape, field)
}

impl<const D: usize> Range<D> {
    fn row_length(&self) -> usize {
        self.high[0] - self.low[0]
    }

    /// The cells of one index along the last axis.
    #[inline(always)]
    fn plane(mut self, index: usize) -> Self {
        (self.low[D - 1], self.high[D - 1]) = (index, index + 1);
        self
    }

    /// The first cell of each row along x.
    #[inline(always)]
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

/// How far a cell is from another along each axis.
#[inline(always)]
fn offset<const D: usize>(cell: [usize; D], low: [usize; D]) -> [usize; D] {
    std::array::from_fn(|axis| cell[axis] - low[axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_tiles_hold_the_same_heat() {
        let shape = Shape::new([70, 45]).unwrap_or_else(|_| unreachable!("a small grid"));
        let tiling = |edge| Tiling { edge, steps: 1, reach: [1; 2], row_multiple: 8 };
        let mut tiles = Tiles::new(&shape, tiling([32, 24]));
        for cell in (0..shape.cells()).filter(|cell| cell % 7 < 4 && cell % 70 < 60) {
            tiles.add(cell, 1.0 + cell as f64);
        }
        for (number, tile) in tiles.now.iter_mut().enumerate() {
            tile.heat.exponent -= 300 * number as i32;
            tiles.visited[number].exposure = tile.heat.clone();
        }
        let copy = |tiles: &Tiles<2>| Tiles {
            now: tiles.now.clone(),
            visited: tiles.visited.clone(),
            ..*tiles
        };
        let exec = Exec::single_threaded();
        let fields = |tiles: Tiles<2>| {
            let heat = tiles.now.into_iter().map(|now| now.heat).collect();
            let exposure = tiles.visited.into_iter().map(|visited| visited.exposure).collect();
            [heat, exposure].map(|held| logarithms(shape, tiles.tiling, held, &exec))
        };
        for edge in [[16, 8], [32, 16], [24, 40]] {
            let others = copy(&tiles).cut(tiling(edge));
            for now in &others.now {
                assert_eq!(now.largest, largest(&now.heat.values));
                assert!(now.heat.values.is_empty() || now.largest > 0.0);
            }
            assert_eq!(fields(others), fields(copy(&tiles)), "{edge:?}");
        }
        assert_eq!(fields(copy(&tiles).cut(tiling([32, 24]))), fields(tiles));
    }
}
