//! Second derivatives averaged along lines in many directions.

use super::kernel::{mirror, pad};
use super::separable::{Derivatives, for_each_slab, second_orders, slab_cells};
use crate::exec::{Cancelled, Exec};
use crate::grid::tensor::apply;
use crate::grid::{Grid, Matrix, Shape, eigen};
use std::ops::Range;

/// Where a line ends, in standard deviations.
const TRUNCATE: f64 = 3.0;

/// How many cells of a row are computed at once.
const BLOCK: usize = 32;

/// What becomes the directions in a plane by turns and flips: 12 of them, 15 degrees apart.
const IN_PLANE: [[f64; 3]; 4] =
    [[1.0, 0.0, 0.0], [1.0, 2.0 - SQRT_3, 0.0], [1.0, SQRT_3 / 3.0, 0.0], [1.0, 1.0, 0.0]];

/// The same in space: 49 directions, of all cells up to two away along each axis. Any
/// other is within 17.7 degrees of one of them.
const IN_SPACE: [[f64; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [1.0, 1.0, 1.0],
    [2.0, 1.0, 0.0],
    [2.0, 1.0, 1.0],
    [2.0, 2.0, 1.0],
];

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// The second derivatives of an image at one scale, and the lines to average them along.
///
/// They are smooth, so a line is a few samples about a scale apart, each at the nearest cell: blurs
/// across the line by a twelfth of a cell squared, less than interpolation between two cells does.
/// Each sample is a shift, so the average of a row of cells is a weighted sum of rows.
pub(super) struct Lines<const D: usize> {
    shape: Shape<D>,
    /// For each slab, each component and each row: the values with mirrored ones at both ends.
    values: Vec<f64>,
    margin: usize,
    lines: Vec<Line<D>>,
}

impl<const D: usize> Lines<D> {
    /// The second derivatives times `factor`, and lines that bring the standard deviation of a
    /// Gaussian of `scale` cell units to `elongation * scale` along each direction.
    pub(super) fn new(
        image: &Grid<f64, D>,
        derivatives: &Derivatives<D>,
        [factor, scale, elongation]: [f64; 3],
        progress: (Range<f64>, &Exec),
    ) -> Result<Self, Cancelled> {
        let shape = *image.shape();
        let deviation = scale * (elongation * elongation - 1.0).sqrt();
        let line = |along| Line::new(along, &shape, [factor, scale, deviation]);
        let lines: Vec<_> = directions().into_iter().map(line).collect();
        let reach = |line: &Line<D>| line.samples.iter().map(|(_, offset)| offset[0]).max();
        let margin = lines.iter().filter_map(reach).max().unwrap_or(0) as usize;
        let width = shape.size()[0];
        let stride = width + 2 * margin;
        let pairs = pairs::<D>();
        let mut values = vec![0.0; shape.cells() / width * stride * pairs.len()];
        let rows = slab_cells(&shape) / width;
        let put = |slab: &mut [f64], component: usize, first: usize, row: &[f64]| {
            let start = (component * rows + first / width) * stride;
            let padded = &mut slab[start..start + stride];
            pad(row, margin, padded);
            if pairs[component][0] == 0 && pairs[component][1] != 0 {
                let seen = padded.iter_mut().enumerate();
                let turned = seen.filter(|(i, _)| turned(*i as isize - margin as isize, width));
                turned.for_each(|(_, value)| *value = -*value);
            }
        };
        derivatives.fill(image, &second_orders(), &mut values, progress, put)?;
        Ok(Self { shape, values, margin, lines })
    }

    /// Calls `visit(part, cell, matrix, frame)` for the averaged matrix of each cell of the slab that
    /// each of `parts` belongs to, along each direction.
    pub(super) fn visit<T: Send>(
        &self,
        parts: impl Iterator<Item = T>,
        (share, exec): (Range<f64>, &Exec),
        visit: impl Fn(&mut T, usize, &Matrix<D>, &Frame<D>) + Sync + Send,
    ) -> Result<(), Cancelled> {
        let width = self.shape.size()[0];
        let pairs = pairs::<D>();
        let scratch = || (vec![0.0; width], vec![[[0.0; D]; D]; width], Vec::new());
        for_each_slab(exec, share, parts, scratch, |(row, matrices, taps), slab, part| {
            for line in &self.lines {
                for first in (0..slab_cells(&self.shape)).step_by(width) {
                    for (component, &[i, j]) in pairs.iter().enumerate() {
                        self.place(line, slab * slab_cells(&self.shape) + first, component, taps);
                        exec.simd().run(
                            #[inline(always)]
                            || weighted_sum(taps, &self.values, row),
                        );
                        for (matrix, value) in matrices.iter_mut().zip(row.iter()) {
                            matrix[i][j] = *value;
                            matrix[j][i] = *value;
                        }
                    }
                    for (x, matrix) in matrices.iter().enumerate() {
                        visit(part, first + x, matrix, &line.frame);
                    }
                }
            }
        })
    }

    /// Where the samples of the row that begins at `cell` are, with their weights.
    fn place(&self, line: &Line<D>, cell: usize, component: usize, taps: &mut Vec<(f64, usize)>) {
        let (size, index) = (self.shape.size(), self.shape.index(cell));
        let [i, j] = pairs::<D>()[component];
        let width = size[0];
        let rows = slab_cells(&self.shape) / width;
        taps.clear();
        taps.extend(line.samples.iter().map(|&(weight, offset)| {
            // Mirrored ends of rows have their sign already.
            let seen =
                |axis: usize| if axis == 0 { 0 } else { index[axis] as isize + offset[axis] };
            let across = |axis: usize| axis != 0 && turned(seen(axis), size[axis]);
            let row = if D == 3 { mirror(seen(1), size[1]) } else { 0 };
            let slab = mirror(seen(D - 1), size[D - 1]);
            let row = (slab * pairs::<D>().len() + component) * rows + row;
            let start = row * (width + 2 * self.margin) + self.margin;
            let weight = if across(i) == across(j) { weight } else { -weight };
            (weight, (start as isize + offset[0]) as usize)
        }));
    }
}

/// A direction and the samples of a line along it.
struct Line<const D: usize> {
    frame: Frame<D>,
    /// Weights and shifts in cells.
    samples: Vec<(f64, [isize; D])>,
}

impl<const D: usize> Line<D> {
    fn new(along: [f64; D], shape: &Shape<D>, [factor, scale, deviation]: [f64; 3]) -> Self {
        let step = scale.min(deviation);
        let count = (TRUNCATE * deviation / step).round() as isize;
        let weight = |k: isize| (-0.5 * (k as f64 * step / deviation).powi(2)).exp();
        let total: f64 = (-count..=count).map(weight).sum();
        let units = shape.spacing().map(|spacing| spacing / shape.smallest_spacing());
        let offset = |k: isize| {
            std::array::from_fn(|axis| {
                (k as f64 * step * along[axis] / units[axis]).round() as isize
            })
        };
        let samples = (-count..=count).map(|k| (factor * weight(k) / total, offset(k))).collect();
        Self { frame: Frame::new(along), samples }
    }
}

/// A direction, and what is across.
pub(super) struct Frame<const D: usize> {
    /// A unit vector whose largest component is positive.
    pub(super) along: [f64; D],
    across: [[f64; D]; D],
}

impl<const D: usize> Frame<D> {
    fn new(along: [f64; D]) -> Self {
        let (_, across) = eigen(&along.map(|a| along.map(|b| a * b)));
        Self { along, across }
    }

    /// The ascending eigenvalues of a matrix in the plane across, and its value along.
    #[inline(always)]
    pub(super) fn values(&self, matrix: &Matrix<D>) -> [f64; D] {
        let product = |a: [f64; D], b: [f64; D]| {
            let image = apply(matrix, b);
            (0..D).fold(0.0, |sum, axis| sum + a[axis] * image[axis])
        };
        let mut values = [product(self.along, self.along); D];
        let [u, w] = [self.across[0], self.across[D - 2]];
        if D == 2 {
            values[0] = product(u, u);
        } else {
            let uw = product(u, w);
            let (across, _) = eigen(&[[product(u, u), uw], [uw, product(w, w)]]);
            values[..2].copy_from_slice(&across);
        }
        values
    }
}

/// The axes of each component of a symmetric matrix.
fn pairs<const D: usize>() -> &'static [[usize; 2]] {
    if D == 2 {
        &[[0, 0], [0, 1], [1, 1]]
    } else {
        &[[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]]
    }
}

/// Whether a mirror at the borders -0.5 and n - 0.5 shows cell `i` turned round.
fn turned(i: isize, n: usize) -> bool {
    i.rem_euclid(2 * n as isize) >= n as isize
}

/// One unit vector of each pair of opposite directions, in physical axes.
fn directions<const D: usize>() -> Vec<[f64; D]> {
    let generators: &[[f64; 3]] = if D == 2 { &IN_PLANE } else { &IN_SPACE };
    let mut directions = Vec::new();
    for generator in generators {
        let length = generator.iter().map(|x| x * x).sum::<f64>().sqrt();
        // Each axis takes one of the components with one of the two signs.
        for choice in 0..(2 * D).pow(D as u32) {
            let choices: [usize; D] =
                std::array::from_fn(|axis| choice / (2 * D).pow(axis as u32) % (2 * D));
            let vector: [f64; D] = choices.map(|choice| {
                let sign = if choice % 2 == 0 { 1.0 } else { -1.0 };
                sign * generator[choice / 2] / length + 0.0
            });
            let all_taken = (0..D).all(|i| choices.iter().any(|choice| choice / 2 == i));
            let larger = |best: f64, &x: &f64| if x.abs() > best.abs() { x } else { best };
            let ahead = vector.iter().fold(0.0, larger) > 0.0;
            if all_taken && ahead && !directions.contains(&vector) {
                directions.push(vector);
            }
        }
    }
    directions
}

/// `result[i]` = sum over `taps` of `weight values[place + i]`.
#[inline(always)]
pub(super) fn weighted_sum(taps: &[(f64, usize)], values: &[f64], result: &mut [f64]) {
    let (blocks, rest) = result.as_chunks_mut::<BLOCK>();
    let first_of_rest = blocks.len() * BLOCK;
    for (block, result) in blocks.iter_mut().enumerate() {
        let mut sums = [0.0; BLOCK];
        for &(weight, place) in taps {
            let values = &values[place + block * BLOCK..][..BLOCK];
            for i in 0..BLOCK {
                sums[i] += weight * values[i];
            }
        }
        *result = sums;
    }
    for (i, sum) in rest.iter_mut().enumerate() {
        let terms = taps.iter().map(|(weight, place)| weight * values[place + first_of_rest + i]);
        *sum = terms.fold(0.0, |sum, term| sum + term);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest angle, in degrees, between any direction and the nearest of the set.
    fn farthest<const D: usize>(probes: impl Iterator<Item = [f64; D]>) -> f64 {
        let directions = directions::<D>();
        let cosine = |a: &[f64; D], b: &[f64; D]| -> f64 { (0..D).map(|i| a[i] * b[i]).sum() };
        let nearest = |probe: [f64; D]| {
            directions.iter().map(|d| cosine(d, &probe).abs()).fold(0.0, f64::max).min(1.0)
        };
        probes.map(nearest).fold(1.0, f64::min).acos().to_degrees()
    }

    #[test]
    fn directions_are_spread() {
        assert_eq!(directions::<2>().len(), 12);
        assert_eq!(directions::<3>().len(), 49);
        let circle = (0..720).map(|i| (f64::from(i) / 2.0).to_radians().sin_cos().into());
        assert!((farthest::<2>(circle) - 7.5).abs() < 1e-9);
        let sphere = (0..100_000).map(|i| {
            let (height, turn) = (1.0 - f64::from(i) / 1e5, f64::from(i) * 2.399_963_229_728_653);
            let radius = (1.0 - height * height).sqrt();
            [radius * turn.cos(), radius * turn.sin(), height]
        });
        // In the middle of the triangle of (1, 0, 0), (2, 1, 0) and (2, 1, 1).
        let (y, z) = (5.0_f64.sqrt() - 2.0, 6.0_f64.sqrt() - 5.0_f64.sqrt());
        let expected = (y * y + z * z).sqrt().atan().to_degrees();
        let farthest = farthest::<3>(sphere);
        assert!((farthest - expected).abs() < 0.2, "{farthest} {expected}");
    }
}
