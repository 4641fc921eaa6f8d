//! Volumes through the command, as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use serde_json::{Value, json};
use std::fs;
use std::thread;
use std::time::Duration;

/// Columns, rows, slices: different ones, so that mixed up axes show.
const SIZE: [usize; 3] = [24, 20, 16];
const SHAPE: [u64; 3] = [16, 20, 24];

fn index(position: usize) -> [usize; 3] {
    [position % SIZE[0], position / SIZE[0] % SIZE[1], position / SIZE[0] / SIZE[1]]
}

/// A bench with `v.npy`: a smooth volume without symmetry, from 0 to 1.
fn bench() -> Bench {
    let bench = Bench::new();
    bench.write_npy("v.npy", &SHAPE, |i| {
        let [x, y, z] = index(i).map(|n| n as f64);
        0.5 + 0.5 * (0.3 * x + 0.1 * z).sin() * (0.2 * y - 0.25 * z).cos()
    });
    bench
}

/// The values of `v.npy` as a stack of pages.
fn write_stack(bench: &Bench, name: &str) {
    let (_, values) = bench.npy("v.npy");
    let mut file = fs::File::create(bench.path(name)).unwrap();
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut file).unwrap();
    for page in values.chunks(SIZE[0] * SIZE[1]) {
        encoder
            .write_image::<tiff::encoder::colortype::Gray64Float>(
                SIZE[0] as u32,
                SIZE[1] as u32,
                page,
            )
            .unwrap();
    }
}

#[test]
fn distances_are_physical_lengths() {
    let bench = Bench::new();
    bench.write_npy("even.npy", &[24, 60, 64], |_| 1.0);
    let report = bench.json(
        "distance even.npy --medium uniform --spacing 1,1,2.5 --source 31,30,11 --time 40 -o d.npy \
         --json",
    );
    assert_eq!(report["size"], json!([64, 60, 24]));
    assert_eq!(report["reached"], 64 * 60 * 24);
    let (shape, values) = bench.npy("d.npy");
    assert_eq!(shape, [24, 60, 64], "slices first");
    // Further out the heat comes back from the border.
    let mut worst = 0.0_f64;
    for (i, value) in values.iter().enumerate() {
        let [x, y, z] = [i % 64, i / 64 % 60, i / 64 / 60].map(|n| n as f64);
        let exact = ((x - 31.0).powi(2) + (y - 30.0).powi(2) + (2.5 * (z - 11.0)).powi(2)).sqrt();
        if (4.0..15.0).contains(&exact) {
            worst = worst.max((value / exact - 1.0).abs());
        }
    }
    println!("largest relative error from 4 to 15 units: {worst:.4}");
    assert!(worst < 0.02, "largest relative error {worst}");
    assert_eq!(values[31 + 64 * (30 + 60 * 11)], 0.0);
}

#[test]
fn a_stack_is_the_same_volume_and_every_output_agrees() {
    let bench = bench();
    write_stack(&bench, "v.tif");
    let distance = |input: &str, output: &str| {
        bench.ok(&format!("distance {input} --source 3,4.5,2 -o {output}"));
    };
    distance("v.npy", "a.npy");
    distance("v.tif", "b.npy");
    distance("v.tif", "c.tif");
    let bytes = |name: &str| fs::read(bench.path(name)).unwrap();
    assert!(bytes("a.npy") == bytes("b.npy"), "the same distances, bit for bit");
    // A field may come back as an input: 32-bit floats, a page a slice.
    let info = bench.json("info c.tif --json");
    assert_eq!((&info["size"], &info["sample"]), (&json!([24, 20, 16]), &json!("float32")));
    assert_eq!(info["pages"], 16);
    assert!(bench.ok("info a.npy").contains("24 x 20 x 16 voxels"));
    let largest = bench.npy("a.npy").1.into_iter().fold(0.0, f64::max);
    assert_eq!(info["max"].as_f64().unwrap(), f64::from(largest as f32));
}

/// Heat moves one cell a step, and the way from corner to corner is the sum of all sides.
#[test]
fn the_default_reaches_every_corner() {
    let bench = Bench::new();
    bench.write_npy("cube.npy", &[9, 10, 11], |i| (i % 5) as f64);
    let report = bench.json("distance cube.npy --source 0,0,0 -o d.npy --json");
    assert_eq!((&report["iterations"], &report["unreached"]), (&json!(33), &json!(0)));
}

#[test]
fn every_medium_works_out_of_the_box() {
    let bench = bench();
    bench.write_npy("field.npy", &SHAPE, |i| 0.2 + 0.05 * (i % 7) as f64);
    for medium in ["uniform", "conductivity", "perona-malik", "combined", "edges", "file"] {
        let options = format!(
            "--medium {medium} --medium-file field.npy --spacing 0.5,0.5,0.8 --source 3,4,2"
        );
        let report = bench.json(&format!("medium v.npy {options} -o k.npy --json --force"));
        assert_eq!(report["size"], json!([24, 20, 16]), "{medium}");
        assert!(report["min"].as_f64().unwrap() > 0.0, "{medium}");
        let report = bench.json(&format!("distance v.npy {options} -o d.npy --json --force"));
        assert_eq!(report["step"].as_f64().unwrap(), 0.8 / 6.0, "{medium}");
        assert_eq!(report["unreached"], 0, "{medium}");
        let curves = bench.json(&format!("path v.npy {options} --end 20.5,15.25,13 --json"));
        assert_eq!(curves["paths"][0]["ended"], "source", "{medium}");
    }
    assert_eq!(bench.npy("k.npy").1[6], 0.2 + 0.05 * 6.0);
    bench.fails("distance v.npy --source 3,4,2 --step 0.2 -o x.npy", 3, &["0.2", "0.16", "auto"]);
}

/// A wall across the volume with one hole: the only way from one side to the other.
fn write_wall(bench: &Bench, name: &str, hole: bool) {
    bench.write_npy(name, &SHAPE, |i| match index(i) {
        [12, 15, 3] if hole => 1.0,
        [12, _, _] => 0.0,
        _ => 1.0,
    });
}

#[test]
fn a_path_finds_the_hole_in_a_wall() {
    let bench = bench();
    write_wall(&bench, "hole.npy", true);
    let path = "path v.npy --medium uniform --spacing 1,1,2.5 --source 2,3,12 --end 21,4,11.5 \
                --iterations 600";
    let curves = bench.json(&format!("{path} --mask hole.npy -o p.json --json"));
    let file: Value =
        serde_json::from_str(&fs::read_to_string(bench.path("p.json")).unwrap()).unwrap();
    assert_eq!(curves, file);
    assert_eq!((&curves["dimension"], &curves["spacing"]), (&json!(3), &json!([1.0, 1.0, 2.5])));
    let path_of = &curves["paths"][0];
    assert_eq!(path_of["ended"], "source");
    let points: Vec<[f64; 3]> = serde_json::from_value(path_of["points"].clone()).unwrap();
    assert_eq!((points[0], points[points.len() - 1]), ([21.0, 4.0, 11.5], [2.0, 3.0, 12.0]));
    let through = points.iter().filter(|p| (p[0] - 12.0).abs() <= 0.5);
    let through: Vec<_> = through.collect();
    assert!(!through.is_empty());
    for point in through {
        assert!((point[1] - 15.0).abs() <= 0.5 && (point[2] - 3.0).abs() <= 0.5, "{point:?}");
    }
    // By way of the hole: two straight lines.
    let leg = |a: [f64; 3], b: [f64; 3]| {
        ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (2.5 * (a[2] - b[2])).powi(2)).sqrt()
    };
    let shortest = leg(points[0], [12.0, 15.0, 3.0]) + leg([12.0, 15.0, 3.0], [2.0, 3.0, 12.0]);
    let length = path_of["physical_length"].as_f64().unwrap();
    assert!((1.0..1.06).contains(&(length / shortest)), "{length}, at best {shortest}");

    write_wall(&bench, "wall.npy", false);
    let output = bench.run(&format!("{path} --mask wall.npy -o none.json"));
    assert_eq!(output.status.code(), Some(5));
    assert!(String::from_utf8(output.stderr).unwrap().contains("walls"));
}

#[test]
fn points_come_from_files_and_paths_go_to_csv() {
    let bench = bench();
    fs::write(bench.path("ends.csv"), "id,x,y,z\na,20,15,13\nb,5,5,5\n").unwrap();
    fs::write(bench.path("sources.json"), "{\"points\": [[3, 4, 2], [20, 4, 2]]}").unwrap();
    bench.ok("path v.npy --sources sources.json --ends ends.csv -o p.csv");
    let text = fs::read_to_string(bench.path("p.csv")).unwrap();
    assert!(text.starts_with("path,point,x,y,z,ended\n0,0,20.0,15.0,13.0,source\n"), "{text}");
    assert!(text.lines().last().unwrap().starts_with("1,"));
    // What was written can be read as points again.
    bench.ok("path v.npy --source 3,4,2 --ends p.csv -o again.json --quiet");
}

#[test]
fn physical_points_and_threads_change_nothing() {
    let bench = bench();
    let plain = bench.json("path v.npy --spacing 2,2,5 --source 3,4,2 --end 20,15,13 --json");
    let physical = bench.json(
        "path v.npy --spacing 2,2,5 --physical --source 6,8,10 --end 40,30,65 --json --threads 1",
    );
    assert_eq!(plain, physical);
}

#[test]
fn the_wrong_number_of_coordinates_is_told() {
    let bench = bench();
    let picture = Bench::with_picture();
    fs::copy(picture.path("curve.png"), bench.path("curve.png")).unwrap();
    fs::write(bench.path("flat.csv"), "1,2\n").unwrap();
    let fails = |arguments: &str, code, words: &[&str]| bench.fails(arguments, code, words);
    fails("distance v.npy --source 1,2 -o x.npy", 2, &["--source 1,2", "volume", "3: x,y,z"]);
    fails(
        "distance curve.png --source 1,2,3 -o x.npy",
        2,
        &["--source 1,2,3", "picture", "2: x,y"],
    );
    fails("path v.npy --source 1,2,3 --end 4,5 -o x.json", 2, &["--end 4,5", "needs 3"]);
    fails(
        "distance v.npy --source 1,2,3 --spacing 1,1 -o x.npy",
        2,
        &["--spacing 1,1", "2 numbers", "needs 3"],
    );
    fails("distance curve.png --source 1,2 --spacing 1,1,1 -o x.npy", 2, &["--spacing", "needs 2"]);
    fails(
        "distance v.npy --source 1,2,3 --spacing 1,1,nan -o x.npy",
        2,
        &["spacing", "axis 2", "NaN", "positive"],
    );
    fails("distance v.npy --source 1,2,3 --spacing 1,1,-2 -o x.npy", 2, &["spacing", "-2"]);
    fails("distance v.npy --sources flat.csv -o x.npy", 3, &["flat.csv", "line 1", "x,y,z"]);
    fails("distance v.npy --source 1,2,16 -o x.npy", 3, &["[1.0, 2.0, 16.0]", "[24, 20, 16]"]);
    fails("path v.npy --source 1,2,3 --end 1,2,nan -o x.json", 3, &["end 0", "NaN", "outside"]);
    assert_eq!(bench.run("distance v.npy --source 1,2,3,4 -o x.npy").status.code(), Some(2));
}

#[test]
fn files_that_do_not_fit_are_told() {
    let bench = bench();
    let picture = Bench::with_picture();
    fs::copy(picture.path("curve.png"), bench.path("curve.png")).unwrap();
    bench.write_npy("small.npy", &[2, 20, 24], |_| 1.0);
    bench.write_npy("hole.npy", &SHAPE, |i| if i == 777 { f64::NAN } else { 1.0 });
    bench.write_npy("four.npy", &[2, 2, 2, 2], |_| 1.0);
    let fails = |arguments: &str, code, words: &[&str]| bench.fails(arguments, code, words);
    let distance = "distance v.npy --source 1,2,3 -o x.npy";
    fails(&format!("{distance} --mask curve.png"), 3, &["curve.png", "100 x 80", "volume"]);
    fails(
        &format!("{distance} --mask small.npy"),
        3,
        &["small.npy", "24 x 20 x 2", "24 x 20 x 16"],
    );
    fails(&format!("{distance} --mask hole.npy"), 3, &["hole.npy", "x = 9, y = 12, z = 1", "NaN"]);
    fails(
        &format!("{distance} --medium file --medium-file hole.npy"),
        3,
        &["hole.npy", "[9, 12, 1]", "NaN"],
    );
    fails("distance curve.png --source 1,2 --mask v.npy -o x.npy", 3, &["v.npy", "a picture is"]);
    fails("distance four.npy --source 1,1,1 -o x.npy", 3, &["[2, 2, 2, 2]", "(slices, rows,"]);
}

#[test]
fn volumes_are_no_pictures() {
    let bench = bench();
    let words = ["volume", ".npy or .tif", ".json or .csv"];
    for output in ["-o x.png", "-o x.npy --format png"] {
        bench.fails(&format!("distance v.npy --source 1,2,3 {output}"), 2, &words);
        bench.fails(&format!("medium v.npy --source 1,2,3 {output}"), 2, &words);
    }
    bench.fails("path v.npy --source 1,2,3 --end 4,4,4 -o x.svg", 2, &words);
}

/// Slices and projections, in the proportions of the spacing.
#[test]
fn volumes_are_drawn_as_slices() {
    let bench = bench();
    let size = |name: &str| {
        let picture = image::open(bench.path(name)).unwrap();
        [picture.width(), picture.height()]
    };
    let common = "v.npy --spacing 1,1,3 --source 1,2,3 --overlay";
    bench.ok(&format!("path {common} path.png --end 20,15,13"));
    bench.ok(&format!("distance {common} distance.png"));
    bench.ok(&format!("medium {common} medium.png"));
    // 48 units are the longest side: 6 pixels each.
    let [path, distance] = ["path.png", "distance.png"].map(size);
    assert!(path[0] > 2 * 6 * (24 + 48) && path[1] > 6 * (20 + 48), "{path:?}");
    assert!(distance[0] > path[0] && distance[1] == path[1], "a bar of colours: {distance:?}");
    assert_eq!(size("medium.png")[1], path[1]);
    bench.ok(&format!("vote {common} vote.png --structure 0.2"));
    bench.ok(&format!("keypoints {common} keypoints.png --structure 0.2"));
}

/// An array with 3 columns could be colours: three numbers say that it is a volume.
#[test]
fn narrow_volumes_need_three_numbers() {
    let bench = Bench::new();
    bench.write_npy("narrow.npy", &[9, 7, 3], |i| i as f64);
    assert_eq!(bench.json("info narrow.npy --json")["size"], json!([7, 9]));
    bench.ok("distance narrow.npy --source 5,8 -o picture.npy");
    assert_eq!(bench.npy("picture.npy").0, [9, 7]);
    bench.ok("distance narrow.npy --source 2,6,8 -o volume.npy");
    assert_eq!(bench.npy("volume.npy").0, [9, 7, 3]);
    fs::write(bench.path("s.csv"), "2,6,8\n").unwrap();
    bench.ok("distance narrow.npy --sources s.csv --spacing 1,1,1 --mask narrow.npy -o s.npy");
    assert_eq!(bench.npy("s.npy").0, [9, 7, 3]);
}

#[test]
fn thin_volumes_are_volumes() {
    let bench = Bench::new();
    for (shape, end) in [([9, 1, 2], "1,0,8"), ([1, 9, 2], "1,8,0"), ([1, 1, 9], "8,0,0")] {
        bench.write_npy("thin.npy", &shape, |_| 1.0);
        let options = "--medium uniform --spacing 1,1,2 --force --source 0,0,0";
        let report = bench.json(&format!("distance thin.npy {options} -o d.npy --json"));
        assert_eq!(report["unreached"], 0, "{shape:?}");
        assert_eq!(bench.npy("d.npy").0, shape);
        let curves = bench.json(&format!("path thin.npy {options} --end {end} --json"));
        assert_eq!(curves["paths"][0]["ended"], "source", "{shape:?}");
    }
    bench.write_npy("one.npy", &[1, 1, 1], |_| 1.0);
    bench.ok("distance one.npy --medium uniform --source 0,0,0 -o one_d.npy");
    assert_eq!(bench.npy("one_d.npy"), (vec![1, 1, 1], vec![0.0]));
}

/// The most bytes of memory that the command has taken at a time.
#[cfg(target_os = "linux")]
fn most_memory(bench: &Bench, arguments: &str) -> f64 {
    let mut running = bench.command(arguments).spawn().unwrap();
    let status = format!("/proc/{}/status", running.id());
    let mut most = 0.0;
    while running.try_wait().unwrap().is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let peak = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = peak.and_then(|peak| peak.trim().strip_suffix(" kB"));
        most = kilobytes.map_or(most, |kilobytes| 1024.0 * kilobytes.parse::<f64>().unwrap());
        thread::sleep(Duration::from_millis(1));
    }
    assert!(running.wait().unwrap().success(), "heatpath {arguments}");
    most
}

/// As docs/volumes.md says.
#[cfg(target_os = "linux")]
#[test]
fn a_path_takes_so_much_memory_a_voxel() {
    const SIDE: usize = 160;
    let bench = Bench::new();
    let header = format!(
        "ObjectType = Image\nNDims = 3\nDimSize = {SIDE} {SIDE} {SIDE}\n\
         ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
    );
    let grey = |i: usize| (128.0 + 90.0 * (0.003 * i as f64).sin()) as u8;
    let values = (0..SIDE.pow(3)).map(grey);
    fs::write(
        bench.path("v.mha"),
        header.into_bytes().into_iter().chain(values).collect::<Vec<_>>(),
    )
    .unwrap();
    let base = most_memory(&bench, "path --help");
    for (method, stated) in [("--estimator eikonal", 45.0), ("--iterations 450", 80.0)] {
        let path =
            "path v.mha --source 10,10,10 --end 150,150,150 --threads 2 --quiet --force -o p.json";
        let taken = most_memory(&bench, &format!("{path} {method}")) - base;
        let bytes = taken / SIDE.pow(3) as f64;
        println!("{method}: {bytes:.1} bytes a voxel");
        assert!(bytes > 20.0 && bytes < 1.1 * stated, "{method}: {bytes} bytes a voxel");
    }
}
