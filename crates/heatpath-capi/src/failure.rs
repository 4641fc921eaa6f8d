//! What the engine refuses on images and volumes, as failures.

use crate::status::{
    Failure, HP_CANCELLED, HP_INVALID_ARGUMENT, HP_INVALID_BUFFER, HP_INVALID_IMAGE,
    HP_INVALID_POINT, HP_NO_ANSWER, HP_NO_THREADS, HP_OUT_OF_MEMORY, HP_PANIC, HP_RANGE,
    HP_UNSTABLE_STEP, HP_UNSUPPORTED,
};
use heatpath_core::evaluation::EvaluationError;
use heatpath_core::exec::{Cancelled, ThreadsError};
use heatpath_core::grid::StructureError;
use heatpath_core::grid::bridge::BridgeError;
use heatpath_core::grid::distance::EikonalError;
use heatpath_core::grid::distance::HeatMethodError;
use heatpath_core::grid::heat::{HeatError, ImplicitError, NoExposure};
use heatpath_core::grid::keypoints::KeyPointError;
use heatpath_core::grid::medium::MediumError;
use heatpath_core::grid::voting::VotingError;
use heatpath_core::grid::{NotFinite, PointError, ShapeError};

impl From<ShapeError> for Failure {
    fn from(error: ShapeError) -> Self {
        Self::new(HP_INVALID_BUFFER, error.to_string())
    }
}

impl From<NotFinite> for Failure {
    fn from(error: NotFinite) -> Self {
        Self::new(HP_INVALID_IMAGE, error.to_string())
    }
}

impl From<PointError> for Failure {
    fn from(error: PointError) -> Self {
        Self::new(HP_INVALID_POINT, error.to_string())
    }
}

impl From<ThreadsError> for Failure {
    fn from(error: ThreadsError) -> Self {
        Self::new(HP_NO_THREADS, error.to_string())
    }
}

impl From<MediumError> for Failure {
    fn from(error: MediumError) -> Self {
        let status = match error {
            MediumError::NotFinite(_)
            | MediumError::GivenValue { .. }
            | MediumError::GivenTensor { .. } => HP_INVALID_IMAGE,
            MediumError::Cancelled(cancelled) => return cancelled.into(),
            MediumError::MaskSize { .. } => HP_INVALID_BUFFER,
            MediumError::Parameter { .. } | MediumError::Smoothing(_) => HP_INVALID_ARGUMENT,
        };
        Self::new(status, error.to_string())
    }
}

impl From<Cancelled> for Failure {
    fn from(error: Cancelled) -> Self {
        Self::new(HP_CANCELLED, format!("{error} by the progress callback"))
    }
}

impl From<NoExposure> for Failure {
    fn from(error: NoExposure) -> Self {
        Self::new(HP_PANIC, error.to_string())
    }
}

impl From<HeatError> for Failure {
    fn from(error: HeatError) -> Self {
        let status = match error {
            HeatError::StepTooLarge { .. } => HP_UNSTABLE_STEP,
            HeatError::Range => HP_RANGE,
            HeatError::Cancelled(cancelled) => return cancelled.into(),
            HeatError::Step(_) | HeatError::Time(_) | HeatError::Iterations(_) => {
                HP_INVALID_ARGUMENT
            }
        };
        Self::new(status, error.to_string())
    }
}

impl From<ImplicitError> for Failure {
    fn from(error: ImplicitError) -> Self {
        let status = match error {
            ImplicitError::TooLarge(_) => HP_OUT_OF_MEMORY,
            ImplicitError::Cancelled(cancelled) => return cancelled.into(),
            ImplicitError::Time(_) | ImplicitError::TooLong { .. } | ImplicitError::Steps(_) => {
                HP_INVALID_ARGUMENT
            }
            ImplicitError::Linear(_) => HP_RANGE,
        };
        Self::new(status, error.to_string())
    }
}

impl From<EikonalError> for Failure {
    fn from(error: EikonalError) -> Self {
        let status = match error {
            EikonalError::TooLarge { .. } => HP_UNSUPPORTED,
            EikonalError::InitialCount { .. }
            | EikonalError::Initial { .. }
            | EikonalError::Farthest(_) => HP_INVALID_ARGUMENT,
            EikonalError::Target(error) => return error.into(),
            EikonalError::Cancelled(cancelled) => return cancelled.into(),
        };
        Self::new(status, error.to_string())
    }
}

impl From<HeatMethodError> for Failure {
    fn from(error: HeatMethodError) -> Self {
        match error {
            HeatMethodError::Tensor => Self::argument(error.to_string()),
            HeatMethodError::Implicit(error) => error.into(),
            HeatMethodError::Medium(error) => error.into(),
            HeatMethodError::Point(error) => error.into(),
            HeatMethodError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<BridgeError> for Failure {
    fn from(error: BridgeError) -> Self {
        let status = match error {
            BridgeError::NotReached => HP_NO_ANSWER,
            BridgeError::Size { .. } | BridgeError::NoExposure(_) => HP_PANIC,
        };
        Self::new(status, error.to_string())
    }
}

impl From<StructureError> for Failure {
    fn from(error: StructureError) -> Self {
        match error {
            StructureError::Point(error) => error.into(),
            StructureError::None | StructureError::Short { .. } => {
                Self::new(HP_NO_ANSWER, error.to_string())
            }
        }
    }
}

impl From<VotingError> for Failure {
    fn from(error: VotingError) -> Self {
        match error {
            VotingError::Parameter(error) => Self::argument(error.to_string()),
            VotingError::End(error) => error.into(),
            VotingError::Heat(error) => error.into(),
            VotingError::Eikonal(error) => error.into(),
            VotingError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<KeyPointError> for Failure {
    fn from(error: KeyPointError) -> Self {
        match error {
            KeyPointError::Parameter(error) => Self::argument(error.to_string()),
            KeyPointError::Point(error) => error.into(),
            KeyPointError::Heat(error) => error.into(),
            KeyPointError::Eikonal(error) => error.into(),
            KeyPointError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<EvaluationError> for Failure {
    fn from(error: EvaluationError) -> Self {
        let status = match error {
            EvaluationError::Tolerance { .. } => HP_INVALID_ARGUMENT,
            EvaluationError::Point { .. } => HP_INVALID_POINT,
            EvaluationError::TooLong { .. } => HP_UNSUPPORTED,
            EvaluationError::Sizes { .. } | EvaluationError::Spacings { .. } => HP_INVALID_BUFFER,
            EvaluationError::Shape(error) => return error.into(),
        };
        Self::new(status, error.to_string())
    }
}
