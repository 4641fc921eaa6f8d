//! The stencil of an anisotropic medium.

use super::stencil::{Dependent, Stencil};
use super::value::Value;
use crate::exec::Exec;
use crate::grid::medium::Medium;
use crate::grid::stencil::selling;
use crate::grid::tensor::{apply, inverse, per_cell};
use crate::grid::{Mask, Matrix, Shape};
use crate::simd::prefetch;
use std::array;

/// The eikonal equation along a few offsets of the lattice in each cell, those of its tensor's
/// decomposition `D = sum of weight offset offset'`: the weighted squared derivatives add up to 1
/// (Mirebeau, "Riemannian fast-marching on Cartesian grids using Voronoi's first reduction of quadratic
/// forms", 2019).
#[derive(Debug)]
pub(super) struct Lattice<const D: usize, const N: usize> {
    shape: Shape<D>,
    strides: [usize; D],
    terms: Vec<[Term<D>; N]>,
    /// For each cell the first of its `dependents`, and their number at the end.
    starts: Vec<u32>,
    dependents: Vec<PackedDependent>,
}

/// A weight along an offset; 0 along none.
#[derive(Clone, Copy, Debug)]
struct Term<const D: usize> {
    weight: f64,
    offset: [i16; D],
    /// How many steps can be made, 0 to 2: behind and ahead.
    open: [u8; 2],
}

/// A cell whose equation holds another.
#[derive(Clone, Copy, Debug, Default)]
struct PackedDependent {
    cell: u32,
    /// `N` if it is a neighbour along an axis.
    term: u8,
    /// Whether the other is ahead of it.
    ahead: bool,
}

impl<const D: usize> Term<D> {
    const NONE: Self = Self { weight: 0.0, offset: [0; D], open: [0; 2] };
}

impl<const D: usize, const N: usize> Lattice<D, N> {
    pub(super) fn new(medium: &Medium<D>, exec: &Exec) -> Self {
        let shape = *medium.shape();
        let mut terms = vec![[Term::NONE; N]; shape.cells()];
        let walls = !medium.mask().is_all_open();
        let row_length = shape.size()[0];
        let mut rows: Vec<_> = terms.chunks_mut(row_length).enumerate().collect();
        exec.for_each(&mut rows, |(row, terms)| {
            let cells = *row * row_length..;
            for (cell, terms) in cells.zip(terms.iter_mut()) {
                if medium.mask().is_open(cell) {
                    *terms = terms_of(medium, walls, cell);
                }
            }
        });
        let strides = array::from_fn(|axis| shape.stride(axis));
        let mut lattice =
            Self { shape, strides, terms, starts: Vec::new(), dependents: Vec::new() };
        lattice.find_dependents();
        lattice
    }

    fn find_dependents(&mut self) {
        let mut starts = vec![0_u32; self.shape.cells() + 1];
        self.for_pairs(|_, other| starts[other + 1] += 1);
        for cell in 0..self.shape.cells() {
            starts[cell + 1] += starts[cell];
        }
        let mut next = starts.clone();
        let mut dependents = vec![PackedDependent::default(); starts[self.shape.cells()] as usize];
        self.for_pairs(|dependent, other| {
            dependents[next[other] as usize] = dependent;
            next[other] += 1;
        });
        (self.starts, self.dependents) = (starts, dependents);
    }

    /// Calls `visit` with each cell and each other that its equation holds.
    fn for_pairs(&self, mut visit: impl FnMut(PackedDependent, usize)) {
        for (cell, terms) in self.terms.iter().enumerate() {
            for term in 0..terms.len() {
                for ahead in [false, true] {
                    let steps = if ahead { 1 } else { -1 };
                    if let Some(other) = self.neighbour(cell, term, steps) {
                        visit(
                            PackedDependent { cell: cell as u32, term: term as u8, ahead },
                            other,
                        );
                    }
                }
            }
            if self.has_closed_side(cell) {
                let along_axis = PackedDependent { cell: cell as u32, term: N as u8, ahead: false };
                let neighbours = self.shape.neighbours(cell).filter(|&other| self.is_open(other));
                neighbours.for_each(|other| visit(along_axis, other));
            }
        }
    }
}

/// The terms of an open cell.
fn terms_of<const D: usize, const N: usize>(
    medium: &Medium<D>,
    walls: bool,
    cell: usize,
) -> [Term<D>; N] {
    let shape = medium.shape();
    let tensor = per_cell(&medium.speed_sq_tensor(cell), shape);
    let index = shape.index(cell);
    let term = |(offset, weight): ([i32; D], f64)| {
        let offset = offset.map(|part| part as i16);
        Term { weight, offset, open: steps(medium.mask(), walls, index, offset) }
    };
    let mut terms = [Term::NONE; N];
    terms.iter_mut().zip(selling(&tensor)).for_each(|(place, sum)| *place = term(sum));
    terms
}

/// How many steps, at most two, can be made along an offset before a wall or the border.
fn steps<const D: usize>(
    mask: &Mask<D>,
    walls: bool,
    index: [usize; D],
    offset: [i16; D],
) -> [u8; 2] {
    let size = mask.shape().size();
    let point = |steps: isize| {
        array::from_fn(|axis| index[axis].wrapping_add_signed(steps * isize::from(offset[axis])))
    };
    let is_inside = |point: &[usize; D]| (0..D).all(|axis| point[axis] < size[axis]);
    let is_clear = |from: isize, to: isize| {
        let [from, to] = [from, to].map(|steps| point(steps).map(|part| part as f64));
        mask.segment_is_open(from, to)
    };
    let is_open = |from, to| is_inside(&point(to)) && (!walls || is_clear(from, to));
    [-1, 1].map(|side| match (is_open(0, side), is_open(side, 2 * side)) {
        (false, _) => 0,
        (true, false) => 1,
        (true, true) => 2,
    })
}

impl<const D: usize, const N: usize> Stencil<D, N> for Lattice<D, N> {
    fn places(&self) -> usize {
        self.shape.cells()
    }

    fn place(&self, index: [usize; D]) -> usize {
        self.shape.position(index)
    }

    fn is_open(&self, place: usize) -> bool {
        self.terms[place][0].weight > 0.0
    }

    #[inline]
    fn weight(&self, place: usize, direction: usize) -> f64 {
        self.terms[place][direction].weight
    }

    #[inline]
    fn neighbour(&self, place: usize, direction: usize, steps: isize) -> Option<usize> {
        let Term { offset, open, .. } = &self.terms[place][direction];
        let stride: isize =
            (0..D).map(|axis| isize::from(offset[axis]) * self.strides[axis] as isize).sum();
        let is_open = usize::from(open[usize::from(steps > 0)]) >= steps.unsigned_abs();
        is_open.then(|| place.wrapping_add_signed(steps * stride))
    }

    #[inline]
    fn has_closed_side(&self, place: usize) -> bool {
        self.terms[place].iter().any(|term| term.weight > 0.0 && term.open.contains(&0))
    }

    fn is_open_at(&self, point: [f64; D]) -> bool {
        self.shape.contains(point) && self.is_open(self.shape.position(self.shape.cell_at(point)))
    }

    fn nearest_along_axes(
        &self,
        place: usize,
        distance: impl Fn(usize) -> f64,
    ) -> Option<(f64, usize)> {
        if !self.has_closed_side(place) {
            return None;
        }
        let mut tensor = [[0.0; D]; D];
        for (direction, term) in self.terms[place].iter().enumerate() {
            let vector = self.vector(place, direction);
            (0..D).for_each(|i| {
                (0..D).for_each(|j| tensor[i][j] += term.weight * vector[i] * vector[j]);
            });
        }
        let metric = inverse(&tensor);
        let index = self.shape.index(place);
        let neighbours = self.shape.neighbours(place).filter(|&other| self.is_open(other));
        let along = neighbours.map(|other| {
            let there = self.shape.index(other);
            let axis = (0..D).find(|&axis| there[axis] != index[axis]).unwrap_or(0);
            (distance(other) + metric[axis][axis].sqrt(), other)
        });
        along.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    #[inline]
    fn vector(&self, place: usize, direction: usize) -> [f64; D] {
        self.terms[place][direction].offset.map(f64::from)
    }

    #[inline]
    fn along(&self, place: usize, direction: usize, covector: &[f64; D]) -> f64 {
        let vector = self.vector(place, direction);
        (0..D).map(|axis| vector[axis] * covector[axis]).sum()
    }

    #[inline]
    fn length_sq(&self, place: usize, direction: usize, metric: &Matrix<D>) -> f64 {
        self.along(place, direction, &apply(metric, self.vector(place, direction)))
    }

    #[inline]
    fn for_dependents(&self, place: usize, mut visit: impl FnMut(Dependent<D>)) {
        let range = self.starts[place] as usize..self.starts[place + 1] as usize;
        for &PackedDependent { cell, term, ahead } in &self.dependents[range] {
            let place = cell as usize;
            let side = if ahead { -1 } else { 1 };
            let direction = (usize::from(term) < N).then_some(usize::from(term));
            let opposite = direction.and_then(|direction| self.neighbour(place, direction, side));
            visit(Dependent { place, index: self.shape.index(place), direction, opposite });
        }
    }

    #[inline]
    fn prefetch_around(&self, place: usize, values: &[Value]) {
        let range = self.starts[place] as usize..self.starts[place + 1] as usize;
        for &PackedDependent { cell, .. } in &self.dependents[range] {
            let terms = &self.terms[cell as usize];
            [&terms[0], &terms[N - 1]].into_iter().for_each(prefetch);
            prefetch(&values[cell as usize]);
        }
    }
}
