//! What each cell receives from others in a step of explicit heat where D is a tensor.
//!
//! `u' = kept x u + sum of share x u(other cell)`. Nothing is negative, so nothing cancels: u is
//! positive wherever heat has come, and exact to a few units in its last place a step.
//!
//! Which offsets a cell has differs from cell to cell, but neighbours have most of them in common.
//! So a bundle of cells in a row along x shares one list of offsets: those of all of them. Shares
//! and values are then read a vector at a time, each from one place, and added up in registers. The
//! shares of cells that do not have an offset of their bundle are zeros, which change no bit of a
//! sum.
//!
//! What takes the time is reading the shares. They are therefore stored in single precision, which
//! is a tenth to a quarter faster: heat flows as if every conductance were changed by up to 3e-8 of
//! itself, the same for both cells of a pair. What a cell keeps is the exact rest, so heat is
//! conserved to the last bits of u, which is in double precision as ever. A share is at least
//! 1e-38, or none. Tried and slower, by an eighth to a half: lists for longer strips of a row, and
//! one offset after the other for a whole row, both with sums that go through memory.

use super::super::links::Links;
use super::super::operator::Operator;
use crate::grid::Shape;
use crate::simd::Aligned;

/// The cells that share a list of offsets, which belong together on any grid, however it is cut.
pub(super) const BUNDLE: usize = 32;

/// What cells keep, and where they receive heat from and which share of it.
#[derive(Debug)]
pub(super) struct Gather<const D: usize> {
    shape: Shape<D>,
    reach: [usize; D],
    /// All offsets: those from a cell to one after it in memory, and their opposites.
    offsets: Vec<[i16; D]>,
    /// Where the terms of each bundle begin, row by row, and where those of the last end.
    starts: Vec<usize>,
    /// The number of the offset of each term, in order in each bundle.
    terms: Vec<u32>,
    /// As many shares for each term as a bundle has cells.
    shares: Vec<Shares>,
    /// What each cell keeps, row by row in whole bundles.
    kept: Aligned,
}

/// A share for each cell of a bundle, aligned so that no vector of them straddles two cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Shares(pub(super) [f32; BUNDLE]);

/// What the cells of a bundle keep and receive.
pub(super) struct Bundle<'a> {
    pub(super) kept: &'a [f64; BUNDLE],
    /// The numbers of the offsets.
    pub(super) terms: &'a [u32],
    pub(super) shares: &'a [Shares],
}

impl<const D: usize> Gather<D> {
    /// Steps of length `step`.
    pub(super) fn new(operator: &Operator<D>, links: &Links<D>, step: f64) -> Self {
        let shape = *operator.medium().shape();
        let forward = links.offsets();
        let backward = forward.iter().map(|offset| offset.map(|part| -part));
        let mut gather = Self {
            shape,
            reach: links.reach(),
            offsets: forward.iter().copied().chain(backward).collect(),
            starts: vec![0],
            terms: Vec::new(),
            shares: Vec::new(),
            kept: Aligned::default(),
        };
        gather.list_terms(links);
        gather.fill_shares(operator, links, step);
        gather
    }

    /// The numbers of an offset of the links and of its opposite.
    fn numbers(links: &Links<D>, offset: u32) -> [u32; 2] {
        [offset, offset + links.offsets().len() as u32]
    }

    fn list_terms(&mut self, links: &Links<D>) {
        let rows = self.shape.cells() / self.shape.size()[0];
        let mut lists = vec![Vec::new(); rows * self.bundles_per_row()];
        links.for_each_pair(|pair, link| {
            for (cell, number) in pair.into_iter().zip(Self::numbers(links, link.offset)) {
                let list: &mut Vec<u32> = &mut lists[self.place(cell).0];
                if !list.contains(&number) {
                    list.push(number);
                }
            }
        });
        for list in &mut lists {
            list.sort_unstable();
            self.terms.append(list);
            self.starts.push(self.terms.len());
        }
        self.shares = vec![Shares([0.0; BUNDLE]); self.terms.len()];
    }

    fn fill_shares(&mut self, operator: &Operator<D>, links: &Links<D>, step: f64) {
        let mut kept = vec![1.0; self.shape.cells()];
        links.for_each_pair(|pair, link| {
            for (cell, number) in pair.into_iter().zip(Self::numbers(links, link.offset)) {
                let share = (step * operator.factor_of(cell) * link.conductance) as f32;
                let share = share.max(f32::MIN_POSITIVE);
                kept[cell] -= f64::from(share);
                if let Some((term, place)) = self.term(cell, number) {
                    self.shares[term].0[place] = share;
                }
            }
        });
        self.kept = Aligned::zeros((self.starts.len() - 1) * BUNDLE);
        for (cell, kept) in kept.into_iter().enumerate() {
            let (bundle, place) = self.place(cell);
            self.kept[bundle * BUNDLE + place] = kept.max(0.0);
        }
    }

    fn bundles_per_row(&self) -> usize {
        self.shape.size()[0].div_ceil(BUNDLE)
    }

    /// The bundle of a cell and its place in it.
    fn place(&self, cell: usize) -> (usize, usize) {
        let width = self.shape.size()[0];
        let (row, x) = (cell / width, cell % width);
        (row * self.bundles_per_row() + x / BUNDLE, x % BUNDLE)
    }

    /// The term of a cell with an offset, if there is one, and the cell's place in its bundle.
    fn term(&self, cell: usize, offset: u32) -> Option<(usize, usize)> {
        let (bundle, place) = self.place(cell);
        let terms = self.starts[bundle]..self.starts[bundle + 1];
        let term = self.terms[terms.clone()].binary_search(&offset).ok()?;
        Some((terms.start + term, place))
    }

    /// How many cells heat moves along each axis in one step at most.
    pub(super) fn reach(&self) -> [usize; D] {
        self.reach
    }

    /// How far apart the two cells of each offset are where rows and planes are so far apart.
    pub(super) fn shifts(&self, strides: &[usize; D]) -> Vec<isize> {
        let shift = |offset: &[i16; D]| {
            (1..D).fold(isize::from(offset[0]), |sum, axis| {
                sum + isize::from(offset[axis]) * strides[axis] as isize
            })
        };
        self.offsets.iter().map(shift).collect()
    }

    /// The cells from which a cell receives heat, and which receive heat from it.
    pub(super) fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> {
        let shifts = self.shifts(&std::array::from_fn(|axis| self.shape.stride(axis)));
        let (bundle, place) = self.place(cell);
        let terms = self.starts[bundle]..self.starts[bundle + 1];
        terms
            .filter(move |&term| self.shares[term].0[place] > 0.0)
            .map(move |term| cell.wrapping_add_signed(shifts[self.terms[term] as usize]))
    }

    /// Some bundles of a row of the grid: what their cells keep, and their terms with all shares.
    #[inline(always)]
    pub(super) fn bundles(
        &self,
        row: [usize; D],
        first: usize,
        count: usize,
    ) -> impl Iterator<Item = Bundle<'_>> {
        let row = self.shape.position(row) / self.shape.size()[0];
        let first = row * self.bundles_per_row() + first;
        let (kept, _) = self.kept.as_chunks::<BUNDLE>();
        self.starts[first..=first + count].windows(2).zip(&kept[first..]).map(
            #[inline(always)]
            move |(ends, kept)| Bundle {
                kept,
                terms: &self.terms[ends[0]..ends[1]],
                shares: &self.shares[ends[0]..ends[1]],
            },
        )
    }
}
