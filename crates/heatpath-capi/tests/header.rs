//! The committed header is the one that this crate generates.
//!
//! After a change of the interface run `HEATPATH_BLESS=1 cargo test -p heatpath-capi --test header`
//! and read what has changed in `include/heatpath.h`.

use cbindgen::{Builder, Config, DocumentationLength, DocumentationStyle, Language};
use std::path::{Path, PathBuf};

const MODULES: [&str; 28] = [
    "version",
    "status",
    "buffer",
    "options",
    "distance",
    "medium",
    "scales",
    "paths",
    "solver",
    "nearest",
    "matrix",
    "bridge",
    "extraction/options",
    "extraction/graph",
    "extraction/votes",
    "extraction/key_points",
    "extraction/skeleton",
    "array",
    "evaluation",
    "mesh/options",
    "mesh/report",
    "mesh/points",
    "mesh/handle",
    "mesh/solver",
    "mesh/paths",
    "mesh/places",
    "mesh/curvature",
    "api",
];

const TITLE: &str = "\
/* heatpath: geodesic distances and paths on images, volumes and triangle meshes by letting heat flow
 * through them.
 *
 * C99 and C++; link with libheatpath. Generated from crates/heatpath-capi, do not edit.
 *
 * Every function that can fail returns an hp_status, and hp_last_error_message() says what was
 * wrong. All memory stays the caller's, except for what the functions that end in _create hand out.
 * Nothing is printed, and no state of the process is changed; threads are started anew for a call and
 * end before it returns. All functions may be called from any thread.
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
    let opaque = ["hp_paths", "hp_solver", "hp_graph", "hp_mesh", "hp_mesh_solver", "hp_api"];
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
    with_api(&tidied(&String::from_utf8(header).expect("the sources are UTF-8")))
}

/// The header with the members of `hp_api`: a pointer to each function, in the order of the table.
fn with_api(header: &str) -> String {
    let members = heatpath::API.map(|name| pointer(header, name)).join("");
    let table = format!(
        "struct hp_api {{\n  /** The size of the table, in bytes. */\n  uint32_t struct_size;\n  \
         /** The HP_ABI_VERSION of the library. */\n  uint32_t abi;\n{members}}};\n"
    );
    let end = "#ifdef __cplusplus\n}  // extern";
    assert_eq!(header.matches(end).count(), 1);
    header.replace(end, &format!("{table}\n{end}"))
}

/// The declaration of a function as that of a pointer to it, without the `hp_` of its name.
fn pointer(header: &str, name: &str) -> String {
    let call = format!("{name}(");
    let is_declaration =
        |line: &&str| line.contains(&call) && line.starts_with(|c: char| c.is_ascii_alphabetic());
    let line = header.lines().find(is_declaration);
    let line = line.unwrap_or_else(|| panic!("{name} is in the table but not in the header"));
    let start = header.find(line).expect("a line of the header");
    let length = header[start..].find(';').expect("a declaration ends");
    let declaration = header[start..start + length].replace('\n', " ");
    let short = name.trim_start_matches("hp_");
    let declaration = declaration.replace(&call, &format!("(*{short})("));
    wrapped(&declaration.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// A member on as many lines as it needs, broken between arguments.
fn wrapped(member: &str) -> String {
    let (mut lines, mut line) = (String::new(), String::new());
    for argument in format!("  {member};\n").split_inclusive(", ") {
        if line.len() + argument.trim_end().len() > 100 {
            lines.push_str(&format!("{}\n", line.trim_end()));
            line = " ".repeat(6);
        }
        line.push_str(argument);
    }
    lines + &line
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
