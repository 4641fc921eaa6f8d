//! Hosts that load a module find what Slicer's modules export, and get what the program gives.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
#![allow(unsafe_code, reason = "libraries are loaded and their functions called")]

mod inputs;

use heatpath_slicer::description;
use heatpath_slicer::library::ProcessInformation;
use heatpath_slicer::modules::ALL;
use inputs::{compare, inputs, program, words};
use libloading::{Library, Symbol};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fs;
use std::process::Command;
use std::ptr;
use std::sync::LazyLock;

/// In the folder `examples` beside the programs, where cargo builds them unless it is asked for one test only.
fn library(name: &str) -> Library {
    static BUILT: LazyLock<()> = LazyLock::new(|| {
        let profile = if cfg!(debug_assertions) { "dev" } else { "release" };
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["build", "--quiet", "--locked", "--package", "heatpath-slicer", "--examples"]);
        let built = cargo.args(["--profile", profile]).output().unwrap();
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    });
    LazyLock::force(&BUILT);
    let file = program(name).with_file_name("examples").join(format!("lib{name}Lib.so"));
    // SAFETY: loading it runs nothing but what Rust needs.
    unsafe { Library::new(file) }.unwrap()
}

type EntryPoint = unsafe extern "C" fn(c_int, *const *const c_char) -> c_int;

/// What the callback finds.
struct Host {
    information: ProcessInformation,
    /// The parts that it was told.
    told: Vec<f32>,
    /// Whether it wants the module to stop from then on.
    abort_at: f32,
}

unsafe extern "C" fn hear(host: *mut c_void) {
    // SAFETY: `call` passes its host, which nobody else looks at meanwhile.
    let host = unsafe { &mut *host.cast::<Host>() };
    host.told.push(host.information.progress);
    host.information.abort = u8::from(host.information.progress >= host.abort_at);
}

/// Calls the module as Slicer does; returns its code, and what the host was told.
fn call(name: &str, words: &[String], abort_at: f32) -> (c_int, Host) {
    let library = library(name);
    // SAFETY: this is its type.
    let entry: Symbol<'_, EntryPoint> = unsafe { library.get("ModuleEntryPoint") }.unwrap();
    let information = ProcessInformation {
        abort: 0,
        progress: 0.0,
        stage_progress: 0.0,
        message: [0; 1024],
        callback: Some(hear),
        client_data: ptr::null_mut(),
        elapsed_time: 0.0,
    };
    let host = Box::into_raw(Box::new(Host { information, told: Vec::new(), abort_at }));
    // SAFETY: it was a box a line ago.
    let address = unsafe {
        (*host).information.client_data = host.cast();
        format!("{:p}", &raw mut (*host).information)
    };
    let own = ["slicer:0x1", "--processinformationaddress", &address];
    let words = own.into_iter().chain(words.iter().map(String::as_str));
    let words: Vec<CString> = words.map(|word| CString::new(word).unwrap()).collect();
    let pointers: Vec<*const c_char> = words.iter().map(|word| word.as_ptr()).collect();
    // SAFETY: the texts and the host outlive the call.
    let code = unsafe { entry(pointers.len() as c_int, pointers.as_ptr()) };
    // SAFETY: the call is over.
    (code, *unsafe { Box::from_raw(host) })
}

fn message(host: &Host) -> &str {
    CStr::from_bytes_until_nul(&host.information.message).unwrap().to_str().unwrap()
}

const NEVER: f32 = 2.0;

const SIDES: [&str; 2] = ["library", "program"];

#[test]
fn descriptions_are_data() {
    for module in ALL {
        let library = library(module.name);
        let data: Symbol<'_, *const c_char> =
            // SAFETY: this is its type.
            unsafe { library.get("XMLModuleDescription") }.unwrap();
        let getter: Symbol<'_, extern "C" fn() -> *const c_char> =
            // SAFETY: this is its type.
            unsafe { library.get("GetXMLModuleDescription") }.unwrap();
        // The symbol is where the text is, not a pointer to it.
        // SAFETY: the text ends with 0.
        let found = unsafe { CStr::from_ptr(data.try_as_raw_ptr().unwrap().cast()) };
        assert_eq!(found.to_str().unwrap(), description(module));
        assert_eq!(getter(), found.as_ptr());
    }
}

/// Whether Ctrl-C does anything but end this process.
fn catches_interrupts() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    u64::from_str_radix(caught.trim(), 16).unwrap() & 0b10 != 0
}

#[test]
fn results_are_those_of_the_programs() {
    for (name, line) in [
        ("HeatpathDistance", "%volume.nrrd @d.nrrd --source 1,11,10.5 --power 4"),
        ("HeatpathPath", "%volume.nrrd @p.vtp --source 1,11,10.5 --end 22,8,7"),
        ("HeatpathVesselTree", "%volume.nrrd @t.vtp --outputDensity @n.nrrd --scale 1.5,2"),
        ("HeatpathMeshDistance", "%mesh.off @m.vtp --source 0,0,0.1 --method heat"),
    ] {
        let folder = inputs(SIDES);
        let folder = folder.path();
        // Twice: nothing is left of the first time.
        for _ in 0..2 {
            let (code, host) = call(name, &words(line, folder, "library"), NEVER);
            assert_eq!((code, message(&host)), (0, ""), "{name}");
            assert_eq!((host.told[0], host.information.progress), (0.0, 1.0), "{name}");
            assert!(host.told.is_sorted() && host.information.elapsed_time > 0.0, "{name}");
        }
        assert!(!catches_interrupts());
        let mut program = Command::new(program(name));
        assert!(program.args(words(line, folder, "program")).output().unwrap().status.success());
        assert_eq!(compare(folder, SIDES), line.matches('@').count());
    }
}

#[test]
fn a_host_can_stop_the_work() {
    let folder = inputs(SIDES);
    let line = "%volume.nrrd @d.nrrd --source 1,2,3 --iterations 1000000000";
    let words = words(line, folder.path(), "library");
    let (code, host) = call("HeatpathDistance", &words, 1e-9);
    assert_eq!((code, message(&host)), (130, "interrupted"));
    assert_eq!(fs::read_dir(folder.path().join("library")).unwrap().count(), 0);
}

#[test]
fn failures_become_messages() {
    let folder = inputs(SIDES);
    for (line, code, text) in [
        ("%volume.nrrd @d.nrrd --source 1,90,1", 3, "source 0 at "),
        ("%none.nrrd @d.nrrd --source 1,2,3", 4, &folder.path().display().to_string()),
        ("slicer:0x1#vtkMRMLScalarVolumeNode1 @d.nrrd --source 1,2,3", 4, "slicer:0x1#vtk"),
        ("%volume.nrrd", 2, "the following required arguments were not provided"),
    ] {
        let words = words(line, folder.path(), "library");
        let (found, host) = call("HeatpathDistance", &words, NEVER);
        assert_eq!(found, code, "{}", message(&host));
        assert!(message(&host).starts_with(text), "{}", message(&host));
        assert_eq!(fs::read_dir(folder.path().join("library")).unwrap().count(), 0);
    }
}

#[test]
fn answers_do_not_end_the_host() {
    for question in ["--help", "--version"] {
        let (code, host) = call("HeatpathPath", &[question.to_owned()], NEVER);
        assert_eq!((code, message(&host)), (0, ""), "{question}");
    }
}

/// All of the above in a process of its own.
#[test]
fn libraries_are_silent() {
    let test = std::env::current_exe().unwrap();
    let others = ["--nocapture", "--skip", "libraries_are_silent"];
    let output = Command::new(test).args(others).output().unwrap();
    assert!(output.status.success());
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(printed.contains("5 passed") && !printed.contains("<filter"), "{printed}");
}
