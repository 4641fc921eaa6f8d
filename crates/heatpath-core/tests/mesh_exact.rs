//! Exact distances and paths on meshes against closed forms, a graph that converges to them, and laws
//! of distance.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::mesh::distance::{Exact, ExactError, ExactOptions, ExactPaths, NO_LABEL};
use heatpath_core::mesh::path::Ending;
use heatpath_core::mesh::{Medium, Source, Sources, SurfacePoint, TriMesh, shapes};
use proptest::prelude::*;
use std::collections::BinaryHeap;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

// ===================================================================== Meshes

/// Numbers from 0 to 1 in an order that never changes (Knuth's linear congruences).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Any point of the mesh: one in three on an edge, one in nine or so at a vertex.
    fn point(&mut self, mesh: &TriMesh) -> SurfacePoint {
        let face = (self.next() * mesh.faces().len() as f64) as u32;
        let mut weights = [0, 1, 2].map(|_| self.next());
        weights.iter_mut().for_each(|weight| *weight = (*weight - 0.15).max(0.0));
        let sum: f64 = weights.iter().sum();
        let weights = if sum > 0.0 { weights.map(|weight| weight / sum) } else { [0.0, 1.0, 0.0] };
        SurfacePoint { face, weights }
    }
}

/// The unit square of n x n cells with moved inner vertices, without the faces whose middle is in
/// the box; vertices near the box stay on the lattice.
fn square(n: usize, hole: Option<[[f64; 2]; 2]>) -> TriMesh {
    let h = 1.0 / n as f64;
    let mut random = Random(7);
    let moves: Vec<[f64; 2]> = (0..(n + 1).pow(2))
        .map(|_| [0.6 * h * (random.next() - 0.5), 0.6 * h * (random.next() - 0.5)])
        .collect();
    let near = |x: f64, y: f64, by: f64| {
        hole.is_some_and(|[low, high]| {
            x > low[0] - by && x < high[0] + by && y > low[1] - by && y < high[1] + by
        })
    };
    let sheet = shapes::sheet(n, n, |i, j| {
        let (x, y) = (i as f64 * h, j as f64 * h);
        let fixed = i == 0 || j == 0 || i == n || j == n || near(x, y, 0.1 * h);
        let [dx, dy] = if fixed { [0.0; 2] } else { moves[j * (n + 1) + i] };
        [x + dx, y + dy, 0.0]
    });
    let outside = |face: &usize| {
        let c = sheet.corners(*face);
        !near((c[0][0] + c[1][0] + c[2][0]) / 3.0, (c[0][1] + c[1][1] + c[2][1]) / 3.0, 0.0)
    };
    let faces = (0..sheet.faces().len()).filter(outside).map(|face| sheet.faces()[face]).collect();
    TriMesh::new(sheet.points().to_vec(), faces).unwrap()
}

/// A sheet of n x n cells with random places; `flat` shrinks what they differ by.
fn rough(n: usize, seed: u64, height: f64) -> TriMesh {
    let mut random = Random(seed);
    let moves: Vec<[f64; 3]> =
        (0..(n + 1).pow(2)).map(|_| [0, 1, 2].map(|_| random.next())).collect();
    shapes::sheet(n, n, |i, j| {
        let [x, y, z] = moves[j * (n + 1) + i];
        [i as f64 + 0.7 * x, j as f64 + 0.7 * y, height * z]
    })
}

fn cube() -> TriMesh {
    let points = (0..8).map(|i| [0, 1, 2].map(|axis| f64::from(i >> axis & 1))).collect();
    let squares =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let faces = squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriMesh::new(points, faces).unwrap()
}

fn scaled(mesh: &TriMesh, factor: f64) -> TriMesh {
    let points = mesh.points().iter().map(|point| point.map(|x| x * factor)).collect();
    TriMesh::new(points, mesh.faces().to_vec()).unwrap()
}

// ===================================================================== Helpers

fn euclid(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

fn exact(mesh: &TriMesh) -> Exact {
    Exact::new(&Medium::uniform(mesh.clone()).unwrap()).unwrap()
}

fn from<'a>(exact: &'a Exact, mesh: &TriMesh, points: &[SurfacePoint]) -> ExactPaths<'a> {
    let sources = Sources::new(mesh, points).unwrap();
    exact.paths(&sources, &ExactOptions::default(), &Exec::single_threaded()).unwrap()
}

fn from_vertices(mesh: &TriMesh, vertices: &[u32]) -> Vec<f64> {
    let sources = Sources::at_vertices(mesh, vertices).unwrap();
    let exec = Exec::single_threaded();
    let map = exact(mesh).distance(&sources, &ExactOptions::default(), &exec).unwrap();
    map.values().to_vec()
}

fn sorted(mut numbers: [f64; 3]) -> [f64; 3] {
    numbers.sort_by(f64::total_cmp);
    numbers
}

/// The distance at `end`, and the path from there checked against it.
fn checked(paths: &ExactPaths<'_>, mesh: &TriMesh, end: &SurfacePoint) -> f64 {
    let distance = paths.distance_at(end).unwrap();
    let path = paths.path(end).unwrap();
    assert_eq!(path.distance, distance);
    assert!((path.length - distance).abs() <= 1e-9 * distance, "{} {distance}", path.length);
    assert_eq!(path.positions[0], mesh.position(end));
    for pair in path.points.windows(2) {
        let (a, b) = (faces_of(mesh, &pair[0]), faces_of(mesh, &pair[1]));
        assert!(a.iter().any(|face| b.contains(face)), "{pair:?} share no face");
    }
    distance
}

/// The faces that have a point.
fn faces_of(mesh: &TriMesh, point: &SurfacePoint) -> Vec<u32> {
    let face = point.face as usize;
    if let Some(corner) = point.corner() {
        return mesh.adjacency().vertex_faces().of(mesh.faces()[face][corner] as usize).to_vec();
    }
    match point.weights.iter().position(|&weight| weight == 0.0) {
        Some(i) => {
            let edge = mesh.adjacency().face_edges()[face][i];
            mesh.adjacency().edge_faces().of(edge as usize).to_vec()
        }
        None => vec![point.face],
    }
}

/// Checks distances and paths between random points of the surface against a closed form.
fn check_between(mesh: &TriMesh, count: usize, form: impl Fn([f64; 3], [f64; 3]) -> f64) {
    let (exact, mut random) = (exact(mesh), Random(3));
    for _ in 0..count {
        let source = random.point(mesh);
        let paths = from(&exact, mesh, &[source]);
        for _ in 0..3 * count {
            let end = random.point(mesh);
            let expected = form(mesh.position(&source), mesh.position(&end));
            let found = checked(&paths, mesh, &end);
            assert!((found - expected).abs() < 1e-11 * (1.0 + expected), "{found} {expected}");
        }
        for (vertex, &value) in paths.map().values().iter().enumerate() {
            if value.is_finite() {
                let expected = form(mesh.position(&source), mesh.points()[vertex]);
                assert!((value - expected).abs() < 1e-11 * (1.0 + expected), "{value} {expected}");
            }
        }
    }
}

/// The shortest way around a box: through its corners, in straight lines that do not enter it.
fn around(hole: [[f64; 2]; 2], a: [f64; 3], b: [f64; 3]) -> f64 {
    let [low, high] = hole;
    let corners = [low, [low[0], high[1]], high, [high[0], low[1]]].map(|[x, y]| [x, y, 0.0]);
    let sees = |p: [f64; 3], q: [f64; 3]| {
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (from, step) = (p[axis], q[axis] - p[axis]);
            let (first, last) = (low[axis] + 1e-9, high[axis] - 1e-9);
            if step == 0.0 && (from <= first || from >= last) {
                return true;
            }
            if step != 0.0 {
                let (s, t) = ((first - from) / step, (last - from) / step);
                (enter, leave) = (enter.max(s.min(t)), leave.min(s.max(t)));
            }
        }
        enter >= leave
    };
    let way = |p, q| if sees(p, q) { euclid(p, q) } else { f64::INFINITY };
    let mut at = corners.map(|corner| way(a, corner));
    for _ in 0..4 {
        at = [0, 1, 2, 3]
            .map(|i| (0..4).map(|j| at[j] + way(corners[j], corners[i])).fold(at[i], f64::min));
    }
    (0..4).map(|i| at[i] + way(corners[i], b)).fold(way(a, b), f64::min)
}

/// Dijkstra's distances on a graph of the vertices and `steps` points on each edge, joined by straight
/// lines within faces: never too short, and less too long with each step.
fn on_graph(medium: &Medium, vertex: u32, steps: usize) -> Vec<f64> {
    let (mesh, adjacency) = (medium.mesh(), medium.mesh().adjacency());
    let vertices = mesh.points().len();
    let mut links = vec![Vec::new(); vertices + steps * adjacency.edges().len()];
    for (face, corners) in mesh.faces().iter().enumerate() {
        let [a, b, c] = medium.sides(face);
        // Heron's formula in Kahan's order; from b and x a needle's height would lose half its digits.
        let [s, m, l] = sorted([a, b, c]);
        let area_4 =
            ((l + (m + s)) * (s - (l - m)) * (s + (l - m)) * (l + (m - s))).max(0.0).sqrt();
        let at = [[0.0; 2], [c, 0.0], [(b * b + (c - a) * (c + a)) / (2.0 * c), 0.5 * area_4 / c]];
        let mut nodes: Vec<(usize, [f64; 2], usize)> =
            (0..3).map(|i| (corners[i] as usize, at[i], 3)).collect();
        for i in 0..3 {
            let edge = adjacency.face_edges()[face][i] as usize;
            let first = adjacency.edges()[edge][0];
            let [p, q] = if corners[(i + 1) % 3] == first { [1, 2] } else { [2, 1] };
            let [p, q] = [p, q].map(|k| at[(i + k) % 3]);
            for step in 0..steps {
                let t = (step + 1) as f64 / (steps + 1) as f64;
                let point = [0, 1].map(|axis| p[axis] + t * (q[axis] - p[axis]));
                nodes.push((vertices + edge * steps + step, point, i));
            }
        }
        for &(a, p, side) in &nodes {
            for &(b, q, other) in &nodes {
                if a != b && (side != other || side == 3) {
                    links[a].push((b, (p[0] - q[0]).hypot(p[1] - q[1])));
                }
            }
        }
        for i in 0..3 {
            let edge = adjacency.face_edges()[face][i] as usize;
            let step = medium.lengths()[edge] / (steps + 1) as f64;
            for k in 1..steps {
                let node = vertices + edge * steps + k;
                links[node].push((node - 1, step));
                links[node - 1].push((node, step));
            }
        }
    }
    let mut distances = vec![f64::INFINITY; links.len()];
    distances[vertex as usize] = 0.0;
    // Positive numbers have the order of their bits.
    let mut heap = BinaryHeap::from([(std::cmp::Reverse(0_u64), vertex as usize)]);
    while let Some((std::cmp::Reverse(bits), node)) = heap.pop() {
        if f64::from_bits(bits) > distances[node] {
            continue;
        }
        for &(next, length) in &links[node] {
            let distance = distances[node] + length;
            if distance < distances[next] {
                distances[next] = distance;
                heap.push((std::cmp::Reverse(distance.to_bits()), next));
            }
        }
    }
    distances.truncate(vertices);
    distances
}

// ===================================================================== Closed forms

#[test]
fn straight_lines_in_the_plane() {
    check_between(&square(12, None), 12, euclid);
}

#[test]
fn around_a_corner() {
    let hole = [[0.5, 0.5], [1.0, 1.0]];
    check_between(&square(12, Some(hole)), 10, |a, b| around(hole, a, b));
}

#[test]
fn around_a_hole() {
    let hole = [[0.25, 0.375], [0.625, 0.75]];
    check_between(&square(16, Some(hole)), 10, |a, b| around(hole, a, b));
}

#[test]
fn along_a_strip() {
    let strip = shapes::sheet(1500, 5, |x, y| [x as f64, y as f64 + 0.3 * (x % 2) as f64, 0.0]);
    let distances = from_vertices(&strip, &[0]);
    for (point, distance) in strip.points().iter().zip(&distances) {
        // The border is a zigzag, which the lines from the first corner touch only near it.
        let straight = euclid(*point, strip.points()[0]);
        assert!(*distance >= straight - 1e-9 && *distance <= straight * 1.05 + 1e-9);
    }
    let strip = shapes::sheet(1500, 5, |x, y| [x as f64, y as f64, 0.0]);
    let distances = from_vertices(&strip, &[3]);
    for (point, distance) in strip.points().iter().zip(&distances) {
        assert!((distance - euclid(*point, strip.points()[3])).abs() < 1e-9);
    }
}

#[test]
fn across_the_cube() {
    let cube = cube();
    let distances = from_vertices(&cube, &[0]);
    for (vertex, expected) in [(1, 1.0), (2, 1.0), (3, 2.0_f64.sqrt()), (7, 5.0_f64.sqrt())] {
        assert!((distances[vertex] - expected).abs() < 1e-14, "{vertex}: {}", distances[vertex]);
    }
    // From the middle of the bottom to the middle of the top.
    let middle = |face| SurfacePoint { face, weights: [0.5, 0.0, 0.5] };
    let (exact, top) = (exact(&cube), middle(2));
    let paths = from(&exact, &cube, &[middle(0)]);
    assert!((checked(&paths, &cube, &top) - 2.0).abs() < 1e-14);
}

/// A cone of `spokes` wedges and three rings around its tip: pointed, or a saddle if `wave` is large.
fn cone(spokes: usize, height: f64, wave: f64) -> TriMesh {
    let mut points = vec![[0.0; 3]];
    for ring in 1..=3 {
        for spoke in 0..spokes {
            let (y, x) = (TAU * spoke as f64 / spokes as f64).sin_cos();
            let z = height + if spoke % 2 == 0 { wave } else { -wave };
            points.push([x, y, z].map(|c| c * f64::from(ring) / x.hypot(y).hypot(z)));
        }
    }
    let mut faces = Vec::new();
    for spoke in 0..spokes {
        let [a, b] = [spoke, (spoke + 1) % spokes].map(|spoke| 1 + spoke as u32);
        let n = spokes as u32;
        faces.push([0, a, b]);
        for ring in 0..2 {
            let [a, b] = [a + ring * n, b + ring * n];
            faces.extend([[a, a + n, b + n], [a, b + n, b]]);
        }
    }
    TriMesh::new(points, faces).unwrap()
}

#[test]
fn on_unrolled_cones() {
    for (height, wave) in [(1.0, 0.0), (0.2, 0.0), (0.0, 0.4), (0.0, 1.0)] {
        let (spokes, mesh) = (12, cone(12, height, wave));
        let [a, b] = [mesh.points()[1], mesh.points()[2]];
        let wedge = 2.0 * (0.5 * euclid(a, b)).asin();
        let source = 1 + spokes as u32;
        let distances = from_vertices(&mesh, &[source]);
        for (vertex, found) in distances.iter().enumerate().skip(1) {
            let (ring, spoke) = ((vertex - 1) / spokes + 1, (vertex - 1) % spokes);
            let angle = wedge * spoke.min(spokes - spoke) as f64;
            let (r, s) = (ring as f64, 2.0);
            let chord = (r * r + s * s - 2.0 * r * s * angle.cos()).max(0.0).sqrt();
            let expected = if angle < PI { chord } else { r + s };
            let error = (found - expected).abs();
            assert!(error < 1e-12, "{height} {wave}: {found} {expected}");
        }
    }
}

#[test]
fn on_an_unrolled_cylinder() {
    let (around, rows) = (24_usize, 10);
    let number = |i: usize, j: usize| (j * around + i % around) as u32;
    let mut points = Vec::new();
    let mut faces = Vec::new();
    for j in 0..=rows {
        for i in 0..around {
            let (y, x) = (TAU * i as f64 / around as f64).sin_cos();
            points.push([x, y, 0.3 * j as f64]);
            if j < rows {
                let [a, b, c, d] =
                    [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| number(i, j));
                faces.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
    let mesh = TriMesh::new(points, faces).unwrap();
    let chord = 2.0 * (PI / around as f64).sin();
    let distances = from_vertices(&mesh, &[number(5, 4)]);
    for j in 0..=rows {
        for i in 0..around {
            let steps = i.abs_diff(5).min(around - i.abs_diff(5));
            let expected = (chord * steps as f64).hypot(0.3 * (j as f64 - 4.0));
            assert!((distances[number(i, j) as usize] - expected).abs() < 1e-12);
        }
    }
}

#[test]
fn on_spheres_the_error_is_that_of_the_faces() {
    let mut errors = Vec::new();
    for level in 3..=5 {
        let sphere = shapes::icosphere(level);
        let distances = from_vertices(&sphere, &[0]);
        let [a, b, c] = sphere.points()[0];
        let error = |(p, d): (&[f64; 3], &f64)| {
            let true_one = (a * p[0] + b * p[1] + c * p[2]).clamp(-1.0, 1.0).acos();
            if true_one > 0.0 { (d - true_one).abs() / true_one } else { 0.0 }
        };
        let sum: f64 = sphere.points().iter().zip(&distances).map(error).sum();
        errors.push(100.0 * sum / distances.len() as f64);
    }
    println!("mean error on spheres of level 3, 4, 5 in per cent: {errors:.4?}");
    for (found, expected) in errors.iter().zip([0.22, 0.057, 0.015]) {
        assert!((found / expected - 1.0).abs() < 0.1, "{errors:?}");
    }
}

#[test]
fn from_the_equator_of_a_torus() {
    let error = |around: usize, along: usize| {
        let torus = shapes::torus(2.0, 1.0, around, along);
        let ring: Vec<u32> = (0..around as u32).collect();
        let distances = from_vertices(&torus, &ring);
        let sum: f64 = (around..around * along)
            .map(|vertex| {
                let steps = (vertex / around).min(along - vertex / around);
                let expected = TAU * steps as f64 / along as f64;
                (distances[vertex] - expected).abs() / expected
            })
            .sum();
        100.0 * sum / distances.len() as f64
    };
    let errors = [error(64, 32), error(128, 64)];
    println!("mean error on the torus in per cent: {errors:.4?}");
    assert!(errors[1] < 0.045 && errors[0] / errors[1] > 3.5, "{errors:?}");
}

// ===================================================================== Meshes of all kinds

#[test]
fn what_is_not_connected_is_not_reached() {
    let (a, b) = (shapes::icosphere(1), square(3, None));
    let shift = a.points().len() as u32;
    let points = [a.points(), b.points(), &[[9.0; 3]]].concat();
    let faces =
        [a.faces().to_vec(), b.faces().iter().map(|f| f.map(|v| v + shift)).collect()].concat();
    let mesh = TriMesh::new(points, faces).unwrap();
    let exact = exact(&mesh);
    let paths = from(&exact, &mesh, &[mesh.at_vertex("source", 0, 0).unwrap()]);
    for (vertex, (value, label)) in
        paths.map().values().iter().zip(paths.map().labels()).enumerate()
    {
        let near = vertex < shift as usize;
        assert_eq!((value.is_finite(), *label), (near, if near { 0 } else { NO_LABEL }));
    }
    let end = mesh.at_vertex("end", 0, shift).unwrap();
    let path = paths.path(&end).unwrap();
    assert_eq!((path.ending, path.points.len()), (Ending::Unreachable, 1));
    assert_eq!(paths.label_at(&end), Ok(NO_LABEL));
}

#[test]
fn through_the_spine_of_a_book() {
    // Three sheets on the edge x = 0, seen from above at different heights; some faces are turned.
    let sheet = square(6, None);
    let count = sheet.points().len() as u32;
    let spine = |vertex: u32| sheet.points()[vertex as usize][0] == 0.0;
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for (page, slope) in [[0.6, 0.8], [-0.6, 0.8], [0.0, 1.0]].into_iter().enumerate() {
        points.extend(sheet.points().iter().map(|p| [slope[0] * p[0], p[1], slope[1] * p[0]]));
        let number = |v: u32| if spine(v) { v } else { v + page as u32 * count };
        faces.extend(sheet.faces().iter().enumerate().map(|(i, f)| {
            let [a, b, c] = f.map(number);
            if i % 3 == 0 { [b, a, c] } else { [a, b, c] }
        }));
    }
    let mesh = TriMesh::new(points, faces).unwrap();
    let page = |point: &SurfacePoint| point.face as usize / sheet.faces().len();
    let (exact, mut random) = (exact(&mesh), Random(11));
    for _ in 0..12 {
        let source = random.point(&mesh);
        let paths = from(&exact, &mesh, &[source]);
        for _ in 0..40 {
            let end = random.point(&mesh);
            let ([_, y, _], [_, t, _]) = (mesh.position(&source), mesh.position(&end));
            let depth = |p: [f64; 3]| p[0].hypot(p[2]);
            let (a, b) = (depth(mesh.position(&source)), depth(mesh.position(&end)));
            let apart = if page(&source) == page(&end) { a - b } else { a + b };
            assert!((checked(&paths, &mesh, &end) - apart.hypot(y - t)).abs() < 1e-12);
        }
    }
}

#[test]
fn faces_upon_each_other_change_nothing() {
    let mesh = rough(12, 5, 1.0);
    let repeated = [mesh.faces(), mesh.faces(), mesh.faces()].concat();
    let three = TriMesh::new(mesh.points().to_vec(), repeated).unwrap();
    let (once, thrice) = (from_vertices(&mesh, &[40]), from_vertices(&three, &[40]));
    for (a, b) in once.iter().zip(&thrice) {
        assert!((a - b).abs() < 1e-11, "{a} {b}");
    }
}

#[test]
fn layers_that_are_welded_at_their_edges() {
    // Squares twice, cut along one diagonal and along the other: each way of k squares exists 2^k times.
    let mesh = rough(10, 4, 1.0);
    let other = mesh.faces().chunks(2).flat_map(|pair| {
        let ([a, b, d], [_, _, c]) = (pair[0], pair[1]);
        [[a, b, c], [b, d, c]]
    });
    let faces = mesh.faces().iter().copied().chain(other).collect();
    let layers = TriMesh::new(mesh.points().to_vec(), faces).unwrap();
    against_the_graph(&layers, &[0, 60], 15, 0.03);
    laws(&layers, 3);
}

#[test]
fn a_moebius_strip_has_one_side() {
    let (around, across) = (40, 6);
    let strip = shapes::sheet(around, across, |i, j| {
        let (angle, off) = (TAU * i as f64 / around as f64, j as f64 / across as f64 - 0.5);
        let radius = 2.0 + off * (0.5 * angle).cos();
        [radius * angle.cos(), radius * angle.sin(), off * (0.5 * angle).sin()]
    });
    // The last column is the first one upside down.
    let (columns, last) = (around as u32 + 1, around as u32);
    let weld =
        |v: u32| if v % columns == last { (across as u32 - v / columns) * columns } else { v };
    let faces = strip.faces().iter().map(|face| face.map(weld)).collect();
    let mesh = TriMesh::new(strip.points().to_vec(), faces).unwrap();
    against_the_graph(&mesh, &[0, 100, 130], 12, 0.01);
    laws(&mesh, 17);
}

// ===================================================================== Laws

/// The graph is never shorter, and longer by no more than `excess`.
fn against_the_graph(mesh: &TriMesh, vertices: &[u32], steps: usize, excess: f64) {
    let medium = Medium::uniform(mesh.clone()).unwrap();
    let exact = Exact::new(&medium).unwrap();
    for &vertex in vertices {
        let paths = from(&exact, mesh, &[mesh.at_vertex("source", 0, vertex).unwrap()]);
        let graph = on_graph(&medium, vertex, steps);
        for (found, upper) in paths.map().values().iter().zip(&graph) {
            if upper.is_finite() {
                assert!(
                    *found <= upper * (1.0 + 1e-9) && *upper <= found * (1.0 + excess),
                    "{found} {upper}"
                );
            }
        }
    }
}

/// Symmetry, the triangle inequality, no shorter than through space, paths as long as distances.
fn laws(mesh: &TriMesh, seed: u64) {
    let (exact, mut random) = (exact(mesh), Random(seed));
    let points = [0; 5].map(|_| random.point(mesh));
    let all = points.map(|point| from(&exact, mesh, &[point]));
    let between = |i: usize, j: usize| checked(&all[i], mesh, &points[j]);
    let scale = 1.0
        + all[0].map().values().iter().filter(|d| d.is_finite()).fold(0.0, |a: f64, b| a.max(*b));
    for i in 0..5 {
        assert!(between(i, i) <= 1e-12 * scale);
        for j in 0..5 {
            assert!((between(i, j) - between(j, i)).abs() <= 1e-10 * scale);
            let straight = euclid(mesh.position(&points[i]), mesh.position(&points[j]));
            assert!(between(i, j) >= straight - 1e-10 * scale);
            for k in 0..5 {
                assert!(between(i, k) <= between(i, j) + between(j, k) + 1e-10 * scale);
            }
        }
    }
}

#[test]
fn the_graph_converges_to_the_distance() {
    let mesh = rough(8, 1, 2.0);
    let medium = Medium::uniform(mesh.clone()).unwrap();
    let exact = from_vertices(&mesh, &[20]);
    let excess = |steps| {
        let graph = on_graph(&medium, 20, steps);
        graph.iter().zip(&exact).map(|(upper, d)| (upper - d) / (d + 1e-3)).fold(0.0, f64::max)
    };
    let excesses = [3, 7, 15, 31].map(excess);
    println!("largest excess of the graph with 3, 7, 15, 31 points on edges: {excesses:?}");
    assert!(excesses.windows(2).all(|pair| pair[1] < 0.45 * pair[0]), "{excesses:?}");
    assert!(excesses[3] < 1e-3);
}

#[test]
fn a_change_of_units_changes_the_units() {
    let mesh = rough(15, 2, 1.5);
    let expected = from_vertices(&mesh, &[33]);
    for factor in [1e-6, 1e6, 1e-80, 1e80] {
        let found = from_vertices(&scaled(&mesh, factor), &[33]);
        for (a, b) in expected.iter().zip(&found) {
            assert!((a - b / factor).abs() < 1e-12 * (1.0 + a));
        }
    }
}

/// Each face in three, with a random point of it as a new vertex; and these points on the mesh.
fn split(mesh: &TriMesh, random: &mut Random) -> (TriMesh, Vec<SurfacePoint>) {
    let (mut points, mut faces, mut inside) = (mesh.points().to_vec(), Vec::new(), Vec::new());
    for (face, &[a, b, c]) in mesh.faces().iter().enumerate() {
        let weights = [0, 1, 2].map(|_| random.next() + 1e-3);
        let sum: f64 = weights.iter().sum();
        inside.push(SurfacePoint { face: face as u32, weights: weights.map(|w| w / sum) });
        let new = points.len() as u32;
        points.push(mesh.position(&inside[face]));
        faces.extend([[a, b, new], [b, c, new], [c, a, new]]);
    }
    (TriMesh::new(points, faces).unwrap(), inside)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn points_inside_faces_are_as_good_as_vertices(
        n in 2_usize..12,
        seed in any::<u64>(),
        height in 0.0..4.0_f64,
        count in 1_usize..8,
    ) {
        let (mesh, mut random) = (rough(n, seed, height), Random(seed));
        let (finer, inside) = split(&mesh, &mut random);
        // Otherwise the two have different lengths.
        prop_assume!(Medium::uniform(finer.clone()).unwrap().mollified() == 0.0);
        let chosen: Vec<(usize, f64)> = (0..count)
            .map(|_| ((random.next() * inside.len() as f64) as usize, random.next()))
            .collect();
        let source = |point, offset| Source { point, offset, label: 0 };
        let on_mesh = chosen.iter().map(|&(face, offset)| source(inside[face], offset)).collect();
        let on_finer = chosen.iter().map(|&(face, offset)| {
            let vertex = (mesh.points().len() + face) as u32;
            source(finer.at_vertex("source", 0, vertex).unwrap(), offset)
        });
        let on_mesh = Sources::with_offsets(&mesh, on_mesh).unwrap();
        let on_finer = Sources::with_offsets(&finer, on_finer.collect()).unwrap();
        let (a, b) = (exact(&mesh), exact(&finer));
        let (options, exec) = (ExactOptions::default(), Exec::single_threaded());
        let paths = a.paths(&on_mesh, &options, &exec).unwrap();
        let expected = b.distance(&on_finer, &options, &exec).unwrap();
        let expected = expected.values();
        prop_assert_eq!(a.distance(&on_mesh, &options, &exec).unwrap(), paths.map().clone());
        for (found, expected) in paths.map().values().iter().zip(expected) {
            prop_assert!((found - expected).abs() < 1e-9, "{} {}", found, expected);
        }
        for (point, expected) in inside.iter().zip(&expected[mesh.points().len()..]) {
            let found = paths.distance_at(point).unwrap();
            prop_assert!((found - expected).abs() < 1e-9, "{} {}", found, expected);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn laws_on_rough_meshes(n in 2_usize..14, seed in any::<u64>(), height in 0.0..8.0_f64) {
        let mesh = rough(n, seed, height);
        // Otherwise its lengths are not those in space.
        prop_assume!(Medium::uniform(mesh.clone()).unwrap().mollified() == 0.0);
        laws(&mesh, seed ^ 1);
        against_the_graph(&mesh, &[(seed % (n as u64 + 1).pow(2)) as u32], 15, 0.1);
    }

    #[test]
    fn nearly_degenerate_meshes(n in 2_usize..12, seed in any::<u64>(), exponent in -16..-2_i32) {
        nearly_degenerate_mesh(n, seed, exponent);
    }
}

/// The only window to a corner was lost across a needle.
#[test]
fn the_corner_behind_a_needle() {
    nearly_degenerate_mesh(9, 5_185_247_509_989_638_859, -13);
}

/// The height of a needle had half its digits.
#[test]
fn a_path_across_a_needle() {
    nearly_degenerate_mesh(6, 17_644_585_697_716_804_029, -5);
}

/// Vertices on a coarse lattice, off it by next to nothing: needles, caps and folds.
fn nearly_degenerate_mesh(n: usize, seed: u64, exponent: i32) {
    let base = rough(n, seed, 3.0);
    let mut random = Random(seed);
    let tiny = 10_f64.powi(exponent);
    let points = base.points().iter().map(|p| p.map(|x| x.round() + tiny * random.next()));
    let mesh = TriMesh::new(points.collect(), base.faces().to_vec()).unwrap();
    let medium = Medium::uniform(mesh.clone()).unwrap();
    let source = (seed % (n as u64 + 1).pow(2)) as u32;
    let exact = Exact::new(&medium).unwrap();
    let paths = from(&exact, &mesh, &[mesh.at_vertex("source", 0, source).unwrap()]);
    // Across needles a way on the graph is up to a step of it longer.
    let (graph, steps) = (on_graph(&medium, source, 19), 20.0);
    let step = medium.lengths().iter().copied().fold(0.0, f64::max) / steps;
    for (vertex, upper) in graph.iter().enumerate() {
        let found = paths.map().values()[vertex];
        assert!(found <= upper + 1e-9 && *upper <= found * 1.1 + step, "{found} {upper}");
        let end = mesh.at_vertex("end", 0, vertex as u32).unwrap();
        let path = paths.path(&end).unwrap();
        assert_eq!(path.ending, Ending::Source(0));
        // Of needles, lengths leave fewer digits; lengths that were mollified are not those in space.
        let error = (path.length - found).abs();
        assert!(medium.mollified() > 0.0 || error <= 1e-10 * found, "{} {found}", path.length);
    }
}

// ===================================================================== Sources and options

#[test]
fn the_nearest_of_several_sources_with_offsets() {
    let mesh = square(14, None);
    let mut random = Random(23);
    for base in [0.0, -3.0, 1e6] {
        let list: Vec<Source> = (0..6)
            .map(|i| Source {
                point: random.point(&mesh),
                offset: base + 0.3 * random.next(),
                label: 7 * i,
            })
            .collect();
        let sources = Sources::with_offsets(&mesh, list.clone()).unwrap();
        let (exact, options) = (exact(&mesh), ExactOptions::default());
        let paths = exact.paths(&sources, &options, &Exec::single_threaded()).unwrap();
        for _ in 0..200 {
            let end = random.point(&mesh);
            let way = |s: &Source| s.offset + euclid(mesh.position(&s.point), mesh.position(&end));
            let nearest = list.iter().min_by(|a, b| way(a).total_cmp(&way(b))).unwrap();
            let found = paths.distance_at(&end).unwrap();
            assert!((found - way(nearest)).abs() < 1e-9, "{found} {}", way(nearest));
            assert_eq!(paths.label_at(&end), Ok(nearest.label));
        }
    }
}

#[test]
fn it_ends_where_it_is_told_to() {
    let mesh = square(14, None);
    let all = from_vertices(&mesh, &[50]);
    let sources = Sources::at_vertices(&mesh, &[50]).unwrap();
    let (exact, exec) = (exact(&mesh), Exec::single_threaded());
    let mut options = ExactOptions { farthest: 0.4 };
    let paths = exact.paths(&sources, &options, &exec).unwrap();
    for (full, part) in all.iter().zip(paths.map().values()) {
        assert_eq!(*part, if *full <= 0.4 { *full } else { f64::INFINITY });
    }
    let mut random = Random(1);
    for _ in 0..300 {
        let end = random.point(&mesh);
        let full = euclid(mesh.position(&end), mesh.points()[50]);
        let part = paths.distance_at(&end).unwrap();
        assert!(if full < 0.4 { (part - full).abs() < 1e-12 } else { part.is_infinite() });
    }
    for wrong in [0.0, -1.0, f64::NAN] {
        options.farthest = wrong;
        let error = exact.distance(&sources, &options, &exec).unwrap_err();
        assert!(error.to_string().starts_with("farthest is"), "{error}");
    }
}

#[test]
fn a_constant_slowness_is_a_factor_and_others_are_refused() {
    let mesh = rough(6, 9, 1.0);
    let count = mesh.points().len();
    let slow = Medium::given(mesh.clone(), &vec![0.25; count]).unwrap();
    let sources = Sources::at_vertices(&mesh, &[3]).unwrap();
    let exec = Exec::single_threaded();
    let map =
        Exact::new(&slow).unwrap().distance(&sources, &ExactOptions::default(), &exec).unwrap();
    for (a, b) in from_vertices(&mesh, &[3]).iter().zip(map.values()) {
        assert!((2.0 * a - b).abs() < 1e-12);
    }
    let mut speed_sq = vec![1.0; count];
    speed_sq[0] = 0.25;
    let error = Exact::new(&Medium::given(mesh, &speed_sq).unwrap()).unwrap_err();
    assert!(matches!(error, ExactError::Slowness { low: 1.0, .. }), "{error}");
}

#[test]
fn it_can_be_cancelled_and_bad_ends_are_named() {
    let mesh = shapes::icosphere(4);
    let sources = Sources::at_vertices(&mesh, &[0]).unwrap();
    let (exact, options) = (exact(&mesh), ExactOptions::default());
    let stop = Exec::single_threaded().with_watch(|part| {
        if part > 0.3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let error = exact.distance(&sources, &options, &stop).unwrap_err();
    assert_eq!(error.to_string(), "cancelled");
    let paths = exact.paths(&sources, &options, &Exec::single_threaded()).unwrap();
    let off = SurfacePoint { face: 1 << 20, weights: [1.0, 0.0, 0.0] };
    assert!(paths.path(&off).unwrap_err().to_string().starts_with("end 0 lies on face 1048576"));
    assert!(paths.distance_at(&off).is_err());
}
