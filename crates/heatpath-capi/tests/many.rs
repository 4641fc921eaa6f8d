//! What solvers tell C callers about many points is what the engine computes, bit for bit.

#![expect(unsafe_code, reason = "calls the functions as C does")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath::{
    HP_EIKONAL, HP_F32, HP_F64, HP_I32, HP_MEDIUM_CONDUCTIVITY, HP_NORMALIZED, HP_OK,
    HP_SOLVER_EXPLICIT, HP_SOLVER_IMPLICIT, HP_VARADHAN, hp_array, hp_array_init, hp_buffer,
    hp_buffer_init, hp_options, hp_options_init, hp_solver, hp_solver_bridge, hp_solver_create,
    hp_solver_free, hp_solver_matrix, hp_solver_nearest,
};
use heatpath_core::Exec;
use heatpath_core::grid::bridge::bridge;
use heatpath_core::grid::distance::{
    Eikonal, EikonalOptions, distance_matrix, normalized, varadhan,
};
use heatpath_core::grid::heat::{
    Explicit, Heat, HeatOptions, HeatSolver, Implicit, ImplicitOptions,
};
use heatpath_core::grid::labels::labels;
use heatpath_core::grid::medium::{Medium, conductivity};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use std::mem::zeroed;
use std::ptr::{null, null_mut};

const SIZE: [usize; 2] = [40, 30];
const CELLS: usize = SIZE[0] * SIZE[1];
const SOURCES: [[f64; 2]; 3] = [[6.0, 7.25], [31.0, 20.0], [20.5, 3.0]];
const ENDS: [[f64; 2]; 2] = [[12.0, 25.0], [35.25, 6.5]];
const REFERENCE: f64 = 0.6;

fn grey([x, y]: [usize; 2]) -> f64 {
    0.5 + 0.4 * (0.2 * x as f64).sin() * (0.3 * y as f64).cos()
}

/// A wall with a way around it.
fn is_open([x, y]: [usize; 2]) -> bool {
    x != 15 || y > 12
}

fn shape() -> Shape<2> {
    Shape::new(SIZE).unwrap()
}

fn mask() -> Mask<2> {
    Mask::new(Grid::from_fn(shape(), is_open))
}

fn engine_medium() -> Medium<2> {
    let medium = conductivity(&Grid::from_fn(shape(), grey), &[REFERENCE], Default::default());
    medium.unwrap().with_walls(mask()).unwrap()
}

fn sources(points: &[[f64; 2]]) -> Sources<2> {
    Sources::new(points, &mask()).unwrap()
}

fn buffer<T>(pixels: &mut [T], kind: u32) -> hp_buffer {
    // SAFETY: a struct of C, of which any bytes are a value; filled by its function.
    let mut buffer: hp_buffer = unsafe { zeroed() };
    // SAFETY: as above.
    let status = unsafe { hp_buffer_init(&raw mut buffer, size_of::<hp_buffer>() as u32) };
    assert_eq!(status, HP_OK);
    buffer.data = pixels.as_mut_ptr().cast();
    buffer.r#type = kind;
    buffer.size = [SIZE[0] as u64, SIZE[1] as u64, 0];
    buffer
}

/// The options of a solver and of its calls.
fn options(solver: u32, estimator: u32) -> hp_options {
    // SAFETY: as in `buffer`.
    let mut options: hp_options = unsafe { zeroed() };
    // SAFETY: as above.
    let status = unsafe { hp_options_init(&raw mut options, size_of::<hp_options>() as u32) };
    assert_eq!(status, HP_OK);
    let (medium, range_low, range_high) = (HP_MEDIUM_CONDUCTIVITY, 0.0, 1.0);
    hp_options {
        medium,
        estimator,
        solver,
        reference: REFERENCE,
        range_low,
        range_high,
        threads: 2,
        ..options
    }
}

/// A solver as C holds it.
struct Handle(*mut hp_solver);

impl Handle {
    fn new(options: &hp_options) -> Self {
        let cells = || (0..CELLS).map(|position| shape().index(position));
        let mut image: Vec<f64> = cells().map(grey).collect();
        let mut walls: Vec<u8> = cells().map(|index| u8::from(is_open(index))).collect();
        let (image, walls) = (buffer(&mut image, HP_F64), buffer(&mut walls, heatpath::HP_U8));
        let mut solver = null_mut();
        // SAFETY: the buffers describe the vectors above.
        let status = unsafe { hp_solver_create(&image, &walls, options, &raw mut solver) };
        assert_eq!(status, HP_OK);
        Self(solver)
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: freed once.
        unsafe { hp_solver_free(self.0) };
    }
}

/// What `hp_solver_nearest` says: distances, labels and, of heat, shares.
fn c_nearest(options: &hp_options) -> (Vec<f64>, Vec<i32>, Vec<f64>) {
    let handle = Handle::new(options);
    let (mut distance, mut labels) = (vec![-1.0; CELLS], vec![7; CELLS]);
    let mut shares = vec![-1.0; SOURCES.len() * CELLS];
    let [distances, first] = [buffer(&mut distance, HP_F64), buffer(&mut shares, HP_F64)];
    let numbers = buffer(&mut labels, HP_I32);
    let first: *const hp_buffer = if options.estimator == HP_EIKONAL { null() } else { &first };
    let points = SOURCES.as_flattened().as_ptr();
    // SAFETY: the buffers describe the vectors above, and the points are three.
    let status =
        unsafe { hp_solver_nearest(handle.0, points, 3, options, &distances, &numbers, first, 0) };
    assert_eq!(status, HP_OK);
    (distance, labels, shares)
}

fn numbers(nearest: &Grid<Option<usize>, 2>) -> Vec<i32> {
    nearest.values().iter().map(|label| label.map_or(-1, |label| label as i32)).collect()
}

/// A kind of heat of the engine and its number.
fn with_each_heat(check: impl Fn(u32, &dyn Fn(&Sources<2>, bool) -> Heat<2>, &[Heat<2>])) {
    let (medium, exec) = (engine_medium(), Exec::single_threaded());
    let each = sources(&SOURCES).each();
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let flow = |sources: &Sources<2>, balanced| {
        let explicit =
            Explicit::new(&medium, HeatOptions { exposure: true, ..HeatOptions::default() });
        explicit.unwrap().flow_from(sources, balanced, &exec).unwrap()
    };
    check(HP_SOLVER_EXPLICIT, &flow, &explicit.flow_each(&each, &exec).unwrap());
    let implicit = Implicit::new(&medium, ImplicitOptions::default(), &exec).unwrap();
    let flow =
        |sources: &Sources<2>, balanced| implicit.flow_from(sources, balanced, &exec).unwrap();
    check(HP_SOLVER_IMPLICIT, &flow, &implicit.flow_each(&each, &exec).unwrap());
}

#[test]
fn labels_of_heat_are_those_of_the_engine() {
    with_each_heat(|solver, flow, heats| {
        let expected = labels(heats).unwrap();
        for estimator in [HP_NORMALIZED, HP_VARADHAN] {
            let (distance, nearest, shares) = c_nearest(&options(solver, estimator));
            assert_eq!(nearest, numbers(&expected.nearest));
            for (share, expected) in shares.chunks(CELLS).zip(&expected.shares) {
                assert!(share == expected.values());
            }
            let map = match estimator {
                HP_NORMALIZED => normalized(&flow(&sources(&SOURCES), true)),
                _ => varadhan(&flow(&sources(&SOURCES), false)),
            };
            assert!(distance == map.field().values());
            let all_three = |label| nearest.contains(&label);
            assert!((0..3).all(all_three) && nearest.contains(&-1), "the wall has no label");
        }
    });
}

#[test]
fn exact_labels_are_those_of_the_engine() {
    let (medium, exec) = (engine_medium(), Exec::single_threaded());
    let eikonal = Eikonal::new(&medium, &exec).unwrap();
    let expected =
        eikonal.distance_and_nearest(&sources(&SOURCES), &EikonalOptions::default(), &exec);
    let (map, nearest) = expected.unwrap();
    let (distance, labels, _) = c_nearest(&options(HP_SOLVER_EXPLICIT, HP_EIKONAL));
    assert!(distance == map.field().values());
    assert_eq!(labels, numbers(&nearest));
}

fn array<T>(numbers: &mut [T], kind: u32, count: usize) -> hp_array {
    // SAFETY: as in `buffer`.
    let mut array: hp_array = unsafe { zeroed() };
    // SAFETY: as above.
    let status = unsafe { hp_array_init(&raw mut array, size_of::<hp_array>() as u32) };
    assert_eq!(status, HP_OK);
    hp_array { r#type: kind, data: numbers.as_mut_ptr().cast(), count: count as u64, ..array }
}

fn c_matrix(options: &hp_options) -> Vec<f64> {
    let handle = Handle::new(options);
    let mut matrix = vec![-1.0; SOURCES.len() * ENDS.len()];
    let row = array(&mut matrix, HP_F64, ENDS.len());
    let (from, to) = (SOURCES.as_flattened().as_ptr(), ENDS.as_flattened().as_ptr());
    // SAFETY: the list describes the vector above, and the points are three and two.
    let status = unsafe { hp_solver_matrix(handle.0, from, 3, to, 2, options, &row, 0) };
    assert_eq!(status, HP_OK);
    let mut floats = vec![[-1.0_f32; 3]; SOURCES.len()];
    let row = array(&mut floats, HP_F32, ENDS.len());
    let stride = size_of_val(&floats[0]) as i64;
    // SAFETY: as above, with a gap after each row.
    let status = unsafe { hp_solver_matrix(handle.0, from, 3, to, 2, options, &row, stride) };
    assert_eq!(status, HP_OK);
    for (row, float) in matrix.chunks(2).zip(&floats) {
        assert_eq!(float, &[row[0] as f32, row[1] as f32, -1.0]);
    }
    matrix
}

#[test]
fn matrices_are_those_of_the_engine() {
    let (medium, exec) = (engine_medium(), Exec::single_threaded());
    let (from, to) = (sources(&SOURCES), sources(&ENDS));
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let expected = distance_matrix(&explicit, &from, &to, &exec).unwrap();
    assert_eq!(c_matrix(&options(HP_SOLVER_EXPLICIT, HP_NORMALIZED)), expected.concat());
    let implicit = Implicit::new(&medium, ImplicitOptions::default(), &exec).unwrap();
    let expected = distance_matrix(&implicit, &from, &to, &exec).unwrap();
    assert_eq!(c_matrix(&options(HP_SOLVER_IMPLICIT, HP_NORMALIZED)), expected.concat());
    let eikonal = Eikonal::new(&medium, &exec).unwrap();
    let map = |from| eikonal.distance(&from, &EikonalOptions::default(), &exec).unwrap();
    let rows = from.each().into_iter().map(map).map(|map| ENDS.map(|end| map.at(end)));
    let expected: Vec<f64> = rows.flatten().collect();
    assert_eq!(c_matrix(&options(HP_SOLVER_EXPLICIT, HP_EIKONAL)), expected);
    assert!(expected.iter().all(|distance| distance.is_finite() && *distance > 1.0));
}

#[test]
fn bridges_are_those_of_the_engine() {
    with_each_heat(|solver, flow, _| {
        let [from, to] = [&SOURCES[..1], &ENDS[1..]];
        let expected = bridge(&flow(&sources(from), false), &flow(&sources(to), false)).unwrap();
        let options = options(solver, HP_NORMALIZED);
        let handle = Handle::new(&options);
        let mut density = vec![0.0; CELLS];
        let target = buffer(&mut density, HP_F64);
        let (from, to) = (from.as_flattened().as_ptr(), to.as_flattened().as_ptr());
        // SAFETY: the buffer describes the vector above, and there is a point at each end.
        let status = unsafe { hp_solver_bridge(handle.0, from, 1, to, 1, &options, &target) };
        assert_eq!(status, HP_OK);
        assert!(density == expected.values());
    });
}
