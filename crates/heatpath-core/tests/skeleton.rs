//! Centrelines, radii and graphs against what geometry and topology say.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::grid::skeleton::{Graph, PruneOptions, radii, raster, thin};
use heatpath_core::grid::{Grid, Shape};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn mask<const D: usize>(size: [usize; D], is_in: impl Fn([f64; D]) -> bool) -> Grid<bool, D> {
    Grid::from_fn(Shape::new(size).unwrap(), |index| is_in(index.map(|i| i as f64)))
}

fn count<const D: usize>(mask: &Grid<bool, D>) -> usize {
    mask.values().iter().filter(|&&set| set).count()
}

/// The pieces of the cells that are `value`, joined by faces or by corners too.
fn pieces<const D: usize>(mask: &Grid<bool, D>, value: bool, corners: bool) -> usize {
    let shape = *mask.shape();
    let mut waiting = mask.map(|&set| set == value);
    let mut pieces = 0;
    for start in 0..shape.cells() {
        if !std::mem::take(&mut waiting.values_mut()[start]) {
            continue;
        }
        pieces += 1;
        let mut stack = vec![start];
        while let Some(cell) = stack.pop() {
            for next in 0..shape.cells() {
                let (a, b) = (shape.index(cell), shape.index(next));
                let steps: Vec<usize> = (0..D).map(|axis| a[axis].abs_diff(b[axis])).collect();
                let far =
                    if corners { steps.iter().max().copied() } else { Some(steps.iter().sum()) };
                if far == Some(1) && std::mem::take(&mut waiting.values_mut()[next]) {
                    stack.push(next);
                }
            }
        }
    }
    pieces
}

fn random_mask<const D: usize>(side: usize, seed: u64, part: f64) -> Grid<bool, D> {
    let mut state = seed.wrapping_mul(2685821657736338717) | 1;
    mask([side; D], |_| true).map(|_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        ((state >> 11) as f64 / (1_u64 << 53) as f64) < part
    })
}

/// With a margin of false cells, all outside is one piece.
fn with_margin<const D: usize>(inner: &Grid<bool, D>) -> Grid<bool, D> {
    let size = inner.shape().size();
    Grid::from_fn(Shape::new(size.map(|n| n + 2)).unwrap(), |index| {
        (0..D).all(|axis| (1..=size[axis]).contains(&index[axis])) && inner[index.map(|i| i - 1)]
    })
}

fn euler(mask: &Grid<bool, 3>) -> i64 {
    // Closed cells: corners, edges, faces and cubes that belong to a true cell.
    let size = mask.shape().size();
    let inside = |index: [i64; 3]| {
        let place = index.map(|i| usize::try_from(i).unwrap_or(usize::MAX));
        (0..3).all(|axis| place[axis] < size[axis]) && mask[place]
    };
    let ends = size.map(|n| 2 * n as i64 + 1);
    let mut sum = 0;
    for x in 0..ends[0] {
        for y in 0..ends[1] {
            for z in 0..ends[2] {
                let at = [x, y, z];
                let low = at.map(|i| (i - 1).div_euclid(2));
                let wide = at.map(|i| i % 2 == 0);
                let touches = (0..8).any(|corner: usize| {
                    let cell = std::array::from_fn(|axis| {
                        low[axis] + i64::from(wide[axis] && corner >> axis & 1 == 1)
                    });
                    inside(cell)
                });
                let dimension = 3 - wide.iter().filter(|&&even| even).count();
                sum += i64::from(touches) * if dimension % 2 == 0 { 1 } else { -1 };
            }
        }
    }
    sum
}

proptest! {
    #[test]
    fn thinning_keeps_pieces_and_holes(seed in 1_u64.., side in 4_usize..14, part in 0.2..0.9) {
        let thick = with_margin(&random_mask::<2>(side, seed, part));
        let thinned = thin(&thick);
        prop_assert_eq!(pieces(&thick, true, true), pieces(&thinned, true, true));
        prop_assert_eq!(pieces(&thick, false, false), pieces(&thinned, false, false));
        prop_assert_eq!(&thin(&thinned), &thinned);
        let inside = thinned.values().iter().zip(thick.values()).all(|(thin, thick)| thick | !thin);
        prop_assert!(inside);
    }

    #[test]
    fn thinning_keeps_the_topology_of_volumes(seed in 1_u64.., side in 3_usize..7, part in 0.2..0.9) {
        let thick = with_margin(&random_mask::<3>(side, seed, part));
        let thinned = thin(&thick);
        prop_assert_eq!(pieces(&thick, true, true), pieces(&thinned, true, true));
        prop_assert_eq!(pieces(&thick, false, false), pieces(&thinned, false, false));
        prop_assert_eq!(euler(&thick), euler(&thinned), "tunnels");
        prop_assert_eq!(&thin(&thinned), &thinned);
    }

    #[test]
    fn a_graph_fits_together(seed in 1_u64.., side in 4_usize..14) {
        let thick = with_margin(&random_mask::<2>(side, seed, 0.6));
        let graph = Graph::of_mask(&thick);
        let holes = pieces(&thick, false, false) - 1;
        let circles = graph.branches.len() + pieces(&thick, true, true) - graph.nodes.len();
        // A hole between junctions that touch is in their node.
        prop_assert!(circles <= holes, "{} {} {:?}", circles, holes, graph);
        for (number, node) in graph.nodes.iter().enumerate() {
            let ends = graph.branches.iter().flat_map(|branch| [branch.from, branch.to]);
            prop_assert_eq!(ends.filter(|&end| end == number).count(), node.degree);
        }
        for branch in &graph.branches {
            prop_assert_eq!(branch.points[0], graph.nodes[branch.from].point);
            prop_assert_eq!(branch.points[branch.points.len() - 1], graph.nodes[branch.to].point);
            prop_assert_eq!(branch.points.len(), branch.radii.len());
        }
    }
}

#[test]
fn discs_and_balls_shrink_to_their_centre() {
    let disc = thin(&mask([31, 31], |[x, y]| (x - 15.0).hypot(y - 15.0) < 11.3));
    assert!(count(&disc) <= 2 && disc[[15, 15]]);
    let ball = |[x, y, z]: [f64; 3]| (x - 8.0).hypot(y - 8.0).hypot(z - 8.0) < 6.2;
    let ball = thin(&mask([17; 3], ball));
    assert!(count(&ball) <= 2 && ball[[8, 8, 8]]);
    let ring = thin(&mask([41, 41], |[x, y]| {
        let radius = (x - 20.0).hypot(y - 20.0);
        (10.0..16.0).contains(&radius)
    }));
    assert_eq!((pieces(&ring, true, true), pieces(&ring, false, false)), (1, 2));
}

#[test]
fn digital_lines_have_their_length() {
    let (mut worst, mut bare) = (0.0_f64, 0.0_f64);
    for degrees in 0..90 {
        let angle = f64::from(degrees).to_radians();
        let (sin, cos) = angle.sin_cos();
        let steps = (90.0 * sin.max(cos)).floor();
        let mut line = mask([101, 101], |_| false);
        for i in 0..=steps as usize {
            let along = i as f64 / sin.max(cos);
            line[[along * cos, along * sin].map(|x| (x + 5.5).floor() as usize)] = true;
        }
        let graph = Graph::of_mask(&line);
        assert_eq!((graph.nodes.len(), graph.branches.len()), (2, 1), "{degrees}");
        let branch = &graph.branches[0];
        let chord = branch.length / branch.tortuosity;
        assert!((chord - steps / sin.max(cos)).abs() < 1.0, "{degrees}: {chord}");
        worst = worst.max((branch.tortuosity - 1.0).abs());
        let slope = angle.tan().min(1.0 / angle.tan());
        bare = bare.max((1.0 - slope + slope * 2_f64.sqrt()) / 1_f64.hypot(slope) - 1.0);
    }
    println!("lines are at most {:.2} % too long, bare {:.2} %", 100.0 * worst, 100.0 * bare);
    assert!(worst < 0.01, "{worst}");
}

#[test]
fn digital_circles_have_their_length() {
    for radius in [8.0, 15.0, 30.5, 60.0] {
        let centre = radius + 6.0;
        let side = (2.0 * centre) as usize;
        let circle = Graph::of_mask(&mask([side, side], |[x, y]| {
            ((x - centre).hypot(y - centre) - radius).abs() < 2.0
        }));
        assert_eq!((circle.nodes.len(), circle.branches.len()), (1, 1));
        assert_eq!(circle.nodes[0].degree, 2);
        assert_eq!(circle.branches[0].tortuosity, f64::INFINITY);
        let error = circle.physical_length() / (TAU * radius) - 1.0;
        println!("circle of radius {radius}: {:.2} %", 100.0 * error);
        assert!(error.abs() < 0.02, "{radius}: {error}");
    }
}

#[test]
fn a_helix_has_its_length_and_radius() {
    // Radius 12, rise 40 a turn, cells twice as high as wide.
    let shape = Shape::with_spacing([41, 41, 40], [1.0, 1.0, 2.0]).unwrap();
    let at = |t: f64| [20.0 + 12.0 * t.cos(), 20.0 + 12.0 * t.sin(), 10.0 + 40.0 * t / TAU];
    let curve: Vec<[f64; 3]> = (0..=400).map(|i| at(1.5 * TAU * f64::from(i) / 400.0)).collect();
    let tube = Grid::from_fn(shape, |index| {
        let here = [index[0] as f64, index[1] as f64, 2.0 * index[2] as f64];
        let apart_sq = |p: &[f64; 3]| (0..3).map(|i| (p[i] - here[i]).powi(2)).sum::<f64>();
        curve.iter().any(|p| apart_sq(p) < 4.0 * 4.0)
    });
    let graph = Graph::of_mask(&tube).pruned(PruneOptions::default());
    assert_eq!((graph.nodes.len(), graph.branches.len()), (2, 1));
    let branch = &graph.branches[0];
    let exact = 1.5 * (TAU * 12.0).hypot(40.0);
    // At each end the centreline stops short of the rounded cap, by about the radius.
    let (least, most) = (exact - 4.0, exact + 8.0);
    println!("helix: length {} of {exact}, radius {}", branch.physical_length, branch.mean_radius);
    assert!((least..most).contains(&branch.physical_length), "{}", branch.physical_length);
    assert!((branch.mean_radius - 4.0).abs() < 0.6, "{}", branch.mean_radius);
    let nearest = |p: &[f64; 3]| {
        let distance = |q: &[f64; 3]| (p[0] - q[0]).hypot(p[1] - q[1]).hypot(2.0 * p[2] - q[2]);
        curve.iter().map(distance).fold(f64::INFINITY, f64::min)
    };
    let inner = &branch.points[6..branch.points.len() - 6];
    let mean = inner.iter().map(nearest).sum::<f64>() / inner.len() as f64;
    println!("helix: the centreline is {mean} off the middle");
    assert!(mean < 0.8, "{mean}");
}

#[test]
fn radii_are_those_of_discs_and_bars() {
    for radius in [3.2, 5.5, 10.3, 20.7] {
        let disc = mask([61, 61], |[x, y]| (x - 30.0).hypot(y - 30.0) < radius);
        let found = radii(&disc)[[30, 30]];
        println!("disc of radius {radius}: {found}");
        assert!((found - radius).abs() < 0.5, "{radius}: {found}");
    }
    for (half, exact) in [(2.2, 2.5), (4.9, 4.5)] {
        let bar = mask([21, 21], |[x, _]| (x - 10.0).abs() < half);
        assert_eq!(radii(&bar)[[10, 10]], exact, "cells count in full");
    }
    // Bars at many angles: right on the average, wherever their edges pass between the cells.
    let (mut sum, mut worst) = (0.0, 0.0_f64);
    for degrees in 0..90 {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let half = 6.0 + 0.01 * f64::from(degrees);
        let bar = mask([61, 61], |[x, y]| (sin * (x - 30.0) - cos * (y - 30.0)).abs() < half);
        let error = radii(&bar)[[30, 30]] - half;
        sum += error / 90.0;
        worst = worst.max(error.abs());
    }
    println!("bars: mean error {sum}, largest {worst}");
    assert!(sum.abs() < 0.1 && worst < 0.51, "{sum} {worst}");
}

#[test]
fn radii_are_physical_and_the_border_is_no_edge() {
    let shape = Shape::with_spacing([9, 9, 7], [2.0, 0.5, 1.0]).unwrap();
    let plate = radii(&Grid::from_fn(shape, |[_, y, _]| (2..7).contains(&y)));
    assert_eq!((plate[[4, 4, 3]], plate[[0, 2, 0]], plate[[0, 1, 0]]), (1.25, 0.25, 0.0));
    let full = radii(&Grid::from_fn(shape, |_| true));
    assert!(full.values().iter().all(|&radius| radius == f64::INFINITY));
}

/// A Y of three arms 3 cells wide with a bump on one.
fn tree() -> Grid<bool, 2> {
    let arm = |[x, y]: [f64; 2], degrees: f64, length: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (along, across) =
            (cos * (x - 50.0) + sin * (y - 50.0), cos * (y - 50.0) - sin * (x - 50.0));
        (0.0..length).contains(&along) && across.abs() < 2.5
    };
    mask([101, 101], |p| {
        arm(p, 0.0, 40.0)
            || arm(p, 130.0, 45.0)
            || arm(p, 230.0, 30.0)
            || (p[0] - 70.0).hypot(p[1] - 53.0) < 2.5
    })
}

#[test]
fn a_pruned_tree_has_its_branches() {
    let graph = Graph::of_mask(&tree()).pruned(PruneOptions { length: 6.0, radii: 1.5 });
    let mut lengths: Vec<f64> = graph.branches.iter().map(|b| b.physical_length).collect();
    lengths.sort_by(f64::total_cmp);
    assert_eq!((graph.nodes.len(), lengths.len()), (4, 3), "{lengths:?}");
    for (found, exact) in lengths.iter().zip([30.0, 40.0, 45.0]) {
        assert!((found - exact).abs() < 4.0, "{found} for {exact}");
    }
    let mut degrees: Vec<usize> = graph.nodes.iter().map(|node| node.degree).collect();
    degrees.sort_unstable();
    assert_eq!(degrees, [1, 1, 1, 3]);
    for branch in &graph.branches {
        assert!((branch.mean_radius - 2.5).abs() < 0.4 && branch.tortuosity < 1.1, "{branch:?}");
    }
    assert_eq!(graph.pruned(PruneOptions { length: 6.0, radii: 1.5 }), graph);
    let nothing = PruneOptions { length: 0.0, radii: 0.0 };
    assert_eq!(Graph::of_mask(&tree()).pruned(nothing), Graph::of_mask(&tree()));
}

#[test]
fn spurs_go_and_what_carried_them_is_one_branch_again() {
    let trunk = vec![[5.0, 20.0], [95.0, 20.0]];
    let spurs = (1..9).map(|i| vec![[10.0 * f64::from(i), 20.0], [10.0 * f64::from(i), 24.0]]);
    let comb: Vec<_> = [trunk].into_iter().chain(spurs).collect();
    let graph = Graph::of_mask(&raster(&comb, Shape::new([101, 41]).unwrap()));
    assert_eq!((graph.nodes.len(), graph.branches.len()), (18, 17));
    let pruned = graph.pruned(PruneOptions { length: 5.0, radii: 0.0 });
    assert_eq!((pruned.nodes.len(), pruned.branches.len()), (2, 1));
    assert!((pruned.physical_length() - 90.0).abs() < 1.0, "{}", pruned.physical_length());
    // A cross of four short arms keeps its two longest as one curve.
    let arms = [[0.0, 4.0], [0.0, -5.0], [6.0, 0.0], [-7.0, 0.0]];
    let cross: Vec<_> =
        arms.iter().map(|[x, y]| vec![[20.0, 20.0], [20.0 + x, 20.0 + y]]).collect();
    let graph = Graph::of_mask(&raster(&cross, Shape::new([41, 41]).unwrap()));
    assert_eq!(graph.branches.len(), 4);
    let pruned = graph.pruned(PruneOptions { length: 100.0, radii: 0.0 });
    assert_eq!((pruned.nodes.len(), pruned.branches.len()), (2, 1));
    assert!((pruned.physical_length() - 13.0).abs() < 0.5, "{}", pruned.physical_length());
}

#[test]
fn a_graph_has_the_circles_of_its_mask() {
    // A window of 3 x 2 panes.
    let window = mask([61, 41], |[x, y]| {
        (3.0..58.0).contains(&x) && (3.0..38.0).contains(&y) && (x % 18.0 < 5.0 || y % 16.0 < 7.0)
    });
    let graph = Graph::of_mask(&window).pruned(PruneOptions::default());
    assert_eq!(pieces(&window, false, false), 7);
    assert_eq!(graph.branches.len() + 1 - graph.nodes.len(), 6);
}

#[test]
fn turning_the_picture_changes_little() {
    let picture = tree();
    let turned = Grid::from_fn(*picture.shape(), |[x, y]| picture[[y, 100 - x]]);
    let lengths = [picture, turned].map(|mask| {
        Graph::of_mask(&mask).pruned(PruneOptions { length: 6.0, radii: 1.5 }).physical_length()
    });
    assert!((lengths[0] / lengths[1] - 1.0).abs() < 0.03, "{lengths:?}");
}

#[test]
fn radii_can_be_the_scales_of_a_filter() {
    let line = raster(&[[[3.0, 5.0], [27.0, 5.0]]], Shape::new([31, 11]).unwrap());
    let scales = Grid::from_fn(*line.shape(), |[x, _]| 1.0 + 0.1 * x as f64);
    let graph = Graph::of_centreline(&line, &scales).unwrap();
    assert!(
        Graph::of_centreline(&line, &Grid::from_fn(Shape::new([31, 9]).unwrap(), |_| 1.0))
            .is_none()
    );
    assert!((graph.branches[0].radii[0] - 1.3).abs() < 1e-12);
    assert!((graph.branches[0].mean_radius - 2.5).abs() < 1e-9);
    let dot = Graph::of_mask(&mask([5, 5], |p| p == [2.0, 2.0]));
    assert_eq!((dot.nodes.len(), dot.branches.len(), dot.nodes[0].degree), (1, 0, 0));
    assert!((dot.nodes[0].radius * PI - 0.5 * PI).abs() < 1e-12);
    let empty = Graph::of_mask(&mask([5, 5], |_| false));
    assert_eq!(empty.nodes.len() + empty.branches.len(), 0);
}
