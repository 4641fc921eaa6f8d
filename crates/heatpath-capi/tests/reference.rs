//! `docs/c-reference.md` says what the header says.
//!
//! After a change of the header run `HEATPATH_BLESS=1 cargo test -p heatpath-capi --test reference`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A declaration of the header with its comment.
struct Entry {
    comment: String,
    declaration: String,
}

impl Entry {
    fn is_type(&self) -> bool {
        self.declaration.starts_with("typedef")
    }

    /// The first name of the library's; of a call the one before its arguments.
    fn name(&self) -> String {
        let until = if self.is_type() { None } else { self.declaration.find('(') };
        let words = self.declaration[..until.unwrap_or(self.declaration.len())]
            .split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let mut names = words.filter(|word| word.to_lowercase().starts_with("hp_"));
        let name = if until.is_some() { names.next_back() } else { names.next() };
        name.unwrap_or_default().to_owned()
    }

    fn first_sentence(&self) -> String {
        let line = self.comment.replace('\n', " ");
        line.split_once(". ").map_or(line.clone(), |(first, _)| format!("{first}."))
    }
}

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// All that has a comment of its own, in the order of the header.
fn entries(header: &str) -> Vec<Entry> {
    let mut entries = Vec::new();
    let mut rest = header;
    while let Some(start) = rest.find("\n/**") {
        rest = &rest[start + 4..];
        let end = rest.find("*/").unwrap();
        let comment = rest[..end].lines().map(|line| line.trim().trim_start_matches('*').trim());
        let comment = comment.collect::<Vec<_>>().join("\n").trim().to_owned();
        rest = rest[end + 2..].trim_start_matches('\n');
        let declaration = declaration(rest).to_owned();
        entries.push(Entry { comment, declaration });
    }
    entries
}

/// A line of a macro, a struct with its members, or a call up to its semicolon.
fn declaration(text: &str) -> &str {
    let end = if text.starts_with("#define") {
        text.find('\n').unwrap()
    } else if text.lines().next().unwrap().ends_with('{') {
        text.find("\n}").unwrap() + text[text.find("\n}").unwrap()..].find(';').unwrap() + 1
    } else {
        text.find(';').unwrap() + 1
    };
    &text[..end]
}

fn reference(header: &str) -> String {
    let mut page = String::from(
        "# The C library, function by function\n\nThe text of `include/heatpath.h`, generated from it.\n\n",
    );
    let (macros, others): (Vec<_>, Vec<_>) =
        entries(header).into_iter().partition(|entry| entry.declaration.starts_with("#define"));
    let (types, calls): (Vec<_>, Vec<_>) = others.into_iter().partition(Entry::is_type);
    page += "## Functions\n\n| | |\n| --- | --- |\n";
    for entry in &calls {
        let name = entry.name();
        writeln!(page, "| [`{name}`](#{name}) | {} |", escaped(&entry.first_sentence())).unwrap();
    }
    page += "\n## Constants\n\n| | | |\n| --- | --- | --- |\n";
    for entry in &macros {
        let value = entry.declaration.split_whitespace().nth(2).unwrap_or_default();
        let text = escaped(&entry.comment.replace('\n', " "));
        writeln!(page, "| `{}` | {value} | {text} |", entry.name()).unwrap();
    }
    for (title, entries) in [("Types", types), ("Calls", calls)] {
        write!(page, "\n## {title}\n").unwrap();
        for entry in entries {
            let Entry { comment, declaration } = &entry;
            let name = entry.name();
            write!(page, "\n### {name}\n\n{}\n\n```c\n{declaration}\n```\n", escaped(comment))
                .unwrap();
        }
    }
    page
}

/// Without what Markdown would take for its own.
fn escaped(text: &str) -> String {
    text.replace('*', "\\*").replace('|', "\\|").replace('<', "&lt;").replace('_', "\\_")
}

#[test]
fn the_committed_reference_is_up_to_date() {
    let header = std::fs::read_to_string(repository("include/heatpath.h")).unwrap();
    let (path, generated) = (repository("docs/c-reference.md"), reference(&header));
    for name in heatpath::API {
        assert!(generated.contains(&format!("\n### {name}\n")), "{name} has no entry");
    }
    if std::env::var_os("HEATPATH_BLESS").is_some() {
        std::fs::write(&path, &generated).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == generated, "docs/c-reference.md is stale: run with HEATPATH_BLESS=1");
}
