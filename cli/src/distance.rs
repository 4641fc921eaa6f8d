//! `heatpath distance`

use crate::args::DistanceArgs;
use crate::failure::Failure;
use crate::input::{Input, Picture, size_text};
use crate::output;
use crate::solve::{Outcome, Plan, solve};
use heatpath_core::grid::heat::Heat;
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
    /// This, the time, the step and the solver are those of heat, if distances are read from it.
    iterations: Option<usize>,
    time: Option<f64>,
    step: Option<f64>,
    seconds: Seconds,
    threads: usize,
    simd: &'static str,
    solver: Option<&'static str>,
    estimator: &'static str,
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
    let plan = Plan::new(&args.method)?;
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
    let medium = picture.medium(&args.medium, &sources, args.method.threads)?;
    let medium_seconds = medium_start.elapsed().as_secs_f64();
    let outcome = solve(&medium, &sources, &[], plan, args.out.quiet)?;
    if outcome.distances.reached().next().is_none() {
        return Err(Failure::no_answer("no pixel lies as near to a source as --farthest"));
    }
    // === Write
    let field = outcome.distances.field();
    if let Some(output) = &args.output {
        let style = FieldStyle { title: Some("distance".to_owned()), placement: picture.placement };
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
    output::tell(&args.out, &line(&report));
    Ok(())
}

/// The report in words.
fn line(report: &Report) -> String {
    let Report { size, min, max, mean, reached, unreached, iterations, seconds, .. } = report;
    let work = match iterations {
        Some(iterations) => format!("{iterations} iterations in {:.2} s", seconds.heat),
        None => format!("{} in {:.2} s", report.estimator, seconds.distance),
    };
    format!(
        "{} cells: distance {min:.6} to {max:.6}, mean {mean:.6}; {reached} cells reached, \
         {unreached} not; {work}",
        size_text(size)
    )
}

fn report<const D: usize>(outcome: &Outcome<'_, D>, plan: &Plan, open_cells: usize) -> Report {
    let (reached, heat) = (outcome.distances.reached().count(), outcome.heat.as_ref());
    Report {
        size: outcome.distances.shape().size().to_vec(),
        min: outcome.distances.reached().fold(f64::INFINITY, f64::min),
        max: outcome.distances.reached().fold(0.0, f64::max),
        mean: outcome.distances.reached().sum::<f64>() / reached as f64,
        reached,
        unreached: open_cells - reached,
        iterations: heat.map(Heat::iterations),
        time: heat.map(Heat::time),
        step: heat.map(Heat::step),
        seconds: Seconds {
            medium: 0.0,
            heat: outcome.heat_seconds,
            distance: outcome.distance_seconds,
            total: 0.0,
        },
        threads: outcome.threads,
        simd: outcome.simd,
        solver: plan.solver(),
        estimator: plan.estimator,
    }
}
