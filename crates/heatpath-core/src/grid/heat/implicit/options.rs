//! What can be chosen, and why it cannot be done.

use super::super::operator::FaceMean;
use crate::exec::Cancelled;
use crate::linear::LinearError;
use thiserror::Error;

/// The parameters of [`Implicit`](super::Implicit).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImplicitOptions {
    /// How long heat flows, in cell units (multiples of the smallest spacing squared). Above 0, at
    /// most [a thousand million](ImplicitError::TooLong) times the largest stable step of explicit
    /// heat; default [`DEFAULT_TIME`](Self::DEFAULT_TIME), 16.
    ///
    /// Heat decays by e every `sqrt(time k D)` cells. Longer times make distances more exact in the
    /// open: they are too short by `1 / (24 time k D)` along the axes. Shorter times feel borders,
    /// walls and changes of the medium less far. For structures of width w take at most `w^2`.
    pub time: f64,
    /// The number of steps that the time is divided into. From 1 to 1000; default 1.
    pub steps: usize,
    /// How the diffusion coefficient of a face is made from its two cells, where it is a number.
    pub face_mean: FaceMean,
    /// The most memory that the factorisation may take, in bytes; default 4 GiB.
    pub memory_limit: usize,
}

impl ImplicitOptions {
    /// The default time: in a uniform medium distances beyond ten cells are right to 0.4 %, and
    /// borders are felt over four cells.
    pub const DEFAULT_TIME: f64 = 16.0;
}

impl Default for ImplicitOptions {
    fn default() -> Self {
        Self {
            time: Self::DEFAULT_TIME,
            steps: 1,
            face_mean: FaceMean::default(),
            memory_limit: 4 << 30,
        }
    }
}

/// The most steps that make sense: beyond them explicit heat is faster.
const MOST_STEPS: usize = 1000;

/// The longest step over the largest stable one of explicit heat: as many times larger are the
/// rounding errors.
const LONGEST_STEP: f64 = 1e9;

/// Why implicit heat cannot flow as asked.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ImplicitError {
    /// The time is not a positive number.
    #[error("the time is {0}; it must be a positive finite number")]
    Time(f64),
    /// The time is so long that rounding would spoil the heat.
    #[error("the time {time} is too long for this medium; at most {longest} is possible")]
    TooLong {
        /// The time asked for, in cell units.
        time: f64,
        /// The longest possible, in cell units.
        longest: f64,
    },
    /// There are no steps, or more than make sense.
    #[error("the number of steps is {0}; it must be from 1 to 1000")]
    Steps(usize),
    /// The grid is too large to factor.
    #[error("{0}; a larger grid than that needs explicit heat, which takes some 50 bytes a cell")]
    TooLarge(LinearError),
    /// The system cannot be solved.
    #[error(transparent)]
    Linear(LinearError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The length of a step, if it makes sense in a medium with this largest stable explicit step.
pub(super) fn step(time: f64, steps: usize, largest_stable: f64) -> Result<f64, ImplicitError> {
    if !(1..=MOST_STEPS).contains(&steps) {
        return Err(ImplicitError::Steps(steps));
    }
    if !(time.is_finite() && time > 0.0) {
        return Err(ImplicitError::Time(time));
    }
    let (step, longest) = (time / steps as f64, LONGEST_STEP * largest_stable);
    if step > longest {
        return Err(ImplicitError::TooLong { time, longest: longest * steps as f64 });
    }
    Ok(step)
}

pub(super) fn explained(error: LinearError) -> ImplicitError {
    match error {
        LinearError::Cancelled(cancelled) => ImplicitError::Cancelled(cancelled),
        LinearError::TooLarge { .. } | LinearError::OutOfMemory(_) => {
            ImplicitError::TooLarge(error)
        }
        error => ImplicitError::Linear(error),
    }
}
