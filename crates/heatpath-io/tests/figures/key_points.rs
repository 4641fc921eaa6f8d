//! The figures of key points: 15, 19 and 20.

use super::automatic::{compare, exec, sources_in, tubes};
use super::panels::{
    BLUE, RED, WHITE, band, below, distance_panel, dot, draw_paths, grey_panel, ground, pixel,
};
use super::scenes::{ROOT, Scene, around, catheter, on_the_catheter, tree};
use super::{alpha, assert_figure, beside, flow_with, panel};
use heatpath_core::evaluation::{CurveSet, Evaluation};
use heatpath_core::grid::Grid;
use heatpath_core::grid::distance::normalized;
use heatpath_core::grid::filter::Polarity;
use heatpath_core::grid::heat::{Duration, Heat, HeatOptions};
use heatpath_core::grid::keypoints::{KeyPointOptions, KeyPoints, Threshold, key_points};
use heatpath_core::grid::medium::Medium;
use image::{Rgb, RgbImage};
use std::f64::consts::TAU;

const YELLOW: [u8; 3] = [255, 190, 0];

/// The paper's epsilon 1.
const OF_THE_PAPER: Threshold = Threshold::Temperature(0.8);

fn find(medium: &Medium<2>, seed: [f64; 2], options: &KeyPointOptions) -> KeyPoints<2> {
    key_points(medium, &sources_in(medium, &[seed]), options, &exec()).unwrap()
}

fn score(found: &KeyPoints<2>, scene: &Scene) -> Evaluation {
    let paths: Vec<_> = found.links.iter().map(|link| &link.path.points[..]).collect();
    compare(&CurveSet::of_polylines(&paths, [1.0; 2]).unwrap(), scene)
}

/// What is known after the first steps, each of which looks around one key point: paths in blue, key
/// points in yellow and the seed in red.
fn steps_panel(scene: &Scene, found: &KeyPoints<2>, steps: usize) -> RgbImage {
    let is_known = |number: usize| found.points[number].parent.is_none_or(|parent| parent < steps);
    let mut drawn = ground(scene);
    let links = found.links.iter().filter(|link| is_known(link.from) && is_known(link.to));
    draw_paths(&mut drawn, links.map(|link| &link.path.points[..]));
    let known = (0..found.points.len()).filter(|&number| is_known(number));
    known.for_each(|number| dot(&mut drawn, pixel(found.points[number].point), 3, YELLOW));
    dot(&mut drawn, pixel(found.points[0].point), 5, RED);
    drawn
}

// === Figure 15

/// The distances of 75 x 75 cells around a key point, twice as large, with its circle in red.
fn circle_panel(heat: &Heat<2>, centre: [f64; 2], radius: f64) -> RgbImage {
    let distances = normalized(heat);
    let farthest = distances.reached().fold(0.0, f64::max);
    let corner = centre.map(|part| part.round() as usize - 37);
    let mut drawn = RgbImage::from_fn(150, 150, |x, y| {
        let distance = distances.field()[[corner[0] + x as usize / 2, corner[1] + y as usize / 2]];
        Rgb(if distance.is_finite() { band(1.0 - distance / farthest) } else { WHITE })
    });
    for degree in 0..360 {
        let [x, y] = around([75.0, 75.0], 2.0 * radius, f64::from(degree).to_radians());
        dot(&mut drawn, [x, y], 1, RED);
    }
    drawn
}

/// The heat density along a circle by its logarithm, from the right clockwise, over the directions
/// of the peaks in yellow. The height is 60.
fn plot_panel(ln_u: impl Fn(f64) -> f64, peaks: &[f64]) -> RgbImage {
    let heights: Vec<f64> = (0..1500).map(|i| ln_u(TAU * f64::from(i) / 1500.0)).collect();
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut drawn = RgbImage::from_pixel(150, 150, Rgb(WHITE));
    for peak in peaks {
        let x = (150.0 * peak / TAU).floor();
        (0..150).for_each(|y| dot(&mut drawn, [x, f64::from(y)], 1, YELLOW));
    }
    for (i, ln_u) in heights.into_iter().enumerate() {
        let y = (5.0 + 140.0 * (highest - ln_u) / 60.0).min(149.0);
        dot(&mut drawn, [(i / 10) as f64, y], 1, BLUE);
    }
    drawn
}

/// How often the tubes cross a circle.
fn crossings(scene: &Scene, centre: [f64; 2], radius: f64) -> usize {
    let is_inside = |&[x, y]: &[f64; 2]| (x - centre[0]).hypot(y - centre[1]) < radius;
    let pairs = scene.tubes.iter().flat_map(|tube| tube.points.windows(2));
    pairs.filter(|pair| is_inside(&pair[0]) != is_inside(&pair[1])).count()
}

/// The directions of the key points found around a seed, as angles.
fn directions(found: &KeyPoints<2>) -> Vec<f64> {
    let [x, y] = found.points[0].point;
    let around = found.points.iter().filter(|point| point.parent == Some(0));
    around.map(|p| (p.point[1] - y).atan2(p.point[0] - x).rem_euclid(TAU)).collect()
}

/// Figure 15: heat on the circle of Algorithm 2 has a peak where a branch crosses it.
#[test]
fn figure_15_circle() {
    let scene = tree();
    let medium = alpha(&scene.image, ROOT, 3.0);
    let options = KeyPointOptions { tips: false, ..Default::default() };
    let paper = KeyPointOptions { threshold: OF_THE_PAPER, ..options };
    let starts: Vec<[f64; 2]> = scene.tubes.iter().map(|tube| tube.points[0]).collect();
    let ends = scene.tubes.iter().map(|tube| tube.points[400]);
    let forks = ends.filter(|end| starts.contains(end));
    let mut rows = Vec::new();
    for (number, centre) in [scene.tubes[0].points[200]].into_iter().chain(forks).enumerate() {
        let found = find(&medium, centre, &options);
        let (peaks, branches) = (directions(&found), crossings(&scene, centre, options.radius));
        let of_the_paper = directions(&find(&medium, centre, &paper)).len();
        println!("{branches} branches, {} peaks, {of_the_paper} by the paper", peaks.len());
        assert_eq!(peaks.len(), branches, "around {centre:?}");
        if number < 2 {
            let duration = Duration::Iterations(found.iterations);
            let heat = flow_with(&medium, centre, HeatOptions { duration, ..Default::default() });
            let ln_u = |angle| heat.ln_temperature().sample(around(centre, options.radius, angle));
            rows.push(beside(&[
                circle_panel(&heat, centre, options.radius),
                plot_panel(ln_u, &peaks),
                steps_panel(&scene, &found, 1),
            ]));
        }
    }
    assert_figure("figure_15_circle.png", &[below(&rows)]);
}

// === Figures 19 and 20

/// Figure 19: key points follow a curve with a loop, one after the other.
#[test]
fn figure_19_catheter() {
    let scene = catheter();
    let (response, medium) = tubes(&scene, Polarity::Dark, on_the_catheter());
    // Eq. (10) is slow on the flanks of a tube.
    let options = KeyPointOptions { least_speed_sq: 0.05, ..Default::default() };
    let found = find(&medium, on_the_catheter(), &options);
    let result = score(&found, &scene);
    println!("{} key points, {:?}", found.points.len(), result.scores);
    println!("mean distance {:.3}", result.extracted_to_truth.mean);
    assert!(result.scores[0].recall > 0.9999, "{result:?}");
    assert!(result.scores[0].precision > 0.99, "{result:?}");
    assert!(result.extracted_to_truth.mean < 0.5, "{result:?}");
    let reached: Grid<bool, 2> = found.travelling.map(|distance| distance.is_finite());
    let above = [
        grey_panel(&scene.image, on_the_catheter()),
        panel(&response, band, &[]),
        steps_panel(&scene, &found, 1),
        steps_panel(&scene, &found, 2),
    ];
    let results = [
        steps_panel(&scene, &found, 3),
        steps_panel(&scene, &found, 10),
        steps_panel(&scene, &found, usize::MAX),
        distance_panel(&found.travelling, &reached),
    ];
    assert_figure("figure_19_catheter.png", &[below(&[beside(&above), beside(&results)])]);
}

/// Figure 20: by the threshold of the paper, the smaller the circles, the more of a tree is found.
#[test]
fn figure_20_radius() {
    let scene = tree();
    let medium = alpha(&scene.image, ROOT, 3.0);
    let mut recall = Vec::new();
    let rows = [OF_THE_PAPER, KeyPointOptions::default().threshold].map(|threshold| {
        beside(&[45.0, 30.0, 15.0, 10.0].map(|radius| {
            let options = KeyPointOptions { radius, threshold, ..Default::default() };
            let found = find(&medium, ROOT, &options);
            let score = score(&found, &scene).scores[0];
            println!("{threshold:?}, {radius}: {:.3}, {:.3}", score.recall, score.precision);
            recall.push(score.recall);
            steps_panel(&scene, &found, usize::MAX)
        }))
    });
    assert!(recall[..4].windows(2).all(|pair| pair[0] < pair[1]), "{recall:?}");
    assert!(recall[3] < 0.5 && recall[4..].iter().all(|&recall| recall > 0.97), "{recall:?}");
    assert_figure("figure_20_radius.png", &[below(&rows)]);
}
