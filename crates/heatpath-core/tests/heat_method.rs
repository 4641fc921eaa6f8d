//! The heat method: closed forms, several sources, walls, borders and what never changes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;

use heatpath_core::Exec;
use heatpath_core::grid::distance::{
    DistanceMap, HeatMethod, HeatMethodError, HeatMethodOptions, NOT_REACHED,
};
use heatpath_core::grid::heat::ImplicitError;
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use proptest::prelude::*;
use support::{euclidean, rough};

fn distance<const D: usize>(medium: &Medium<D>, points: &[[f64; D]]) -> DistanceMap<D> {
    distance_after(HeatMethodOptions::DEFAULT_TIME, medium, points)
}

fn distance_after<const D: usize>(
    time: f64,
    medium: &Medium<D>,
    points: &[[f64; D]],
) -> DistanceMap<D> {
    let exec = Exec::single_threaded();
    let options = HeatMethodOptions { time, ..HeatMethodOptions::default() };
    let method = HeatMethod::new(medium, options, &exec).unwrap();
    method.distance(&Sources::new(points, medium.mask()).unwrap(), &exec).unwrap()
}

/// The largest error, the mean error, and the largest five cells or more from the border.
fn errors<const D: usize>(map: &DistanceMap<D>, exact: impl Fn([f64; D]) -> f64) -> [f64; 3] {
    let shape = *map.shape();
    let (mut largest, mut sum, mut inner, mut count) = (0.0_f64, 0.0, 0.0_f64, 0.0);
    for cell in (0..shape.cells()).filter(|&cell| map.field().values()[cell].is_finite()) {
        let error = (map.field().values()[cell] - exact(shape.centre(cell))).abs();
        let index = shape.index(cell);
        if (0..D).all(|axis| index[axis] >= 5 && index[axis] + 5 < shape.size()[axis]) {
            inner = inner.max(error);
        }
        (largest, sum, count) = (largest.max(error), sum + error, count + 1.0);
    }
    let mean = sum / count;
    [largest, mean, inner]
}

fn nearest(points: &[[f64; 2]], p: [f64; 2]) -> f64 {
    points.iter().map(|&source| euclidean(p, source)).fold(f64::INFINITY, f64::min)
}

#[test]
fn uniform_plane() {
    let medium = medium::uniform(Shape::new([101, 101]).unwrap());
    for (source, limits) in [
        ([50.0, 50.0], [5e-3, 3e-3, 5e-3]),
        ([50.5, 50.5], [3e-2, 1e-2, 3e-2]),
        ([20.3, 5.6], [8e-2, 1e-2, 5e-2]),
        ([0.0, 0.0], [0.3, 3e-2, 0.15]),
        ([-0.4, 60.2], [0.2, 3e-2, 8e-2]),
    ] {
        let map = distance(&medium, &[source]);
        let found = errors(&map, |p| euclidean(p, source));
        assert!(found.iter().zip(limits).all(|(found, limit)| *found < limit), "{source:?}");
    }
}

#[test]
fn space_with_spacing() {
    let shape = Shape::with_spacing([33, 41, 21], [0.5, 0.5, 1.0]).unwrap();
    let medium = medium::uniform(shape);
    for source in [[16.0, 20.0, 10.0], [5.3, 30.2, 8.8]] {
        let map = distance(&medium, &[source]);
        let exact = |p| shape.physical_distance(p, source);
        let [largest, mean, _] = errors(&map, exact);
        assert!(largest < 0.2 && mean < 0.05);
    }
}

/// Distances converge if the time is long for the cells, but short for the picture.
#[test]
fn half_plane() {
    let mut before = f64::INFINITY;
    for (n, time, limits) in
        [(51, 1.0, [5e-3, 1.3e-3]), (101, 2.0, [2.5e-3, 7e-4]), (201, 4.0, [1.4e-3, 4e-4])]
    {
        let h = 1.0 / f64::from(n - 1);
        let shape = Shape::with_spacing([n as usize; 2], [h; 2]).unwrap();
        let y = |row: f64| 1.0 + h * row;
        let field = Grid::from_fn(shape, |[_, row]| y(row as f64).powi(2));
        let middle = f64::from(n - 1) / 2.0;
        let medium = medium::given(field, Form::Pointwise).unwrap();
        let map = distance_after(time, &medium, &[[middle; 2]]);
        let exact = |p: [f64; 2]| {
            let square = (h * (p[0] - middle)).powi(2) + (y(p[1]) - 1.5).powi(2);
            (1.0 + square / (2.0 * 1.5 * y(p[1]))).acosh()
        };
        let [largest, mean, _] = errors(&map, exact);
        assert!(largest < limits[0] && mean < limits[1] && mean < before / 1.6);
        before = mean;
    }
}

#[test]
fn speed_grows_and_the_border_does_not_bend_distances() {
    let shape = Shape::new([201, 201]).unwrap();
    let (source, slope) = ([100.0, 100.0], 0.002);
    let speed = |x: f64| 0.3 + slope * x;
    let field = Grid::from_fn(shape, |[x, _]| speed(x as f64).powi(2));
    let exact = |p: [f64; 2]| {
        let square = (slope * euclidean(p, source)).powi(2);
        (1.0 + square / (2.0 * speed(source[0]) * speed(p[0]))).acosh() / slope
    };
    for form in [Form::Pointwise, Form::Divergence] {
        let map = distance(&medium::given(field.clone(), form).unwrap(), &[source]);
        let [largest, mean, inner] = errors(&map, exact);
        // The errors grow with the distance from the source, which is largest at the border.
        assert!(largest < 1.3 * inner && largest < 4.0 && mean < 0.9);
    }
}

#[test]
fn several_sources_do_not_fold_the_distances() {
    let medium = medium::uniform(Shape::new([101, 101]).unwrap());
    let three = [[20.0, 20.0], [70.0, 60.0], [80.0, 10.0]];
    let map = distance(&medium, &three);
    let [largest, mean, _] = errors(&map, |p| nearest(&three, p));
    assert!(largest < 1.6 && mean < 0.25);
    assert!(three.iter().all(|&source| map.at(source) == 0.0));
    let border: Vec<[f64; 2]> = (0..101)
        .flat_map(|i| {
            let i = f64::from(i);
            [[i, 0.0], [i, 100.0], [0.0, i], [100.0, i]]
        })
        .collect();
    let map = distance(&medium, &border);
    let [largest, mean, _] = errors(&map, |p| nearest(&border, p));
    assert!(largest < 1.6 && mean < 0.25);
    assert!(border.iter().all(|&source| map.at(source) == 0.0));
}

#[test]
fn walls_are_gone_around_and_not_through() {
    let shape = Shape::new([161, 161]).unwrap();
    let mask = Mask::new(Grid::from_fn(shape, |[x, y]| x != 80 || y >= 120));
    let medium = medium::uniform(shape).with_walls(mask).unwrap();
    let (source, end) = ([40.0, 60.0], [80.0, 119.5]);
    let exact = |p: [f64; 2]| {
        let crossing = source[1] + (80.0 - source[0]) / (p[0] - source[0]) * (p[1] - source[1]);
        if p[0] < 80.0 || crossing > end[1] {
            euclidean(p, source)
        } else {
            euclidean(source, end) + euclidean(end, p)
        }
    };
    let map = distance(&medium, &[source]);
    let [largest, _, _] = errors(&map, exact);
    assert!(largest < 4.5);
    // Right behind the wall the way is 150 cells longer than through it.
    assert!((map.at([84.0, 20.0]) / exact([84.0, 20.0]) - 1.0).abs() < 0.03);

    let apart = Mask::new(Grid::from_fn(shape, |[x, _]| x != 80));
    let medium = medium::uniform(shape).with_walls(apart).unwrap();
    let map = distance(&medium, &[source]);
    assert_eq!(map.reached().count(), 80 * 161);
    assert!((map.at([75.0, 60.0]) - 35.0).abs() < 0.5);
    let both = distance(&medium, &[source, [120.0, 60.0]]);
    assert_eq!(both.field()[[40, 60]], 0.0);
    assert!((both.at([75.0, 60.0]) - map.at([75.0, 60.0])).abs() < 1e-9);
    assert!((both.at([85.0, 60.0]) - both.at([75.0, 60.0])).abs() < 1e-6);
}

#[test]
fn slender_grids_and_single_cells() {
    for size in [[200, 1], [1, 200]] {
        let source = size.map(|side| if side > 1 { 60.0 } else { 0.0 });
        let map = distance(&medium::uniform(Shape::new(size).unwrap()), &[source]);
        assert!(errors(&map, |p| euclidean(p, source))[0] < 1e-9);
    }
    let map = distance(&medium::uniform(Shape::new([1, 1, 1]).unwrap()), &[[0.25, 0.0, 0.0]]);
    assert_eq!(map.field().values(), [0.25]);
}

#[test]
fn units_do_not_matter() {
    let (medium, source) = rough(Shape::new([40, 30]).unwrap(), 1.0, Form::Pointwise, 0.1, 3);
    let map = distance(&medium, &[source]);
    let k = medium.factor().unwrap();
    for (scale, spacing) in [(1e-40, 1.0), (1e60, 1e-9)] {
        let shape = Shape::with_spacing([40, 30], [spacing; 2]).unwrap();
        let field = Grid::from_values(shape, k.values().iter().map(|k| k * scale).collect());
        let other = medium::given(field.unwrap(), Form::Divergence).unwrap();
        let other = distance(&other.with_walls(medium.mask().clone()).unwrap(), &[source]);
        for (a, b) in map.reached().zip(other.reached()) {
            let b = b * scale.sqrt() / spacing;
            assert!((a - b).abs() < 1e-7 * (1.0 + a), "{a} {b}");
        }
    }
}

#[test]
fn what_cannot_be_done_is_refused() {
    let medium = medium::uniform(Shape::new([20, 15]).unwrap());
    let exec = Exec::single_threaded();
    let refusal = |options| HeatMethod::new(&medium, options, &exec).map(|_| ()).unwrap_err();
    for time in [0.0, -1.0, f64::INFINITY] {
        let options = HeatMethodOptions { time, ..HeatMethodOptions::default() };
        assert_eq!(refusal(options), HeatMethodError::Implicit(ImplicitError::Time(time)));
    }
    let small = HeatMethodOptions { memory_limit: 1000, ..HeatMethodOptions::default() };
    assert!(matches!(refusal(small), HeatMethodError::Implicit(ImplicitError::TooLarge(_))));
    let larger = Mask::all_open(Shape::new([40, 40]).unwrap());
    let elsewhere = Sources::new(&[[25.0, 10.0]], &larger).unwrap();
    let method = HeatMethod::new(&medium, HeatMethodOptions::default(), &exec).unwrap();
    assert!(matches!(method.distance(&elsewhere, &exec), Err(HeatMethodError::Point(_))));
    let cancelling = Exec::single_threaded().with_watch(|_| std::ops::ControlFlow::Break(()));
    let source = Sources::new(&[[5.0, 10.0]], medium.mask()).unwrap();
    assert!(method.distance(&source, &cancelling).is_err());
    assert_eq!(method.distances(&[], &exec).unwrap(), []);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn zero_at_sources_finite_where_reachable_and_the_same_for_any_threads(
        seed in 1_u64..10_000, contrast in 0.0..3.0, density in 0.0..0.4, size in 4_usize..24,
    ) {
        let shape = Shape::with_spacing([size, 27 - size, 4], [1.0, 1.5, 2.0]).unwrap();
        let (medium, source) = rough(shape, contrast, Form::Divergence, density, seed);
        let open: Vec<usize> =
            (0..shape.cells()).filter(|&cell| medium.mask().is_open(cell)).collect();
        let points = [source, shape.centre(open[open.len() / 2]), shape.centre(open[0])];
        let both = Sources::new(&points, medium.mask()).unwrap();
        let sets: Vec<_> = both.each().into_iter().chain([both]).collect();
        let exec = Exec::single_threaded();
        let method = HeatMethod::new(&medium, HeatMethodOptions::default(), &exec).unwrap();
        let maps = method.distances(&sets, &exec).unwrap();
        prop_assert_eq!(&maps, &method.distances(&sets, &Exec::new(3).unwrap()).unwrap());
        for (map, sources) in maps.iter().zip(&sets) {
            prop_assert_eq!(map, &method.distance(sources, &exec).unwrap());
            let seeds = sources.points().iter().map(|&p| shape.position(shape.cell_at(p)));
            let reachable = medium.mask().reachable_from(seeds.clone());
            for (value, reachable) in map.field().values().iter().zip(reachable.values()) {
                prop_assert_eq!(value.is_finite(), *reachable);
                prop_assert!(*value >= 0.0 && *value <= NOT_REACHED);
            }
            for cell in seeds {
                prop_assert_eq!(map.field().values()[cell], 0.0);
            }
        }
    }

    #[test]
    fn flips_and_turns_change_nothing(seed in 1_u64..10_000, contrast in 0.0..3.0) {
        let size = [19, 14];
        let (medium, source) = rough(Shape::new(size).unwrap(), contrast, Form::Pointwise, 0.15, seed);
        let map = distance(&medium, &[source]);
        let k = medium.factor().unwrap();
        let turned = Shape::new([14, 19]).unwrap();
        let back = |[x, y]: [usize; 2]| [size[0] - 1 - y, x];
        let field = Grid::from_fn(turned, |index| k[back(index)]);
        let open = Grid::from_fn(turned, |index| {
            medium.mask().is_open(k.shape().position(back(index)))
        });
        let other = medium::given(field, Form::Pointwise).unwrap().with_walls(Mask::new(open));
        let other = distance(&other.unwrap(), &[[source[1], 18.0 - source[0]]]);
        for x in 0..14 {
            for y in 0..19 {
                let (a, b) = (map.field()[back([x, y])], other.field()[[x, y]]);
                prop_assert!(a == b || (a - b).abs() < 1e-7 * (1.0 + a), "{} {}", a, b);
            }
        }
    }
}
