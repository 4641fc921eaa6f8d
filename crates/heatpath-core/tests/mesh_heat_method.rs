//! What the heat method on meshes promises beside accuracy, which `mesh_accuracy.rs` measures.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

#[path = "support/meshes.rs"]
mod meshes;

use heatpath_core::Exec;
use heatpath_core::mesh::distance::{
    DistanceMap, HeatMethod, HeatMethodOptions, NO_LABEL, NOT_REACHED,
};
use heatpath_core::mesh::shapes::icosphere;
use heatpath_core::mesh::{Medium, Source, Sources, SurfacePoint, TriMesh};
use meshes::{apart, jittered};

fn distances(mesh: &TriMesh, sources: &Sources) -> DistanceMap {
    let exec = Exec::single_threaded();
    let medium = Medium::uniform(mesh.clone()).unwrap();
    let method = HeatMethod::new(medium, HeatMethodOptions::default(), &exec).unwrap();
    method.distance(sources, &exec).unwrap()
}

/// Mean and largest relative error in per cent.
fn compare(mesh: &TriMesh, map: &DistanceMap, exact: impl Fn([f64; 3]) -> f64) -> [f64; 2] {
    let pairs = mesh.points().iter().zip(map.values()).map(|(&point, value)| (exact(point), value));
    let pairs = pairs.filter(|(right, _)| *right > 1e-9);
    let errors: Vec<f64> = pairs.map(|(right, value)| (value / right - 1.0).abs()).collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    [100.0 * mean, 100.0 * errors.iter().fold(0.0_f64, |most, &error| most.max(error))]
}

#[test]
fn labels_are_those_of_the_nearest_source() {
    let square = jittered(64);
    let places = [100_u32, 700, 1500, 2222, 2700, 3131, 3900, 4100];
    let starts = places.map(|vertex| square.points()[vertex as usize]);
    let nearest = |p: [f64; 3]| starts.iter().map(|&s| apart(p, s)).fold(f64::INFINITY, f64::min);
    let map = distances(&square, &Sources::at_vertices(&square, &places).unwrap());
    for (&point, &label) in square.points().iter().zip(map.labels()) {
        assert!(apart(point, starts[label as usize]) < nearest(point) + 0.01);
    }
    let curve = places.map(|vertex| Source {
        point: square.at_vertex("source", 0, vertex).unwrap(),
        offset: 0.0,
        label: 7,
    });
    let map = distances(&square, &Sources::with_offsets(&square, curve.to_vec()).unwrap());
    assert!(map.labels().iter().all(|&label| label == 7));
}

#[test]
fn offsets_and_places_within_faces() {
    let square = jittered(64);
    let point = |face: u32, weights| SurfacePoint { face, weights };
    let points = [point(4000, [0.2, 0.5, 0.3]), point(900, [0.0, 0.25, 0.75])];
    let offsets = [0.1, 0.0];
    let list = (0..2).map(|i| Source { point: points[i], offset: offsets[i], label: i as u32 });
    let sources = Sources::with_offsets(&square, list.collect()).unwrap();
    let starts = points.map(|point| square.position(&point));
    let exact = |p: [f64; 3]| (apart(p, starts[0]) + 0.1).min(apart(p, starts[1]));
    let [mean, largest] = compare(&square, &distances(&square, &sources), exact);
    assert!(mean < 0.4 && largest < 6.0);
}

#[test]
fn what_has_no_source_is_not_reached() {
    let one = icosphere(2);
    let count = one.points().len() as u32;
    let mut points = one.points().to_vec();
    points.extend(one.points().iter().map(|p| [p[0] + 3.0, p[1], p[2]]));
    points.push([9.0; 3]);
    let mut faces = one.faces().to_vec();
    faces.extend(one.faces().iter().map(|face| face.map(|vertex| vertex + count)));
    let mesh = TriMesh::new(points, faces).unwrap();
    let map = distances(&mesh, &Sources::at_vertices(&mesh, &[5]).unwrap());
    for (vertex, (&value, &label)) in map.values().iter().zip(map.labels()).enumerate() {
        let is_reached = vertex < count as usize;
        assert_eq!(value < NOT_REACHED, is_reached, "{vertex}: {value}");
        assert_eq!(label, if is_reached { 0 } else { NO_LABEL });
    }
}

#[test]
fn distances_scale_with_the_mesh() {
    let one = jittered(64);
    let sources = Sources::at_vertices(&one, &[2112]).unwrap();
    let right = distances(&one, &sources);
    for scale in [1e-6, 1e6, 1e-60, 1e60] {
        let points = one.points().iter().map(|p| p.map(|x| x * scale)).collect();
        let scaled = TriMesh::new(points, one.faces().to_vec()).unwrap();
        for (value, right) in distances(&scaled, &sources).values().iter().zip(right.values()) {
            assert!((value / scale - right).abs() < 1e-9, "{value} for {right} times {scale}");
        }
    }
}

#[test]
fn threads_change_nothing() {
    let mesh = jittered(64);
    let sets =
        [[5, 900], [77, 78], [2000, 4000]].map(|set| Sources::at_vertices(&mesh, &set).unwrap());
    let maps = [1, 3].map(|threads| {
        let exec = Exec::new(threads).unwrap();
        let medium = Medium::uniform(mesh.clone()).unwrap();
        let method = HeatMethod::new(medium, HeatMethodOptions::default(), &exec).unwrap();
        method.distances(&sets, &exec).unwrap()
    });
    assert_eq!(maps[0], maps[1]);
    for (map, set) in maps[0].iter().zip(&sets) {
        assert_eq!(*map, distances(&mesh, set));
    }
}
