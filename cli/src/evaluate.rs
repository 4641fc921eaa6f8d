//! `heatpath evaluate`

use crate::args::EvaluateArgs;
use crate::failure::Failure;
use crate::input::{coordinates, size_text};
use crate::output;
use crate::place::Place;
use heatpath_core::evaluation::{self, CurveSet, Evaluation, Score, Separation};
use heatpath_core::grid::{Mask, Shape};
use heatpath_io::scores::SCORE_ENDINGS;
use heatpath_io::{
    CurveFile, ImageFile, Placement, ReadError, check_output, scores_json, write_scores,
};
use std::path::Path;

/// A file of curves or a mask.
enum Given {
    Curves(CurveFile),
    Mask(ImageFile),
}

pub(crate) fn evaluate(args: &EvaluateArgs) -> Result<(), Failure> {
    if let Some(output) = &args.output {
        check_output(output, args.format.as_deref(), args.force, &SCORE_ENDINGS)?;
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
    let view = args.mask.as_ref().map(ImageFile::read).transpose()?;
    let files = [
        truth.file().map(|file| (args.truth.as_path(), file)),
        extracted.file().map(|file| (args.extracted.as_path(), file)),
        args.mask.as_deref().zip(view.as_ref()),
    ];
    let places: Vec<Place<'_, D>> =
        files.into_iter().flatten().filter_map(|(path, file)| Place::of(path, file)).collect();
    let spacing = match &args.spacing {
        Some(spacing) => coordinates("spacing", spacing)?,
        None => places.first().map_or([1.0; D], |place| place.spacing),
    };
    Shape::with_spacing([1; D], spacing)?;
    let place = (spacing, places.first().map(|place| place.placement));
    let extracted = extracted.curves(&args.extracted, place)?;
    let truth = truth.curves(&args.truth, place)?;
    let view = view.map(|file| file.into_mask(spacing)).transpose()?;
    let size = check_sizes(args, &extracted, &truth, view.as_ref())?;
    if let ([first, others @ ..], Some(size), None) = (&places[..], size, &args.spacing) {
        others.iter().try_for_each(|other| first.check(other, size))?;
    }
    let evaluation = evaluation::evaluate(&extracted, &truth, &args.tolerance, view.as_ref())?;
    if let Some(output) = &args.output {
        write_scores(output, args.format.as_deref(), args.force, &evaluation)?;
    }
    if args.json {
        output::print(&scores_json(&evaluation))
    } else if args.quiet {
        Ok(())
    } else {
        output::print(&table(&evaluation))
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

    fn file(&self) -> Option<&ImageFile> {
        match self {
            Self::Curves(_) => None,
            Self::Mask(file) => Some(file),
        }
    }

    fn curves<const D: usize>(
        self,
        path: &Path,
        (spacing, placement): ([f64; D], Option<Placement>),
    ) -> Result<CurveSet<D>, Failure> {
        match self {
            Self::Mask(file) => Ok(CurveSet::of_mask(file.into_mask(spacing)?.open())),
            Self::Curves(file) => {
                let polylines = file.into_polylines(spacing, placement)?;
                CurveSet::of_polylines(&polylines, spacing)
                    .map_err(|error| Failure::bad_input(format!("{}: {error}", path.display())))
            }
        }
    }
}

/// The size of the masks, if there are any. Names the files whose sizes differ.
fn check_sizes<const D: usize>(
    args: &EvaluateArgs,
    extracted: &CurveSet<D>,
    truth: &CurveSet<D>,
    view: Option<&Mask<D>>,
) -> Result<Option<[usize; D]>, Failure> {
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
        _ => Ok(sized.first().map(|&(_, size)| size)),
    }
}

/// The scores for eyes.
fn table(evaluation: &Evaluation) -> String {
    let mut lines =
        vec![format!("{:>10} {:>8} {:>9} {:>8}", "tolerance", "recall", "precision", "f1")];
    lines.extend(evaluation.scores.iter().map(|score| {
        let Score { tolerance, recall, precision, f1, .. } = score;
        format!("{tolerance:>10} {recall:>8.4} {precision:>9.4} {f1:>8.4}")
    }));
    if let Some(score) = evaluation.scores.first() {
        let (truth, extracted) = (evaluation.truth_to_extracted, evaluation.extracted_to_truth);
        lines.push(side("truth", score.truth_length, truth));
        lines.push(side("extracted", score.extracted_length, extracted));
    }
    lines.join("\n")
}

fn side(name: &str, length: f64, Separation { mean, largest }: Separation) -> String {
    format!(
        "{name:>10} length {length:.3}, distance from the other: mean {mean:.3}, largest {largest:.3}"
    )
}
