//! What is made of the heat of many sources.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;

use heatpath_core::Exec;
use heatpath_core::grid::bridge::{BridgeError, bridge};
use heatpath_core::grid::distance::{distance_matrix, normalized};
use heatpath_core::grid::heat::{Explicit, Heat, HeatOptions, Implicit, ImplicitOptions};
use heatpath_core::grid::labels::labels;
use heatpath_core::grid::medium::{self, Form};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use support::{euclidean, flow, options, rough};

#[test]
fn balanced_sources_are_equally_near() {
    let shape = Shape::new([160, 60]).unwrap();
    let field = Grid::from_fn(shape, |[x, _]| if x < 80 { 1.0 } else { 0.1 });
    let medium = medium::given(field, Form::Pointwise).unwrap();
    let exec = Exec::single_threaded();
    let sources = Sources::new(&[[30.0, 30.0], [130.0, 30.0]], medium.mask()).unwrap();
    let implicit = Implicit::new(&medium, options(16.0, 1), &exec).unwrap();
    let balanced = normalized(&implicit.flow_balanced(&sources, &exec).unwrap());
    for (source, slowness) in [([30.0, 30.0], 1.0), ([130.0, 30.0], 10.0_f64.sqrt())] {
        assert!(balanced.at(source) < 1.0, "{source:?}: {}", balanced.at(source));
        let beside = balanced.at([source[0] + 9.0, source[1]]);
        assert!((beside / (9.0 * slowness) - 1.0).abs() < 0.05, "{source:?}: {beside}");
    }
}

#[test]
fn a_matrix_of_distances_is_symmetric() {
    let (medium, _) = rough(Shape::new([70, 50]).unwrap(), 1.0, Form::Pointwise, 0.0, 5);
    let exec = Exec::new(2).unwrap();
    let implicit = Implicit::new(&medium, options(16.0, 1), &exec).unwrap();
    let points: Vec<[f64; 2]> =
        (0..40).map(|i| [f64::from(i * 17 % 70), f64::from(i * 29 % 50)]).collect();
    let points = Sources::new(&points, medium.mask()).unwrap();
    let matrix = distance_matrix(&implicit, &points, &points, &exec).unwrap();
    for (i, row) in matrix.iter().enumerate() {
        let alone = normalized(&implicit.flow(&points.each()[i], &exec).unwrap());
        for (j, &there) in row.iter().enumerate() {
            let back = matrix[j][i];
            assert!((there - back).abs() < 1e-8 * (1.0 + there), "{there} and {back}");
            assert!((there - alone.at(points.points()[j])).abs() < 1e-9 * (1.0 + there));
        }
    }
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let two = Sources::new(&points.points()[..2], medium.mask()).unwrap();
    let slower = distance_matrix(&explicit, &two, &two, &exec).unwrap();
    assert!((slower[0][1] / matrix[0][1] - 1.0).abs() < 0.15, "{slower:?} {}", matrix[0][1]);
}

#[test]
fn a_bridge_is_as_wide_as_said() {
    let medium = medium::uniform(Shape::new([161, 101]).unwrap());
    let (s, t) = ([30.0, 50.0], [130.0, 50.0]);
    let density = bridge(&flow(&medium, s, options(16.0, 1)), &flow(&medium, t, options(16.0, 1)));
    let density = density.unwrap();
    let half_width = 0.5 * (2.0 * 100.0 * 4.0_f64).sqrt();
    for x in [80_usize, 60] {
        let highest =
            (0..101).max_by(|&a, &b| density[[x, a]].total_cmp(&density[[x, b]])).unwrap();
        assert_eq!(highest, 50);
    }
    let fall = density[[80, 50]] - density[[80, 50 + half_width.round() as usize]];
    assert!((fall - 1.0).abs() < 0.1, "{fall}");

    let other = medium::uniform(Shape::new([8, 9]).unwrap());
    let small = flow(&other, [1.0, 1.0], options(1.0, 1));
    let big = flow(&medium, s, options(1.0, 1));
    assert!(matches!(bridge(&small, &big), Err(BridgeError::Size { .. })));
    let walls = Mask::new(Grid::from_fn(Shape::new([8, 9]).unwrap(), |[x, _]| x != 4));
    let apart = other.clone().with_walls(walls).unwrap();
    let [a, b] = [[1.0, 1.0], [7.0, 1.0]].map(|point| flow(&apart, point, options(1.0, 1)));
    assert_eq!(bridge(&a, &b), Err(BridgeError::NotReached));
}

#[test]
fn labels_are_those_of_the_nearest_source() {
    let walls = Mask::new(Grid::from_fn(Shape::new([90, 70]).unwrap(), |[x, _]| x != 80));
    let medium = medium::uniform(*walls.shape()).with_walls(walls).unwrap();
    let points = [[20.0, 20.0], [60.0, 15.0], [40.0, 55.0]];
    let heats: Vec<Heat<2>> =
        points.iter().map(|&point| flow(&medium, point, ImplicitOptions::default())).collect();
    let labels = labels(&heats).unwrap();
    for cell in 0..90 * 70 {
        let p = medium.shape().centre(cell);
        let shares: f64 = labels.shares.iter().map(|share| share.values()[cell]).sum();
        if p[0] >= 80.0 {
            assert_eq!((labels.nearest.values()[cell], shares), (None, 0.0));
            continue;
        }
        assert!((shares - 1.0).abs() < 1e-12);
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| euclidean(points[a], p).total_cmp(&euclidean(points[b], p)));
        if euclidean(points[order[1]], p) - euclidean(points[order[0]], p) > 0.5 {
            assert_eq!(labels.nearest.values()[cell], Some(order[0]), "{p:?}");
            assert!(labels.shares[order[0]].values()[cell] > 0.4);
        }
    }
    assert!(heatpath_core::grid::labels::labels::<2>(&[]).is_none());
}
