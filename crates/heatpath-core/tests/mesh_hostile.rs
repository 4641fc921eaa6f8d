//! Faces that lie in each other, vertices in one place: all methods end, and with numbers.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::mesh::distance::ExactError;
use heatpath_core::mesh::{
    Geodesics, GeodesicsError, GeodesicsOptions, Medium, Method, Sources, TriMesh,
};
use proptest::prelude::*;

/// A mesh on which flips came back to where they began.
fn without_end_of_flips() -> TriMesh {
    let points = vec![
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 1.000000001, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 1e-09, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 1e-09, 1.0],
        [1.0, 1.0, 0.0],
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
    ];
    let faces = vec![
        [0, 2, 4],
        [1, 6, 5],
        [0, 2, 1],
        [1, 5, 3],
        [0, 3, 1],
        [3, 1, 4],
        [4, 2, 7],
        [0, 10, 5],
        [5, 1, 0],
        [5, 4, 6],
        [7, 5, 3],
        [5, 2, 4],
    ];
    TriMesh::new(points, faces).unwrap()
}

/// A mesh on which windows multiply.
fn without_end_of_windows() -> TriMesh {
    let points = vec![
        [1.0, 1.000000001, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 1.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 1e-09, 0.0],
        [0.0, 2e-09, 1.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
    ];
    let faces = vec![
        [5, 3, 4],
        [3, 0, 5],
        [0, 5, 4],
        [3, 6, 5],
        [4, 3, 6],
        [1, 6, 11],
        [13, 0, 5],
        [1, 8, 10],
        [2, 4, 6],
        [4, 0, 2],
        [9, 2, 0],
        [6, 1, 5],
        [5, 0, 6],
    ];
    TriMesh::new(points, faces).unwrap()
}

/// Faces of which some lie in each other, at most two at each edge: windows do not end.
fn without_end_of_automatic_windows() -> TriMesh {
    let mut points = vec![[0.0; 3]; 14];
    points[0] = [0.0, 1.0 + 1e-9, 2e-9];
    points[2] = [0.0, 1.0, 1.0];
    points[5] = [1.0; 3];
    points[8] = [0.0, 1.0, 2e-9];
    points[11] = [1e-9, 1.0, 0.0];
    let faces = vec![[5, 11, 12], [0, 1, 2], [8, 11, 2], [2, 8, 11], [3, 4, 5], [1, 5, 8]];
    TriMesh::new(points, faces).unwrap()
}

/// Distances from the first corner, by all methods.
fn check(mesh: TriMesh) {
    let exec = Exec::single_threaded();
    let sources = Sources::at_vertices(&mesh, &[mesh.faces()[0][0]]).unwrap();
    let components = mesh.adjacency().components();
    let home = components[mesh.faces()[0][0] as usize];
    let Ok(medium) = Medium::uniform(mesh) else { return };
    for method in [Method::Auto, Method::Heat, Method::Eikonal, Method::Exact] {
        let options = GeodesicsOptions { method, ..GeodesicsOptions::default() };
        let geodesics = Geodesics::new(medium.clone(), options, &exec).unwrap();
        match geodesics.distance(&sources, &exec) {
            Ok(map) => {
                for (&value, &component) in map.values().iter().zip(&components) {
                    assert!(value >= 0.0, "{method:?}: {value}");
                    assert_eq!(value.is_finite(), component == home, "{method:?}");
                }
            }
            Err(GeodesicsError::Exact(ExactError::Windows { .. })) => {
                assert_eq!(method, Method::Exact);
            }
            Err(error) => panic!("{method:?}: {error}"),
        }
    }
}

#[test]
fn known_cases() {
    check(without_end_of_flips());
    check(without_end_of_windows());
    check(without_end_of_automatic_windows());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_faces_between_few_places(
        points in prop::collection::vec(prop::array::uniform3((0..2_i32, 0..3_i32)), 14),
        faces in prop::collection::vec((0..14_u32, 1..7_u32, 1..7_u32), 1..20),
    ) {
        let near = |(whole, tiny): (i32, i32)| f64::from(whole) + 1e-9 * f64::from(tiny);
        let points = points.into_iter().map(|point| point.map(near)).collect();
        let face = |(a, b, c): (u32, u32, u32)| [a, (a + b) % 14, (a + b + c) % 14];
        if let Ok(mesh) = TriMesh::new(points, faces.into_iter().map(face).collect()) {
            check(mesh);
        }
    }
}
