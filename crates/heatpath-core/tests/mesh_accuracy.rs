//! The methods on meshes against closed forms: the table of docs/meshes.md.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(clippy::print_stdout, reason = "the table of errors is what users are shown")]

#[path = "support/meshes.rs"]
mod meshes;

use heatpath_core::Exec;
use heatpath_core::mesh::shapes::{icosphere, sheet, torus};
use heatpath_core::mesh::{
    Directed, Geodesics, GeodesicsOptions, Medium, Method, Source, Sources, TriMesh,
};
use meshes::{apart, jittered};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A medium with sources, and the distance of each vertex.
struct Case {
    name: String,
    medium: Arc<Medium>,
    sources: Sources,
    exact: Vec<f64>,
}

impl Case {
    fn new(name: &str, medium: Medium, sources: Sources, exact: impl Fn([f64; 3]) -> f64) -> Self {
        let exact = medium.mesh().points().iter().map(|&point| exact(point)).collect();
        Self { name: name.to_owned(), medium: Arc::new(medium), sources, exact }
    }

    /// Lengths as they are, from one vertex.
    fn uniform(name: &str, mesh: TriMesh, vertex: u32, exact: impl Fn([f64; 3]) -> f64) -> Self {
        let sources = Sources::at_vertices(&mesh, &[vertex]).unwrap();
        Self::new(name, Medium::uniform(mesh).unwrap(), sources, exact)
    }

    /// Straight distances from one vertex.
    fn straight(name: &str, mesh: TriMesh, vertex: u32) -> Self {
        let start = mesh.points()[vertex as usize];
        Self::uniform(name, mesh, vertex, |point| apart(point, start))
    }

    /// Mean and largest relative error in per cent; none if the method refuses the medium.
    fn errors(&self, method: Method) -> Option<[f64; 2]> {
        let exec = Exec::single_threaded();
        let options = GeodesicsOptions { method, ..GeodesicsOptions::default() };
        let geodesics = Geodesics::new(Arc::clone(&self.medium), options, &exec).ok()?;
        let map = geodesics.distance(&self.sources, &exec).unwrap();
        let pairs = self.exact.iter().zip(map.values()).filter(|(right, _)| **right > 1e-9);
        let errors: Vec<f64> = pairs.map(|(right, found)| (found / right - 1.0).abs()).collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let largest = errors.iter().fold(0.0_f64, |most, &error| most.max(error));
        Some([100.0 * mean, 100.0 * largest])
    }

    /// Prints the line of the table; the mean errors of the heat method and of fast marching must be
    /// below `heat` and `eikonal`.
    fn check(&self, heat: f64, eikonal: f64) {
        let methods = [Method::Heat, Method::Eikonal, Method::Exact];
        let errors = methods.map(|method| self.errors(method));
        let cell = |errors: Option<[f64; 2]>| match errors {
            Some([mean, largest]) => format!("{} / {}", rounded(mean), rounded(largest)),
            None => "-".to_owned(),
        };
        let cells = errors.map(cell).join(" | ");
        println!("| {} | {cells} |", self.name);
        assert!(errors[0].unwrap()[0] < heat, "heat: {:?}", errors[0]);
        assert!(errors[1].unwrap()[0] < eikonal, "eikonal: {:?}", errors[1]);
    }
}

/// Two digits.
fn rounded(error: f64) -> String {
    match error {
        0.0..1e-6 => "0".to_owned(),
        1e-6..0.001 => format!("{error:.0e}"),
        0.001..0.1 => format!("{error:.3}"),
        0.1..10.0 => format!("{error:.2}"),
        _ => format!("{error:.0}"),
    }
}

/// The unit square of so many cells a side, and the number of the vertex in the middle.
fn square(cells: usize) -> (TriMesh, u32) {
    let mesh = sheet(cells, cells, |x, y| [x as f64 / cells as f64, y as f64 / cells as f64, 0.0]);
    (mesh, middle(cells))
}

fn middle(cells: usize) -> u32 {
    (cells / 2 * (cells + 2)) as u32
}

#[test]
fn flat() {
    let (square_64, in_64) = square(64);
    let (square_128, in_128) = square(128);
    Case::straight("square 65², from the middle", square_64.clone(), in_64).check(0.3, 1e-6);
    Case::straight("square 129², from the middle", square_128, in_128).check(0.3, 1e-6);
    Case::straight("square 65², from a corner", square_64, 0).check(0.7, 1e-6);
    Case::straight("square 65², jittered", jittered(64), middle(64)).check(0.2, 1e-6);
    for shear in [4.0, 16.0] {
        let sheared = sheet(64, 64, |x, y| [x as f64 + shear * y as f64, y as f64, 0.0]);
        let name = format!("square 65², sheared by {shear}");
        Case::straight(&name, sheared, middle(64)).check(0.5, 1e-6);
    }
    for length in [500, 1500] {
        let strip = sheet(length, 5, |x, y| [x as f64, y as f64, 0.0]);
        let name = format!("strip of {length} x 5 edges, from one end");
        Case::straight(&name, strip, 2 * (length as u32 + 1)).check(0.6, 1e-6);
    }
}

#[test]
fn curved() {
    for (level, heat, eikonal) in [(3, 0.1, 0.1), (4, 0.07, 0.03), (5, 0.05, 0.01), (6, 0.06, 0.01)]
    {
        let sphere = icosphere(level);
        let start = sphere.points()[0];
        let exact = |point| 2.0 * (0.5 * apart(point, start)).asin();
        Case::uniform(&format!("icosphere {level}"), sphere, 0, exact).check(heat, eikonal);
    }
    // The last column of the sheet is the first one again.
    let angle = |x: usize| TAU * x as f64 / 64.0;
    let open = sheet(64, 32, |x, y| [angle(x).cos(), angle(x).sin(), 3.0 * y as f64 / 32.0]);
    let closed = open.faces().iter().map(|face| face.map(|v| v / 65 * 64 + v % 65 % 64));
    let points = open.points().chunks(65).flat_map(|row| row[..64].to_vec()).collect();
    let cylinder = TriMesh::new(points, closed.collect()).unwrap();
    let start = 16 * 64;
    let unrolled = |point: [f64; 3]| {
        let around = point[1].atan2(point[0]).abs();
        around.hypot(point[2] - 1.5)
    };
    Case::uniform("cylinder 64 x 33, from one side", cylinder, start, unrolled).check(1.0, 0.05);
    let torus = torus(2.0, 1.0, 128, 64);
    let ring = (0..128).map(|i| point_source(&torus, i, 0)).collect();
    let sources = Sources::with_offsets(&torus, ring).unwrap();
    let around = |point: [f64; 3]| point[2].atan2(point[0].hypot(point[1]) - 2.0).abs();
    let medium = Medium::uniform(torus).unwrap();
    Case::new("torus 128 x 64, from its outer ring", medium, sources, around).check(0.1, 0.1);
}

fn point_source(mesh: &TriMesh, vertex: u32, label: u32) -> Source {
    Source { point: mesh.at_vertex("source", 0, vertex).unwrap(), offset: 0.0, label }
}

#[test]
fn several_sources() {
    let mesh = jittered(64);
    let is_border = mesh.adjacency().border_vertices();
    let border: Vec<u32> = (0..is_border.len() as u32).filter(|&v| is_border[v as usize]).collect();
    let inside = |p: [f64; 3]| p[0].min(p[1]).min(1.0 - p[0]).min(1.0 - p[1]);
    let each = Sources::at_vertices(&mesh, &border).unwrap();
    let medium = Medium::uniform(mesh.clone()).unwrap();
    let name = "square 65², jittered, each vertex of the border";
    Case::new(name, medium.clone(), each, inside).check(1.6, 0.2);
    let curve = border.iter().map(|&vertex| point_source(&mesh, vertex, 0)).collect();
    let curve = Sources::with_offsets(&mesh, curve).unwrap();
    let name = "square 65², jittered, the border as one curve";
    Case::new(name, medium.clone(), curve, inside).check(4.0, 0.2);
    let places = [100_u32, 700, 1500, 2222, 2700, 3131, 3900, 4100];
    let starts = places.map(|vertex| mesh.points()[vertex as usize]);
    let nearest = |p: [f64; 3]| starts.iter().map(|&s| apart(p, s)).fold(f64::INFINITY, f64::min);
    let sources = Sources::at_vertices(&mesh, &places).unwrap();
    Case::new("square 65², jittered, 8 sources", medium, sources, nearest).check(0.5, 0.2);
}

#[test]
fn weighted() {
    let (mesh, vertex) = square(128);
    let speed = |p: [f64; 3]| 0.5 + p[1];
    let start = mesh.points()[vertex as usize];
    let hyperbolic =
        |p: [f64; 3]| (1.0 + apart(p, start).powi(2) / (2.0 * speed(p) * speed(start))).acosh();
    let speed_sq: Vec<f64> = mesh.points().iter().map(|&point| speed(point).powi(2)).collect();
    let sources = Sources::at_vertices(&mesh, &[vertex]).unwrap();
    let medium = Medium::given(mesh, &speed_sq).unwrap();
    Case::new("speed 1/2 + y, 129²", medium, sources, hyperbolic).check(0.5, 0.2);
    for (contrast, heat) in [(2.0, 20.0), (10.0, 100.0), (100.0, 1000.0)] {
        let (mesh, _) = square(128);
        let half_width = 4.0 / 128.0;
        let slowness: Vec<f64> = (0..mesh.faces().len())
            .map(|face| mesh.corners(face).iter().map(|corner| corner[1]).sum::<f64>() / 3.0)
            .map(|y| if (y - 0.5).abs() < half_width { 1.0 / contrast } else { 1.0 })
            .collect();
        let exact = |p: [f64; 3]| {
            let (x, y) = (p[0], (p[1] - 0.5).abs());
            if y <= half_width {
                return x.hypot(y) / contrast;
            }
            let by =
                |along: f64| along.hypot(half_width) / contrast + (x - along).hypot(y - half_width);
            (0..=4000).map(|i| by(x * f64::from(i) / 4000.0)).fold(f64::INFINITY, f64::min)
        };
        let sources = Sources::at_vertices(&mesh, &[64 * 129]).unwrap();
        let medium = Medium::given_slowness(mesh, &slowness).unwrap();
        let name = format!("fast band of contrast {contrast}, 129²");
        Case::new(&name, medium, sources, exact).check(heat, 0.1);
    }
}

#[test]
fn directed() {
    for ratio in [5.0, 30.0] {
        let (mesh, vertex) = square(64);
        let (sin, cos) = 0.5_f64.sin_cos();
        let along = Directed { direction: [cos, sin, 0.0], along: 1.0, across: ratio };
        let start = mesh.points()[vertex as usize];
        let sources = Sources::at_vertices(&mesh, &[vertex]).unwrap();
        let medium = Medium::directed(mesh.clone(), &vec![along; mesh.faces().len()]).unwrap();
        let exact = |p: [f64; 3]| {
            let [x, y] = [p[0] - start[0], p[1] - start[1]];
            (x * cos + y * sin).hypot(ratio * (y * cos - x * sin))
        };
        let name = format!("metric of ratio {ratio}, 65²");
        Case::new(&name, medium, sources, exact).check(1.1, 1e-3);
    }
}
