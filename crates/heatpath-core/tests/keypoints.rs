//! Key points: all of a curve or tree is found, nothing else is, and always the same.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;

use heatpath_core::Exec;
use heatpath_core::grid::distance::normalized;
use heatpath_core::grid::filter::Tubes;
use heatpath_core::grid::heat::{Duration, Explicit, HeatOptions};
use heatpath_core::grid::keypoints::{
    KeyPointError, KeyPointOptions, KeyPoints, LengthOptions, Stop, Threshold, key_points,
    key_points_by_length,
};
use heatpath_core::grid::medium::{self, Medium, VesselnessOptions};
use heatpath_core::grid::path::Ending;
use heatpath_core::grid::{Mask, PointError, Shape, Sources};
use std::f64::consts::{PI, TAU};
use std::ops::{ControlFlow, Range};
use support::curves::{Curve, Score, curve, distance, draw, random_tree, score, segment, tree};
use support::random;

fn options(radius: f64) -> KeyPointOptions {
    KeyPointOptions { radius, ..KeyPointOptions::default() }
}

fn find<const D: usize>(
    medium: &Medium<D>,
    seeds: &[[f64; D]],
    options: &KeyPointOptions,
) -> KeyPoints<D> {
    let seeds = Sources::new(seeds, medium.mask()).unwrap();
    key_points(medium, &seeds, options, &Exec::single_threaded()).unwrap()
}

/// Of grey values with noise and of vesselness.
fn media<const D: usize>(shape: Shape<D>, curves: &[Curve<D>]) -> [Medium<D>; 2] {
    let image = draw(shape, curves, 0.05);
    let tubes = Tubes { scales: vec![1.5, 2.0, 3.0, 4.5], ..Tubes::default() };
    let vesselness = VesselnessOptions { tubes, ..VesselnessOptions::default() };
    [
        medium::conductivity(&image, &[0.8], Default::default()).unwrap(),
        medium::vesselness(&image, &vesselness, &Exec::single_threaded()).unwrap(),
    ]
}

fn picture() -> Shape<2> {
    Shape::new([300, 300]).unwrap()
}

/// A closed curve around the middle at a distance that depends on the angle.
fn around(half_width: f64, radius: impl Fn(f64) -> f64) -> Curve<2> {
    curve(half_width, |s| {
        let (angle, radius) = (TAU * s, radius(TAU * s));
        [150.0 + radius * angle.cos(), 150.0 + radius * angle.sin()]
    })
}

/// Every parent link and closing link leads from its one end to the other, along its points.
fn assert_links_hold<const D: usize>(found: &KeyPoints<D>) {
    for (number, point) in found.points.iter().enumerate() {
        let parents = found.links.iter().filter(|link| link.from == number);
        assert_eq!(
            parents.filter(|link| point.parent == Some(link.to)).count(),
            usize::from(point.parent.is_some())
        );
    }
    for link in &found.links {
        let points = &link.path.points;
        assert_eq!(link.path.ending, Ending::Source(link.to));
        assert!(distance(points[0], found.points[link.from].point) < 1e-9);
        assert!(distance(points[points.len() - 1], found.points[link.to].point) < 1e-9);
        assert!(points.windows(2).all(|pair| distance(pair[0], pair[1]) < 2.5));
    }
}

fn assert_found(
    name: &str,
    curves: &[Curve<2>],
    seed: [f64; 2],
    radius: f64,
    (closing, gap): (usize, f64),
) {
    for (medium, kind) in media(picture(), curves).iter().zip(["conductivity", "vesselness"]) {
        let found = find(medium, &[seed], &options(radius));
        let score = score(&found, curves);
        let loops = found.closing().count();
        let name = format!("{name}, {kind}, radius {radius}");
        assert_links_hold(&found);
        assert_eq!(found.stop, Stop::Complete);
        assert!(score.recall > 0.98 && score.gap <= gap, "{name}: {score:?}");
        assert!(score.precision > 0.96 && score.mean < 0.6, "{name}: {score:?}");
        assert!(loops == closing, "{name}: {loops} loops");
    }
}

#[test]
fn closed_curves_are_found_and_closed() {
    for radius in [15.0, 30.0] {
        assert_found("circle", &[around(3.0, |_| 100.0)], [250.0, 150.0], radius, (1, 0.0));
        assert_found("small circle", &[around(3.0, |_| 40.0)], [190.0, 150.0], radius, (1, 0.0));
        let ellipse =
            curve(3.0, |s| [150.0 + 120.0 * (TAU * s).cos(), 150.0 + 50.0 * (TAU * s).sin()]);
        assert_found("ellipse", &[ellipse], [270.0, 150.0], radius, (1, 0.0));
        let trefoil = around(2.5, |a| 80.0 + 40.0 * (3.0 * a).cos());
        assert_found("trefoil", &[trefoil], [270.0, 150.0], radius, (1, 0.0));
        let star = around(2.5, |a| 90.0 + 31.5 * (5.0 * a).cos());
        assert_found("star", &[star], [271.5, 150.0], radius, (1, 4.5));
    }
}

#[test]
fn a_spiral_is_followed_to_its_end() {
    let spiral = curve(2.5, |s| {
        let (angle, radius) = (6.0 * PI * s, 20.0 + 105.0 * s);
        [150.0 + radius * angle.cos(), 150.0 + radius * angle.sin()]
    });
    assert_found("spiral", &[spiral], [275.0, 150.0], 30.0, (0, 0.0));
}

#[test]
fn all_branches_of_a_tree_are_found() {
    let tree = tree([150.0, 290.0], PI / 2.0, 85.0, 4.5, 3);
    assert_found("tree", &tree, [150.0, 285.0], 15.0, (0, 5.0));
}

/// What is found of generated trees in both media. (Circles are 3 times as wide as the trunk, at least.)
fn scores_of_trees(trees: &[(usize, Range<u64>)]) -> impl Iterator<Item = (String, Score<2>)> {
    let numbered = trees.iter().flat_map(|(side, numbers)| numbers.clone().map(|n| (*side, n)));
    numbered.flat_map(|(side, number)| {
        let mut random = random(number);
        let half_width = 2.5 + 2.5 * random();
        let tree = random_tree(side as f64, half_width, &mut random);
        let seed = [0.5 * side as f64, 0.96 * side as f64 - 1.0];
        let media = media(Shape::new([side, side]).unwrap(), &tree);
        ["conductivity", "vesselness"].into_iter().zip(media).map(move |(kind, medium)| {
            let found = find(&medium, &[seed], &options(15.0));
            (format!("{side}, tree {number}, {kind}"), score(&found, &tree))
        })
    })
}

/// A gap is a stretch of a centreline, from where its branch leaves that of its parent to its tip, that
/// is more than 2 pixels away from every link. None is longer than 3 pixels: ends of thin branches.
#[test]
fn no_gap_remains_on_generated_trees() {
    let trees = [(300, 1..7), (450, 7..11), (700, 11..13), (1000, 13..14)];
    for (name, score) in scores_of_trees(&trees) {
        println!("{name}: {score:.3?}");
        assert!(score.recall > 0.985 && score.precision > 0.98 && score.mean < 0.3);
        assert!(score.gap <= 3.0 || BROKEN.contains(&name.as_str()));
    }
}

/// Trees of which branches cross, or end in others, where vesselness has holes; what is beyond one is too
/// short to be told from noise.
const BROKEN: [&str; 2] = ["300, tree 1, vesselness", "700, tree 12, vesselness"];

/// Where three branches meet within a few pixels, one side of the triangle may be left out, and so may a tip
/// beside another branch.
#[test]
fn gaps_of_further_trees_are_shorter_than_a_circle() {
    let mut with_gap = 0;
    for (name, score) in scores_of_trees(&[(300, 20..30), (450, 40..50), (700, 60..65)]) {
        println!("{name}: {score:.3?}");
        assert!(score.recall > 0.98 && score.precision > 0.98 && score.mean < 0.35);
        assert!(score.gap < 12.0);
        with_gap += usize::from(score.gap > 3.0);
    }
    assert!(with_gap <= 9, "{with_gap} of 50");
}

/// A fifth of the temperature is lost over a seventh of a cell.
#[test]
fn the_threshold_of_the_paper_loses_branches() {
    let tree = tree([150.0, 290.0], PI / 2.0, 85.0, 4.5, 3);
    let medium = &media(picture(), &tree)[0];
    let recall = |threshold| {
        let options = KeyPointOptions { threshold, ..options(15.0) };
        score(&find(medium, &[[150.0, 285.0]], &options), &tree).recall
    };
    let [paper, ours] = [Threshold::Temperature(0.8), Threshold::Speed(0.5)].map(recall);
    println!("recall with the threshold of the paper {paper:.3}, by speed {ours:.3}");
    assert!(paper < 0.5 && ours > 0.97);
}

#[test]
fn curves_in_space_are_found() {
    let shape = Shape::new([64, 64, 64]).unwrap();
    let helix = [curve(2.5, |s| {
        let angle = 4.0 * PI * s;
        [32.0 + 20.0 * angle.cos(), 32.0 + 20.0 * angle.sin(), 8.0 + 48.0 * s]
    })];
    let fork = [
        segment(3.0, [32.0, 32.0, 6.0], [32.0, 32.0, 30.0]),
        segment(2.5, [32.0, 32.0, 30.0], [54.0, 36.0, 56.0]),
        segment(2.5, [32.0, 32.0, 30.0], [12.0, 24.0, 54.0]),
    ];
    for (curves, seed) in [(&helix[..], [52.0, 32.0, 8.0]), (&fork[..], [32.0, 32.0, 8.0])] {
        for medium in media(shape, curves) {
            let found =
                find(&medium, &[seed], &KeyPointOptions { iterations: 20, ..options(12.0) });
            let score = score(&found, curves);
            println!("space: {score:.3?}, {} key points", found.points.len());
            assert_links_hold(&found);
            assert_eq!(found.closing().count(), 0);
            assert!(score.recall > 0.97 && score.gap == 0.0 && score.precision > 0.97, "{score:?}");
            assert!(score.mean < 0.6, "{score:?}");
        }
    }
}

#[test]
fn circles_are_round_in_physical_units() {
    let shape = Shape::with_spacing([200, 100], [1.0, 2.0]).unwrap();
    let ring = [curve(4.0, |s| [100.0 + 70.0 * (TAU * s).cos(), 100.0 + 70.0 * (TAU * s).sin()])];
    let image = draw(shape, &ring, 0.05);
    let medium = medium::conductivity(&image, &[0.8], Default::default()).unwrap();
    let found = find(&medium, &[[170.0, 50.0]], &options(20.0));
    let score = score(&found, &ring);
    assert!(score.recall > 0.99 && score.precision > 0.99 && score.mean < 1.0, "{score:?}");
    assert!(found.closing().count() >= 1);
    for point in found.points.iter().filter(|point| point.parent == Some(0)) {
        let length = shape.physical_distance(point.point, found.points[0].point);
        assert!((length - 20.0).abs() < 1e-9, "{length}");
    }
}

#[test]
fn several_seeds_share_the_structure() {
    let ring = [around(3.0, |_| 100.0)];
    let medium = &media(picture(), &ring)[0];
    let found = find(medium, &[[250.0, 150.0], [150.0, 50.0]], &options(30.0));
    let score_of_ring = score(&found, &ring);
    assert!(score_of_ring.recall > 0.99 && score_of_ring.precision > 0.99, "{score_of_ring:?}");
    assert_eq!(found.closing().count(), 2, "the two seeds meet on either side");
    assert_eq!(found.points.iter().filter(|point| point.parent.is_none()).count(), 2);
}

#[test]
fn neighbours_that_merely_lie_near_are_not_joined() {
    let lines = [50.0, 62.0].map(|x| segment(2.5, [x, 20.0], [x, 280.0]));
    for medium in media(picture(), &lines) {
        let one = find(&medium, &[[50.0, 150.0]], &options(30.0));
        assert_eq!(score(&one, &lines[..1]).recall, 1.0);
        assert!(one.points.iter().all(|point| point.point[0] < 54.0), "no key point in the other");
        let both = find(&medium, &[[50.0, 150.0], [62.0, 60.0]], &options(30.0));
        assert_eq!(score(&both, &lines).recall, 1.0);
        assert_eq!(both.closing().count(), 0);
    }
}

/// A window holds all that heat reaches, so its distances are those in the whole picture.
#[test]
fn windows_change_nothing() {
    let ring = [around(3.0, |_| 100.0)];
    for medium in media(picture(), &ring) {
        let seed = [250.3, 149.6];
        let found = find(&medium, &[seed], &KeyPointOptions { most: 3, ..options(30.0) });
        let duration = Duration::Iterations(found.iterations);
        let explicit =
            Explicit::new(&medium, HeatOptions { duration, ..HeatOptions::default() }).unwrap();
        let seeds = Sources::new(&[seed], medium.mask()).unwrap();
        let whole = normalized(&explicit.flow(&seeds, &Exec::single_threaded()).unwrap());
        let cells = medium.shape().cells();
        let inside = (0..cells).filter(|&c| distance(medium.shape().centre(c), seed) <= 30.0);
        for cell in inside {
            assert_eq!(found.travelling.values()[cell], whole.field().values()[cell]);
        }
    }
}

#[test]
fn threads_change_nothing() {
    let tree = tree([150.0, 290.0], PI / 2.0, 85.0, 4.5, 3);
    let medium = &media(picture(), &tree)[1];
    let seeds = Sources::new(&[[150.0, 285.0]], medium.mask()).unwrap();
    let run =
        |threads| key_points(medium, &seeds, &options(20.0), &Exec::new(threads).unwrap()).unwrap();
    let one = run(1);
    assert!(one.points.len() > 20);
    for threads in [2, 5] {
        assert_eq!(run(threads), one);
    }
}

#[test]
fn the_number_of_key_points_and_the_caller_can_end_it() {
    let ring = [around(3.0, |_| 100.0)];
    let medium = &media(picture(), &ring)[0];
    let found = find(medium, &[[250.0, 150.0]], &KeyPointOptions { most: 6, ..options(30.0) });
    assert_eq!((found.points.len(), found.stop), (6, Stop::Most));
    let seeds = Sources::new(&[[250.0, 150.0]], medium.mask()).unwrap();
    let exec = Exec::single_threaded().with_watch(|part| {
        if part > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let error = key_points(medium, &seeds, &options(30.0), &exec).unwrap_err();
    assert!(matches!(error, KeyPointError::Cancelled(_)), "{error}");
}

#[test]
fn what_is_out_of_range_is_named() {
    let medium = medium::uniform(Shape::new([40, 30]).unwrap());
    let seeds = Sources::new(&[[20.0, 15.0]], medium.mask()).unwrap();
    let exec = Exec::single_threaded();
    let message = |change: fn(&mut KeyPointOptions)| {
        let mut options = options(10.0);
        change(&mut options);
        key_points(&medium, &seeds, &options, &exec).unwrap_err().to_string()
    };
    assert_eq!(message(|o| o.radius = 3.0), "radius is 3; it must be from 4 to 10000 cells");
    assert!(message(|o| o.radius = f64::NAN).starts_with("radius is NaN"));
    assert_eq!(
        message(|o| o.threshold = Threshold::Speed(0.0)),
        "threshold is 0; it must be above 0 and at most 1"
    );
    assert!(message(|o| o.threshold = Threshold::Temperature(1.1)).starts_with("threshold is 1.1"));
    assert_eq!(
        message(|o| o.least_speed_sq = -1.0),
        "least squared speed is -1; it must be finite and not negative"
    );
    assert_eq!(message(|o| o.most = 0), "number of key points is 0; it must be at least 1");
    assert_eq!(message(|o| o.iterations = 0), "number of steps is 0; it must be from 1 to 1000000");
    let far =
        Sources::new(&[[70.0, 15.0]], &Mask::all_open(Shape::new([90, 30]).unwrap())).unwrap();
    let outside = key_points(&medium, &far, &options(10.0), &exec).unwrap_err();
    assert!(matches!(outside, KeyPointError::Point(PointError::Outside { number: 0, .. })));
    let by_length = |change: fn(&mut LengthOptions)| {
        let mut options = LengthOptions::default();
        change(&mut options);
        key_points_by_length(&medium, &seeds, &options, &exec).unwrap_err().to_string()
    };
    assert_eq!(by_length(|o| o.length = 0.0), "length is 0; it must be from 4 to 1e9 cells");
    assert!(by_length(|o| o.least_speed_sq = f64::NAN).starts_with("least squared speed is NaN"));
    assert!(by_length(|o| o.most = 0).starts_with("number of key points is 0"));
}

#[test]
fn borders_and_walls_end_a_curve() {
    let line = [segment(3.0, [0.0, 150.0], [299.0, 150.0])];
    let image = draw(picture(), &line, 0.05);
    let open = heatpath_core::grid::Grid::from_fn(picture(), |[x, _]| x != 200);
    let medium = medium::conductivity(&image, &[0.8], Default::default()).unwrap();
    let medium = medium.with_walls(Mask::new(open)).unwrap();
    let found = find(&medium, &[[0.0, 150.0]], &options(30.0));
    let furthest = found.points.iter().map(|point| point.point[0]).fold(0.0, f64::max);
    assert!(furthest > 194.0 && furthest < 199.5, "{furthest}");
    assert_links_hold(&found);
    let wall = Sources::new(&[[200.0, 150.0]], &Mask::all_open(picture())).unwrap();
    let error = key_points(&medium, &wall, &options(30.0), &Exec::single_threaded()).unwrap_err();
    assert!(matches!(error, KeyPointError::Point(PointError::InsideWall { number: 0, .. })));
}

#[test]
fn key_points_by_length_lie_that_far_apart() {
    let ring = [around(3.0, |_| 100.0)];
    let medium = &media(picture(), &ring)[1];
    let seeds = Sources::new(&[[250.0, 150.0]], medium.mask()).unwrap();
    let exec = Exec::single_threaded();
    let found = key_points_by_length(medium, &seeds, &LengthOptions::default(), &exec).unwrap();
    let score = score(&found, &ring);
    assert!(score.recall > 0.9 && score.precision > 0.95 && score.mean < 1.0, "{score:?}");
    assert_links_hold(&found);
    assert_eq!((found.closing().count(), found.stop), (0, Stop::Complete));
    for link in &found.links {
        assert!((link.path.length - 30.0).abs() < 3.0, "{}", link.path.length);
    }
    let few = LengthOptions { most: 4, ..LengthOptions::default() };
    let few = key_points_by_length(medium, &seeds, &few, &exec).unwrap();
    assert_eq!((few.points.len(), few.stop), (4, Stop::Most));
}

/// In a uniform medium the length of a path is its distance.
#[test]
fn lengths_are_distances_where_the_medium_is_uniform() {
    for spacing in [[1.0, 1.0], [1.0, 2.0]] {
        let medium = medium::uniform(Shape::with_spacing([120, 120], spacing).unwrap());
        let seeds = Sources::new(&[[60.0, 60.0]], medium.mask()).unwrap();
        let options = LengthOptions { most: 2, ..LengthOptions::default() };
        let exec = Exec::single_threaded();
        let found = key_points_by_length(&medium, &seeds, &options, &exec).unwrap();
        let far = medium.shape().physical_distance(found.points[1].point, [60.0, 60.0]);
        assert!((far - 30.0).abs() < 2.0, "{far}");
        let link = &found.links[0].path;
        assert!((link.physical_length - far).abs() < 0.5, "{} for {far}", link.physical_length);
    }
}
