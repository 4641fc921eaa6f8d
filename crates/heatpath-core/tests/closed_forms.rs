//! Distances and paths against formulas.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::grid::distance::{DistanceMap, normalized, varadhan};
use heatpath_core::grid::heat::{Duration, Explicit, Heat, HeatOptions, Step};
use heatpath_core::grid::{Grid, Shape, Sources, medium};
use std::f64::consts::PI;

fn flow<const D: usize>(shape: Shape<D>, source: [f64; D], options: HeatOptions) -> Heat<D> {
    let medium = medium::uniform(shape);
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    Explicit::new(&medium, options).unwrap().flow(&sources, &Exec::single_threaded()).unwrap()
}

fn iterations(n: usize) -> HeatOptions {
    HeatOptions { duration: Duration::Iterations(n), ..HeatOptions::default() }
}

/// How far heat reaches: the radius at which it is `exp(-36)`, half a unit of f64's precision, of
/// its value at the source.
fn reach(time: f64) -> f64 {
    (36.0 * 4.0 * time).sqrt()
}

/// The largest relative error beyond five cells and within half the reach.
fn largest_error<const D: usize>(map: &DistanceMap<D>, source: [f64; D], time: f64) -> f64 {
    let shape = *map.shape();
    let unit = shape.smallest_spacing();
    (0..shape.cells())
        .filter_map(|cell| {
            let exact = shape.physical_distance(source, shape.centre(cell));
            let counts = exact >= 5.0 * unit && exact <= 0.5 * reach(time) * unit;
            counts.then(|| (map.field().values()[cell] / exact - 1.0).abs())
        })
        .fold(0.0, f64::max)
}

#[test]
fn normalized_distance_in_the_plane() {
    println!("iterations   source            largest error");
    for (n, side) in [(100, 161), (300, 261), (600, 361), (1200, 521)] {
        for source in [[0.0, 0.0], [0.5, 0.5], [0.3, -0.2]] {
            let source = source.map(|offset| (side / 2) as f64 + offset);
            let heat = flow(Shape::new([side, side]).unwrap(), source, iterations(n));
            let error = largest_error(&normalized(&heat), source, heat.time());
            println!("{n:10}   {source:?}  {:.3} %", 100.0 * error);
            // Below 300 steps the walk from cell to cell shows within half the reach.
            let bound = if n < 300 { 0.01 } else { 0.005 };
            assert!(error < bound, "{n} iterations from {source:?}: {error}");
        }
    }
}

#[test]
fn normalized_distance_in_space() {
    let source = [52.0; 3];
    let heat = flow(
        Shape::new([105; 3]).unwrap(),
        source,
        HeatOptions {
            duration: Duration::Iterations(300),
            step: Step::Auto,
            ..HeatOptions::default()
        },
    );
    let error = largest_error(&normalized(&heat), source, heat.time());
    println!("in space: {:.3} %", 100.0 * error);
    assert!(error < 0.005, "{error}");
}

#[test]
fn normalized_distance_with_spacing() {
    let source = [200.0, 100.0];
    let shape = Shape::with_spacing([401, 201], [0.25, 0.5]).unwrap();
    let heat = flow(shape, source, iterations(1200));
    let error = largest_error(&normalized(&heat), source, heat.time());
    println!("with spacing: {:.3} %", 100.0 * error);
    assert!(error < 0.005, "cells of two different sizes: {error}");
}

#[test]
fn varadhan_has_its_known_bias() {
    let source = [150.0, 150.0];
    let heat = flow(Shape::new([301, 301]).unwrap(), source, iterations(600));
    let map = varadhan(&heat);
    let t = heat.time();
    for r in [20.0_f64, 100.0] {
        let biased = (r * r + 4.0 * t * (4.0 * PI * t).ln()).sqrt();
        let got = map.at([150.0 + r, 150.0]);
        assert!((got / biased - 1.0).abs() < 1e-3, "at {r}: {got}, expected {biased}");
    }
    assert!(map.at([250.0, 150.0]) > 115.0, "16 % too long at 100 cells");
    assert!(map.at([170.0, 150.0]) > 60.0, "three times too long at 20 cells");
}

/// The scheme is first order in time and second in space: with the step a fixed part of the cell
/// squared, halving the cell divides the error by four.
#[test]
fn the_temperature_converges_with_second_order() {
    // The cosine of half a wave decays as exp(-pi^2 t) in the unit square with closed borders.
    // As a sum over cosines is hard to start from a point, compare u of a point source with the
    // Gaussian: the error of ln u at a fixed physical point and time.
    let error = |refine: usize| {
        let n = 40 * refine + 1;
        let h = 1.0 / refine as f64;
        let shape = Shape::with_spacing([n, n], [h, h]).unwrap();
        let centre = (20 * refine) as f64;
        let time = 12.0;
        let options =
            HeatOptions { duration: Duration::Time(time / (h * h)), ..HeatOptions::default() };
        let heat = flow(shape, [centre, centre], options);
        let point = [centre + (8 * refine) as f64, centre + (3 * refine) as f64];
        let ln_u = heat.ln_temperature().sample(point) - (h * h).ln();
        let exact = -(64.0 + 9.0) / (4.0 * time) - (4.0 * PI * time).ln();
        (ln_u - exact).abs()
    };
    let errors = [1, 2, 4].map(error);
    println!("errors of ln u as cells are halved: {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.8..2.4).contains(&order), "order {order}: {errors:?}");
    }
}

/// Lengths ds / y in the upper half plane have a classical distance.
#[test]
fn half_plane_distance_is_close_to_the_exact_one() {
    let n = 101;
    let shape = Shape::new([n, n]).unwrap();
    let y = |j: usize| 1.0 + j as f64 / (n - 1) as f64;
    let field = Grid::from_fn(shape, |[_, j]| y(j) * y(j) / 4.0);
    let medium = medium::given(field, medium::Form::Pointwise).unwrap();
    let sources = Sources::new(&[[50.0, 50.0]], medium.mask()).unwrap();
    let options = HeatOptions { duration: Duration::Iterations(600), ..HeatOptions::default() };
    let heat =
        Explicit::new(&medium, options).unwrap().flow(&sources, &Exec::single_threaded()).unwrap();
    let map = normalized(&heat);
    let mut worst: f64 = 0.0;
    for cell in 0..shape.cells() {
        let [i, j] = shape.index(cell);
        let (dx, y0, y1) = ((i as f64 - 50.0) / 100.0, 1.5, y(j));
        let plus = (dx * dx + (y1 + y0).powi(2)).sqrt();
        let minus = (dx * dx + (y1 - y0).powi(2)).sqrt();
        // Lengths ds / sqrt(k) with k = y^2 / 4 in cells of 1/100 are 200 ds / y.
        let exact = 200.0 * ((plus + minus) / (plus - minus)).ln();
        if minus > 0.05 && minus < 0.3 {
            worst = worst.max((map.field().values()[cell] / exact - 1.0).abs());
        }
    }
    println!("half plane: {:.3} %", 100.0 * worst);
    assert!(worst < 0.02, "{worst}");
}
