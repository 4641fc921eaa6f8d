//! The report of a batch in Chromium, without a network.

use crate::harness::{Host, has_program, workplace};
use heatpath_ffi_tests::{repository, run};
use image::{GrayImage, ImageReader, Luma};
use serde_json::Value;
use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

pub(crate) fn hosts() -> Vec<Host> {
    let present = || has_program("chromium");
    vec![Host { name: "report", package: "chromium", present, run: report }]
}

/// A path with its picture, distances of a name that fills the screen, and a failure.
const MANIFEST: &str = "\
[[row]]
command = 'path'
input = 'curve.png'
source = '2,60'
end = '150,83'
output = 'path.json'
overlay = 'path.png'

[[row]]
command = 'distance'
input = 'curve.png'
source = '2,60'
name = 'LONG'
output = 'LONG.npy'

[[row]]
command = 'distance'
input = 'curve.png'
name = 'outside'
source = '900,60'
output = 'none.npy'
";

fn report() {
    let folder = workplace("report");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    write_report(&folder);
    fs::copy(repository("ffi-tests/hosts/report/look.html"), folder.join("look.html")).unwrap();
    let output = chromium(&folder, &["--dump-dom"], "look.html");
    let log = String::from_utf8_lossy(&output.stderr);
    assert!(!log.contains(":CONSOLE"), "errors of scripts, or files that were not found: {log}");
    let seen = seen(&String::from_utf8_lossy(&output.stdout));
    assert_eq!(seen.len(), 2);
    for screen in &seen {
        needs_nothing_else(screen);
        fits(screen);
        has_all_rows(screen);
    }
    looks_like_something(&folder);
}

fn write_report(folder: &Path) {
    let picture = GrayImage::from_fn(160, 120, |x, y| {
        let curve = 60.0 + 25.0 * (f64::from(x) / 20.0).sin();
        Luma([if (f64::from(y) - curve).abs() < 3.0 { 220 } else { 60 }])
    });
    picture.save(folder.join("curve.png")).unwrap();
    let manifest = MANIFEST.replace("LONG", &"long_name".repeat(20));
    fs::write(folder.join("rows.toml"), manifest).unwrap();
    let mut batch = Command::new(heatpath_ffi_tests::heatpath());
    batch.current_dir(folder).args(["batch", "rows.toml", "--quiet", "--report", "report.html"]);
    assert_eq!(batch.output().unwrap().status.code(), Some(11), "one of the rows fails");
}

/// Opens a page of the folder; no name of any computer is known.
fn chromium(folder: &Path, more: &[&str], page: &str) -> Output {
    let mut browser = Command::new("chromium");
    browser.args(["--headless", "--no-sandbox", "--hide-scrollbars", "--disable-gpu"]);
    browser.arg("--disable-dev-shm-usage");
    browser.args(["--host-resolver-rules=MAP * ~NOTFOUND", "--disable-background-networking"]);
    browser.args(["--allow-file-access-from-files", "--enable-logging=stderr"]);
    browser.arg(format!("--user-data-dir={}", folder.join("profile").display())).args(more);
    run(browser.arg(format!("file://{}", folder.join(page).display())))
}

/// What `look.html` says, one value a screen.
fn seen(page: &str) -> Vec<Value> {
    let text = page.split_once("<pre>").and_then(|(_, text)| text.split_once("</pre>"));
    let text = text.unwrap_or_else(|| panic!("the page was not seen:\n{page}")).0;
    let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    serde_json::from_str(&text).unwrap()
}

fn needs_nothing_else(screen: &Value) {
    assert_eq!(screen["scripts"], 0);
    assert_eq!(screen["lost_links"], 0);
    let addresses = ["requests", "addresses"].map(|key| screen[key].as_array().unwrap());
    assert!(!addresses[1].is_empty());
    for address in addresses.into_iter().flatten().map(|address| address.as_str().unwrap()) {
        assert!(address.starts_with("data:") || address.contains("report.html#"), "{address}");
    }
}

fn fits(screen: &Value) {
    let [page, width] = ["page_width", "screen_width"].map(|key| screen[key].as_u64().unwrap());
    assert!(page <= width, "the page is {page} pixels wide, the screen {width}");
}

fn has_all_rows(screen: &Value) {
    assert_eq!(screen["table_rows"], 3);
    let sections = screen["sections"].as_array().unwrap();
    let images = |row: usize| sections[row]["images"].as_array().unwrap();
    assert_eq!((sections.len(), images(0).len(), images(1).len(), images(2).len()), (3, 1, 1, 0));
    assert!(sections.iter().all(|section| section["text"].as_str().unwrap().len() > 100));
    for image in images(0).iter().chain(images(1)) {
        assert_eq!(image["shown"], true);
        assert_eq!(image["pixels"], image["promised"]);
        assert!(image["pixels"][0].as_u64() > Some(0), "a picture cannot be decoded");
    }
}

/// The picture of the page has its size, and the colours of text and pictures.
fn looks_like_something(folder: &Path) {
    let file = folder.join("page.png");
    let screenshot = format!("--screenshot={}", file.display());
    chromium(folder, &[&screenshot, "--window-size=1200,1600"], "report.html");
    let picture = ImageReader::open(file).unwrap().decode().unwrap().to_rgb8();
    assert_eq!(picture.dimensions(), (1200, 1600));
    let colours: HashSet<_> = picture.pixels().collect();
    assert!(colours.len() > 200, "{} colours", colours.len());
}
