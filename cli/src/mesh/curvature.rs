//! `heatpath mesh curvature`

use super::args::MeshCurvatureArgs;
use super::input::Input;
use super::medium;
use super::output::{MeshFacts, VALUE_ENDINGS, picture, tell_report, write_arrays, write_picture};
use crate::failure::Failure;
use crate::output;
use crate::run::run;
use heatpath_core::mesh::Principal;
use heatpath_io::mesh::MeshPicture;
use serde::Serialize;

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    minimum: f64,
    maximum: f64,
    mean: f64,
    radius: Option<f64>,
    mesh: MeshFacts,
}

pub(super) fn curvature(args: &MeshCurvatureArgs) -> Result<(), Failure> {
    output::check(args.output.as_deref(), &VALUE_ENDINGS, &args.out.common)?;
    let input = Input::read(&args.mesh)?;
    tell_report(&args.out, &input);
    let curvature = run("curvature", (args.threads, args.out.common.quiet), |exec| {
        medium::curvature(&args.curvature, &input, exec)
    })?;
    let array = |value: fn(&Principal) -> f64| -> Vec<f64> {
        curvature.vertices().iter().map(value).collect()
    };
    let [minimum, maximum] = [array(|k| k.values[0]), array(|k| k.values[1])];
    let [mean, gaussian] = [array(Principal::mean), array(Principal::gaussian)];
    // === Write
    if let Some(file) = &args.output {
        let arrays = [
            ("minimum", &minimum[..]),
            ("maximum", &maximum[..]),
            ("mean", &mean[..]),
            ("gaussian", &gaussian[..]),
        ];
        write_arrays(file, &args.out, &input, &arrays)?;
    }
    let view = MeshPicture { values: Some(&mean), ..picture(&args.out) };
    write_picture(&args.out, &input, &view, "mean curvature")?;
    // === Report
    let report = Report {
        minimum: minimum.iter().copied().fold(f64::INFINITY, f64::min),
        maximum: maximum.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        mean: mean.iter().sum::<f64>() / mean.len() as f64,
        radius: curvature.radius(),
        mesh: input.facts(),
    };
    if args.out.common.json {
        output::print_json(&report)?;
    }
    let Report { minimum, maximum, mean, .. } = report;
    let line = format!("curvature {minimum:.6} to {maximum:.6}, mean curvature {mean:.6}");
    output::tell(&args.out.common, &line);
    Ok(())
}
