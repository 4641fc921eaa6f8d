//! The exact distance on meshes against closed forms.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(clippy::print_stdout, reason = "the figures of docs/accuracy.md")]

use heatpath_core::Exec;
use heatpath_core::mesh::distance::{DistanceMap, Eikonal, EikonalOptions, NO_LABEL};
use heatpath_core::mesh::path::{Descent, Ending};
use heatpath_core::mesh::{
    Geodesics, GeodesicsOptions, Locator, Medium, Method, Source, Sources, SurfacePoint, TriMesh,
    shapes,
};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn between(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// A number from 0 to 1 that looks like any.
fn any(seed: usize) -> f64 {
    (((seed as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20) % 100_003) as f64 / 100_003.0
}

/// The unit square, its inner vertices moved by up to `jitter` cells.
fn square(cells: usize, jitter: f64) -> TriMesh {
    shapes::sheet(cells, cells, |i, j| {
        let moved = |k: usize, seed: usize| {
            let inside = i > 0 && j > 0 && i < cells && j < cells;
            let by = 2.0 * any(2 * (i * 97 + j * 1013) + seed) - 1.0;
            (k as f64 + if inside { jitter * by } else { 0.0 }) / cells as f64
        };
        [moved(i, 0), moved(j, 1), 0.0]
    })
}

fn march(medium: &Medium, sources: &[SurfacePoint]) -> DistanceMap {
    let sources = Sources::new(medium.mesh(), sources).unwrap();
    let exec = Exec::single_threaded();
    Eikonal::new(medium.clone()).distance(&sources, &EikonalOptions::default(), &exec).unwrap()
}

/// The mean and the largest relative error of distances, printed.
fn compare(
    name: &str,
    medium: &Medium,
    distances: &DistanceMap,
    exact: impl Fn([f64; 3]) -> f64,
) -> [f64; 2] {
    let vertices = medium.mesh().points().iter().zip(distances.values());
    let reached = vertices.filter(|(_, found)| found.is_finite());
    let errors: Vec<f64> = reached
        .filter(|(point, _)| exact(**point) > 0.0)
        .map(|(&point, found)| (found - exact(point)).abs() / exact(point))
        .collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let max = errors.into_iter().fold(0.0, f64::max);
    println!("| {name} | {mean:.1e} | {max:.1e} |");
    [mean, max]
}

/// The mean relative error of the distances from a source; the largest is at most `most`.
fn error(
    name: &str,
    medium: &Medium,
    source: SurfacePoint,
    most: f64,
    exact: impl Fn([f64; 3], [f64; 3]) -> f64,
) -> f64 {
    let place = medium.mesh().position(&source);
    let distances = march(medium, &[source]);
    let [mean, max] = compare(name, medium, &distances, |point| exact(point, place));
    assert!(max < most, "{name}: {max}");
    mean
}

fn vertex(medium: &Medium, vertex: u32) -> SurfacePoint {
    medium.mesh().at_vertex("source", 0, vertex).unwrap()
}

fn great_circle(a: [f64; 3], b: [f64; 3]) -> f64 {
    2.0 * (between(a, b) / 2.0).min(1.0).asin()
}

#[test]
fn flat_surfaces_are_exact() {
    for (name, jitter) in [("square of 65^2", 0.0), ("square of 65^2, jittered", 0.3)] {
        let plane = Medium::uniform(square(64, jitter)).unwrap();
        let inside = Locator::new(plane.mesh()).nearest([0.313, 0.571, 0.0]).0;
        let edge = Locator::new(plane.mesh()).nearest([0.25, 1.0, 0.0]).0;
        for source in [vertex(&plane, 32 * 65 + 32), vertex(&plane, 0), inside, edge] {
            assert!(error(name, &plane, source, 1e-9, between) < 1e-10);
        }
    }
    // === Over two sides of a box, and around the corners of a hole
    let cube = shapes::sheet(20, 20, |i, j| {
        let (x, y) = (i as f64 / 10.0, j as f64 / 20.0);
        [x.min(1.0), y, (x - 1.0).max(0.0)]
    });
    let cube = Medium::uniform(cube).unwrap();
    let mean = error("two sides of a box", &cube, vertex(&cube, 7), 1e-9, |a, b| {
        between([a[0] + a[2], a[1], 0.0], [b[0] + b[2], b[1], 0.0])
    });
    assert!(mean < 1e-10);
}

#[test]
fn fronts_begin_anew_at_the_corners_of_a_hole() {
    let sheet = square(60, 0.0);
    let middle = |f: &[u32; 3], axis: usize| {
        f.iter().map(|&v| sheet.points()[v as usize][axis]).sum::<f64>() / 3.0
    };
    // What is left is an L.
    let faces = sheet.faces().iter().copied().filter(|f| middle(f, 0) < 0.5 || middle(f, 1) < 0.5);
    let bent =
        Medium::uniform(TriMesh::new(sheet.points().to_vec(), faces.collect()).unwrap()).unwrap();
    let corner = [0.5, 0.5, 0.0];
    let mean = error("an L", &bent, vertex(&bent, 55 * 61 + 10), 5e-3, |a, b| {
        // Hidden behind the line from the source over the corner.
        let [u, v] = [[b[0] - 0.5, b[1] - 0.5], [a[0] - 0.5, a[1] - 0.5]];
        let is_hidden = u[0] * v[1] - u[1] * v[0] < 0.0 && a[0] > 0.5;
        if is_hidden { between(a, corner) + between(corner, b) } else { between(a, b) }
    });
    // Beside the edge of the shadow fronts around both centres meet.
    assert!(mean < 5e-4);
}

#[test]
fn curved_surfaces() {
    for (level, most) in [(3, 2e-3), (4, 5e-4), (5, 2e-4), (6, 1.5e-4)] {
        let sphere = Medium::uniform(shapes::icosphere(level)).unwrap();
        for source in [0, 137] {
            let name = format!("icosphere {level}, vertex {source}");
            assert!(error(&name, &sphere, vertex(&sphere, source), 0.03, great_circle) < most);
        }
    }
    let cylinder = shapes::sheet(64, 32, |i, j| {
        let (sin, cos) = (TAU * i as f64 / 64.0).sin_cos();
        [cos, sin, 3.0 * j as f64 / 32.0]
    });
    // Closed: the last column is the first.
    let faces = cylinder.faces().iter().map(|f| f.map(|v| if v % 65 == 64 { v - 64 } else { v }));
    let cylinder = TriMesh::new(cylinder.points().to_vec(), faces.collect()).unwrap();
    let cylinder = Medium::uniform(cylinder).unwrap();
    let unrolled = |a: [f64; 3], b: [f64; 3]| {
        let turn = (a[1].atan2(a[0]) - b[1].atan2(b[0])).rem_euclid(TAU);
        turn.min(TAU - turn).hypot(a[2] - b[2])
    };
    // Its 64 sides are shorter by 4e-4 than the arcs.
    assert!(error("cylinder", &cylinder, vertex(&cylinder, 16 * 65), 1e-3, unrolled) < 5e-4);
    // === The whole border of a square
    let plane = Medium::uniform(square(64, 0.3)).unwrap();
    let depth = |p: [f64; 3]| p[0].min(p[1]).min(1.0 - p[0]).min(1.0 - p[1]);
    let on_border = (0..65 * 65).filter(|&v| depth(plane.mesh().points()[v as usize]) == 0.0);
    let border: Vec<SurfacePoint> = on_border.map(|v| vertex(&plane, v)).collect();
    let [mean, max] = compare("square, its border", &plane, &march(&plane, &border), depth);
    // Next to a corner fronts of two sides meet.
    assert!(mean < 2e-3 && max < 0.5);
    // === The outer equator of a torus
    let torus = Medium::uniform(shapes::torus(2.0, 1.0, 128, 64)).unwrap();
    let ring: Vec<SurfacePoint> = (0..128).map(|i| vertex(&torus, i)).collect();
    let exact = |p: [f64; 3]| p[2].atan2(p[0].hypot(p[1]) - 2.0).abs();
    let [mean, max] = compare("torus, equator", &torus, &march(&torus, &ring), exact);
    assert!(mean < 2e-3 && max < 3e-3);
}

#[test]
fn varied_media() {
    let mut last = f64::INFINITY;
    for cells in [32, 64, 128] {
        let mesh = square(cells, 0.3);
        let speeds: Vec<f64> = mesh.points().iter().map(|p| (0.5 + p[1]).powi(2)).collect();
        let medium = Medium::given(mesh, &speeds).unwrap();
        let middle = vertex(&medium, (cells / 2 * (cells + 1) + cells / 2) as u32);
        let mean =
            error(&format!("speed 1/2 + y, {cells} cells"), &medium, middle, 0.02, |a, b| {
                (1.0 + between(a, b).powi(2) / (2.0 * (0.5 + a[1]) * (0.5 + b[1]))).acosh()
            });
        assert!(mean < 0.6 * last && mean < 0.2 / cells as f64, "{mean} after {last}");
        last = mean;
    }
}

#[test]
fn several_sources_with_offsets_and_labels() {
    let medium = Medium::uniform(square(64, 0.3)).unwrap();
    let locator = Locator::new(medium.mesh());
    let source = |number: usize| Source {
        point: locator.nearest([any(5 * number), any(5 * number + 2), 0.0]).0,
        offset: 0.02 * number as f64,
        label: 10 + number as u32,
    };
    let list: Vec<Source> = (0..8).map(source).collect();
    let from = |p: [f64; 3], s: &Source| s.offset + between(p, medium.mesh().position(&s.point));
    let exact = |p: [f64; 3]| list.iter().map(|s| from(p, s)).fold(f64::INFINITY, f64::min);
    let sources = Sources::with_offsets(medium.mesh(), list.clone()).unwrap();
    let exec = Exec::single_threaded();
    let eikonal = Eikonal::new(medium.clone());
    let distances = eikonal.distance(&sources, &EikonalOptions::default(), &exec).unwrap();
    let [mean, _] = compare("square, 8 sources", &medium, &distances, exact);
    assert!(mean < 1e-3);
    for (vertex, &label) in distances.labels().iter().enumerate() {
        let point = medium.mesh().points()[vertex];
        let chosen = from(point, &list[label as usize - 10]);
        assert!(chosen < exact(point) + 0.01, "vertex {vertex} has the label {label}");
    }
    // === No further than told
    let options = EikonalOptions { farthest: 0.1 };
    let near = eikonal.distance(&sources, &options, &exec).unwrap();
    for (vertex, &value) in near.values().iter().enumerate() {
        let all = distances.values()[vertex];
        assert_eq!(value, if all <= 0.1 { all } else { f64::INFINITY });
        assert_eq!(value.is_infinite(), near.labels()[vertex] == NO_LABEL);
    }
    let wrong = eikonal.distance(&sources, &EikonalOptions { farthest: 0.0 }, &exec).unwrap_err();
    assert_eq!(wrong.to_string(), "farthest is 0; it must be a positive distance");
    let stopped = Exec::single_threaded().with_watch(|_| std::ops::ControlFlow::Break(()));
    let sphere = Medium::uniform(shapes::icosphere(6)).unwrap();
    let pole = Sources::at_vertices(sphere.mesh(), &[0]).unwrap();
    assert!(
        Eikonal::new(sphere.clone()).distance(&pole, &EikonalOptions::default(), &stopped).is_err()
    );
}

#[test]
fn a_path_through_two_points() {
    let medium = Medium::uniform(square(32, 0.3)).unwrap();
    let locator = Locator::new(medium.mesh());
    let places = [[0.1, 0.1, 0.0], [0.83, 0.2, 0.0], [0.7, 0.9, 0.0], [0.11, 0.56, 0.0]];
    let points = places.map(|place| locator.nearest(place).0);
    let (options, exec) = (GeodesicsOptions::default(), Exec::single_threaded());
    let options = GeodesicsOptions { method: Method::Eikonal, ..options };
    let geodesics = Geodesics::new(medium, options, &exec).unwrap();
    let path = geodesics.through(&points, &exec).unwrap();
    let exact: f64 = places.windows(2).map(|pair| between(pair[0], pair[1])).sum();
    assert_eq!(path.ending, Ending::Source(0));
    assert!((path.length / exact - 1.0).abs() < 0.02 && (path.distance / exact - 1.0).abs() < 0.01);
    for point in points {
        assert!(path.points.contains(&point));
    }
    let text = |points| geodesics.through(points, &exec).unwrap_err().to_string();
    assert_eq!(text(&points[..1]), "no way point was given; at least one is needed");
    assert_eq!(text(&[]), "no end point was given; at least one is needed");
}

/// The distance along edges, by relaxing all of them until nothing changes.
fn along_edges(medium: &Medium, source: u32) -> Vec<f64> {
    let adjacency = medium.mesh().adjacency();
    let mut values = vec![f64::INFINITY; medium.mesh().points().len()];
    values[source as usize] = 0.0;
    for _ in 0..values.len() {
        for (edge, ends) in adjacency.edges().iter().enumerate() {
            let faces = adjacency.edge_faces().of(edge).iter();
            let slow = faces.map(|&f| medium.slowness()[f as usize]).fold(f64::INFINITY, f64::min);
            let cost = slow * medium.lengths()[edge];
            let [a, b] = ends.map(|end| end as usize);
            values[a] = values[a].min(values[b] + cost);
            values[b] = values[b].min(values[a] + cost);
        }
    }
    values
}

proptest! {
    /// Any triangles between a few points: borders, edges of many faces, flat and doubled faces.
    #[test]
    fn any_mesh_has_distances(
        points in prop::collection::vec(prop::array::uniform3(-2..3_i32), 12),
        faces in prop::collection::vec((0..12_u32, 1..6_u32, 1..6_u32), 1..40),
        speeds in prop::collection::vec(0.1..10.0_f64, 12),
    ) {
        let points = points.iter().map(|p| p.map(f64::from)).collect();
        let face = |&(a, b, c): &(u32, u32, u32)| [a, (a + b) % 12, (a + b + c) % 12];
        let mesh = TriMesh::new(points, faces.iter().map(face).collect());
        prop_assume!(mesh.is_ok());
        let medium = Medium::given(mesh.unwrap(), &speeds);
        prop_assume!(medium.is_ok());
        let medium = medium.unwrap();
        let source = medium.mesh().faces()[0][0];
        let distances = march(&medium, &[vertex(&medium, source)]);
        for (vertex, edges) in along_edges(&medium, source).into_iter().enumerate() {
            let found = distances.values()[vertex];
            prop_assert_eq!(found.is_infinite(), edges.is_infinite());
            prop_assert!(found <= edges * (1.0 + 1e-9) || edges.is_infinite(), "{found} at {vertex}, {edges} along edges");
            prop_assert!(found >= 0.0, "{found} at {vertex}, {edges} along edges");
        }
        // From everywhere a path leads to a source inside a face.
        let inside = SurfacePoint { face: 0, weights: [0.2, 0.3, 0.5] };
        let distances = march(&medium, &[inside]);
        let sources = Sources::new(medium.mesh(), &[inside]).unwrap();
        let descent = Descent::new(&medium, distances.values(), &sources).unwrap();
        for face in 0..medium.mesh().faces().len() as u32 {
            let path = descent.path(SurfacePoint { face, weights: [0.6, 0.3, 0.1] }).unwrap();
            let corner = medium.mesh().faces()[face as usize][0] as usize;
            let is_reached = distances.values()[corner].is_finite();
            prop_assert_eq!(path.ending, if is_reached { Ending::Source(0) } else { Ending::Unreachable });
        }
    }
}
