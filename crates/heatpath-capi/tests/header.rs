//! The committed header is the one that this crate generates.
//!
//! After a change of the interface run `HEATPATH_BLESS=1 cargo test -p heatpath-capi --test header`
//! and read what has changed in `include/heatpath.h`.

use cbindgen::{Builder, Config, DocumentationLength, DocumentationStyle, Language};
use std::path::{Path, PathBuf};

const MODULES: [&str; 15] = [
    "version",
    "status",
    "buffer",
    "options",
    "distance",
    "paths",
    "solver",
    "mesh/array",
    "mesh/options",
    "mesh/report",
    "mesh/points",
    "mesh/handle",
    "mesh/solver",
    "mesh/paths",
    "mesh/curvature",
];

const TITLE: &str = "\
/* heatpath: geodesic distances and paths on images, volumes and triangle meshes by letting heat flow
 * through them.
 *
 * C99 and C++; link with libheatpath. Generated from crates/heatpath-capi, do not edit.
 *
 * Every function that can fail returns an hp_status, and hp_last_error_message() says what was
 * wrong. All memory stays the caller's, except for hp_paths, hp_solver, hp_mesh and
 * hp_mesh_solver. Nothing is printed, and no state of
 * the process is changed; threads are started anew for a call and end before it returns.
 * All functions may be called from any thread.
 *
 * Structs begin with their size. Fill them with the _init function, or set struct_size where there
 * is none: a program then works with later versions of the library, whose structs may be longer.
 */";

fn config() -> Config {
    let [major, minor, patch] =
        ["MAJOR", "MINOR", "PATCH"].map(|part| format!("HP_VERSION_{part}"));
    let mut config = Config {
        language: Language::C,
        cpp_compat: true,
        header: Some(TITLE.to_owned()),
        include_guard: Some("HEATPATH_H".to_owned()),
        no_includes: true,
        sys_includes: vec!["stdint.h".to_owned()],
        documentation_length: DocumentationLength::Full,
        documentation_style: DocumentationStyle::Doxy,
        line_length: 100,
        after_includes: Some(format!(
            "\n/* The version of heatpath that this header belongs to. */\n\
             #define {major} {}\n#define {minor} {}\n#define {patch} {}\n\
             #define HP_VERSION_STRING \"{}\"",
            env!("CARGO_PKG_VERSION_MAJOR"),
            env!("CARGO_PKG_VERSION_MINOR"),
            env!("CARGO_PKG_VERSION_PATCH"),
            env!("CARGO_PKG_VERSION"),
        )),
        ..Config::default()
    };
    // Opaque types: only pointers to them are used.
    let opaque = ["hp_paths", "hp_solver", "hp_mesh", "hp_mesh_solver"];
    config.export.include.extend(opaque.map(str::to_owned));
    config
}

fn generated() -> String {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let builder = MODULES.iter().fold(Builder::new().with_config(config()), |builder, module| {
        builder.with_src(sources.join(format!("{module}.rs")))
    });
    let mut header = Vec::new();
    builder.generate().expect("the sources can be parsed").write(&mut header);
    tidied(&String::from_utf8(header).expect("the sources are UTF-8"))
}

/// Turns what is Rust's about comments into C's: `# Safety` headings, back quotes, and three lines
/// for a comment that would fit on one.
fn tidied(header: &str) -> String {
    let header = header.replace("* # Safety\n", "* The caller promises:\n").replace('`', "");
    let mut lines: Vec<String> = Vec::new();
    for line in header.lines() {
        let opened = lines.len() >= 2 && lines[lines.len() - 2].trim() == "/**";
        if line.trim() == "*/" && opened {
            let text = lines.pop().unwrap_or_default();
            if let Some(opening) = lines.last_mut() {
                opening.push_str(&text.trim_start()[1..]);
                opening.push_str(" */");
            }
        } else {
            lines.push(line.to_owned());
        }
    }
    lines.join("\n") + "\n"
}

#[test]
fn the_committed_header_is_up_to_date() {
    let path: PathBuf =
        [env!("CARGO_MANIFEST_DIR"), "..", "..", "include", "heatpath.h"].iter().collect();
    let generated = generated();
    if std::env::var_os("HEATPATH_BLESS").is_some() {
        std::fs::write(&path, &generated).expect("the header can be written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    let lines = committed.lines().zip(generated.lines()).enumerate();
    let different = lines.filter(|(_, (old, new))| old != new).map(|(number, _)| number + 1);
    assert!(
        committed == generated,
        "include/heatpath.h is stale from line {:?} on: run with HEATPATH_BLESS=1",
        different.min()
    );
}
