//! What must not change the result: turns, flips, units, and what lies out of reach.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::grid::distance::{DistanceMap, normalized};
use heatpath_core::grid::heat::{Duration, Explicit, FaceMean, Heat, HeatOptions};
use heatpath_core::grid::medium::{self, Medium};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use std::ops::ControlFlow;

const N: usize = 90;
const STEPS: usize = 150;

/// A picture without any symmetry.
fn picture(spacing: [f64; 2]) -> Grid<f64, 2> {
    Grid::from_fn(Shape::with_spacing([N, N], spacing).unwrap(), |[x, y]| {
        let (x, y) = (x as f64, y as f64);
        0.5 + 0.2 * (0.11 * x + 0.03 * y).sin() + 0.2 * (0.05 * x - 0.17 * y + 1.0).cos()
    })
}

/// The medium under test, made from a picture and the value at its source.
type Make = fn(&Grid<f64, 2>, f64) -> Medium<2>;

const MEDIA: [(&str, Make); 5] = [
    ("uniform", |image, _| medium::uniform(*image.shape())),
    ("conductivity", |image, f0| medium::conductivity(image, &[f0], Default::default()).unwrap()),
    ("perona-malik", |image, _| medium::perona_malik(image, Default::default()).unwrap()),
    ("combined", |image, f0| {
        medium::combined(image, &[f0], Default::default(), Default::default()).unwrap()
    }),
    ("edges", |image, _| medium::edges(image, Default::default()).unwrap()),
];

fn flow(medium: &Medium<2>, source: [f64; 2], steps: usize) -> Heat<2> {
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    let options = HeatOptions { duration: Duration::Iterations(steps), ..Default::default() };
    Explicit::new(medium, options).unwrap().flow(&sources, &Exec::single_threaded()).unwrap()
}

fn distance(image: &Grid<f64, 2>, make: Make, source: [f64; 2]) -> DistanceMap<2> {
    normalized(&flow(&make(image, image.sample(source)), source, STEPS))
}

#[test]
fn flips_and_turns_change_no_bit() {
    let image = picture([1.0, 1.0]);
    let last = N - 1;
    let turns: [fn([usize; 2]) -> [usize; 2]; 4] = [
        |[x, y]| [N - 1 - x, y],
        |[x, y]| [x, N - 1 - y],
        |[x, y]| [y, x],
        |[x, y]| [y, N - 1 - x],
    ];
    for (name, make) in MEDIA {
        let plain = distance(&image, make, [30.0, 41.0]);
        for turn in turns {
            let turned = Grid::from_fn(*image.shape(), |index| image[turn(index)]);
            // The source's cell of the turned picture is the one that looks at the original's.
            let source = (0..N * N).map(|p| [p % N, p / N]).find(|&i| turn(i) == [30, 41]).unwrap();
            let map = distance(&turned, make, source.map(|i| i as f64));
            for cell in (0..N * N).map(|p| [p % N, p / N]) {
                assert_eq!(map.field()[cell], plain.field()[turn(cell)], "{name} at {cell:?}");
            }
        }
        assert!(plain.field()[[last, last]].is_finite());
    }
}

#[test]
fn distances_scale_with_the_unit_of_length() {
    for (name, make) in MEDIA {
        let millimetres = distance(&picture([0.25, 0.5]), make, [30.0, 41.0]);
        // A power of two changes no bit; another factor rounds.
        let doubled = distance(&picture([0.5, 1.0]), make, [30.0, 41.0]);
        let metres = distance(&picture([0.00025, 0.0005]), make, [30.0, 41.0]);
        for cell in 0..N * N {
            let d = millimetres.field().values()[cell];
            assert_eq!(doubled.field().values()[cell], 2.0 * d, "{name}");
            assert!((metres.field().values()[cell] * 1000.0 - d).abs() <= 1e-9 * d, "{name}");
        }
    }
}

#[test]
fn distance_is_symmetric() {
    let image = picture([1.0, 1.0]);
    let (a, b) = ([30.0, 41.0], [52.0, 33.0]);
    for (name, make) in MEDIA {
        // The medium is that of `a` in both directions.
        let medium = make(&image, image.sample(a));
        // The scheme is symmetric up to the factor k: u_a(b) / k(b) = u_b(a) / k(a).
        let ln_u = |from: [f64; 2], to: [f64; 2]| {
            let k = medium.factor().map_or(1.0, |k| k[to.map(|i| i as usize)]);
            flow(&medium, from, STEPS).ln_temperature().sample(to) - k.ln()
        };
        let (there, back) = (ln_u(a, b), ln_u(b, a));
        assert!((there - back).abs() < 1e-9 * there.abs(), "{name}: {there} and {back}");
    }
}

#[test]
fn what_heat_cannot_reach_does_not_matter() {
    let image = picture([1.0, 1.0]);
    let source = [20.0, 20.0];
    let is_wall = |x: usize| x == 60;
    for (name, make) in MEDIA {
        let open = make(&image, image.sample(source));
        let wall = Mask::new(Grid::from_fn(*image.shape(), |[x, _]| !is_wall(x)));
        let walled = open.clone().with_walls(wall).unwrap();
        // Heat moves one cell a step: after 39 steps it has not met the wall.
        let before = normalized(&flow(&walled, source, 39));
        assert_eq!(before, normalized(&flow(&open, source, 39)), "{name}");
        // Later it has filled all of its side, and nothing of the other.
        let after = normalized(&flow(&walled, source, STEPS));
        for cell in (0..N * N).map(|p| [p % N, p / N]) {
            let steps = cell[0].abs_diff(20) + cell[1].abs_diff(20);
            assert_eq!(before.field()[cell].is_finite(), steps <= 39, "{name} at {cell:?}");
            assert_eq!(after.field()[cell].is_finite(), cell[0] < 60, "{name} at {cell:?}");
        }
    }
}

#[test]
fn a_constant_medium_has_one_face_mean() {
    let field = picture([1.0, 1.0]).map(|_| 0.5);
    let medium = medium::given(field, medium::Form::Divergence).unwrap();
    let sources = Sources::new(&[[30.0, 41.0]], medium.mask()).unwrap();
    let [arithmetic, harmonic] = [FaceMean::Arithmetic, FaceMean::Harmonic].map(|face_mean| {
        let explicit =
            Explicit::new(&medium, HeatOptions { face_mean, ..Default::default() }).unwrap();
        normalized(&explicit.flow(&sources, &Exec::single_threaded()).unwrap())
    });
    assert_eq!(arithmetic, harmonic);
}

#[test]
fn a_watcher_sees_progress_and_can_cancel() {
    let medium = medium::uniform(Shape::new([64, 64]).unwrap());
    let sources = Sources::new(&[[3.0, 3.0]], medium.mask()).unwrap();
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let seen = std::sync::Mutex::new(Vec::new());
    let watching = Exec::single_threaded().with_watch(|finished| {
        seen.lock().unwrap().push(finished);
        ControlFlow::Continue(())
    });
    explicit.flow(&sources, &watching).unwrap();
    drop(watching);
    let seen = seen.into_inner().unwrap();
    assert!(seen.len() > 5 && seen.windows(2).all(|pair| pair[0] < pair[1]), "{seen:?}");
    assert_eq!((seen[0], seen[seen.len() - 1]), (0.0, 1.0));

    let cancelling = Exec::single_threaded().with_watch(|finished| {
        if finished > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(explicit.flow(&sources, &cancelling).unwrap_err().to_string(), "cancelled");
}

#[test]
fn steps_above_the_stable_one_are_refused_with_both_numbers() {
    use heatpath_core::grid::heat::{HeatError, Step};
    let medium = medium::uniform(Shape::new([20, 20]).unwrap());
    let with = |step, duration| {
        Explicit::new(&medium, HeatOptions { step, duration, ..Default::default() })
            .map(|e| e.step())
    };
    let usual = Duration::default();
    assert_eq!(
        with(Step::Fixed(0.26), usual).unwrap_err().to_string(),
        "the time step 0.26 is too large: the largest stable step in this medium is 0.25"
    );
    assert_eq!(with(Step::Auto, usual), Ok(0.2));
    assert_eq!(with(Step::Fixed(0.25), usual), Ok(0.25));
    assert_eq!(with(Step::Fixed(-1.0), usual), Err(HeatError::Step(-1.0)));
    for absurd in [0, usize::MAX] {
        let refused = Err(HeatError::Iterations(absurd as f64));
        assert_eq!(with(Step::Auto, Duration::Iterations(absurd)), refused);
    }
    assert_eq!(with(Step::Auto, Duration::Time(1e300)), Err(HeatError::Iterations(5e300)));
    assert_eq!(with(Step::Fixed(1e-300), usual), Err(HeatError::Step(1e-300)));
    assert!(with(Step::Fixed(f64::NAN), usual).is_err());
    assert_eq!(with(Step::Auto, Duration::Time(0.0)), Err(HeatError::Time(0.0)));
    assert_eq!(with(Step::Auto, Duration::Time(1.1)), Ok(1.1 / 6.0));
}

/// Images step as in the paper; volumes take the same part of what is stable in them.
#[test]
fn the_usual_step_is_stable_in_images_and_volumes() {
    fn step<const D: usize>(spacing: [f64; D]) -> f64 {
        let medium = medium::uniform(Shape::with_spacing([9; D], spacing).unwrap());
        Explicit::new(&medium, HeatOptions::default()).unwrap().step()
    }
    assert_eq!(step([1.0, 1.0]), 0.2);
    assert_eq!(step([3.0, 2.0]), 0.2);
    assert_eq!(step([1.0, 1.0, 1.0]), 0.8 / 6.0);
    assert_eq!(step([0.4, 0.4, 2.5]), 0.8 / 6.0);
}

/// Heat moves one cell a step: by default it gets from corner to corner.
#[test]
fn the_usual_duration_crosses_images_and_volumes() {
    fn reached<const D: usize>(size: [usize; D]) -> usize {
        let shape = Shape::new(size).unwrap();
        let medium = medium::uniform(shape);
        let corner = Sources::new(&[[0.0; D]], medium.mask()).unwrap();
        let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
        assert_eq!(explicit.iterations(), D * shape.longest_side());
        let heat = explicit.flow(&corner, &Exec::single_threaded()).unwrap();
        heat.ln_temperature().values().iter().filter(|ln_u| ln_u.is_finite()).count()
    }
    assert_eq!(reached([12, 12]), 144);
    assert_eq!(reached([12, 11, 12]), 12 * 11 * 12);
}
