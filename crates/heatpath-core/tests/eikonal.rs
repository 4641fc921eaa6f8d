//! The exact distance against closed forms.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(clippy::print_stdout, reason = "the figures of docs/accuracy.md")]

mod support;

use heatpath_core::Exec;
use heatpath_core::grid::distance::{Eikonal, EikonalOptions, NOT_REACHED, Order};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::path::{Descent, Ending, PathOptions};
use heatpath_core::grid::{Grid, Mask, Matrix, Shape, Sources, TensorField};
use std::f64::consts::PI;
use support::{euclidean, march};

/// A domain: cells of one size from the centre of the first one.
#[derive(Clone, Copy)]
struct Domain<const D: usize> {
    shape: Shape<D>,
    low: [f64; D],
    h: f64,
}

impl<const D: usize> Domain<D> {
    fn new(size: [usize; D], h: f64, low: [f64; D]) -> Self {
        Self { shape: Shape::with_spacing(size, [h; D]).unwrap(), low, h }
    }

    fn at(&self, index: [usize; D]) -> [f64; D] {
        std::array::from_fn(|axis| self.low[axis] + self.h * index[axis] as f64)
    }

    /// The medium of a cost per length.
    fn isotropic(&self, cost: impl Fn([f64; D]) -> f64) -> Medium<D> {
        let field = Grid::from_fn(self.shape, |index| cost(self.at(index)).powi(-2));
        medium::given(field, Form::Pointwise).unwrap()
    }

    /// The largest and the mean error of the distance from `source`, where `exact` has an answer.
    fn errors(
        &self,
        medium: &Medium<D>,
        source: [f64; D],
        order: Order,
        exact: impl Fn([f64; D]) -> Option<f64>,
    ) -> (f64, f64) {
        let point = std::array::from_fn(|axis| (source[axis] - self.low[axis]) / self.h);
        let distances = march(medium, &[point], &EikonalOptions { order, ..Default::default() });
        let errors: Vec<f64> = (0..self.shape.cells())
            .filter_map(|cell| Some((cell, exact(self.at(self.shape.index(cell)))?)))
            .map(|(cell, exact)| (distances.values()[cell] - exact).abs())
            .collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        (errors.into_iter().fold(0.0, f64::max), mean)
    }
}

/// Prints a row of the table in docs/accuracy.md.
fn print(name: &str, cells: usize, (max, mean): (f64, f64)) {
    println!("| {name} | {cells} | {max:.1e} | {mean:.1e} |");
}

/// The Poincaré half-plane: cost 1/y on [-1/2, 1/2] x [1, 2].
fn half_plane(n: usize, source: [f64; 2], order: Order) -> (f64, f64) {
    let domain = Domain::new([n, n], 1.0 / (n - 1) as f64, [-0.5, 1.0]);
    let medium = domain.isotropic(|[_, y]| 1.0 / y);
    domain.errors(&medium, source, order, |p| {
        let (across, straight) = (euclidean(p, [source[0], -source[1]]), euclidean(p, source));
        Some(((across + straight) / (across - straight)).ln())
    })
}

#[test]
fn the_half_plane() {
    let mut last = f64::INFINITY;
    for n in [50, 100, 200, 400] {
        let errors = half_plane(n, [0.0, 1.5], Order::Second);
        print("half-plane, source off the grid", n, errors);
        assert!(errors.1 < last / 3.0, "second order: {} after {last}", errors.1);
        last = errors.1;
    }
    let errors = half_plane(100, [0.0, 1.5], Order::Second);
    assert!(errors.0 < 1.5e-4 && errors.1 < 1.2e-5, "{errors:?}");
    let errors = half_plane(101, [0.0, 1.5], Order::Second);
    print("half-plane, source on the grid", 101, errors);
    assert!(errors.0 < 3e-5, "{errors:?}");
    let errors = half_plane(100, [0.013, 1.307], Order::First);
    print("half-plane, first order", 100, errors);
    assert!(errors.0 < 5e-3, "{errors:?}");
}

/// Treister and Haber's medium of a constant gradient of the velocity, on [0, 4] x [0, 8].
fn velocity_gradient(h: f64) -> (f64, f64) {
    let domain = Domain::new([(4.0 / h) as usize + 1, (8.0 / h) as usize + 1], h, [0.0; 2]);
    let (gradient, slowness, source) = (1.0, 2.0, [0.0, 4.0]);
    let cost = |[x, _]: [f64; 2]| 1.0 / (1.0 / slowness + gradient * x);
    domain.errors(&domain.isotropic(cost), source, Order::Second, |p| {
        let r_sq = euclidean(p, source).powi(2);
        Some((1.0 + 0.5 * slowness * gradient * gradient * cost(p) * r_sq).acosh() / gradient)
    })
}

/// Their medium of a constant gradient of the squared slowness.
fn slowness_gradient(h: f64) -> (f64, f64) {
    let domain = Domain::new([(4.0 / h) as usize + 1, (8.0 / h) as usize + 1], h, [0.0; 2]);
    let (a, slowness, source) = (-0.4, 2.0_f64, [0.0, 4.0]);
    let medium = domain.isotropic(|[x, _]| (slowness * slowness + 2.0 * a * x).sqrt());
    domain.errors(&medium, source, Order::Second, |p| {
        let (s, r_sq) = (slowness * slowness + a * p[0], euclidean(p, source).powi(2));
        let sigma = (2.0 * r_sq / (s + (s * s - a * a * r_sq).sqrt())).sqrt();
        Some(s * sigma - a * a * sigma.powi(3) / 6.0)
    })
}

#[test]
fn constant_gradients() {
    for (h, largest) in [(0.05, 2.2e-3), (0.025, 5.2e-4), (0.0125, 1.7e-4)] {
        let errors = velocity_gradient(h);
        print("gradient of the velocity", (4.0 / h) as usize, errors);
        assert!(errors.0 < largest, "{errors:?}");
    }
    for (h, largest) in [(0.05, 2.6e-4), (0.025, 9.6e-5), (0.0125, 3.5e-5)] {
        let errors = slowness_gradient(h);
        print("gradient of the squared slowness", (4.0 / h) as usize, errors);
        assert!(errors.0 < largest, "{errors:?}");
    }
}

fn volume(n: usize, source: [f64; 3]) -> (f64, f64) {
    let domain = Domain::new([n, n, n], 1.0 / (n - 1) as f64, [0.0; 3]);
    let velocity = |p: [f64; 3]| 0.5 + p[0] + 0.5 * p[2];
    let medium = domain.isotropic(|p| 1.0 / velocity(p));
    domain.errors(&medium, source, Order::Second, |p| {
        let growth = 1.25 * euclidean(p, source).powi(2) / (2.0 * velocity(p) * velocity(source));
        Some((1.0 + growth).acosh() / 1.25_f64.sqrt())
    })
}

#[test]
fn volumes() {
    for (n, on_grid, off_grid) in [(41, 3e-4, 1.2e-3), (81, 1e-4, 2.5e-4)] {
        let errors = volume(n, [0.5; 3]);
        print("gradient of the velocity, volume", n, errors);
        assert!(errors.0 < on_grid, "{errors:?}");
        let errors = volume(n, [0.51, 0.48, 0.37]);
        print("the same, source off the grid", n, errors);
        assert!(errors.0 < off_grid, "{errors:?}");
    }
}

/// The plane bent by `(x, y + sin(pi x) / 2)`: lengths are those of diag(1/4, 1) in the image.
fn bent(n: usize) -> (f64, f64) {
    let h = 2.0 / n as f64;
    let domain = Domain::new([n, n / 2], h, [-1.0 + 0.5 * h, -0.5 + 0.5 * h]);
    let diffusion = TensorField::from_fn(domain.shape, |index| {
        // The metric is [[1/4 + c^2, c], [c, 1]], and its determinant 1/4.
        let c = 0.5 * PI * (PI * domain.at(index)[0]).cos();
        [[4.0, -4.0 * c], [-4.0 * c, 1.0 + 4.0 * c * c]]
    });
    let medium = medium::given_tensor(diffusion).unwrap();
    domain.errors(&medium, [0.0; 2], Order::Second, |[x, y]| {
        // Elsewhere the straight line of the image leaves the domain.
        ((x - y).abs() < 1.0).then(|| (0.5 * x).hypot(y + 0.5 * (PI * x).sin()))
    })
}

#[test]
fn a_riemannian_metric() {
    for (n, largest, mean) in [(100, 2.4e-3, 2.4e-4), (200, 6.5e-4, 6e-5), (400, 2.5e-4, 1.6e-5)] {
        let errors = bent(n);
        print("bent plane, Riemannian", n, errors);
        assert!(errors.0 < largest && errors.1 < mean, "{n}: {errors:?}");
    }
}

#[test]
fn constant_media_are_exact() {
    let shape = Shape::with_spacing([60, 50], [0.7, 1.3]).unwrap();
    let source = [21.3, 30.8];
    let field = march(&medium::uniform(shape), &[source], &EikonalOptions::default());
    for cell in 0..shape.cells() {
        let exact = shape.physical_distance(source, shape.centre(cell));
        assert!((field.values()[cell] - exact).abs() < 1e-9 * (1.0 + exact));
    }
    let shape = Shape::with_spacing([20, 24, 18], [1.0, 1.0, 2.5]).unwrap();
    let source = [4.2, 11.0, 7.6];
    let field = march(&medium::uniform(shape), &[source], &EikonalOptions::default());
    for cell in 0..shape.cells() {
        let exact = shape.physical_distance(source, shape.centre(cell));
        assert!((field.values()[cell] - exact).abs() < 1e-9 * (1.0 + exact));
    }
}

/// `sqrt(x' M x)` in the metric M of a constant diffusion tensor, away from the corners, where an
/// offset may leave the grid on either side.
fn constant_tensor<const D: usize>(shape: Shape<D>, diffusion: Matrix<D>, metric: Matrix<D>) {
    let source = shape.size().map(|n| 0.4 * n as f64 + 0.3);
    let medium = medium::given_tensor(TensorField::from_fn(shape, |_| diffusion)).unwrap();
    let field = march(&medium, &[source], &EikonalOptions::default());
    for cell in 0..shape.cells() {
        let (index, spacing) = (shape.index(cell), shape.spacing());
        let inside = (0..D).all(|axis| index[axis] > 7 && index[axis] + 8 < shape.size()[axis]);
        let d: [f64; D] =
            std::array::from_fn(|axis| (index[axis] as f64 - source[axis]) * spacing[axis]);
        let squares = (0..D).flat_map(|i| (0..D).map(move |j| d[i] * metric[i][j] * d[j]));
        let (exact, value) = (squares.sum::<f64>().sqrt(), field.values()[cell]);
        let tolerance = if inside { 1e-9 } else { 0.1 };
        assert!((value - exact).abs() < tolerance * (1.0 + exact), "{index:?}: {value} {exact}");
    }
}

#[test]
fn constant_tensors_are_exact() {
    let shape = Shape::with_spacing([60, 50], [1.0, 0.8]).unwrap();
    // det = 0.19
    let diffusion = [[1.0, 0.9], [0.9, 1.0]];
    constant_tensor(shape, diffusion, [[1.0 / 0.19, -0.9 / 0.19], [-0.9 / 0.19, 1.0 / 0.19]]);
    let shape = Shape::with_spacing([24, 26, 22], [1.0, 1.0, 1.5]).unwrap();
    let diffusion = [[1.0, 0.6, 0.0], [0.6, 1.0, 0.0], [0.0, 0.0, 0.25]];
    let [a, b] = [1.0 / 0.64, -0.6 / 0.64];
    constant_tensor(shape, diffusion, [[a, b, 0.0], [b, a, 0.0], [0.0, 0.0, 4.0]]);
}

#[test]
fn several_sources_do_not_fold() {
    // Every cell of the border is a source: the distance is that from the border.
    let shape = Shape::new([41, 33]).unwrap();
    let border = (0..shape.cells()).map(|cell| shape.index(cell));
    let border: Vec<[f64; 2]> = border
        .filter(|&[x, y]| x == 0 || y == 0 || x == 40 || y == 32)
        .map(|index| index.map(|i| i as f64))
        .collect();
    let field = march(&medium::uniform(shape), &border, &EikonalOptions::default());
    for cell in 0..shape.cells() {
        let [x, y] = shape.index(cell);
        let exact = x.min(y).min(40 - x).min(32 - y) as f64;
        assert!((field.values()[cell] - exact).abs() < 0.05, "{x},{y}: {}", field.values()[cell]);
    }
}

#[test]
fn labels_and_initial_distances() {
    let shape = Shape::new([80, 40]).unwrap();
    let medium = medium::uniform(shape);
    let exec = Exec::single_threaded();
    let eikonal = Eikonal::new(&medium, &exec).unwrap();
    let points = [[20.0, 20.0], [60.0, 20.0], [62.0, 20.0]];
    let sources = Sources::new(&points, medium.mask()).unwrap();
    let initial = vec![0.0, 10.0, 20.0];
    let options = EikonalOptions { initial: initial.clone(), ..Default::default() };
    let (distances, nearest) = eikonal.distance_and_nearest(&sources, &options, &exec).unwrap();
    for cell in 0..shape.cells() {
        let centre = shape.centre(cell);
        let each = |source: usize| initial[source] + euclidean(centre, points[source]);
        // The third source is farther from the second than its own distance.
        let exact = each(0).min(each(1));
        let value = distances.field().values()[cell];
        let seam = (each(0) - each(1)).abs() < 1.5;
        assert!((value - exact).abs() < if seam { 0.2 } else { 3e-4 }, "{centre:?}: {value}");
        if !seam {
            assert_eq!(nearest.values()[cell], Some(usize::from(each(1) < each(0))), "{centre:?}");
        }
    }
}

/// From one source the cells of a picture are solved for two at a time, from several one by one. A source
/// that is passed over makes the difference.
#[test]
fn cells_in_pairs_have_the_distances_of_single_cells() {
    let shape = Shape::with_spacing([83, 71], [1.0, 1.3]).unwrap();
    let rough = |index: [usize; 2]| 0.05 + ((index[0] * 7919 + index[1] * 104_729) % 997) as f64;
    let smooth = |index: [usize; 2]| 0.2 + (0.07 * index[0] as f64).sin().powi(2);
    let open = |index: [usize; 2]| index[0] % 12 != 5 || index[1] % 60 == 3 * index[0] % 7;
    let given = |speed_sq: &dyn Fn([usize; 2]) -> f64| {
        medium::given(Grid::from_fn(shape, speed_sq), Form::Pointwise).unwrap()
    };
    let walls = Mask::new(Grid::from_fn(shape, open));
    for medium in [given(&rough), given(&smooth), given(&smooth).with_walls(walls).unwrap()] {
        let source = [40.3, 22.0];
        let alone = march(&medium, &[source], &EikonalOptions::default());
        let options = EikonalOptions { initial: vec![0.0, 1e6], ..Default::default() };
        let with_another = march(&medium, &[source, [10.0, 60.0]], &options);
        assert!(alone.values().iter().any(|distance| *distance < 1e6));
        assert_eq!(alone, with_another);
    }
}

#[test]
fn a_march_ends_early() {
    let domain = Domain::new([90, 70], 1.0, [0.0; 2]);
    let medium = domain.isotropic(|[x, y]| 1.5 + (0.3 * x).sin() * (0.2 * y).cos());
    let source = [30.2, 40.0];
    let all = march(&medium, &[source], &EikonalOptions::default());
    let near = march(&medium, &[source], &EikonalOptions { farthest: 25.0, ..Default::default() });
    let targets = vec![[50.5, 20.25], [10.0, 60.0]];
    let some = march(
        &medium,
        &[source],
        &EikonalOptions { targets: targets.clone(), ..Default::default() },
    );
    let farthest_target = targets.iter().map(|&target| all.sample(target)).fold(0.0, f64::max);
    for (cell, &distance) in all.values().iter().enumerate() {
        assert_eq!(near.values()[cell], if distance <= 25.0 { distance } else { NOT_REACHED });
        assert!(some.values()[cell] == distance || distance > farthest_target);
    }
    assert!(some.values().contains(&NOT_REACHED));
    targets.iter().for_each(|&target| assert_eq!(some.sample(target), all.sample(target)));
}

#[test]
fn a_path_is_a_cycloid() {
    // The curve of quickest descent: cost 1 / sqrt(z) from one cusp almost to the next.
    let h = 2.0 * PI / 300.0;
    let domain = Domain::new([300, 110], h, [0.5 * h, 0.5 * h]);
    let medium = domain.isotropic(|[_, z]| 1.0 / z.sqrt());
    let cycloid = |t: f64| [t - t.sin(), 1.0 - t.cos()];
    let pixel = |p: [f64; 2]| p.map(|x| x / h - 0.5);
    let sources = Sources::new(&[pixel(cycloid(0.2))], medium.mask()).unwrap();
    let exec = Exec::single_threaded();
    let eikonal = Eikonal::new(&medium, &exec).unwrap();
    let distances = eikonal.distance(&sources, &EikonalOptions::default(), &exec).unwrap();
    let descent = Descent::of_distances(&distances, &sources, &medium);
    let end = pixel(cycloid(2.0 * PI - 0.2));
    let path = descent.path(end, &distances, PathOptions::default()).unwrap();
    assert_eq!(path.ending, Ending::Source(0));
    let exact: Vec<[f64; 2]> =
        (0..20_000).map(|i| pixel(cycloid(0.15 + 2.98e-4 * PI * f64::from(i) / 3.0))).collect();
    let off = |&p: &[f64; 2]| exact.iter().map(|&q| euclidean(p, q)).fold(f64::INFINITY, f64::min);
    let strayed: Vec<f64> = path.points.iter().map(off).collect();
    let mean = strayed.iter().sum::<f64>() / strayed.len() as f64;
    let most = strayed.into_iter().fold(0.0, f64::max);
    println!("a cycloid of 300 cells: the path strays by {mean:.3} cells, at most {most:.3}");
    // Along the cycloid it takes as long as the parameter grows, times sqrt 2.
    let exact = 2_f64.sqrt() * (2.0 * PI - 0.4);
    println!("its length {:.5}, exactly {exact:.5}", path.distance);
    assert!(mean < 0.2 && most < 0.6, "{mean} {most}");
    assert!((path.distance / exact - 1.0).abs() < 5e-3, "{} {exact}", path.distance);
}

#[test]
fn paths_arrive_at_any_anisotropy() {
    // Offsets are as long as the picture, and few cells have a lower neighbour.
    let shape = Shape::new([70, 60]).unwrap();
    for ratio in [1e-2, 1e-4, 1e-8, 1e-12] {
        let (sin, cos) = 0.3_f64.sin_cos();
        let xy = (1.0 - ratio) * sin * cos;
        let diffusion = [[cos * cos + ratio * sin * sin, xy], [xy, sin * sin + ratio * cos * cos]];
        let medium = medium::given_tensor(TensorField::from_fn(shape, |_| diffusion)).unwrap();
        let exec = Exec::single_threaded();
        let sources = Sources::new(&[[5.0, 50.0]], medium.mask()).unwrap();
        let eikonal = Eikonal::new(&medium, &exec).unwrap();
        let distances = eikonal.distance(&sources, &EikonalOptions::default(), &exec).unwrap();
        let descent = Descent::of_distances(&distances, &sources, &medium);
        for end in [[60.0, 5.0], [69.0, 59.0], [0.0, 0.0], [33.3, 30.7]] {
            let path = descent.path(end, &distances, PathOptions::default()).unwrap();
            assert_eq!(path.ending, Ending::Source(0), "{ratio:e} from {end:?}");
        }
    }
}
