//! Explicit heat: one row, and the order of rows when several steps are made at once.

use super::stencil::{Across, FaceStencil, ROW_MULTIPLE, Stencil};
use crate::simd::{Aligned, Lanes};
use bytemuck::{cast_slice, cast_slice_mut};
use std::ops::Range;

/// A row of cells and what flows into it. All slices are of one length, u but one vector longer.
///
/// Along x the neighbours are in the row; the first entries of `across`, `next` and `inflow` are for
/// axis 1, the second for axis 2, if there is one.
struct Row<'a, V, C, const D: usize> {
    u: &'a mut [V],
    /// `step x k`.
    rate: &'a [V],
    /// The conductances towards the next cell in the row.
    along: &'a [V],
    /// The conductances towards the next row along each axis.
    across: [C; 2],
    /// u of the next row along each axis.
    next: [&'a [V]; 2],
    /// Before: what flows in from the row before along each axis. After: what flows out, to the row
    /// after.
    inflow: [&'a mut [V]; 2],
    /// To be added u after the step.
    sum: &'a mut [V],
}

/// The conductances from a row to the next.
trait Conductances<V>: Copy {
    fn upto(self, n: usize) -> Self;
    fn at(self, i: usize) -> V;
}

impl<V: Copy> Conductances<V> for &[V] {
    #[inline(always)]
    fn upto(self, n: usize) -> Self {
        &self[..n]
    }

    #[inline(always)]
    fn at(self, i: usize) -> V {
        self[i]
    }
}

/// The same conductance everywhere.
#[derive(Clone, Copy)]
struct Equal<V>(V);

impl<V: Copy> Conductances<V> for Equal<V> {
    #[inline(always)]
    fn upto(self, _: usize) -> Self {
        self
    }

    #[inline(always)]
    fn at(self, _: usize) -> V {
        self.0
    }
}

impl<V: bytemuck::Pod, C: Conductances<V>, const D: usize> Row<'_, V, C, D> {
    /// `u' = u + rate x sum over axes (flux from the cell after - flux to the cell before)`.
    ///
    /// A flux is a conductance times a difference of u. Each is computed once, from u before the
    /// step, and serves both cells: that is why the row can be updated in place. The order of
    /// operations gives the same bits for a picture and its mirror image, and for a picture and its
    /// transpose.
    #[inline(always)]
    fn step<const SUM: bool>(self, lanes: impl Lanes<Vector = V>) {
        let Self { u, rate, next: [next_y, next_z], .. } = self;
        let [inflow_y, inflow_z] = self.inflow;
        // One length for all, seen by the compiler, leaves no bounds to check in the loop.
        let n = rate.len();
        let u = &mut u[..=n];
        let (along, across) = (&self.along[..n], self.across.map(|across| across.upto(n)));
        let next = [&next_y[..n], &next_z[..n]];
        let inflow = [&mut inflow_y[..n], &mut inflow_z[..n]];
        let sum = &mut self.sum[..if SUM { n } else { 0 }];
        let rate = &rate[..n];
        let zero = lanes.splat(0.0);
        let (mut here, mut flux_before) = (u[0], zero);
        for i in 0..n {
            let after = u[i + 1];
            let flux = lanes.mul(along[i], lanes.sub(lanes.one_after(here, after), here));
            let mut net = lanes.sub(flux, lanes.one_before(flux_before, flux));
            flux_before = flux;
            for axis in 0..D - 1 {
                let flux = lanes.mul(across[axis].at(i), lanes.sub(next[axis][i], here));
                net = lanes.add(net, lanes.sub(flux, inflow[axis][i]));
                inflow[axis][i] = flux;
            }
            u[i] = lanes.add(here, lanes.mul(rate[i], net));
            if SUM {
                sum[i] = lanes.add(sum[i], u[i]);
            }
            here = after;
        }
    }
}

/// Part of the grid, copied to where it can be advanced by several steps.
pub(super) struct Window<const D: usize> {
    /// The numbers from one row to the next along each axis but x (0 along x).
    pub(super) strides: [usize; D],
    /// How many planes there is room for; those that are done make room for others.
    planes: usize,
    /// The numbers before the first row.
    first: usize,
    pub(super) u: Aligned,
    /// u before or after a step where it cannot be updated in place; empty where it can.
    pub(super) other: Aligned,
    /// How far apart in the window the cells of each offset of the stencil are.
    pub(super) shifts: Vec<isize>,
    /// `step x k` of every cell, or of one row if it is the same everywhere.
    pub(super) rate: Aligned,
    pub(super) rate_is_uniform: bool,
    /// u added up over the steps, in the rows that are right to the last step; empty if not wanted.
    pub(super) sum: Aligned,
    /// What flows from one row to the next along the last axis, for each step and each row of a
    /// plane.
    inflow_last: Aligned,
    /// What flows from one row to the next along the axis between the first and the last.
    inflow_middle: Aligned,
}

/// How planes get into a window and out of it. A plane is all rows of one index along the last axis.
pub(super) trait Traffic<const D: usize> {
    /// Copies a plane in, before the first step.
    fn enter(&mut self, window: &mut Window<D>, plane: usize);
    /// Copies a plane out, after the last step.
    fn leave(&mut self, window: &Window<D>, plane: usize);
}

/// What a window holds.
#[derive(Clone, Copy)]
pub(super) struct Extent<const D: usize> {
    /// The first cell, in the grid.
    pub(super) low: [usize; D],
    /// The cells along each axis.
    pub(super) size: [usize; D],
    /// Whether the grid ends there, before the first cell and behind the last along each axis.
    pub(super) is_border: [(bool, bool); D],
}

impl<const D: usize> Extent<D> {
    /// The cells along an axis that are further than `margin` from the ends of the window, except
    /// at the border of the grid.
    ///
    /// What lies outside the window is not known, so along each axis some cells more become wrong
    /// with every step. Along x whole rows are computed.
    #[inline(always)]
    pub(super) fn inner(&self, axis: usize, margin: usize) -> Range<usize> {
        let (starts, ends) = self.is_border[axis];
        let low = if starts { 0 } else { margin };
        low..self.size[axis] - if ends { 0 } else { margin }
    }

    /// The cells of a row that are computed.
    #[inline(always)]
    fn row_length(&self) -> usize {
        self.size[0].next_multiple_of(ROW_MULTIPLE)
    }
}

impl<const D: usize> Window<D> {
    pub(super) fn new(
        room: [usize; D],
        steps: usize,
        stencil: &Stencil<D>,
        with_sum: bool,
    ) -> Self {
        let multiple = stencil.row_multiple();
        let mut strides = [0; D];
        strides[1] = room[0].next_multiple_of(multiple) + multiple;
        for axis in 2..D {
            // Behind the last row one more is read, through faces without conductance.
            strides[axis] = strides[axis - 1] * (room[axis - 1] + 1);
        }
        let planes = match stencil {
            // The one that enters, and one for each step.
            Stencil::Faces(_) => steps + 1,
            Stencil::Gather(_) => room[D - 1] + 1,
        };
        let mut numbers = strides[D - 1] * planes;
        let mut window = Self {
            strides,
            planes,
            first: 0,
            u: Aligned::default(),
            other: Aligned::default(),
            shifts: Vec::new(),
            rate: Aligned::default(),
            rate_is_uniform: false,
            sum: Aligned::default(),
            inflow_last: Aligned::default(),
            inflow_middle: Aligned::default(),
        };
        match stencil {
            Stencil::Faces(_) => {
                window.rate = Aligned::zeros(numbers);
                window.inflow_last = Aligned::zeros(strides[D - 1] * steps);
                window.inflow_middle = Aligned::zeros(strides[1]);
            }
            Stencil::Gather(gather) => {
                // What lies beyond the ends of the first and the last row is read, and counts for
                // nothing.
                window.first = gather.reach()[0].next_multiple_of(multiple);
                numbers += 2 * window.first;
                window.other = Aligned::zeros(numbers);
                window.shifts = gather.shifts(&strides);
            }
        }
        window.u = Aligned::zeros(numbers);
        window.sum = Aligned::zeros(if with_sum { numbers } else { 0 });
        window
    }

    /// Where the row of a cell begins.
    #[inline(always)]
    pub(super) fn row(&self, index: [usize; D]) -> usize {
        let last = index[D - 1] % self.planes * self.strides[D - 1];
        (1..D - 1).fold(self.first + last, |start, axis| start + index[axis] * self.strides[axis])
    }

    /// The numbers that belong to a row, with room for a vector behind it.
    #[inline(always)]
    pub(super) fn row_stride(&self) -> usize {
        self.strides[1]
    }

    /// Advances all cells by `steps`, which may be fewer than there is room for.
    #[inline(always)]
    pub(super) fn advance<L: Lanes>(
        &mut self,
        lanes: L,
        stencil: &Stencil<D>,
        extent: &Extent<D>,
        steps: usize,
        traffic: &mut impl Traffic<D>,
    ) {
        let planes = 0..extent.size[D - 1];
        match stencil {
            Stencil::Faces(faces) => self.flow_through(lanes, faces, extent, steps, traffic),
            Stencil::Gather(gather) => {
                planes.clone().for_each(|plane| traffic.enter(self, plane));
                self.gather(lanes, gather, extent, steps);
                planes.for_each(|plane| traffic.leave(self, plane));
            }
        }
    }

    /// Advances all cells by what flows through their faces.
    ///
    /// The rows (in 3-D: planes) are passed over once by a front of all steps: behind the first
    /// step, one row later, follows the second, and so on. So a row is read from cache by all steps
    /// but the first, and only as many are in the window as there are steps.
    #[inline(always)]
    fn flow_through<L: Lanes>(
        &mut self,
        lanes: L,
        stencil: &FaceStencil<D>,
        extent: &Extent<D>,
        steps: usize,
        traffic: &mut impl Traffic<D>,
    ) {
        self.inflow_last.fill(0.0);
        let planes = extent.size[D - 1];
        traffic.enter(self, 0);
        for front in 0..planes + steps - 1 {
            if front + 1 < planes {
                traffic.enter(self, front + 1);
            }
            let mut after = (front + 1) % self.planes;
            for step in 0..steps.min(front + 1) {
                let here = after.checked_sub(1).unwrap_or(self.planes - 1);
                if extent.inner(D - 1, step).contains(&(front - step)) {
                    let places = [here, after].map(|place| place * self.strides[D - 1]);
                    self.step_plane(lanes, stencil, extent, [front - step, step], steps, places);
                }
                after = here;
            }
            if front + 1 >= steps {
                traffic.leave(self, front + 1 - steps);
            }
        }
    }

    /// Makes one step of the rows whose last index is `plane`, which begin at `here` in the window;
    /// those of the plane after it begin at `after`.
    #[inline(always)]
    fn step_plane<L: Lanes>(
        &mut self,
        lanes: L,
        stencil: &FaceStencil<D>,
        extent: &Extent<D>,
        [plane, step]: [usize; 2],
        steps: usize,
        [here, after]: [usize; 2],
    ) {
        let rows = if D == 2 { 0..1 } else { extent.inner(1, step) };
        if D == 3 {
            self.inflow_middle.fill(0.0);
        }
        for y in rows {
            let mut index = [0; D];
            index[1] = y;
            index[D - 1] = plane;
            let lasts = (1..D).all(|axis| extent.inner(axis, steps).contains(&index[axis]));
            let mut cell = index;
            (0..D).for_each(|axis| cell[axis] += extent.low[axis]);
            let before = if D == 2 { 0 } else { y * self.strides[1] };
            // Along the last axis the inflow is kept for each step and each row of a plane.
            let inflow = step * self.strides[D - 1] + before;
            let row = [here + before, after + before, inflow, extent.row_length()];
            let (along, sums) = (stencil.along(cell), lasts && !self.sum.is_empty());
            match stencil.across(cell) {
                Across::Equal(across) => {
                    let across = across.map(|conductance| Equal(lanes.splat(conductance)));
                    self.step_row(lanes, along, across, row, sums);
                }
                Across::Varying(across) => {
                    let across = across.map(cast_slice::<_, L::Vector>);
                    self.step_row(lanes, along, across, row, sums);
                }
            }
        }
    }

    /// Makes one step of a row that begins at `start`, is followed by that at `after` along the last
    /// axis, has its inflow from there at `inflow`, and is so many `numbers` long; adds them up if it
    /// `sums`.
    #[inline(always)]
    fn step_row<L: Lanes, C: Conductances<L::Vector>>(
        &mut self,
        lanes: L,
        along: &[f64],
        across: [C; 2],
        [start, after, inflow, numbers]: [usize; 4],
        sums: bool,
    ) {
        let rate = if self.rate_is_uniform { 0 } else { start };
        // Along the axis between the first and the last.
        let below =
            if D == 2 { 0..0 } else { start + self.strides[1]..start + self.strides[1] + numbers };
        let parts = [start..start + self.strides[1], after..after + numbers, below];
        let Ok([u, after, below]) = self.u.get_disjoint_mut(parts) else {
            unreachable!("rows do not overlap")
        };
        let (after, below) = (cast_slice(after), cast_slice(below));
        let middle: &mut [L::Vector] = cast_slice_mut(&mut self.inflow_middle[..numbers]);
        let last = cast_slice_mut(&mut self.inflow_last[inflow..][..numbers]);
        let row = Row::<_, _, D> {
            u: cast_slice_mut(u),
            rate: cast_slice(&self.rate[rate..rate + numbers]),
            along: cast_slice(along),
            across,
            next: if D == 2 { [after, after] } else { [below, after] },
            inflow: if D == 2 { [last, middle] } else { [middle, last] },
            sum: if sums { cast_slice_mut(&mut self.sum[start..start + numbers]) } else { &mut [] },
        };
        if sums {
            row.step::<true>(lanes);
        } else {
            row.step::<false>(lanes);
        }
    }
}
