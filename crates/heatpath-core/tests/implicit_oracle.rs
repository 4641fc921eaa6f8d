//! Implicit heat against the simplest solver, and against explicit heat.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;

use heatpath_core::Exec;
use heatpath_core::exec::SimdLevel;
use heatpath_core::grid::heat::{Duration, Explicit, HeatOptions, Implicit, Step};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::path::Ending;
use heatpath_core::grid::{Shape, Sources};
use heatpath_core::linear::Wide;
use proptest::prelude::*;
use support::{flow, options, paths, rough};

/// The conductance of the face between two neighbours.
fn conductance<const D: usize>(medium: &Medium<D>, axis: usize, a: usize, b: usize) -> f64 {
    let shape = medium.shape();
    let open = medium.mask().is_open(a) && medium.mask().is_open(b);
    let harmonic = |x: f64, y: f64| 2.0 * x * y / (x + y);
    let mean = medium.diffusion().scalar().map_or(1.0, |d| harmonic(d.values()[a], d.values()[b]));
    let scale = (shape.smallest_spacing() / shape.spacing()[axis]).powi(2);
    if open { scale * mean } else { 0.0 }
}

/// Gauss-Seidel sweeps until nothing changes: `u = (u0 + step k sum of c u_next) / (1 + step k sum
/// of c)` has only positive terms, so it is right in every cell, however small.
fn sweeps<const D: usize>(medium: &Medium<D>, start: &[Wide], step: f64) -> Vec<Wide> {
    let shape = *medium.shape();
    let mut u = vec![Wide::ZERO; shape.cells()];
    for sweep in 0.. {
        let before = u.clone();
        for number in 0..shape.cells() {
            let cell = if sweep % 2 == 0 { number } else { shape.cells() - 1 - number };
            let k = medium.factor().map_or(1.0, |k| k.values()[cell]);
            let (mut sum, mut weights) = (start[cell], 1.0);
            for next in shape.neighbours(cell) {
                let axis = (0..D).find(|&a| shape.index(next)[a] != shape.index(cell)[a]).unwrap();
                let weight = step * k * conductance(medium, axis, cell, next);
                sum = sum.plus(u[next].times(weight));
                weights += weight;
            }
            u[cell] = sum.times(1.0 / weights);
        }
        let still = |(a, b): (&Wide, &Wide)| {
            a == b || (a.ln() - b.ln()).abs() < 1e-15 * (1.0 + a.ln().abs())
        };
        if u.iter().zip(&before).all(still) || sweep > 20_000 {
            break;
        }
    }
    u
}

fn assert_agrees<const D: usize>(medium: &Medium<D>, source: [f64; D], time: f64, steps: usize) {
    let shape = *medium.shape();
    let heat = flow(medium, source, options(time, steps));
    let mut u = vec![Wide::ZERO; shape.cells()];
    u[shape.position(shape.cell_at(source))] = Wide::from(1.0);
    let mut sum = vec![Wide::ZERO; shape.cells()];
    for _ in 0..steps {
        u = sweeps(medium, &u, time / steps as f64);
        sum.iter_mut().zip(&u).for_each(|(sum, &u)| *sum = sum.plus(u));
    }
    for (field, exact) in [(heat.ln_temperature(), &u), (heat.ln_exposure().unwrap(), &sum)] {
        for (cell, (ln, exact)) in field.values().iter().zip(exact).enumerate() {
            assert_eq!(*ln == f64::NEG_INFINITY, exact.is_zero(), "cell {cell}");
            let error = if exact.is_zero() { 0.0 } else { (ln - exact.ln()).abs() };
            assert!(error <= 1e-11 * (1.0 + exact.ln().abs()), "cell {cell}: {ln}, {}", exact.ln());
        }
    }
}

#[test]
fn every_cell_is_right_however_small() {
    let shape = Shape::new([60, 45]).unwrap();
    for (form, contrast, time, steps) in [
        (Form::Divergence, 2.0, 0.1, 1),
        (Form::Pointwise, 3.0, 0.5, 1),
        (Form::Pointwise, 1.0, 2.0, 3),
        (Form::Divergence, 6.0, 1.0, 2),
        (Form::Pointwise, 3.0, 1e-15, 1),
        (Form::Divergence, 1.0, 1e-40, 2),
    ] {
        let (medium, source) = rough(shape, contrast, form, 0.0, 7);
        let heat = flow(&medium, source, options(time, steps));
        let least = heat.ln_temperature().values().iter().copied().fold(0.0, f64::min);
        println!("{form:?}, contrast {contrast}, time {time}: log u down to {least:.0}");
        assert_agrees(&medium, source, time, steps);
    }
}

/// A corridor of slow cells: u falls to exp(-27000), which f64 ends at exp(-745).
#[test]
fn range_without_limits() {
    let n = 3000;
    let medium = medium::uniform(Shape::new([n, 1]).unwrap());
    let heat = flow(&medium, [0.0, 0.0], options(1e-4, 1));
    let per_cell = 2.0 * 50_f64.asinh();
    let ln = heat.ln_temperature().values();
    println!("log u down to {}", ln[n - 1]);
    for cell in 1..n - 1 {
        assert!((ln[cell] - ln[0] + per_cell * cell as f64).abs() < 1e-10 * per_cell * cell as f64);
    }
}

#[test]
fn threads_batches_and_new_times_change_no_bit() {
    let (medium, source) = rough(Shape::new([90, 70]).unwrap(), 2.0, Form::Divergence, 0.1, 3);
    let once = flow(&medium, source, options(9.0, 2));
    for level in [SimdLevel::Baseline, SimdLevel::Avx2] {
        let exec = Exec::single_threaded().with_simd(level);
        let sources = Sources::new(&[source], medium.mask()).unwrap();
        let implicit = Implicit::new(&medium, options(9.0, 2), &exec).unwrap();
        let heat = implicit.flow(&sources, &exec).unwrap();
        assert_eq!(heat.ln_temperature(), once.ln_temperature(), "{level:?}");
    }
    let sets: Vec<Sources<2>> =
        (0..20).map(|_| Sources::new(&[source], medium.mask()).unwrap()).collect();
    for threads in [1, 2, 3, 8] {
        let exec = Exec::new(threads).unwrap();
        let other = Implicit::new(&medium, options(2.0, 1), &exec).unwrap();
        let implicit = other.with_time(9.0, 2, &exec).unwrap();
        for heat in implicit.flow_many(&sets, &exec).unwrap() {
            assert_eq!(heat.ln_temperature(), once.ln_temperature(), "{threads} threads");
            assert_eq!(heat.ln_exposure(), once.ln_exposure());
        }
    }
}

/// Many small implicit steps and many smaller explicit ones are the same heat.
#[test]
fn small_steps_are_those_of_explicit_heat() {
    let (medium, source) = rough(Shape::new([25, 25]).unwrap(), 0.5, Form::Pointwise, 0.1, 11);
    let implicit = flow(&medium, source, options(10.0, 1000));
    let duration = Duration::Time(10.0);
    let explicit = Explicit::new(
        &medium,
        HeatOptions { duration, step: Step::Fixed(0.01), ..Default::default() },
    );
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    let explicit = explicit.unwrap().flow(&sources, &Exec::single_threaded()).unwrap();
    for (a, b) in implicit.ln_temperature().values().iter().zip(explicit.ln_temperature().values())
    {
        assert_eq!(a.is_finite(), b.is_finite());
        if *b > -6.0 {
            assert!((a - b).abs() < 0.03, "{a} and {b}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    /// Any small medium with walls: right in every cell, and every path ends at the source.
    #[test]
    fn any_picture(
        width in 1_usize..14, height in 1_usize..14, seed: u64, density in 0.0..0.6_f64,
        contrast in 0.0..4.0_f64, time in -20.0..2.0_f64, steps in 1_usize..4, pointwise: bool,
    ) {
        let form = if pointwise { Form::Pointwise } else { Form::Divergence };
        let (medium, source) =
            rough(Shape::new([width, height]).unwrap(), contrast, form, density, seed);
        let time = 10_f64.powf(time);
        assert_agrees(&medium, source, time, steps);
        let position = |point| medium.shape().position(medium.shape().cell_at(point));
        let connected = medium.mask().reachable_from([position(source)]);
        let open = (0..width * height).filter(|&cell| medium.mask().is_open(cell));
        let ends: Vec<[f64; 2]> = open.step_by(3).map(|cell| medium.shape().centre(cell)).collect();
        for path in paths(&medium, &[source], &ends, options(time, steps)) {
            let reachable = connected.values()[position(path.points[0])];
            let expected = if reachable { Ending::Source(0) } else { Ending::Unreachable };
            prop_assert_eq!(path.ending, expected);
        }
    }

    #[test]
    fn any_volume(
        x in 1_usize..6, y in 1_usize..6, z in 1_usize..6, seed: u64, density in 0.0..0.5_f64,
    ) {
        let shape = Shape::with_spacing([x, y, z], [1.0, 2.0, 0.7]).unwrap();
        let (medium, source) = rough(shape, 1.0, Form::Divergence, density, seed);
        assert_agrees(&medium, source, 0.8, 1);
    }
}
