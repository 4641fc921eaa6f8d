//! Curvature against surfaces whose curvatures are known.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::mesh::shapes::{icosphere, sheet, torus};
use heatpath_core::mesh::{Curvature, CurvatureMethod, CurvatureOptions, Principal, TriMesh};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::ControlFlow;

const METHODS: [CurvatureMethod; 2] =
    [CurvatureMethod::NormalCycles, CurvatureMethod::LeastSquares];

fn curvature(mesh: &TriMesh, method: CurvatureMethod, radius: Option<f64>) -> Vec<Principal> {
    let options = CurvatureOptions { method, radius };
    Curvature::new(mesh, options, &Exec::single_threaded()).unwrap().vertices().to_vec()
}

fn mean_edge(mesh: &TriMesh) -> f64 {
    let lengths = mesh.edge_lengths();
    lengths.iter().sum::<f64>() / lengths.len() as f64
}

fn with_points(mesh: &TriMesh, point: impl FnMut(&[f64; 3]) -> [f64; 3]) -> TriMesh {
    TriMesh::new(mesh.points().iter().map(point).collect(), mesh.faces().to_vec()).unwrap()
}

/// The mesh with noise on each coordinate whose standard deviation is this part of a mean edge;
/// always the same.
fn noisy(mesh: &TriMesh, part: f64) -> TriMesh {
    let (mut state, size) = (1_u64, 3_f64.sqrt() * part * mean_edge(mesh));
    let mut random = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * ((state >> 11) as f64 / (1_u64 << 53) as f64) - 1.0
    };
    with_points(mesh, |point| point.map(|x| x + size * random()))
}

fn flipped(mesh: &TriMesh) -> TriMesh {
    let faces = mesh.faces().iter().map(|&[a, b, c]| [a, c, b]).collect();
    TriMesh::new(mesh.points().to_vec(), faces).unwrap()
}

/// The larger curvature is 1 / tube radius everywhere, the smaller one known at each angle.
fn torus_curvatures(vertex: usize) -> [f64; 2] {
    let cos = (TAU * (vertex / 128) as f64 / 64.0).cos();
    [cos / (2.0 + cos), 1.0]
}

fn cosine(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum::<f64>().abs()
}

/// The mean error of the stronger curvature in percent, where it is 1.
fn error(found: &[Principal]) -> f64 {
    let errors = found.iter().map(|found| (found.strongest() - 1.0).abs());
    100.0 * errors.sum::<f64>() / found.len() as f64
}

#[test]
fn the_table_of_errors() {
    let meshes = [icosphere(4), torus(2.0, 1.0, 128, 64)];
    // Bounds in percent: clean and noisy sphere, clean and noisy torus.
    let rows = [
        (CurvatureMethod::NormalCycles, Some(2.0), [1.0, 17.0, 0.7, 19.0]),
        (CurvatureMethod::NormalCycles, Some(4.0), [0.4, 3.2, 0.7, 2.6]),
        (CurvatureMethod::NormalCycles, Some(6.0), [0.2, 1.0, 1.8, 3.0]),
        (CurvatureMethod::LeastSquares, None, [0.01, 35.0, 0.1, 60.0]),
        (CurvatureMethod::LeastSquares, Some(4.0), [0.01, 2.5, 0.8, 2.1]),
    ];
    println!(
        "method radius: sphere, noisy, torus, noisy (mean error of the stronger curvature, %)"
    );
    for (method, radius, bounds) in rows {
        let of = |mesh: &TriMesh, noise: bool| {
            let radius = radius.map(|radius| radius * mean_edge(mesh));
            let mesh = if noise { &noisy(mesh, 0.05) } else { mesh };
            error(&curvature(mesh, method, radius))
        };
        let errors = [(0, false), (0, true), (1, false), (1, true)].map(|(i, n)| of(&meshes[i], n));
        println!("{method:?} {radius:?}: {errors:.3?}");
        assert!(errors.iter().zip(bounds).all(|(error, bound)| *error < bound), "{errors:?}");
    }
}

#[test]
fn both_curvatures_of_a_torus_and_their_directions() {
    let torus = torus(2.0, 1.0, 128, 64);
    for method in METHODS {
        for (vertex, found) in curvature(&torus, method, None).iter().enumerate() {
            let exact = torus_curvatures(vertex);
            assert!((found.values[0] - exact[0]).abs() < 0.05, "{method:?} {found:?} {exact:?}");
            assert!((found.gaussian() - exact[0] * exact[1]).abs() < 0.06);
            assert!((found.mean() - 0.5 * (exact[0] + exact[1])).abs() < 0.03);
            let [x, y, _] = torus.points()[vertex];
            let around = [-y, x, 0.0].map(|c| c / x.hypot(y));
            assert!(cosine(found.directions[0], around) > 0.999, "{method:?} at {vertex}");
            assert!(cosine(found.directions[1], around) < 0.05);
            // On the inner side both curvatures are equally strong.
            assert!(exact[0] < -0.9 || cosine(found.crease(), around) > 0.999);
        }
    }
}

#[test]
fn a_cylinder_with_borders_inside_and_out() {
    let step = TAU / 90.0;
    let outward = sheet(30, 20, |column, row| {
        let (sin, cos) = (step * column as f64).sin_cos();
        [0.5 * cos, 0.5 * sin, 0.5 * step * row as f64]
    });
    for (mesh, sign) in [(&outward, 1.0), (&flipped(&outward), -1.0)] {
        for method in METHODS {
            for (vertex, found) in curvature(mesh, method, None).iter().enumerate() {
                let [column, row] = [vertex % 31, vertex / 31];
                let inside = (5..=25).contains(&column) && (5..=15).contains(&row);
                // Normals at a border are those of the faces on one side.
                let bound = if inside { 0.02 } else { 0.51 };
                assert!(
                    (found.strongest() - sign * 2.0).abs() < 2.0 * bound,
                    "{method:?} {found:?}"
                );
                assert!(!inside || cosine(found.crease(), [0.0, 0.0, 1.0]) > 0.9999);
            }
        }
    }
}

#[test]
fn a_sharp_edge_has_the_curvature_that_its_angle_says() {
    for angle in [FRAC_PI_2, -0.4] {
        // Two half planes that meet along the second column in the middle.
        let (sin, cos) = f64::sin_cos(angle);
        let fold = sheet(40, 40, |column, row| {
            let [x, y] = [column as f64 - 20.0, row as f64];
            if x <= 0.0 { [x, y, 0.0] } else { [x * cos, y, -x * sin] }
        });
        let found = curvature(&fold, CurvatureMethod::NormalCycles, Some(5.0))[20 * 41 + 20];
        let expected = angle * 8.0 / (3.0 * PI * 5.0);
        assert!((found.strongest() - expected).abs() < 1e-3 * expected.abs(), "{found:?}");
        assert!(cosine(found.crease(), [0.0, 1.0, 0.0]) > 1.0 - 1e-9);
    }
}

#[test]
fn the_other_side_of_a_thin_sheet_does_not_count() {
    let bump = |z: f64| {
        sheet(24, 24, move |column, row| {
            let [x, y] = [column, row].map(|i| i as f64 - 12.0);
            [x, y, z - 0.02 * (x * x + y * y)]
        })
    };
    let (above, below) = (bump(0.1), flipped(&bump(0.0)));
    let count = above.points().len() as u32;
    let points = [above.points(), below.points()].concat();
    let lower = below.faces().iter().map(|face| face.map(|vertex| vertex + count));
    let both = TriMesh::new(points, above.faces().iter().copied().chain(lower).collect()).unwrap();
    for method in METHODS {
        let alone = curvature(&above, method, Some(4.0));
        assert_eq!(curvature(&both, method, Some(4.0))[..count as usize], alone);
    }
}

#[test]
fn turning_faces_over_changes_signs_and_units_change_units() {
    let mesh = noisy(&torus(2.0, 1.0, 30, 20), 0.1);
    for method in METHODS {
        let plain = curvature(&mesh, method, None);
        for (found, plain) in curvature(&flipped(&mesh), method, None).iter().zip(&plain) {
            for i in 0..2 {
                let difference = found.values[i] + plain.values[1 - i];
                assert!(difference.abs() < 1e-9, "{found:?} {plain:?}");
            }
        }
        for unit in [1e-60, 1e-6, 1e6, 1e60] {
            let scaled = with_points(&mesh, |point| point.map(|x| x * unit));
            for (found, plain) in curvature(&scaled, method, None).iter().zip(&plain) {
                let difference = found.values[1] * unit - plain.values[1];
                assert!(difference.abs() < 1e-9 * plain.values[1].abs().max(1.0), "{unit}");
            }
        }
    }
}

#[test]
fn threads_change_nothing_and_cancelling_works() {
    let (mesh, options) = (icosphere(4), CurvatureOptions::default());
    let one = Curvature::new(&mesh, options, &Exec::single_threaded()).unwrap();
    assert_eq!(one, Curvature::new(&mesh, options, &Exec::new(3).unwrap()).unwrap());
    let impatient = Exec::single_threaded().with_watch(|part| {
        if part > 0.3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(Curvature::new(&mesh, options, &impatient).unwrap_err().to_string(), "cancelled");
    for (radius, text) in [
        (-1.0, "curvature radius is -1; it must be a positive finite number"),
        (
            1e-9,
            "curvature radius is 0.000000001; it must be at least a millionth of the longest edge",
        ),
    ] {
        let bad = CurvatureOptions { radius: Some(radius), ..options };
        let error = Curvature::new(&mesh, bad, &Exec::single_threaded()).unwrap_err();
        assert_eq!(error.to_string(), text);
    }
    let huge = CurvatureOptions { radius: Some(1e300), ..options };
    let found = Curvature::new(&icosphere(1), huge, &Exec::single_threaded()).unwrap();
    assert!(found.vertices().iter().all(|vertex| vertex.values.iter().all(|x| x.is_finite())));
}

#[test]
fn a_mesh_in_one_point_is_flat() {
    let mesh = TriMesh::new(vec![[1.0; 3]; 4], vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    for method in METHODS {
        assert_eq!(curvature(&mesh, method, None), [Principal::default(); 4]);
    }
}

proptest! {
    /// Any faces at all: edges with many faces, clashing orientations, flat faces, vertices alone.
    #[test]
    fn any_mesh_has_finite_curvature(
        corners in prop::collection::vec((0..9_u32, 0..9_u32, 0..9_u32), 1..30),
        points in prop::collection::vec((0..4_i8, 0..4_i8, 0..3_i8), 9),
    ) {
        let faces: Vec<[u32; 3]> = corners.into_iter().map(|(a, b, c)| [a, b, c])
            .filter(|[a, b, c]| a != b && b != c && c != a).collect();
        prop_assume!(!faces.is_empty());
        let points = points.iter().map(|&(x, y, z)| [x, y, z].map(f64::from)).collect();
        let mesh = TriMesh::new(points, faces).unwrap();
        for method in METHODS {
            for radius in [None, Some(0.3), Some(2.5)] {
                for found in curvature(&mesh, method, radius) {
                    prop_assert!(found.values.iter().all(|value| value.is_finite()), "{:?}", found);
                    prop_assert!(found.values[0] <= found.values[1]);
                }
            }
        }
    }
}
