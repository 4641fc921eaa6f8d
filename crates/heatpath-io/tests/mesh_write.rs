//! Meshes, values and paths written and read back.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::mesh::TriMesh;
use heatpath_core::mesh::clean::CleanOptions;
use heatpath_core::mesh::path::{Ending, Path};
use heatpath_core::mesh::shapes::{icosphere, sheet};
use heatpath_io::{
    CurveFile, WriteError, curves_json, mesh_curves, read_field, read_mesh, read_mesh_values,
    write_mesh, write_mesh_paths, write_mesh_values,
};
use tempfile::tempdir;

/// A mesh of 32-bit floats.
fn single() -> TriMesh {
    sheet(3, 2, |x, y| [x as f64 * 0.5, y as f64 * 0.25, (x * y) as f64 - 1.0])
}

/// Not reached at vertex 1.
fn distances(mesh: &TriMesh) -> Vec<f64> {
    let distance = |i| if i == 1 { f64::INFINITY } else { 0.1 * i as f64 };
    (0..mesh.points().len()).map(distance).collect()
}

#[test]
fn meshes_and_values_come_back() {
    let folder = tempdir().unwrap();
    for (mesh, kind) in [(single(), "single"), (icosphere(2), "double")] {
        let values = distances(&mesh);
        let labels: Vec<f64> = (0..mesh.points().len()).map(|i| (i % 3) as f64).collect();
        for ending in ["ply", "vtp", "vtk"] {
            let path = folder.path().join(format!("{kind}.{ending}"));
            let arrays = [("distance", &values[..]), ("nearest <source>", &labels[..])];
            write_mesh(&path, None, false, &mesh, &arrays).unwrap();
            let file = read_mesh(&path).unwrap();
            assert_eq!(file.clean(CleanOptions::default()).unwrap().mesh, mesh, "{ending}");
            let [(name, read), (_, read_labels)] = &file.arrays[..] else { panic!("{ending}") };
            assert_eq!((name.as_str(), read_labels), ("distance", &labels));
            assert_eq!((read[0], &read[2..]), (values[0], &values[2..]), "{ending}");
            // Infinite in PLY, NaN for VTK.
            assert!(if ending == "ply" { read[1] == f64::INFINITY } else { read[1].is_nan() });
        }
    }
}

#[test]
fn bare_meshes_come_back() {
    let folder = tempdir().unwrap();
    for mesh in [single(), icosphere(1)] {
        for ending in ["obj", "off", "ply", "vtp", "vtk"] {
            let path = folder.path().join(format!("mesh.{ending}"));
            write_mesh(&path, None, true, &mesh, &[]).unwrap();
            let file = read_mesh(&path).unwrap();
            assert_eq!(file.clean(file.usual_options()).unwrap().mesh, mesh, "{ending}");
        }
    }
    let (mesh, path) = (icosphere(2), folder.path().join("mesh.stl"));
    write_mesh(&path, None, false, &mesh, &[]).unwrap();
    let file = read_mesh(&path).unwrap();
    let cleaned = file.clean(file.usual_options()).unwrap();
    assert_eq!((cleaned.mesh.points().len(), cleaned.report.border_edges), (162, 0));
    for (vertex, &new) in mesh.faces().iter().flatten().zip(&cleaned.vertices) {
        let [old, new] = [mesh.points()[*vertex as usize], cleaned.mesh.points()[new as usize]];
        assert!((0..3).all(|axis| (old[axis] - new[axis]).abs() < 1e-6));
    }
}

#[test]
fn values_alone_are_tables() {
    let (folder, mesh) = (tempdir().unwrap(), single());
    let (values, ones) = (distances(&mesh), vec![1.0; 12]);
    let [table, one, two] = ["v.csv", "one.npy", "two.npy"].map(|name| folder.path().join(name));
    write_mesh_values(&table, None, false, mesh.points(), &[("distance", &values)]).unwrap();
    let text = std::fs::read_to_string(&table).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[..3], ["vertex,x,y,z,distance", "0,0,0,-1,0", "1,0.5,0,-1,inf"]);
    assert_eq!(lines.len(), 13);
    let arrays = [("distance", &values[..]), ("one", &ones[..])];
    write_mesh_values(&one, None, false, mesh.points(), &arrays[..1]).unwrap();
    write_mesh_values(&two, None, false, mesh.points(), &arrays).unwrap();
    let field = read_field::<2>(&two, [1.0; 2]).unwrap();
    assert_eq!(field.shape().size(), [2, 12]);
    assert_eq!((field[[0, 1]], field[[0, 2]], field[[1, 2]]), (f64::INFINITY, 0.2, 1.0));
    assert_eq!(read_mesh_values(one, None).unwrap(), values);
    assert_eq!(read_mesh_values(&table, None).unwrap(), values);
    let x: Vec<f64> = mesh.points().iter().map(|point| point[0]).collect();
    assert_eq!(read_mesh_values(&table, Some("x")).unwrap(), x);
    let text = |path, column| read_mesh_values(path, column).unwrap_err().to_string();
    assert!(text(&table, Some("w")).ends_with("line 1: no column is called \"w\""));
    assert!(text(&two, None).contains("an array of shape [12, 2]"));
}

#[test]
fn values_come_in_other_ways_too() {
    let folder = tempdir().unwrap();
    let file = |content: &[u8]| {
        let path = folder.path().join("lh.curv");
        std::fs::write(&path, content).unwrap();
        read_mesh_values(path, None)
    };
    let mut curvature = b"\xff\xff\xff\0\0\0\x02\0\0\0\x09\0\0\0\x01".to_vec();
    curvature.extend([0.5_f32, -2.0].iter().flat_map(|value| value.to_be_bytes()));
    assert_eq!(file(&curvature).unwrap(), [0.5, -2.0]);
    for length in 0..curvature.len() {
        assert!(file(&curvature[..length]).is_err(), "{length}");
    }
    assert_eq!(file(b"1\n2.5\ninf\n").unwrap(), [1.0, 2.5, f64::INFINITY]);
    assert_eq!(file(b"# a comment\nd\n1\n-2\n").unwrap(), [1.0, -2.0]);
    let error = file(b"1\n2\nthree\n").unwrap_err().to_string();
    assert!(error.ends_with("line 3: expected a number, found \"three\""), "{error}");
}

fn paths() -> [Path; 2] {
    let path = |positions: &[[f64; 3]], ending, distance| Path {
        points: Vec::new(),
        positions: positions.to_vec(),
        ending,
        length: 3.0,
        distance,
    };
    [
        path(&[[0.5, 0.0, 0.25], [1.5, 2.0, 2.25]], Ending::Source(7), 3.5),
        path(&[[0.0, 0.0, 9.0]], Ending::Unreachable, f64::INFINITY),
    ]
}

#[test]
fn paths_are_curves_in_space() {
    let (folder, paths) = (tempdir().unwrap(), paths());
    for ending in ["json", "csv"] {
        let path = folder.path().join(format!("paths.{ending}"));
        write_mesh_paths(&path, None, false, &paths).unwrap();
        let curves = CurveFile::read(&path).unwrap().into_polylines([1.0; 3], None).unwrap();
        assert_eq!(curves, [paths[0].positions.clone(), paths[1].positions.clone()], "{ending}");
    }
    let json = curves_json(&mesh_curves(&paths));
    assert_eq!(
        (json["dimension"].as_u64(), json["paths"][0]["source"].as_u64()),
        (Some(3), Some(7))
    );
    assert_eq!(json["paths"][1]["ended"], "unreachable");
    let path = folder.path().join("paths.vtp");
    write_mesh_paths(&path, None, false, &paths).unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let array = |name: &str| {
        let start = text.find(&format!("Name=\"{name}\"")).unwrap();
        text[start..].lines().nth(1).unwrap().trim().to_owned()
    };
    assert_eq!((array("end"), array("source")), ("0 1".to_owned(), "7 -1".to_owned()));
    assert_eq!((array("length"), array("distance")), ("3 3".to_owned(), "3.5 -1".to_owned()));
    assert_eq!(array("points"), "0.5 0 0.25 1.5 2 2.25 0 0 9");
}

#[test]
fn what_does_not_fit_is_refused() {
    let (folder, mesh) = (tempdir().unwrap(), single());
    let path = |name: &str| folder.path().join(name);
    let values = vec![0.0; 12];
    let error = write_mesh(path("a.obj"), None, false, &mesh, &[("d", &values)]).unwrap_err();
    assert!(matches!(error, WriteError::NoValues { .. }), "{error}");
    let error = write_mesh(path("a.ply"), None, false, &mesh, &[("d", &values[1..])]).unwrap_err();
    assert!(error.to_string().ends_with("11 values of \"d\" were given for 12 vertices"));
    let error = write_mesh(path("a.glb"), None, false, &mesh, &[]).unwrap_err();
    assert!(error.to_string().contains(".ply, .vtp, .vtk, .obj, .off, .stl"), "{error}");
    let error = write_mesh_paths(path("a.svg"), None, false, &paths()).unwrap_err();
    assert!(matches!(error, WriteError::Ending { .. }), "{error}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
