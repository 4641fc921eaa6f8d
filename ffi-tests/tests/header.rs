//! The header stands alone, in C99 and C++17, and says what the library has.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath::{
    hp_array, hp_buffer, hp_curves, hp_graph_branch, hp_graph_info, hp_graph_node,
    hp_key_point_options, hp_mesh_options, hp_mesh_report, hp_options, hp_path_info, hp_score,
    hp_surface_points, hp_vote_options,
};
use heatpath_ffi_tests::{Workshop, repository, run, shared_library, text};
use std::collections::BTreeSet;
use std::mem::offset_of;
use std::process::Command;

const ONLY_THE_HEADER: &str = "#include \"heatpath.h\"\nint main(void) { return HP_OK; }\n";

#[test]
fn the_header_compiles_on_its_own() {
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), "header");
    workshop.check("alone.c", ONLY_THE_HEADER);
    workshop.check("alone.cpp", ONLY_THE_HEADER);
    workshop.check("wrapper.cpp", &ONLY_THE_HEADER.replace("heatpath.h", "heatpath.hpp"));
    workshop.check("twice.c", &ONLY_THE_HEADER.replace("int", "#include \"heatpath.h\"\nint"));
}

#[test]
fn c_and_rust_agree_on_structs() {
    macro_rules! sizes {
        ($($name:ident: $($field:ident)*;)*) => {
            concat!($(stringify!($name), " {}\n", $(stringify!($name.$field), " {}\n",)*)*)
        };
    }
    macro_rules! numbers {
        ($($name:ident: $($field:ident)*;)*) => {
            [$(size_of::<$name>(), $(offset_of!($name, $field),)*)*]
        };
    }
    macro_rules! structs {
        ($with:ident) => {
            $with! {
                hp_buffer: data spacing;
                hp_options: smoothing estimator user solver reference memory farthest tensor tensor_count directions scales margin;
                hp_path_info: source distance cost;
                hp_array: data count byte_stride;
                hp_mesh_options: user weld medium values time farthest curvature bend floor reference iterations step;
                hp_mesh_report: vertices welded euler_characteristic;
                hp_surface_points: curve vertices weights labels sets;
                hp_vote_options: structure no_growth gap prune;
                hp_key_point_options: structure iterations;
                hp_graph_info: node_count physical_length stop;
                hp_graph_node: point radius parent;
                hp_graph_branch: from length mean_radius;
                hp_curves: dimension points spacing mask;
                hp_score: recall extracted_distance;
            }
        };
    }
    let workshop = Workshop::new(env!("CARGO_TARGET_TMPDIR"), "sizes");
    let output = run(&mut Command::new(workshop.build("sizes.c")));
    let numbers = structs!(numbers).into_iter();
    let expected = numbers
        .zip(structs!(sizes).lines())
        .map(|(number, line)| line.replace(" . ", ".").replace("{}", &number.to_string()) + "\n");
    assert_eq!(text(&output), expected.collect::<String>());
}

/// The functions that the header declares.
fn declared() -> BTreeSet<String> {
    let header = std::fs::read_to_string(repository("include/heatpath.h")).unwrap();
    let code = header.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_alphabetic()));
    let names = code.filter(|line| !line.starts_with("typedef")).filter_map(|line| {
        let before = line.split_once('(')?.0;
        let start = before.rfind(|c: char| !(c.is_alphanumeric() || c == '_'))?;
        Some(before[start + 1..].to_owned())
    });
    names.collect()
}

#[test]
fn the_library_exports_what_the_header_declares_and_nothing_else() {
    let output = run(Command::new("nm").args(["-D", "--defined-only"]).arg(shared_library()));
    let lines = text(&output);
    let exported: BTreeSet<String> =
        lines.lines().filter_map(|line| Some(line.split(' ').next_back()?.to_owned())).collect();
    assert!(exported.iter().all(|name| name.starts_with("hp_")), "{exported:?}");
    assert_eq!(exported, declared());
    assert!(exported.len() > 10);
}

#[test]
fn the_table_has_all_functions() {
    let mut table = declared();
    assert!(table.remove("hp_get_api"), "it hands out the table");
    assert_eq!(heatpath::API.iter().map(|&name| name.to_owned()).collect::<BTreeSet<_>>(), table);
}

#[test]
fn the_library_has_a_name_and_stays_loaded() {
    let output = run(Command::new("readelf").args(["-d", "-W"]).arg(shared_library()));
    let text = text(&output);
    let name = format!("soname: [libheatpath.so.{}]", heatpath::HP_ABI_VERSION);
    assert!(text.contains(&name), "{text}");
    assert!(text.contains("NODELETE"), "{text}");
}
