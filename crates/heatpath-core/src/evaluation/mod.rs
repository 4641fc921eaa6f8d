//! How well extracted curves agree with a truth: recall and precision by length.
//!
//! Recall is the part of the truth's length that lies within a tolerance of the extraction, precision
//! the part of the extraction's length that lies within the tolerance of the truth. Lengths are
//! integrated over elements of at most a quarter of a cell; the distance of an element is that of its
//! middle from the nearest point of the other curves, which are polylines, not their vertices.
//!
//! ```
//! use heatpath_core::evaluation::{CurveSet, evaluate};
//!
//! let truth = CurveSet::of_polylines(&[[[0.0, 0.0], [40.0, 0.0]]], [1.0; 2])?;
//! let found = CurveSet::of_polylines(&[[[0.0, 1.0], [30.0, 1.0]]], [1.0; 2])?;
//! let evaluation = evaluate(&found, &truth, &[0.5, 1.0], None)?;
//! assert_eq!(evaluation.scores[0].recall, 0.0);
//! assert_eq!(evaluation.scores[1].recall, 0.75);
//! assert_eq!(evaluation.scores[1].precision, 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod curves;
mod nearest;

pub use curves::CurveSet;

use crate::grid::{Mask, ShapeError};
use nearest::Nearest;
use thiserror::Error;

/// Distances so much above a tolerance, in cell units, are within it: they come from rounding.
const SLACK: f64 = 1e-9;

/// Recall and precision at one tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// The largest distance, in physical units, at which curves agree.
    pub tolerance: f64,
    /// The part of the truth's length within the tolerance of the extraction, 0 to 1; 1 if the truth
    /// has no length: nothing was missed.
    pub recall: f64,
    /// The part of the extracted length within the tolerance of the truth, 0 to 1; 1 if nothing was
    /// extracted: nothing of it is wrong.
    pub precision: f64,
    /// The harmonic mean of recall and precision, `2 r p / (r + p)`; 0 if both are.
    pub f1: f64,
    /// The truth's length in physical units.
    pub truth_length: f64,
    /// The extraction's length in physical units.
    pub extracted_length: f64,
}

/// How far one set of curves lies from the other, in physical units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// The mean over the length; infinite if the other set is empty, 0 if this one has no length.
    pub mean: f64,
    /// The largest distance; infinite if the other set is empty, 0 if this one has no length.
    pub largest: f64,
}

/// The comparison of an extraction with a truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// One score for each tolerance, in the order in which they were given.
    pub scores: Vec<Score>,
    /// How far the truth lies from the extraction.
    pub truth_to_extracted: Separation,
    /// How far the extraction lies from the truth.
    pub extracted_to_truth: Separation,
}

/// Why curves cannot be compared.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EvaluationError {
    /// A tolerance is negative, infinite or not a number.
    #[error("the tolerance {tolerance} must be a finite number of at least 0")]
    Tolerance {
        /// The rejected value.
        tolerance: f64,
    },
    /// A point of a polyline is not finite or too far away.
    #[error("point {point} of curve {curve} must be finite and less than 1e9 cells away")]
    Point {
        /// The curve, counted from 0.
        curve: usize,
        /// The point, counted from 0.
        point: usize,
    },
    /// The curves are too long to be measured.
    #[error("the curves are {length:.0} cells long; at most {longest} are possible")]
    TooLong {
        /// Their length in cell units.
        length: f64,
        /// The largest length.
        longest: f64,
    },
    /// Masks, or a mask and the field of view, have different sizes.
    #[error("the sizes differ: {left:?} cells and {right:?} cells")]
    Sizes {
        /// The cells along each axis of one.
        left: Vec<usize>,
        /// The cells along each axis of the other.
        right: Vec<usize>,
    },
    /// The curves have different spacings.
    #[error("the spacings differ: {extracted:?} of the extraction and {truth:?} of the truth")]
    Spacings {
        /// The extraction's.
        extracted: Vec<f64>,
        /// The truth's.
        truth: Vec<f64>,
    },
    /// The spacing is no spacing.
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

/// Compares `extracted` curves with the `truth` at each of `tolerances`, in physical units (pixels if
/// the spacing is 1).
///
/// Elements of either set whose cell is not open in `view`, or lies beyond it, do not count; curves
/// beyond it can still be near. Of two points at tolerance 0 only equal ones agree, up to rounding.
/// What is asked of empty sets is said at [`Score`].
///
/// # Errors
/// A tolerance is negative or not finite; the spacings, or the sizes of masks and view, differ.
pub fn evaluate<const D: usize>(
    extracted: &CurveSet<D>,
    truth: &CurveSet<D>,
    tolerances: &[f64],
    view: Option<&Mask<D>>,
) -> Result<Evaluation, EvaluationError> {
    if let Some(&tolerance) = tolerances.iter().find(|t| !(t.is_finite() && **t >= 0.0)) {
        return Err(EvaluationError::Tolerance { tolerance });
    }
    check_grids(extracted, truth, view)?;
    let of_truth = Agreement::new(truth, extracted, tolerances, view);
    let of_extracted = Agreement::new(extracted, truth, tolerances, view);
    let scores = tolerances.iter().enumerate();
    Ok(Evaluation {
        scores: scores
            .map(|(i, &tolerance)| score(tolerance, i, &of_truth, &of_extracted))
            .collect(),
        truth_to_extracted: of_truth.separation(),
        extracted_to_truth: of_extracted.separation(),
    })
}

fn check_grids<const D: usize>(
    extracted: &CurveSet<D>,
    truth: &CurveSet<D>,
    view: Option<&Mask<D>>,
) -> Result<(), EvaluationError> {
    if extracted.spacing != truth.spacing {
        let (extracted, truth) = (extracted.spacing.to_vec(), truth.spacing.to_vec());
        return Err(EvaluationError::Spacings { extracted, truth });
    }
    let sizes = [extracted.size(), truth.size(), view.map(|view| view.shape().size())];
    let sizes: Vec<_> = sizes.into_iter().flatten().collect();
    match sizes.windows(2).find(|pair| pair[0] != pair[1]) {
        Some(pair) => {
            Err(EvaluationError::Sizes { left: pair[0].to_vec(), right: pair[1].to_vec() })
        }
        None => Ok(()),
    }
}

fn score(tolerance: f64, i: usize, truth: &Agreement, extracted: &Agreement) -> Score {
    let (recall, precision) = (truth.part(i), extracted.part(i));
    let sum = recall + precision;
    Score {
        tolerance,
        recall,
        precision,
        f1: if sum > 0.0 { 2.0 * recall * precision / sum } else { 0.0 },
        truth_length: truth.length,
        extracted_length: extracted.length,
    }
}

/// How one set of curves agrees with another.
struct Agreement {
    length: f64,
    /// The length within each tolerance.
    within: Vec<f64>,
    /// The distance, integrated over the length.
    integral: f64,
    largest: f64,
}

impl Agreement {
    fn new<const D: usize>(
        curves: &CurveSet<D>,
        others: &CurveSet<D>,
        tolerances: &[f64],
        view: Option<&Mask<D>>,
    ) -> Self {
        let slack = SLACK * curves.spacing.into_iter().fold(f64::INFINITY, f64::min);
        let nearest = Nearest::new(others.segments());
        let within = vec![0.0; tolerances.len()];
        let mut sums = Self { length: 0.0, within, integral: 0.0, largest: 0.0 };
        for (middle, length) in curves.elements(view) {
            let distance = nearest.distance(middle);
            sums.length += length;
            sums.integral += length * distance;
            sums.largest = sums.largest.max(distance);
            for (within, tolerance) in sums.within.iter_mut().zip(tolerances) {
                *within += if distance <= tolerance + slack { length } else { 0.0 };
            }
        }
        sums
    }

    fn part(&self, tolerance: usize) -> f64 {
        if self.length > 0.0 { self.within[tolerance] / self.length } else { 1.0 }
    }

    fn separation(&self) -> Separation {
        let mean = if self.length > 0.0 { self.integral / self.length } else { 0.0 };
        Separation { mean, largest: self.largest }
    }
}
