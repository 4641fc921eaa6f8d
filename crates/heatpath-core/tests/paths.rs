//! Paths: where they end, how straight they are, and that they cross no wall.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(clippy::print_stdout, reason = "the figures of docs/accuracy.md")]

use heatpath_core::Exec;
use heatpath_core::grid::distance::{Eikonal, EikonalOptions, normalized};
use heatpath_core::grid::heat::{Duration, Explicit, Heat, HeatOptions, Step};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::path::{Descent, Ending, Path, PathOptions};
use heatpath_core::grid::{Grid, Mask, PointError, Shape, Sources, TensorField};
use proptest::prelude::*;

fn flow<const D: usize>(medium: &Medium<D>, sources: &[[f64; D]], options: HeatOptions) -> Heat<D> {
    let sources = Sources::new(sources, medium.mask()).unwrap();
    let explicit = Explicit::new(medium, options).unwrap();
    explicit.flow(&sources, &Exec::single_threaded()).unwrap()
}

fn paths<const D: usize>(
    medium: &Medium<D>,
    sources: &[[f64; D]],
    ends: &[[f64; D]],
    options: HeatOptions,
) -> Vec<Path<D>> {
    let heat = flow(medium, sources, options);
    let (descent, distances) = (Descent::new(&heat, medium).unwrap(), normalized(&heat));
    let path = |&end| descent.path(end, &distances, PathOptions::default()).unwrap();
    ends.iter().map(path).collect()
}

/// How far the points of a path stray from the straight line between its ends.
fn straying(path: &Path<2>) -> f64 {
    let (a, b) = (path.points[0], path.points[path.points.len() - 1]);
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let off =
        |p: &[f64; 2]| ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / length;
    path.points.iter().map(|p| off(p).abs()).fold(0.0, f64::max)
}

#[test]
fn paths_in_a_uniform_picture_are_straight_to_the_last_cell() {
    let medium = medium::uniform(Shape::new([241, 201]).unwrap());
    for source in [[120.0, 100.0], [120.5, 100.5], [119.7, 100.2]] {
        let ends: Vec<[f64; 2]> = (0..24)
            .map(|i| {
                let angle = f64::from(i) * 0.26;
                let r = if i % 2 == 0 { 60.0 } else { 7.3 };
                [source[0] + r * angle.cos(), source[1] + r * angle.sin()]
            })
            .collect();
        for (path, end) in
            paths(&medium, &[source], &ends, HeatOptions::default()).iter().zip(&ends)
        {
            assert_eq!(path.ending, Ending::Source(0));
            assert_eq!((path.points[0], path.points[path.points.len() - 1]), (*end, source));
            let exact = (end[0] - source[0]).hypot(end[1] - source[1]);
            assert!(straying(path) < 0.12, "{end:?} to {source:?}: {}", straying(path));
            assert!((path.length / exact - 1.0).abs() < 0.002, "{} for {exact}", path.length);
            assert!((path.distance / exact - 1.0).abs() < 0.01, "{} for {exact}", path.distance);
        }
    }
}

#[test]
fn paths_in_space_are_straight_and_measured_in_physical_units() {
    let shape = Shape::with_spacing([61, 61, 31], [0.5, 0.5, 1.0]).unwrap();
    let medium = medium::uniform(shape);
    let options = HeatOptions { step: Step::Auto, ..HeatOptions::default() };
    let (source, end) = ([30.0, 30.0, 15.0], [50.0, 12.0, 22.0]);
    let path = &paths(&medium, &[source], &[end], options)[0];
    let exact = shape.physical_distance(source, end);
    assert_eq!(path.ending, Ending::Source(0));
    assert!((path.physical_length / exact - 1.0).abs() < 0.005, "{}", path.physical_length);
    assert!((path.distance / exact - 1.0).abs() < 0.03, "{} for {exact}", path.distance);
    let pixels = (20.0_f64.powi(2) + 18.0_f64.powi(2) + 7.0_f64.powi(2)).sqrt();
    assert!((path.length / pixels - 1.0).abs() < 0.005);
}

/// A broad bright region beside a thin bright line: the warmest point moves from the line into the
/// region, and a descent of the temperature would end there.
fn lake_beside_a_river() -> Grid<f64, 2> {
    Grid::from_fn(Shape::new([120, 90]).unwrap(), |[x, y]| {
        let (dx, dy) = (x as f64 - 40.0, y as f64 - 30.0);
        if dx.hypot(dy) < 22.0 || (48..=50).contains(&y) { 1.0 } else { 0.2 }
    })
}

#[test]
fn paths_end_at_the_source_although_the_warmest_point_drifts_away() {
    let image = lake_beside_a_river();
    let source = [21.0, 30.0];
    let medium = medium::combined(&image, &[1.0], Default::default(), Default::default()).unwrap();
    let options = HeatOptions { duration: Duration::Iterations(6000), ..HeatOptions::default() };
    let heat = flow(&medium, &[source], options);
    let warmest = (0..image.shape().cells())
        .max_by(|&a, &b| {
            let u = heat.ln_temperature().values();
            u[a].total_cmp(&u[b])
        })
        .map(|cell| image.shape().centre(cell))
        .unwrap();
    let drift = (warmest[0] - source[0]).hypot(warmest[1] - source[1]);
    assert!(drift > 5.0, "the warmest point is at {warmest:?}: this picture tests nothing");
    let ends: Vec<[f64; 2]> =
        (0..image.shape().cells()).step_by(61).map(|cell| image.shape().centre(cell)).collect();
    for path in paths(&medium, &[source], &ends, options) {
        assert_eq!(path.ending, Ending::Source(0), "from {:?}", path.points[0]);
        assert_eq!(path.points[path.points.len() - 1], source);
    }
}

/// The proof of the documentation, in numbers: each cell has a neighbour with more exposure.
#[test]
fn exposure_has_no_maximum_but_the_sources() {
    let image = lake_beside_a_river();
    let medium = medium::combined(&image, &[1.0], Default::default(), Default::default()).unwrap();
    let heat = flow(&medium, &[[40.0, 50.0], [100.0, 10.0]], HeatOptions::default());
    let exposure = heat.ln_exposure().unwrap().values();
    let peaks: Vec<usize> = (0..exposure.len())
        .filter(|&cell| image.shape().neighbours(cell).all(|next| exposure[next] <= exposure[cell]))
        .collect();
    let source_cells = [[40, 50], [100, 10]].map(|index| image.shape().position(index));
    assert!(peaks.iter().all(|peak| source_cells.contains(peak)), "{peaks:?}");
}

#[test]
fn the_cost_of_a_polyline() {
    let shape = Shape::with_spacing([40, 30], [0.5, 2.0]).unwrap();
    let line = [[3.0, 4.0], [15.0, 4.0], [30.0, 20.0]];
    let straight: f64 = line.windows(2).map(|p| shape.physical_distance(p[0], p[1])).sum();
    assert!((medium::uniform(shape).cost(&line) - straight).abs() < 1e-12);
    assert_eq!(medium::uniform(shape).cost(&line[..1]), 0.0);
    // The squared speed grows linearly: the integral of 0.5 dx / sqrt(1 + x).
    let speed_sq = Grid::from_fn(shape, |[x, _]| 1.0 + x as f64);
    let walls = Grid::from_fn(shape, |[x, y]| (x, y) != (20, 20));
    let rising = medium::given(speed_sq, Form::Pointwise).unwrap();
    let rising = rising.with_walls(Mask::new(walls)).unwrap();
    let (cost, exact) = (rising.cost(&[[3.2, 7.0], [30.7, 7.0]]), 31.7_f64.sqrt() - 4.2_f64.sqrt());
    assert!((cost / exact - 1.0).abs() < 1e-4, "{cost} for {exact}");
    assert_eq!(rising.cost(&[[20.0, 15.0], [20.0, 25.0]]), f64::INFINITY);
    // A tensor with the inverse [[2, 1], [1, 3]].
    let matrix = [[0.6, -0.2], [-0.2, 0.4]];
    let tensor = medium::given_tensor(TensorField::from_fn(shape, |_| matrix)).unwrap();
    let ([dx, dy], cost) = ([5.0, 8.0], tensor.cost(&[[10.0, 9.0], [20.0, 13.0]]));
    let exact = f64::sqrt(2.0 * dx * dx + 2.0 * dx * dy + 3.0 * dy * dy);
    assert!((cost / exact - 1.0).abs() < 1e-12, "{cost} for {exact}");
}

/// The shortest path leads along a serpentine of 280 pixels between walls of 9 slow pixels. Heat of few
/// steps cannot follow it, and heat of many is lost to the walls, which stay cold.
#[test]
fn a_short_cut_costs_more_than_its_distance() {
    let serpentine = Grid::from_fn(Shape::new([61, 61]).unwrap(), |[x, y]| {
        let bend = if y % 24 < 12 { 58..61 } else { 0..3 };
        if y % 12 < 3 || bend.contains(&x) { 1.0 } else { 1e-4 }
    });
    let medium = medium::given(serpentine, Form::Pointwise).unwrap();
    let (source, end) = ([1.0, 1.0], [1.0, 49.0]);
    for steps in [122, 4000] {
        let options =
            HeatOptions { duration: Duration::Iterations(steps), ..HeatOptions::default() };
        let path = &paths(&medium, &[source], &[end], options)[0];
        assert_eq!(path.ending, Ending::Source(0));
        let times = path.cost / path.distance;
        println!("{steps} steps: the short cut costs {times:.1} times its distance");
        assert!(path.length < 60.0 && (2.5..13.5).contains(&times), "{path:?}");
    }
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    let exec = Exec::single_threaded();
    let eikonal = Eikonal::new(&medium, &exec).unwrap();
    let distances = eikonal.distance(&sources, &EikonalOptions::default(), &exec).unwrap();
    let descent = Descent::of_distances(&distances, &sources, &medium);
    let path = descent.path(end, &distances, PathOptions::default()).unwrap();
    assert!(path.length > 250.0 && (path.cost / path.distance - 1.0).abs() < 0.05, "{path:?}");
}

#[test]
fn a_path_says_why_it_does_not_reach_a_source() {
    let shape = Shape::new([40, 30]).unwrap();
    let walls = Grid::from_fn(shape, |[x, _]| x != 20);
    let medium = medium::uniform(shape).with_walls(Mask::new(walls)).unwrap();
    let options = HeatOptions { duration: Duration::Iterations(10), ..HeatOptions::default() };
    let heat = flow(&medium, &[[5.0, 5.0]], options);
    let (descent, distances) = (Descent::new(&heat, &medium).unwrap(), normalized(&heat));
    let ending = |end, options| descent.path(end, &distances, options).map(|path| path.ending);
    let usual = PathOptions::default();
    assert_eq!(ending([30.0, 5.0], usual), Ok(Ending::Unreachable));
    assert_eq!(ending([18.0, 25.0], usual), Ok(Ending::NotReached));
    assert_eq!(ending([9.0, 9.0], usual), Ok(Ending::Source(0)));
    assert_eq!(ending([5.0, 5.0], usual), Ok(Ending::Source(0)));
    let short = PathOptions { largest_steps: Some(3), ..usual };
    assert_eq!(ending([9.0, 9.0], short), Ok(Ending::StepLimit));
    assert!(matches!(ending([20.0, 5.0], usual), Err(PointError::InsideWall { .. })));
    assert!(matches!(ending([40.0, 5.0], usual), Err(PointError::Outside { .. })));
}

#[test]
fn each_end_finds_the_nearer_source() {
    let medium = medium::uniform(Shape::new([160, 120]).unwrap());
    let sources = [[40.0, 60.0], [120.0, 60.0]];
    let found = paths(&medium, &sources, &[[50.0, 50.0], [115.0, 73.0]], HeatOptions::default());
    assert_eq!(found[0].ending, Ending::Source(0));
    assert_eq!(found[1].ending, Ending::Source(1));
    assert!((found[0].distance - 200.0_f64.sqrt()).abs() < 0.2);
    assert!((found[1].distance - 194.0_f64.sqrt()).abs() < 0.2);
}

/// Sources in media of different speed: balanced, both have distance zero.
#[test]
fn balanced_sources_are_equally_near() {
    let shape = Shape::new([160, 60]).unwrap();
    let field = Grid::from_fn(shape, |[x, _]| if x < 80 { 1.0 } else { 0.1 });
    let medium = medium::given(field, Form::Pointwise).unwrap();
    let sources = Sources::new(&[[30.0, 30.0], [130.0, 30.0]], medium.mask()).unwrap();
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let exec = Exec::single_threaded();
    let equal = normalized(&explicit.flow(&sources, &exec).unwrap());
    assert!(equal.at([30.0, 30.0]) > 10.0, "equal amounts leave the fast source cold");
    let balanced = normalized(&explicit.flow_balanced(&sources, &exec).unwrap());
    for (source, slowness) in [([30.0, 30.0], 1.0), ([130.0, 30.0], 10.0_f64.sqrt())] {
        assert!(balanced.at(source) < 0.5, "{source:?}: {}", balanced.at(source));
        let beside = balanced.at([source[0] + 9.0, source[1]]);
        assert!((beside / (9.0 * slowness) - 1.0).abs() < 0.03, "{source:?}: {beside}");
    }
}

fn assert_walls_hold(path: &Path<2>, mask: &Mask<2>) {
    for pair in path.points.windows(2) {
        for i in 0..=50 {
            let s = f64::from(i) / 50.0;
            let point: [f64; 2] =
                std::array::from_fn(|a| pair[0][a] + s * (pair[1][a] - pair[0][a]));
            assert!(mask.is_open_at(point), "{point:?} lies in a wall");
        }
    }
}

#[test]
fn a_maze_of_one_cell_corridors() {
    // A spiral: walls on every second ring, each with one gap.
    let n = 41;
    let shape = Shape::new([n, n]).unwrap();
    let open = Grid::from_fn(shape, |[x, y]| {
        let ring = x.min(y).min(n - 1 - x).min(n - 1 - y);
        let gap = if ring % 4 == 1 { x == n / 2 && y < n / 2 } else { x == n / 2 && y > n / 2 };
        ring % 2 == 0 || gap
    });
    let medium = medium::uniform(shape).with_walls(Mask::new(open)).unwrap();
    let options = HeatOptions { duration: Duration::Iterations(1500), ..HeatOptions::default() };
    let ends = [[0.0, 0.0], [40.0, 40.0], [2.3, 20.0]];
    for path in paths(&medium, &[[20.0, 20.0]], &ends, options) {
        assert_eq!(path.ending, Ending::Source(0));
        assert_walls_hold(&path, medium.mask());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]

    /// Any walls, any medium, any points: a path ends at its source exactly when one can be
    /// reached, and crosses no wall.
    #[test]
    fn walls_are_never_crossed(
        width in 3_usize..40, height in 3_usize..40, seed: u64, density in 0.0..0.5_f64,
        contrast in 0.0..6.0_f64, sx in 0.0..1.0_f64, sy in 0.0..1.0_f64, ex in 0.0..1.0_f64, ey in 0.0..1.0_f64,
    ) {
        let shape = Shape::new([width, height]).unwrap();
        let mut state = seed | 1;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let field = Grid::from_fn(shape, |_| 10_f64.powf(-contrast * random()));
        let inside = |u: f64, n: usize| u * n as f64 - 0.5;
        let (source, end) = ([inside(sx, width), inside(sy, height)], [inside(ex, width), inside(ey, height)]);
        let (s, e) = (shape.cell_at(source), shape.cell_at(end));
        let mask = Mask::new(Grid::from_fn(shape, |i| i == s || i == e || random() > density));
        let connected = mask.reachable_from([shape.position(s)])[e];
        let medium = medium::given(field, Form::Divergence).unwrap().with_walls(mask).unwrap();
        let options =
            HeatOptions { duration: Duration::Iterations(width * height), ..HeatOptions::default() };
        let path = &paths(&medium, &[source], &[end], options)[0];
        let expected = if connected { Ending::Source(0) } else { Ending::Unreachable };
        prop_assert_eq!(path.ending, expected);
        assert_walls_hold(path, medium.mask());
    }
}
