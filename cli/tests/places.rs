//! Volumes with a place in the world through the command, as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use heatpath_core::grid::{Grid, Shape};
use heatpath_io::{CurveFile, FieldStyle, ImageFile, Placement, read_field, write_field};
use serde_json::json;
use std::fs;

/// Columns, rows, slices: different ones, so that mixed up axes show.
const SIZE: [usize; 3] = [20, 16, 12];
const SPACING: [f64; 3] = [0.5, 0.8, 2.0];
const ENDINGS: [&str; 6] = ["nii", "nii.gz", "nrrd", "nhdr", "mha", "mhd"];

/// Turned by 30 degrees about z, and then on its side.
fn place() -> Placement {
    let (s, c) = (0.5, 0.75_f64.sqrt());
    Placement {
        origin: [-31.5, 20.25, 112.0],
        direction: [[c, s, 0.0], [0.0, 0.0, -1.0], [-s, c, 0.0]],
    }
}

fn values() -> Grid<f64, 3> {
    Grid::from_fn(Shape::with_spacing(SIZE, SPACING).unwrap(), |index| {
        let [x, y, z] = index.map(|n| n as f64);
        0.5 + 0.5 * (0.3 * x + 0.1 * z).sin() * (0.2 * y - 0.25 * z).cos()
    })
}

fn write(bench: &Bench, name: &str, placement: Option<Placement>) {
    let style = FieldStyle { placement, ..FieldStyle::default() };
    write_field(bench.path(name), None, true, &values(), &style).unwrap();
}

/// A bench with `v.nrrd`, and `v.npy` of the same values without a place.
fn bench() -> Bench {
    let bench = Bench::new();
    write(&bench, "v.nrrd", Some(place()));
    write(&bench, "v.npy", None);
    bench
}

/// A point in voxels as an argument in the world.
fn world(index: [f64; 3]) -> String {
    place().to_world(index, SPACING).map(|x| format!("{x:?}")).join(",")
}

fn close(one: &[f64], other: &[f64], gap: f64) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(a, b)| (a - b).abs() <= gap)
}

#[test]
fn distances_of_a_turned_volume_from_a_point_in_the_world() {
    let bench = bench();
    // Not between two cells, where the last bit of a coordinate would decide.
    bench.ok("distance v.npy --spacing 0.5,0.8,2 --source 3,4.25,2 -o plain.npy");
    let source = world([3.0, 4.25, 2.0]);
    let (_, expected) = bench.npy("plain.npy");
    for ending in ENDINGS {
        let output = format!("d-{}.{ending}", ending.replace('.', "-"));
        bench.ok(&format!("distance v.nrrd --physical --source {source} -o {output}"));
        let file = ImageFile::read(bench.path(&output)).unwrap();
        let found = file.placement().unwrap();
        assert!(close(&found.origin, &place().origin, 1e-5), "{ending}: {found:?}");
        let [one, other] = [found.direction, place().direction];
        assert!(close(one.as_flattened(), other.as_flattened(), 1e-6), "{ending}: {found:?}");
        assert!(close(&file.spacing::<3>().unwrap(), &SPACING, 1e-6), "{ending}");
        let distances = file.into_field::<3>(None).unwrap();
        assert!(close(distances.values(), &expected, 1e-9), "{ending}");
    }
    bench.fails(
        "distance v.nrrd --physical --source 3,4.5,2 -o x.nrrd",
        3,
        &["source 0", "outside"],
    );
}

#[test]
fn curves_lie_in_the_world_and_come_back() {
    let bench = bench();
    let points = format!("--source {} --end {}", world([3.0, 4.0, 2.0]), world([16.0, 12.0, 9.0]));
    let json = bench.json(&format!("path v.nrrd --physical {points} -o p.swc --json"));
    bench.ok(&format!("path v.nrrd --physical {points} -o p.vtp"));
    bench.ok(&format!("path v.nrrd --physical {points} -o p.csv"));
    // NRRD keeps the product of spacing and direction.
    let spacing: Vec<f64> = serde_json::from_value(json["spacing"].clone()).unwrap();
    assert!(close(&spacing, &SPACING, 1e-14), "{spacing:?}");
    let origin: Vec<f64> = serde_json::from_value(json["origin"].clone()).unwrap();
    let direction: [[f64; 3]; 3] = serde_json::from_value(json["direction"].clone()).unwrap();
    assert!(
        close(&origin, &place().origin, 1e-12) && close(&direction[1], &[0.0, 0.0, -1.0], 1e-9)
    );
    let pixels: Vec<[f64; 3]> = serde_json::from_value(json["paths"][0]["points"].clone()).unwrap();
    assert!(close(&pixels[0], &[16.0, 12.0, 9.0], 1e-9), "points stay in voxels");
    // The root of the tree is the source.
    let text = fs::read_to_string(bench.path("p.swc")).unwrap();
    let root: Vec<f64> = text
        .lines()
        .nth(1)
        .unwrap()
        .split(' ')
        .skip(2)
        .take(3)
        .map(|x| x.parse().unwrap())
        .collect();
    assert!(close(&root, &place().to_world([3.0, 4.0, 2.0], SPACING), 1e-9), "{text}");
    let vtp = fs::read_to_string(bench.path("p.vtp")).unwrap();
    assert!(vtp.contains(&format!("{}", place().to_world(pixels[0], SPACING)[0])));
    let file = CurveFile::read(bench.path("p.swc")).unwrap();
    let back = &file.into_polylines::<3>(SPACING, Some(place())).unwrap()[0];
    for point in back {
        assert!(pixels.iter().any(|pixel| close(pixel, point, 1e-9)), "{point:?}");
    }
}

#[test]
fn masks_media_and_truths_must_lie_where_the_volume_does() {
    let bench = bench();
    let moved = Placement { origin: [-31.5, 20.25, 113.0], ..place() };
    write(&bench, "moved.mha", Some(moved));
    write(&bench, "there.nii", Some(place()));
    let distance = "distance v.nrrd --source 3,4,2 -o d.nrrd --force";
    for name in ["there.nii", "v.npy"] {
        bench.ok(&format!("{distance} --mask {name}"));
    }
    let words = ["moved.mha", "lies elsewhere", "1.000 away", "v.nrrd"];
    fs::remove_file(bench.path("d.nrrd")).unwrap();
    bench.fails(&format!("{distance} --mask moved.mha"), 3, &words);
    bench.fails(&format!("{distance} --medium file --medium-file moved.mha"), 3, &words);
    bench.ok(&format!("{distance} --mask moved.mha --spacing 0.5,0.8,2"));
    // A curve in the world against a mask that says where it lies.
    bench.ok("path v.nrrd --source 3,4,2 --end 16,12,9 -o p.swc");
    bench.ok("path v.nrrd --source 3,4,2 --end 16,12,9 -o p.json");
    let line = Grid::from_fn(*values().shape(), |index| f64::from(u8::from(index == [3, 4, 2])));
    let style = FieldStyle { placement: Some(place()), ..FieldStyle::default() };
    write_field(bench.path("line.nrrd"), None, false, &line, &style).unwrap();
    let scores = |file: &str| {
        bench.json(&format!("evaluate --extracted {file} --truth line.nrrd --tolerance 2 --json"))
    };
    let [swc, json] = [scores("p.swc"), scores("p.json")].map(|s| s["precision"].as_f64().unwrap());
    assert!(swc > 0.0 && (swc - json).abs() < 1e-9, "{swc} {json}");
    // Masks that say that they lie apart.
    let moved = FieldStyle { placement: Some(moved), ..FieldStyle::default() };
    write_field(bench.path("moved.nrrd"), None, false, &line, &moved).unwrap();
    let evaluate = "evaluate --truth line.nrrd --tolerance 2 --extracted";
    let words = ["moved.nrrd", "lies elsewhere", "1.000 away", "line.nrrd"];
    bench.fails(&format!("{evaluate} moved.nrrd"), 3, &words);
    bench.fails(&format!("{evaluate} p.json --mask moved.nrrd"), 3, &words);
    bench.ok(&format!("{evaluate} moved.nrrd --spacing 0.5,0.8,2"));
    bench.ok(&format!("{evaluate} line.nrrd --mask line.nrrd"));
}

#[test]
fn info_tells_the_place() {
    let bench = bench();
    let text = bench.ok("info v.nrrd");
    assert!(text.contains("20 x 16 x 12 voxels") && text.contains("float64"), "{text}");
    assert!(text.contains("origin -31.5,20.25,112 (LPS)") && text.contains("(0,0,-1)"), "{text}");
    let json = bench.json("info v.nrrd --json");
    assert_eq!((&json["origin"], &json["format"]), (&json!(place().origin), &json!("nrrd")));
    assert_eq!(json["direction"].as_array().unwrap().len(), 3);
    let json = bench.json("info v.npy --json");
    assert!(json.get("origin").is_none() && json.get("spacing").is_none());
}

#[test]
fn a_component_is_chosen() {
    let bench = Bench::new();
    let head = "NDims = 4\nDimSize = 4 3 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
    let data: Vec<u8> = (0..48).collect();
    fs::write(bench.path("two.mha"), [head.as_bytes(), &data].concat()).unwrap();
    let distance = "distance two.mha --source 1,1,1 -o d.npy";
    bench.fails(distance, 3, &["two.mha", "from 0 to 1"]);
    bench.fails(&format!("{distance} --component 2"), 3, &["from 0 to 1"]);
    bench.ok(&format!("{distance} --component 1"));
    assert_eq!(bench.json("info two.mha --component 1 --json")["min"], json!(24.0));
}

#[test]
fn a_header_of_the_same_stem_has_data_of_its_own() {
    let bench = bench();
    bench.ok("medium v.nrrd --source 3,4,2 -o k.mhd");
    let before = fs::read(bench.path("k.mhd.raw")).unwrap();
    bench.ok("distance k.mhd --source 3,4,2 -o k.nhdr --force");
    assert_eq!(fs::read(bench.path("k.mhd.raw")).unwrap(), before);
    let [input, output] =
        ["k.mhd", "k.nhdr"].map(|name| read_field::<3>(bench.path(name), None).unwrap());
    assert_ne!(input, output);
    bench.ok("medium v.nrrd --source 3,4,2 -o data.raw --format mhd");
    assert!(bench.path("data.raw.raw").exists());
    assert_eq!(read_field::<3>(bench.path("data.raw"), None).unwrap(), input);
}

#[test]
fn votes_and_media_keep_the_place_too() {
    let bench = bench();
    bench.ok("medium v.nrrd --source 3,4,2 -o k.nii.gz");
    bench.ok("vote v.nrrd --source 3,4,2 --structure 0.5 -o kept.mha --density votes.nrrd");
    bench.ok("keypoints v.nrrd --source 3,4,2 --structure 0.5 -o c.vtp --travelling t.mhd");
    assert!(bench.path("t.mhd.raw").exists());
    for name in ["k.nii.gz", "kept.mha", "votes.nrrd", "t.mhd"] {
        let found = ImageFile::read(bench.path(name)).unwrap().placement().unwrap();
        assert!(close(&found.origin, &place().origin, 1e-5), "{name}");
    }
    let kept = read_field::<3>(bench.path("kept.mha"), None).unwrap();
    assert!(kept.values().iter().all(|value| [0.0, 255.0].contains(value)));
}
