//! `heatpath medium`

use crate::args::{AutoArg, MediumArg, MediumCommandArgs};
use crate::failure::Failure;
use crate::input::{Input, Picture, size_text};
use crate::output;
use heatpath_io::{FieldFormat, FieldStyle, ImageFile, Overlay, write_field, write_overlay};
use serde::Serialize;

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    size: Vec<usize>,
    min: f64,
    max: f64,
    mean: f64,
    /// What `--scale auto` chose.
    #[serde(skip_serializing_if = "Option::is_none")]
    scales: Option<Vec<f64>>,
}

pub(crate) fn medium(args: &MediumCommandArgs) -> Result<(), Failure> {
    output::check(args.output.as_deref(), &FieldFormat::ENDINGS, &args.out)?;
    match Input::read(&args.picture, &[&args.sources.source])? {
        Input::Picture(file) => medium_in::<2>(args, file),
        Input::Volume(file) => medium_in::<3>(args, file),
    }
}

fn medium_in<const D: usize>(args: &MediumCommandArgs, file: ImageFile) -> Result<(), Failure> {
    output::check_dimension(args.output.as_deref(), &args.out, D)?;
    let picture = Picture::<D>::new(&args.picture, file)?;
    let sources = picture.optional_sources(&args.sources)?;
    let (mut medium, mut scales) = (args.medium.clone(), None);
    if let (MediumArg::Vesselness, [AutoArg::Auto]) = (medium.medium, &medium.scale[..]) {
        medium = picture.with_scales(&medium, 0)?;
        scales = Some(medium.scale.iter().filter_map(AutoArg::number).collect());
    }
    let field = picture.medium(&medium, &sources, 0)?.speed_sq_field();
    if let Some(output) = &args.output {
        let style = FieldStyle { title: Some("k D".to_owned()), placement: picture.placement };
        write_field(output, args.out.format.as_deref(), args.out.force, &field, &style)?;
    }
    if let Some(overlay) = &args.out.overlay {
        let layers = Overlay { field: Some(&field), sources: &sources, ..Overlay::default() };
        write_overlay(overlay, args.out.force, &picture.image, &layers)?;
    }
    let values = field.values();
    let report = Report {
        size: field.shape().size().to_vec(),
        min: values.iter().copied().fold(f64::INFINITY, f64::min),
        max: values.iter().copied().fold(0.0, f64::max),
        mean: values.iter().sum::<f64>() / values.len() as f64,
        scales,
    };
    if args.out.json {
        output::print_json(&report)?;
    }
    let Report { size, min, max, mean, scales } = report;
    if let Some(scales) = scales {
        let scales: Vec<String> = scales.iter().map(|scale| format!("{scale:.2}")).collect();
        output::tell(&args.out, &format!("--scale {}", scales.join(",")));
    }
    let size = size_text(size);
    output::tell(
        &args.out,
        &format!("{size} cells: k D from {min:.6} to {max:.6}, mean {mean:.6}"),
    );
    Ok(())
}
