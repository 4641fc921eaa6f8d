//! Forward and backward substitution in one block of the factor.
//!
//! In the backward pass an unknown is a sum over the unknowns below it in its column, and these lie
//! in a few runs of neighbours in space: where values differ by less than 2^400 a run, or *band*,
//! is scaled by one power of two and multiplied in plain f64. No product of a trusted entry of the
//! factor with such a value underflows, so the bits are those of floats without limits. The sums of
//! a few unknowns at a time, one for each band, are then added as [`Wide`].

use super::Wide;

/// How many columns are computed together.
const COLUMNS: usize = 8;

/// Values of a band stand at 2^LOW to 2^HIGH; the first one at 2^MIDDLE.
const LOW: i32 = 80;
const MIDDLE: i32 = 280;
const HIGH: i32 = 480;

/// Neighbouring columns of the factor of like pattern.
pub(super) struct Block<'a> {
    /// The unknowns of the columns.
    pub(super) start: usize,
    pub(super) end: usize,
    /// The other unknowns of the rows.
    pub(super) pattern: &'a [usize],
    /// The number of rows.
    pub(super) height: usize,
    /// Column by column.
    pub(super) values: &'a [f64],
}

impl<'a> Block<'a> {
    pub(super) fn width(&self) -> usize {
        self.end - self.start
    }

    #[inline(always)]
    pub(super) fn column(&self, column: usize) -> &'a [f64] {
        &self.values[column * self.height..][..self.height]
    }

    /// The unknown of a row.
    #[inline(always)]
    fn unknown(&self, row: usize) -> usize {
        if row < self.width() { self.start + row } else { self.pattern[row - self.width()] }
    }

    /// Computes y of the columns, and takes their part from the rows below.
    #[inline(always)]
    pub(super) fn forward(&self, y: &mut [Wide]) {
        for first in (0..self.width()).step_by(COLUMNS) {
            let end = self.width().min(first + COLUMNS);
            for j in first..end {
                let column = self.column(j);
                let value = y[self.start + j].times(1.0 / column[j]);
                y[self.start + j] = value;
                for i in j + 1..end {
                    let row = &mut y[self.start + i];
                    *row = row.plus(value.times(-column[i]));
                }
            }
            let solved: Vec<Wide> = (first..end).map(|j| y[self.start + j]).collect();
            self.spread(first, &solved, y);
        }
    }

    /// Takes the part of the columns from `first` on, whose y are `solved`, from the rows below.
    #[inline(always)]
    fn spread(&self, first: usize, solved: &[Wide], y: &mut [Wide]) {
        let mut sums = vec![0.0; self.height - first - solved.len()];
        let mut bands = Bands::default();
        let mut values = vec![0.0; solved.len()];
        for (j, &value) in solved.iter().enumerate().rev() {
            values[j] = bands.push(j, value);
        }
        for band in &bands.0 {
            sums.fill(0.0);
            for (j, value) in (band.start..band.end).zip(&values[band.start..]) {
                let column = &self.column(first + j)[first + solved.len()..];
                sums.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * value);
            }
            for (i, &sum) in sums.iter().enumerate() {
                let row = &mut y[self.unknown(first + solved.len() + i)];
                *row = row.plus(Wide::new(-sum, band.exponent));
            }
        }
    }

    /// Computes x of the columns from y there and x of the rows below, for several solutions.
    #[inline(always)]
    pub(super) fn backward(&self, solutions: &mut [Vec<Wide>], scratch: &mut [Below]) {
        for (solution, below) in solutions.iter().zip(&mut *scratch) {
            below.restart(self.height);
            for row in (self.width()..self.height).rev() {
                below.push(row, solution[self.unknown(row)]);
            }
        }
        let mut end = self.width();
        while end > 0 {
            let first = (end - 1) / COLUMNS * COLUMNS;
            for (solution, below) in solutions.iter_mut().zip(&mut *scratch) {
                let x = &mut solution[self.start + first..self.start + end];
                self.take_rows_below(first, x, below);
                self.solve_corner(first, x);
                x.iter().enumerate().rev().for_each(|(j, &value)| below.push(first + j, value));
            }
            end = first;
        }
    }

    /// Subtracts from `x`, of the columns from `first` on, the part of the rows below.
    #[inline(always)]
    fn take_rows_below(&self, first: usize, x: &mut [Wide], below: &Below) {
        for band in &below.bands.0 {
            let rows = band.start..band.end;
            let values = &below.values[rows.clone()];
            for (group, x) in x.chunks_mut(4).enumerate() {
                let column =
                    |j: usize| &self.column(first + 4 * group + j.min(x.len() - 1))[rows.clone()];
                let sums = dots([column(0), column(1), column(2), column(3)], values);
                for (x, sum) in x.iter_mut().zip(sums) {
                    *x = x.plus(Wide::new(-sum, band.exponent));
                }
            }
        }
    }

    /// Solves the small triangle of the columns from `first` on.
    #[inline(always)]
    fn solve_corner(&self, first: usize, x: &mut [Wide]) {
        let entry = |i: usize, j: usize| self.column(first + j)[first + i];
        let exponents = x.iter().map(|x| x.exponent());
        let largest = exponents.clone().fold(i32::MIN, i32::max);
        if exponents.fold(i32::MAX, i32::min) < largest - 200 {
            // The values are too far apart for one exponent.
            for j in (0..x.len()).rev() {
                let sum = (j + 1..x.len()).fold(x[j], |sum, i| sum.plus(x[i].times(-entry(i, j))));
                x[j] = sum.times(1.0 / entry(j, j));
            }
            return;
        }
        let mut values = [0.0; COLUMNS];
        for j in (0..x.len()).rev() {
            let sum = (j + 1..x.len())
                .fold(x[j].relative_to(largest), |sum, i| sum - entry(i, j) * values[i]);
            values[j] = sum / entry(j, j);
            x[j] = Wide::new(values[j], largest);
        }
    }
}

/// The solution in the rows of a block, gathered and scaled.
#[derive(Clone, Default)]
pub(super) struct Below {
    values: Vec<f64>,
    bands: Bands,
}

impl Below {
    fn restart(&mut self, height: usize) {
        self.values.resize(self.values.len().max(height), 0.0);
        self.bands.0.clear();
    }

    #[inline(always)]
    fn push(&mut self, row: usize, value: Wide) {
        self.values[row] = self.bands.push(row, value);
    }
}

/// Runs of rows whose values are divided by the same power of two. Rows come from the last to the
/// first.
#[derive(Clone, Default)]
struct Bands(Vec<Band>);

#[derive(Clone)]
struct Band {
    start: usize,
    end: usize,
    exponent: i32,
}

impl Bands {
    /// Takes the row before those so far; the value as it is to be stored.
    #[inline(always)]
    fn push(&mut self, row: usize, value: Wide) -> f64 {
        if let Some(last) = self.0.last_mut()
            && last.start == row + 1
        {
            let exponent = value.exponent() - last.exponent;
            if value.is_zero() || (LOW..=HIGH).contains(&exponent) {
                last.start = row;
                return value.relative_to(last.exponent);
            }
        }
        if value.is_zero() {
            return 0.0;
        }
        let exponent = value.exponent() - MIDDLE;
        self.0.push(Band { start: row, end: row + 1, exponent });
        value.relative_to(exponent)
    }
}

/// The scalar products of four columns with `values`.
///
/// Eight sums each, added in the end, so that they fill vectors.
#[inline(always)]
fn dots(columns: [&[f64]; 4], values: &[f64]) -> [f64; 4] {
    let (values, last_values) = values.as_chunks::<8>();
    let columns: [_; 4] = std::array::from_fn(|c| columns[c].as_chunks::<8>());
    let mut sums = [[0.0; 8]; 4];
    for (i, values) in values.iter().enumerate() {
        for c in 0..4 {
            for lane in 0..8 {
                sums[c][lane] += columns[c].0[i][lane] * values[lane];
            }
        }
    }
    for (lane, value) in last_values.iter().enumerate() {
        for c in 0..4 {
            sums[c][lane] += columns[c].1[lane] * value;
        }
    }
    std::array::from_fn(|c| {
        let s = sums[c];
        ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]))
    })
}
