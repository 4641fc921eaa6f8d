//! `heatpath path`

use crate::args::{OutputArgs, PathArgs};
use crate::failure::Failure;
use crate::input::{Input, Picture};
use crate::output;
use crate::solve::{Plan, solve};
use heatpath_core::grid::path::{Ending, Path, PathOptions};
use heatpath_io::curves::ending_name;
use heatpath_io::{Curves, ImageFile, Overlay, curves_json, write_curves, write_overlay};

pub(crate) fn path(args: &PathArgs) -> Result<(), Failure> {
    output::check(args.output.as_deref(), &Curves::<2>::ENDINGS, &args.out)?;
    let given = &args.sources.points;
    let plan = Plan::new(&args.method)?;
    match Input::read(&args.picture, &[&given.source, &args.end])? {
        Input::Picture(file) => path_in::<2>(args, &plan, file),
        Input::Volume(file) => path_in::<3>(args, &plan, file),
    }
}

fn path_in<const D: usize>(args: &PathArgs, plan: &Plan, file: ImageFile) -> Result<(), Failure> {
    output::check_dimension(args.output.as_deref(), &args.out, D)?;
    let picture = Picture::<D>::new(&args.picture, file)?;
    let given = &args.sources.points;
    let sources = picture.points("source", &given.source, given.sources.as_deref())?;
    let ends = picture.points("end", &args.end, args.ends.as_deref())?;
    let medium = picture.medium(&args.medium, &sources, args.method.threads)?;
    let outcome = solve(&medium, &sources, &ends, plan, args.out.quiet)?;
    let descent = outcome.descent()?;
    let paths = ends
        .iter()
        .map(|&end| descent.path(end, &outcome.distances, PathOptions::default()))
        .collect::<Result<Vec<_>, _>>()?;
    // === Write
    let shape = picture.image.shape();
    let (spacing, placement) = (shape.spacing(), picture.placement);
    let curves = Curves { spacing, placement, paths, key_points: Vec::new() };
    if let Some(output) = &args.output {
        write_curves(output, args.out.format.as_deref(), args.out.force, &curves, shape)?;
    }
    if let Some(overlay) = &args.out.overlay {
        let layers = Overlay { paths: &curves.paths, sources: &sources, ..Overlay::default() };
        write_overlay(overlay, args.out.force, &picture.image, &layers)?;
    }
    // === Report
    if args.out.json {
        output::print_json(&curves_json(&curves))?;
    }
    for (number, path) in curves.paths.iter().enumerate() {
        output::tell(&args.out, &line(number, path));
    }
    warn_of_dear_paths(&curves.paths, plan, &args.out);
    complain_of_missing(&curves.paths, plan)
}

/// One path in words.
fn line<const D: usize>(number: usize, path: &Path<D>) -> String {
    let end = path.points[0].map(|coordinate| coordinate.to_string()).join(",");
    match path.ending {
        Ending::Source(source) => format!(
            "path {number} from {end} to source {source}: length {:.2} pixels, {:.6} physical, \
             distance {:.6}, cost {:.6}",
            path.length, path.physical_length, path.distance, path.cost
        ),
        ending => format!("path {number} from {end}: {}", ending_name(ending)),
    }
}

/// How many times its distance a path of some pixels may cost: by heat of a fitting number of steps
/// on real pictures it is at most 1.14 times.
const DEAREST: f64 = 1.5;

/// Says where heat is wrong about a path or its distance.
fn warn_of_dear_paths<const D: usize>(paths: &[Path<D>], plan: &Plan, out: &OutputArgs) {
    let dear = paths.iter().enumerate().filter(|(_, path)| is_dear(path));
    for (number, path) in dear.filter(|_| plan.has_heat()) {
        let times = path.cost / path.distance;
        output::warn(
            out,
            &format!(
                "path {number} costs {times:.1} times its distance: it is no shortest path, or the \
                 distance is too short; --estimator eikonal finds both"
            ),
        );
    }
}

fn is_dear<const D: usize>(path: &Path<D>) -> bool {
    path.length > 5.0 && path.distance < f64::INFINITY && path.cost > DEAREST * path.distance
}

/// Paths that ended nowhere are written with the others, but they are no answer.
fn complain_of_missing<const D: usize>(paths: &[Path<D>], plan: &Plan) -> Result<(), Failure> {
    let missing: Vec<(usize, Ending)> = paths
        .iter()
        .enumerate()
        .filter(|(_, path)| !matches!(path.ending, Ending::Source(_)))
        .map(|(number, path)| (number, path.ending))
        .collect();
    let Some(&(number, ending)) = missing.first() else {
        return Ok(());
    };
    let reason = match ending {
        Ending::Source(_) => "it did",
        Ending::Unreachable => "walls separate it from every source",
        Ending::NotReached => plan.not_reached(),
        Ending::StepLimit => "the tracer took its largest number of steps or found no way down",
    };
    Err(Failure::no_answer(format!(
        "{} of {} paths did not reach a source; the first is path {number}: {reason}",
        missing.len(),
        paths.len()
    )))
}
