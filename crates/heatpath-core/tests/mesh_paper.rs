//! Section 2.3 of the paper: eqs. (15), (16) and (3) on meshes, and its experiment on the block.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::mesh::distance::{
    DistanceMap, HeatMethodOptions, NO_LABEL, Of, Scale, VaradhanOptions, varadhan,
};
use heatpath_core::mesh::heat::{Explicit, Heat, HeatOptions, Step, Weights};
use heatpath_core::mesh::path::{Descent, Ending, Path};
use heatpath_core::mesh::shapes::{BLOCK_DIVISION, Block, block, icosphere, sheet};
use heatpath_core::mesh::{
    Curvature, CurvatureMediumOptions, CurvatureOptions, Geodesics, GeodesicsOptions, Medium,
    Method, Source, Sources, SurfacePoint, TriMesh,
};
use proptest::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;

fn between(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

fn squares(size: usize) -> TriMesh {
    sheet(size, size, |column, row| [column as f64, row as f64, 0.0])
}

/// A strip of equilateral triangles.
fn strip(columns: usize) -> TriMesh {
    sheet(columns, 1, |x, y| [x as f64 - 0.5 * y as f64, 0.75_f64.sqrt() * y as f64, 0.0])
}

fn steps(iterations: usize) -> HeatOptions {
    HeatOptions { iterations: Some(iterations), ..Default::default() }
}

fn flow(medium: &Medium, sources: &[u32], options: HeatOptions) -> Heat {
    let sources = Sources::at_vertices(medium.mesh(), sources).unwrap();
    Explicit::new(medium, options).unwrap().flow(&sources, &Exec::single_threaded()).unwrap()
}

fn uniform(mesh: &TriMesh, source: u32, options: HeatOptions) -> DistanceMap {
    let heat = flow(&Medium::uniform(mesh.clone()).unwrap(), &[source], options);
    assert_eq!((heat.missed(), heat.negative_weights()), (0, 0));
    varadhan(&heat, VaradhanOptions::default())
}

/// The mean error in percent.
fn error(map: &DistanceMap, exact: impl Fn(usize) -> f64) -> f64 {
    let errors = map.values().iter().enumerate().filter(|&(vertex, _)| exact(vertex) > 0.0);
    let errors: Vec<f64> = errors.map(|(v, found)| (found / exact(v) - 1.0).abs()).collect();
    100.0 * errors.iter().sum::<f64>() / errors.len() as f64
}

#[test]
fn errors_on_uniform_and_on_graded_meshes() {
    let (sheet_65, centre) = (squares(64), 32 * 65 + 32);
    let euclid = |mesh: &TriMesh, options| {
        let map = uniform(mesh, centre, options);
        error(&map, |v| between(mesh.points()[v], mesh.points()[centre as usize]))
    };
    println!("mean errors in %");
    for (iterations, low, high) in [(100, 4.0, 5.5), (400, 0.3, 0.7), (1600, 1.5, 2.5)] {
        let error = euclid(&sheet_65, steps(iterations));
        println!("sheet, {iterations} steps: {error:.2}");
        assert!(low < error && error < high);
    }
    let error_usual = euclid(&sheet_65, HeatOptions::default());
    println!("sheet, usual number of steps: {error_usual:.2}");
    assert!(error_usual < 0.8);
    for level in [4, 5] {
        let sphere = icosphere(level);
        let map = uniform(&sphere, 0, HeatOptions::default());
        let arc = |v: usize| 2.0 * (0.5 * between(sphere.points()[v], sphere.points()[0])).asin();
        let error = error(&map, arc);
        println!("sphere, level {level}: {error:.2}");
        assert!(error < 4.0);
    }
    // Edges are from 0.5 to 1.5 units long: nothing here knows that.
    let bend = |i: usize| {
        i as f64
            + 0.5 * 64.0 / std::f64::consts::TAU * (std::f64::consts::TAU * i as f64 / 64.0).sin()
    };
    let graded = sheet(64, 64, |column, row| [bend(column), bend(row), 0.0]);
    let error_graded = euclid(&graded, HeatOptions::default());
    println!("graded sheet: {error_graded:.2}");
    assert!(error_graded > 5.0, "better than the formula can be");
}

/// Eq. (16) as it stands, from the positions of the vertices, in logarithms.
fn oracle(mesh: &TriMesh, speed_sq: &[f64], source: usize, iterations: usize) -> Vec<f64> {
    let count = mesh.points().len();
    let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); count];
    for (face, vertices) in mesh.faces().iter().enumerate() {
        let corners = mesh.corners(face);
        for i in 0..3 {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            let [a, b, c] = [(j, k), (i, j), (i, k)].map(|(p, q)| between(corners[p], corners[q]));
            let angle = ((b * b + c * c - a * a) / (2.0 * b * c)).acos();
            let [j, k] = [j, k].map(|corner| vertices[corner] as usize);
            rows[j].push((k, 1.0 / angle.tan()));
            rows[k].push((j, 1.0 / angle.tan()));
        }
    }
    let mut ln_u = vec![f64::NEG_INFINITY; count];
    ln_u[source] = 0.0;
    for _ in 0..iterations {
        let old = ln_u.clone();
        for (vertex, row) in rows.iter().enumerate() {
            let sum: f64 = row.iter().map(|(_, weight)| weight).sum();
            let own = (1.0 - 0.2 * speed_sq[vertex]).ln() + old[vertex];
            let others =
                row.iter().map(|&(next, w)| (0.2 * w / sum * speed_sq[next]).ln() + old[next]);
            let terms: Vec<f64> =
                others.chain([own]).filter(|&ln| ln > f64::NEG_INFINITY).collect();
            let most = terms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            ln_u[vertex] = most + terms.iter().map(|ln| (ln - most).exp()).sum::<f64>().ln();
            if terms.is_empty() {
                ln_u[vertex] = f64::NEG_INFINITY;
            }
        }
    }
    ln_u
}

#[test]
fn every_step_is_equation_16_down_to_any_depth() {
    let mesh = strip(900);
    let vertices = mesh.points().len();
    let speed_sq: Vec<f64> =
        (0..vertices).map(|v| 0.01 + 0.99 * (0.37 * v as f64).sin().powi(2)).collect();
    let medium = Medium::given(mesh.clone(), &speed_sq).unwrap();
    for iterations in [3, 100, 1000] {
        let heat = flow(&medium, &[20], steps(iterations));
        let expected = oracle(&mesh, &speed_sq, 20, iterations);
        let mut lowest = 0.0_f64;
        for (vertex, (found, expected)) in heat.ln_density().iter().zip(&expected).enumerate() {
            assert_eq!(found.is_finite(), expected.is_finite(), "{vertex} after {iterations}");
            if found.is_finite() {
                assert!(
                    (found - expected).abs() < 1e-10 * (1.0 + expected.abs()),
                    "{found} {expected}"
                );
                lowest = lowest.min(*found);
            }
        }
        let missed = expected.iter().filter(|ln| !ln.is_finite()).count();
        assert_eq!(heat.missed(), missed);
        println!("{iterations} steps: down to exp({lowest:.0}), {missed} vertices not reached");
        assert!(iterations < 1000 || lowest < -3000.0);
    }
}

#[test]
fn the_unit_of_the_walk_is_half_an_edge() {
    let mesh = strip(200);
    let heat = flow(&Medium::uniform(mesh).unwrap(), &[100], HeatOptions::default());
    assert!((heat.kappa() - 0.25).abs() < 1e-12);
    let [length, walk] = [Scale::Length, Scale::Walk]
        .map(|scale| varadhan(&heat, VaradhanOptions { scale, ..Default::default() }));
    for (length, walk) in length.values().iter().zip(walk.values()) {
        assert!((2.0 * length - walk).abs() <= 1e-12 * walk);
    }
}

#[test]
fn balanced_sources_are_equally_warm_and_share_the_sheet() {
    let mesh = squares(60);
    let speed_sq: Vec<f64> =
        mesh.points().iter().map(|p| if p[0] < 30.0 { 1.0 } else { 0.25 }).collect();
    let exec = Exec::new(2).unwrap();
    let balanced = |medium: &Medium, vertices: &[u32]| {
        let sources = Sources::at_vertices(medium.mesh(), vertices).unwrap();
        Explicit::new(medium, steps(400)).unwrap().flow_balanced(&sources, &exec).unwrap()
    };
    let heat =
        balanced(&Medium::given(mesh.clone(), &speed_sq).unwrap(), &[30 * 61 + 10, 30 * 61 + 50]);
    let [a, b] = heat.ln_temperature_at_sources()[..] else { panic!("two sources") };
    assert!((a - b).abs() < 1e-3, "{a} and {b}");
    // In a uniform sheet, one source close to the border, which reflects its heat.
    let sources = [30 * 61 + 2, 25 * 61 + 40];
    let map = varadhan(
        &balanced(&Medium::uniform(mesh.clone()).unwrap(), &sources),
        VaradhanOptions::default(),
    );
    let wrong = (0..mesh.points().len()).filter(|&vertex| {
        let distances =
            sources.map(|source| between(mesh.points()[vertex], mesh.points()[source as usize]));
        let nearest = u32::from(distances[1] < distances[0]);
        (distances[0] - distances[1]).abs() > 2.0 && map.labels()[vertex] != nearest
    });
    assert_eq!(wrong.count(), 0);
}

#[test]
fn sources_inside_faces_and_components_out_of_reach() {
    let (left, right) = (squares(20), squares(5));
    let count = left.points().len() as u32;
    let far = right.points().iter().map(|&[x, y, z]| [x + 100.0, y, z]);
    let faces = right.faces().iter().map(|face| face.map(|vertex| vertex + count));
    let alone = [[500.0; 3]];
    let mesh = TriMesh::new(
        left.points().iter().copied().chain(far).chain(alone).collect(),
        left.faces().iter().copied().chain(faces).collect(),
    )
    .unwrap();
    let point = SurfacePoint { face: 420, weights: [0.5, 0.25, 0.25] };
    let sources = Sources::new(&mesh, &[point]).unwrap();
    let medium = Medium::uniform(mesh.clone()).unwrap();
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let heat = explicit.flow(&sources, &Exec::single_threaded()).unwrap();
    assert_eq!(heat.missed(), 0);
    let map = varadhan(&heat, VaradhanOptions::default());
    let centre = mesh.position(&point);
    for (vertex, (&value, &label)) in map.values().iter().zip(map.labels()).enumerate() {
        if vertex < count as usize {
            let exact = between(mesh.points()[vertex], centre);
            // At borders heat is reflected.
            assert!((value - exact).abs() < 0.12 * exact + 0.1 && label == 0, "{value} {exact}");
        } else {
            assert!(value == f64::INFINITY && label == NO_LABEL);
        }
    }
}

#[test]
fn threads_change_nothing_and_bad_options_are_named() {
    let medium = Medium::uniform(icosphere(4)).unwrap();
    let sources = Sources::at_vertices(medium.mesh(), &[0, 77]).unwrap();
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let one = explicit.flow_balanced(&sources, &Exec::single_threaded()).unwrap();
    let three = explicit.flow_balanced(&sources, &Exec::new(3).unwrap()).unwrap();
    assert_eq!(one.ln_density(), three.ln_density());
    let impatient = Exec::single_threaded().with_watch(|part| {
        if part > 0.3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(explicit.flow(&sources, &impatient).unwrap_err().to_string(), "cancelled");
    let text = |options| Explicit::new(&medium, options).unwrap_err().to_string();
    assert_eq!(
        text(HeatOptions { step: Step::Fixed(1.5), ..Default::default() }),
        "the time step is 1.5, but on this mesh and medium it is stable only up to 1.0000"
    );
    assert_eq!(text(steps(0)), "number of iterations is 0; it must be from 1 to 1e9");
    let mut source = sources.list()[0];
    source = Source { offset: 0.5, ..source };
    let offset = Sources::with_offsets(medium.mesh(), vec![source]).unwrap();
    assert_eq!(
        explicit.flow(&offset, &Exec::single_threaded()).unwrap_err().to_string(),
        "source offset is 0.5; it must be 0: heat has no offsets"
    );
}

#[test]
fn negative_weights_are_told_and_positive_ones_reach_everything() {
    let slanted = sheet(40, 40, |x, y| [x as f64 + 3.0 * y as f64, y as f64, 0.0]);
    let medium = Medium::uniform(slanted).unwrap();
    for weights in [Weights::Literal, Weights::Positive] {
        let heat = flow(&medium, &[800], HeatOptions { weights, ..Default::default() });
        println!("{weights:?}: {} missed, {} negative", heat.missed(), heat.negative_weights());
        assert!(heat.negative_weights() > 1000);
        assert!(weights == Weights::Literal || heat.missed() == 0);
        let map = varadhan(&heat, VaradhanOptions::default());
        let unreached = map.values().iter().filter(|&&value| value == f64::INFINITY).count();
        assert_eq!(unreached, heat.missed());
        assert!(map.values().iter().all(|value| *value >= 0.0));
    }
}

proptest! {
    /// Any faces at all: heat comes wherever edges with a weight lead, unless it becomes negative.
    #[test]
    fn any_mesh_has_distances(
        corners in prop::collection::vec((0..9_u32, 0..9_u32, 0..9_u32), 1..20),
        points in prop::collection::vec((0..4_i8, 0..4_i8, 0..3_i8), 9),
        positive: bool,
    ) {
        let faces: Vec<[u32; 3]> = corners.into_iter().map(|(a, b, c)| [a, b, c])
            .filter(|[a, b, c]| a != b && b != c && c != a).collect();
        prop_assume!(!faces.is_empty());
        let sources = [faces[0][0], faces[faces.len() - 1][1]];
        let points = points.iter().map(|&(x, y, z)| [x, y, z].map(f64::from)).collect();
        let Ok(medium) = Medium::uniform(TriMesh::new(points, faces).unwrap()) else {
            return Ok(());
        };
        let weights = if positive { Weights::Positive } else { Weights::Literal };
        let options = HeatOptions { weights, ..Default::default() };
        let explicit = Explicit::new(&medium, options).unwrap();
        let sources = Sources::at_vertices(medium.mesh(), &sources).unwrap();
        let heat = explicit.flow_balanced(&sources, &Exec::single_threaded()).unwrap();
        let map = varadhan(&heat, VaradhanOptions::default());
        for (value, label) in map.values().iter().zip(map.labels()) {
            prop_assert!(*value >= 0.0);
            prop_assert_eq!(*value == f64::INFINITY, *label == NO_LABEL);
        }
        prop_assert!(!positive || heat.missed() == 0);
    }
}

/// The block with its sources, ends and sharp edges.
struct Fig11 {
    mesh: Arc<TriMesh>,
    mean_edge: f64,
    /// The two ends of each sharp edge.
    sharp: Vec<[[f64; 3]; 2]>,
    on_edge: Vec<bool>,
    sources: [u32; 3],
    /// Ten on edges and ten anywhere.
    ends: [Vec<u32>; 2],
}

fn fig_11() -> Fig11 {
    let Block { mesh, sharp_edges } = block(BLOCK_DIVISION);
    let mut on_edge = vec![false; mesh.points().len()];
    sharp_edges.iter().flatten().for_each(|&vertex| on_edge[vertex as usize] = true);
    let edges: Vec<u32> = (0..on_edge.len() as u32).filter(|&v| on_edge[v as usize]).collect();
    let some = |i: usize, of: usize| (i * 7919 + 4711) % of;
    let on = (0..10).map(|i| edges[some(i, edges.len())]).collect();
    let anywhere = (0..10).map(|i| some(i, on_edge.len()) as u32).collect();
    let sources = [100, 400, 700].map(|i| edges[i]);
    let ends_of = |edge: &[u32; 2]| edge.map(|vertex| mesh.points()[vertex as usize]);
    let sharp = sharp_edges.iter().map(ends_of).collect();
    let lengths = mesh.edge_lengths();
    let mean_edge = lengths.iter().sum::<f64>() / lengths.len() as f64;
    Fig11 { mesh: mesh.into(), mean_edge, sharp, on_edge, sources, ends: [on, anywhere] }
}

/// The vertices from `end` down to a source, always to the neighbour with the steepest fall.
fn descent(mesh: &TriMesh, potential: &[f64], end: u32) -> Vec<u32> {
    let (points, adjacency) = (mesh.points(), mesh.adjacency());
    let mut path = vec![end];
    loop {
        let here = path[path.len() - 1];
        let fall = |next: u32| {
            let [a, b] = [here, next].map(|vertex| vertex as usize);
            (potential[a] - potential[b]) / between(points[a], points[b])
        };
        let edges = adjacency.vertex_edges().of(here as usize).iter();
        let next = edges.map(|&edge| adjacency.other_end(edge, here));
        let steepest = next.max_by(|&a, &b| fall(a).total_cmp(&fall(b))).unwrap();
        if fall(steepest) <= 0.0 {
            return path;
        }
        path.push(steepest);
    }
}

/// How many paths arrive, which part of their length is on edges, in percent, and how far from a source
/// at most they stop.
fn on_edges(figure: &Fig11, potential: &[f64], ends: &[u32]) -> (usize, f64, f64) {
    let (mut arrived, mut length, mut length_on, mut furthest) = (0, 0.0, 0.0, 0.0_f64);
    for &end in ends {
        let path = descent(&figure.mesh, potential, end);
        let apart = |a: u32, b: u32| {
            between(figure.mesh.points()[a as usize], figure.mesh.points()[b as usize])
        };
        let last = path[path.len() - 1];
        let nearest = figure
            .sources
            .map(|source| apart(source, last))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        arrived += usize::from(nearest == 0.0);
        furthest = furthest.max(nearest);
        for pair in path.windows(2) {
            let on_edge = pair.iter().all(|&vertex| figure.on_edge[vertex as usize]);
            length += apart(pair[0], pair[1]);
            length_on += if on_edge { apart(pair[0], pair[1]) } else { 0.0 };
        }
    }
    (arrived, 100.0 * length_on / length, furthest)
}

/// The medium of the curvature of balls with this radius, in mean edges.
fn block_medium(figure: &Fig11, radius: f64, floor: f64) -> Arc<Medium> {
    let options =
        CurvatureOptions { radius: Some(radius * figure.mean_edge), ..Default::default() };
    let curvature = Curvature::new(&figure.mesh, options, &Exec::new(2).unwrap()).unwrap();
    let options = CurvatureMediumOptions { floor, ..Default::default() };
    Medium::curvature(figure.mesh.clone(), &curvature, options).unwrap().into()
}

fn block_heat(figure: &Fig11, medium: &Medium) -> Heat {
    let sources = Sources::at_vertices(&figure.mesh, &figure.sources).unwrap();
    let explicit = Explicit::new(medium, HeatOptions::default()).unwrap();
    let heat = explicit.flow_balanced(&sources, &Exec::new(2).unwrap()).unwrap();
    assert_eq!((heat.missed(), heat.negative_weights()), (0, 0));
    heat
}

#[test]
fn figure_11_paths_run_along_the_edges_of_the_block() {
    let figure = fig_11();
    let on = |what: &str, ln: &[f64]| {
        let potential: Vec<f64> = ln.iter().map(|ln| -ln).collect();
        let found = figure.ends.each_ref().map(|ends| on_edges(&figure, &potential, ends));
        println!("{what}: {found:.2?}");
        found
    };
    println!(
        "from ends on edges and from any: (paths of 10 that arrive, % of their length on edges,"
    );
    println!("how far at most they stop from a source)");
    for (radius, least) in [(0.6, 98.0), (1.0, 75.0), (2.0, 45.0), (4.0, 30.0)] {
        let heat = block_heat(&figure, &block_medium(&figure, radius, 0.01));
        let exposure = on(&format!("radius {radius}, exposure"), heat.ln_exposure());
        assert!(exposure.iter().all(|found| found.0 == 10) && exposure[0].1 > least);
        if radius == 0.6 {
            on("P u", heat.ln_temperature());
            let [edges, any] = on("u", heat.ln_density());
            assert!(edges.0 + any.0 < 10, "u itself leads into minima beside the sources");
            let map = varadhan(&heat, VaradhanOptions { of: Of::Exposure, ..Default::default() });
            let of_map = figure.ends.each_ref().map(|ends| on_edges(&figure, map.values(), ends));
            assert!(of_map.iter().all(|found| found.0 == 10), "no other minima in the map either");
        }
    }
}

fn to_segment(point: [f64; 3], [a, b]: [[f64; 3]; 2]) -> f64 {
    let along: f64 = (0..3).map(|axis| (point[axis] - a[axis]) * (b[axis] - a[axis])).sum();
    let part = (along / between(a, b).powi(2)).clamp(0.0, 1.0);
    between(point, std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis])))
}

/// The part of the length of paths, in percent, that is at most `tolerance` from a sharp edge: of
/// all of it, and of what comes after the first point there.
fn near_edges(figure: &Fig11, paths: &[Path], tolerance: f64) -> [f64; 2] {
    const PARTS: usize = 8;
    let (mut near, mut all, mut after) = (0.0, 0.0, 0.0);
    for path in paths {
        let mut has_met = false;
        for ([a, b], i) in path
            .positions
            .windows(2)
            .flat_map(|pair| (0..PARTS).map(move |i| ([pair[0], pair[1]], i)))
        {
            let (part, length) = ((i as f64 + 0.5) / PARTS as f64, between(a, b) / PARTS as f64);
            let point = std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]));
            let is_near = figure.sharp.iter().any(|&edge| to_segment(point, edge) <= tolerance);
            has_met |= is_near;
            all += length;
            near += if is_near { length } else { 0.0 };
            after += if has_met { length } else { 0.0 };
        }
    }
    [100.0 * near / all, 100.0 * near / after]
}

/// Descends `values` from the ends on edges and from those anywhere. How much of the paths is on edges, within
/// a millionth of an edge of the mesh and within a twentieth.
fn across_faces(figure: &Fig11, medium: &Medium, values: &[f64]) -> [[[f64; 2]; 2]; 2] {
    let sources = Sources::at_vertices(&figure.mesh, &figure.sources).unwrap();
    let descent = Descent::new(medium, values, &sources).unwrap();
    figure.ends.each_ref().map(|ends| {
        let ends = ends.iter().map(|&end| figure.mesh.at_vertex("end", 0, end).unwrap());
        let paths: Vec<Path> = ends.map(|end| descent.path(end).unwrap()).collect();
        assert!(paths.iter().all(|path| matches!(path.ending, Ending::Source(_))));
        [1e-6, 0.05].map(|part| near_edges(figure, &paths, part * figure.mean_edge))
    })
}

/// What is not on edges cuts off the block's corners, by one edge of the mesh. From ends anywhere the first
/// part of a path crosses a plane.
#[test]
fn figure_11_paths_across_faces_keep_to_the_edges_of_the_block() {
    let (figure, exec) = (fig_11(), Exec::new(2).unwrap());
    println!("from ends on edges and from any, within 1e-6 and 0.05 of an edge's length:");
    println!("percent of the length of paths on edges, and of that after the first point there");
    for floor in [0.01, 0.001] {
        let medium = block_medium(&figure, 0.6, floor);
        let sources = Sources::at_vertices(&figure.mesh, &figure.sources).unwrap();
        let measured = |what: String, values: &[f64]| {
            let found = across_faces(&figure, &medium, values);
            println!("{floor}, {what}: {found:.2?}");
            found
        };
        let by = |method, time| {
            let heat = HeatMethodOptions { time, ..Default::default() };
            let options = GeodesicsOptions { method, heat, ..Default::default() };
            let geodesics = Geodesics::new(Arc::clone(&medium), options, &exec).unwrap();
            let map = geodesics.distance(&sources, &exec).unwrap();
            measured(format!("{method:?}, time {time:?}"), map.values())
        };
        let eikonal = by(Method::Eikonal, None);
        // It arrives, but one step of heat does not see ridges as narrow as these.
        for time in [4.0, 0.2, 0.05, 0.01] {
            by(Method::Heat, Some(time));
        }
        let explicit = block_heat(&figure, &medium);
        let map = varadhan(&explicit, VaradhanOptions { of: Of::Exposure, ..Default::default() });
        let explicit = measured("eqs. (16) and (3)".into(), map.values());
        for [on, anywhere] in [eikonal, explicit] {
            assert!(on[1][0] > 97.0 && anywhere[1][1] > 97.0);
            assert!(floor > 0.001 || (on[0][0] > 97.0 && anywhere[0][1] > 97.0));
        }
    }
}
