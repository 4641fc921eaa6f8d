//! Averages over discs and balls, from which oriented flux is made.

use super::kernel::{Kernel, mirror, pad};
use super::separable::{for_each_slab, slab_cells};
use crate::exec::{Cancelled, Exec};
use crate::grid::{Grid, Shape};
use std::ops::Range;

/// How many lines through a ball are measured for each cell, along each axis across.
const LINES: usize = 16;

/// The variance that the hat which blurs a ball has along each axis, in squares of the spacing.
pub(super) const HAT_VARIANCE: f64 = 1.0 / 6.0;

/// The integral of the image over the disc or ball of `radius` cell units around each cell, over the
/// ball's circumference or surface.
///
/// Its Hessian is the oriented flux matrix of Law & Chung (2008): by the divergence theorem the mean
/// of `n_j d_i f` over a sphere with normals n is `d_i d_j` of this integral. A cell that the ball
/// covers in part counts in part, which blurs the ball as the box of a cell would.
///
/// Rows of the ball of the same length are summed before they are averaged along x, so a volume
/// takes about as many additions a cell as the ball has rows, not cells.
pub(super) fn ball_over_sphere<const D: usize>(
    image: &Grid<f64, D>,
    radius: f64,
    share: Range<f64>,
    exec: &Exec,
) -> Result<Grid<f64, D>, Cancelled> {
    let shape = *image.shape();
    let bundles = bundles(&shape, radius);
    let mut result = image.map(|_| 0.0);
    let slabs = result.values_mut().chunks_mut(slab_cells(&shape));
    let width = shape.size()[0];
    let margin = bundles.iter().map(|bundle| bundle.along.radius()).max().unwrap_or(0);
    let scratch = || [vec![0.0; width], vec![0.0; width + 2 * margin], vec![0.0; width]];
    for_each_slab(exec, share, slabs, scratch, |[sum, padded, average], slab, result| {
        let before = slab * slab_cells(&shape);
        for (row, result) in result.chunks_mut(width).enumerate() {
            let index = shape.index(before + row * width);
            for bundle in &bundles {
                sum.fill(0.0);
                for offset in &bundle.offsets {
                    let seen =
                        |axis| mirror(index[axis] as isize + offset[axis], shape.size()[axis]);
                    let first = shape.position(std::array::from_fn(seen));
                    exec.simd().run(|| add(sum, &image.values()[first..first + width]));
                }
                pad(sum, margin, padded);
                let taps = bundle.along.taps(|k| (margin as isize + k) as usize);
                bundle.along.apply(&taps, padded, average, exec.simd());
                add(result, average);
            }
        }
    })?;
    Ok(result)
}

/// Rows of a ball that are alike.
struct Bundle<const D: usize> {
    along: Kernel,
    /// Where the rows are; 0 along x.
    offsets: Vec<[isize; D]>,
}

/// The rows of a ball, by how they cover the cells along x.
fn bundles<const D: usize>(shape: &Shape<D>, radius: f64) -> Vec<Bundle<D>> {
    let units = shape.spacing().map(|spacing| spacing / shape.smallest_spacing());
    let reach = units.map(|unit| (radius / unit + 1.0).ceil() as isize);
    let mut rows: Vec<(Vec<f64>, Vec<[isize; D]>)> = Vec::new();
    for offset in offsets(reach) {
        let row = coverage(offset, units, radius);
        match rows.iter_mut().find(|(alike, _)| *alike == row) {
            Some((_, offsets)) => offsets.push(offset),
            None if row.iter().any(|&part| part > 0.0) => rows.push((row, vec![offset])),
            None => {}
        }
    }
    let cells = |row: &[f64]| row[0] + 2.0 * row[1..].iter().sum::<f64>();
    let total: f64 = rows.iter().map(|(row, offsets)| offsets.len() as f64 * cells(row)).sum();
    // The ball over its surface, r / 2 in a plane and r / 3 in space.
    let weight = radius / D as f64 / total;
    let bundle = |(row, offsets)| Bundle { along: Kernel::even(row).times(weight), offsets };
    rows.into_iter().map(bundle).collect()
}

/// All offsets up to `reach` either way along all axes but x.
fn offsets<const D: usize>(reach: [isize; D]) -> Vec<[isize; D]> {
    (1..D).fold(vec![[0; D]], |offsets, axis| {
        let with = |mut offset: [isize; D], along| {
            offset[axis] = along;
            offset
        };
        let all = |offset| (-reach[axis]..=reach[axis]).map(move |along| with(offset, along));
        offsets.into_iter().flat_map(all).collect()
    })
}

/// The weights of the cells at 0, 1, 2, ... along x, in the row at `offset`: how much of the ball a
/// hat around each of them covers.
fn coverage<const D: usize>(offset: [isize; D], units: [f64; D], radius: f64) -> Vec<f64> {
    let mut row = vec![0.0; (radius / units[0] + 1.0).ceil() as usize + 1];
    for line in 0..LINES.pow(D as u32 - 1) {
        let (mut weight, mut across_sq) = (1.0, 0.0);
        for axis in 1..D {
            let place = (line / LINES.pow(axis as u32 - 1) % LINES) as f64 + 0.5;
            let from_centre = 2.0 * place / LINES as f64 - 1.0;
            weight *= (1.0 - from_centre.abs()) * 2.0 / LINES as f64;
            // The same bits on both sides of the ball.
            across_sq += ((offset[axis].abs() as f64 + from_centre) * units[axis]).powi(2);
        }
        let half_chord = (radius * radius - across_sq).max(0.0).sqrt() / units[0];
        for (cell, part) in row.iter_mut().enumerate() {
            let cell = cell as f64;
            *part += weight * (hat_below(half_chord - cell) - hat_below(-half_chord - cell));
        }
    }
    row
}

/// The part of a hat between -1 and 1 that is below x.
fn hat_below(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    0.5 + x - 0.5 * x * x.abs()
}

#[inline(always)]
fn add(sums: &mut [f64], values: &[f64]) {
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ball_over_its_sphere() {
        let plane = Grid::from_fn(Shape::new([30, 20]).unwrap(), |_| 2.0);
        let exec = Exec::single_threaded();
        let found = ball_over_sphere(&plane, 4.5, 0.0..1.0, &exec).unwrap();
        assert!(found.values().iter().all(|v| (v - 4.5).abs() < 1e-13));
        let space = Grid::from_fn(Shape::new([9, 8, 7]).unwrap(), |_| 1.0);
        let found = ball_over_sphere(&space, 3.0, 0.0..1.0, &exec).unwrap();
        assert!(found.values().iter().all(|v| (v - 1.0).abs() < 1e-13));
    }

    #[test]
    fn weights_add_up_to_the_ball() {
        let shape = Shape::with_spacing([1, 1, 1], [1.0, 1.0, 2.0]).unwrap();
        let units = shape.spacing();
        let reach = [0, 5, 4];
        let cells: f64 = offsets(reach)
            .into_iter()
            .map(|offset| coverage(offset, units, 3.7))
            .map(|row| row[0] + 2.0 * row[1..].iter().sum::<f64>())
            .sum();
        let volume = 4.0 / 3.0 * std::f64::consts::PI * 3.7_f64.powi(3);
        assert!((2.0 * cells / volume - 1.0).abs() < 2e-3, "{}", 2.0 * cells / volume);
    }
}
