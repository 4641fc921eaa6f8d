//! Curves that are found without ends, through the command: votes and key points.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use serde_json::Value;
use std::fs;

/// A picture of 120 x 100 pixels with a bright fork, `fork.npy`, and its middle as a mask, `truth.npy`.
fn fork() -> Bench {
    let bench = Bench::new();
    // From the left to a junction, and from there up and down to the right.
    let off = |cell: usize| {
        let (x, y) = ((cell % 120) as f64, (cell / 120) as f64);
        let arms = if x < 50.0 { 50.0 } else { 50.0 + 0.6 * (x - 50.0) };
        (x, (y - arms).abs().min((y - 100.0 + arms).abs()))
    };
    bench.write_npy("fork.npy", &[100, 120], |cell| {
        let (x, off) = off(cell);
        let noise =
            (12.9898 * (cell % 120) as f64 + 78.233 * (cell / 120) as f64).sin() * 43758.5453;
        let inside = (5.0..115.0).contains(&x);
        0.05 * (noise - noise.floor()) + if inside { 0.9 * (-off * off / 6.0).exp() } else { 0.0 }
    });
    bench.write_npy("truth.npy", &[100, 120], |cell| {
        let (x, off) = off(cell);
        f64::from(u8::from(off <= 0.5 && (5.0..115.0).contains(&x)))
    });
    bench
}

fn scores(bench: &Bench, extracted: &str) -> (f64, f64) {
    let report = bench
        .json(&format!("evaluate --extracted {extracted} --truth truth.npy --tolerance 2 --json"));
    (report["recall"].as_f64().unwrap(), report["precision"].as_f64().unwrap())
}

/// The branches or paths of a file; each must have ended at a source.
fn paths(text: &str) -> Vec<Value> {
    let paths = serde_json::from_str::<Value>(text).unwrap()["paths"].as_array().unwrap().clone();
    assert!(paths.iter().all(|path| path["ended"] == "source"));
    paths
}

#[test]
fn votes_find_the_tree_by_themselves() {
    let bench = fork();
    for options in ["", "--medium vesselness", "--medium vesselness --source 20,50"] {
        let printed = bench.ok(&format!("vote fork.npy {options} -o tree.json --force --json"));
        assert_eq!(paths(&printed).len(), 3, "{options}");
        let (recall, precision) = scores(&bench, "tree.json");
        assert!(recall > 0.95 && precision > 0.95, "{options}: {recall} {precision}");
    }
    let tree: Value =
        serde_json::from_str(&fs::read_to_string(bench.path("tree.json")).unwrap()).unwrap();
    assert_eq!(tree["nodes"].as_array().unwrap().len(), 4);
    let radius = tree["paths"][0]["mean_radius"].as_f64().unwrap();
    assert!((1.0..4.0).contains(&radius), "of a tube of deviation 1.7: {radius}");
}

#[test]
fn the_papers_votes_and_fast_marching() {
    let bench = fork();
    for (method, least) in [
        ("front --no-growth", 0.6),
        ("multiple --no-growth --level 36", 0.2),
        ("accumulated --no-growth", 0.9),
        ("random", 0.6),
        ("border", 0.6),
    ] {
        let medium = "--medium vesselness --source 20,50";
        bench.ok(&format!("vote fork.npy {medium} --method {method} -o tree.json --force --quiet"));
        let recall = scores(&bench, "tree.json").0;
        assert!(recall > least, "{method}: {recall}");
    }
    bench.fails(
        "vote fork.npy --source 20,50 --method random --level 3 -o x.json",
        2,
        &["--level"],
    );
}

#[test]
fn every_format_of_a_tree() {
    let bench = fork();
    bench
        .ok("vote fork.npy --medium vesselness -o tree.swc --density votes.npy --overlay tree.png");
    let swc = fs::read_to_string(bench.path("tree.swc")).unwrap();
    let points: Vec<&str> = swc.lines().filter(|line| !line.starts_with('#')).collect();
    assert!(points.len() > 150 && points.iter().filter(|line| line.ends_with(" -1")).count() == 1);
    let (shape, votes) = bench.npy("votes.npy");
    assert_eq!(shape, [100, 120]);
    assert!(votes.iter().copied().fold(0.0, f64::max) > 20.0);
    assert!(scores(&bench, "tree.swc").0 > 0.95);
    for ending in ["csv", "vtp", "svg"] {
        bench.ok(&format!("vote fork.npy --medium vesselness -o tree.{ending}"));
    }
    bench.ok("vote fork.npy --medium vesselness -o kept.png");
    let kept = image::open(bench.path("kept.png")).unwrap().into_luma8();
    assert_eq!(kept.dimensions(), (120, 100));
    assert!(kept.pixels().all(|pixel| [0, 255].contains(&pixel.0[0])));
    assert!(scores(&bench, "kept.png").1 > 0.9);
}

#[test]
fn key_points_find_the_tree_by_themselves() {
    let bench = fork();
    for options in ["", "--medium vesselness --source 20,50", "--medium vesselness --radius 15"] {
        let command = format!("keypoints fork.npy {options} -o tree.json --force --json");
        let printed = bench.ok(&command);
        let printed: Value = serde_json::from_str(&printed).unwrap();
        let points = printed["keypoints"].as_array().unwrap();
        assert!(points.len() > 5 && points[0]["parent"].is_null() && points[1]["parent"] == 0);
        paths(&fs::read_to_string(bench.path("tree.json")).unwrap());
        let (recall, precision) = scores(&bench, "tree.json");
        assert!(recall > 0.95 && precision > 0.95, "{options}: {recall} {precision}");
    }
    let baseline = "--method length --medium vesselness --source 20,50 --radius 10";
    bench.ok(&format!("keypoints fork.npy {baseline} -o length.csv --travelling map.npy --quiet"));
    assert!(scores(&bench, "length.csv").0 > 0.8);
    let (_, map) = bench.npy("map.npy");
    assert!(map[50 * 120 + 20] == 0.0 && map.iter().any(|d| d.is_finite() && *d > 1.0));
    bench.ok("keypoints fork.npy --medium vesselness --overlay tree.png --quiet");
    assert!(image::open(bench.path("tree.png")).is_ok());
}

#[test]
fn what_cannot_be_found_is_said() {
    let bench = fork();
    bench.write_npy("flat.npy", &[40, 50], |_| 0.5);
    for command in ["vote", "keypoints"] {
        bench.fails(&format!("{command} flat.npy -o x.json"), 5, &["same everywhere", "--medium"]);
        let long = format!("{command} fork.npy --medium vesselness --extent 1000 -o x.json");
        bench.fails(&long, 5, &["1000.0 pixels", "--source"]);
        bench.fails(&format!("{command} fork.npy --source 500,1 -o x.json"), 3, &["500"]);
        bench.fails(
            &format!("{command} fork.npy --structure -1 --source 20,50 -o x.json"),
            2,
            &["-1"],
        );
        assert_eq!(bench.run(&format!("{command} fork.npy")).status.code(), Some(2));
    }
    let flat = "flat.npy --source 20,20 --medium uniform --no-growth";
    bench.ok(&format!("vote {flat} -o flat.json"));
    fs::remove_file(bench.path("flat.json")).unwrap();
    bench.fails("vote fork.npy --threshold 0.1 -o x.json", 2, &["--threshold", "--no-growth"]);
    for option in ["--gap 3", "--least-votes 3", "--settled 0.9", "--iterations 9", "--no-growth"] {
        let border = format!("vote fork.npy --source 20,50 --method border {option} -o x.json");
        bench.fails(&border, 2, &[option.split(' ').next().unwrap(), "fast marching"]);
    }
    let length = "keypoints fork.npy --method length --iterations 9 -o x.json";
    bench.fails(length, 2, &["--iterations", "length"]);
    bench.fails("vote fork.npy --gap -1 -o x.json", 2, &["gap", "-1"]);
    bench.fails("vote fork.npy --density x.npy -o x.npy", 2, &["two files"]);
    let masked = "vote fork.npy --mask truth.npy -o x.json";
    bench.fails(&format!("{masked} --margin -1"), 2, &["--margin", "-1"]);
    bench.fails(&format!("{masked} --margin 99"), 2, &["--margin 99", "no pixel"]);
    bench.fails("vote fork.npy --prune nan -o x.json", 2, &["--prune", "NaN"]);
    bench.fails("keypoints fork.npy --extent -5 -o x.json", 2, &["--extent", "-5"]);
    bench.fails("keypoints fork.npy --radius 1 -o x.json", 2, &["radius", "1"]);
}
