//! Heat where D is a tensor, against the simplest engine and closed forms.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::exec::SimdLevel;
use heatpath_core::grid::distance::normalized;
use heatpath_core::grid::heat::{
    Duration, Explicit, Heat, HeatOptions, Implicit, ImplicitError, ImplicitOptions, Step,
};
use heatpath_core::grid::medium::{self, Medium};
use heatpath_core::grid::{Grid, Mask, Matrix, Shape, Sources, TensorField};
use std::ops::Range;

mod support;
use support::random;

/// The matrix with these eigenvalues along a direction and across it.
fn along<const D: usize>(direction: [f64; D], [along, across]: [f64; 2]) -> Matrix<D> {
    let norm_sq: f64 = direction.iter().map(|part| part * part).sum();
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let outer = direction[i.min(j)] * direction[i.max(j)] / norm_sq;
            (along - across) * outer + if i == j { across } else { 0.0 }
        })
    })
}

/// Directions that turn around a centre, with some noise.
fn turning<const D: usize>(shape: Shape<D>, eigenvalues: [f64; 2], noise: f64) -> TensorField<D> {
    let mut random = random(7);
    TensorField::from_fn(shape, |index| {
        let from_centre: [f64; D] =
            std::array::from_fn(|axis| index[axis] as f64 - 0.47 * shape.size()[axis] as f64);
        let mut direction = [3.0; D];
        (direction[0], direction[1]) = (-from_centre[1], from_centre[0]);
        let noise = noise * from_centre.iter().map(|part| part.abs()).sum::<f64>();
        along(direction.map(|part| part + noise * (random() - 0.5)), eigenvalues)
    })
}

/// Weights of a sum of `weight offset offset'`, found among all small superbases.
fn superbase_weights(m: &Matrix<2>) -> Vec<([isize; 2], f64)> {
    let range = || -12_isize..=12;
    let vectors = || range().flat_map(|x| range().map(move |y| [x, y]));
    for a in vectors() {
        for b in vectors().filter(|b| a[0] * b[1] - a[1] * b[0] == 1) {
            let c = [-a[0] - b[0], -a[1] - b[1]];
            let product = |p: [isize; 2], q: [isize; 2]| -> f64 {
                let sum = |i: usize| (0..2).map(|j| m[i][j] * q[j] as f64).sum::<f64>();
                (0..2).map(|i| p[i] as f64 * sum(i)).sum()
            };
            let weights = [(a, -product(b, c)), (b, -product(c, a)), (c, -product(a, b))];
            if weights.iter().all(|(_, weight)| *weight >= -1e-12) {
                return weights.map(|([x, y], weight)| ([-y, x], weight)).to_vec();
            }
        }
    }
    panic!("no small superbase is obtuse for {m:?}");
}

/// The conductances between all cells of a plane, by the formulas alone.
fn dense(medium: &Medium<2>) -> Vec<Vec<f64>> {
    let (shape, mask) = (*medium.shape(), medium.mask());
    let mut conductances = vec![vec![0.0; shape.cells()]; shape.cells()];
    let field = medium.diffusion().tensor().unwrap();
    let scale = shape.spacing().map(|spacing| shape.smallest_spacing() / spacing);
    for cell in (0..shape.cells()).filter(|&cell| mask.is_open(cell)) {
        let d = field.at(cell);
        let mut m: Matrix<2> =
            std::array::from_fn(|i| std::array::from_fn(|j| d[i][j] * scale[i] * scale[j]));
        let floor = 0.125 * (m[0][0] * m[1][1] - m[0][1] * m[0][1]) / (m[0][0] + m[1][1]);
        (0..2).for_each(|axis| m[axis][axis] -= floor);
        let axes = [([1, 0], floor), ([0, 1], floor)];
        for (offset, weight) in superbase_weights(&m).into_iter().chain(axes) {
            for sign in [1, -1] {
                let index = shape.index(cell);
                let [x, y] = [0, 1].map(|i| index[i] as isize + sign * offset[i]);
                let [width, height] = shape.size().map(|side| side as isize);
                if (0..width).contains(&x) && (0..height).contains(&y) {
                    let other = shape.position([x as usize, y as usize]);
                    if mask.segment_is_open(shape.centre(cell), shape.centre(other)) {
                        conductances[cell][other] += 0.5 * weight;
                        conductances[other][cell] += 0.5 * weight;
                    }
                }
            }
        }
    }
    conductances
}

fn options(iterations: usize, step: Step) -> HeatOptions {
    HeatOptions { duration: Duration::Iterations(iterations), step, ..HeatOptions::default() }
}

fn flow<const D: usize>(
    medium: &Medium<D>,
    source: [f64; D],
    options: HeatOptions,
    exec: &Exec,
) -> Heat<D> {
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    Explicit::new(medium, options).unwrap().flow(&sources, exec).unwrap()
}

fn assert_agrees(medium: &Medium<2>, source: [usize; 2], iterations: usize) {
    let shape = *medium.shape();
    let options = options(iterations, Step::Fixed(0.11));
    let heat = flow(medium, source.map(|i| i as f64), options, &Exec::single_threaded());
    let mut conductances = dense(medium);
    // The engine keeps what flows in a step in single precision.
    let rounded = |c: &f64| f64::from((heat.step() * c) as f32) / heat.step();
    conductances.iter_mut().for_each(|row| row.iter_mut().for_each(|c| *c = rounded(c)));
    let mut u = vec![0.0; shape.cells()];
    u[shape.position(source)] = 1.0;
    let mut sum = u.clone();
    for _ in 0..iterations {
        let before = u.clone();
        for (cell, u) in u.iter_mut().enumerate() {
            for (conductance, other) in conductances[cell].iter().zip(&before) {
                *u += heat.step() * conductance * (other - before[cell]);
            }
        }
        sum.iter_mut().zip(&u).for_each(|(sum, u)| *sum += u);
    }
    let mut worst: f64 = 0.0;
    for cell in 0..shape.cells() {
        let ln_u = heat.ln_temperature().values()[cell];
        let index = shape.index(cell);
        // A weight that is nothing but rounding may be missing on one side.
        if u[cell] > 1e-290 {
            worst = worst.max((ln_u - u[cell].ln()).abs() / (1.0 + ln_u.abs()));
            let ln_sum = heat.ln_exposure().unwrap().values()[cell];
            worst = worst.max((ln_sum - sum[cell].ln()).abs() / (1.0 + ln_sum.abs()));
        } else if u[cell] == 0.0 {
            assert_eq!(ln_u, f64::NEG_INFINITY, "{index:?}");
        }
    }
    assert!(worst < 1e-12, "{worst}");
}

#[test]
fn planes_agree_with_the_simplest_engine() {
    for (size, spacing, noise) in
        [([45, 33], [1.0, 1.0], 0.0), ([37, 31], [1.0, 1.5], 0.3), ([70, 9], [2.0, 1.0], 5.0)]
    {
        let shape = Shape::with_spacing(size, spacing).unwrap();
        let medium = medium::given_tensor(turning(shape, [1.0, 0.05], noise)).unwrap();
        for iterations in [1, 2, 3, 7, 40] {
            assert_agrees(&medium, [12, 4], iterations);
        }
        let mut random = random(3);
        let mask = Mask::new(Grid::from_fn(shape, |index| index == [12, 4] || random() > 0.2));
        assert_agrees(&medium.with_walls(mask).unwrap(), [12, 4], 50);
    }
}

#[test]
fn the_result_depends_on_neither_threads_nor_vector_instructions() {
    fn check<const D: usize>(medium: &Medium<D>, source: [f64; D]) {
        let options = options(60, Step::Auto);
        let once = flow(medium, source, options, &Exec::single_threaded());
        let level = |level| Exec::single_threaded().with_simd(level);
        let others = [
            Exec::new(2).unwrap(),
            Exec::new(3).unwrap(),
            level(SimdLevel::Baseline),
            level(SimdLevel::Avx2),
        ];
        for exec in others {
            let again = flow(medium, source, options, &exec);
            assert_eq!(once.ln_temperature(), again.ln_temperature());
            assert_eq!(once.ln_exposure(), again.ln_exposure());
        }
    }
    let field = turning(Shape::new([170, 150]).unwrap(), [1.0, 0.05], 0.5);
    check(&medium::given_tensor(field).unwrap(), [90.0, 61.0]);
    let field = turning(Shape::new([41, 37, 29]).unwrap(), [1.0, 0.05], 0.5);
    check(&medium::given_tensor(field).unwrap(), [9.0, 21.0, 11.0]);
}

/// Once with tiles as they are, once with the cells shifted against them by rows and columns of
/// walls.
#[test]
fn the_result_does_not_depend_on_tiles() {
    let size = [150, 140];
    let field = turning(Shape::new(size).unwrap(), [1.0, 0.05], 0.3);
    // Walls around the field: the same cells can be reached on the same ways.
    let framed = |margin: [usize; 2]| {
        let shape = Shape::new([0, 1].map(|axis| size[axis] + 160)).unwrap();
        let inside = |index: [usize; 2]| -> Option<[usize; 2]> {
            let inner =
                |axis: usize| index[axis].checked_sub(margin[axis]).filter(|i| *i < size[axis]);
            Some([inner(0)?, inner(1)?])
        };
        let matrix = |index| {
            let cell = inside(index).map(|inner| field.shape().position(inner));
            cell.map_or([[1.0, 0.0], [0.0, 1.0]], |cell| field.at(cell))
        };
        let mask = Mask::new(Grid::from_fn(shape, |index| inside(index).is_some()));
        let medium = medium::given_tensor(TensorField::from_fn(shape, matrix)).unwrap();
        let source = [70.0 + margin[0] as f64, 50.0 + margin[1] as f64];
        let options = options(250, Step::Fixed(0.2));
        let heat =
            flow(&medium.with_walls(mask).unwrap(), source, options, &Exec::single_threaded());
        Grid::from_fn(*field.shape(), |[x, y]| {
            heat.ln_temperature()[[x + margin[0], y + margin[1]]]
        })
    };
    let plain = framed([0, 0]);
    assert!(plain.values().iter().all(|ln_u| ln_u.is_finite()));
    for margin in [[128, 128], [1, 3], [77, 0], [13, 141]] {
        let shifted = framed(margin);
        for (a, b) in plain.values().iter().zip(shifted.values()) {
            assert!((a - b).abs() <= 1e-13 * (1.0 + a.abs()), "{a} and {b} at {margin:?}");
        }
    }
}

/// Heat stays on its side of a ring of walls one cell thick, however long the offsets are, and
/// comes to all of that side.
#[test]
fn walls_do_not_leak() {
    let shape = Shape::new([61, 55]).unwrap();
    let centre = [30, 27];
    let distance_sq = |index: [usize; 2]| -> usize {
        (0..2).map(|axis| index[axis].abs_diff(centre[axis]).pow(2)).sum()
    };
    // A circle whose cells touch at corners only in places.
    let is_wall = |index| (324..361).contains(&distance_sq(index));
    for condition in [20.0, 1e4] {
        let field = turning(shape, [1.0, 1.0 / condition], 0.1);
        let mask = Mask::new(Grid::from_fn(shape, |index| !is_wall(index)));
        let medium = medium::given_tensor(field).unwrap().with_walls(mask).unwrap();
        let heat = flow(&medium, [30.0, 27.0], options(400, Step::Auto), &Exec::single_threaded());
        for cell in 0..shape.cells() {
            let inside = distance_sq(shape.index(cell)) < 324;
            assert_eq!(heat.ln_temperature().values()[cell].is_finite(), inside, "cell {cell}");
        }
    }
}

/// In random fields with random walls heat comes to exactly those cells that faces connect.
#[test]
fn heat_reaches_what_faces_connect() {
    for seed in 1..25 {
        let mut random = random(seed);
        let shape = Shape::new([33, 28]).unwrap();
        let field = TensorField::from_fn(shape, |_| {
            along([random() - 0.5, random() - 0.5], [1.0, 10_f64.powf(-4.0 * random())])
        });
        let mask = Mask::new(Grid::from_fn(shape, |index| index == [5, 5] || random() > 0.35));
        let medium = medium::given_tensor(field).unwrap().with_walls(mask).unwrap();
        let heat = flow(&medium, [5.0, 5.0], options(500, Step::Auto), &Exec::single_threaded());
        let reached = medium.mask().reachable_from([shape.position([5, 5])]);
        let warm = heat.ln_temperature().map(|ln_u| ln_u.is_finite());
        assert_eq!(warm, reached, "seed {seed}");
    }
}

#[test]
fn heat_is_positive_at_condition_ten_thousand() {
    fn check<const D: usize>(size: [usize; D], iterations: usize) {
        let field = turning(Shape::new(size).unwrap(), [1.0, 1e-4], 0.0);
        let medium = medium::given_tensor(field).unwrap();
        let source = size.map(|side| (side / 3) as f64);
        let heat =
            flow(&medium, source, options(iterations, Step::Usual), &Exec::single_threaded());
        assert!(heat.ln_temperature().values().iter().all(|ln_u| ln_u.is_finite()));
        assert!(heat.ln_exposure().unwrap().values().iter().all(|ln_u| ln_u.is_finite()));
    }
    check([150, 120], 300);
    check([30, 26, 33], 100);
}

#[test]
fn heat_is_symmetric_and_conserved() {
    fn check<const D: usize>(size: [usize; D], sources: [[usize; D]; 2]) {
        let shape = Shape::new(size).unwrap();
        let medium = medium::given_tensor(turning(shape, [1.0, 0.02], 1.0)).unwrap();
        let [there, back] = [0, 1].map(|from| {
            let source = sources[from].map(|i| i as f64);
            let heat = flow(&medium, source, options(150, Step::Auto), &Exec::single_threaded());
            let total: f64 = heat.ln_temperature().values().iter().map(|ln_u| ln_u.exp()).sum();
            assert!((total - 1.0).abs() < 1e-12, "{total}");
            heat.ln_temperature()[sources[1 - from]]
        });
        assert!((there - back).abs() < 1e-12 * there.abs(), "{there} and {back}");
    }
    check([60, 50], [[12, 31], [45, 8]]);
    check([21, 18, 25], [[3, 11, 20], [17, 4, 5]]);
}

/// A tensor that is the same in all directions gives what the number does.
#[test]
fn the_unit_tensor_is_the_uniform_medium() {
    let shape = Shape::with_spacing([70, 60], [1.0, 2.0]).unwrap();
    let tensor = constant(shape, [[1.0, 0.0], [0.0, 1.0]]);
    let number = medium::uniform(shape);
    let step = |medium: &Medium<2>, step| Explicit::new(medium, options(1, step)).unwrap().step();
    assert_eq!(step(&tensor, Step::Usual), step(&number, Step::Usual));
    assert_eq!(step(&tensor, Step::Auto), step(&number, Step::Auto));
    // Exact in single precision.
    let options = options(90, Step::Fixed(0.1875));
    let logarithms = |medium: &Medium<2>| {
        let heat = flow(medium, [30.0, 20.0], options, &Exec::single_threaded());
        heat.ln_temperature().values().to_vec()
    };
    for (a, b) in logarithms(&tensor).iter().zip(logarithms(&number)) {
        assert!(*a == b || (a - b).abs() < 1e-12 * (1.0 + a.abs()), "{a} and {b}");
    }
}

/// Where a constant tensor has larger eigenvalues than 1 the usual step is as long as is safe.
#[test]
fn the_usual_step_is_stable_for_tensors_in_any_unit() {
    let shape = Shape::new([20, 20]).unwrap();
    for scale in [1e-3, 1.0, 50.0] {
        let medium = constant(shape, along([2.0, 1.0], [scale, 0.1 * scale]));
        let step = |step| Explicit::new(&medium, options(1, step)).unwrap().step();
        assert_eq!(step(Step::Usual), step(Step::Auto).min(0.2));
    }
}

/// The largest relative error of normalized distances at some exact ones.
fn largest_error<const D: usize>(heat: &Heat<D>, d: &Matrix<D>, range: Range<f64>) -> f64 {
    let (shape, map) = (*heat.shape(), normalized(heat));
    let source = heat.sources().points()[0];
    let inverse = inverse(d);
    let error = |cell: usize| {
        let centre = shape.centre(cell);
        let x: [f64; D] =
            std::array::from_fn(|axis| (centre[axis] - source[axis]) * shape.spacing()[axis]);
        let product = |i: usize| -> f64 { (0..D).map(|j| inverse[i][j] * x[j]).sum() };
        let exact = (0..D).map(|i| x[i] * product(i)).sum::<f64>().sqrt();
        range.contains(&exact).then(|| (map.field().values()[cell] / exact - 1.0).abs())
    };
    (0..shape.cells()).filter_map(error).fold(0.0, f64::max)
}

/// By Gauss-Jordan elimination, without pivots.
fn inverse<const D: usize>(matrix: &Matrix<D>) -> Matrix<D> {
    let (mut m, mut inverse) = (*matrix, [[0.0; D]; D]);
    (0..D).for_each(|i| inverse[i][i] = 1.0);
    for i in 0..D {
        let pivot = m[i][i];
        (m[i], inverse[i]) = (m[i].map(|v| v / pivot), inverse[i].map(|v| v / pivot));
        for j in (0..D).filter(|&j| j != i) {
            let times = m[j][i];
            m[j] = std::array::from_fn(|k| m[j][k] - times * m[i][k]);
            inverse[j] = std::array::from_fn(|k| inverse[j][k] - times * inverse[i][k]);
        }
    }
    inverse
}

fn constant<const D: usize>(shape: Shape<D>, matrix: Matrix<D>) -> Medium<D> {
    medium::given_tensor(TensorField::from_fn(shape, |_| matrix)).unwrap()
}

const ANGLES: [f64; 5] = [0.0, 0.3, 0.7, 1.2, 2.5];

/// As exact as in a uniform medium after as much time for the slowest direction (docs/accuracy.md).
#[test]
fn explicit_distances_in_constant_tensors() {
    let mut worst: f64 = 0.0;
    for (anisotropy, angle, spacing) in [0.5, 0.9].into_iter().flat_map(|anisotropy| {
        let both =
            move |angle| [[1.0, 1.0], [1.0, 1.6]].map(|spacing| (anisotropy, angle, spacing));
        ANGLES.into_iter().flat_map(both)
    }) {
        let shape = Shape::with_spacing([261, 261], spacing).unwrap();
        let across = (1.0 - anisotropy) / (1.0 + anisotropy);
        let d = along([f64::cos(angle), f64::sin(angle)], [1.0, across]);
        // Long enough for the slowest direction, and too short to feel the border.
        let time = (40.0 * spacing[1] * spacing[1] / across).min(760.0);
        let options = HeatOptions {
            duration: Duration::Time(time),
            step: Step::Auto,
            exposure: false,
            ..HeatOptions::default()
        };
        let heat = flow(&constant(shape, d), [130.0, 130.0], options, &Exec::new(2).unwrap());
        let error = largest_error(&heat, &d, 5.0 / across.sqrt()..70.0);
        println!("A {anisotropy}, angle {angle}, spacing {spacing:?}: {:.2} %", 100.0 * error);
        worst = worst.max(error);
    }
    assert!(worst < 0.008, "{worst}");
}

#[test]
fn implicit_distances_in_constant_tensors() {
    let exec = Exec::single_threaded();
    let mut worst: f64 = 0.0;
    for anisotropy in [0.5, 0.9] {
        for angle in ANGLES {
            for spacing in [[1.0, 1.0], [1.0, 1.6]] {
                let shape = Shape::with_spacing([201, 201], spacing).unwrap();
                let across = (1.0 - anisotropy) / (1.0 + anisotropy);
                let d = along([angle.cos(), angle.sin()], [1.0, across]);
                let medium = constant(shape, d);
                let options = ImplicitOptions { time: 16.0 / across, ..Default::default() };
                let implicit = Implicit::new(&medium, options, &exec).unwrap();
                let sources = Sources::new(&[[100.0, 100.0]], medium.mask()).unwrap();
                let heat = implicit.flow(&sources, &exec).unwrap();
                let error = largest_error(&heat, &d, 10.0 / across.sqrt()..60.0);
                println!(
                    "A {anisotropy}, angle {angle}, spacing {spacing:?}: {:.2} %",
                    100.0 * error
                );
                worst = worst.max(error);
            }
        }
    }
    assert!(worst < 0.006, "{worst}");
}

#[test]
fn distances_in_constant_tensors_of_space() {
    let exec = Exec::new(2).unwrap();
    for direction in [[1.0, 0.0, 0.0], [1.0, 0.5, -0.3], [0.2, -0.7, 1.0]] {
        let d = along(direction, [1.0, 0.2]);
        let shape = Shape::with_spacing([55, 55, 45], [1.0, 1.0, 1.25]).unwrap();
        let options = HeatOptions {
            duration: Duration::Time(40.0),
            step: Step::Auto,
            ..HeatOptions::default()
        };
        let heat = flow(&constant(shape, d), [27.0, 27.0, 22.0], options, &exec);
        let explicit = largest_error(&heat, &d, 8.0..15.0);
        let shape = Shape::with_spacing([35, 35, 29], [1.0, 1.0, 1.25]).unwrap();
        let medium = constant(shape, d);
        let options = ImplicitOptions { time: 8.0, ..ImplicitOptions::default() };
        let sources = Sources::new(&[[17.0, 17.0, 14.0]], medium.mask()).unwrap();
        let heat = Implicit::new(&medium, options, &exec).unwrap().flow(&sources, &exec).unwrap();
        let implicit = largest_error(&heat, &d, 8.0..12.0);
        println!(
            "{direction:?}: explicit {:.2} %, implicit {:.2} %",
            100.0 * explicit,
            100.0 * implicit
        );
        assert!(explicit < 0.015 && implicit < 0.05);
    }
}

/// One implicit step solves its equation, in every row and with the conductances by formula alone.
#[test]
fn implicit_heat_solves_its_equation() {
    let shape = Shape::with_spacing([31, 27], [1.0, 1.2]).unwrap();
    let mut random = random(5);
    let mask = Mask::new(Grid::from_fn(shape, |index| index == [12, 4] || random() > 0.15));
    let field = turning(shape, [1.0, 0.04], 0.4);
    let medium = medium::given_tensor(field).unwrap().with_walls(mask).unwrap();
    let options = ImplicitOptions { time: 9.0, ..ImplicitOptions::default() };
    let exec = Exec::single_threaded();
    let implicit = Implicit::new(&medium, options, &exec).unwrap();
    let sources = Sources::new(&[[12.0, 4.0]], medium.mask()).unwrap();
    let u = implicit.flow(&sources, &exec).unwrap().ln_temperature().map(|ln_u| ln_u.exp());
    let reached = medium.mask().reachable_from([shape.position([12, 4])]);
    for (cell, conductances) in dense(&medium).iter().enumerate() {
        let here = u.values()[cell];
        assert_eq!(here > 0.0, reached.values()[cell]);
        // All terms have one sign on each side.
        let couplings = || conductances.iter().zip(u.values());
        let given: f64 = couplings().map(|(c, other)| 9.0 * c * other).sum();
        let taken = here * (1.0 + couplings().map(|(c, _)| 9.0 * c).sum::<f64>());
        let given = given + if cell == shape.position([12, 4]) { 1.0 } else { 0.0 };
        assert!((given - taken).abs() <= 1e-11 * taken, "{given} and {taken} in cell {cell}");
    }
}

#[test]
fn implicit_heat_counts_its_memory() {
    let medium =
        medium::given_tensor(turning(Shape::new([90, 80]).unwrap(), [1.0, 0.02], 0.2)).unwrap();
    let exec = Exec::single_threaded();
    let with = |memory_limit| {
        let options = ImplicitOptions { memory_limit, ..ImplicitOptions::default() };
        Implicit::new(&medium, options, &exec).map(|implicit| implicit.bytes())
    };
    let bytes = with(1 << 30).unwrap();
    assert_eq!(with(bytes), Ok(bytes));
    assert!(matches!(with(bytes - 1), Err(ImplicitError::TooLarge(_))));
    assert!(matches!(with(1000), Err(ImplicitError::TooLarge(_))));
}
