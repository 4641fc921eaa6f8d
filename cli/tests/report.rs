//! The report of a batch, read as a browser reads it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use common::Bench;
use html5ever::tendril::TendrilSink;
use html5ever::{ParseOpts, parse_document};
use markup5ever_rcdom::{Handle, NodeData, RcDom};
use std::fs;

/// A page and all that is in it.
struct Page {
    dom: RcDom,
}

impl Page {
    /// Parses by the rules of HTML5, whose every complaint is an error.
    fn parse(text: &str) -> Self {
        let dom = parse_document(RcDom::default(), ParseOpts::default()).one(text);
        assert!(dom.errors.borrow().is_empty(), "{:?}", dom.errors.borrow());
        Self { dom }
    }

    /// All elements with this name.
    fn elements(&self, name: &str) -> Vec<Handle> {
        let mut found = Vec::new();
        collect(
            &self.dom.document,
            &|node| element_name(node).as_deref() == Some(name),
            &mut found,
        );
        found
    }

    /// The values of this attribute everywhere.
    fn attributes(&self, name: &str) -> Vec<String> {
        let mut all = Vec::new();
        collect(&self.dom.document, &|_| true, &mut all);
        all.iter().filter_map(|node| attribute(node, name)).collect()
    }
}

fn collect(node: &Handle, is_meant: &dyn Fn(&Handle) -> bool, found: &mut Vec<Handle>) {
    if is_meant(node) {
        found.push(node.clone());
    }
    node.children.borrow().iter().for_each(|child| collect(child, is_meant, found));
}

fn element_name(node: &Handle) -> Option<String> {
    match &node.data {
        NodeData::Element { name, .. } => Some(name.local.to_string()),
        _ => None,
    }
}

fn attribute(node: &Handle, name: &str) -> Option<String> {
    let NodeData::Element { attrs, .. } = &node.data else { return None };
    let attributes = attrs.borrow();
    let found = attributes.iter().find(|attribute| &*attribute.name.local == name)?;
    Some(found.value.to_string())
}

fn text(node: &Handle) -> String {
    let own = match &node.data {
        NodeData::Text { contents } => contents.borrow().to_string(),
        _ => String::new(),
    };
    own + &node.children.borrow().iter().map(text).collect::<String>()
}

const NASTY: &str = "<script>alert('&quot;') & \"more\".png";

/// A batch with a nasty name, pictures, a distance map, scores and a failure.
fn report() -> (Bench, Page) {
    let bench = Bench::with_picture();
    fs::copy(bench.path("curve.png"), bench.path(NASTY)).unwrap();
    let quoted = serde_json::to_string(NASTY).unwrap();
    fs::write(
        bench.path("m.toml"),
        format!(
            "[defaults]\nsource = '10,51'\n\
             [[row]]\ncommand = 'path'\ninput = {quoted}\nend = '90,54'\noverlay = 'o.png'\n\
             output = 'p.json'\ntruth = 'curve.png'\ntolerance = [2, 3]\n\
             [[row]]\ncommand = 'distance'\ninput = 'curve.png'\noutput = 'd.npy'\noverlay = 'do.png'\n\
             [[row]]\nname = '<b>none</b>'\ncommand = 'distance'\ninput = 'none.png'\noutput = 'n.npy'\n"
        ),
    )
    .unwrap();
    assert_eq!(bench.run("batch m.toml --report r.html").status.code(), Some(11));
    let page = Page::parse(&fs::read_to_string(bench.path("r.html")).unwrap());
    (bench, page)
}

#[test]
fn the_page_is_valid_and_stands_alone() {
    let (_bench, page) = report();
    assert_eq!(page.elements("script").len(), 0);
    assert_eq!(page.elements("link").len(), 0);
    assert_eq!(page.elements("title").iter().map(text).collect::<String>(), "m.toml");
    for link in page.attributes("href") {
        let target = link.strip_prefix('#').unwrap().to_owned();
        assert!(page.attributes("id").contains(&target), "{link}");
    }
    assert!(
        page.attributes("src").iter().all(|source| source.starts_with("data:image/jpeg;base64,"))
    );
    let style: String = page.elements("style").iter().map(text).collect();
    assert!(!style.contains("url(") && !style.contains("@import"));
    assert!(style.contains("prefers-color-scheme: dark") && style.contains("@media print"));
}

#[test]
fn every_row_is_there_with_its_pictures() {
    let (_bench, page) = report();
    let rows: Vec<String> = page.elements("section").iter().map(text).collect();
    assert_eq!(rows.len(), 3);
    assert!(rows[0].contains(NASTY) && rows[0].contains("p.json"), "{}", rows[0]);
    assert!(rows[1].contains("reached") && rows[1].contains("8000"), "{}", rows[1]);
    assert!(rows[2].contains("<b>none</b>") && rows[2].contains("none.png: cannot be read"));
    let pictures = page.elements("img");
    let names: Vec<String> = pictures.iter().filter_map(|image| attribute(image, "alt")).collect();
    assert_eq!(names, ["o.png", "d.npy", "do.png"]);
    for picture in pictures {
        let source = attribute(&picture, "src").unwrap();
        let (_, data) = source.split_once(',').unwrap();
        let decoded = image::load_from_memory(&BASE64_STANDARD.decode(data).unwrap()).unwrap();
        let size = ["width", "height"].map(|side| attribute(&picture, side).unwrap());
        assert_eq!(size, [decoded.width(), decoded.height()].map(|side| side.to_string()));
    }
}

#[test]
fn scores_stand_in_the_table() {
    let (bench, page) = report();
    let scores = bench.json("evaluate --extracted p.json --truth curve.png --tolerance 2 --json");
    let recall = format!("{:.3}", scores["recall"].as_f64().unwrap());
    let table = &page.elements("table")[0];
    let mut cells = Vec::new();
    collect(table, &|node| element_name(node).as_deref() == Some("td"), &mut cells);
    let cells: Vec<String> = cells.iter().map(text).collect();
    // The mean of one row, and the row; the other tolerance may have the same.
    assert!(cells.iter().filter(|cell| **cell == recall).count() >= 2, "{recall} in {cells:?}");
    assert!(text(table).contains("recall at 3"));
}

/// The same but for times.
#[test]
fn reports_are_reproducible() {
    let (bench, _) = report();
    let without_times = || {
        let text = fs::read_to_string(bench.path("r.html")).unwrap();
        let is_timed = |line: &&str| {
            ["<dt>time of this run", "<dt>written"].iter().any(|start| line.starts_with(start))
        };
        text.lines().filter(|line| !is_timed(line)).collect::<Vec<_>>().join("\n")
    };
    let first = without_times();
    assert_eq!(bench.run("batch m.toml --resume --report r.html").status.code(), Some(11));
    assert!(first == without_times());
}
