//! The distances of two cells at once.

use super::factor::Upwind;
use super::seed::Seed;
use super::stencil::Stencil;
use wide::f64x2;

/// The distances of two cells along the axes, to second order, in the usual case that each comes from
/// all known neighbours, the only seed is further than a cell away, and no step costs more than
/// `largest_step_sq`; `None` in others.
///
/// The operations are those of [`Factor::solve`](super::factor::Factor::solve), in vectors of two: a
/// root or a quotient of two numbers takes no longer than one, and mostly a cell that becomes known has
/// two neighbours that are not.
#[inline(always)]
pub(super) fn solve_two<const D: usize, const N: usize>(
    stencil: &impl Stencil<D, N>,
    seed: &Seed<D>,
    cells: &[(usize, [usize; D]); 2],
    upwind: impl Fn(usize, usize) -> Upwind,
    largest_step_sq: f64,
) -> [Option<f64>; 2] {
    let number = f64x2::splat;
    let places = cells.map(|(place, _)| place);
    let initial = number(seed.initial);
    let mut d = [number(0.0); D];
    for (axis, d) in d.iter_mut().enumerate() {
        *d = f64x2::from(cells.map(|(_, index)| index[axis] as f64)) - number(seed.point[axis]);
    }
    let covector: [f64x2; D] = std::array::from_fn(|row| dot(&seed.metric[row].map(number), &d));
    let r_sq = dot(&d, &covector);
    let per_r_sq = number(1.0) / r_sq;
    let mut nearest = number(f64::INFINITY);
    let (mut near, mut next, mut side) = ([nearest; N], [nearest; N], [nearest; N]);
    for direction in 0..N {
        let (a, b) = (upwind(places[0], direction), upwind(places[1], direction));
        near[direction] = f64x2::from([a.near, b.near]);
        next[direction] = f64x2::from([a.next, b.next]);
        side[direction] = f64x2::from([a.side as f64, b.side as f64]);
        nearest = nearest.fast_min(near[direction]);
    }
    let mut farthest = nearest;
    let mut is_usual = nearest.simd_eq(nearest);
    let (mut a, mut b, mut c) = (number(0.0), number(0.0), number(-1.0));
    let mut terms = [(nearest, nearest, nearest); N];
    for direction in 0..N {
        let is_missing = near[direction].simd_eq(number(f64::INFINITY));
        let near = is_missing.bitselect(nearest, near[direction]);
        farthest = farthest.fast_max(near);
        let next = next[direction];
        let weight = f64x2::from(places.map(|place| stencil.weight(place, direction)));
        let step_sq = places.map(|place| stencil.length_sq(place, direction, &seed.metric));
        let step_sq = f64x2::from(step_sq);
        let along = covector[direction];
        let is_beside = along.simd_ne(number(0.0)) & along.abs().simd_lt(step_sq);
        let away = -side[direction] * along;
        let is_factored =
            away.simd_gt(number(0.0)) | (away * away).simd_lt(number(0.25) * r_sq * step_sq);
        let growth = is_factored & (away * per_r_sq);
        let is_second = next.simd_lt(near);
        let distances = [near, is_second.bitselect(next, near)].map(|distance| distance - initial);
        let shares = [1.0, 2.0].map(|steps: f64| {
            let (one, two) = (number(2.0 * steps) * away, number(steps * steps) * step_sq);
            number(1.0) - (one - two) * per_r_sq
        });
        let least = number(1e-9) * per_r_sq * step_sq;
        let is_far = shares[0].simd_gt(least) & shares[1].simd_gt(least);
        is_usual = is_usual & (is_far | !is_factored) & !(is_missing & is_beside);
        let [first, second] = [0, 1]
            .map(|i: usize| is_factored.bitselect(distances[i] / shares[i].sqrt(), distances[i]));
        let rest = is_second.bitselect(number(2.0) * first - number(0.5) * second, first);
        let slope = is_second.bitselect(number(1.5), number(1.0)) + growth;
        let rest = rest + slope * initial;
        let weight = !is_missing & weight;
        // Counted from the nearest neighbour, as in `larger_root`.
        let left = rest - slope * nearest;
        a += weight * slope * slope;
        b += weight * slope * left;
        c += weight * left * left;
        terms[direction] = (weight, slope, rest);
    }
    let distance = nearest + (b + (b * b - a * c).sqrt()) / a;
    is_usual = is_usual & distance.simd_ge(farthest) & distance.simd_lt(number(f64::INFINITY));
    for (direction, (weight, slope, rest)) in terms.into_iter().enumerate() {
        let step = (distance - near[direction]).fast_max(number(0.0));
        let grows = slope.simd_gt(number(0.0)) & (slope * distance).simd_ge(rest);
        is_usual = is_usual
            & (weight.simd_eq(number(0.0)) | grows)
            & (weight * step * step).simd_le(number(largest_step_sq));
    }
    let (distance, usual) = (distance.to_array(), is_usual.to_bitmask());
    [0, 1].map(|i| (usual >> i & 1 == 1).then_some(distance[i]))
}

#[inline(always)]
fn dot<const D: usize>(a: &[f64x2; D], b: &[f64x2; D]) -> f64x2 {
    let first = a[0] * b[0];
    (1..D).fold(first, |sum, i| sum + a[i] * b[i])
}
