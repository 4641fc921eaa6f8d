//! `--estimator eikonal` through the command, as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use serde_json::{Value, json};

/// The largest deviation from the lengths that `exact` gives for the steps along x, y and z.
fn worst(
    values: &[f64],
    [columns, rows]: [usize; 2],
    source: [f64; 3],
    exact: impl Fn([f64; 3]) -> f64,
) -> f64 {
    let deviation = |(i, value): (usize, &f64)| {
        let cell = [i % columns, i / columns % rows, i / columns / rows];
        (value - exact(std::array::from_fn(|axis| cell[axis] as f64 - source[axis]))).abs()
    };
    values.iter().enumerate().map(deviation).fold(0.0, f64::max)
}

#[test]
fn distances_in_an_even_picture_are_exact() {
    let bench = Bench::with_picture();
    let arguments = "distance curve.png --medium uniform --estimator eikonal --source 30.25,40";
    let report = bench.json(&format!("{arguments} -o d.npy --json"));
    assert_eq!((&report["estimator"], &report["solver"]), (&json!("eikonal"), &Value::Null));
    for key in ["iterations", "time", "step"] {
        assert!(report[key].is_null(), "{key}");
    }
    assert_eq!((&report["reached"], &report["unreached"]), (&json!(8000), &json!(0)));
    assert_eq!(report["seconds"]["heat"], 0.0);
    assert!(report["seconds"]["distance"].as_f64().unwrap() > 0.0);
    let (_, values) = bench.npy("d.npy");
    let error = worst(&values, [100, 80], [30.25, 40.0, 0.0], |[x, y, _]| x.hypot(y));
    assert!(error < 1e-7, "largest error {error}");
    assert_eq!(report["max"], values.iter().copied().fold(0.0, f64::max));

    let words = String::from_utf8(bench.run(&format!("{arguments} -o d.tif")).stderr).unwrap();
    assert!(words.contains("8000 cells reached") && words.contains("eikonal in"), "{words}");
    assert!(!words.contains("iterations"), "{words}");
    let heat = bench.json("distance curve.png --source 30,40 --json");
    assert_eq!((&heat["estimator"], &heat["solver"]), (&json!("normalized"), &json!("explicit")));
}

#[test]
fn distances_in_an_even_volume_are_exact() {
    let bench = Bench::new();
    bench.write_npy("even.npy", &[12, 20, 24], |_| 1.0);
    bench
        .ok("distance even.npy --medium uniform --estimator eikonal --spacing 1,0.5,2.5 --source \
              15,10.5,7 -o d.npy");
    let length = |[x, y, z]: [f64; 3]| (x * x + 0.25 * y * y + 6.25 * z * z).sqrt();
    let error = worst(&bench.npy("d.npy").1, [24, 20], [15.0, 10.5, 7.0], length);
    assert!(error < 1e-7, "largest error {error}");
}

#[test]
fn paths_end_at_their_source_and_know_the_distance() {
    let bench = Bench::with_picture();
    bench.write_npy("v.npy", &[14, 18, 22], |i| 0.5 + 0.4 * (0.2 * (i % 22) as f64).sin());
    for (input, source, end, cell) in [
        ("curve.png", "10,51.2", "90,55", 55 * 100 + 90),
        ("v.npy", "3,4.5,2", "20,15,10", (10 * 18 + 15) * 22 + 20),
    ] {
        for medium in ["uniform", "conductivity", "perona-malik", "combined", "edges"] {
            let options = format!("--estimator eikonal --medium {medium} --source {source}");
            bench.ok(&format!("distance {input} {options} -o d.npy --force"));
            let curves = bench.json(&format!("path {input} {options} --end {end} --json"));
            let path = &curves["paths"][0];
            assert_eq!(path["ended"], "source", "{input}, {medium}");
            let (distance, map) = (path["distance"].as_f64().unwrap(), bench.npy("d.npy").1[cell]);
            // Numbers of JSON are read with an error in the last digit.
            assert!((distance / map - 1.0).abs() < 1e-15, "{input}, {medium}: {distance}, {map}");
        }
    }
}

#[test]
fn a_path_that_is_no_shortest_one_is_told() {
    let bench = Bench::new();
    // Three corridors, joined at the right and at the left.
    let is_open = |x: usize, y: usize| y % 12 < 3 || if y < 12 { x > 40 } else { x < 3 };
    bench.write_npy("bends.npy", &[27, 44], |i| if is_open(i % 44, i / 44) { 1.0 } else { 1e-4 });
    let path = "path bends.npy --medium file --medium-file bends.npy --source 1,1 --end 42,25 \
                --force -o p.json";
    let stderr =
        |options: &str| String::from_utf8(bench.run(&format!("{path} {options}")).stderr).unwrap();
    assert!(stderr("").contains("warning: path 0 costs"), "{}", stderr(""));
    assert!(stderr("").contains("--estimator eikonal"), "{}", stderr(""));
    assert!(!stderr("--estimator eikonal").contains("warning"));
    assert_eq!(stderr("--quiet"), "");
    let curves = bench.json(&format!("{path} --estimator eikonal --json"));
    let [cost, distance] =
        ["cost", "distance"].map(|key| curves["paths"][0][key].as_f64().unwrap());
    assert!(cost < 1.5 * distance, "{cost} {distance}");
}

#[test]
fn walls_are_walked_around() {
    let bench = Bench::with_picture();
    let wall = |i: usize| f64::from(u8::from(i % 100 != 50 || i / 100 > 70));
    bench.write_npy("gap.npy", &[80, 100], wall);
    bench.write_npy("wall.npy", &[80, 100], |i| f64::from(u8::from(i % 100 != 50)));
    let arguments =
        "path curve.png --medium uniform --estimator eikonal --source 30,20 --end 70,20";
    let around = bench.json(&format!("{arguments} --mask gap.npy --json"));
    let length = around["paths"][0]["length"].as_f64().unwrap();
    // By way of the cells 49,71 and 51,71 at the wall's end.
    let shortest = 2.0 * 19.0_f64.hypot(51.0) + 2.0;
    assert!((length / shortest - 1.0).abs() < 0.02, "{length} instead of {shortest}");
    let output = bench.run(&format!("{arguments} --mask wall.npy -o p.json"));
    assert_eq!(output.status.code(), Some(5));
    assert!(String::from_utf8(output.stderr).unwrap().contains("walls"));
}

#[test]
fn nothing_is_reached_beyond_the_farthest_distance() {
    let bench = Bench::with_picture();
    let uniform = "--medium uniform --estimator eikonal --source 30,40";
    let report =
        bench.json(&format!("distance curve.png {uniform} --farthest 10.5 -o d.npy --json"));
    let inside = |i: usize| (i % 100).abs_diff(30).pow(2) + (i / 100).abs_diff(40).pow(2) <= 110;
    let (_, values) = bench.npy("d.npy");
    for (i, value) in values.iter().enumerate() {
        assert_eq!(value.is_finite(), inside(i), "cell {i} at {value}");
    }
    assert_eq!(report["reached"], (0..8000).filter(|&i| inside(i)).count());
    assert_eq!(report["unreached"], (0..8000).filter(|&i| !inside(i)).count());

    let ends = "--end 35,40 --end 60,40 -o p.json";
    let output = bench.run(&format!("path curve.png {uniform} --farthest 10.5 {ends}"));
    assert_eq!(output.status.code(), Some(5));
    let words = String::from_utf8(output.stderr).unwrap();
    assert!(words.contains("1 of 2 paths") && words.contains("beyond --farthest"), "{words}");
    let file = std::fs::read_to_string(bench.path("p.json")).unwrap();
    let curves: Value = serde_json::from_str(&file).unwrap();
    assert_eq!(curves["paths"][0]["ended"], "source");
    assert_eq!(curves["paths"][1]["ended"], "not_reached");

    let near = "distance curve.png --medium uniform --estimator eikonal --source 30.5,40";
    bench.fails(&format!("{near} --farthest 0.1 -o x.npy"), 5, &["--farthest"]);
}

#[test]
fn options_of_heat_are_refused() {
    let bench = Bench::with_picture();
    let fails = |options: &str, words: &[&str]| {
        bench.fails(&format!("distance curve.png --source 5,5 -o x.npy {options}"), 2, words);
        bench.fails(&format!("path curve.png --source 5,5 --end 9,9 --json {options}"), 2, words);
    };
    for option in [
        "--solver explicit",
        "--solver implicit",
        "--iterations 100",
        "--time 3",
        "--step auto",
        "--memory 1",
        "--face-mean harmonic",
    ] {
        let name = option.split(' ').next().unwrap();
        fails(&format!("--estimator eikonal {option}"), &[name, "eikonal"]);
    }
    fails("--farthest 5", &["--farthest", "--estimator eikonal"]);
    fails("--estimator varadhan --farthest 5", &["--farthest", "--estimator eikonal"]);
    for bad in ["0", "-3", "nan"] {
        fails(&format!("--estimator eikonal --farthest {bad}"), &["--farthest", "positive"]);
    }
}

#[test]
fn a_tensor_field_is_the_diffusion() {
    let bench = Bench::with_picture();
    // Lengths are sqrt(dx' D^-1 dx).
    bench.write_npy("plane.npy", &[80, 100, 3], |i| [4.0, 1.0, 2.0][i % 3]);
    let arguments = "distance curve.png --medium file --medium-file plane.npy --source 30.2,40.3";
    let report = bench.json(&format!("{arguments} --estimator eikonal -o d.npy --json"));
    assert_eq!(report["reached"], 8000);
    let length = |[x, y, _]: [f64; 3]| ((2.0 * x * x - 2.0 * x * y + 4.0 * y * y) / 7.0).sqrt();
    let error = worst(&bench.npy("d.npy").1, [100, 80], [30.2, 40.3, 0.0], length);
    assert!(error < 1e-7, "largest error {error}");
    let curves = bench.json(
        "path curve.png --medium file --medium-file plane.npy --estimator eikonal --source 30,40 \
         --end 80,20 --end 10,70 --json",
    );
    for path in curves["paths"].as_array().unwrap() {
        let [x, y] = [0, 1].map(|axis| path["end"][axis].as_f64().unwrap() - [30.0, 40.0][axis]);
        let (measured, straight) = (path["length"].as_f64().unwrap(), x.hypot(y));
        assert!((measured / straight - 1.0).abs() < 1e-3, "{measured}, not {straight}");
    }
    let medium = bench.json("medium curve.png --medium file --medium-file plane.npy --json");
    assert!((medium["mean"].as_f64().unwrap() - 7.0_f64.sqrt()).abs() < 1e-12);

    bench.write_npy("v.npy", &[14, 18, 22], |_| 1.0);
    bench.write_npy("space.npy", &[14, 18, 22, 6], |i| [2.0, 0.5, 0.3, 4.0, 0.2, 1.0][i % 6]);
    bench.ok("distance v.npy --medium file --medium-file space.npy --estimator eikonal --source \
              5,6,7 -o s.npy");
    let length = |[x, y, z]: [f64; 3]| {
        let squares = 3.96 * x * x + 1.91 * y * y + 7.75 * z * z;
        ((squares - 0.88 * x * y - 2.2 * x * z - 0.5 * y * z) / 7.37).sqrt()
    };
    let error = worst(&bench.npy("s.npy").1, [22, 18], [5.0, 6.0, 7.0], length);
    assert!(error < 1e-7, "largest error {error}");
}

#[test]
fn wrong_tensor_fields_are_refused() {
    let bench = Bench::with_picture();
    let fails = |file: &str, options: &str, code: i32, words: &[&str]| {
        bench.fails(
            &format!(
                "distance curve.png --medium file --medium-file {file} --estimator eikonal \
                 --source 5,5 -o x.npy {options}"
            ),
            code,
            words,
        );
    };
    let identity = |i: usize| [1.0, 0.0, 1.0][i % 3];
    bench.write_npy("good.npy", &[80, 100, 3], identity);
    bench.write_npy("small.npy", &[80, 99, 3], identity);
    bench.write_npy(
        "flat.npy",
        &[80, 100, 3],
        |i| if i == 3 * 205 + 2 { 0.0 } else { identity(i) },
    );
    bench.write_npy("nan.npy", &[80, 100, 3], |i| if i == 1 { f64::NAN } else { identity(i) });
    bench.write_npy("space.npy", &[4, 80, 100, 6], |i| identity(i / 2));
    fails("good.npy", "--form pointwise", 2, &["good.npy", "--form", "tensors"]);
    fails("small.npy", "", 3, &["small.npy", "99 x 80", "100 x 80"]);
    fails("flat.npy", "", 3, &["flat.npy", "[5, 2]", "positive definite"]);
    fails("nan.npy", "", 3, &["nan.npy", "[0, 0]", "NaN"]);
    fails("space.npy", "", 3, &["space.npy", "tensors"]);
    bench.fails("distance space.npy --source 5,5,1 -o x.npy", 3, &["space.npy", "tensors"]);
    let arguments = "distance curve.png --source 5,5 -o x.npy --mask space.npy";
    bench.fails(arguments, 3, &["space.npy", "tensors"]);
}
