//! `heatpath evaluate`, run as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use image::{GrayImage, Luma};
use serde_json::{Value, json};
use std::fs;

/// A line from 10,20 to 50,20 as curves and as a mask, and one beside three quarters of it.
fn bench() -> Bench {
    let bench = Bench::new();
    let curves = |y: f64, end: f64| {
        json!({ "version": 1, "dimension": 2, "spacing": [1.0, 1.0],
                "paths": [{ "points": [[end, y], [10.0, y]] }] })
        .to_string()
    };
    fs::write(bench.path("truth.json"), curves(20.0, 50.0)).unwrap();
    fs::write(bench.path("found.json"), curves(21.0, 40.0)).unwrap();
    let line = |x: u32, y: u32| Luma([if y == 20 && (10..=50).contains(&x) { 255 } else { 0 }]);
    GrayImage::from_fn(64, 40, line).save(bench.path("truth.png")).unwrap();
    let right = |x: u32, _: u32| Luma([if x >= 30 { 255 } else { 0 }]);
    GrayImage::from_fn(64, 40, right).save(bench.path("view.png")).unwrap();
    bench
}

fn number(report: &Value, key: &str) -> f64 {
    report[key].as_f64().unwrap()
}

#[test]
fn one_tolerance_is_one_object_with_the_promised_fields_first() {
    let bench = bench();
    for truth in ["truth.json", "truth.png"] {
        let arguments =
            format!("evaluate --extracted found.json --truth {truth} --tolerance 1 --json");
        let text = bench.ok(&arguments);
        let start = "{\"tolerance\":1.0,\"recall\":0.75,\"precision\":1.0,\"f1\":";
        assert!(text.starts_with(start), "{text}");
        let keys =
            ["\"f1\"", "\"truth_length\"", "\"extracted_length\"", "\"truth_mean_distance\""];
        let places: Vec<_> = keys.iter().map(|key| text.find(key).unwrap()).collect();
        assert!(places.is_sorted(), "{text}");
        let report: Value = serde_json::from_str(&text).unwrap();
        assert!((number(&report, "truth_length") - 40.0).abs() < 1e-9);
        assert!((number(&report, "extracted_length") - 30.0).abs() < 1e-9);
        assert_eq!(report["extracted_mean_distance"], 1.0);
    }
}

#[test]
fn several_tolerances_are_a_list_and_a_table() {
    let bench = bench();
    let arguments = "evaluate --extracted found.json --truth truth.png --tolerance 0.5 \
                     --tolerance 1 --tolerance 20";
    let list = bench.json(&format!("{arguments} --json -o scores.json"));
    let recalls: Vec<f64> =
        list.as_array().unwrap().iter().map(|report| number(report, "recall")).collect();
    assert_eq!(recalls, [0.0, 0.75, 1.0]);
    let file: Value =
        serde_json::from_str(&fs::read_to_string(bench.path("scores.json")).unwrap()).unwrap();
    assert_eq!(file, list);
    let table = bench.ok(&format!("{arguments} -o scores.csv"));
    assert_eq!(table.lines().count(), 6, "{table}");
    assert!(
        table.starts_with(" tolerance   recall precision       f1\n       0.5   0.0000"),
        "{table}"
    );
    let csv = fs::read_to_string(bench.path("scores.csv")).unwrap();
    assert!(
        csv.starts_with("tolerance,recall,precision,f1,truth_length,extracted_length,"),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 4);
    assert!(csv.lines().nth(2).unwrap().starts_with("1.0,0.75,1.0,"), "{csv}");
    assert_eq!(bench.ok(&format!("{arguments} --quiet")), "");
}

#[test]
fn a_field_of_view_and_a_spacing_count() {
    let bench = bench();
    let arguments = "evaluate --extracted found.json --truth truth.png --mask view.png";
    let report = bench.json(&format!("{arguments} --tolerance 1 --json"));
    assert!((number(&report, "truth_length") - 20.5).abs() < 0.26, "{report}");
    assert!((number(&report, "recall") - 0.5).abs() < 0.02, "{report}");
    let report = bench.json(&format!("{arguments} --spacing 0.5,3 --tolerance 2.9 --json"));
    assert_eq!(report["recall"], 0.0);
    assert!((number(&report, "extracted_length") - 5.25).abs() < 0.2, "{report}");
    assert!((number(&report, "extracted_mean_distance") - 3.0).abs() < 1e-9, "{report}");
}

#[test]
fn paths_of_the_command_can_be_compared_in_any_format() {
    let bench = Bench::with_picture();
    for ending in ["json", "csv", "swc"] {
        bench.ok(&format!(
            "path curve.png --source 10,51 --end 90,54 --end 60,27 -o p.{ending} --spacing 0.5,0.5"
        ));
        let report = bench.json(&format!(
            "evaluate --extracted p.{ending} --truth p.json --spacing 0.5,0.5 --tolerance 0 --json"
        ));
        assert!(
            number(&report, "recall") > 0.999 && number(&report, "precision") > 0.999,
            "{report}"
        );
    }
    bench.ok("path curve.png --source 10,51 --end 90,54 -o p.vtp");
    assert!(fs::read_to_string(bench.path("p.vtp")).unwrap().contains("</VTKFile>"));
}

#[test]
fn volumes_can_be_compared() {
    let bench = Bench::new();
    bench.write_npy("tube.npy", &[9, 9, 30], |i| {
        let (x, y, z) = (i % 30, i / 30 % 9, i / 270);
        f64::from(u8::from((3..27).contains(&x) && (3..6).contains(&y) && (3..6).contains(&z)))
    });
    fs::write(bench.path("line.swc"), "# a line\n1 0 4 4 4 1 -1\n2 0 24 4 4 1 1\n").unwrap();
    let report = bench.json("evaluate --extracted tube.npy --truth line.swc --tolerance 1 --json");
    assert_eq!(report["truth_length"], 20.0);
    assert_eq!((number(&report, "recall"), number(&report, "precision")), (1.0, 1.0));
}

#[test]
fn errors_are_one_line() {
    let bench = bench();
    GrayImage::new(30, 40).save(bench.path("small.png")).unwrap();
    fs::write(bench.path("odd.txt"), "no curves here\n").unwrap();
    fs::write(bench.path("solid.swc"), "1 0 4 4 4 1 -1\n2 0 24 4 4 1 1\n").unwrap();
    fs::write(bench.path("far.csv"), "x,y\n0,0\n1e12,0\n").unwrap();
    let pair = "evaluate --extracted found.json --truth truth.png";
    for tolerance in ["-1", "nan", "inf"] {
        bench.fails(&format!("{pair} --tolerance {tolerance}"), 2, &["tolerance", "at least 0"]);
    }
    bench.fails(
        "evaluate --extracted small.png --truth truth.png --tolerance 1",
        3,
        &["truth.png: has 64 x 40 pixels but small.png has 30 x 40"],
    );
    bench.fails(&format!("{pair} --tolerance 1 --mask small.png"), 3, &["small.png", "30 x 40"]);
    bench.fails(&format!("{pair} --tolerance 1 --spacing 1,0"), 2, &["spacing"]);
    bench.fails(&format!("{pair} --tolerance 1 --spacing 1,1,1"), 2, &["spacing", "picture"]);
    for (file, code, words) in [
        ("odd.txt", 3, ["odd.txt", "no curves"]),
        ("solid.swc", 3, ["solid.swc", "volume"]),
        ("far.csv", 3, ["far.csv", "1e9 cells"]),
        ("none.json", 4, ["none.json", "cannot be read"]),
    ] {
        bench.fails(
            &format!("evaluate --extracted {file} --truth truth.png --tolerance 1"),
            code,
            &words,
        );
    }
    bench.fails(&format!("{pair} --tolerance 1 -o s.txt"), 2, &["s.txt", ".json, .csv"]);
    fs::write(bench.path("there.json"), "").unwrap();
    bench.fails(&format!("{pair} --tolerance 1 -o there.json"), 4, &["--force"]);
}
