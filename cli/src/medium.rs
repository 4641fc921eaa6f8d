//! `heatpath medium`

use crate::args::MediumCommandArgs;
use crate::failure::Failure;
use crate::input::Picture;
use crate::output;
use heatpath_io::{FieldFormat, FieldStyle, Overlay, write_field, write_overlay};
use serde::Serialize;

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    min: f64,
    max: f64,
    mean: f64,
}

pub(crate) fn medium(args: &MediumCommandArgs) -> Result<(), Failure> {
    output::check(args.output.as_deref(), &FieldFormat::ENDINGS, &args.out)?;
    let picture = Picture::read(&args.picture)?;
    let sources = picture.optional_sources(&args.sources)?;
    let field = picture.medium(&args.medium, &sources)?.speed_sq_field();
    if let Some(output) = &args.output {
        let style = FieldStyle { title: Some("k D".to_owned()) };
        write_field(output, args.out.format.as_deref(), args.out.force, &field, &style)?;
    }
    if let Some(overlay) = &args.out.overlay {
        let layers = Overlay { field: Some(&field), sources: &sources, ..Overlay::default() };
        write_overlay(overlay, args.out.force, &picture.image, &layers)?;
    }
    let values = field.values();
    let report = Report {
        min: values.iter().copied().fold(f64::INFINITY, f64::min),
        max: values.iter().copied().fold(0.0, f64::max),
        mean: values.iter().sum::<f64>() / values.len() as f64,
    };
    if args.out.json {
        output::print_json(&report)?;
    }
    let Report { min, max, mean } = report;
    output::tell(&args.out, &format!("k D from {min:.6} to {max:.6}, mean {mean:.6}"));
    Ok(())
}
