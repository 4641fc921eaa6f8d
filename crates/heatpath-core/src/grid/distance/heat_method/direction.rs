//! From heat to the differences of distance across faces.

use super::Faces;
use super::near::Near;
use crate::grid::{Grid, Mask};

/// The unit vector that points away from the sources in each open cell; zero where heat has a
/// maximum.
///
/// It is along the central differences of u, not of `ln u`: where `u = exp(-k . i)` in cells i, the
/// way from the source to there is as `sinh(k) / spacing`, which is as `k / spacing` only if heat
/// decays slowly. With this the directions in a uniform medium are right at any time, however short.
pub(super) fn directions<const D: usize>(mask: &Mask<D>, ln_u: &Grid<f64, D>) -> Vec<[f64; D]> {
    let (shape, ln_u) = (mask.shape(), ln_u.values());
    (0..shape.cells())
        .map(|cell| {
            let index = shape.index(cell);
            let growth = |axis: usize, forward: bool| {
                let end = if forward { shape.size()[axis] - 1 } else { 0 };
                let stride = shape.stride(axis);
                let next = if forward { cell + stride } else { cell.wrapping_sub(stride) };
                (index[axis] != end && mask.is_open(next)).then(|| ln_u[next] - ln_u[cell])
            };
            if mask.is_open(cell) {
                let per_unit = shape.spacing().map(|spacing| shape.smallest_spacing() / spacing);
                direction(per_unit, |axis| [growth(axis, false), growth(axis, true)])
            } else {
                [0.0; D]
            }
        })
        .collect()
}

/// The direction in a cell, given by how much `ln u` grows towards the neighbours along each axis, of
/// which there are `per_unit` in a unit of length.
fn direction<const D: usize>(
    per_unit: [f64; D],
    growth: impl Fn(usize) -> [Option<f64>; 2],
) -> [f64; D] {
    let growth: [[Option<f64>; 2]; D] = std::array::from_fn(growth);
    let ends = growth.map(|ends| match ends {
        [Some(before), Some(after)] => [before, after],
        // As if ln u went on in a line.
        [Some(before), None] => [before, -before],
        [None, Some(after)] => [-after, after],
        [None, None] => [0.0; 2],
    });
    let highest = ends.as_flattened().iter().copied().fold(0.0, f64::max);
    let falls: [f64; D] = std::array::from_fn(|axis| {
        let [before, after] = ends[axis].map(|ln| (ln - highest).exp());
        (before - after) * per_unit[axis]
    });
    let length = falls.iter().map(|fall| fall * fall).sum::<f64>().sqrt();
    if length > 0.0 { falls.map(|fall| fall / length) } else { [0.0; D] }
}

/// The differences of distance across faces: the mean over both cells of slowness times direction,
/// which is also right where two fronts meet between them.
pub(super) fn differences<const D: usize>(
    faces: &[(usize, usize)],
    slowness: &Grid<f64, D>,
    directions: &[[f64; D]],
    near: &Near<D>,
) -> Faces<D> {
    let (shape, slowness) = (slowness.shape(), slowness.values());
    let mut differences: Faces<D> = std::array::from_fn(|_| vec![0.0; shape.cells()]);
    for &(axis, cell) in faces {
        let ends = [cell - shape.stride(axis), cell];
        let [before, after] = ends.map(|cell| slowness[cell]);
        let [back, forth] = ends.map(|cell| directions[cell][axis]);
        // What the straight ways around a source correct is per unit of slowness.
        let mean = 0.5 * (before + after);
        let slope = 0.5 * (before * back + after * forth) / mean;
        differences[axis][cell] = mean * near.corrected(axis, ends, shape.spacing()[axis] * slope);
    }
    differences
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_of_a_lattice_wave_are_those_of_its_rays() {
        for k in [[0.01, 0.02], [1.5, 0.5], [40.0, 39.0], [-900.0, 900.0]] {
            let [x, y] = direction([1.0, 0.5], |axis| [Some(k[axis]), Some(-k[axis])]);
            let ratio = |k: f64| if k.abs() > 300.0 { k.signum() } else { k.sinh() };
            let expected = 0.5 * ratio(k[1]) / ratio(k[0]);
            assert!((y / x / expected - 1.0).abs() < 1e-12, "{k:?}: {x} {y}");
            assert!((x.hypot(y) - 1.0).abs() < 1e-14);
        }
        assert_eq!(direction([1.0, 1.0], |_| [Some(-1.0), Some(-1.0)]), [0.0, 0.0]);
        assert_eq!(
            direction([1.0, 1.0], |axis| [[None, Some(-2.0)], [None, None]][axis]),
            [1.0, 0.0]
        );
    }
}
