//! What the engine refuses, as failures.

use crate::status::{
    Failure, HP_INVALID_ARGUMENT, HP_INVALID_BUFFER, HP_INVALID_IMAGE, HP_INVALID_MESH,
    HP_INVALID_POINT, HP_OUT_OF_MEMORY, HP_RANGE, HP_UNSTABLE_STEP,
};
use heatpath_core::linear::LinearError;
use heatpath_core::mesh::clean::CleanError;
use heatpath_core::mesh::distance::{EikonalError, ExactError, HeatMethodError};
use heatpath_core::mesh::heat::HeatError;
use heatpath_core::mesh::path::{ChainError, ValuesError};
use heatpath_core::mesh::{CurvatureError, GeodesicsError, MediumError, MeshError, PointError};

impl From<MeshError> for Failure {
    fn from(error: MeshError) -> Self {
        Self::new(HP_INVALID_MESH, error.to_string())
    }
}

impl From<CleanError> for Failure {
    fn from(error: CleanError) -> Self {
        let status = match error {
            CleanError::Mesh(_) | CleanError::Corners { .. } => HP_INVALID_MESH,
            CleanError::Parameter(_) => HP_INVALID_ARGUMENT,
        };
        Self::new(status, error.to_string())
    }
}

impl From<PointError> for Failure {
    fn from(error: PointError) -> Self {
        Self::new(HP_INVALID_POINT, error.to_string())
    }
}

impl From<MediumError> for Failure {
    fn from(error: MediumError) -> Self {
        let status = match error {
            MediumError::Length { .. } => HP_INVALID_BUFFER,
            MediumError::Parameter(_) => HP_INVALID_ARGUMENT,
            MediumError::Point => HP_INVALID_MESH,
            MediumError::Value { .. }
            | MediumError::Metric { .. }
            | MediumError::Cost { .. }
            | MediumError::Direction { .. } => HP_INVALID_IMAGE,
        };
        Self::new(status, error.to_string())
    }
}

impl From<CurvatureError> for Failure {
    fn from(error: CurvatureError) -> Self {
        match error {
            CurvatureError::Parameter(error) => Self::argument(error.to_string()),
            CurvatureError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<GeodesicsError> for Failure {
    fn from(error: GeodesicsError) -> Self {
        match error {
            GeodesicsError::Parameter(error) => Self::argument(error.to_string()),
            GeodesicsError::Heat(error) => error.into(),
            GeodesicsError::Eikonal(error) => error.into(),
            GeodesicsError::Exact(error) => error.into(),
            GeodesicsError::Explicit(error) => error.into(),
            GeodesicsError::Point(error) => error.into(),
            GeodesicsError::Values(error) => error.into(),
            GeodesicsError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<HeatMethodError> for Failure {
    fn from(error: HeatMethodError) -> Self {
        match error {
            HeatMethodError::Parameter(error) => Self::argument(error.to_string()),
            HeatMethodError::Linear(error) => error.into(),
            HeatMethodError::Point(error) => error.into(),
            HeatMethodError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<LinearError> for Failure {
    fn from(error: LinearError) -> Self {
        let status = match error {
            LinearError::TooLarge { .. } | LinearError::OutOfMemory(_) => HP_OUT_OF_MEMORY,
            LinearError::Cancelled(cancelled) => return cancelled.into(),
            LinearError::Coupling { .. }
            | LinearError::Length { .. }
            | LinearError::NotPositiveDefinite(_) => HP_RANGE,
        };
        Self::new(status, error.to_string())
    }
}

impl From<EikonalError> for Failure {
    fn from(error: EikonalError) -> Self {
        match error {
            EikonalError::Parameter(error) => Self::argument(error.to_string()),
            EikonalError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<ExactError> for Failure {
    fn from(error: ExactError) -> Self {
        match error {
            ExactError::Slowness { .. } | ExactError::Parameter(_) => {
                Self::argument(error.to_string())
            }
            ExactError::Windows { .. } => Self::new(HP_INVALID_MESH, error.to_string()),
            ExactError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<HeatError> for Failure {
    fn from(error: HeatError) -> Self {
        match error {
            HeatError::StepTooLarge { .. } => Self::new(HP_UNSTABLE_STEP, error.to_string()),
            HeatError::Parameter(error) => Self::argument(error.to_string()),
            HeatError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<ValuesError> for Failure {
    fn from(error: ValuesError) -> Self {
        let status = match error {
            ValuesError::Count { .. } => HP_INVALID_BUFFER,
            ValuesError::NotANumber { .. } => HP_INVALID_IMAGE,
        };
        Self::new(status, error.to_string())
    }
}

impl From<ChainError> for Failure {
    fn from(error: ChainError) -> Self {
        Self::new(HP_INVALID_POINT, error.to_string())
    }
}
