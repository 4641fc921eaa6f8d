//! Media on meshes: what they make of lengths and speeds.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::mesh::shapes::{icosphere, sheet, torus};
use heatpath_core::mesh::{
    Bend, Curvature, CurvatureMediumOptions, CurvatureOptions, Directed, Medium, TriMesh,
};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A sheet in a slanting plane, with vertices out of line.
fn slanted_sheet() -> TriMesh {
    sheet(12, 9, |column, row| {
        let (x, y) = (column as f64, row as f64);
        let (x, y) = (x + 0.2 * (1.3 * y + x).sin(), y + 0.2 * (2.1 * x).cos());
        [x, 0.6 * y, 0.8 * y]
    })
}

fn curvature(mesh: &TriMesh) -> Curvature {
    Curvature::new(mesh, CurvatureOptions::default(), &Exec::single_threaded()).unwrap()
}

/// The edges of a mesh as vectors.
fn edge_vectors(mesh: &TriMesh) -> Vec<[f64; 3]> {
    let points = mesh.points();
    let vector = |&[a, b]: &[u32; 2]| {
        std::array::from_fn(|axis| points[b as usize][axis] - points[a as usize][axis])
    };
    mesh.adjacency().edges().iter().map(vector).collect()
}

fn relative(a: f64, b: f64) -> f64 {
    (a - b).abs() / b
}

#[test]
fn a_constant_metric_measures_every_edge() {
    let mesh = slanted_sheet();
    let metric = [[2.0, 0.5, 0.1], [0.5, 1.0, -0.2], [0.1, -0.2, 3.0]];
    let medium = Medium::tensor(mesh.clone(), &vec![metric; mesh.faces().len()]).unwrap();
    assert_eq!(medium.mollified(), 0.0);
    for (edge, length) in edge_vectors(&mesh).iter().zip(medium.lengths()) {
        let square: f64 = (0..3)
            .flat_map(|i| (0..3).map(move |j| (i, j)))
            .map(|(i, j)| edge[i] * metric[i][j] * edge[j])
            .sum();
        assert!(relative(*length, square.sqrt()) < 1e-12);
    }
    assert!(medium.slowness().iter().all(|&slowness| slowness == 1.0));
    assert!(medium.speed_sq().iter().all(|&speed_sq| speed_sq == 1.0));
}

#[test]
fn a_direction_and_its_costs_are_the_metric_they_stand_for() {
    let mesh = slanted_sheet();
    let (along, across) = (0.5, 7.0);
    // Half of the direction sticks out of the plane and does not count.
    let directed = Directed { direction: [3.0, -0.8, 0.6], along, across };
    let medium = Medium::directed(mesh.clone(), &vec![directed; mesh.faces().len()]).unwrap();
    for (edge, length) in edge_vectors(&mesh).iter().zip(medium.lengths()) {
        let rest = edge[1].hypot(edge[2]);
        assert!(relative(*length, (along * edge[0]).hypot(across * rest)) < 1e-12);
    }
    // Straight out of the plane there is no direction.
    let out = Directed { direction: [0.0, -0.8, 0.6], along, across };
    let medium = Medium::directed(mesh.clone(), &vec![out; mesh.faces().len()]).unwrap();
    for (plain, length) in mesh.edge_lengths().iter().zip(medium.lengths()) {
        assert!(relative(*length, across * plain) < 1e-12);
    }
}

#[test]
fn slowness_of_faces_and_speed_of_vertices() {
    let mesh = slanted_sheet();
    let slowness: Vec<f64> = (0..mesh.faces().len()).map(|face| 1.0 + face as f64).collect();
    let medium = Medium::given_slowness(mesh.clone(), &slowness).unwrap();
    assert_eq!(medium.slowness(), slowness);
    // The first vertex has the faces 0 and 1.
    assert_eq!(medium.speed_sq()[0], 1.0 / (1.5 * 1.5));
    let speed_sq: Vec<f64> =
        (0..mesh.points().len()).map(|v| 1.0 / (1.0 + v as f64).powi(2)).collect();
    let medium = Medium::given(mesh.clone(), &speed_sq).unwrap();
    assert_eq!(*medium.speed_sq(), speed_sq);
    let [a, b, c] = mesh.faces()[7].map(|vertex| 1.0 + f64::from(vertex));
    assert!(relative(medium.slowness()[7], (a + b + c) / 3.0) < 1e-14);
}

#[test]
fn what_is_no_medium_is_named() {
    let mesh = slanted_sheet();
    let faces = mesh.faces().len();
    let text = |result: Result<Medium, _>| -> String {
        let error: heatpath_core::mesh::MediumError = result.unwrap_err();
        error.to_string()
    };
    assert_eq!(
        text(Medium::given_slowness(mesh.clone(), &[1.0; 3])),
        format!("3 values were given for {faces} faces")
    );
    let mut slowness = vec![1.0; faces];
    slowness[5] = -2.0;
    assert_eq!(
        text(Medium::given_slowness(mesh.clone(), &slowness)),
        "the slowness is -2 at face 5; it must be positive, from 1e-100 to 1e100"
    );
    let mut metric = vec![[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]; faces];
    metric[2][0][1] = 0.5;
    assert_eq!(
        text(Medium::tensor(mesh.clone(), &metric)),
        "the metric of face 2 is [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]; it must be \
         symmetric and positive definite, from 1e-100 to 1e100"
    );
    metric[2] = [[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert!(text(Medium::tensor(mesh.clone(), &metric)).starts_with("the metric of face 2"));
    metric[2][1][1] = f64::NAN;
    assert!(text(Medium::tensor(mesh.clone(), &metric)).starts_with("the metric of face 2"));
    let directed = Directed { direction: [1.0, 0.0, 0.0], along: 0.0, across: 1.0 };
    assert_eq!(
        text(Medium::directed(mesh.clone(), &vec![directed; faces])),
        "the cost along is 0 at face 0; it must be positive, from 1e-50 to 1e50"
    );
    let endless = Directed { direction: [1.0, f64::INFINITY, 0.0], along: 1.0, across: 1.0 };
    assert_eq!(
        text(Medium::directed(mesh.clone(), &vec![endless; faces])),
        "the direction of face 0 is [1.0, inf, 0.0]; it must be finite"
    );
    let other = curvature(&icosphere(1));
    let options = CurvatureMediumOptions::default();
    assert_eq!(
        text(Medium::curvature(mesh.clone(), &other, options)),
        format!("42 values were given for {} vertices", mesh.points().len())
    );
    let options = CurvatureMediumOptions { floor: 1.5, ..options };
    assert_eq!(
        text(Medium::curvature(mesh.clone(), &curvature(&mesh), options)),
        "floor is 1.5; it must be above 0 (1e-100), at most 1"
    );
}

#[test]
fn ridges_valleys_and_what_is_flat() {
    let torus = torus(2.0, 0.5, 96, 48);
    let curvature = curvature(&torus);
    let of = |bend| {
        let options =
            CurvatureMediumOptions { bend, floor: 0.04, power: 2.0, ..Default::default() };
        Medium::curvature(torus.clone(), &curvature, options).unwrap().speed_sq().into_owned()
    };
    // The tube is convex by 2 everywhere, and concave by up to 1 / 1.5 on the inner side.
    let [both, convex, concave] = [Bend::Both, Bend::Convex, Bend::Concave].map(of);
    assert!(both.iter().chain(&convex).all(|&speed_sq| speed_sq > 0.9 && speed_sq <= 1.0));
    for (vertex, &found) in concave.iter().enumerate() {
        let cos = (TAU * (vertex / 96) as f64 / 48.0).cos();
        let bent = (-cos / (2.0 + 0.5 * cos)).max(0.0) * 1.5;
        let expected = 0.04 + 0.96 * bent * bent;
        assert!((found - expected).abs() < 0.03, "{found} instead of {expected}");
    }
    let flat = slanted_sheet();
    let medium =
        Medium::curvature(flat.clone(), &self::curvature(&flat), Default::default()).unwrap();
    assert!(medium.speed_sq().iter().all(|&speed_sq| speed_sq == 0.01));
}

#[test]
fn a_crease_is_fast_along_and_slow_across() {
    // A cylinder is bent alike everywhere: fast along its axis, slow around.
    let step = TAU / 60.0;
    let cylinder = sheet(20, 30, |column, row| {
        let (sin, cos) = (step * column as f64).sin_cos();
        [cos, sin, step * row as f64]
    });
    let options =
        CurvatureMediumOptions { floor: 1.0 / 25.0, quantile: 0.01, ..Default::default() };
    let medium = Medium::crease(cylinder.clone(), &curvature(&cylinder), options).unwrap();
    for ((edge, vector), length) in
        cylinder.adjacency().edges().iter().zip(edge_vectors(&cylinder)).zip(medium.lengths())
    {
        let across = vector[0].hypot(vector[1]);
        let expected = vector[2].hypot(5.0 * across);
        assert!(relative(*length, expected) < 0.02, "{edge:?} {length} instead of {expected}");
    }
}

proptest! {
    /// However the metric changes from face to face: every face has an area by its lengths.
    #[test]
    fn any_metrics_close_triangles(turns in prop::collection::vec((0.0..3.2, 0.001..1.0), 216)) {
        let mesh = slanted_sheet();
        let directed: Vec<Directed> = turns.iter().map(|&(angle, along): &(f64, f64)| {
            let (sin, cos) = angle.sin_cos();
            Directed { direction: [cos, 0.6 * sin, 0.8 * sin], along, across: 1.0 }
        }).collect();
        let medium = Medium::directed(mesh.clone(), &directed).unwrap();
        prop_assert!(medium.mollified() < 1e-5);
        for face in 0..mesh.faces().len() {
            prop_assert!(medium.area(face) > 0.0);
        }
        let plain = mesh.edge_lengths();
        prop_assert!(medium.lengths().iter().zip(&plain).all(|(length, plain)| *length <= plain + 1e-5));
    }
}
