//! Fast marching against its simplest version, and what must hold in any medium.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;

use heatpath_core::Exec;
use heatpath_core::grid::distance::{Eikonal, EikonalError, EikonalOptions, NOT_REACHED, Order};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::{Grid, Mask, Shape, Sources, TensorField};
use proptest::prelude::*;
use support::rough;

fn march<const D: usize>(
    medium: &Medium<D>,
    points: &[[f64; D]],
    options: &EikonalOptions<D>,
) -> Grid<f64, D> {
    let exec = Exec::single_threaded();
    let sources = Sources::new(points, medium.mask()).unwrap();
    let eikonal = Eikonal::new(medium, &exec).unwrap();
    eikonal.distance(&sources, options, &exec).unwrap().into_field()
}

/// The distance from a source at the centre of a cell in an isotropic medium of unit spacing: in each
/// round the nearest of all cells that are not yet known becomes known, and each is found by halving
/// intervals.
fn oracle<const D: usize>(medium: &Medium<D>, source: [usize; D], order: Order) -> Vec<f64> {
    let (shape, mask) = (medium.shape(), medium.mask());
    let mut known = vec![f64::INFINITY; shape.cells()];
    let mut trial = known.clone();
    known[shape.position(source)] = 0.0;
    loop {
        let unknown = |cell: &usize| mask.is_open(*cell) && known[*cell].is_infinite();
        let unknown: Vec<usize> = (0..shape.cells()).filter(unknown).collect();
        for &cell in &unknown {
            trial[cell] = trial[cell].min(root(medium, source, &known, cell, order));
        }
        let nearest = unknown.into_iter().min_by(|&a, &b| trial[a].total_cmp(&trial[b]));
        let Some(cell) = nearest.filter(|&cell| trial[cell].is_finite()) else {
            return known;
        };
        known[cell] = trial[cell];
    }
}

/// How derivatives are taken.
#[derive(Clone, Copy, PartialEq)]
enum Difference {
    /// Of T.
    Plain,
    /// Of T / r over one cell.
    Factored,
    /// Of T / r over two.
    Second,
}

/// The root T of `sum of squared derivatives = 1 / speed^2` in a cell: with second differences of
/// T / r, else with first, else with those of T.
fn root<const D: usize>(
    medium: &Medium<D>,
    source: [usize; D],
    known: &[f64],
    cell: usize,
    order: Order,
) -> f64 {
    let with = |difference| bisect(medium, source, known, cell, difference);
    let second = if order == Order::Second { with(Difference::Second) } else { None };
    let first = second.or_else(|| with(Difference::Factored));
    first.or_else(|| with(Difference::Plain)).unwrap_or(f64::INFINITY)
}

fn bisect<const D: usize>(
    medium: &Medium<D>,
    source: [usize; D],
    known: &[f64],
    cell: usize,
    difference: Difference,
) -> Option<f64> {
    let shape = medium.shape();
    let r = |index: [isize; D]| {
        (0..D).map(|axis| (index[axis] - source[axis] as isize).pow(2) as f64).sum::<f64>().sqrt()
    };
    let at = |index: [isize; D]| {
        let inside = (0..D).all(|k| index[k] >= 0 && index[k] < shape.size()[k] as isize);
        if inside { known[shape.position(index.map(|i| i as usize))] } else { f64::INFINITY }
    };
    let tau = |index: [isize; D]| {
        if r(index) == 0.0 { slowness(medium, source) } else { at(index) / r(index) }
    };
    let here = shape.index(cell).map(|i| i as isize);
    let step = |axis: usize, by: isize| {
        let mut there = here;
        there[axis] += by;
        there
    };
    // The derivative along an axis as a function of T, and where it begins to count.
    let terms: Vec<_> = (0..D)
        .filter_map(|axis| {
            let side = if at(step(axis, 1)) < at(step(axis, -1)) { 1 } else { -1 };
            let (near, next) = (at(step(axis, side)), at(step(axis, 2 * side)));
            let slope_of_r = -(side * (here[axis] - source[axis] as isize)) as f64 / r(here);
            let (t1, t2) = (tau(step(axis, side)), tau(step(axis, 2 * side)));
            let derivative = move |t: f64| {
                let tau = t / r(here);
                match difference {
                    Difference::Plain => t - near,
                    Difference::Second if next < near - 1e-12 => {
                        r(here) * (1.5 * tau - 2.0 * t1 + 0.5 * t2) + tau * slope_of_r
                    }
                    _ => r(here) * (tau - t1) + tau * slope_of_r,
                }
            };
            near.is_finite().then_some((near, derivative))
        })
        .collect();
    let nearest = terms.iter().map(|term| term.0).fold(f64::INFINITY, f64::min);
    let excess = |t: f64| {
        let squares = terms.iter().filter(|term| term.0 < t).map(|term| term.1(t).max(0.0).powi(2));
        squares.sum::<f64>() - 1.0 / medium.speed_sq(cell)
    };
    let (mut low, mut high) = (nearest, nearest + 4.0 / medium.speed_sq(cell).sqrt());
    if terms.is_empty() {
        return None;
    }
    // The nearest neighbour alone must not be enough.
    if excess(low + 1e-12 * (1.0 + low)) > 0.0 {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    Some(high)
}

fn slowness<const D: usize>(medium: &Medium<D>, cell: [usize; D]) -> f64 {
    1.0 / medium.speed_sq(medium.shape().position(cell)).sqrt()
}

fn compare<const D: usize>(size: [usize; D], contrast: f64, seed: u64, order: Order) {
    let (medium, source) = rough(Shape::new(size).unwrap(), contrast, Form::Pointwise, 0.1, seed);
    let field = march(&medium, &[source], &EikonalOptions { order, ..Default::default() });
    let expected = oracle(&medium, source.map(|x| x as usize), order);
    let mut cells: Vec<usize> = (0..expected.len()).collect();
    cells.sort_by(|&a, &b| expected[a].total_cmp(&expected[b]));
    for (cell, expected) in cells.into_iter().map(|cell| (cell, expected[cell])) {
        let value = field.values()[cell];
        let index = medium.shape().index(cell);
        let same = value == expected || (value - expected).abs() < 1e-9 * (1.0 + expected);
        assert!(
            same,
            "seed {seed}, cell {:?}: {value}, not {expected}",
            medium.shape().index(cell)
        );
    }
}

#[test]
fn marching_agrees_with_its_simplest_version() {
    for seed in 0..12 {
        for order in [Order::First, Order::Second] {
            compare([17, 13], 0.5, seed, order);
            compare([7, 6, 5], 0.5, seed, order);
        }
    }
}
