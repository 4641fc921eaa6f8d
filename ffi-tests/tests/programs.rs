//! The programs in `c/` do what they say, also under valgrind.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::grid::distance::normalized;
use heatpath_core::grid::heat::{Explicit, HeatOptions};
use heatpath_core::grid::medium::{ConductivityOptions, conductivity};
use heatpath_core::grid::{Grid, Shape, Sources};
use heatpath_ffi_tests::{Workshop, repository, run, text, valgrind};
use std::path::Path;
use std::process::Command;

const SIZE: [usize; 2] = [40, 30];
const SOURCE: [f64; 2] = [5.0, 6.5];

fn level(x: usize, y: usize) -> u8 {
    (120.0 + 100.0 * (0.3 * x as f64).sin() * (0.2 * y as f64).cos()) as u8
}

/// Writes a picture for `distance.c`.
fn write_pgm(path: &Path) {
    let mut bytes = format!("P5\n{} {}\n255\n", SIZE[0], SIZE[1]).into_bytes();
    bytes.extend((0..SIZE[0] * SIZE[1]).map(|i| level(i % SIZE[0], i / SIZE[0])));
    std::fs::write(path, bytes).unwrap();
}

/// What the engine says about that picture.
fn expected() -> Vec<f64> {
    let shape = Shape::new(SIZE).unwrap();
    let grey = Grid::from_fn(shape, |[x, y]| f64::from(level(x, y)) / 255.0);
    let sources = Sources::new(&[SOURCE], &heatpath_core::grid::Mask::all_open(shape)).unwrap();
    let medium = conductivity(&grey, &sources.values(&grey), ConductivityOptions::default());
    let medium = medium.unwrap();
    let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let heat = explicit.flow_balanced(&sources, &Exec::single_threaded()).unwrap();
    normalized(&heat).into_field().into_values()
}

#[test]
fn the_example_gives_the_distances_of_the_engine_and_a_path() {
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), "distance");
    let program = workshop.build("distance.c");
    let (picture, raw) = (workshop.path("picture.pgm"), workshop.path("distances"));
    write_pgm(&picture);
    for mut command in [Command::new(&program), valgrind(&program)] {
        command.arg(&picture).args(["5", "6.5"]).arg(&raw).args(["35", "25"]);
        let path = text(&run(&mut command));
        assert!(path.starts_with("35.000 25.000\n"), "{path}");
        assert!(path.ends_with("\n5.000 6.500\n"), "{path}");
        let bytes = std::fs::read(&raw).unwrap();
        let distances: Vec<f64> =
            bytes.as_chunks().0.iter().map(|&bytes| f64::from_ne_bytes(bytes)).collect();
        assert!(distances == expected(), "the distances differ");
    }
}

#[test]
fn the_example_explains_what_is_wrong() {
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), "explains");
    let program = workshop.build("distance.c");
    let picture = workshop.path("picture.pgm");
    write_pgm(&picture);
    let mut command = Command::new(program);
    let output = command.arg(&picture).args(["99", "0"]).arg(workshop.path("none")).output();
    let output = output.unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        text(&output),
        "distance: HP_INVALID_POINT: source 0 at [99.0, 0.0] lies outside the grid of [40, 30] \
         cells; pixel coordinates run from -0.5 to the size minus 0.5\n"
    );
}

/// A program that checks itself; it is silent, as the library must be.
fn checks_itself(source: &str) {
    let name = source.replace('.', "_");
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), &name);
    let program = workshop.build(source);
    for mut command in [Command::new(&program), valgrind(&program)] {
        assert_eq!(text(&run(&mut command)), "");
    }
    let mut sanitized = Command::new(workshop.build_sanitized(source));
    // Too much memory is an answer, of which it warns on standard error.
    let output = run(sanitized.env("ASAN_OPTIONS", "allocator_may_return_null=1"));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "");
}

#[test]
fn wrong_calls_fail_in_words() {
    checks_itself("misuse.c");
}

#[test]
fn wrong_values_fail_in_words() {
    checks_itself("misuse_values.c");
}

#[test]
fn wrong_volumes_fail_in_words() {
    checks_itself("misuse_volumes.c");
}

#[test]
fn a_prepared_solver_gives_the_same_maps() {
    checks_itself("solver.c");
}

#[test]
fn labels_matrices_and_bridges() {
    checks_itself("many.c");
}

#[test]
fn progress_is_one_run_from_0_to_1() {
    checks_itself("progress.c");
}

#[test]
fn every_call_that_reports_progress_is_watched() {
    let read = |path: &str| std::fs::read_to_string(repository(path)).unwrap();
    let (header, program) = (read("include/heatpath.h"), read("ffi-tests/c/progress.c"));
    let calls: Vec<&str> = header
        .split("hp_status ")
        .filter_map(|call| call.split(';').next()?.split_once('('))
        .filter(|(name, arguments)| {
            name.starts_with("hp_")
                && arguments.contains("_options *options")
                && !name.ends_with("_init")
        })
        .map(|(name, _)| name)
        .collect();
    assert!(calls.len() > 15, "{calls:?}");
    for call in calls {
        assert!(program.contains(&format!("RUN({call}(")), "{call}");
    }
}

#[test]
fn places_and_loops_on_meshes() {
    checks_itself("mesh_places.c");
}

#[test]
fn exact_distances_and_tensors() {
    checks_itself("eikonal.c");
}

#[test]
fn layouts_of_memory_change_no_bit() {
    checks_itself("layouts.c");
}

#[test]
fn threads_do_not_disturb_each_other() {
    checks_itself("threads.cpp");
}

#[test]
fn meshes_against_closed_forms() {
    checks_itself("mesh.c");
}

#[test]
fn layouts_of_meshes_change_no_bit() {
    checks_itself("mesh_layouts.c");
}

#[test]
fn wrong_meshes_fail_in_words() {
    checks_itself("mesh_misuse.c");
}

#[test]
fn threads_share_meshes() {
    checks_itself("mesh_threads.cpp");
}

#[test]
fn random_meshes_give_numbers_or_words() {
    checks_itself("mesh_any.c");
}

#[test]
fn media_are_as_the_header_says() {
    checks_itself("media.c");
}

#[test]
fn curves_are_found_without_ends() {
    checks_itself("extraction.c");
}

#[test]
fn the_wrapper_for_cplusplus_frees_and_throws() {
    checks_itself("wrapper.cpp");
}

#[test]
fn structs_with_any_contents_get_a_status() {
    checks_itself("wild.c");
}
