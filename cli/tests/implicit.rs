//! `--solver implicit` through the command, as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use serde_json::json;
use std::fs;

/// The largest relative deviation from the straight distance, in physical units, of an even picture
/// or volume of `shape` (slices, rows, columns), beyond 6 units and at least 8 cells from the border.
fn worst(values: &[f64], shape: [usize; 3], source: [usize; 3], spacing: [f64; 3]) -> f64 {
    let [slices, rows, columns] = shape;
    let deviation = |(i, value): (usize, &f64)| {
        let cell = [i % columns, i / columns % rows, i / columns / rows];
        let sides = [columns, rows, slices];
        let inside = (0..3).all(|a| sides[a] == 1 || (cell[a] >= 8 && cell[a] + 8 < sides[a]));
        let squares = (0..3).map(|a| (spacing[a] * (cell[a] as f64 - source[a] as f64)).powi(2));
        let exact = squares.sum::<f64>().sqrt();
        (inside && exact > 6.0).then(|| (value / exact - 1.0).abs())
    };
    values.iter().enumerate().filter_map(deviation).fold(0.0, f64::max)
}

#[test]
fn distances_in_an_even_picture_are_straight() {
    let bench = Bench::with_picture();
    let report = bench.json(
        "distance curve.png --medium uniform --solver implicit --source 30,40 -o d.npy --json",
    );
    assert_eq!((&report["solver"], &report["iterations"]), (&json!("implicit"), &json!(1)));
    assert_eq!((&report["time"], &report["step"]), (&json!(16.0), &json!(16.0)));
    assert_eq!((&report["reached"], &report["unreached"]), (&json!(8000), &json!(0)));
    let worst = worst(&bench.npy("d.npy").1, [1, 80, 100], [30, 40, 0], [1.0; 3]);
    println!("largest relative error: {worst:.4}");
    assert!(worst < 0.02, "largest relative error {worst}");
    let explicit = bench.json("distance curve.png --source 30,40 --json");
    assert_eq!(explicit["solver"], "explicit");
}

#[test]
fn distances_in_an_even_volume_are_straight() {
    let bench = Bench::new();
    bench.write_npy("even.npy", &[20, 40, 44], |_| 1.0);
    let arguments = "distance even.npy --medium uniform --spacing 1,1,2 --solver implicit \
                     --source 15,20,10 --threads 2 -o d.npy";
    bench.ok(arguments);
    let worst = worst(&bench.npy("d.npy").1, [20, 40, 44], [15, 20, 10], [1.0, 1.0, 2.0]);
    println!("largest relative error: {worst:.4}");
    assert!(worst < 0.05, "largest relative error {worst}");
}

/// The mean relative difference of two fields where the first is above 5.
fn mean_difference(first: &[f64], second: &[f64]) -> f64 {
    let far: Vec<f64> = first
        .iter()
        .zip(second)
        .filter(|(a, _)| **a > 5.0)
        .map(|(a, b)| (b / a - 1.0).abs())
        .collect();
    far.iter().sum::<f64>() / far.len() as f64
}

#[test]
fn both_solvers_see_the_same_distances_and_paths() {
    let bench = Bench::with_picture();
    bench.write_npy("p.npy", &[80, 100], |i| {
        0.5 + 0.5 * (0.05 * (i % 100) as f64).sin() * (0.06 * (i / 100) as f64).cos()
    });
    bench.write_npy("v.npy", &[30, 32, 34], |i| 0.5 + 0.2 * (0.1 * (i % 34) as f64).sin());
    let fields = |input: &str, source: &str| {
        ["explicit", "implicit"].map(|solver| {
            bench.ok(&format!(
                "distance {input} --solver {solver} --range 0,1 --power 1 --source {source} -o {solver}.npy \
                 --force"
            ));
            bench.npy(&format!("{solver}.npy")).1
        })
    };
    for (input, source, limit) in [("p.npy", "10,51", 0.03), ("v.npy", "16,15.5,14", 0.07)] {
        let [explicit, implicit] = fields(input, source);
        let difference = mean_difference(&explicit, &implicit);
        println!("{input}: mean relative difference {difference:.4}");
        assert!(difference < limit, "{input}: mean relative difference {difference}");
    }
    let length = |solver: &str| {
        let curves = bench.json(&format!(
            "path curve.png --solver {solver} --source 10,51 --end 90,54 --power 6 --json"
        ));
        assert_eq!(curves["paths"][0]["ended"], "source", "{solver}");
        curves["paths"][0]["length"].as_f64().unwrap()
    };
    let ratio = length("implicit") / length("explicit");
    assert!((ratio - 1.0).abs() < 0.05, "lengths differ by {ratio}");
    let volume = bench.json(
        "path v.npy --solver implicit --time 4 --iterations 2 --source 5,5.5,4 --end 20,15,10 \
         --face-mean arithmetic --json",
    );
    assert_eq!(volume["paths"][0]["ended"], "source");
}

#[test]
fn time_and_iterations_go_together() {
    let bench = Bench::with_picture();
    let report = bench.json(
        "distance curve.png --solver implicit --time 12 --iterations 3 --estimator varadhan \
         --source 10,51 -o d.npy --json",
    );
    assert_eq!((&report["iterations"], &report["time"]), (&json!(3), &json!(12.0)));
    assert_eq!(report["step"], 4.0);
    bench.ok("distance curve.png --solver implicit --source 10,51 -o a.npy --threads 1");
    bench.ok("distance curve.png --solver implicit --source 10,51 -o b.npy --threads 3");
    let read = |name: &str| fs::read(bench.path(name)).unwrap();
    assert!(read("a.npy") == read("b.npy") && read("a.npy") != read("d.npy"));
}

#[test]
fn options_of_the_other_solver_are_refused() {
    let bench = Bench::with_picture();
    let fails = |options: &str, words: &[&str]| {
        bench.fails(&format!("distance curve.png --source 5,5 -o x.npy {options}"), 2, words);
        bench.fails(&format!("path curve.png --source 5,5 --end 9,9 --json {options}"), 2, words);
    };
    fails("--solver implicit --step 0.1", &["--step", "explicit"]);
    fails("--solver implicit --step auto", &["--step", "explicit"]);
    fails("--memory 2", &["--memory", "--solver implicit"]);
    fails("--iterations 5 --time 3", &["--iterations", "--time", "both"]);
    fails("--solver implicit --time 0", &["time is 0", "positive"]);
    fails("--solver implicit --time nan", &["time is NaN", "positive"]);
    fails("--solver implicit --time 1e30", &["too long", "at most"]);
    fails("--solver implicit --iterations 0", &["steps is 0", "1000"]);
    fails("--solver implicit --memory 0", &["--memory is 0", "positive"]);
    fails("--solver implicit --memory nan", &["--memory is NaN", "positive"]);
}

#[test]
fn what_is_too_large_is_refused_with_the_memory_it_needs() {
    let bench = Bench::with_picture();
    let words = ["MiB of memory, 1.0 MiB are allowed", "--solver explicit", "--memory"];
    let arguments = "distance curve.png --solver implicit --source 5,5 -o x.npy --memory";
    bench.fails(&format!("{arguments} 0.001"), 3, &words);
    bench.ok(&format!("{arguments} 0.1"));
    bench.write_npy("v.npy", &[30, 30, 30], |i| (i % 7) as f64);
    let arguments = "path v.npy --solver implicit --source 5,5,5 --end 9,9,9 --json --memory 0.001";
    bench.fails(arguments, 3, &words);
}
