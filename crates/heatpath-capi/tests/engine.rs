//! What C callers get is what the engine computes, bit for bit.

#![expect(unsafe_code, reason = "calls the functions as C does")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath::{
    HP_EIKONAL, HP_F64, HP_FORM_DIVERGENCE, HP_MEDIUM_COMBINED, HP_MEDIUM_CONDUCTIVITY,
    HP_MEDIUM_EDGES, HP_MEDIUM_GIVEN, HP_MEDIUM_PERONA_MALIK, HP_MEDIUM_UNIFORM, HP_NORMALIZED,
    HP_OK, HP_U16, HP_VARADHAN, hp_buffer, hp_buffer_init, hp_distance, hp_options,
    hp_options_init, hp_path_info, hp_paths_create, hp_paths_free, hp_paths_info, hp_paths_points,
};
use heatpath_core::Exec;
use heatpath_core::grid::distance::{DistanceMap, Eikonal, EikonalOptions, normalized, varadhan};
use heatpath_core::grid::heat::{Duration, Explicit, Heat, HeatOptions, Step};
use heatpath_core::grid::medium::{self, EdgesOptions, Form, Medium};
use heatpath_core::grid::path::{Descent, Ending, PathOptions};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use std::mem::{size_of, zeroed};

const SIZE: [usize; 2] = [50, 40];
const CELLS: usize = SIZE[0] * SIZE[1];
const SPACING: [f64; 2] = [0.5, 0.75];
const SOURCES: [[f64; 2]; 2] = [[6.0, 7.25], [41.0, 30.0]];

fn shape() -> Shape<2> {
    Shape::with_spacing(SIZE, SPACING).unwrap()
}

fn level([x, y]: [usize; 2]) -> u16 {
    (30_000.0 + 25_000.0 * (0.2 * x as f64).sin() * (0.3 * y as f64).cos()) as u16
}

fn is_open([x, y]: [usize; 2]) -> bool {
    x != 25 || y > 30
}

fn grey() -> Grid<f64, 2> {
    Grid::from_fn(shape(), |index| f64::from(level(index)) / 65_535.0)
}

fn mask() -> Mask<2> {
    Mask::new(Grid::from_fn(shape(), is_open))
}

fn sources() -> Sources<2> {
    Sources::new(&SOURCES, &mask()).unwrap()
}

/// The engine's medium for the default parameters of a medium of the header.
fn engine_medium(number: u32) -> Medium<2> {
    let (grey, references) = (grey(), sources().values(&grey()));
    let medium = match number {
        HP_MEDIUM_UNIFORM => Ok(medium::uniform(shape())),
        HP_MEDIUM_CONDUCTIVITY => medium::conductivity(&grey, &references, Default::default()),
        HP_MEDIUM_PERONA_MALIK => medium::perona_malik(&grey, Default::default()),
        HP_MEDIUM_COMBINED => {
            medium::combined(&grey, &references, Default::default(), Default::default())
        }
        HP_MEDIUM_EDGES => {
            medium::edges(&grey, EdgesOptions { smoothing: 1.5, ..EdgesOptions::default() })
        }
        _ => medium::given(grey.map(|v| v * 65_535.0), Form::Pointwise),
    };
    medium.unwrap().with_walls(mask()).unwrap()
}

fn buffer<T>(pixels: &mut [T], pixel_type: u32) -> hp_buffer {
    // SAFETY: a struct of C, of which any bytes are a value; filled by its function.
    let mut buffer: hp_buffer = unsafe { zeroed() };
    // SAFETY: as above.
    let status = unsafe { hp_buffer_init(&raw mut buffer, size_of::<hp_buffer>() as u32) };
    assert_eq!(status, HP_OK);
    buffer.data = pixels.as_mut_ptr().cast();
    buffer.r#type = pixel_type;
    buffer.size = [SIZE[0] as u64, SIZE[1] as u64, 0];
    buffer.spacing[..2].copy_from_slice(&SPACING);
    buffer
}

fn options(medium: u32, estimator: u32) -> hp_options {
    // SAFETY: as in `buffer`.
    let mut options: hp_options = unsafe { zeroed() };
    // SAFETY: as above.
    let status = unsafe { hp_options_init(&raw mut options, size_of::<hp_options>() as u32) };
    assert_eq!(status, HP_OK);
    options.medium = medium;
    options.estimator = estimator;
    options.step = 0.0;
    options.iterations = 120;
    options.smoothing = if medium == HP_MEDIUM_EDGES { 1.5 } else { 0.0 };
    options
}

/// The image and the mask in the caller's memory.
fn pixels() -> (Vec<u16>, Vec<u16>) {
    let indices = || (0..CELLS).map(|position| shape().index(position));
    (indices().map(level).collect(), indices().map(|index| 7 * u16::from(is_open(index))).collect())
}

fn c_distance(options: &hp_options) -> Vec<f64> {
    let ((mut image, mut mask), mut result) = (pixels(), vec![-1.0; CELLS]);
    let (image, mask) = (buffer(&mut image, HP_U16), buffer(&mut mask, HP_U16));
    let target = buffer(&mut result, HP_F64);
    let points = SOURCES.as_flattened().as_ptr();
    // SAFETY: the buffers describe the vectors above.
    let status = unsafe { hp_distance(&image, &mask, points, 2, options, &target) };
    assert_eq!(status, HP_OK);
    result
}

fn engine_heat(medium: &Medium<2>, estimator: u32) -> Heat<2> {
    let heat =
        HeatOptions { duration: Duration::Iterations(120), step: Step::Auto, ..Default::default() };
    let explicit = Explicit::new(medium, heat).unwrap();
    let exec = Exec::single_threaded();
    if estimator == HP_NORMALIZED {
        explicit.flow_balanced(&sources(), &exec).unwrap()
    } else {
        explicit.flow(&sources(), &exec).unwrap()
    }
}

#[test]
fn distances_are_those_of_the_engine() {
    for number in HP_MEDIUM_UNIFORM..=HP_MEDIUM_GIVEN {
        let medium = engine_medium(number);
        let heat = engine_heat(&medium, HP_NORMALIZED);
        let expected = normalized(&heat).into_field().into_values();
        assert!(expected.iter().any(|distance| *distance > 0.0 && distance.is_finite()));
        assert!(c_distance(&options(number, HP_NORMALIZED)) == expected, "medium {number}");
        let heat = engine_heat(&medium, HP_VARADHAN);
        let expected = varadhan(&heat).into_field().into_values();
        assert!(c_distance(&options(number, HP_VARADHAN)) == expected, "medium {number}");
    }
}

#[test]
fn exact_distances_are_those_of_the_engine() {
    let exec = Exec::single_threaded();
    for number in HP_MEDIUM_UNIFORM..=HP_MEDIUM_GIVEN {
        let medium = engine_medium(number);
        let eikonal = Eikonal::new(&medium, &exec).unwrap();
        let expected = eikonal.distance(&sources(), &EikonalOptions::default(), &exec).unwrap();
        let expected = expected.into_field().into_values();
        assert!(c_distance(&options(number, HP_EIKONAL)) == expected, "medium {number}");
    }
}

#[test]
fn the_form_of_a_medium_can_be_chosen() {
    let field = grey().map(|v| v * 65_535.0);
    let medium = medium::given(field, Form::Divergence).unwrap().with_walls(mask()).unwrap();
    let expected = normalized(&engine_heat(&medium, HP_NORMALIZED)).into_field().into_values();
    let mut options = options(HP_MEDIUM_GIVEN, HP_NORMALIZED);
    options.form = HP_FORM_DIVERGENCE;
    assert!(c_distance(&options) == expected);
}

const ENDS: [[f64; 2]; 3] = [[20.0, 3.5], [45.0, 5.0], [2.0, 38.0]];

#[test]
fn paths_are_those_of_the_engine() {
    let medium = engine_medium(HP_MEDIUM_CONDUCTIVITY);
    let heat = engine_heat(&medium, HP_NORMALIZED);
    check_paths(HP_NORMALIZED, &Descent::new(&heat, &medium).unwrap(), &normalized(&heat));
}

#[test]
fn paths_of_exact_distances_are_those_of_the_engine() {
    let (medium, exec) = (engine_medium(HP_MEDIUM_CONDUCTIVITY), Exec::single_threaded());
    let eikonal = Eikonal::new(&medium, &exec).unwrap();
    let options = EikonalOptions { targets: ENDS.to_vec(), ..EikonalOptions::default() };
    let distances = eikonal.distance(&sources(), &options, &exec).unwrap();
    let descent = Descent::of_distances(&distances, &sources(), &medium);
    check_paths(HP_EIKONAL, &descent, &distances);
}

fn check_paths(estimator: u32, descent: &Descent<'_, 2>, distances: &DistanceMap<2>) {
    let (mut image, mut mask) = pixels();
    let (image, mask) = (buffer(&mut image, HP_U16), buffer(&mut mask, HP_U16));
    let options = options(HP_MEDIUM_CONDUCTIVITY, estimator);
    let (from, to) = (SOURCES.as_flattened().as_ptr(), ENDS.as_flattened().as_ptr());
    let mut paths = std::ptr::null_mut();
    // SAFETY: the buffers describe the vectors above, and the points are two and three.
    let status =
        unsafe { hp_paths_create(&image, &mask, from, 2, to, 3, &options, &raw mut paths) };
    assert_eq!(status, HP_OK);
    for (index, &end) in ENDS.iter().enumerate() {
        let expected = descent.path(end, distances, PathOptions::default()).unwrap();
        let Ending::Source(source) = expected.ending else { panic!("{:?}", expected.ending) };
        // SAFETY: as in `buffer`.
        let mut info: hp_path_info = unsafe { zeroed() };
        info.struct_size = size_of::<hp_path_info>() as u32;
        // SAFETY: the paths were made above.
        assert_eq!(unsafe { hp_paths_info(paths, index as u64, &raw mut info) }, HP_OK);
        assert_eq!((info.source, info.length), (source as i64, expected.length));
        let measured = (info.physical_length, info.distance);
        assert_eq!(measured, (expected.physical_length, expected.distance));
        let mut points = vec![[0.0; 2]; info.point_count as usize];
        let xy = points.as_flattened_mut().as_mut_ptr();
        // SAFETY: there is room for the points.
        let status = unsafe { hp_paths_points(paths, index as u64, xy, info.point_count) };
        assert_eq!((status, points), (HP_OK, expected.points));
    }
    // SAFETY: freed once.
    unsafe { hp_paths_free(paths) };
}
