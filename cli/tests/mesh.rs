//! Meshes through the command, as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use heatpath_core::mesh::TriMesh;
use heatpath_core::mesh::shapes::{Block, block, icosphere, sheet};
use heatpath_io::mesh::{PointArray, read_mesh, write_mesh};
use serde_json::{Value, json};
use std::fs;

fn write(bench: &Bench, name: &str, mesh: &TriMesh, arrays: &[PointArray<'_>]) {
    write_mesh(bench.path(name), None, false, mesh, arrays).unwrap();
}

/// A bench with the unit sphere, `sphere.ply`, and three arrays of its vertices.
fn sphere() -> (Bench, TriMesh) {
    let (bench, sphere) = (Bench::new(), icosphere(3));
    let height: Vec<f64> = sphere.points().iter().map(|point| point[2]).collect();
    let count = height.len();
    let mut broken = height.clone();
    broken[7] = f64::NAN;
    let arrays = [("height", &height[..]), ("four", &vec![4.0; count]), ("broken", &broken)];
    write(&bench, "sphere.ply", &sphere, &arrays);
    (bench, sphere)
}

/// Two spheres, `two.ply`, the second one 5 to the right.
fn two_spheres() -> Bench {
    let (bench, sphere) = (Bench::new(), icosphere(2));
    let count = sphere.points().len() as u32;
    let moved = sphere.points().iter().map(|[x, y, z]| [x + 5.0, *y, *z]);
    let points = sphere.points().iter().copied().chain(moved).collect();
    let others = sphere.faces().iter().map(|face| face.map(|vertex| vertex + count));
    let faces = sphere.faces().iter().copied().chain(others).collect();
    write(&bench, "two.ply", &TriMesh::new(points, faces).unwrap(), &[]);
    bench
}

/// Sixteen squares a side, `square.ply`.
fn square() -> Bench {
    let bench = Bench::new();
    let mesh = sheet(16, 16, |column, row| [column as f64, row as f64, 0.0]);
    write(&bench, "square.ply", &mesh, &[]);
    bench
}

fn array(bench: &Bench, file: &str, name: &str) -> Vec<f64> {
    let file = read_mesh(bench.path(file)).unwrap();
    file.arrays.into_iter().find(|(own, _)| own == name).unwrap().1
}

/// The last column of a table.
fn column(bench: &Bench, file: &str, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(bench.path(file)).unwrap();
    let mut lines = text.lines();
    let place = lines.next().unwrap().split(',').position(|title| title == name).unwrap();
    lines.map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

fn arc(a: [f64; 3], b: [f64; 3]) -> f64 {
    let chord = (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
    2.0 * (0.5 * chord).min(1.0).asin()
}

/// The mean error of distances on the unit sphere, as a part of the mean distance.
fn error(found: &[f64], sphere: &TriMesh, source: [f64; 3]) -> f64 {
    let arcs: Vec<f64> = sphere.points().iter().map(|&point| arc(point, source)).collect();
    let off: f64 = found.iter().zip(&arcs).map(|(found, arc)| (found - arc).abs()).sum();
    off / arcs.iter().sum::<f64>()
}

/// The paths of what was printed.
fn paths(printed: &Value) -> &Vec<Value> {
    printed["paths"].as_array().unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn every_format_holds_the_same_distances() {
    let (bench, sphere) = sphere();
    let report = bench.json("mesh distance sphere.ply --source 100 -o d.npy --json");
    let (shape, values) = bench.npy("d.npy");
    assert_eq!(shape, [642]);
    assert_eq!(values[100], 0.0);
    let error = error(&values, &sphere, sphere.points()[100]);
    assert!(error < 0.005, "{error}");
    assert_eq!(report["max"], values.iter().copied().fold(0.0, f64::max));
    let facts = json!([report["reached"], report["unreached"], report["min"], report["method"]]);
    assert_eq!(facts, json!([642, 0, 0.0, "exact"]));
    assert_eq!(report["mesh"]["faces"], 1280);
    for ending in ["ply", "vtp", "vtk", "VTP"] {
        bench.ok(&format!("mesh distance sphere.ply --source 100 -o d.{ending}"));
        assert_eq!(array(&bench, &format!("d.{ending}"), "distance"), values, "{ending}");
        assert_eq!(array(&bench, &format!("d.{ending}"), "source"), [0.0; 642]);
    }
    for (name, format) in [("d.csv", ""), ("d.table", "--format csv"), ("D.CSV", "")] {
        bench.ok(&format!("mesh distance sphere.ply --source 100 -o {name} {format}"));
        assert_eq!(column(&bench, name, "distance"), values, "{name}");
    }
}

#[test]
fn every_method_is_as_good_as_it_says() {
    let (bench, sphere) = sphere();
    for (method, name, most) in [
        ("auto", "exact", 0.005),
        ("exact", "exact", 0.005),
        ("eikonal", "eikonal", 0.01),
        ("heat --time 3 --memory 1", "heat", 0.03),
        ("paper --iterations 300 --step 0.1", "paper", 0.1),
        ("paper", "paper", 0.08),
    ] {
        let command = format!("mesh distance sphere.ply --source 100 --method {method} --json");
        let report = bench.json(&format!("{command} -o d.npy --force"));
        assert_eq!(report["method"], name);
        let error = error(&bench.npy("d.npy").1, &sphere, sphere.points()[100]);
        println!("{method}: {error:.5}");
        assert!(error < most, "{method}: {error}");
    }
}

#[test]
fn vertices_keep_the_numbers_of_the_file() {
    let (bench, small) = (Bench::new(), icosphere(2));
    write(&bench, "small.stl", &small, &[]);
    let corners: Vec<[f64; 3]> =
        small.faces().iter().flatten().map(|&vertex| small.points()[vertex as usize]).collect();
    let mut text = String::new();
    for [x, y, z] in &corners {
        text += &format!("v {x} {y} {z}\n");
    }
    for first in (1..corners.len()).step_by(3) {
        text += &format!("f {first} {} {}\n", first + 1, first + 2);
    }
    fs::write(bench.path("torn.obj"), text).unwrap();
    for input in ["small.stl", "torn.obj --weld 0", "torn.obj --weld 1e-6"] {
        let command = format!("mesh distance {input} --source 500 -o d.npy --force --json");
        let report = bench.json(&command);
        assert_eq!((&report["reached"], &report["mesh"]["vertices"]), (&json!(162), &json!(162)));
        let values = bench.npy("d.npy").1;
        assert_eq!((values.len(), values[500]), (960, 0.0), "{input}");
        for (value, &corner) in values.iter().zip(&corners) {
            let expected = arc(corner, corners[500]);
            assert!((value - expected).abs() < 0.04, "{input}: {value} for {expected}");
        }
    }
    bench.ok("mesh distance small.stl --source 500 -o joined.ply");
    assert_eq!(array(&bench, "joined.ply", "distance").len(), 162);
    for input in ["torn.obj", "small.stl --no-weld"] {
        let torn = bench.run(&format!("mesh distance {input} --source 500 -o d.npy --force"));
        let told = String::from_utf8(torn.stderr).unwrap();
        assert!(told.contains("--weld 0` joins them): 798"), "{told}");
        assert!(told.contains("3 vertices reached, 957 not"), "{told}");
    }
}

#[test]
fn sources_are_points_of_the_surface() {
    let (bench, sphere) = sphere();
    let unit = [3.0, 2.0, 1.0].map(|x: f64| x / 14.0_f64.sqrt());
    let [x, y, z] = unit;
    bench.ok(&format!("mesh distance sphere.ply --source {x},{y},{z} -o d.npy"));
    let snapped = error(&bench.npy("d.npy").1, &sphere, unit);
    assert!(snapped < 0.005, "{snapped}");
    let poles = [[-2.0, 0.0, 0.0], [0.0, 0.5, -1.0]];
    fs::write(bench.path("p.csv"), "x,y,z\n-2,0,0\n0,0.5,-1\n").unwrap();
    fs::write(bench.path("p.json"), json!(poles).to_string()).unwrap();
    for (file, name) in [("p.csv", "c.ply"), ("p.json", "j.ply")] {
        bench.ok(&format!("mesh distance sphere.ply --source 0 --sources {file} -o {name}"));
    }
    assert_eq!(fs::read(bench.path("c.ply")).unwrap(), fs::read(bench.path("j.ply")).unwrap());
    let [labels, values] = ["source", "distance"].map(|name| array(&bench, "c.ply", name));
    let length = 1.25_f64.sqrt();
    let places = [sphere.points()[0], [-1.0, 0.0, 0.0], [0.0, 0.5 / length, -1.0 / length]];
    for (vertex, &point) in sphere.points().iter().enumerate() {
        let arcs = places.map(|place| arc(place, point));
        assert!((values[vertex] - arcs[labels[vertex] as usize]).abs() < 0.02);
        assert!(
            arcs[labels[vertex] as usize] < arcs.iter().fold(9.0, |a: f64, b| a.min(*b)) + 0.02
        );
    }
}

#[test]
fn distances_from_a_border() {
    let bench = square();
    // Points at the vertices of the border, so that those of the curve are there too.
    let sides = (0..=64).map(|step| {
        let [side, along] = [step / 16 % 4, step % 16];
        [[along, 0], [16, along], [16 - along, 16], [0, 16 - along]][side]
    });
    let table: String = sides.map(|[x, y]| format!("{x},{y},0\n")).collect();
    fs::write(bench.path("border.csv"), table).unwrap();
    // Fast marching takes the edge that cuts off a corner for a part of the border.
    for (method, most) in [("exact", 1e-12), ("eikonal", 0.35)] {
        let border = format!("square.ply --curve border.csv --method {method}");
        bench.ok(&format!("mesh distance {border} -o d.ply --overlay border.png --force"));
        assert!(array(&bench, "d.ply", "source").iter().all(|&curve| curve == 0.0));
        for (vertex, value) in array(&bench, "d.ply", "distance").into_iter().enumerate() {
            let [x, y] = [vertex % 17, vertex / 17];
            let expected = x.min(16 - x).min(y).min(16 - y) as f64;
            assert!((value - expected).abs() < most, "{method} {x},{y}: {value}");
        }
    }
}

#[test]
fn what_is_not_connected_is_not_reached() {
    let bench = two_spheres();
    let report = bench.json("mesh distance two.ply --source 3 -o d.npy --json");
    let facts = [&report["reached"], &report["unreached"], &report["mesh"]["components"]];
    assert_eq!(facts, [162, 162, 2]);
    assert!(number(&report["max"]) < 3.2);
    let values = bench.npy("d.npy").1;
    assert!(values[..162].iter().all(|value| value.is_finite()));
    assert!(values[162..].iter().all(|&value| value == f64::INFINITY));
    bench.ok("mesh distance two.ply --source 3 -o d.ply --overlay d.png");
    assert_eq!(array(&bench, "d.ply", "distance"), values);
    assert_eq!(array(&bench, "d.ply", "source")[162..], [-1.0; 162]);
    bench.ok("mesh distance two.ply --source 3 -o d.vtp");
    assert!(array(&bench, "d.vtp", "distance")[162..].iter().all(|value| value.is_nan()));
    for method in ["exact", "eikonal", "heat", "paper"] {
        let lost = bench.run(&format!(
            "mesh path two.ply --source 3 --end 200 --end 50 --method {method} -o {method}.json"
        ));
        let told = String::from_utf8(lost.stderr).unwrap();
        assert_eq!(lost.status.code(), Some(5), "{told}");
        assert!(told.contains("1 of 2 paths"), "{told}");
        let file = fs::read_to_string(bench.path(&format!("{method}.json"))).unwrap();
        let written: Value = serde_json::from_str(&file).unwrap();
        let ended = [0, 1].map(|path| paths(&written)[path]["ended"].as_str().unwrap());
        assert_eq!(ended, ["unreachable", "source"]);
    }
}

#[test]
fn distances_end_at_the_farthest() {
    let (bench, _) = sphere();
    for method in ["auto", "exact", "eikonal", "heat"] {
        let command = format!("mesh distance sphere.ply --source 0 --method {method} -o d.npy");
        let report = bench.json(&format!("{command} --farthest 1 --force --json"));
        let values = bench.npy("d.npy").1;
        let reached = values.iter().filter(|value| value.is_finite()).count();
        // A cap of that radius has the part (1 - cos 1) / 2 of the sphere.
        assert!((120..180).contains(&reached), "{method}: {reached}");
        assert!(values.iter().all(|&value| value <= 1.0 || value == f64::INFINITY));
        assert_eq!(report["reached"], reached);
    }
    bench.fails(
        "mesh distance sphere.ply --source 0.1,0.2,1 --farthest 1e-9 --json",
        5,
        &["--farthest"],
    );
}

#[test]
fn values_of_the_file_are_media() {
    let (bench, _) = sphere();
    let max = |options: &str| {
        let command = format!("mesh distance sphere.ply --source 0 --method eikonal {options}");
        number(&bench.json(&format!("{command} --json"))["max"])
    };
    let uniform = max("");
    let fast = max("--medium speed --scalars four");
    assert!((fast / uniform - 0.5).abs() < 1e-12, "P = 4 is twice as fast: {fast} {uniform}");
    let alike = max("--medium scalars --scalars four --floor 3");
    assert!((alike / uniform - 0.5).abs() < 1e-12, "P = 1 + 3: {alike} {uniform}");
    let unlike = max("--medium scalars --scalars height");
    assert!(unlike > 1.2 * uniform, "{unlike} {uniform}");
    assert!(max("--medium scalars --scalars height --power 1") < unlike);
}

#[test]
fn creases_are_fast() {
    let (bench, Block { mesh, sharp_edges }) = (Bench::new(), block(4));
    write(&bench, "block.ply", &mesh, &[]);
    let [first, last] = [sharp_edges[0][0], sharp_edges[sharp_edges.len() - 1][1]];
    let values = |options: &str| {
        let command = format!("mesh distance block.ply --source {first} --method eikonal");
        bench.ok(&format!("{command} {options} -o d.npy --force"));
        bench.npy("d.npy").1
    };
    let uniform = values("");
    for medium in ["crease", "curvature", "crease --bend convex --power 2 --floor 0.05"] {
        let found = values(&format!("--medium {medium} --radius 0.4"));
        let mut sums = [[0.0; 2]; 2];
        for vertex in (0..uniform.len()).filter(|&vertex| uniform[vertex] > 0.0) {
            let is_sharp = sharp_edges.iter().flatten().any(|&end| end as usize == vertex);
            let sum = &mut sums[usize::from(is_sharp)];
            *sum = [sum[0] + found[vertex], sum[1] + uniform[vertex]];
        }
        let [off, on] = sums.map(|[found, uniform]| found / uniform);
        assert!(on < 0.9 * off, "{medium}: {on} on edges, {off} elsewhere");
    }
    for medium in ["curvature", "crease"] {
        let ends = format!("--source {first} --end {last} --end 0");
        let command = format!("mesh path block.ply {ends} --medium {medium} --method paper");
        let found = bench.json(&format!("{command} --json"));
        assert!(paths(&found).iter().all(|path| path["ended"] == "source"), "{medium}");
    }
}

#[test]
fn paths_in_every_format() {
    let (bench, sphere) = sphere();
    let command = "mesh path sphere.ply --source 0 --source 1 --end 100 --end 0,0,3";
    for method in ["auto", "eikonal", "heat", "paper"] {
        let printed = bench.json(&format!("{command} --method {method} -o p.json --json --force"));
        let file = fs::read_to_string(bench.path("p.json")).unwrap();
        assert_eq!(printed, serde_json::from_str::<Value>(&file).unwrap());
        assert_eq!([&printed["version"], &printed["dimension"]], [1, 3]);
        assert_eq!(paths(&printed).len(), 2);
        for path in paths(&printed) {
            assert_eq!(path["ended"], "source", "{method}");
            let points: Vec<[f64; 3]> = serde_json::from_value(path["points"].clone()).unwrap();
            let source = path["source"].as_u64().unwrap() as usize;
            assert_eq!(path["points"][0], path["end"]);
            assert_eq!(points.last(), Some(&sphere.points()[source]), "{method}");
            let expected = arc(points[0], sphere.points()[source]);
            for (key, most) in [("length", 0.05), ("physical_length", 0.05), ("distance", 0.12)] {
                let off = number(&path[key]) / expected - 1.0;
                assert!(off.abs() < most, "{method}: {key} {} for {expected}", path[key]);
            }
        }
    }
    let count: usize = {
        let printed = bench.json(&format!("{command} --json"));
        paths(&printed).iter().map(|path| path["points"].as_array().unwrap().len()).sum()
    };
    bench.ok(&format!("{command} -o p.csv"));
    assert_eq!(column(&bench, "p.csv", "x").len(), count);
    for ending in ["vtp", "swc"] {
        bench.ok(&format!("{command} -o p.{ending}"));
        assert!(fs::metadata(bench.path(&format!("p.{ending}"))).unwrap().len() > 100);
    }
    fs::write(bench.path("ends.csv"), "x,y,z\n0,0,3\n").unwrap();
    let ends = bench.json("mesh path sphere.ply --source 0 --ends ends.csv --json");
    assert_eq!(paths(&ends).len(), 1);
}

#[test]
fn paths_lead_through_points_and_become_short() {
    let (bench, sphere) = sphere();
    let [a, b, c, d] = [0, 400, 77, 230].map(|vertex| sphere.points()[vertex]);
    let expected = arc(a, b) + arc(b, c) + arc(c, d);
    for options in ["", "--method eikonal", "--method heat --shorten", "--method paper --shorten"] {
        let command = "mesh path sphere.ply --end 0 --through 400 --through 77 --source 230";
        let printed = bench.json(&format!("{command} {options} --json"));
        let path = &paths(&printed)[0];
        assert_eq!(path["ended"], "source");
        let off = number(&path["length"]) / expected - 1.0;
        assert!(off.abs() < 0.01, "{options}: {}", path["length"]);
        let points: Vec<[f64; 3]> = serde_json::from_value(path["points"].clone()).unwrap();
        assert!(points.contains(&b) && points.contains(&c), "{options}");
    }
    let length = |options: &str| {
        let command = format!("mesh path sphere.ply --source 0 --end 500 {options} --json");
        number(&paths(&bench.json(&command))[0]["length"])
    };
    let (exact, rough) = (length(""), length("--method paper"));
    let short = length("--method paper --shorten");
    assert!(exact < rough && (short / exact - 1.0).abs() < 1e-3, "{exact} {rough} {short}");
}

#[test]
fn the_curvature_of_a_sphere() {
    let (bench, _) = sphere();
    for estimator in ["normal-cycles", "least-squares", "normal-cycles --radius 0.5"] {
        let command = format!("mesh curvature sphere.ply --estimator {estimator}");
        let report = bench.json(&format!("{command} -o k.ply --json --force"));
        for key in ["minimum", "maximum", "mean"] {
            let off = (number(&report[key]) - 1.0).abs();
            assert!(
                off < if key == "mean" { 0.03 } else { 0.15 },
                "{estimator}: {key} {}",
                report[key]
            );
        }
        let [low, high, mean, gaussian] =
            ["minimum", "maximum", "mean", "gaussian"].map(|name| array(&bench, "k.ply", name));
        for vertex in 0..642 {
            assert!(low[vertex] <= high[vertex]);
            assert!((mean[vertex] - 0.5 * (low[vertex] + high[vertex])).abs() < 1e-12);
            assert!((gaussian[vertex] - low[vertex] * high[vertex]).abs() < 1e-12);
        }
    }
    bench.ok("mesh curvature sphere.ply -o k.npy --overlay k.png");
    assert_eq!(bench.npy("k.npy").0, [642, 4]);
    assert!(bench.path("k.png").exists());
}

#[test]
fn pictures_have_colours() {
    let (bench, _) = sphere();
    let colours = |file: &str| {
        let picture = image::open(bench.path(file)).unwrap().into_rgb8();
        let [low, high] = [u8::min, u8::max]
            .map(|most| move |pixel: &image::Rgb<u8>| pixel.0.into_iter().reduce(most).unwrap());
        picture.pixels().filter(|pixel| high(pixel) - low(pixel) > 60).count()
    };
    let views = ["", "--up z --isolines 9", "--view -30,20 --up y"];
    for (number, view) in views.into_iter().enumerate() {
        let file = format!("{number}.png");
        bench.ok(&format!("mesh distance sphere.ply --source 0 --overlay {file} {view}"));
        assert!(colours(&file) > 50_000, "{view}: {}", colours(&file));
    }
    let seen: Vec<Vec<u8>> =
        (0..3).map(|number| fs::read(bench.path(&format!("{number}.png"))).unwrap()).collect();
    assert!(seen[0] != seen[1] && seen[0] != seen[2] && seen[1] != seen[2]);
    bench.ok("mesh path sphere.ply --source 0 --end 9 --overlay p.png --isolines 1000000000");
    assert!(colours("p.png") > 10_000);
}

#[test]
fn what_is_in_a_mesh_file() {
    let (bench, _) = sphere();
    let words = bench.ok("info sphere.ply");
    for word in
        ["PLY", "642 vertices", "1280 triangles", "height, four, broken", "from -1,-1,-1 to 1,1,1"]
    {
        assert!(words.contains(word), "{words}");
    }
    let report = bench.json("info sphere.ply --json");
    assert_eq!(report["format"], "PLY");
    assert_eq!(report["values"], json!(["height", "four", "broken"]));
    assert_eq!(report["bounds"], json!([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]]));
    assert!((0.1..0.2).contains(&number(&report["mean_edge"])));
    assert_eq!(report["mesh"]["euler_characteristic"], 2);
    bench.write_npy("picture.npy", &[4, 5], |i| i as f64);
    assert!(bench.ok("info picture.npy").contains("5 x 4 pixels"));
    fs::write(bench.path("words.txt"), "neither\n").unwrap();
    bench.fails("info words.txt", 3, &["words.txt", "no known picture and no known mesh"]);
    bench.fails("info nothing.ply", 4, &["nothing.ply"]);
}

#[test]
fn nothing_is_said_but_what_was_asked_for() {
    let bench = two_spheres();
    for command in [
        "mesh distance two.ply --source 0",
        "mesh path two.ply --source 0 --end 9",
        "mesh curvature two.ply",
    ] {
        let printed = bench.run(&format!("{command} --json"));
        assert!(printed.stderr.is_empty(), "{command}");
        assert!(serde_json::from_slice::<Value>(&printed.stdout).unwrap().is_object());
        let quiet = bench.run(&format!("{command} --overlay x.png --force --quiet"));
        assert!(quiet.stderr.is_empty() && quiet.stdout.is_empty(), "{command}");
        let told = bench.run(&format!("{command} --overlay x.png --force"));
        assert!(!told.stderr.is_empty() && told.stdout.is_empty(), "{command}");
    }
    for command in ["mesh", "mesh distance", "mesh path", "mesh curvature"] {
        let help = bench.ok(&format!("{command} --help"));
        assert!(help.contains("Usage: heatpath mesh") && !help.contains("volume"), "{help}");
    }
}

#[test]
fn options_that_do_nothing_are_refused() {
    let (bench, _) = sphere();
    for (options, words) in [
        ("--method exact --medium curvature", ["same on all faces", "--method eikonal"]),
        ("--bend convex", ["--bend", "--medium curvature"]),
        ("--radius 1", ["--radius", "--medium crease"]),
        (
            "--estimator least-squares --medium scalars --scalars height",
            ["--estimator", "--medium"],
        ),
        ("--scalars height", ["--scalars", "--medium speed"]),
        ("--floor 0.1", ["--floor", "--medium"]),
        ("--power 2 --medium speed --scalars four", ["--power", "--medium"]),
        ("--time 1", ["--time", "--method heat"]),
        ("--memory 1 --method eikonal", ["--memory", "--method heat"]),
        ("--iterations 9", ["--iterations", "--method paper"]),
        ("--step 0.1 --method heat", ["--step", "--method paper"]),
        ("--farthest 1 --method paper", ["--farthest", "--method auto"]),
        ("--farthest -1", ["farthest", "-1"]),
        ("--farthest nan", ["farthest", "NaN"]),
        ("--method heat --memory 0", ["--memory", "positive"]),
        ("--method heat --memory nan", ["--memory", "NaN"]),
        ("--method heat --memory inf", ["--memory", "inf"]),
        ("--method heat --time -1", ["time", "-1"]),
        ("--method paper --iterations 0", ["iterations", "0"]),
        ("--method paper --step -1", ["step", "-1"]),
        ("--weld nan", ["weld", "NaN"]),
        ("--weld -1", ["weld", "-1"]),
        ("--medium crease --radius -1", ["radius", "-1"]),
        ("--medium crease --floor 2", ["floor", "2"]),
        ("--medium scalars --scalars height --power -1", ["power", "-1"]),
        ("--threads 100000000", ["100000000", "threads"]),
    ] {
        bench.fails(&format!("mesh distance sphere.ply --source 0 {options} -o x.ply"), 2, &words);
    }
    for options in [
        "--up z -o x.ply",
        "--view 1,2 -o x.ply",
        "--isolines 3 -o x.ply",
        "",
        "-o x.ply --medium speed",
        "--overlay x.png --view nan,0",
        "--json --source 0,0,inf",
        "--json --weld 0 --no-weld",
    ] {
        let refused = bench.run(&format!("mesh distance sphere.ply --source 0 {options}"));
        assert_eq!(refused.status.code(), Some(2), "{options}");
    }
    for output in ["x.obj", "x.tif", "x", "x.ply --format stl"] {
        bench.fails(&format!("mesh distance sphere.ply --source 0 -o {output}"), 2, &[".vtp"]);
        bench.fails(&format!("mesh curvature sphere.ply -o {output}"), 2, &[".vtp"]);
    }
    bench.fails("mesh path sphere.ply --source 0 --end 1 -o x.ply", 2, &[".json", ".vtp"]);
    bench.fails("mesh distance sphere.ply --source 0 --overlay x.jpg", 2, &[".png"]);
}

#[test]
fn bad_input_is_named() {
    let (bench, _) = sphere();
    let bytes = fs::read(bench.path("sphere.ply")).unwrap();
    fs::write(bench.path("cut.ply"), &bytes[..bytes.len() / 2]).unwrap();
    fs::write(bench.path("empty.ply"), "").unwrap();
    fs::write(bench.path("words.txt"), "neither\n").unwrap();
    fs::write(bench.path("pair.csv"), "1,2\n").unwrap();
    write(&bench, "bare.off", &icosphere(1), &[]);
    fs::write(bench.path("lone.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n").unwrap();
    for (arguments, code, words) in [
        ("cut.ply --source 0", 3, ["cut.ply", "PLY"]),
        ("empty.ply --source 0", 3, ["empty.ply", "empty"]),
        ("words.txt --source 0", 3, ["words.txt", "mesh"]),
        ("nothing.ply --source 0", 4, ["nothing.ply", "read"]),
        ("sphere.ply --source 3 --source 642", 3, ["source 1 is vertex 642", "has 642"]),
        ("lone.obj --source 3 --quiet", 3, ["source 0 is vertex 3", "no face"]),
        ("sphere.ply --sources pair.csv", 3, ["pair.csv", "line 1"]),
        ("sphere.ply --curve pair.csv", 3, ["pair.csv", "line 1"]),
        ("sphere.ply --curve nothing.csv", 4, ["nothing.csv", "read"]),
        ("sphere.ply --source 0 --medium speed --scalars no", 3, ["`no`", "height, four, broken"]),
        ("bare.off --source 0 --medium speed --scalars no", 3, ["`no`", "none"]),
        ("sphere.ply --source 0 --medium speed --scalars height", 3, ["squared speed", "vertex"]),
        ("sphere.ply --source 0 --medium scalars --scalars broken", 3, ["`broken`", "vertex 7"]),
        ("sphere.ply --source 0 --method paper --step 9", 3, ["9", "stable"]),
        ("sphere.ply --source 0 --method heat --memory 1e-5", 3, ["--memory", "eikonal"]),
    ] {
        bench.fails(&format!("mesh distance {arguments} -o x.ply"), code, &words);
    }
    for arguments in ["--end 642", "--end 1 --through 642"] {
        let command = format!("mesh path sphere.ply --source 0 {arguments} -o x.json");
        bench.fails(&command, 3, &["0 is vertex 642", "has 642"]);
    }
    for command in ["mesh distance sphere.ply --source 0", "mesh curvature sphere.ply"] {
        bench.fails(&format!("{command} -o sphere.ply"), 4, &["sphere.ply", "--force"]);
        bench.fails(&format!("{command} -o no/x.ply"), 4, &["no/x.ply"]);
    }
    assert_eq!(fs::read(bench.path("sphere.ply")).unwrap(), bytes);
    bench.ok("mesh distance sphere.ply --source 0 -o sphere.ply --force");
    assert_eq!(array(&bench, "sphere.ply", "distance")[0], 0.0);
}
