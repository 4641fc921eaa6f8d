//! The plugin in `ParaView`, without a window: its filters say what the command says.

use crate::harness::{Host, has_cmake_and, has_program, heatpath, installed, workplace};
use heatpath_ffi_tests::{npy, repository, run, text};
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || root().is_some() && has_program("cmake") && has_program("ninja");
    vec![Host { name: "paraview", package: "python3-paraview", present, run: paraview }]
}

/// Where `ParaView` is: unpacked by `.ci/hosts`, because its Python conflicts with that of VTK, or
/// installed.
fn root() -> Option<PathBuf> {
    let unpacked = repository("target/paraview/usr");
    let places = [Some(unpacked), has_cmake_and("paraview-dev").then(|| "/usr".into())];
    places.into_iter().flatten().find(|root| root.join("bin/pvpython").exists())
}

/// The folder of libraries of the machine's kind.
fn libraries(root: &Path) -> PathBuf {
    let kind = text(&run(Command::new("cc").arg("-print-multiarch")));
    root.join("lib").join(kind.trim())
}

fn paraview() {
    let root = fs::canonicalize(root().unwrap()).unwrap();
    let libraries = libraries(&root);
    let cmake = libraries.join("cmake/paraview-5.11");
    let cmake = format!("-DParaView_DIR={}", cmake.display());
    let build = installed().build_project(Path::new("plugins/paraview"), &[&cmake]);
    let folder = workplace("paraview-files");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    write_volume(&folder);
    fs::write(folder.join("mesh.vtk"), mesh()).unwrap();
    let mut pvpython = Command::new(root.join("bin/pvpython"));
    pvpython.env("LD_LIBRARY_PATH", &libraries);
    pvpython.env("PYTHONPATH", root.join("lib/python3/dist-packages"));
    pvpython.arg(repository("ffi-tests/hosts/paraview/filters.py"));
    pvpython.arg(build.join("lib/Heatpath/Heatpath.so"));
    let geodesic = "paraview-5.11/plugins/GeodesicMeasurement/GeodesicMeasurement.so";
    let output = run(pvpython.arg(libraries.join(geodesic)).arg(&folder));
    let said = text(&output);
    let refusal = "source 0 at [99.0, 0.0, 0.0] lies outside the grid of [20, 17, 13] cells";
    assert!(said.contains(refusal), "{said}");
    let results = results(&String::from_utf8_lossy(&output.stdout));
    assert_eq!(results["outside"], [0.0]);
    let (points, told) = results["stopped"].split_first().unwrap();
    assert_eq!(*points, 0.0);
    assert!(told.iter().any(|finished| (0.3..0.9).contains(finished)), "{told:?}");
    volumes_agree(&folder, &results);
    meshes_agree(&folder, &results);
    the_other_filter_is_near(&results);
}

type Results = HashMap<String, Vec<f64>>;

/// A name and its numbers in each line.
fn results(output: &str) -> Results {
    let line = |line: &str| {
        let mut words = line.split(' ');
        let name = words.next().unwrap_or_default().to_owned();
        Some((name, words.map(|word| word.parse().ok()).collect::<Option<_>>()?))
    };
    output.lines().filter_map(line).collect()
}

/// Columns, rows, slices.
const SIZE: [usize; 3] = [20, 17, 13];

/// Writes the same volume for VTK and for the command; slices are 2.5 apart.
fn write_volume(folder: &Path) {
    let voxel = |i: usize| {
        let [x, y, z] = [i % SIZE[0], i / SIZE[0] % SIZE[1], i / SIZE[0] / SIZE[1]];
        let [x, y, z] = [x, y, z].map(|n| n as f64);
        (128.0 + 100.0 * (0.3 * x + 0.2 * z).sin() * (0.25 * y - 0.1 * z).cos()) as u8
    };
    let voxels: Vec<u8> = (0..SIZE.iter().product()).map(voxel).collect();
    let [columns, rows, slices] = SIZE;
    let header = format!(
        "# vtk DataFile Version 3.0\nvolume\nBINARY\nDATASET STRUCTURED_POINTS\n\
         DIMENSIONS {columns} {rows} {slices}\nORIGIN 0 0 0\nSPACING 1 1 2.5\n\
         POINT_DATA {}\nSCALARS grey unsigned_char 1\nLOOKUP_TABLE default\n",
        voxels.len()
    );
    fs::write(folder.join("volume.vtk"), [header.as_bytes(), &voxels].concat()).unwrap();
    fs::write(folder.join("volume.npy"), npy("|u1", &[slices, rows, columns], &voxels)).unwrap();
}

/// A dented sphere; its first point is a seed.
fn mesh() -> String {
    let (around, rings) = (40, 20);
    let mut points = vec![[0.0, 0.0, 1.0]];
    for ring in 1..rings {
        for step in 0..around {
            let angle = std::f64::consts::TAU * f64::from(step) / f64::from(around);
            let down = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
            let radius = 1.0 - 0.2 * (2.0 * angle).cos() * down.sin();
            let [x, y, z] = [angle.cos() * down.sin(), angle.sin() * down.sin(), down.cos()];
            points.push([radius * x, radius * y, z]);
        }
    }
    points.push([0.0, 0.0, -1.0]);
    let at = |ring: i32, step: i32| 1 + (ring - 1) * around + step % around;
    let mut faces = Vec::new();
    for step in 0..around {
        faces.push([0, at(1, step), at(1, step + 1)]);
        for ring in 1..rings - 1 {
            let [a, b] = [at(ring, step), at(ring, step + 1)];
            let [c, d] = [at(ring + 1, step), at(ring + 1, step + 1)];
            faces.extend([[a, c, b], [b, c, d]]);
        }
        let last = points.len() as i32 - 1;
        faces.push([at(rings - 1, step), last, at(rings - 1, step + 1)]);
    }
    let rows: String = points.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    let corners: String = faces.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect();
    let seeds = "1\n".to_owned() + &"0\n".repeat(points.len() - 1);
    format!(
        "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS {} double\n{rows}\
         POLYGONS {} {}\n{corners}POINT_DATA {}\nSCALARS seed double 1\nLOOKUP_TABLE default\n{seeds}",
        points.len(),
        faces.len(),
        4 * faces.len(),
        points.len(),
    )
}

/// Runs the command; returns the doubles of the array of numpy that it writes.
fn distances(folder: &Path, line: &str) -> Vec<f64> {
    let output = folder.join("command.npy");
    heatpath(line.split_whitespace(), &output);
    let bytes = fs::read(&output).unwrap();
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    bytes[start..].as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect()
}

fn volumes_agree(folder: &Path, results: &Results) {
    let volume = folder.join("volume.npy").display().to_string();
    let common = format!("{volume} --spacing 1,1,2.5 --source 4,5.25,3");
    let combined = "--medium combined --power 2 --contrast 0.05 --range 0,200";
    assert_eq!(results["heat"], distances(folder, &format!("distance {common}")));
    assert_eq!(results["combined"], distances(folder, &format!("distance {common} {combined}")));
    let tubes = "--medium vesselness --scale 1.5,2 --polarity dark --estimator heat-method";
    assert_eq!(results["tubes"], distances(folder, &format!("distance {common} {tubes}")));
    for (name, estimator) in [("path", "normalized"), ("eikonal", "eikonal")] {
        let ends = "--end 19,16,12 --end 1,2,1";
        lines_agree(
            folder,
            results,
            name,
            &format!("path {common} {ends} --estimator {estimator}"),
        );
    }
    let [_, rows, slices] = SIZE;
    let grey: Vec<u8> = results["flat_grey"].iter().map(|&grey| grey as u8).collect();
    let flat = folder.join("flat.npy");
    fs::write(&flat, npy("|u1", &[slices, rows], &grey)).unwrap();
    let line = format!("distance {} --spacing 1,2.5 --source 3,2", flat.display());
    assert_eq!(results["flat"], distances(folder, &line));
}

fn meshes_agree(folder: &Path, results: &Results) {
    let mesh = folder.join("mesh.vtk").display().to_string();
    let common = format!("{mesh} --source 0.875,0.125,0.25");
    for (name, method) in [("exact", "exact"), ("eikonal", "eikonal"), ("heat", "heat")] {
        let line = format!("mesh distance {common} --method {method}");
        assert_eq!(results[&format!("mesh_{name}")], distances(folder, &line), "{name}");
    }
    let line = format!("mesh path {common} --end -0.75,0.25,-0.375 --shorten");
    lines_agree(folder, results, "mesh_path", &line);
}

/// The lines of a filter are those that the command writes for VTK.
fn lines_agree(folder: &Path, results: &Results, name: &str, line: &str) {
    let output = folder.join("command.vtp");
    heatpath(line.split_whitespace(), &output);
    let vtp = fs::read_to_string(&output).unwrap();
    for array in ["points", "end", "source", "length", "distance"] {
        let start = vtp.split(&format!("Name=\"{array}\"")).nth(1).unwrap();
        let numbers = start.split(['>', '<']).nth(1).unwrap().split_whitespace();
        let numbers: Vec<f64> = numbers.map(|number| number.parse().unwrap()).collect();
        assert_eq!(results[&format!("{name}.{array}")], numbers, "{name}: {array}");
    }
}

/// `ParaView`'s own fast marching differs from exact distances by its error.
#[expect(clippy::print_stdout, reason = "docs/paraview.md quotes the figures")]
fn the_other_filter_is_near(results: &Results) {
    let (ours, theirs) = (&results["corner"], &results["theirs"]);
    assert_eq!(ours.len(), theirs.len());
    let differences = ours.iter().zip(theirs).map(|(ours, theirs)| (ours - theirs).abs());
    let largest = differences.clone().fold(0.0, f64::max);
    let mean = differences.sum::<f64>() / ours.len() as f64;
    let farthest = ours.iter().copied().fold(0.0, f64::max);
    println!("GeodesicMeasurement: mean {mean:.5}, largest {largest:.5}, of {farthest:.3}");
    assert!(largest > 0.0, "theirs is not exact");
    assert!(largest < 0.02, "{largest}");
}
