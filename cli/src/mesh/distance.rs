//! `heatpath mesh distance`

use super::args::MeshDistanceArgs;
use super::input::Input;
use super::medium::{self, medium};
use super::output::{
    MeshFacts, VALUE_ENDINGS, crosses, is_written_as, picture, tell_report, write_arrays,
    write_picture,
};
use super::solve::{MEDIUM_END, PREPARE_END, Plan};
use crate::failure::Failure;
use crate::output;
use crate::run::run;
use heatpath_core::mesh::distance::{DistanceMap, NO_LABEL};
use heatpath_io::mesh::MeshPicture;
use serde::Serialize;
use std::time::Instant;

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    min: f64,
    max: f64,
    mean: f64,
    reached: usize,
    unreached: usize,
    method: &'static str,
    mesh: MeshFacts,
    seconds: Seconds,
    threads: usize,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    medium: f64,
    prepare: f64,
    distance: f64,
    total: f64,
}

pub(super) fn distance(args: &MeshDistanceArgs) -> Result<(), Failure> {
    let start = Instant::now();
    output::check(args.output.as_deref(), &VALUE_ENDINGS, &args.out.common)?;
    medium::check(&args.medium)?;
    let plan = Plan::new(&args.method)?;
    let input = Input::read(&args.mesh)?;
    tell_report(&args.out, &input);
    let sources = input.sources(&args.sources)?;
    let read = start.elapsed().as_secs_f64();
    let watch = (args.method.threads, args.out.common.quiet);
    let (map, method, mut seconds, threads) = run("distance", watch, |exec| {
        let began = Instant::now();
        let medium = medium(&args.medium, &input, &sources, &exec.part(0.0, MEDIUM_END))?;
        let medium_seconds = began.elapsed().as_secs_f64();
        let solver = plan.prepare(medium, &exec.part(MEDIUM_END, PREPARE_END))?;
        let began = Instant::now();
        let map = solver.distance(&sources, &exec.part(PREPARE_END, 1.0))?;
        let distance = began.elapsed().as_secs_f64();
        let prepare = solver.prepare_seconds;
        let seconds = Seconds { read, medium: medium_seconds, prepare, distance, total: 0.0 };
        Ok((map, solver.method(), seconds, exec.threads()))
    })?;
    if map.values().iter().all(|value| value.is_infinite()) {
        return Err(Failure::no_answer("no vertex lies as near to a source as --farthest"));
    }
    // === Write
    if let Some(file) = &args.output {
        let source = |&label: &u32| if label == NO_LABEL { -1.0 } else { f64::from(label) };
        let labels: Vec<f64> = map.labels().iter().map(source).collect();
        let arrays = [("distance", map.values()), ("source", &labels[..])];
        // A table of distances alone has one axis.
        let count = if is_written_as("npy", file, &args.out) { 1 } else { 2 };
        write_arrays(file, &args.out, &input, &arrays[..count])?;
    }
    let places = crosses(&input, &sources, args.sources.curve.len());
    let view = MeshPicture { values: Some(map.values()), sources: &places, ..picture(&args.out) };
    write_picture(&args.out, &input, &view, "distance")?;
    // === Report
    seconds.total = start.elapsed().as_secs_f64();
    let report = report(&map, &input, method, seconds, threads);
    if args.out.common.json {
        output::print_json(&report)?;
    }
    output::tell(&args.out.common, &line(&report));
    Ok(())
}

fn report(
    map: &DistanceMap,
    input: &Input,
    method: &'static str,
    seconds: Seconds,
    threads: usize,
) -> Report {
    let reached = || map.values().iter().copied().filter(|value| value.is_finite());
    let count = reached().count();
    Report {
        min: reached().fold(f64::INFINITY, f64::min),
        max: reached().fold(0.0, f64::max),
        mean: reached().sum::<f64>() / count as f64,
        reached: count,
        unreached: map.values().len() - count,
        method,
        mesh: input.facts(),
        seconds,
        threads,
    }
}

/// The report in words.
fn line(report: &Report) -> String {
    let Report { min, max, mean, reached, unreached, method, seconds, .. } = report;
    format!(
        "distance {min:.6} to {max:.6}, mean {mean:.6}; {reached} vertices reached, {unreached} not; \
         {method}: prepared in {:.2} s, solved in {:.2} s",
        seconds.prepare, seconds.distance
    )
}
