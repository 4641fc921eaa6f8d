//! The figures that show paths: 5, 6, 7, 9 and 10.

use super::panels::dot;
use super::scenes::{
    CENTRE, CURVE_ENDS, ROAD_ENDS, TUBE, U_ENDS, around, clean_curve, gaussian, noisy_curve,
    off_the_noisy_curve, road, road_points, spiral, spiral_ends, u_tube,
};
use super::{alpha, assert_figure, flow_with, panel, picture_panel};
use heatpath_core::Exec;
use heatpath_core::grid::distance::{DistanceMap, Eikonal, EikonalOptions, Order, normalized};
use heatpath_core::grid::filter::Polarity;
use heatpath_core::grid::heat::{Duration, HeatOptions, Step};
use heatpath_core::grid::medium::{self, Directions, Medium, TensorOptions};
use heatpath_core::grid::path::{Descent, Ending, Path, PathOptions};
use heatpath_core::grid::{Grid, Sources};
use heatpath_io::colour::viridis;
use image::{Rgb, RgbImage};

/// The path by heat that has flowed for some automatic steps, and its distances.
fn by_heat(
    medium: &Medium<2>,
    [source, end]: [[f64; 2]; 2],
    steps: usize,
) -> (Path<2>, DistanceMap<2>) {
    let duration = Duration::Iterations(steps);
    let heat =
        flow_with(medium, source, HeatOptions { duration, step: Step::Auto, ..Default::default() });
    let distances = normalized(&heat);
    let path = Descent::new(&heat, medium).unwrap().path(end, &distances, PathOptions::default());
    (arrived(path.unwrap()), distances)
}

fn by_fast_marching(medium: &Medium<2>, [source, end]: [[f64; 2]; 2], order: Order) -> Path<2> {
    let (exec, options) = (Exec::new(0).unwrap(), EikonalOptions { order, ..Default::default() });
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    let distances =
        Eikonal::new(medium, &exec).unwrap().distance(&sources, &options, &exec).unwrap();
    let descent = Descent::of_distances(&distances, &sources, medium);
    arrived(descent.path(end, &distances, PathOptions::default()).unwrap())
}

fn arrived(path: Path<2>) -> Path<2> {
    assert_eq!(path.ending, Ending::Source(0));
    path
}

/// The mean of a quantity along a path.
fn mean_along(path: &Path<2>, quantity: impl Fn([f64; 2]) -> f64) -> f64 {
    let parts = path.points.windows(2).map(|pair| {
        let middle = std::array::from_fn(|axis| 0.5 * (pair[0][axis] + pair[1][axis]));
        (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]) * quantity(middle)
    });
    parts.sum::<f64>() / path.length
}

fn anisotropic(image: &Grid<f64, 2>, directions: Directions, anisotropy: f64) -> Medium<2> {
    let options = TensorOptions { directions, anisotropy, fading: false };
    medium::tensor(image, options, &Exec::new(0).unwrap()).unwrap()
}

// === Drawing

/// Every second pixel of a grey picture with two paths, the first in blue and the second in red.
fn paths_panel(image: &Grid<f64, 2>, paths: [&Path<2>; 2]) -> RgbImage {
    let mut drawn = picture_panel(image, &[]);
    let half = |point: [f64; 2]| point.map(|part| 0.5 * part);
    for (path, colour) in paths.into_iter().zip([[0, 120, 255], [230, 20, 30]]) {
        path.points.iter().for_each(|&point| dot(&mut drawn, half(point), 1, colour));
    }
    let ends = [paths[0].points[0], paths[0].points[paths[0].points.len() - 1]];
    ends.into_iter().for_each(|end| dot(&mut drawn, half(end), 5, [255, 200, 0]));
    drawn
}

/// 50 x 50 pixels of a grey picture from `corner`, three times as large, with a path in red.
fn detail_panel(image: &Grid<f64, 2>, path: &Path<2>, corner: [u32; 2]) -> RgbImage {
    let mut drawn = RgbImage::from_fn(150, 150, |x, y| {
        let cell = [corner[0] + x / 3, corner[1] + y / 3].map(|part| part as usize);
        Rgb([(255.0 * image[cell]).round() as u8; 3])
    });
    for point in &path.points {
        let pixel = [0, 1].map(|axis| 3.0 * (point[axis] - f64::from(corner[axis])) + 1.0);
        dot(&mut drawn, pixel, 2, [230, 20, 30]);
    }
    drawn
}

/// Distances from yellow (0) to dark blue, and a black line every twelfth of the largest.
fn distance_panel(distances: &DistanceMap<2>) -> RgbImage {
    let largest = distances.reached().fold(0.0, f64::max);
    panel(
        distances.field(),
        |distance| match 12.0 * distance / largest {
            level if level.fract() < 0.1 => [0; 3],
            level => viridis(1.0 - level / 12.0),
        },
        &[],
    )
}

// === The figures

/// Figure 5: as the anisotropy grows, the path goes from a straight line to the half circle.
///
/// Around the middle the metric is that of a cone: `dr^2 / l1 + r^2 da^2`, whose shortest paths are
/// straight once it is unrolled, `r(a) = r0 cos(sqrt(l1) w / 2) / cos(sqrt(l1) a)` with w the whole
/// angle and a the angle from its middle. Exactly opposite ends would have two shortest paths.
#[test]
fn figure_5_anisotropy() {
    const RADIUS: f64 = 80.0;
    let (image, first, whole) = (gaussian(), 0.3, 170_f64.to_radians());
    let ends = [first, first + whole].map(|angle| around(CENTRE, RADIUS, angle));
    let radius = |[x, y]: [f64; 2]| (x - CENTRE[0]).hypot(y - CENTRE[1]);
    let mut panels = vec![picture_panel(&image, &ends)];
    let mut before = [0.0; 2];
    for anisotropy in [0.0, 0.5, 0.8, 0.99] {
        let medium = anisotropic(&image, Directions::Gradient { sigma: 0.0 }, anisotropy);
        let paths =
            [by_heat(&medium, ends, 2000).0, by_fast_marching(&medium, ends, Order::Second)];
        let shrink = ((1.0 - anisotropy) / (1.0 + anisotropy)).sqrt();
        let off = |[x, y]: [f64; 2]| {
            let (sin, cos) = (first + 0.5 * whole).sin_cos();
            let (dx, dy) = (x - CENTRE[0], y - CENTRE[1]);
            let from_middle = (dy * cos - dx * sin).atan2(dx * cos + dy * sin);
            let exact = RADIUS * (0.5 * shrink * whole).cos() / (shrink * from_middle).cos();
            (radius([x, y]) - exact).abs()
        };
        let straying = paths
            .each_ref()
            .map(|path| path.points.iter().map(|&point| off(point)).fold(0.0, f64::max));
        let radii = paths.each_ref().map(|path| mean_along(path, radius) / RADIUS);
        println!(
            "A = {anisotropy}, heat and fast marching: radius {radii:.4?}, off {straying:.3?}"
        );
        // At 0.99, where heat is 199 times as fast along as across, paths wobble towards the source.
        let most = if anisotropy < 0.9 { 0.5 } else { 0.6 };
        assert!(straying.iter().all(|&off| off < most), "from the closed form: {straying:?}");
        assert!(radii[0] > before[0] && radii[1] > before[1] && radii[0] < 1.0);
        before = radii;
        panels.push(paths_panel(&image, [&paths[1], &paths[0]]));
    }
    assert!(before.iter().all(|&radius| radius > 0.99), "not the half circle: {before:?}");
    assert_figure("figure_5_anisotropy.png", &panels);
}

/// Figures 6 and 10: by eq. (6) the path takes the short cut, with an anisotropy of 0.9 it stays in
/// the tube.
#[test]
fn figures_6_and_10_tubes() {
    let u_tube = ("figure_6_u_tube.png", u_tube(), U_ENDS);
    for (name, image, ends) in [u_tube, ("figure_10_spiral.png", spiral(), spiral_ends())] {
        let directions = Directions::Hessian { sigma: 4.0, polarity: Polarity::Both };
        let media = [alpha(&image, ends[0], 3.0), anisotropic(&image, directions, 0.9)];
        let mut panels = vec![picture_panel(&image, &ends[..1])];
        let inside = media.each_ref().map(|medium| {
            let (path, distances) = by_heat(medium, ends, 2000);
            let exact = by_fast_marching(medium, ends, Order::Second);
            panels.extend([distance_panel(&distances), paths_panel(&image, [&exact, &path])]);
            let in_tube = |point| f64::from(image.sample(point) > TUBE);
            [path, exact].map(|path| mean_along(&path, in_tube))
        });
        println!("{name}: inside by heat and fast marching, isotropic, anisotropic: {inside:.4?}");
        assert!(inside[0].iter().all(|&part| part < 0.5), "no short cut: {inside:?}");
        assert!(inside[1].iter().all(|&part| part >= 0.99), "out of the tube: {inside:?}");
        assert_figure(name, &panels);
    }
}

/// Figure 7: a thin road between fields, in the medium of eq. (6) by fast marching and by heat, and by
/// heat along edges, eq. (11), and in homogeneous parts, eq. (8).
#[test]
fn figure_7_road() {
    let (image, points) = (road(), road_points());
    let similar = alpha(&image, ROAD_ENDS[0], 2.0);
    let edges = medium::edges(&image, Default::default()).unwrap();
    let homogeneous = medium::perona_malik(&image, Default::default()).unwrap();
    let heat = |medium, steps| by_heat(medium, ROAD_ENDS, steps).0;
    let paths = [
        by_fast_marching(&similar, ROAD_ENDS, Order::First),
        heat(&similar, 2000),
        heat(&edges, 12_000),
        heat(&homogeneous, 2000),
    ];
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) <= 2.0;
    let scores = paths.each_ref().map(|path| {
        let found = points.iter().filter(|&&p| path.points.iter().any(|&other| near(p, other)));
        let on_the_road = |point| f64::from(points.iter().any(|&other| near(point, other)));
        [found.count() as f64 / points.len() as f64, mean_along(path, on_the_road)]
    });
    println!("fast marching, heat by (6), (11), (8): recall, precision {scores:.3?}");
    for other in [0, 1, 3] {
        assert!((0..2).all(|i| scores[2][i] > scores[other][i] + 0.1), "{scores:?}");
    }
    assert!(scores[2][0] > 0.8 && scores[3][0] < 0.2, "{scores:?}");
    let [fast_marching, by_6, by_11, by_8] = &paths;
    let panels = [
        picture_panel(&image, &ROAD_ENDS[..1]),
        paths_panel(&image, [fast_marching, by_6]),
        paths_panel(&image, [by_8, by_11]),
    ];
    assert_figure("figure_7_road.png", &panels);
}

/// Figure 9: where 13.3 % of the pixels are corrupted, heat keeps to a curve better than fast
/// marching in the same medium, that of eq. (11).
#[test]
fn figure_9_noise() {
    const SEEDS: u64 = 5;
    let clean = clean_curve();
    let mut mean = [0.0; 2];
    for seed in 1..=SEEDS {
        let image = noisy_curve(&clean, seed);
        let medium = medium::edges(&image, Default::default()).unwrap();
        let paths = [
            by_fast_marching(&medium, CURVE_ENDS, Order::First),
            by_heat(&medium, CURVE_ENDS, 15_000).0,
        ];
        let errors = paths.each_ref().map(|path| mean_along(path, off_the_noisy_curve));
        println!(
            "noise {seed}: mean distance from the curve by fast marching and heat {errors:.3?}"
        );
        (0..2).for_each(|i| mean[i] += errors[i] / SEEDS as f64);
        if seed == 1 {
            let details = paths.each_ref().map(|path| detail_panel(&image, path, [60, 185]));
            let panels = [&[picture_panel(&image, &[])], &details[..]].concat();
            assert_figure("figure_9_noise.png", &panels);
        }
    }
    println!("mean by fast marching and heat {mean:.3?}, ratio {:.3}", mean[1] / mean[0]);
    assert!(mean[1] <= 0.5 * mean[0], "{mean:?}");
}
