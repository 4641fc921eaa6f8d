//! Implicit heat: closed forms, paths, and what is refused.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;

use heatpath_core::Exec;
use heatpath_core::grid::distance::{normalized, varadhan};
use heatpath_core::grid::heat::{
    Explicit, Heat, HeatOptions, Implicit, ImplicitError, ImplicitOptions, Step,
};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::path::Ending;
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use support::{euclidean, flow, options, paths};

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

/// A medium without any open cell can be prepared, although nothing can start there.
#[test]
fn walls_everywhere_but_one_cell_or_none() {
    let shape = Shape::new([5, 4, 3]).unwrap();
    let exec = Exec::single_threaded();
    let nowhere = Mask::new(Grid::from_fn(shape, |_| false));
    let closed = medium::uniform(shape).with_walls(nowhere).unwrap();
    assert!(Implicit::new(&closed, ImplicitOptions::default(), &exec).is_ok());
    let one = Mask::new(Grid::from_fn(shape, |index| index == [2, 2, 1]));
    let cell = medium::uniform(shape).with_walls(one).unwrap();
    let heat = flow(&cell, [2.0, 2.0, 1.0], ImplicitOptions::default());
    assert_eq!(heat.ln_temperature()[[2, 2, 1]], 0.0);
    assert_eq!(heat.ln_temperature().values().iter().filter(|ln| ln.is_finite()).count(), 1);
    assert_eq!(normalized(&heat).reached().count(), 1);
}

/// A host keeps a solver without keeping the medium.
#[test]
fn a_solver_may_own_its_medium() {
    let medium = medium::uniform(Shape::new([20, 15]).unwrap());
    let exec = Exec::single_threaded();
    let sources = Sources::new(&[[4.0, 5.5]], medium.mask()).unwrap();
    let borrowing = Implicit::new(&medium, ImplicitOptions::default(), &exec).unwrap();
    let expected = borrowing.flow(&sources, &exec).unwrap();
    let owning: Implicit<'static, 2> =
        Implicit::new(medium, ImplicitOptions::default(), &exec).unwrap();
    let heat = owning.flow(&sources, &exec).unwrap();
    assert_eq!(heat.ln_temperature().values(), expected.ln_temperature().values());
}
