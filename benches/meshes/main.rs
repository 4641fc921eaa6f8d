//! Meshes for the comparison with other programs, and heatpath's part in it.
//!
//!     meshes make SHAPE MESH.off
//!     meshes METHOD MESH.off SOLVES OUTPUT.f64 [THREADS]
//!
//! prepares distances from vertex 0 by METHOD (heat, eikonal, exact), solves SOLVES times more, and prints
//! a line of JSON: seconds until the first distances, of each further solve, and memory in MiB beyond
//! the mesh. `compare.py` runs it.

#![allow(clippy::print_stdout, reason = "its purpose")]

use heatpath_core::Exec;
use heatpath_core::mesh::{Geodesics, GeodesicsOptions, Medium, Method, Sources, TriMesh, shapes};
use heatpath_io::mesh::{read_mesh, write_mesh};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["make", shape, file] => Ok(write_mesh(file, None, true, &make(shape)?, &[])?),
        [method, mesh, solves, output] => measure(method, mesh, solves.parse()?, output, 1),
        [method, mesh, solves, output, threads] => {
            measure(method, mesh, solves.parse()?, output, threads.parse()?)
        }
        _ => Err("meshes make SHAPE MESH.off | METHOD MESH.off SOLVES OUTPUT.f64 [THREADS]".into()),
    }
}

/// `icosphere-LEVEL`, `plane-SIDE` (regular) or `torus-VERTICES` around.
fn make(shape: &str) -> Result<TriMesh, Box<dyn Error>> {
    let (kind, number) = shape.split_once('-').ok_or("a shape is KIND-NUMBER")?;
    let number: usize = number.parse()?;
    Ok(match kind {
        "icosphere" => shapes::icosphere(number),
        "plane" => {
            let place = |i: usize| i as f64 / number as f64;
            shapes::sheet(number, number, |x, y| [place(x), place(y), 0.0])
        }
        "torus" => shapes::torus(2.0, 1.0, number, number / 2),
        _ => return Err(format!("no shape is called {kind}").into()),
    })
}

fn measure(
    method: &str,
    mesh: &str,
    solves: usize,
    output: &str,
    threads: usize,
) -> Result<(), Box<dyn Error>> {
    let file = read_mesh(mesh)?;
    let mesh = file.clean(file.usual_options())?.mesh;
    drop(file);
    let method = match method {
        "heat" => Method::Heat,
        "eikonal" => Method::Eikonal,
        "exact" => Method::Exact,
        _ => return Err(format!("no method is called {method}").into()),
    };
    let exec = Exec::new(threads)?;
    let sources = Sources::at_vertices(&mesh, &[0])?;
    let loaded = memory("VmRSS")?;
    let start = Instant::now();
    let options = GeodesicsOptions { method, ..GeodesicsOptions::default() };
    let geodesics = Geodesics::new(Medium::uniform(mesh)?, options, &exec)?;
    let mut map = geodesics.distance(&sources, &exec)?;
    let first = start.elapsed().as_secs_f64();
    let mut times = Vec::new();
    for _ in 0..solves {
        let start = Instant::now();
        map = geodesics.distance(&sources, &exec)?;
        times.push(start.elapsed().as_secs_f64());
    }
    let bytes: Vec<u8> = map.values().iter().flat_map(|value| value.to_le_bytes()).collect();
    std::fs::write(output, bytes)?;
    let memory = memory("VmHWM")? - loaded;
    println!("{{\"first\":{first},\"solves\":{times:?},\"memory\":{memory}}}");
    Ok(())
}

/// A line of /proc/self/status, in MiB.
fn memory(name: &str) -> Result<f64, Box<dyn Error>> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find(|line| line.starts_with(name)).ok_or("no such line")?;
    let kibibytes: f64 = line.split_whitespace().nth(1).ok_or("no number")?.parse()?;
    Ok(kibibytes / 1024.0)
}
