//! `heatpath evaluate`

use crate::args::EvaluateArgs;
use crate::failure::Failure;
use crate::input::{coordinates, size_text};
use crate::output;
use heatpath_core::evaluation::{self, CurveSet, Evaluation};
use heatpath_core::grid::{Mask, Shape};
use heatpath_io::{CurveFile, ImageFile, ReadError, check_output, read_mask, write_atomically};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

const ENDINGS: [&str; 2] = ["json", "csv"];

/// What `--json` prints for a tolerance.
#[derive(Serialize)]
struct Report {
    tolerance: f64,
    recall: f64,
    precision: f64,
    f1: f64,
    truth_length: f64,
    extracted_length: f64,
    /// Infinity, if there is nothing to be near to, becomes null.
    truth_mean_distance: f64,
    truth_largest_distance: f64,
    extracted_mean_distance: f64,
    extracted_largest_distance: f64,
}

/// A file of curves or a mask.
enum Given {
    Curves(CurveFile),
    Mask(ImageFile),
}

pub(crate) fn evaluate(args: &EvaluateArgs) -> Result<(), Failure> {
    if let Some(output) = &args.output {
        check_output(output, args.format.as_deref(), args.force, &ENDINGS)?;
    }
    let [extracted, truth] = [Given::read(&args.extracted)?, Given::read(&args.truth)?];
    match dimension(args, &extracted, &truth) {
        2 => evaluate_in::<2>(args, extracted, truth),
        _ => evaluate_in::<3>(args, extracted, truth),
    }
}

/// Where both can lie in a picture or in a volume, --spacing decides; else the truth.
fn dimension(args: &EvaluateArgs, extracted: &Given, truth: &Given) -> usize {
    let [ours, theirs] = [extracted.dimensions(), truth.dimensions()];
    let given = args.spacing.as_ref().map(|spacing| spacing.0.len());
    let mut shared = theirs.iter().copied().filter(|d| ours.contains(d));
    let first = shared.clone().next();
    given.filter(|d| shared.any(|other| other == *d)).or(first).unwrap_or(theirs[0])
}

fn evaluate_in<const D: usize>(
    args: &EvaluateArgs,
    extracted: Given,
    truth: Given,
) -> Result<(), Failure> {
    let spacing = match &args.spacing {
        Some(spacing) => coordinates("spacing", spacing)?,
        None => [1.0; D],
    };
    Shape::with_spacing([1; D], spacing)?;
    let extracted = extracted.curves(&args.extracted, spacing)?;
    let truth = truth.curves(&args.truth, spacing)?;
    let view = args.mask.as_ref().map(|file| read_mask(file, spacing)).transpose()?;
    check_sizes(args, &extracted, &truth, view.as_ref())?;
    let evaluation = evaluation::evaluate(&extracted, &truth, &args.tolerance, view.as_ref())?;
    let reports = reports(&evaluation);
    if let Some(output) = &args.output {
        let format = args.format.as_deref().or(output.extension().and_then(|e| e.to_str()));
        let is_csv = format.is_some_and(|format| format.eq_ignore_ascii_case("csv"));
        write_atomically(output, args.force, |out| {
            if is_csv { write_csv(out, &reports) } else { write_json(out, &reports) }
        })?;
    }
    match &reports[..] {
        [report] if args.json => output::print_json(report),
        reports if args.json => output::print_json(&reports),
        _ if args.quiet => Ok(()),
        reports => output::print(&table(reports)),
    }
}

impl Given {
    fn read(path: &Path) -> Result<Self, ReadError> {
        match ImageFile::read(path) {
            Ok(file) => Ok(Self::Mask(file)),
            Err(ReadError::Unrecognised { .. }) => CurveFile::read(path).map(Self::Curves),
            Err(error) => Err(error),
        }
    }

    fn dimensions(&self) -> &'static [usize] {
        match self {
            Self::Curves(file) => file.dimensions(),
            Self::Mask(file) => file.dimensions(),
        }
    }

    fn curves<const D: usize>(
        self,
        path: &Path,
        spacing: [f64; D],
    ) -> Result<CurveSet<D>, Failure> {
        match self {
            Self::Mask(file) => Ok(CurveSet::of_mask(file.into_mask(spacing)?.open())),
            Self::Curves(file) => {
                let polylines = file.into_polylines(spacing)?;
                CurveSet::of_polylines(&polylines, spacing)
                    .map_err(|error| Failure::bad_input(format!("{}: {error}", path.display())))
            }
        }
    }
}

/// Names the files whose sizes differ.
fn check_sizes<const D: usize>(
    args: &EvaluateArgs,
    extracted: &CurveSet<D>,
    truth: &CurveSet<D>,
    view: Option<&Mask<D>>,
) -> Result<(), Failure> {
    let files = [
        (Some(&args.extracted), extracted.size()),
        (Some(&args.truth), truth.size()),
        (args.mask.as_ref(), view.map(|view| view.shape().size())),
    ];
    let sized: Vec<_> = files.into_iter().filter_map(|(file, size)| Some((file?, size?))).collect();
    match sized.windows(2).find(|pair| pair[0].1 != pair[1].1) {
        Some([(one, size), (other, other_size)]) => Err(Failure::bad_input(format!(
            "{}: has {} pixels but {} has {}",
            other.display(),
            size_text(other_size),
            one.display(),
            size_text(size),
        ))),
        _ => Ok(()),
    }
}

fn reports(evaluation: &Evaluation) -> Vec<Report> {
    let report = |score: &evaluation::Score| Report {
        tolerance: score.tolerance,
        recall: score.recall,
        precision: score.precision,
        f1: score.f1,
        truth_length: score.truth_length,
        extracted_length: score.extracted_length,
        truth_mean_distance: evaluation.truth_to_extracted.mean,
        truth_largest_distance: evaluation.truth_to_extracted.largest,
        extracted_mean_distance: evaluation.extracted_to_truth.mean,
        extracted_largest_distance: evaluation.extracted_to_truth.largest,
    };
    evaluation.scores.iter().map(report).collect()
}

/// The scores for eyes.
fn table(reports: &[Report]) -> String {
    let mut lines =
        vec![format!("{:>10} {:>8} {:>9} {:>8}", "tolerance", "recall", "precision", "f1")];
    lines.extend(reports.iter().map(|report| {
        let Report { tolerance, recall, precision, f1, .. } = report;
        format!("{tolerance:>10} {recall:>8.4} {precision:>9.4} {f1:>8.4}")
    }));
    if let Some(report) = reports.first() {
        for (name, length, mean, largest) in [
            (
                "truth",
                report.truth_length,
                report.truth_mean_distance,
                report.truth_largest_distance,
            ),
            (
                "extracted",
                report.extracted_length,
                report.extracted_mean_distance,
                report.extracted_largest_distance,
            ),
        ] {
            lines.push(format!(
                "{name:>10} length {length:.3}, distance from the other: mean {mean:.3}, largest \
                 {largest:.3}"
            ));
        }
    }
    lines.join("\n")
}

/// One object, or of several tolerances a list.
fn write_json(out: &mut dyn Write, reports: &[Report]) -> io::Result<()> {
    match reports {
        [report] => serde_json::to_writer(&mut *out, report)?,
        reports => serde_json::to_writer(&mut *out, reports)?,
    }
    writeln!(out)
}

/// One row a tolerance.
fn write_csv(out: &mut dyn Write, reports: &[Report]) -> io::Result<()> {
    writeln!(
        out,
        "tolerance,recall,precision,f1,truth_length,extracted_length,truth_mean_distance,\
         truth_largest_distance,extracted_mean_distance,extracted_largest_distance"
    )?;
    for report in reports {
        let Report { tolerance, recall, precision, f1, truth_length, extracted_length, .. } =
            report;
        write!(out, "{tolerance},{recall},{precision},{f1},{truth_length},{extracted_length},")?;
        let (mean, largest) = (report.truth_mean_distance, report.truth_largest_distance);
        write!(out, "{mean},{largest},")?;
        let (mean, largest) = (report.extracted_mean_distance, report.extracted_largest_distance);
        writeln!(out, "{mean},{largest}")?;
    }
    Ok(())
}
