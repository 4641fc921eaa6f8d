//! Paths on meshes: down a distance, shortened, and along levels.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(clippy::print_stdout, reason = "the figures of docs/accuracy.md")]

use heatpath_core::mesh::path::{Descent, Ending, Isoline, Path, isolines, shorten, shorten_loop};
use heatpath_core::mesh::{Locator, Medium, Source, Sources, SurfacePoint, TriMesh, shapes};
use proptest::prelude::*;

fn between(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// A number from 0 to 1 that looks like any.
fn any(seed: usize) -> f64 {
    (((seed as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20) % 100_003) as f64 / 100_003.0
}

/// The unit square with 64 x 64 cells, its inner vertices moved by up to 0.3 cells.
fn jittered(cells: usize) -> TriMesh {
    shapes::sheet(cells, cells, |i, j| {
        let moved = |k: usize, seed: usize| {
            let inside = i > 0 && j > 0 && i < cells && j < cells;
            let jitter = if inside { 0.6 * any(2 * (i * 97 + j * 1013) + seed) - 0.3 } else { 0.0 };
            (k as f64 + jitter) / cells as f64
        };
        [moved(i, 0), moved(j, 1), 0.0]
    })
}

/// The faces that a point lies on.
fn faces_at(mesh: &TriMesh, point: &SurfacePoint) -> Vec<u32> {
    let corners = mesh.faces()[point.face as usize];
    let of: Vec<u32> = (0..3).filter(|&i| point.weights[i] > 1e-12).map(|i| corners[i]).collect();
    let first = mesh.adjacency().vertex_faces().of(of[0] as usize).iter().copied();
    first.filter(|&face| of.iter().all(|v| mesh.faces()[face as usize].contains(v))).collect()
}

/// The vertices that a point lies between, in their order.
fn on_corners(mesh: &TriMesh, point: &SurfacePoint) -> Vec<u32> {
    let corners = mesh.faces()[point.face as usize];
    let mut on: Vec<u32> = (0..3).filter(|&i| point.weights[i] > 0.0).map(|i| corners[i]).collect();
    on.sort_unstable();
    on
}

fn assert_connected(mesh: &TriMesh, points: &[SurfacePoint]) {
    for pair in points.windows(2) {
        let [a, b] = [0, 1].map(|i| faces_at(mesh, &pair[i]));
        assert!(a.iter().any(|face| b.contains(face)), "{pair:?} share no face");
    }
}

fn path_to(medium: &Medium, values: &[f64], source: SurfacePoint, end: SurfacePoint) -> Path {
    let sources = Sources::new(medium.mesh(), &[source]).unwrap();
    let path = Descent::new(medium, values, &sources).unwrap().path(end).unwrap();
    assert_eq!(path.ending, Ending::Source(0));
    assert_eq!(path.points.last(), Some(&source));
    assert_connected(medium.mesh(), &path.points);
    path
}

/// The largest and mean excess of the lengths of paths over the distances, in edges.
fn excess(mesh: TriMesh, edge: f64, distance: impl Fn([f64; 3], [f64; 3]) -> f64) -> [f64; 2] {
    let medium = Medium::uniform(mesh).unwrap();
    let mesh = medium.mesh();
    let source = SurfacePoint { face: mesh.faces().len() as u32 / 3, weights: [0.2, 0.3, 0.5] };
    let place = mesh.position(&source);
    let values: Vec<f64> = mesh.points().iter().map(|&p| distance(p, place)).collect();
    let [mut largest, mut sum] = [0.0_f64, 0.0];
    for face in (0..mesh.faces().len()).step_by(37) {
        let end = SurfacePoint { face: face as u32, weights: [0.5, 0.1, 0.4] };
        let path = path_to(&medium, &values, source, end);
        assert_eq!(path.points[0], end);
        let more = (path.length - distance(mesh.position(&end), place)) / edge;
        (largest, sum) = (largest.max(more), sum + more);
    }
    [largest, sum / mesh.faces().len().div_ceil(37) as f64]
}

#[test]
fn paths_are_about_as_long_as_the_distance() {
    let plane = excess(jittered(64), 1.0 / 64.0, between);
    let sphere = excess(shapes::icosphere(4), 0.07, |a, b| {
        let cos: f64 = (0..3).map(|i| a[i] * b[i]).sum();
        (cos / (between(a, [0.0; 3]) * between(b, [0.0; 3]))).clamp(-1.0, 1.0).acos()
    });
    // Folded across the middle: the distance is that of the sheet before.
    let flat = |[x, y, z]: [f64; 3]| [x + z, y, 0.0];
    let folded = shapes::sheet(40, 40, |i, j| {
        let (x, y) = (i as f64 / 40.0, j as f64 / 40.0);
        [x.min(0.5), y, (x - 0.5).max(0.0)]
    });
    let fold = excess(folded, 1.0 / 40.0, |a, b| between(flat(a), flat(b)));
    for (name, [largest, mean]) in [("plane", plane), ("sphere", sphere), ("fold", fold)] {
        println!("| {name} | {largest:.3} | {mean:.3} | edges");
        assert!(largest < 0.8 && mean < 0.25, "{name}: {largest}, {mean}");
    }
}

#[test]
fn the_nearest_of_several_sources_by_its_offset() {
    let medium = Medium::uniform(jittered(20)).unwrap();
    let mesh = medium.mesh();
    let locator = Locator::new(mesh);
    let at = |x: f64, y: f64| locator.nearest([x, y, 0.0]).0;
    // The third lies nearer to the first than its offset says; the last is on an edge.
    let list =
        [(0.21, 0.3, 0.0, 4), (0.8, 0.72, -0.1, 5), (0.3, 0.31, 0.2, 6), (0.7, 1.0, 0.05, 7)];
    let source = |(x, y, offset, label)| Source { point: at(x, y), offset, label };
    let list: Vec<Source> = list.into_iter().map(source).collect();
    let nearest = |p: [f64; 3]| {
        let all = list.iter().map(|s| (s.offset + between(p, mesh.position(&s.point)), s));
        all.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    };
    let values: Vec<f64> = mesh.points().iter().map(|&p| nearest(p).0).collect();
    let sources = Sources::with_offsets(mesh, list.clone()).unwrap();
    let descent = Descent::new(&medium, &values, &sources).unwrap();
    let mut right = 0;
    for face in 0..mesh.faces().len() as u32 {
        let end = SurfacePoint { face, weights: [0.3, 0.3, 0.4] };
        let (distance, source) = nearest(mesh.position(&end));
        let path = descent.path(end).unwrap();
        right += u32::from(path.ending == Ending::Source(source.label));
        assert!((path.distance - distance).abs() < 0.03, "{} for {distance}", path.distance);
        assert_ne!(path.ending, Ending::Source(6));
        assert!(matches!(path.ending, Ending::Source(_)));
    }
    // On the line between two sources either will do.
    assert!(right >= 780, "{right} of 800 paths end at their nearest source");
}

/// A roof, of which the ridge is ten times as fast: paths join it and stay on it.
#[test]
fn paths_follow_a_fast_ridge() {
    let roof = shapes::sheet(40, 20, |i, j| [i as f64, j as f64, -(j as f64 - 10.0).abs()]);
    let speed = |p: &[f64; 3]| if p[1] == 10.0 { 100.0 } else { 0.01 };
    let speeds: Vec<f64> = roof.points().iter().map(speed).collect();
    // The ridge costs 1 a unit, the way to it much more.
    let values: Vec<f64> =
        roof.points().iter().map(|p| p[0] + 100.0 * (p[1] - 10.0).abs()).collect();
    let medium = Medium::given(roof, &speeds).unwrap();
    let at = |vertex| medium.mesh().at_vertex("end", 0, vertex).unwrap();
    let path = path_to(&medium, &values, at(10 * 41), at(15 * 41 + 40));
    let on_ridge = path.positions.iter().filter(|p| p[1] == 10.0).count();
    assert!(on_ridge >= 40, "{:?}", path.positions);
}

#[test]
fn ends_of_other_components_are_unreachable_and_false_minima_are_said() {
    let sheet = shapes::sheet(2, 2, |i, j| [i as f64, j as f64, 0.0]);
    let mut points = sheet.points().to_vec();
    points.extend([[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0], [9.0; 3]]);
    let mut faces = sheet.faces().to_vec();
    faces.push([9, 10, 11]);
    let medium = Medium::uniform(TriMesh::new(points, faces).unwrap()).unwrap();
    let mesh = medium.mesh();
    let sources = Sources::at_vertices(mesh, &[0]).unwrap();
    let mut values: Vec<f64> = mesh.points().iter().map(|p| p[0].hypot(p[1])).collect();
    values[9..].fill(f64::INFINITY);
    let end = SurfacePoint { face: 8, weights: [0.2, 0.3, 0.5] };
    let path = Descent::new(&medium, &values, &sources).unwrap().path(end).unwrap();
    assert_eq!((path.ending, path.points.len()), (Ending::Unreachable, 1));
    assert_eq!(path.distance, f64::INFINITY);
    values[8] = -1.0;
    let end = mesh.at_vertex("end", 0, 5).unwrap();
    let path = Descent::new(&medium, &values, &sources).unwrap().path(end).unwrap();
    assert_eq!((path.ending, path.points.len()), (Ending::Stuck, 3));
    let text = Descent::new(&medium, &values[1..], &sources).unwrap_err().to_string();
    assert_eq!(text, "12 values were given for 13 vertices");
}

#[test]
fn the_end_may_be_the_source() {
    let medium = Medium::uniform(jittered(4)).unwrap();
    let mesh = medium.mesh();
    let inside = SurfacePoint { face: 7, weights: [0.25, 0.25, 0.5] };
    for point in [inside, mesh.at_vertex("end", 0, 12).unwrap()] {
        let values: Vec<f64> =
            mesh.points().iter().map(|&p| between(p, mesh.position(&point))).collect();
        let path = path_to(&medium, &values, point, point);
        assert_eq!((path.length, path.distance), (0.0, 0.0));
    }
}

/// Along the edges from one vertex to another, by a search in depth: far from short.
fn along_edges(mesh: &TriMesh, from: u32, to: u32) -> Path {
    let mut before = vec![u32::MAX; mesh.points().len()];
    let mut stack = vec![to];
    before[to as usize] = to;
    while let Some(vertex) = stack.pop() {
        for &edge in mesh.adjacency().vertex_edges().of(vertex as usize) {
            let next = mesh.adjacency().other_end(edge, vertex);
            if before[next as usize] == u32::MAX {
                before[next as usize] = vertex;
                stack.push(next);
            }
        }
    }
    let mut vertices = vec![from];
    while vertices[vertices.len() - 1] != to {
        vertices.push(before[vertices[vertices.len() - 1] as usize]);
    }
    through_vertices(mesh, &vertices)
}

fn through_vertices(mesh: &TriMesh, vertices: &[u32]) -> Path {
    let points: Vec<SurfacePoint> =
        vertices.iter().map(|&v| mesh.at_vertex("end", 0, v).unwrap()).collect();
    let positions: Vec<[f64; 3]> = points.iter().map(|p| mesh.position(p)).collect();
    let length = positions.windows(2).map(|p| between(p[0], p[1])).sum();
    Path { points, positions, ending: Ending::Source(0), length, distance: f64::NAN }
}

fn assert_shortened(mesh: &TriMesh, path: &Path) -> Path {
    let short = shorten(mesh, path).unwrap();
    assert_connected(mesh, &short.points);
    assert!(short.length <= path.length);
    assert_eq!(short.points.first(), path.points.first());
    assert_eq!(short.points.last(), path.points.last());
    short
}

fn assert_shortest(mesh: &TriMesh, path: &Path) -> Path {
    let short = assert_shortened(mesh, path);
    let again = shorten(mesh, &short).unwrap();
    assert!(
        (again.length - short.length).abs() <= 1e-12 * short.length,
        "{} after {}",
        again.length,
        short.length
    );
    short
}

#[test]
fn shortened_paths_are_straight_in_the_plane() {
    let mesh = jittered(30);
    for (from, to) in [(0, 960), (480, 30), (17, 941), (33, 34), (5, 5)] {
        let path = along_edges(&mesh, from, to);
        let short = assert_shortest(&mesh, &path);
        let straight = between(path.positions[0], path.positions[path.positions.len() - 1]);
        assert!((short.length - straight).abs() < 1e-12, "{} for {straight}", short.length);
    }
    // Points inside faces.
    let medium = Medium::uniform(mesh).unwrap();
    let at = |face| SurfacePoint { face, weights: [0.1, 0.2, 0.7] };
    let place = medium.mesh().position(&at(3));
    let values: Vec<f64> = medium.mesh().points().iter().map(|&p| between(p, place)).collect();
    let path = path_to(&medium, &values, at(3), at(1501));
    let short = assert_shortest(medium.mesh(), &path);
    let straight = between(place, medium.mesh().position(&at(1501)));
    assert!((short.length - straight).abs() < 1e-12);
}

#[test]
fn shortened_paths_on_curved_surfaces() {
    // === A great circle
    for level in [2, 3, 4] {
        let sphere = shapes::icosphere(level);
        let short = assert_shortest(&sphere, &along_edges(&sphere, 3, 40));
        let [a, b] = [3, 40].map(|v| sphere.points()[v]);
        let arc = 2.0 * (between(a, b) / 2.0).asin();
        println!("| sphere {level} | {:.6} | {arc:.6} |", short.length);
        assert!((short.length / arc - 1.0).abs() < 0.3 * 0.25_f64.powi(level as i32));
    }
    // === A helix, on a prism of 48 sides that is unrolled exactly
    let (around, high) = (48, 30);
    let side = 2.0 * (std::f64::consts::PI / around as f64).sin();
    let tube = tube(around, high, side);
    let path = along_edges(&tube, 0, (high * around + around / 3) as u32);
    let short = assert_shortest(&tube, &path);
    let windings = (-8..8).map(|w| {
        (side * (around as f64 / 3.0 + f64::from(w * around as i32))).hypot(side * high as f64)
    });
    let nearest = windings.map(|exact| (short.length - exact).abs()).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-10, "{} is no winding", short.length);
}

/// An open tube of squares with sides `side` around the z axis.
fn tube(around: usize, high: usize, side: f64) -> TriMesh {
    let points = (0..=high).flat_map(|row| {
        (0..around).map(move |i| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / around as f64).sin_cos();
            [cos, sin, side * row as f64]
        })
    });
    let number = |row: usize, i: usize| (row * around + i % around) as u32;
    let squares = (0..high).flat_map(|row| {
        (0..around).map(move |i| {
            let [a, b, c, d] = [(row, i), (row, i + 1), (row + 1, i), (row + 1, i + 1)];
            [[a, b, d], [a, d, c]]
        })
    });
    let faces = squares.flatten().map(|face| face.map(|(row, i)| number(row, i)));
    TriMesh::new(points.collect(), faces.collect()).unwrap()
}

#[test]
fn a_cube_from_corner_to_corner_and_around_a_hole() {
    // The unit cube: the way over two faces is the root of 5.
    let corner = |i: u32| [i & 1, (i >> 1) & 1, (i >> 2) & 1].map(f64::from);
    let squares =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces = squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let cube = TriMesh::new((0..8).map(corner).collect(), faces).unwrap();
    let short = assert_shortest(&cube, &through_vertices(&cube, &[0, 1, 3, 7]));
    assert!((short.length - 5.0_f64.sqrt()).abs() < 1e-12, "{}", short.length);
    // A plane with a hole of 4 x 4 in its middle: over one of its corners.
    let sheet = shapes::sheet(12, 12, |i, j| [i as f64, j as f64, 0.0]);
    let is_hole = |face: &[u32; 3]| {
        let middle =
            |axis: usize| face.iter().map(|&v| sheet.points()[v as usize][axis]).sum::<f64>() / 3.0;
        [0, 1].iter().all(|&axis| (4.0..8.0).contains(&middle(axis)))
    };
    let faces = sheet.faces().iter().copied().filter(|face| !is_hole(face)).collect();
    let holed = TriMesh::new(sheet.points().to_vec(), faces).unwrap();
    let path: Vec<u32> = (0..=12).map(|i| 13 * i).chain((1..=12).map(|i| 156 + i)).collect();
    let short = assert_shortest(&holed, &through_vertices(&holed, &path));
    assert!((short.length - 2.0 * 4.0_f64.hypot(8.0)).abs() < 1e-12, "{}", short.length);
    assert!(short.positions.iter().any(|p| p[0] == 4.0 && p[1] == 8.0));
}

#[test]
fn loops_shrink_to_closed_geodesics_or_points() {
    let points = |mesh: &TriMesh, vertices: &[u32]| through_vertices(mesh, vertices).points;
    let closed_length = |mesh: &TriMesh, loop_points: &[SurfacePoint]| {
        let places: Vec<[f64; 3]> = loop_points.iter().map(|p| mesh.position(p)).collect();
        (0..places.len()).map(|i| between(places[i], places[(i + 1) % places.len()])).sum::<f64>()
    };
    // === Around a tube: its girth
    let side = 2.0 * (std::f64::consts::PI / 24.0).sin();
    let tube = tube(24, 10, side);
    let zigzag: Vec<u32> = (0..24)
        .flat_map(|i| {
            let row = 1 + (i * 5) % 8;
            let step = |row: usize, i: usize| (row * 24 + i % 24) as u32;
            let rows = |a: usize, b: usize| {
                if a < b { (a..=b).collect() } else { (b..=a).rev().collect::<Vec<_>>() }
            };
            let to = 1 + ((i + 1) % 24 * 5) % 8;
            rows(row, to).into_iter().map(move |row| step(row, i)).collect::<Vec<_>>()
        })
        .collect();
    let girth = shorten_loop(&tube, &points(&tube, &zigzag)).unwrap().unwrap();
    assert!((closed_length(&tube, &girth) - 24.0 * side).abs() < 1e-10);
    let closed: Vec<SurfacePoint> = girth.iter().chain(girth.first()).copied().collect();
    assert_connected(&tube, &closed);
    // === A small loop, and a great circle
    assert_eq!(shorten_loop(&tube, &points(&tube, &[30, 31, 55, 54])).unwrap(), None);
    let sphere = shapes::icosphere(3);
    let mut around: Vec<u32> = Vec::new();
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        let path = along_edges(&sphere, from, to);
        around.extend(
            path.points.iter().map(|p| sphere.faces()[p.face as usize][p.corner().unwrap()]),
        );
        around.pop();
    }
    assert_eq!(shorten_loop(&sphere, &points(&sphere, &around)).unwrap(), None);
    // === The inner equator of a torus, from a loop around it that winds through the hole
    let torus = shapes::torus(2.0, 1.0, 40, 20);
    let winding: Vec<u32> = (0..40)
        .flat_map(|i| {
            let up = i * 6 / 40;
            let next = (i + 1) * 6 / 40;
            (up..=next).map(move |j| (j + 7) * 40 + i).collect::<Vec<u32>>()
        })
        .chain((8..=13).rev().map(|j| j * 40))
        .collect();
    let inner = shorten_loop(&torus, &points(&torus, &winding)).unwrap().unwrap();
    let exact = 80.0 * (std::f64::consts::PI / 40.0).sin();
    let found = closed_length(&torus, &inner);
    println!("| torus | {found:.9} | {exact:.9} |");
    assert!((found - exact).abs() < 1e-6);
}

fn line_length(mesh: &TriMesh, line: &Isoline) -> f64 {
    let places: Vec<[f64; 3]> = line.points.iter().map(|p| mesh.position(p)).collect();
    let open: f64 = places.windows(2).map(|p| between(p[0], p[1])).sum();
    if line.is_closed { open + between(places[0], places[places.len() - 1]) } else { open }
}

fn assert_on_level(mesh: &TriMesh, values: &[f64], level: f64, line: &Isoline) {
    assert_connected(mesh, &line.points);
    if line.is_closed {
        assert_connected(mesh, &[line.points[0], line.points[line.points.len() - 1]]);
    }
    for point in &line.points {
        let corners = mesh.faces()[point.face as usize];
        let value: f64 = (0..3).map(|i| point.weights[i] * values[corners[i] as usize]).sum();
        assert!((value - level).abs() < 1e-12, "{value} for {level}");
    }
    for pair in line.points.windows(2) {
        assert_ne!(pair[0], pair[1]);
    }
}

#[test]
fn isolines_of_known_shape() {
    // === Straight lines across a square, some through vertices only
    let mesh = shapes::sheet(8, 8, |i, j| [i as f64, j as f64, 0.0]);
    let values: Vec<f64> = mesh.points().iter().map(|p| p[0]).collect();
    let levels = [2.0, 3.5, 0.0, 8.0, 9.0];
    let lines = isolines(&mesh, &values, &levels).unwrap();
    assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [1, 1, 1, 1, 0]);
    for (level, line) in levels.iter().zip(&lines[..4]) {
        assert!(!line[0].is_closed);
        assert_on_level(&mesh, &values, *level, &line[0]);
        assert!((line_length(&mesh, &line[0]) - 8.0).abs() < 1e-12);
    }
    assert_eq!(lines[0][0].points.len(), 9);
    // === Both diagonals meet in a saddle at a vertex: four arms
    let saddle: Vec<f64> =
        mesh.points().iter().map(|p| (p[0] - p[1]) * (p[0] + p[1] - 8.0)).collect();
    let arms = &isolines(&mesh, &saddle, &[0.0]).unwrap()[0];
    assert_eq!(arms.len(), 4);
    let sum: f64 = arms.iter().map(|arm| line_length(&mesh, arm)).sum();
    assert!((sum - 2.0 * 128.0_f64.sqrt()).abs() < 1e-12);
    // === Circles of a sphere, also where vertices are on them
    let sphere = shapes::icosphere(4);
    let heights: Vec<f64> = sphere.points().iter().map(|p| p[2]).collect();
    for (level, lines) in
        [0.0, 0.5].into_iter().zip(isolines(&sphere, &heights, &[0.0, 0.5]).unwrap())
    {
        assert!(lines.len() == 1 && lines[0].is_closed);
        assert_on_level(&sphere, &heights, level, &lines[0]);
        let exact = std::f64::consts::TAU * (1.0 - level * level).sqrt();
        let found = line_length(&sphere, &lines[0]);
        assert!((found / exact - 1.0).abs() < 2e-3, "{found} for {exact}");
    }
    // === A top in one point, and faces that nothing has reached
    let mut values: Vec<f64> = mesh.points().iter().map(|p| between(*p, [4.0, 4.0, 0.0])).collect();
    assert_eq!(isolines(&mesh, &values, &[0.0]).unwrap()[0], []);
    values[0] = f64::INFINITY;
    let corner = &isolines(&mesh, &values, &[5.2]).unwrap()[0];
    assert_eq!(corner.len(), 3);
}

/// Any triangles between a few points: borders, edges of many faces, flat and doubled faces.
fn any_mesh() -> impl Strategy<Value = TriMesh> {
    let points = prop::collection::vec(prop::array::uniform3(-2..3_i32), 12);
    let faces = prop::collection::vec((0..12_u32, 1..6_u32, 1..6_u32), 1..40);
    (points, faces).prop_filter_map("all points in one place", |(points, faces)| {
        let points = points.iter().map(|p| p.map(f64::from)).collect();
        let face = |&(a, b, c): &(u32, u32, u32)| [a, (a + b) % 12, (a + b + c) % 12];
        let mesh = TriMesh::new(points, faces.iter().map(face).collect()).ok()?;
        Medium::uniform(mesh.clone()).is_ok().then_some(mesh)
    })
}

proptest! {
    #[test]
    fn any_walk_is_shortened(mesh in any_mesh(), turns in prop::collection::vec(0..100_usize, 1..30)) {
        let mut vertices = vec![mesh.faces()[0][0]];
        for turn in turns {
            let here = vertices[vertices.len() - 1];
            let edges = mesh.adjacency().vertex_edges().of(here as usize);
            vertices.push(mesh.adjacency().other_end(edges[turn % edges.len()], here));
        }
        let path = through_vertices(&mesh, &vertices);
        assert_shortened(&mesh, &path);
        // With no two points in one place the shortest is that of its own.
        let moved = |(i, p): (usize, &[f64; 3])| [0, 1, 2].map(|axis| p[axis] + 0.3 * any(3 * i + axis));
        let points = mesh.points().iter().enumerate().map(moved).collect();
        let generic = TriMesh::new(points, mesh.faces().to_vec()).unwrap();
        assert_shortest(&generic, &through_vertices(&generic, &vertices));
        let closed = shorten_loop(&mesh, &path.points);
        if mesh.adjacency().edge_between(vertices[0], vertices[vertices.len() - 1]).is_some() {
            let points = closed.unwrap().unwrap_or_default();
            assert_connected(&mesh, &points.iter().chain(points.first()).copied().collect::<Vec<_>>());
        }
    }

}

proptest! {
    #[test]
    fn isolines_have_neither_gaps_nor_doubles(
        mesh in any_mesh(),
        values in prop::collection::vec((0..4_i32).prop_map(f64::from), 12),
        level in prop_oneof![Just(1.0), Just(2.0), 0.0..3.0],
    ) {
        let lines = isolines(&mesh, &values, &[level]).unwrap().remove(0);
        let mut pieces = Vec::new();
        for line in &lines {
            assert_on_level(&mesh, &values, level, line);
            let ring = line.points.iter().chain(line.points.first().filter(|_| line.is_closed));
            let ring: Vec<_> = ring.collect();
            pieces.extend(ring.windows(2).map(|pair| {
                let mut ends = [0, 1].map(|i| format!("{:?}", on_corners(&mesh, pair[i])));
                ends.sort();
                ends
            }));
        }
        let count = pieces.len();
        pieces.sort();
        pieces.dedup();
        prop_assert_eq!(count, pieces.len(), "a piece is there twice");
        // As many as there are different crossings of faces.
        let mut crossed: Vec<_> = mesh.faces().iter().filter_map(|face| {
            let mut ends: Vec<Vec<u32>> = face.iter().filter(|&&v| values[v as usize] == level).map(|&v| vec![v]).collect();
            for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|pair: [usize; 2]| pair.map(|i| face[i])) {
                let [low, high] = [a.min(b), a.max(b)];
                if (values[a as usize] - level) * (values[b as usize] - level) < 0.0 {
                    ends.push(vec![low, high]);
                }
            }
            ends.sort();
            (ends.len() == 2).then_some(ends)
        }).collect();
        crossed.sort();
        crossed.dedup();
        prop_assert_eq!(count, crossed.len());
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn every_descent_ends_and_falls(
        mesh in any_mesh(),
        values in prop::collection::vec(prop_oneof![(0..5_i32).prop_map(f64::from), 0.0..5.0], 12),
        far in 0..24_usize,
        [source, end] in prop::array::uniform2(0.0..1.0_f64),
        kind in 0..3_usize,
    ) {
        let weights = [[1.0, 0.0, 0.0], [0.0, 0.4, 0.6], [0.2, 0.5, 0.3]][kind];
        let mut values = values;
        if far < 12 { values[far] = f64::INFINITY; }
        let on = |part: f64| SurfacePoint { face: (part * mesh.faces().len() as f64) as u32, weights };
        let medium = Medium::uniform(mesh.clone()).unwrap();
        let sources = Sources::new(&mesh, &[on(source)]).unwrap();
        let path = Descent::new(&medium, &values, &sources).unwrap().path(on(end)).unwrap();
        assert_connected(&mesh, &path.points);
        let value = |p: &SurfacePoint| {
            let corners = mesh.faces()[p.face as usize];
            (0..3).filter(|&i| p.weights[i] > 0.0).map(|i| p.weights[i] * values[corners[i] as usize]).sum::<f64>()
        };
        match path.ending {
            Ending::Source(label) => {
                prop_assert_eq!(label, 0);
                prop_assert_eq!(path.points.last(), Some(&on(source)));
            }
            Ending::Unreachable => prop_assert!(value(&on(end)).is_infinite()),
            Ending::Stuck => {
                let last = path.points[path.points.len() - 1];
                let around = faces_at(&mesh, &last);
                let corners = around.iter().flat_map(|&face| mesh.faces()[face as usize]);
                prop_assert!(corners.into_iter().all(|v| values[v as usize] >= value(&last)));
            }
        }
        // Only the way out of a minimum rises: along edges, to a lower vertex.
        let mut level = f64::INFINITY;
        for point in &path.points[..path.points.len() - 1] {
            let value = value(point);
            prop_assert!(value <= level + 1e-12 || point.corner().is_some(), "{} {}", value, level);
            level = level.min(value);
        }
    }
}
