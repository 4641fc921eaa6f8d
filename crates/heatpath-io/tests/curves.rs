//! Curves to JSON, CSV and SVG, and points back.

#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use heatpath_core::grid::Shape;
use heatpath_core::grid::keypoints::KeyPoint;
use heatpath_core::grid::path::{Ending, Path};
use heatpath_io::{
    Curves, ReadError, WriteError, curves_json, read_points, read_points_from_bytes, write_curves,
};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::fs;
use tempfile::tempdir;

fn path(points: &[[f64; 2]], ending: Ending, distance: f64) -> Path<2> {
    Path {
        points: points.to_vec(),
        ending,
        length: 5.0,
        physical_length: 10.0,
        distance,
        cost: distance,
    }
}

fn some_curves() -> Curves<2> {
    Curves {
        spacing: [2.0, 2.0],
        placement: None,
        paths: vec![
            path(&[[3.0, 4.0], [0.1, 1.0 / 3.0], [0.0, 0.0]], Ending::Source(1), 7.5),
            path(&[[9.0, -0.5]], Ending::Unreachable, f64::INFINITY),
            path(&[[1.0, 1.0], [2.0, 2.0]], Ending::NotReached, f64::INFINITY),
            path(&[[1.0, 1.0]], Ending::StepLimit, f64::NAN),
        ],
        key_points: Vec::new(),
    }
}

fn written(name: &str, curves: &Curves<2>) -> String {
    let folder = tempdir().unwrap();
    let file = folder.path().join(name);
    write_curves(&file, None, false, curves, &Shape::new([20, 10]).unwrap()).unwrap();
    fs::read_to_string(file).unwrap()
}

#[test]
fn json_has_the_documented_layout() {
    let text = written("curves.json", &some_curves());
    let value: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value, curves_json(&some_curves()));
    assert!(text.starts_with(
        "{\"version\":1,\"dimension\":2,\"spacing\":[2.0,2.0],\"paths\":[{\"points\""
    ));
    assert!(text.ends_with('\n'));
    let first = json!({
        "points": [[3.0, 4.0], [0.1, 1.0 / 3.0], [0.0, 0.0]], "length": 5.0,
        "physical_length": 10.0, "ended": "source", "source": 1, "end": [3.0, 4.0], "distance": 7.5,
        "cost": 7.5
    });
    assert_eq!(value["paths"][0], first);
    let second = json!({
        "points": [[9.0, -0.5]], "length": 5.0, "physical_length": 10.0, "ended": "unreachable",
        "source": null, "end": [9.0, -0.5], "distance": null, "cost": null
    });
    assert_eq!(value["paths"][1], second);
    assert_eq!(value["paths"][2]["ended"], "not_reached");
    assert_eq!(value["paths"][3]["ended"], "step_limit");
    assert!(value["paths"][3]["distance"].is_null() && value.get("keypoints").is_none());
}

#[test]
fn json_knows_volumes() {
    let path = Path {
        points: vec![[1.0, 2.0, 3.0]],
        ending: Ending::Source(0),
        length: 0.0,
        physical_length: 0.0,
        distance: 0.0,
        cost: 0.0,
    };
    let value = curves_json(&Curves {
        spacing: [1.0; 3],
        placement: None,
        paths: vec![path],
        key_points: Vec::new(),
    });
    assert_eq!(
        (&value["dimension"], &value["paths"][0]["end"]),
        (&json!(3), &json!([1.0, 2.0, 3.0]))
    );
}

#[test]
fn volumes_have_a_column_more_and_no_drawing() {
    let folder = tempdir().unwrap();
    let path = Path {
        points: vec![[1.0, 2.0, 0.1], [0.0, 0.5, 3.0]],
        ending: Ending::Source(0),
        length: 0.0,
        physical_length: 0.0,
        distance: 0.0,
        cost: 1.0,
    };
    let points = path.points.clone();
    let curves = Curves {
        spacing: [1.0, 1.0, 2.5],
        placement: None,
        paths: vec![path],
        key_points: Vec::new(),
    };
    let shape = Shape::with_spacing([4, 4, 4], curves.spacing).unwrap();
    let file = folder.path().join("a.csv");
    write_curves(&file, None, false, &curves, &shape).unwrap();
    let text = fs::read_to_string(&file).unwrap();
    assert_eq!(text, "path,point,x,y,z,ended\n0,0,1.0,2.0,0.1,source\n0,1,0.0,0.5,3.0,source\n");
    assert_eq!(read_points(&file).unwrap(), points);
    let file = folder.path().join("a.svg");
    let error = write_curves(&file, None, false, &curves, &shape).unwrap_err();
    assert!(matches!(error, WriteError::Volume { .. }) && !file.exists(), "{error}");
}

#[test]
fn points_in_volumes_have_three_coordinates() {
    for text in [
        "1,2,3\n4.5,-5,6e1\n",
        "name,Z,Y,X\na,3,2,1\nb,60,-5,4.5\n",
        "[[1, 2, 3], {\"x\": 4.5, \"y\": -5, \"z\": 60}]",
    ] {
        let points = read_points_from_bytes::<3>(text.as_bytes(), "points").unwrap();
        assert_eq!(points, [[1.0, 2.0, 3.0], [4.5, -5.0, 60.0]], "{text}");
    }
    for (text, reason) in [
        ("1,2\n", "line 1: expected three numbers x,y,z, found \"1,2\""),
        (
            "x,y\n1,2\n",
            "line 1: expected three numbers x,y,z or a header line with columns x and y and z",
        ),
        ("1,2,nan\n", "line 1: expected a finite number for z, found \"nan\""),
        ("[[1, 2]]", "entry 0: expected [x, y, z] or {\"x\": x, \"y\": y, \"z\": z}, found [1,2]"),
    ] {
        let error = read_points_from_bytes::<3>(text.as_bytes(), "p").unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
    let error = read_points_from_bytes::<2>(b"[[1, 2, 3]]", "p").unwrap_err().to_string();
    assert!(error.contains("expected [x, y]"), "{error}");
}

#[test]
fn csv_has_a_row_for_each_point() {
    let text = written("curves.csv", &some_curves());
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 1 + 3 + 1 + 2 + 1);
    assert_eq!(lines[0], "path,point,x,y,ended");
    assert_eq!(lines[1], "0,0,3.0,4.0,source");
    assert_eq!(lines[2], "0,1,0.1,0.3333333333333333,source");
    assert_eq!(lines[4], "1,0,9.0,-0.5,unreachable");
    let points: Vec<_> = some_curves().paths.into_iter().flat_map(|path| path.points).collect();
    assert_eq!(read_points_from_bytes(text.as_bytes(), "curves.csv").unwrap(), points);
}

#[test]
fn svg_lies_over_the_picture() {
    let text = written("curves.svg", &some_curves());
    assert!(text.contains("viewBox=\"-0.5 -0.5 20 10\"") && text.contains("</svg>"));
    assert_eq!(text.matches("<polyline").count(), 2);
    assert!(text.contains("points=\"3,4 0.1,0.333 0,0\""));
    assert_eq!(text.matches("class=\"end\"").count(), 4);
    assert_eq!(text.matches("class=\"source\"").count(), 1);
    assert_eq!(text.matches("class=\"open\"").count(), 1);
    // Every bracket that opens closes.
    assert_eq!(text.matches('<').count(), text.matches('>').count());
}

#[test]
fn other_endings_are_refused() {
    let error = write_curves("a.xyz", None, false, &some_curves(), &Shape::new([1, 1]).unwrap())
        .unwrap_err();
    assert!(matches!(error, WriteError::Ending { .. }));
    assert!(error.to_string().contains(".json, .csv, .svg"));
}

#[test]
fn points_in_all_their_dresses() {
    for text in [
        "1,2\n3.5,-4\n",
        "x,y\n1,2\n3.5,-4",
        "id,Y,weight,X\na,2,0,1\nb,-4,0,3.5\n",
        "\u{feff}x, y\r\n 1 , 2 \r\n\r\n# a comment\r\n\"3.5\",-4e0\r\n",
        "[[1, 2], [3.5, -4]]",
        " {\"points\": [[1, 2], [3.5, -4]], \"note\": \"\"}",
        "[{\"x\": 1, \"y\": 2, \"z\": 0}, {\"y\": -4, \"x\": 3.5}]",
    ] {
        let points = read_points_from_bytes(text.as_bytes(), "points").unwrap();
        assert_eq!(points, [[1.0, 2.0], [3.5, -4.0]], "{text}");
    }
}

#[test]
fn errors_name_the_line_or_the_entry() {
    for (text, place) in [
        ("1,2\n3\n", "line 2"),
        ("1,2,3\n", "line 1"),
        ("1,2\n\n# c\n3,four\n", "line 4"),
        ("# c\n \n1,2\n  \n3,\n", "line 5"),
        ("x,y\n1,inf\n", "line 2"),
        ("x,y\n1\n", "line 2"),
        ("a,b\n1,2\n", "line 1"),
        ("1;2\n", "line 1"),
        ("[[1, 2], [3]]", "entry 1"),
        ("[[1, 2], [3, \"4\"]]", "entry 1"),
        ("[{\"x\": 1}]", "entry 0"),
        ("[1, 2]", "entry 0"),
        ("{\"paths\": []}", "the file"),
        ("{\"points\": 3}", "the file"),
        ("[[1, 2],\n[3", "line 2"),
        ("[[1e999, 0]]", "line 1"),
        ("", "the file"),
        ("[]", "the file"),
        ("x,y\n", "the file"),
    ] {
        let error = read_points_from_bytes::<2>(text.as_bytes(), "points").unwrap_err();
        let line = error.to_string();
        assert!(
            line.starts_with(&format!("points: {place}: ")) && line.lines().count() == 1,
            "{line}"
        );
        assert!(matches!(error, ReadError::Points { .. }) && !error.is_access());
    }
    assert!(read_points::<2>("no/such/points.csv").unwrap_err().is_access());
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-0.5..4096.0, any::<f64>().prop_filter("finite", |v| v.is_finite())]
}

proptest! {
    #[test]
    fn coordinates_survive_csv_and_json(
        points in prop::collection::vec([coordinate(), coordinate()], 1..20)
    ) {
        let curves = Curves { spacing: [1.0; 2], placement: None, paths: vec![path(&points, Ending::Source(0), 1.0)], key_points: Vec::new() };
        let csv = written("a.csv", &curves);
        prop_assert_eq!(&read_points_from_bytes(csv.as_bytes(), "a.csv").unwrap(), &points);
        let json = serde_json::to_string(&json!({ "points": points })).unwrap();
        let back = read_points_from_bytes::<2>(json.as_bytes(), "a.json").unwrap();
        // The JSON reader may miss the last bit of a number.
        for (a, b) in points.iter().flatten().zip(back.iter().flatten()) {
            prop_assert!((a - b).abs() <= 2.0 * f64::EPSILON * a.abs() + 1e-300);
        }
    }

    #[test]
    fn no_text_panics(text in "(?s).{0,60}|[\\[\\]{}\",:xy0-9eE.\n-]{0,60}") {
        let _ = read_points_from_bytes::<2>(text.as_bytes(), "points");
        let _ = read_points_from_bytes::<3>(text.as_bytes(), "points");
    }
}

#[test]
fn key_points_stand_beside_their_paths() {
    let key_point = |point, parent| KeyPoint { point, parent, ln_temperature: None };
    let curves = Curves {
        key_points: vec![key_point([0.0, 0.0], None), key_point([3.0, 4.0], Some(0))],
        ..some_curves()
    };
    let value = curves_json(&curves);
    assert_eq!(value["keypoints"][0]["parent"], Value::Null);
    assert_eq!(value["keypoints"][1], serde_json::json!({ "point": [3.0, 4.0], "parent": 0 }));
    assert!(curves_json(&some_curves()).get("keypoints").is_none());
}
