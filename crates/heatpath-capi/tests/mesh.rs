//! What C callers get on meshes is what the engine computes, bit for bit.

#![expect(unsafe_code, reason = "calls the functions as C does")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath::{
    HP_ENDED_SOURCE, HP_F64, HP_MESH_AUTO, HP_MESH_CREASE, HP_MESH_CURVATURE, HP_MESH_EIKONAL,
    HP_MESH_EXACT, HP_MESH_EXPLICIT, HP_MESH_HEAT, HP_MESH_SPEED_SQ, HP_MESH_UNIFORM, HP_OK,
    HP_U32, hp_array, hp_array_init, hp_mesh, hp_mesh_create, hp_mesh_curvature, hp_mesh_free,
    hp_mesh_options, hp_mesh_options_init, hp_mesh_paths_create, hp_mesh_solver,
    hp_mesh_solver_create, hp_mesh_solver_distances, hp_mesh_solver_free, hp_path_info, hp_paths,
    hp_paths_free, hp_paths_info, hp_paths_places, hp_paths_points, hp_surface_points,
    hp_surface_points_init,
};
use heatpath_core::Exec;
use heatpath_core::mesh::path::{Ending, shorten};
use heatpath_core::mesh::{
    Curvature, Geodesics, GeodesicsOptions, Medium, Method, Source, Sources, SurfacePoint, TriMesh,
    shapes,
};
use std::mem::zeroed;
use std::ptr::{null, null_mut};

/// A torus, closed and not convex.
fn torus() -> TriMesh {
    shapes::torus(2.0, 0.75, 40, 20)
}

fn speed_sq(mesh: &TriMesh) -> Vec<f64> {
    mesh.points().iter().map(|point| 1.5 + point[0].sin() * point[2].cos()).collect()
}

const SOURCES: [u32; 3] = [3, 401, 700];
const OFFSETS: [f64; 3] = [0.0, 0.25, 0.5];
const LABELS: [u32; 3] = [9, 4, 9];
const ENDS: [u32; 4] = [120, 255, 640, 799];

fn array<T>(numbers: &[T], kind: u32, count: usize) -> hp_array {
    // SAFETY: a struct of C, of which any bytes are a value; filled by its function.
    let mut array: hp_array = unsafe { zeroed() };
    // SAFETY: as above.
    let status = unsafe { hp_array_init(&raw mut array, size_of::<hp_array>() as u32) };
    assert_eq!(status, HP_OK);
    array.r#type = kind;
    array.data = numbers.as_ptr().cast_mut().cast();
    array.count = count as u64;
    array
}

/// A list for the library to write.
fn target<T>(numbers: &mut [T], kind: u32) -> hp_array {
    let mut list = array(numbers, kind, numbers.len());
    list.data = numbers.as_mut_ptr().cast();
    list
}

fn options() -> hp_mesh_options {
    // SAFETY: as in `array`.
    let mut options: hp_mesh_options = unsafe { zeroed() };
    let size = size_of::<hp_mesh_options>() as u32;
    // SAFETY: as above.
    assert_eq!(unsafe { hp_mesh_options_init(&raw mut options, size) }, HP_OK);
    options
}

fn places(vertices: &hp_array) -> hp_surface_points {
    // SAFETY: as in `array`.
    let mut places: hp_surface_points = unsafe { zeroed() };
    let size = size_of::<hp_surface_points>() as u32;
    // SAFETY: as above.
    assert_eq!(unsafe { hp_surface_points_init(&raw mut places, size) }, HP_OK);
    places.vertices = vertices;
    places
}

/// A mesh and its solver as C holds them.
struct Handles {
    mesh: *mut hp_mesh,
    solver: *mut hp_mesh_solver,
}

impl Handles {
    fn new(mesh: &TriMesh, options: &hp_mesh_options) -> Self {
        let points = array(mesh.points(), HP_F64, mesh.points().len());
        let faces = array(mesh.faces(), HP_U32, mesh.faces().len());
        let mut handles = Self { mesh: null_mut(), solver: null_mut() };
        // SAFETY: the lists describe the mesh.
        unsafe {
            let target = &raw mut handles.mesh;
            assert_eq!(hp_mesh_create(&points, &faces, null(), options, target), HP_OK);
            let target = &raw mut handles.solver;
            assert_eq!(hp_mesh_solver_create(handles.mesh, options, target), HP_OK);
        }
        handles
    }
}

impl Drop for Handles {
    fn drop(&mut self) {
        // SAFETY: freed once.
        unsafe {
            hp_mesh_free(self.mesh);
            hp_mesh_solver_free(self.solver);
        }
    }
}

fn engine(method: Method, medium: Medium) -> Geodesics {
    let options = GeodesicsOptions { method, ..GeodesicsOptions::default() };
    Geodesics::new(medium, options, &Exec::single_threaded()).unwrap()
}

fn engine_sources(mesh: &TriMesh) -> Sources {
    let source = |i: usize| Source {
        point: mesh.at_vertex("source", i, SOURCES[i]).unwrap(),
        offset: OFFSETS[i],
        label: LABELS[i],
    };
    Sources::with_offsets(mesh, (0..SOURCES.len()).map(source).collect()).unwrap()
}

fn check_distances(handles: &Handles, geodesics: &Geodesics) {
    let mesh = geodesics.medium().mesh();
    let map = geodesics.distance(&engine_sources(mesh), &Exec::single_threaded()).unwrap();
    let (mut values, mut labels) = (vec![0.0; map.values().len()], vec![7_u32; map.labels().len()]);
    let distances = array(&values, HP_F64, values.len());
    let names = array(&labels, HP_U32, labels.len());
    let numbers = array(&SOURCES, HP_U32, SOURCES.len());
    let [offsets, called] =
        [array(&OFFSETS, HP_F64, OFFSETS.len()), array(&LABELS, HP_U32, LABELS.len())];
    let sources = hp_surface_points { offsets: &offsets, labels: &called, ..places(&numbers) };
    // SAFETY: the lists describe the vectors above, which nothing else uses meanwhile.
    let status = unsafe {
        let solver = handles.solver;
        hp_mesh_solver_distances(solver, &sources, null(), &distances, 0, &names, 0)
    };
    assert_eq!(status, HP_OK);
    // Written behind the compiler's back.
    let (values, labels) = (std::hint::black_box(&mut values), std::hint::black_box(&mut labels));
    assert!(values == map.values());
    assert!(labels == map.labels());
}

#[test]
fn distances_are_those_of_the_engine() {
    let mesh = torus();
    for (number, method) in [
        (HP_MESH_AUTO, Method::Auto),
        (HP_MESH_HEAT, Method::Heat),
        (HP_MESH_EIKONAL, Method::Eikonal),
        (HP_MESH_EXACT, Method::Exact),
    ] {
        let handles = Handles::new(&mesh, &hp_mesh_options { method: number, ..options() });
        check_distances(&handles, &engine(method, Medium::uniform(mesh.clone()).unwrap()));
    }
}

#[test]
fn media_are_those_of_the_engine() {
    let (mesh, exec) = (torus(), Exec::single_threaded());
    let values = speed_sq(&mesh);
    let list = array(&values, HP_F64, values.len());
    let curvature = Curvature::new(&mesh, Default::default(), &exec).unwrap();
    let bends = Default::default();
    for (number, medium) in [
        (HP_MESH_UNIFORM, Medium::uniform(mesh.clone())),
        (HP_MESH_SPEED_SQ, Medium::given(mesh.clone(), &values)),
        (HP_MESH_CURVATURE, Medium::curvature(mesh.clone(), &curvature, bends)),
        (HP_MESH_CREASE, Medium::crease(mesh.clone(), &curvature, bends)),
    ] {
        let options = hp_mesh_options { medium: number, values: &list, ..options() };
        let handles = Handles::new(&mesh, &options);
        check_distances(&handles, &engine(Method::Auto, medium.unwrap()));
    }
}

#[test]
fn curvature_is_that_of_the_engine() {
    let mesh = torus();
    let expected = Curvature::new(&mesh, Default::default(), &Exec::single_threaded()).unwrap();
    let handles = Handles::new(&mesh, &options());
    let count = mesh.points().len();
    let (mut values, mut directions) = (vec![[0.0; 2]; count], vec![[[0.0; 3]; 2]; count]);
    let mut lists = [0, 1].map(|place| {
        let data = values.as_flattened_mut()[place..].as_mut_ptr().cast();
        let stride = size_of_val(&values[0]) as i64;
        hp_array { data, byte_stride: stride, ..array::<f64>(&[], HP_F64, count) }
    });
    let tangents = [0, 1].map(|place| {
        let data = directions.as_flattened_mut()[place..].as_mut_ptr().cast();
        let stride = size_of_val(&directions[0]) as i64;
        hp_array { data, byte_stride: stride, ..array::<f64>(&[], HP_F64, count) }
    });
    let [low, high] = &mut lists;
    // SAFETY: the lists describe the vectors above.
    let status =
        unsafe { hp_mesh_curvature(handles.mesh, null(), low, high, &tangents[0], &tangents[1]) };
    assert_eq!(status, HP_OK);
    for (vertex, principal) in expected.vertices().iter().enumerate() {
        assert_eq!(values[vertex], principal.values);
        assert_eq!(directions[vertex], principal.directions);
    }
}

/// A path as C sees it.
fn c_path(paths: *const hp_paths, index: u64) -> (hp_path_info, Vec<[f64; 3]>) {
    // SAFETY: as in `array`.
    let mut info: hp_path_info = unsafe { zeroed() };
    info.struct_size = size_of::<hp_path_info>() as u32;
    // SAFETY: the paths live, and there is room for the points.
    let points = unsafe {
        assert_eq!(hp_paths_info(paths, index, &raw mut info), HP_OK);
        let mut points = vec![[0.0; 3]; info.point_count as usize];
        let xyz = points.as_flattened_mut().as_mut_ptr();
        assert_eq!(hp_paths_points(paths, index, xyz, info.point_count), HP_OK);
        points
    };
    (info, points)
}

/// The points of a path on faces as C sees them.
fn c_places(paths: *const hp_paths, index: u64, count: usize) -> Vec<SurfacePoint> {
    let (mut faces, mut weights) = (vec![0_u32; count], vec![[0.0; 3]; count]);
    let (on, shares) = (target(&mut faces, HP_U32), target(&mut weights, HP_F64));
    // SAFETY: the lists describe the vectors above.
    assert_eq!(unsafe { hp_paths_places(paths, index, &on, &shares) }, HP_OK);
    faces.into_iter().zip(weights).map(|(face, weights)| SurfacePoint { face, weights }).collect()
}

#[test]
fn paths_are_those_of_the_engine() {
    let (mesh, exec) = (torus(), Exec::single_threaded());
    for (number, method) in [
        (HP_MESH_HEAT, Method::Heat),
        (HP_MESH_EXACT, Method::Exact),
        (HP_MESH_EXPLICIT, Method::Explicit),
    ] {
        let geodesics = engine(method, Medium::uniform(mesh.clone()).unwrap());
        let sources = Sources::at_vertices(&mesh, &SOURCES).unwrap();
        let ends = ENDS.map(|vertex| mesh.at_vertex("end", 0, vertex).unwrap());
        let (_, expected) = geodesics.paths(&sources, &ends, &exec).unwrap();
        for shortens in [0, 1] {
            let options = hp_mesh_options { method: number, shorten: shortens, ..options() };
            let handles = Handles::new(&mesh, &options);
            let numbers = array(&SOURCES, HP_U32, SOURCES.len());
            let targets = array(&ENDS, HP_U32, ENDS.len());
            let (from, to) = (places(&numbers), places(&targets));
            let mut paths = null_mut();
            // SAFETY: the lists describe the arrays above.
            let status = unsafe {
                hp_mesh_paths_create(handles.solver, &from, &to, &options, &raw mut paths)
            };
            assert_eq!(status, HP_OK);
            for (index, path) in expected.iter().enumerate() {
                let short = shorten(&mesh, path).unwrap();
                let path = if shortens == 0 { path } else { &short };
                let (info, points) = c_path(paths, index as u64);
                let Ending::Source(label) = path.ending else { panic!("{:?}", path.ending) };
                assert_eq!((info.ending, info.source), (HP_ENDED_SOURCE, i64::from(label)));
                assert_eq!((info.length, info.distance), (path.length, path.distance));
                assert_eq!(points, path.positions);
                assert_eq!(c_places(paths, index as u64, path.points.len()), path.points);
            }
            // SAFETY: freed once.
            unsafe { hp_paths_free(paths) };
        }
    }
}
