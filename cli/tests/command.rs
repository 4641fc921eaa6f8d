//! The binary, run as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use image::{GrayImage, Luma};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn distance_writes_every_format() {
    let bench = Bench::with_picture();
    let report = bench.json("distance curve.png --source 10,47 -o d.npy --overlay o.png --json");
    let (shape, values) = bench.npy("d.npy");
    assert_eq!(shape, [80, 100], "rows first");
    assert_eq!(values[47 * 100 + 10], 0.0);
    assert_eq!(report["min"], 0.0);
    assert_eq!(report["reached"], 8000);
    assert_eq!(report["unreached"], 0);
    assert_eq!(report["iterations"], 200);
    assert_eq!(report["time"], 40.0);
    for key in ["max", "mean", "step", "threads", "simd"] {
        assert!(!report[key].is_null(), "{key}");
    }
    for key in ["medium", "heat", "distance", "total"] {
        assert!(report["seconds"][key].is_number(), "{key}");
    }
    assert_eq!(image::open(bench.path("o.png")).unwrap().width(), 300, "small pictures grow");

    bench.ok("distance curve.png --source 10,47 -o d.tif");
    let mut tiff =
        tiff::decoder::Decoder::new(fs::File::open(bench.path("d.tif")).unwrap()).unwrap();
    let tiff::decoder::DecodingResult::F32(single) = tiff.read_image().unwrap() else {
        panic!("a distance TIFF holds 32-bit floats");
    };
    assert_eq!(single, values.iter().map(|&v| v as f32).collect::<Vec<_>>());
    bench.ok("distance curve.png --source 10,47 -o d.png");
    assert!(image::open(bench.path("d.png")).unwrap().width() > 300, "a colour bar stands beside");
    bench.ok("distance curve.png --source 10,47 -o d.data --format npy");
    assert_eq!(bench.npy("d.data").1, values);
}

#[test]
fn what_heat_has_not_reached_is_infinite() {
    let bench = Bench::with_picture();
    let report = bench.json("distance curve.png --source 10,40 --iterations 5 -o d.npy --json");
    let (_, values) = bench.npy("d.npy");
    let reached = values.iter().filter(|v| v.is_finite()).count();
    assert_eq!(reached, 61, "a diamond of five cells' radius");
    assert_eq!(report["reached"], reached);
    assert_eq!(report["unreached"], 8000 - reached);
}

#[test]
fn paths_end_at_the_source_in_every_medium() {
    let bench = Bench::with_picture();
    for medium in ["uniform", "conductivity", "perona-malik", "combined", "edges"] {
        let curves = bench.json(&format!(
            "path curve.png --source 10,51.2 --end 90,55 --end 50.5,25.25 --end=0,79 --end -0.4,0 \
             --medium {medium} -o p.json --overlay p.png --json --force"
        ));
        let file: Value =
            serde_json::from_str(&fs::read_to_string(bench.path("p.json")).unwrap()).unwrap();
        assert_eq!(curves, file);
        assert_eq!(curves["version"], 1);
        assert_eq!(curves["dimension"], 2);
        let paths = curves["paths"].as_array().unwrap();
        assert_eq!(paths.len(), 4);
        for path in paths {
            assert_eq!(path["ended"], "source", "{medium}");
            assert_eq!(path["source"], 0);
            let points = path["points"].as_array().unwrap();
            assert_eq!(points[0], path["end"]);
            assert_eq!(points[points.len() - 1], serde_json::json!([10.0, 51.2]));
            assert!(path["length"].as_f64().unwrap() > 20.0);
        }
    }
}

#[test]
fn a_path_follows_the_bright_curve() {
    let bench = Bench::with_picture();
    let curves = bench.json("path curve.png --source 10,51 --end 90,54 --power 6 --json");
    let points = curves["paths"][0]["points"].as_array().unwrap();
    for point in points {
        let (x, y) = (point[0].as_f64().unwrap(), point[1].as_f64().unwrap());
        let off = (y - (40.0 + 15.0 * (x / 12.0).sin())).abs();
        assert!(off < 5.0, "the path leaves the curve at {x},{y}");
    }
}

#[test]
fn curves_as_csv_and_svg_and_points_from_files() {
    let bench = Bench::with_picture();
    fs::write(bench.path("ends.csv"), "x,y,name\n90,54,a\n50,40,b\n").unwrap();
    fs::write(bench.path("sources.json"), "[[10, 51], [60, 30]]").unwrap();
    bench.ok("path curve.png --sources sources.json --ends ends.csv --end 1,1 -o p.csv");
    bench.ok("path curve.png --sources sources.json --ends ends.csv --end 1,1 -o p.svg");
    let csv = fs::read_to_string(bench.path("p.csv")).unwrap();
    assert!(csv.starts_with("path,point,x,y,ended\n0,0,1.0,1.0,source\n"), "{}", &csv[..80]);
    assert!(csv.lines().last().unwrap().starts_with("2,"));
    let svg = fs::read_to_string(bench.path("p.svg")).unwrap();
    assert!(svg.contains("<svg") && svg.contains("viewBox=\"-0.5 -0.5 100 80\""), "{svg}");
}

#[test]
fn spacing_gives_physical_lengths_and_points() {
    let bench = Bench::with_picture();
    let plain = bench.json("path curve.png --medium uniform --source 10,40 --end 40,20 --json");
    let arguments = "path curve.png --medium uniform --spacing 0.5,0.5 --physical \
                     --source 5,20 --end 20,10 --json";
    let physical = bench.json(arguments);
    let (plain, physical) = (&plain["paths"][0], &physical["paths"][0]);
    assert_eq!(plain["points"], physical["points"], "points are in pixels");
    assert_eq!(plain["length"], physical["length"]);
    let half = |key: &str| plain[key].as_f64().unwrap() / 2.0;
    assert_eq!(physical["physical_length"].as_f64().unwrap(), half("physical_length"));
    assert_eq!(physical["distance"].as_f64().unwrap(), half("distance"));
}

#[test]
fn medium_shows_what_heat_sees() {
    let bench = Bench::with_picture();
    let report = bench.json("medium curve.png --source 10,51 -o k.npy --json");
    let (_, values) = bench.npy("k.npy");
    let difference = (220.0 - 60.0) / 255.0_f64;
    let low = (1.0 - difference).powi(3) + 1e-3;
    assert!((values[0] - low).abs() < 1e-12);
    assert!((report["max"].as_f64().unwrap() - 1.001).abs() < 1e-12);
    bench.ok("medium curve.png --medium edges --smooth 1 -o e.png");
    bench.ok("medium curve.png --reference 0.8 -o r.npy");
    bench.fails("medium curve.png -o x.npy", 2, &["--source", "--reference"]);
}

#[test]
fn a_given_field_is_the_squared_speed() {
    let bench = Bench::with_picture();
    let write = |name: &str, value: f64| {
        bench.write_npy(name, &[80, 100], |i| if i == 4321 { value } else { 0.25 });
    };
    write("quarter.npy", 0.25);
    let arguments = "distance curve.png --medium file --medium-file quarter.npy --source 50,40 \
                     --time 60 --step auto -o d.npy --force";
    bench.ok(arguments);
    let (_, values) = bench.npy("d.npy");
    assert!(
        (values[40 * 100 + 62] / 24.0 - 1.0).abs() < 0.01,
        "half the speed, twice the distance"
    );
    write("nan.npy", f64::NAN);
    let with = |name: &str| arguments.replace("quarter.npy", name);
    bench.fails(&with("nan.npy"), 3, &["nan.npy", "NaN", "[21, 43]", "finite"]);
    write("zero.npy", 0.0);
    bench.fails(&with("zero.npy"), 3, &["zero.npy", "[21, 43]", "positive"]);
}

#[test]
fn walls_stop_paths() {
    let bench = Bench::with_picture();
    let wall = |gap: bool| {
        GrayImage::from_fn(100, 80, |x, y| Luma([if x == 50 && !(gap && y == 5) { 0 } else { 1 }]))
    };
    wall(false).save(bench.path("wall.png")).unwrap();
    wall(true).save(bench.path("gap.png")).unwrap();
    let through = bench.json("path curve.png --mask gap.png --source 10,40 --end 90,40 --json");
    assert_eq!(through["paths"][0]["ended"], "source");
    assert!(through["paths"][0]["length"].as_f64().unwrap() > 100.0, "around by the gap");

    // A path that does not arrive is written with the others, and told by the exit code.
    let output =
        bench.run("path curve.png --mask wall.png --source 10,40 --end 90,40 --end 9,9 -o p.json");
    assert_eq!(output.status.code(), Some(5));
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.contains("1 of 2 paths did not reach a source"), "{error}");
    assert!(error.contains("walls"), "{error}");
    let file: Value =
        serde_json::from_str(&fs::read_to_string(bench.path("p.json")).unwrap()).unwrap();
    assert_eq!(file["paths"][0]["ended"], "unreachable");
    assert_eq!(file["paths"][0]["distance"], Value::Null);
    assert_eq!(file["paths"][1]["ended"], "source");

    let output = bench.run("path curve.png --source 10,40 --end 90,40 --iterations 20 --json");
    assert_eq!(output.status.code(), Some(5));
    assert!(String::from_utf8(output.stderr).unwrap().contains("more --iterations"));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(printed["paths"][0]["ended"], "not_reached");
}

#[test]
fn bad_input_is_told_in_one_line() {
    let bench = Bench::with_picture();
    let mask = GrayImage::from_fn(100, 80, |x, _| Luma([u8::from(x < 50)]));
    mask.save(bench.path("mask.png")).unwrap();
    GrayImage::new(3, 3).save(bench.path("small.png")).unwrap();
    fs::write(bench.path("empty.png"), "").unwrap();
    let whole = fs::read(bench.path("curve.png")).unwrap();
    fs::write(bench.path("half.png"), &whole[..whole.len() / 2]).unwrap();
    fs::write(bench.path("text.png"), "no picture").unwrap();
    fs::write(bench.path("there.npy"), "precious").unwrap();

    let fails = |arguments: &str, code, words: &[&str]| bench.fails(arguments, code, words);
    fails(
        "distance curve.png --source 100,5 -o x.npy",
        3,
        &["source 0", "[100.0, 5.0]", "[100, 80]"],
    );
    fails("distance curve.png --source 5,-0.6 -o x.npy", 3, &["outside"]);
    fails("path curve.png --source 5,5 --end 1e9,1 -o x.json", 3, &["end 0", "outside"]);
    fails("distance curve.png --source nan,5 -o x.npy", 3, &["NaN", "outside"]);
    fails("distance empty.png --source 5,5 -o x.npy", 3, &["empty.png", "empty"]);
    fails("distance half.png --source 5,5 -o x.npy", 3, &["half.png"]);
    fails("distance text.png --source 5,5 -o x.npy", 3, &["text.png"]);
    fails("distance missing.png --source 5,5 -o x.npy", 4, &["missing.png"]);
    fails("distance curve.png --source 5,5 --step 0.3 -o x.npy", 3, &["0.3", "0.249", "auto"]);
    fails("distance curve.png --source 60,5 --mask mask.png -o x.npy", 3, &["source 0", "wall"]);
    fails("path curve.png --source 5,5 --end 60,5 --mask mask.png -o x.csv", 3, &["end 0", "wall"]);
    fails("distance curve.png --source 5,5 --mask small.png -o x.npy", 3, &["small.png", "3 x 3"]);
    fails("distance curve.png --source 5,5 -o gone/x.npy", 4, &["gone", "does not exist"]);
    fails("distance curve.png --source 5,5 -o x.jpg", 2, &["x.jpg", ".npy", ".tif", ".png"]);
    fails("path curve.png --source 5,5 --end 1,1 -o x.npy", 2, &["x.npy", ".json", ".csv", ".svg"]);
    fails("distance curve.png --source 5,5 -o there.npy", 4, &["there.npy", "exists", "--force"]);
    fails("distance curve.png --source 5,5 --power -1 -o x.npy", 2, &["power", "positive"]);
    fails("distance curve.png --source 5,5 --iterations 0 -o x.npy", 2, &["iterations", "1"]);
    fails("distance curve.png --source 5,5 --spacing 0,1 -o x.npy", 2, &["spacing", "positive"]);
    fails(
        "distance curve.png --source 5,5 --medium edges --smooth -1 -o x.npy",
        2,
        &["sigma", "-1"],
    );
    fails("distance curve.png --source 5,5 -o x.png --overlay x.png", 2, &["x.png", "two files"]);
    fails("distance curve.png --source 5,5 --threads 100000 -o x.npy", 2, &["100000", "1024"]);
    fails("distance curve.png --source 5,5 --time 1e300 -o x.npy", 2, &["5e300", "1e12"]);
    assert_eq!(fs::read_to_string(bench.path("there.npy")).unwrap(), "precious");
    bench.ok("distance curve.png --source 5,5 -o there.npy --force");
    assert_eq!(bench.npy("there.npy").0, [80, 100]);
}

#[test]
fn wrong_usage_has_its_own_exit_code() {
    let bench = Bench::with_picture();
    for arguments in [
        "",
        "distance",
        "distance curve.png -o x.npy",
        "distance curve.png --source 1,2",
        "distance curve.png --source 1,2,3 -o x.npy",
        "distance curve.png --source 1;2 -o x.npy",
        "distance curve.png --source 1,2 --medium glue -o x.npy",
        "distance curve.png --source 1,2 --medium file -o x.npy",
        "distance curve.png --source 1,2 --iterations 5 --time 3 -o x.npy",
        "distance curve.png --source 1,2 --step fast -o x.npy",
        "path curve.png --source 1,2 -o x.json",
    ] {
        assert_eq!(bench.run(arguments).status.code(), Some(2), "heatpath {arguments}");
    }
}

#[test]
fn info_and_completions() {
    let bench = Bench::with_picture();
    let info = bench.json("info curve.png --json");
    assert_eq!(info["format"], "png");
    assert_eq!(info["size"], serde_json::json!([100, 80]));
    assert_eq!(info["sample"], "uint8");
    assert_eq!((&info["min"], &info["max"]), (&serde_json::json!(60.0), &serde_json::json!(220.0)));
    assert!(bench.ok("info curve.png").contains("100 x 80"));
    bench.fails("info nothing.png", 4, &["nothing.png"]);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(bench.ok(&format!("completions {shell}")).contains("heatpath"), "{shell}");
    }
}

#[test]
fn quiet_is_quiet_and_json_is_alone() {
    let bench = Bench::with_picture();
    let run = |flags: &str| {
        bench.run(&format!("distance curve.png --source 5,5 -o d.npy --force {flags}"))
    };
    let plain = run("");
    assert!(plain.stdout.is_empty() && !plain.stderr.is_empty());
    let quiet = run("--quiet");
    assert!(quiet.stdout.is_empty() && quiet.stderr.is_empty());
    let json = run("--json");
    assert!(json.stderr.is_empty());
    assert_eq!(String::from_utf8(json.stdout).unwrap().lines().count(), 1);
}

#[test]
fn threads_change_nothing() {
    let bench = Bench::with_picture();
    for threads in [1, 2, 5] {
        bench.ok(&format!("distance curve.png --source 5,5 --threads {threads} -o d{threads}.npy"));
    }
    let read = |name: &str| fs::read(bench.path(name)).unwrap();
    assert!(read("d1.npy") == read("d2.npy") && read("d1.npy") == read("d5.npy"));
}

/// Ctrl-C in the middle of the heat: exit code 130, and nothing on disk.
#[cfg(unix)]
#[test]
fn an_interruption_leaves_no_file() {
    let bench = Bench::with_picture();
    let mut child = Command::new(env!("CARGO_BIN_EXE_heatpath"))
        .current_dir(bench.path("."))
        .stderr(std::process::Stdio::null())
        .args("distance curve.png --source 5,5 --iterations 2000000 -o d.npy".split(' '))
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1000));
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(bench.files(), [bench.path("curve.png")]);
}

/// The main job of the README, on the picture that ships with the project.
#[test]
fn the_retina_of_the_readme() {
    let bench = Bench::with_picture();
    let retina = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/data/retina.jpg");
    let info = bench.json(&format!("info {} --json", retina.display()));
    assert_eq!(info["size"], serde_json::json!([1411, 1411]));
    assert_eq!(info["channels"], 3);
}
