//! What went wrong, and the exit code for it.

use clap::error::ErrorKind;
use heatpath_core::evaluation::EvaluationError;
use heatpath_core::exec::ThreadsError;
use heatpath_core::grid::distance::{EikonalError, HeatMethodError};
use heatpath_core::grid::heat::{HeatError, ImplicitError, NoExposure};
use heatpath_core::grid::keypoints::KeyPointError;
use heatpath_core::grid::medium::MediumError;
use heatpath_core::grid::voting::VotingError;
use heatpath_core::grid::{PointError, ShapeError, StructureError};
use heatpath_io::{ReadError, WriteError};
use std::fmt;

/// A reason to stop, told in one line.
#[derive(Debug)]
pub struct Failure {
    code: u8,
    message: String,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Usage = 2,
    BadInput = 3,
    File = 4,
    NoAnswer = 5,
    Interrupted = 130,
}

impl Failure {
    /// The command line asks for what cannot be.
    pub(crate) fn usage(message: impl fmt::Display) -> Self {
        Self::new(Kind::Usage, &message)
    }

    /// The input cannot be used.
    pub(crate) fn bad_input(message: impl fmt::Display) -> Self {
        Self::new(Kind::BadInput, &message)
    }

    /// A file cannot be read or written.
    pub(crate) fn file(message: impl fmt::Display) -> Self {
        Self::new(Kind::File, &message)
    }

    /// There is no answer, or only a part of it.
    pub(crate) fn no_answer(message: impl fmt::Display) -> Self {
        Self::new(Kind::NoAnswer, &message)
    }

    /// Somebody asked to stop.
    pub(crate) fn interrupted() -> Self {
        Self::new(Kind::Interrupted, &"interrupted")
    }

    /// Rows of a batch have failed: 10 more than how many, 110 for a hundred and more.
    pub(crate) fn rows(failed: usize, message: impl fmt::Display) -> Self {
        Self { code: 10 + failed.min(100) as u8, message: message.to_string() }
    }

    fn new(kind: Kind, message: &dyn fmt::Display) -> Self {
        Self { code: kind as u8, message: message.to_string() }
    }

    /// The exit code for it.
    #[must_use]
    pub fn code(&self) -> u8 {
        self.code
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.message)
    }
}

/// What the parser of command lines says, without how the command is used.
pub(crate) fn in_one_line(error: &clap::Error) -> String {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        return "asks for help".to_owned();
    }
    let text = error.to_string();
    let lines = text.lines().take_while(|line| !line.starts_with("Usage:"));
    let words = lines
        .filter(|line| !line.starts_with("For more information"))
        .flat_map(str::split_whitespace);
    let line = words.collect::<Vec<_>>().join(" ");
    line.strip_prefix("error: ").map_or(line.clone(), str::to_owned)
}

impl From<clap::Error> for Failure {
    fn from(error: clap::Error) -> Self {
        Self::usage(in_one_line(&error))
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        if error.is_access() { Self::file(error) } else { Self::bad_input(error) }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::Ending { .. } | WriteError::Volume { .. } => Self::usage(error),
            WriteError::Exists { .. } => Self::file(format!("{error}; --force overwrites it")),
            _ => Self::file(error),
        }
    }
}

impl From<ShapeError> for Failure {
    fn from(error: ShapeError) -> Self {
        Self::usage(error)
    }
}

impl From<MediumError> for Failure {
    fn from(error: MediumError) -> Self {
        match error {
            MediumError::Parameter { .. } | MediumError::Smoothing(_) => Self::usage(error),
            MediumError::Cancelled(_) => Self::interrupted(),
            _ => Self::bad_input(error),
        }
    }
}

impl From<PointError> for Failure {
    fn from(error: PointError) -> Self {
        Self::bad_input(error)
    }
}

impl From<NoExposure> for Failure {
    fn from(error: NoExposure) -> Self {
        Self::no_answer(error)
    }
}

impl From<HeatError> for Failure {
    fn from(error: HeatError) -> Self {
        match error {
            HeatError::Cancelled(_) => Self::interrupted(),
            HeatError::Range => Self::no_answer(error),
            HeatError::StepTooLarge { .. } => {
                Self::bad_input(format!("{error}; `--step auto` chooses one"))
            }
            _ => Self::usage(error),
        }
    }
}

impl From<ImplicitError> for Failure {
    fn from(error: ImplicitError) -> Self {
        match error {
            ImplicitError::Cancelled(_) => Self::interrupted(),
            ImplicitError::TooLarge(_) => {
                Self::bad_input(format!("{error}: `--solver explicit`; --memory allows more"))
            }
            ImplicitError::Linear(_) => Self::no_answer(error),
            _ => Self::usage(error),
        }
    }
}

impl From<EikonalError> for Failure {
    fn from(error: EikonalError) -> Self {
        match error {
            EikonalError::Cancelled(_) => Self::interrupted(),
            EikonalError::Target(error) => error.into(),
            EikonalError::TooLarge { .. } => Self::bad_input(error),
            EikonalError::InitialCount { .. }
            | EikonalError::Initial { .. }
            | EikonalError::Farthest(_) => Self::usage(error),
        }
    }
}

impl From<HeatMethodError> for Failure {
    fn from(error: HeatMethodError) -> Self {
        match error {
            HeatMethodError::Implicit(error) => error.into(),
            HeatMethodError::Medium(error) => error.into(),
            HeatMethodError::Point(error) => error.into(),
            HeatMethodError::Cancelled(_) => Self::interrupted(),
            HeatMethodError::Tensor => Self::usage(error),
        }
    }
}

impl From<EvaluationError> for Failure {
    fn from(error: EvaluationError) -> Self {
        match error {
            EvaluationError::Tolerance { .. } | EvaluationError::Shape(_) => Self::usage(error),
            _ => Self::bad_input(error),
        }
    }
}

impl From<StructureError> for Failure {
    fn from(error: StructureError) -> Self {
        match error {
            StructureError::Point(error) => error.into(),
            StructureError::None => Self::no_answer(format!("{error} (--medium)")),
            StructureError::Short { .. } => {
                Self::no_answer(format!("{error} (--source, --extent, --structure)"))
            }
        }
    }
}

impl From<VotingError> for Failure {
    fn from(error: VotingError) -> Self {
        match error {
            VotingError::Heat(error) => error.into(),
            VotingError::Eikonal(error) => error.into(),
            VotingError::End(error) => error.into(),
            VotingError::Cancelled(_) => Self::interrupted(),
            VotingError::Parameter { .. } => Self::usage(error),
        }
    }
}

impl From<KeyPointError> for Failure {
    fn from(error: KeyPointError) -> Self {
        match error {
            KeyPointError::Heat(error) => error.into(),
            KeyPointError::Eikonal(error) => error.into(),
            KeyPointError::Point(error) => error.into(),
            KeyPointError::Cancelled(_) => Self::interrupted(),
            KeyPointError::Parameter { .. } => Self::usage(error),
        }
    }
}

impl From<ThreadsError> for Failure {
    fn from(error: ThreadsError) -> Self {
        Self::usage(error)
    }
}
