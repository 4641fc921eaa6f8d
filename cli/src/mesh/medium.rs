//! What makes ways short.

use super::args::{BendArg, CurvatureArg, CurvatureArgs, MeshMediumArg, MeshMediumArgs};
use super::idle::refuse_idle;
use super::input::Input;
use crate::failure::Failure;
use heatpath_core::Exec;
use heatpath_core::mesh::{
    Bend, Curvature, CurvatureMediumOptions, CurvatureMethod, CurvatureOptions, Medium,
    ScalarsOptions, Sources,
};
use std::sync::Arc;

/// Refuses options that would do nothing.
pub(super) fn check(args: &MeshMediumArgs) -> Result<(), Failure> {
    use MeshMediumArg::{Crease, Curvature, Scalars, Speed};
    let (bends, values) = (&[Curvature, Crease][..], &[Scalars, Speed][..]);
    let shaped = &[Curvature, Crease, Scalars][..];
    let needs = [
        (args.bend.is_some(), "--bend", bends),
        (args.curvature.estimator.is_some(), "--estimator", bends),
        (args.curvature.radius.is_some(), "--radius", bends),
        (args.scalars.is_some(), "--scalars", values),
        (args.floor.is_some(), "--floor", shaped),
        (args.power.is_some(), "--power", shaped),
    ];
    refuse_idle("--medium", &args.medium, &needs)
}

/// The medium that the options ask for.
pub(super) fn medium(
    args: &MeshMediumArgs,
    input: &Input,
    sources: &Sources,
    exec: &Exec,
) -> Result<Medium, Failure> {
    let mesh = || Arc::clone(&input.mesh);
    let values = || input.array(args.scalars.as_deref().unwrap_or_default());
    Ok(match args.medium {
        MeshMediumArg::Uniform => Medium::uniform(mesh())?,
        MeshMediumArg::Curvature => {
            let curvature = curvature(&args.curvature, input, exec)?;
            Medium::curvature(mesh(), &curvature, curvature_options(args))?
        }
        MeshMediumArg::Crease => {
            let curvature = curvature(&args.curvature, input, exec)?;
            Medium::crease(mesh(), &curvature, curvature_options(args))?
        }
        MeshMediumArg::Scalars => {
            let usual = ScalarsOptions::default();
            let options = ScalarsOptions {
                power: args.power.unwrap_or(usual.power),
                floor: args.floor.unwrap_or(usual.floor),
            };
            let values = to_unit(values()?);
            let references: Vec<f64> = sources
                .list()
                .iter()
                .map(|source| input.mesh.value_at(&values, &source.point))
                .collect();
            Medium::scalars(mesh(), &values, &references, options)?
        }
        MeshMediumArg::Speed => Medium::given(mesh(), &values()?)?,
    })
}

/// The curvature that the options ask for.
pub(super) fn curvature(
    args: &CurvatureArgs,
    input: &Input,
    exec: &Exec,
) -> Result<Curvature, Failure> {
    let method = match args.estimator {
        Some(CurvatureArg::LeastSquares) => CurvatureMethod::LeastSquares,
        Some(CurvatureArg::NormalCycles) | None => CurvatureMethod::NormalCycles,
    };
    Ok(Curvature::new(&input.mesh, CurvatureOptions { method, radius: args.radius }, exec)?)
}

fn curvature_options(args: &MeshMediumArgs) -> CurvatureMediumOptions {
    let usual = CurvatureMediumOptions::default();
    CurvatureMediumOptions {
        bend: match args.bend {
            Some(BendArg::Convex) => Bend::Convex,
            Some(BendArg::Concave) => Bend::Concave,
            Some(BendArg::Both) | None => Bend::Both,
        },
        floor: args.floor.unwrap_or(usual.floor),
        power: args.power.unwrap_or(usual.power),
        ..usual
    }
}

/// Values scaled so that the smallest is 0 and the largest 1.
fn to_unit(mut values: Vec<f64>) -> Vec<f64> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let range = if high > low { high - low } else { 1.0 };
    values.iter_mut().for_each(|value| *value = (*value - low) / range);
    values
}
