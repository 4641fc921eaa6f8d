//! Graphs to JSON, CSV, SWC and VTP, and curves back.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use heatpath_core::grid::skeleton::{Graph, raster};
use heatpath_core::grid::{Grid, Shape};
use heatpath_io::{CurveFile, graph_json, write_graph};
use proptest::prelude::*;
use serde_json::Value;
use std::fs;
use tempfile::tempdir;

fn written<const D: usize>(ending: &str, graph: &Graph<D>, seeds: &[[f64; D]]) -> String {
    let folder = tempdir().unwrap();
    let file = folder.path().join(format!("graph.{ending}"));
    write_graph(&file, None, false, graph, seeds, None).unwrap();
    fs::read_to_string(file).unwrap()
}

fn read<const D: usize>(text: &str, spacing: [f64; D]) -> Vec<Vec<[f64; D]>> {
    CurveFile::from_bytes(text.as_bytes(), "graph").unwrap().into_polylines(spacing, None).unwrap()
}

/// A closed square with a tail, and a line apart.
fn loop_and_line() -> Graph<2> {
    let shape = Shape::with_spacing([40, 30], [0.5, 2.0]).unwrap();
    let square = vec![[5.0, 5.0], [20.0, 5.0], [20.0, 20.0], [5.0, 20.0], [5.0, 5.0]];
    let lines = [square, vec![[20.0, 12.0], [30.0, 12.0]], vec![[35.0, 3.0], [35.0, 25.0]]];
    Graph::of_mask(&raster(&lines, shape))
}

fn lengths<const D: usize>(curves: &[Vec<[f64; D]>], shape: &Shape<D>) -> f64 {
    let pairs = curves.iter().flat_map(|curve| curve.windows(2));
    pairs.map(|pair| shape.physical_distance(pair[0], pair[1])).sum()
}

#[test]
fn json_and_csv_have_the_documented_layout() {
    let graph = loop_and_line();
    assert_eq!((graph.nodes.len(), graph.branches.len()), (4, 3));
    let text = written("json", &graph, &[]);
    let value: Value = serde_json::from_str(&text).unwrap();
    let again: Value = serde_json::from_str(&graph_json(&graph, &[], None).to_string()).unwrap();
    assert_eq!(value, again);
    assert!(text.starts_with("{\"version\":1,\"dimension\":2,\"spacing\":[0.5,2.0],\"nodes\":[{"));
    for (entry, branch) in value["paths"].as_array().unwrap().iter().zip(&graph.branches) {
        let length = entry["physical_length"].as_f64().unwrap();
        assert!((length - branch.physical_length).abs() < 1e-12 * length);
        assert_eq!(entry["tortuosity"].as_f64().is_some(), branch.tortuosity.is_finite());
        assert_eq!(entry["radii"].as_array().unwrap().len(), branch.points.len());
    }
    assert!(value["paths"].as_array().unwrap().iter().all(|path| path["ended"] == "unreachable"));
    let seeds = [graph.nodes[0].point];
    let value = graph_json(&graph, &seeds, None);
    let piece = |number: &Value| number.as_u64().map(|number| number as usize);
    for path in value["paths"].as_array().unwrap() {
        let is_first = piece(&path["from"]) == Some(0) || piece(&path["to"]) == Some(0);
        assert!(!is_first || (path["ended"] == "source" && path["source"] == 0), "{path}");
    }
    let curves = read(&text, [0.5, 2.0]);
    for (curve, branch) in curves.iter().zip(&graph.branches) {
        assert_eq!(curve.len(), branch.points.len());
        let mut pairs = curve.iter().flatten().zip(branch.points.iter().flatten());
        assert!(pairs.all(|(a, b)| (a - b).abs() < 1e-12));
    }
    let csv = written("csv", &graph, &[]);
    let head =
        "branch,from,to,length,physical_length,tortuosity,mean_radius,from_x,from_y,to_x,to_y";
    assert_eq!(csv.lines().next().unwrap(), head);
    assert_eq!(csv.lines().count(), 4);
    assert!(csv.lines().all(|line| line.split(',').count() == 11), "{csv}");
}

#[test]
fn swc_is_rooted_cuts_loops_and_keeps_the_length() {
    let graph = loop_and_line();
    let text = written("swc", &graph, &[[30.0, 12.0]]);
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split(' ').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows[0], [1.0, 0.0, 15.0, 24.0, 0.0, rows[0][5], -1.0], "{text}");
    assert_eq!(rows.iter().filter(|row| row[6] == -1.0).count(), 2, "two pieces");
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row[0], (i + 1) as f64);
        assert!(row[6] < row[0] && row[5] > 0.0, "{row:?}");
    }
    assert_eq!(text.matches("a loop is cut").count(), 1, "{text}");
    let curves = read(&text, [0.5, 2.0]);
    let lost = graph.physical_length() - lengths(&curves, &graph.shape);
    assert!((0.0..4.0).contains(&lost), "{lost}");
}

#[test]
fn vtp_has_as_many_points_as_it_says() {
    let graph = loop_and_line();
    let text = written("vtp", &graph, &[]);
    let points: usize = graph.branches.iter().map(|branch| branch.points.len()).sum();
    assert!(text.contains(&format!("NumberOfPoints=\"{points}\" NumberOfLines=\"3\"")), "{text}");
    let numbers = |name: &str| {
        let body = text.split(&format!("Name=\"{name}\"")).nth(1).unwrap();
        let body = body.split_once('>').unwrap().1.split('<').next().unwrap();
        body.split_whitespace().map(|cell| cell.parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(numbers("points").len(), 3 * points);
    assert_eq!(numbers("radius").len(), points);
    assert_eq!(numbers("connectivity").len(), points);
    assert_eq!(numbers("offsets").last(), Some(&(points as f64)));
    assert_eq!(text.matches('<').count(), text.matches('>').count());
}

#[test]
fn swc_is_read_branch_by_branch() {
    let text = "# a Y and a point\n1 1 0 0 2 .5 -1\n2 0 0 4 2 .5 1\n\n3 0 0 8 2 .5 2\r\n\
                4 0 4 9 2 .5 3\n5 0 -4 9 2 .5 3\n6 0 9 9 2 1 -1\n";
    let curves = read(text, [2.0, 1.0, 1.0]);
    assert_eq!(
        curves,
        [
            vec![[0.0, 8.0, 2.0], [0.0, 4.0, 2.0], [0.0, 0.0, 2.0]],
            vec![[2.0, 9.0, 2.0], [0.0, 8.0, 2.0]],
            vec![[-2.0, 9.0, 2.0], [0.0, 8.0, 2.0]],
            vec![[4.5, 9.0, 2.0]],
        ]
    );
    let file = |text: &str| CurveFile::from_bytes(text.as_bytes(), "a.swc").unwrap();
    assert_eq!(file(text).dimensions(), [3]);
    assert_eq!(file("1 0 1 2 0 1 -1\n").dimensions(), [2, 3]);
    let error = file(text).into_polylines([1.0; 2], None).unwrap_err().to_string();
    assert!(error.contains("lies in a volume, not in a picture"), "{error}");
}

#[test]
fn what_is_no_curve_is_named() {
    for (text, words) in [
        ("", "is empty"),
        ("hello\nworld\n", "no curves"),
        ("1 0 1 2 3 1 -1\n2 0 1 2 3 1\n", "line 2: expected seven"),
        ("1 0 1 2 3 1 -1\n2 0 1 nan 3 1 1\n", "line 2: expected seven"),
        ("# c\n1 0 1 2 3 1 2\n2 0 1 2 3 1 1\n", "line 2: the parent 2 does not stand above"),
        ("1 0 1 2 3 1 1\n", "line 1: the parent 1"),
        ("1 0 1 2 3 1 -1\n1 0 1 2 3 1 1\n", "line 2: the id 1 stands above"),
        ("path,x,y\n0,1,2\n0,1,x\n", "line 3: expected a finite number for y"),
        ("path,x,y\n0,1\n", "line 2"),
        ("{\"points\": []}", "\"paths\""),
        ("{\"paths\": [{\"points\": [[1]]}]}", "two or three numbers"),
        ("{\"paths\": [{\"points\": [[1, 2], [1, null]]}]}", "curve 0"),
        ("{\"paths\": [{\"points\": [[1, 2]]}, {}]}", "curve 1"),
        ("{\"paths\": ", "not valid JSON"),
    ] {
        let error = CurveFile::from_bytes(text.as_bytes(), "odd").unwrap_err().to_string();
        assert!(error.starts_with("odd: ") && error.contains(words), "{text}: {error}");
        assert_eq!(error.lines().count(), 1);
    }
}

proptest! {
    #[test]
    fn any_text_is_curves_or_one_line(text in "[-0-9 .,exyzpath#\n\"{}\\[\\]:]{0,80}") {
        match CurveFile::from_bytes(text.as_bytes(), "any") {
            Ok(file) => {
                let dimension = file.dimensions()[0];
                let finite = if dimension == 2 {
                    file.into_polylines([1.0; 2], None).unwrap().iter().flatten().flatten().all(|x| x.is_finite())
                } else {
                    file.into_polylines([1.0; 3], None).unwrap().iter().flatten().flatten().all(|x| x.is_finite())
                };
                prop_assert!(finite);
            }
            Err(error) => prop_assert_eq!(error.to_string().lines().count(), 1),
        }
    }

    #[test]
    fn trees_of_any_mask_come_back(seed in 1_u64..) {
        let mut state = seed;
        let shape = Shape::with_spacing([9, 8, 7], [1.0, 2.0, 0.5]).unwrap();
        let mask = Grid::from_fn(shape, |_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            state >> 62 == 0
        });
        let graph = Graph::of_mask(&mask);
        let curves = read(&written("swc", &graph, &[]), shape.spacing());
        let (whole, back) = (graph.physical_length(), lengths(&curves, &shape));
        prop_assert!(back <= whole + 1e-9);
        let circles = graph.branches.len() as f64 * 4.0;
        prop_assert!(back >= whole - circles);
    }
}
