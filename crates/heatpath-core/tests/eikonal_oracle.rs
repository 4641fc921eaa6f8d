//! Fast marching against its simplest version, and what must hold in any medium.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;

use heatpath_core::Exec;
use heatpath_core::grid::distance::{Eikonal, EikonalError, EikonalOptions, NOT_REACHED, Order};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::{Grid, Mask, Shape, Sources, TensorField};
use proptest::prelude::*;
use support::{march, random, rough};

/// The distance from a source at the centre of a cell in an isotropic medium of unit spacing: in each
/// round the nearest of all cells that are not yet known becomes known, and each is found by halving
/// intervals.
fn oracle<const D: usize>(medium: &Medium<D>, source: [usize; D], order: Order) -> Vec<f64> {
    let (shape, mask) = (medium.shape(), medium.mask());
    let mut known = vec![f64::INFINITY; shape.cells()];
    let mut trial = known.clone();
    known[shape.position(source)] = 0.0;
    let mut last = 0.0;
    loop {
        let unknown = |cell: &usize| mask.is_open(*cell) && known[*cell].is_infinite();
        let unknown: Vec<usize> = (0..shape.cells()).filter(unknown).collect();
        for &cell in &unknown {
            let distance = root(medium, source, &known, cell, order);
            trial[cell] = trial[cell].min(f64::max(distance, last));
        }
        let nearest = unknown.into_iter().min_by(|&a, &b| trial[a].total_cmp(&trial[b]));
        let Some(cell) = nearest.filter(|&cell| trial[cell].is_finite()) else {
            return known;
        };
        last = trial[cell];
        known[cell] = last;
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
    let shape = medium.shape();
    // No step from a neighbour costs a tenth more than in the cell itself.
    let is_plausible = |distance: &f64| {
        let most = 1.1 / medium.speed_sq(cell).sqrt();
        shape.neighbours(cell).all(|next| *distance <= known[next] + most)
    };
    let with = |difference| bisect(medium, source, known, cell, difference).filter(is_plausible);
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
                // Straight towards the source differences are those of T.
                let is_factored = difference != Difference::Plain && slope_of_r > -0.5;
                match (difference, is_factored) {
                    (Difference::Second, true) if next < near - 1e-12 => {
                        r(here) * (1.5 * tau - 2.0 * t1 + 0.5 * t2) + tau * slope_of_r
                    }
                    (Difference::Second, false) if next < near - 1e-12 => {
                        1.5 * t - 2.0 * near + 0.5 * next
                    }
                    (_, true) => r(here) * (tau - t1) + tau * slope_of_r,
                    (_, false) => t - near,
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

fn tensor_medium(shape: Shape<2>, anisotropy: f64, walls: f64, seed: u64) -> (Medium<2>, [f64; 2]) {
    let mut random = random(seed);
    let ratio = (1.0 - anisotropy) / (1.0 + anisotropy);
    let field = TensorField::from_fn(shape, |_| {
        let (sin, cos) = (3.2 * random()).sin_cos();
        let xy = (1.0 - ratio) * sin * cos;
        [[cos * cos + ratio * sin * sin, xy], [xy, sin * sin + ratio * cos * cos]]
    });
    let source = [shape.size()[0] / 3, shape.size()[1] / 2];
    let mask = Mask::new(Grid::from_fn(shape, |index| index == source || random() > walls));
    let medium = medium::given_tensor(field).unwrap().with_walls(mask).unwrap();
    (medium, source.map(|i| i as f64))
}

/// What is reached is what open cells connect with the source.
fn check_reached<const D: usize>(medium: &Medium<D>, source: [f64; D]) {
    let field = march(medium, &[source], &EikonalOptions::default());
    let cell = medium.shape().position(medium.shape().cell_at(source));
    let connected = medium.mask().reachable_from([cell]);
    for (cell, &distance) in field.values().iter().enumerate() {
        let index = medium.shape().index(cell);
        assert_eq!(distance < NOT_REACHED, connected.values()[cell], "{index:?}: {distance}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn what_is_connected_is_reached(seed in 0_u64..1 << 32, contrast in 0.0..6.0, walls in 0.0..0.6) {
        let (medium, source) =
            rough(Shape::new([23, 19]).unwrap(), contrast, Form::Divergence, walls, seed);
        check_reached(&medium, source);
        let (medium, source) =
            rough(Shape::new([9, 8, 7]).unwrap(), contrast, Form::Pointwise, walls, seed);
        check_reached(&medium, source);
        let (medium, source) = tensor_medium(Shape::new([23, 19]).unwrap(), 0.95, walls, seed);
        check_reached(&medium, source);
    }

    /// A step to a neighbour costs at most a tenth more than it does at the speed there.
    #[test]
    fn neighbours_are_near_each_other(seed in 0_u64..1 << 32, contrast in 0.0..4.0) {
        let shape = Shape::with_spacing([24, 17], [1.0, 1.7]).unwrap();
        let (medium, source) = rough(shape, contrast, Form::Pointwise, 0.2, seed);
        let off = [source[0] + 0.3, source[1] - 0.2];
        let source = if medium.mask().segment_is_open(source, off) && shape.contains(off) { off } else { source };
        let field = march(&medium, &[source], &EikonalOptions::default());
        for cell in (0..shape.cells()).filter(|&cell| field.values()[cell] < NOT_REACHED) {
            for next in shape.neighbours(cell).filter(|&next| field.values()[next] < NOT_REACHED) {
                let length = shape.physical_distance(shape.centre(cell), shape.centre(next));
                let most = 1.1 * length / medium.speed_sq(next).sqrt();
                let step = field.values()[next] - field.values()[cell];
                prop_assert!(step <= most * (1.0 + 1e-9), "{step} of {most}");
            }
        }
    }

    /// Turned pictures and other units of length give turned distances in those units.
    #[test]
    fn turns_and_units_change_nothing(seed in 0_u64..1 << 32) {
        let shape = Shape::with_spacing([21, 16], [1.0, 1.5]).unwrap();
        let (medium, source) = rough(shape, 1.0, Form::Pointwise, 0.15, seed);
        let field = march(&medium, &[source], &EikonalOptions::default());
        let turned_shape = Shape::with_spacing([16, 21], [1.5e3, 1e3]).unwrap();
        let back = |[x, y]: [usize; 2]| [20 - y, x];
        let speeds = Grid::from_fn(turned_shape, |index| medium.speed_sq(shape.position(back(index))));
        let mask = Mask::new(Grid::from_fn(turned_shape, |index| {
            medium.mask().is_open(shape.position(back(index)))
        }));
        let turned = medium::given(speeds, Form::Pointwise).unwrap().with_walls(mask).unwrap();
        let again = march(&turned, &[[source[1], 20.0 - source[0]]], &EikonalOptions::default());
        for cell in 0..turned_shape.cells() {
            let (a, b) = (1e3 * field[back(turned_shape.index(cell))], again.values()[cell]);
            prop_assert!(a == b || (a - b).abs() < 1e-9 * a, "{a} {b}");
        }
    }
}

#[test]
fn walls_are_walked_around() {
    // A wall from the top down to row 30, and a cell wide: the way leads around its end.
    let shape = Shape::new([81, 61]).unwrap();
    let mask = Mask::new(Grid::from_fn(shape, |[x, y]| x != 40 || y > 30));
    let medium = medium::uniform(shape).with_walls(mask).unwrap();
    let field = march(&medium, &[[20.0, 10.0]], &EikonalOptions::default());
    let around = 20_f64.hypot(21.0) + 20_f64.hypot(21.0);
    let there = field[[60, 10]];
    assert!((there / around - 1.0).abs() < 0.02, "{there} of {around}");
    // Two walls that touch at a corner let nothing through, in an anisotropic medium neither.
    let shape = Shape::new([24, 24]).unwrap();
    let diagonal = Mask::new(Grid::from_fn(shape, |[x, y]| x != y));
    let tensor = TensorField::from_fn(shape, |_| [[1.0, -0.95], [-0.95, 1.0]]);
    for medium in [medium::uniform(shape), medium::given_tensor(tensor).unwrap()] {
        let medium = medium.with_walls(diagonal.clone()).unwrap();
        let field = march(&medium, &[[16.0, 4.0]], &EikonalOptions::default());
        assert!(field[[20, 8]] < NOT_REACHED && field[[4, 16]] == NOT_REACHED);
    }
}

#[test]
fn results_do_not_depend_on_threads() {
    let (medium, source) = tensor_medium(Shape::new([70, 60]).unwrap(), 0.9, 0.1, 3);
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    let fields = [1, 2, 5].map(|threads| {
        let exec = Exec::new(threads).unwrap();
        let eikonal = Eikonal::new(&medium, &exec).unwrap();
        eikonal.distance(&sources, &EikonalOptions::default(), &exec).unwrap().into_field()
    });
    assert!(fields[0] == fields[1] && fields[1] == fields[2]);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let medium = medium::uniform(Shape::new([9, 9]).unwrap());
    let exec = Exec::single_threaded();
    let eikonal = Eikonal::new(&medium, &exec).unwrap();
    let sources = Sources::new(&[[1.0, 1.0], [5.0, 5.0]], medium.mask()).unwrap();
    let with =
        |options: EikonalOptions<2>| eikonal.distance(&sources, &options, &exec).unwrap_err();
    let initial =
        |initial: &[f64]| EikonalOptions { initial: initial.to_vec(), ..Default::default() };
    assert_eq!(with(initial(&[0.0])), EikonalError::InitialCount { given: 1, expected: 2 });
    let error = with(initial(&[0.0, -1.0]));
    assert_eq!(error, EikonalError::Initial { number: 1, value: -1.0 });
    assert!(matches!(with(initial(&[f64::NAN, 0.0])), EikonalError::Initial { number: 0, .. }));
    let target = EikonalOptions { targets: vec![[9.0, 0.0]], ..Default::default() };
    assert!(matches!(with(target), EikonalError::Target(_)));
    for farthest in [0.0, -1.0, f64::NAN] {
        let end = EikonalOptions { farthest, ..Default::default() };
        assert!(matches!(with(end), EikonalError::Farthest(_)));
    }
    let cancelled = Exec::single_threaded().with_watch(|_| std::ops::ControlFlow::Break(()));
    let large = medium::uniform(Shape::new([300, 300]).unwrap());
    let eikonal = Eikonal::new(&large, &exec).unwrap();
    let result = eikonal.distance(&sources, &EikonalOptions::default(), &cancelled);
    assert!(matches!(result, Err(EikonalError::Cancelled(_))));
}
