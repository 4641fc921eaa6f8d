//! `heatpath keypoints`

use crate::args::{KeyPointMethodArg, KeyPointsArgs};
use crate::failure::Failure;
use crate::input::{Input, Picture};
use crate::output;
use crate::run::run;
use crate::structure;
use heatpath_core::Exec;
use heatpath_core::grid::Structure;
use heatpath_core::grid::keypoints::{
    KeyPointOptions, KeyPoints, LengthOptions, Stop, key_points, key_points_by_length,
};
use heatpath_io::{
    Curves, FieldStyle, ImageFile, Overlay, check_dimension, curves_json, write_curves,
    write_field, write_overlay,
};

pub(crate) fn keypoints(args: &KeyPointsArgs) -> Result<(), Failure> {
    if args.iterations.is_some() && matches!(args.method, KeyPointMethodArg::Length) {
        return Err(Failure::usage("--iterations is of heat: `--method length` does not take it"));
    }
    output::check(args.output.as_deref(), &Curves::<2>::ENDINGS, &args.out)?;
    let output = args.output.as_deref();
    output::check_field("--travelling", args.travelling.as_deref(), output, &args.out)?;
    match Input::read(&args.picture, &[&args.sources.source])? {
        Input::Picture(file) => keypoints_in::<2>(args, file),
        Input::Volume(file) => keypoints_in::<3>(args, file),
    }
}

fn keypoints_in<const D: usize>(args: &KeyPointsArgs, file: ImageFile) -> Result<(), Failure> {
    output::check_dimension(args.output.as_deref(), &args.out, D)?;
    if let Some(file) = &args.travelling {
        check_dimension(file, None, D)?;
    }
    let picture = Picture::<D>::new(&args.picture, file)?;
    let found = structure::find(&picture, &args.sources, &args.medium, &args.structure)?;
    let options = options(args, &found)?;
    let found_points = run("key points", (args.structure.threads, args.out.quiet), |exec| {
        search(args.method, &found, &options, exec)
    })?;
    // === Write
    let shape = picture.image.shape();
    let paths = found_points.links.iter().map(|link| link.path.clone()).collect();
    let (spacing, placement) = (shape.spacing(), picture.placement);
    let curves = Curves { spacing, placement, paths, key_points: found_points.points.clone() };
    if let Some(output) = &args.output {
        write_curves(output, args.out.format.as_deref(), args.out.force, &curves, shape)?;
    }
    if let Some(file) = &args.travelling {
        let style =
            FieldStyle { title: Some("travelling map".to_owned()), placement: picture.placement };
        write_field(file, None, args.out.force, &found_points.travelling, &style)?;
    }
    if let Some(overlay) = &args.out.overlay {
        let layers = Overlay {
            field: Some(&found_points.travelling),
            paths: &curves.paths,
            key_points: &curves.key_points,
            sources: found.sources.points(),
            are_pieces: true,
        };
        write_overlay(overlay, args.out.force, &picture.image, &layers)?;
    }
    // === Report
    if args.out.json {
        output::print_json(&curves_json(&curves))?;
    }
    output::tell(
        &args.out,
        &line(&found_points, &curves, found.sources.points().len(), options.radius),
    );
    Ok(())
}

/// What is not asked for comes from the structure.
fn options<const D: usize>(
    args: &KeyPointsArgs,
    found: &Structure<D>,
) -> Result<KeyPointOptions, Failure> {
    let usual = KeyPointOptions::of_structure(&found.medium, found.level()?);
    Ok(KeyPointOptions {
        radius: args.radius.unwrap_or(usual.radius),
        iterations: args.iterations.unwrap_or(usual.iterations),
        least_speed_sq: args.structure.structure.unwrap_or(usual.least_speed_sq),
        ..usual
    })
}

fn search<const D: usize>(
    method: KeyPointMethodArg,
    found: &Structure<D>,
    options: &KeyPointOptions,
    exec: &Exec,
) -> Result<KeyPoints<D>, Failure> {
    let Structure { medium, sources, .. } = found;
    Ok(match method {
        KeyPointMethodArg::Heat => key_points(medium, sources, options, exec)?,
        KeyPointMethodArg::Length => {
            let &KeyPointOptions { radius: length, least_speed_sq, most, .. } = options;
            let options = LengthOptions { length, least_speed_sq, most };
            key_points_by_length(medium, sources, &options, exec)?
        }
    })
}

/// The result in words.
fn line<const D: usize>(
    found: &KeyPoints<D>,
    curves: &Curves<D>,
    seeds: usize,
    radius: f64,
) -> String {
    let stop = match found.stop {
        Stop::Complete => "",
        Stop::Most => ", which are as many as allowed",
    };
    let length: f64 = curves.paths.iter().map(|path| path.physical_length).sum();
    format!(
        "{} key points{stop}, of them seeds: {seeds}, {} apart: {} paths of {length:.1} in all, {} of \
         them close a curve",
        found.points.len(),
        radius,
        curves.paths.len(),
        found.closing().count()
    )
}
