//! The plugin in a real Orthanc: what it answers about stored instances is what the command says.

use crate::dicom::{Pixels, SIZE};
use crate::harness::{Host, has_cmake_and, has_program, heatpath, installed, workplace};
use std::fs;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

pub(crate) fn hosts() -> Vec<Host> {
    let present = || {
        has_program(ORTHANC) && has_cmake_and("orthanc-dev") && has_cmake_and("nlohmann-json3-dev")
    };
    vec![Host { name: "orthanc", package: "orthanc-dev", present, run: orthanc }]
}

const ORTHANC: &str = "/usr/sbin/Orthanc";

fn orthanc() {
    let plugin = installed().build_project(Path::new("plugins/orthanc"), &[]);
    let folder = workplace("orthanc-server");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let server = Server::start(&plugin.join("libOrthancHeatpath.so"), &folder);
    assert_eq!(
        server.text("GET", "/heatpath", ""),
        (200, format!("{{\"version\":\"{}\"}}\n", env!("CARGO_PKG_VERSION")))
    );
    let store = |number, pixels: &Pixels| Stored::new(&server, &folder, number, pixels);
    let grey = store(1, &Pixels::grey("<u2", 2000.0));
    let signed = store(2, &Pixels::grey("<i2", 0.0));
    let coloured = store(3, &Pixels::colours());
    let wall = store(4, &Pixels::wall());
    // === What the plugin is asked, and the command
    agree(&server, &grey, "", "");
    agree(
        &server,
        &signed,
        r#""range": [-1024, 3071], "power": 2.5"#,
        "--range -1024,3071 --power 2.5",
    );
    agree(&server, &coloured, r#""channel": "blue", "step": "auto""#, "--channel blue --step auto");
    agree(
        &server,
        &grey,
        &format!(
            r#""mask": "{}", "medium": "combined", "contrast": 0.05, "edge_stop": "rational",
            "smooth": 1.5, "range": [0, 4095], "spacing": [2, 1]"#,
            wall.id
        ),
        &format!(
            "--mask {} --medium combined --contrast 0.05 --edge-stop rational --smooth 1.5 \
             --range 0,4095 --spacing 2,1",
            wall.npy.display()
        ),
    );
    agree(
        &server,
        &grey,
        r#""estimator": "eikonal", "medium": "edges", "floor": 0.1, "farthest": 40"#,
        "--estimator eikonal --medium edges --floor 0.1 --farthest 40",
    );
    agree(
        &server,
        &grey,
        r#""medium": "tensor", "tensor": "structure", "scale": 1.5, "anisotropy": 0.7, "range": [0, 4095]"#,
        "--medium tensor --tensor structure --scale 1.5 --anisotropy 0.7 --range 0,4095",
    );
    agree(
        &server,
        &grey,
        r#""medium": "vesselness", "scale": [1.5, 2], "polarity": "both", "estimator": "heat-method""#,
        "--medium vesselness --scale 1.5,2 --polarity both --estimator heat-method",
    );
    refuses(&server, &grey.id, &coloured.id);
}

/// Asks for distances and paths, of the plugin and of the command, which get the same options.
fn agree(server: &Server, stored: &Stored, json: &str, words: &str) {
    let npy = stored.npy.to_str().unwrap();
    let spacing = if words.contains("--spacing") { "" } else { "--spacing 0.25,0.5" };
    let words = |command| {
        let first = [command, npy, "--source", "5,6.5"].into_iter();
        first.chain(words.split_whitespace()).chain(spacing.split_whitespace())
    };
    let comma = if json.is_empty() { "" } else { "," };
    let body = |more| {
        let id = &stored.id;
        format!(r#"{{"instance": "{id}", "source": [5, 6.5] {more} {comma} {json}}}"#)
    };
    // === Distances
    let output = stored.npy.with_extension("distance.npy");
    heatpath(words("distance"), &output);
    let (status, answer) = server.ask("POST", "/heatpath/distance", body(""));
    assert_eq!(status, 200, "{}", String::from_utf8_lossy(&answer));
    assert!(answer.starts_with(b"\x93NUMPY\x01\0"));
    let numbers = |file: &[u8]| file[file.len() - SIZE[0] * SIZE[1] * 8..].to_vec();
    assert!(numbers(&answer) == numbers(&fs::read(&output).unwrap()), "the distances differ");
    // === Paths
    let output = stored.npy.with_extension("json");
    heatpath(words("path").chain(["--end", "15,12.25", "--end", "2,25"]), &output);
    let ends = r#", "end": [[15, 12.25], [2, 25]]"#;
    let (status, answer) = server.text("POST", "/heatpath/path", &body(ends));
    assert_eq!(status, 200, "{answer}");
    assert_eq!(parsed(&answer), parsed(&fs::read_to_string(&output).unwrap()));
}

/// A text without its numbers, and the numbers: the same ones may be written differently.
fn parsed(json: &str) -> (String, Vec<f64>) {
    let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let words: String = json.chars().map(|c| if is_part(c) { c } else { ' ' }).collect();
    let numbers = words.split(' ').filter_map(|word| word.parse().ok()).collect();
    (json.chars().filter(|&c| !is_part(c)).collect(), numbers)
}

fn refuses(server: &Server, grey: &str, coloured: &str) {
    let source = r#""source": [5, 6.5]"#;
    for (body, expected, line) in [
        ("[1]".to_owned(), 400, "the body must be a JSON object"),
        (
            format!("{{{source}}}"),
            400,
            "`instance` is missing: Orthanc's identifier of an instance",
        ),
        (format!(r#"{{"instance": "x", {source}}}"#), 404, "there is no instance `x`"),
        (format!(r#"{{"instance": "{grey}"}}"#), 400, "`source` is missing"),
        (
            format!(r#"{{"instance": "{grey}", "source": [50, 6]}}"#),
            400,
            "source 0 at [50.0, 6.0] lies outside the grid of [40, 30] cells; pixel coordinates run \
             from -0.5 to the size minus 0.5",
        ),
        (
            format!(r#"{{"instance": "{grey}", {source}, "powr": 2}}"#),
            400,
            "there is no option `powr` here",
        ),
        (
            format!(r#"{{"instance": "{grey}", {source}, "solver": "both"}}"#),
            400,
            "`solver` must be one of: explicit, implicit",
        ),
        (
            format!(r#"{{"instance": "{coloured}", {source}}}"#),
            400,
            "the image is coloured: `channel` must be red, green or blue",
        ),
        // The configuration of this test allows two seconds.
        (
            format!(r#"{{"instance": "{grey}", {source}, "iterations": 1000000000000}}"#),
            503,
            "given up after the 2 seconds of Heatpath.TimeLimit",
        ),
    ] {
        let (status, answer) = server.text("POST", "/heatpath/distance", &body);
        assert_eq!((status, answer), (expected, format!("{line}\n")), "{body}");
    }
    assert_eq!(server.ask("GET", "/heatpath/path", "").0, 405);
}

/// An instance, and the same pixels for the command.
struct Stored {
    id: String,
    npy: PathBuf,
}

impl Stored {
    fn new(server: &Server, folder: &Path, number: u16, pixels: &Pixels) -> Self {
        let npy = folder.join(format!("{number}.npy"));
        fs::write(&npy, pixels.npy()).unwrap();
        let (status, answer) = server.ask("POST", "/instances", pixels.dicom(number));
        let answer = String::from_utf8(answer).unwrap();
        assert_eq!(status, 200, "{answer}");
        let id = answer.split("\"ID\" : \"").nth(1).and_then(|rest| rest.split('"').next());
        Self { id: id.unwrap().to_owned(), npy }
    }
}

/// Orthanc with the plugin; it ends with the test.
struct Server {
    process: Child,
    port: u16,
}

impl Server {
    fn start(plugin: &Path, folder: &Path) -> Self {
        let free = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = free.local_addr().unwrap().port();
        drop(free);
        let configuration = folder.join("orthanc.json");
        let [storage, plugin] =
            [&folder.join("storage"), plugin].map(|path| path.display().to_string());
        let text = format!(
            r#"{{"StorageDirectory": "{storage}", "IndexDirectory": "{storage}", "Plugins": ["{plugin}"],
            "HttpPort": {port}, "DicomServerEnabled": false, "AuthenticationEnabled": false,
            "Heatpath": {{"TimeLimit": 2}}}}"#
        );
        fs::write(&configuration, text).unwrap();
        let log = fs::File::create(folder.join("log")).unwrap();
        let mut command = Command::new(ORTHANC);
        command.arg(&configuration).stdout(Stdio::null()).stderr(log);
        let mut server = Self { process: command.spawn().unwrap(), port };
        server.wait(&folder.join("log"));
        server
    }

    /// Waits until it answers.
    fn wait(&mut self, log: &Path) {
        let start = Instant::now();
        while TcpStream::connect(("127.0.0.1", self.port)).is_err() {
            let ended = self.process.try_wait().unwrap();
            let waits = ended.is_none() && start.elapsed() < Duration::from_secs(120);
            assert!(waits, "{ended:?}: {}", fs::read_to_string(log).unwrap());
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// The status and the body of an answer.
    fn ask(&self, method: &str, path: &str, body: impl AsRef<[u8]>) -> (u16, Vec<u8>) {
        let body = body.as_ref();
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\
             Content-Length: {}\r\n\r\n",
            body.len()
        );
        stream.write_all(&[head.as_bytes(), body].concat()).unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|bytes| bytes == b"\r\n\r\n").unwrap();
        let status = std::str::from_utf8(&answer[9..12]).unwrap().parse().unwrap();
        (status, answer.split_off(end + 4))
    }

    /// [`ask`](Self::ask) for a text.
    fn text(&self, method: &str, path: &str, body: &str) -> (u16, String) {
        let (status, answer) = self.ask(method, path, body);
        (status, String::from_utf8(answer).unwrap())
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
