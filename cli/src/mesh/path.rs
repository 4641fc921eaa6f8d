//! `heatpath mesh path`

use super::args::MeshPathArgs;
use super::input::Input;
use super::medium::{self, medium};
use super::output::{crosses, picture, tell_report, write_picture};
use super::solve::{MEDIUM_END, PREPARE_END, Plan, Route};
use crate::failure::Failure;
use crate::output;
use crate::run::run;
use heatpath_core::mesh::path::{Ending, Path};
use heatpath_io::curves_json;
use heatpath_io::mesh::{MeshPicture, PATH_ENDINGS, mesh_curves, write_mesh_paths};

pub(super) fn path(args: &MeshPathArgs) -> Result<(), Failure> {
    output::check(args.output.as_deref(), &PATH_ENDINGS, &args.out.common)?;
    medium::check(&args.medium)?;
    let plan = Plan::new(&args.method)?;
    let input = Input::read(&args.mesh)?;
    tell_report(&args.out, &input);
    let sources = input.sources(&args.sources)?;
    let ends = input.points("end", &args.end, args.ends.as_deref())?;
    let via = input.points("way point", &args.through, None)?;
    let watch = (args.method.threads, args.out.common.quiet);
    let (map, paths) = run("paths", watch, |exec| {
        let medium = medium(&args.medium, &input, &sources, &exec.part(0.0, MEDIUM_END))?;
        let solver = plan.prepare(medium, &exec.part(MEDIUM_END, PREPARE_END))?;
        let route = Route { ends: &ends, via: &via, shorten: args.shorten };
        solver.paths(&sources, &route, &exec.part(PREPARE_END, 1.0))
    })?;
    // === Write
    let out = &args.out.common;
    if let Some(file) = &args.output {
        write_mesh_paths(file, out.format.as_deref(), out.force, &paths)?;
    }
    let places = crosses(&input, &sources, args.sources.curve.len());
    let view = MeshPicture {
        values: Some(map.values()),
        paths: &paths,
        sources: &places,
        ..picture(&args.out)
    };
    write_picture(&args.out, &input, &view, "distance")?;
    // === Report
    if out.json {
        output::print_json(&curves_json(&mesh_curves(&paths)))?;
    }
    for (number, path) in paths.iter().enumerate() {
        output::tell(out, &line(number, path));
    }
    complain_of_missing(&paths)
}

/// One path in words.
fn line(number: usize, path: &Path) -> String {
    match path.ending {
        Ending::Source(source) => format!(
            "path {number} to source {source}: length {:.6}, distance {:.6}",
            path.length, path.distance
        ),
        Ending::Unreachable => format!("path {number}: unreachable"),
        Ending::Stuck => format!("path {number}: stuck"),
    }
}

/// Paths that ended nowhere are written with the others, but they are no answer.
fn complain_of_missing(paths: &[Path]) -> Result<(), Failure> {
    let is_missing = |path: &&Path| !matches!(path.ending, Ending::Source(_));
    let missing = paths.iter().filter(is_missing).count();
    let Some(number) = paths.iter().position(|path| is_missing(&path)) else { return Ok(()) };
    let reason = match paths[number].ending {
        Ending::Stuck => "it found no way down",
        _ => {
            "no source lies in its component or nearer than --farthest, or heat needs more \
              --iterations"
        }
    };
    Err(Failure::no_answer(format!(
        "{missing} of {} paths did not reach a source; the first is path {number}: {reason}",
        paths.len()
    )))
}
