//! The binary interface is that of the release in `abi/`, or longer.

use crate::harness::{Host, has_program, workplace};
use heatpath_ffi_tests::repository;
use std::fs;
use std::path::Path;
use std::process::Command;

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_program("abidiff");
    vec![Host { name: "abi", package: "abigail-tools", present, run: abi }]
}

/// What `scripts/abi` finds in a header, and whether it accepts it.
fn found(header: &Path) -> (String, bool) {
    let output = Command::new(repository("scripts/abi")).arg(header).output().unwrap();
    (String::from_utf8_lossy(&output.stdout).into_owned(), output.status.success())
}

/// Changes of the header, and a word of the complaint about each; none for those that break nothing.
const CHANGES: [(&str, &str, &str); 7] = [
    ("} hp_options;", "double longer;} hp_options;", ""),
    ("uint32_t hp_abi_version(void);", "uint32_t hp_abi_version(void); int hp_more(void);", ""),
    ("uint32_t medium;", "uint32_t inserted, medium;", "gone: hp_options.medium at 4"),
    ("void hp_paths_free(struct hp_paths *paths);", "", "gone: hp_paths_free()"),
    ("#define HP_CANCELLED 6", "#define HP_CANCELLED 7", "gone: HP_CANCELLED = 6"),
    ("uint64_t source_count,", "int source_count,", "use_hp_distance"),
    ("hp_paths_count(const", "hp_paths_count(int more, const", "use_hp_paths_count"),
];

fn abi() {
    let header = repository("include/heatpath.h");
    let (complaint, fine) = found(&header);
    assert!(fine, "{complaint}scripts/abi --bless accepts it");
    let text = fs::read_to_string(header).unwrap();
    fs::create_dir_all(workplace("abi")).unwrap();
    let changed = workplace("abi/heatpath.h");
    for (old, new, complaint) in CHANGES {
        assert!(text.contains(old), "{old} is not in the header");
        fs::write(&changed, text.replacen(old, new, 1)).unwrap();
        let (found, fine) = found(&changed);
        assert_eq!(fine, complaint.is_empty(), "{new}: {found}");
        assert!(found.contains(complaint), "{new}: {found}");
    }
}
