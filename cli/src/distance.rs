//! `heatpath distance`

use crate::args::DistanceArgs;
use crate::failure::Failure;
use crate::heat::{Outcome, Plan, flow};
use crate::input::{Input, Picture, size_text};
use crate::output;
use heatpath_io::{FieldFormat, FieldStyle, ImageFile, Overlay, write_field, write_overlay};
use serde::Serialize;
use std::time::Instant;

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    size: Vec<usize>,
    min: f64,
    max: f64,
    mean: f64,
    reached: usize,
    unreached: usize,
    iterations: usize,
    time: f64,
    step: f64,
    seconds: Seconds,
    threads: usize,
    simd: &'static str,
    solver: &'static str,
}

#[derive(Serialize)]
struct Seconds {
    medium: f64,
    heat: f64,
    distance: f64,
    total: f64,
}

pub(crate) fn distance(args: &DistanceArgs) -> Result<(), Failure> {
    let start = Instant::now();
    output::check(args.output.as_deref(), &FieldFormat::ENDINGS, &args.out)?;
    let given = &args.sources.points;
    let plan = Plan::new(&args.heat)?;
    match Input::read(&args.picture, &[&given.source])? {
        Input::Picture(file) => distance_in::<2>(args, &plan, file, start),
        Input::Volume(file) => distance_in::<3>(args, &plan, file, start),
    }
}

fn distance_in<const D: usize>(
    args: &DistanceArgs,
    plan: &Plan,
    file: ImageFile,
    start: Instant,
) -> Result<(), Failure> {
    output::check_dimension(args.output.as_deref(), &args.out, D)?;
    let picture = Picture::<D>::new(&args.picture, file)?;
    let given = &args.sources.points;
    let sources = picture.points("source", &given.source, given.sources.as_deref())?;
    let medium_start = Instant::now();
    let medium = picture.medium(&args.medium, &sources)?;
    let medium_seconds = medium_start.elapsed().as_secs_f64();
    let outcome = flow(&medium, &sources, plan, false, args.out.quiet)?;
    // === Write
    let field = outcome.distances.field();
    if let Some(output) = &args.output {
        let style = FieldStyle { title: Some("distance".to_owned()) };
        write_field(output, args.out.format.as_deref(), args.out.force, field, &style)?;
    }
    if let Some(overlay) = &args.out.overlay {
        let layers = Overlay { field: Some(field), sources: &sources, ..Overlay::default() };
        write_overlay(overlay, args.out.force, &picture.image, &layers)?;
    }
    // === Report
    let open = (0..field.values().len()).filter(|&cell| medium.mask().is_open(cell)).count();
    let mut report = report(&outcome, plan, open);
    report.seconds.medium = medium_seconds;
    report.seconds.total = start.elapsed().as_secs_f64();
    if args.out.json {
        output::print_json(&report)?;
    }
    let Report { size, min, max, mean, reached, unreached, iterations, .. } = report;
    output::tell(
        &args.out,
        &format!(
            "{} cells: distance {min:.6} to {max:.6}, mean {mean:.6}; {reached} cells reached, \
             {unreached} not; {iterations} iterations in {:.2} s",
            size_text(size),
            report.seconds.heat
        ),
    );
    Ok(())
}

fn report<const D: usize>(outcome: &Outcome<D>, plan: &Plan, open_cells: usize) -> Report {
    let reached = outcome.distances.reached().count();
    Report {
        size: outcome.heat.shape().size().to_vec(),
        min: outcome.distances.reached().fold(f64::INFINITY, f64::min),
        max: outcome.distances.reached().fold(0.0, f64::max),
        mean: outcome.distances.reached().sum::<f64>() / reached as f64,
        reached,
        unreached: open_cells - reached,
        iterations: outcome.heat.iterations(),
        time: outcome.heat.time(),
        step: outcome.heat.step(),
        seconds: Seconds {
            medium: 0.0,
            heat: outcome.heat_seconds,
            distance: outcome.distance_seconds,
            total: 0.0,
        },
        threads: outcome.threads,
        simd: outcome.simd,
        solver: plan.solver(),
    }
}
