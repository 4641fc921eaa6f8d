//! Implicit heat: closed forms, the simplest solver, explicit heat, paths, and what is made of many
//! heats.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::exec::SimdLevel;
use heatpath_core::grid::bridge::{BridgeError, bridge};
use heatpath_core::grid::distance::{distance_matrix, normalized, varadhan};
use heatpath_core::grid::heat::{
    Duration, Explicit, Heat, HeatOptions, Implicit, ImplicitError, ImplicitOptions, Step,
};
use heatpath_core::grid::labels::labels;
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::path::{Descent, Ending, Path, PathOptions};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use heatpath_core::linear::Wide;
use proptest::prelude::*;

fn options(time: f64, steps: usize) -> ImplicitOptions {
    ImplicitOptions { time, steps, ..ImplicitOptions::default() }
}

fn flow<const D: usize>(medium: &Medium<D>, source: [f64; D], options: ImplicitOptions) -> Heat<D> {
    let exec = Exec::single_threaded();
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    Implicit::new(medium, options, &exec).unwrap().flow(&sources, &exec).unwrap()
}

fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(2685821657736338717) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The largest relative error of distances between `from` and `to`, in per cent.
fn worst<const D: usize>(
    field: &Grid<f64, D>,
    exact: impl Fn([f64; D]) -> f64,
    from: f64,
    to: f64,
) -> f64 {
    let cells =
        (0..field.shape().cells()).map(|cell| (field.values()[cell], field.shape().centre(cell)));
    cells
        .filter(|&(_, point)| (from..to).contains(&exact(point)))
        .map(|(distance, point)| 100.0 * (distance / exact(point) - 1.0).abs())
        .fold(0.0, f64::max)
}

fn euclidean<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn uniform_plane() {
    let medium = medium::uniform(Shape::new([321, 321]).unwrap());
    println!("time, source, steps: largest error in % from 5, 10, 40 to 130 cells");
    for (time, limits) in [
        (1.0, [4.6, 4.3, 4.0]),
        (4.0, [1.6, 1.3, 1.2]),
        (16.0, [0.8, 0.45, 0.4]),
        (64.0, [0.6, 0.25, 0.7]),
    ] {
        for source in [[160.0, 160.0], [160.5, 160.5], [160.2, 159.9]] {
            for steps in [1, 3] {
                let heat = flow(&medium, source, options(time * steps as f64, steps));
                let map = normalized(&heat);
                let error = [5.0, 10.0, 40.0]
                    .map(|from| worst(map.field(), |p| euclidean(p, source), from, 130.0));
                println!("{time:4} {source:?} {steps}: {error:.2?}");
                for (error, limit) in error.iter().zip(limits) {
                    assert!(*error < limit + if steps > 1 { 0.3 } else { 0.0 });
                }
            }
        }
    }
}

/// What the formula as printed gives: `-sqrt(t) log u`, with no 4 and no square root.
#[test]
fn the_printed_formula_is_that_of_the_resolvent() {
    let medium = medium::uniform(Shape::new([101, 101]).unwrap());
    let heat = flow(&medium, [50.0, 50.0], options(16.0, 1));
    for (cell, distance) in varadhan(&heat).field().values().iter().enumerate() {
        assert_eq!(*distance, (-4.0 * heat.ln_temperature().values()[cell]).max(0.0));
    }
    // Times 4 the diffusion length: the distance over sqrt(t) is 5, K_0(5) / 2 pi t is known.
    let exact = -4.0 * (0.0036910983340425942 / (32.0 * std::f64::consts::PI)).ln();
    let printed = varadhan(&heat).at([70.0, 50.0]);
    assert!((printed / exact - 1.0).abs() < 2e-3, "{printed} for {exact}");
}

#[test]
fn uniform_space_line_and_slender_grids() {
    let shape = Shape::with_spacing([49, 49, 25], [0.5, 0.5, 1.0]).unwrap();
    let medium = medium::uniform(shape);
    let source = [24.0, 24.0, 12.0];
    let exact = |p: [f64; 3]| shape.physical_distance(p, source);
    for steps in [1, 2] {
        let map = normalized(&flow(&medium, source, options(4.0 * steps as f64, steps)));
        let error = worst(map.field(), exact, 3.0, 8.0);
        println!("space, {steps} steps: {error:.2} %");
        assert!(error < 4.5);
    }
    for size in [[200, 1], [1, 200]] {
        let medium = medium::uniform(Shape::new(size).unwrap());
        let source = size.map(|side| if side > 1 { 100.0 } else { 0.0 });
        let map = normalized(&flow(&medium, source, options(16.0, 1)));
        assert!(worst(map.field(), |p| euclidean(p, source), 5.0, 70.0) < 0.6);
    }
    for size in [[1, 1], [2, 1], [1, 3]] {
        let medium = medium::uniform(Shape::new(size).unwrap());
        let map = normalized(&flow(&medium, [0.0, 0.0], options(16.0, 1)));
        assert!(map.field().values().iter().all(|d| d.is_finite() && *d >= 0.0));
    }
}

/// The largest errors in two ranges of distance, for several times and for explicit heat.
fn table(
    name: &str,
    medium: &Medium<2>,
    source: [f64; 2],
    exact: &dyn Fn([f64; 2]) -> f64,
    ranges: [[f64; 2]; 2],
) -> (String, [f64; 2]) {
    let errors = |heat: &Heat<2>| {
        let map = normalized(heat);
        ranges.map(|[from, to]| worst(map.field(), exact, from, to))
    };
    let mut lines = name.to_owned();
    for time in [1.0, 4.0, 64.0, 256.0] {
        let error = errors(&flow(medium, source, options(time, 1)));
        lines += &format!("\n  time {time}: {error:.2?}");
    }
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    let auto = HeatOptions { step: Step::Auto, ..HeatOptions::default() };
    let explicit = Explicit::new(medium, auto).unwrap();
    let explicit = explicit.flow(&sources, &Exec::single_threaded()).unwrap();
    let usual = errors(&flow(medium, source, ImplicitOptions::default()));
    lines += &format!("\n  default time: {usual:.2?}\n  explicit: {:.2?}", errors(&explicit));
    (lines, usual)
}

/// How far changes of the medium, walls and borders are felt: closed forms.
#[test]
fn the_default_time() {
    let shape = Shape::new([201, 201]).unwrap();
    let (s, slope) = ([100.0, 100.0], 0.004);
    let speed = |x: f64| 0.3 + slope * x;
    let linear = Grid::from_fn(shape, |[x, _]| speed(x as f64).powi(2));
    let linear = medium::given(linear, Form::Pointwise).unwrap();
    let exact = |p: [f64; 2]| {
        (1.0 + (slope * euclidean(p, s)).powi(2) / (2.0 * speed(s[0]) * speed(p[0]))).acosh()
            / slope
    };
    let (lines, found) = table("speed grows", &linear, s, &exact, [[10.0, 80.0], [80.0, 1e9]]);
    println!("{lines}");
    assert!(found[0] < 0.8);

    let shape = Shape::new([161, 161]).unwrap();
    let mask = Mask::new(Grid::from_fn(shape, |[x, y]| x != 80 || y >= 120));
    let walled = medium::uniform(shape).with_walls(mask).unwrap();
    let (s, end) = ([40.0, 60.0], [80.0, 119.5]);
    let exact = |p: [f64; 2]| {
        let crossing = s[1] + (80.0 - s[0]) / (p[0] - s[0]) * (p[1] - s[1]);
        let in_sight = p[0] < 80.0 || crossing > end[1];
        match (p[0] == 80.0 && p[1] < 120.0, in_sight) {
            (true, _) => f64::INFINITY,
            (_, true) => euclidean(p, s),
            _ => euclidean(s, end) + euclidean(end, p),
        }
    };
    let (lines, found) = table("wall", &walled, s, &exact, [[5.0, 20.0], [40.0, 1e9]]);
    println!("{lines}");
    assert!(found[0] < 0.8 && found[1] < 9.5);

    let open = medium::uniform(Shape::new([201, 201]).unwrap());
    let s = [3.0, 100.0];
    let (lines, found) =
        table("border", &open, s, &|p| euclidean(p, s), [[10.0, 20.0], [80.0, 1e9]]);
    println!("{lines}");
    assert!(found[0] < 22.0 && found[1] < 5.5);
}

#[test]
fn half_plane() {
    let shape = Shape::with_spacing([101, 101], [0.01, 0.01]).unwrap();
    let y = |row: f64| 1.0 + 0.01 * row;
    let field = Grid::from_fn(shape, |[_, row]| y(row as f64).powi(2));
    let half_plane = medium::given(field, Form::Pointwise).unwrap();
    let exact = |p: [f64; 2]| {
        let square = (0.01 * (p[0] - 50.0)).powi(2) + (y(p[1]) - 1.5).powi(2);
        (1.0 + square / (2.0 * 1.5 * y(p[1]))).acosh()
    };
    let map = normalized(&flow(&half_plane, [50.0, 50.0], options(4.0, 1)));
    let error = worst(map.field(), exact, 0.05, 0.2);
    println!("half-plane: {error:.2} %");
    assert!(error < 1.0);
}

/// A medium without symmetry, with walls if `density` is above 0; the source's cell is open.
fn rough<const D: usize>(
    shape: Shape<D>,
    contrast: f64,
    form: Form,
    density: f64,
    seed: u64,
) -> (Medium<D>, [f64; D]) {
    let mut random = random(seed);
    let field = Grid::from_fn(shape, |_| 10_f64.powf(-contrast * random()));
    let source = shape.cell_at(shape.size().map(|side| side as f64 * random() - 0.5));
    let mask = Mask::new(Grid::from_fn(shape, |index| index == source || random() > density));
    let medium = medium::given(field, form).unwrap().with_walls(mask).unwrap();
    (medium, source.map(|i| i as f64))
}

/// The conductance of the face between two neighbours.
fn conductance<const D: usize>(medium: &Medium<D>, axis: usize, a: usize, b: usize) -> f64 {
    let shape = medium.shape();
    let open = medium.mask().is_open(a) && medium.mask().is_open(b);
    let harmonic = |x: f64, y: f64| 2.0 * x * y / (x + y);
    let mean = medium.diffusion().map_or(1.0, |d| harmonic(d.values()[a], d.values()[b]));
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
    for (field, exact) in [(heat.ln_temperature(), &u), (heat.ln_exposure(), &sum)] {
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

#[test]
fn what_cannot_be_done_is_refused() {
    let medium = medium::uniform(Shape::new([200, 200]).unwrap());
    let exec = Exec::single_threaded();
    let refusal = |options| Implicit::new(&medium, options, &exec).map(|_| ()).unwrap_err();
    assert_eq!(refusal(options(0.0, 1)), ImplicitError::Time(0.0));
    assert!(matches!(refusal(options(f64::NAN, 1)), ImplicitError::Time(_)));
    assert_eq!(refusal(options(1.0, 0)), ImplicitError::Steps(0));
    assert_eq!(refusal(options(1.0, 1001)), ImplicitError::Steps(1001));
    assert!(matches!(refusal(options(1e12, 1)), ImplicitError::TooLong { .. }));
    let small = ImplicitOptions { memory_limit: 10 << 20, ..ImplicitOptions::default() };
    let message = refusal(small).to_string();
    assert!(
        message.contains("10.0 MiB are allowed") && message.contains("explicit heat"),
        "{message}"
    );
    println!("{message}");
    // The analysis of this one alone would take gigabytes.
    let huge = medium::uniform(Shape::new([700, 700, 2]).unwrap());
    let small = ImplicitOptions { memory_limit: 1 << 20, ..ImplicitOptions::default() };
    assert!(matches!(Implicit::new(&huge, small, &exec), Err(ImplicitError::TooLarge(_))));
    let cancelling = Exec::single_threaded().with_watch(|_| std::ops::ControlFlow::Break(()));
    let cancelled = Implicit::new(&medium, ImplicitOptions::default(), &cancelling);
    assert!(matches!(cancelled, Err(ImplicitError::Cancelled(_))));
}

fn paths(
    medium: &Medium<2>,
    sources: &[[f64; 2]],
    ends: &[[f64; 2]],
    options: ImplicitOptions,
) -> Vec<Path<2>> {
    let exec = Exec::single_threaded();
    let sources = Sources::new(sources, medium.mask()).unwrap();
    let heat = Implicit::new(medium, options, &exec).unwrap().flow(&sources, &exec).unwrap();
    let (descent, distances) = (Descent::new(&heat), normalized(&heat));
    ends.iter().map(|&end| descent.path(end, &distances, PathOptions::default()).unwrap()).collect()
}

#[test]
fn paths_in_a_uniform_picture_are_straight_to_the_last_cell() {
    let medium = medium::uniform(Shape::new([241, 201]).unwrap());
    let mut worst = 0.0_f64;
    for steps in [1, 3] {
        for source in [[120.0, 100.0], [120.5, 100.5], [119.7, 100.2]] {
            let ends: Vec<[f64; 2]> = (0..24)
                .map(|i| {
                    let (angle, r) = (f64::from(i) * 0.26, if i % 2 == 0 { 60.0 } else { 7.3 });
                    [source[0] + r * f64::cos(angle), source[1] + r * f64::sin(angle)]
                })
                .collect();
            let found = paths(&medium, &[source], &ends, options(16.0 * steps as f64, steps));
            for (path, end) in found.iter().zip(&ends) {
                assert_eq!(path.ending, Ending::Source(0));
                let (a, b) = (path.points[0], path.points[path.points.len() - 1]);
                assert_eq!((a, b), (*end, source));
                let length = euclidean(a, b);
                let off = |p: &[f64; 2]| {
                    ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])).abs() / length
                };
                let straying = path.points.iter().map(off).fold(0.0, f64::max);
                worst = worst.max(straying);
                assert!(straying < 0.2, "{end:?} to {source:?}: {straying}");
                assert!((path.length / length - 1.0).abs() < 0.003, "{} for {length}", path.length);
                let limit = if steps > 1 { 0.015 } else { 0.01 };
                assert!((path.distance / length - 1.0).abs() < limit, "{} {length}", path.distance);
            }
        }
    }
    println!("paths stray by {worst:.3} cells");
}

#[test]
fn paths_follow_the_river_and_the_walls() {
    let image = Grid::from_fn(Shape::new([120, 90]).unwrap(), |[x, y]| {
        let (dx, dy) = (x as f64 - 40.0, y as f64 - 30.0);
        if dx.hypot(dy) < 22.0 || (48..=50).contains(&y) { 1.0 } else { 0.2 }
    });
    let medium = medium::combined(&image, &[1.0], Default::default(), Default::default()).unwrap();
    let wall = Mask::new(Grid::from_fn(*image.shape(), |[x, y]| x != 60 || y > 80));
    for medium in [medium.clone(), medium.with_walls(wall).unwrap()] {
        let open = |cell: &usize| medium.mask().is_open(*cell);
        let ends: Vec<[f64; 2]> = (0..image.shape().cells())
            .step_by(61)
            .filter(open)
            .map(|cell| image.shape().centre(cell))
            .collect();
        for (time, steps) in [(16.0, 1), (4.0, 1), (1000.0, 4)] {
            for path in paths(&medium, &[[21.0, 30.0]], &ends, options(time, steps)) {
                assert_eq!(path.ending, Ending::Source(0), "from {:?}", path.points[0]);
            }
        }
    }
}

/// In a closed chamber the heat has nowhere to go, and its maximum is nearly flat.
#[test]
fn paths_end_at_the_source_when_heat_is_trapped() {
    let medium = medium::uniform(Shape::new([12, 9]).unwrap());
    for time in [1.0, 100.0, 1e4, 1e6] {
        let ends = [[0.0, 0.0], [11.0, 8.0], [0.0, 8.0], [7.0, 4.0]];
        for path in paths(&medium, &[[5.0, 4.0]], &ends, options(time, 1)) {
            assert_eq!(path.ending, Ending::Source(0), "time {time}");
        }
    }
}

#[test]
fn balanced_sources_are_equally_near() {
    let shape = Shape::new([160, 60]).unwrap();
    let field = Grid::from_fn(shape, |[x, _]| if x < 80 { 1.0 } else { 0.1 });
    let medium = medium::given(field, Form::Pointwise).unwrap();
    let exec = Exec::single_threaded();
    let sources = Sources::new(&[[30.0, 30.0], [130.0, 30.0]], medium.mask()).unwrap();
    let implicit = Implicit::new(&medium, options(16.0, 1), &exec).unwrap();
    let balanced = normalized(&implicit.flow_balanced(&sources, &exec).unwrap());
    for (source, slowness) in [([30.0, 30.0], 1.0), ([130.0, 30.0], 10.0_f64.sqrt())] {
        assert!(balanced.at(source) < 1.0, "{source:?}: {}", balanced.at(source));
        let beside = balanced.at([source[0] + 9.0, source[1]]);
        assert!((beside / (9.0 * slowness) - 1.0).abs() < 0.05, "{source:?}: {beside}");
    }
}

#[test]
fn a_matrix_of_distances_is_symmetric() {
    let (medium, _) = rough(Shape::new([70, 50]).unwrap(), 1.0, Form::Pointwise, 0.0, 5);
    let exec = Exec::new(2).unwrap();
    let implicit = Implicit::new(&medium, options(16.0, 1), &exec).unwrap();
    let points: Vec<[f64; 2]> =
        (0..40).map(|i| [f64::from(i * 17 % 70), f64::from(i * 29 % 50)]).collect();
    let points = Sources::new(&points, medium.mask()).unwrap();
    let matrix = distance_matrix(&implicit, &points, &points, &exec).unwrap();
    for (i, row) in matrix.iter().enumerate() {
        let alone = normalized(&implicit.flow(&points.each()[i], &exec).unwrap());
        for (j, &there) in row.iter().enumerate() {
            let back = matrix[j][i];
            assert!((there - back).abs() < 1e-8 * (1.0 + there), "{there} and {back}");
            assert!((there - alone.at(points.points()[j])).abs() < 1e-9 * (1.0 + there));
        }
    }
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let two = Sources::new(&points.points()[..2], medium.mask()).unwrap();
    let slower = distance_matrix(&explicit, &two, &two, &exec).unwrap();
    assert!((slower[0][1] / matrix[0][1] - 1.0).abs() < 0.15, "{slower:?} {}", matrix[0][1]);
}

#[test]
fn a_bridge_is_as_wide_as_said() {
    let medium = medium::uniform(Shape::new([161, 101]).unwrap());
    let (s, t) = ([30.0, 50.0], [130.0, 50.0]);
    let density = bridge(&flow(&medium, s, options(16.0, 1)), &flow(&medium, t, options(16.0, 1)));
    let density = density.unwrap();
    let half_width = 0.5 * (2.0 * 100.0 * 4.0_f64).sqrt();
    for x in [80_usize, 60] {
        let highest =
            (0..101).max_by(|&a, &b| density[[x, a]].total_cmp(&density[[x, b]])).unwrap();
        assert_eq!(highest, 50);
    }
    let fall = density[[80, 50]] - density[[80, 50 + half_width.round() as usize]];
    assert!((fall - 1.0).abs() < 0.1, "{fall}");

    let other = medium::uniform(Shape::new([8, 9]).unwrap());
    let small = flow(&other, [1.0, 1.0], options(1.0, 1));
    let big = flow(&medium, s, options(1.0, 1));
    assert!(matches!(bridge(&small, &big), Err(BridgeError::Size { .. })));
    let walls = Mask::new(Grid::from_fn(Shape::new([8, 9]).unwrap(), |[x, _]| x != 4));
    let apart = other.clone().with_walls(walls).unwrap();
    let [a, b] = [[1.0, 1.0], [7.0, 1.0]].map(|point| flow(&apart, point, options(1.0, 1)));
    assert_eq!(bridge(&a, &b), Err(BridgeError::NotReached));
}

#[test]
fn labels_are_those_of_the_nearest_source() {
    let walls = Mask::new(Grid::from_fn(Shape::new([90, 70]).unwrap(), |[x, _]| x != 80));
    let medium = medium::uniform(*walls.shape()).with_walls(walls).unwrap();
    let points = [[20.0, 20.0], [60.0, 15.0], [40.0, 55.0]];
    let heats: Vec<Heat<2>> =
        points.iter().map(|&point| flow(&medium, point, ImplicitOptions::default())).collect();
    let labels = labels(&heats).unwrap();
    for cell in 0..90 * 70 {
        let p = medium.shape().centre(cell);
        let shares: f64 = labels.shares.iter().map(|share| share.values()[cell]).sum();
        if p[0] >= 80.0 {
            assert_eq!((labels.nearest.values()[cell], shares), (None, 0.0));
            continue;
        }
        assert!((shares - 1.0).abs() < 1e-12);
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| euclidean(points[a], p).total_cmp(&euclidean(points[b], p)));
        if euclidean(points[order[1]], p) - euclidean(points[order[0]], p) > 0.5 {
            assert_eq!(labels.nearest.values()[cell], Some(order[0]), "{p:?}");
            assert!(labels.shares[order[0]].values()[cell] > 0.4);
        }
    }
    assert!(heatpath_core::grid::labels::labels::<2>(&[]).is_none());
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
