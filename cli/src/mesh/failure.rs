//! Exit codes for what goes wrong on meshes.

use crate::failure::Failure;
use heatpath_core::linear::LinearError;
use heatpath_core::mesh::distance::{EikonalError, ExactError, HeatMethodError};
use heatpath_core::mesh::heat::HeatError;
use heatpath_core::mesh::path::{ChainError, ValuesError};
use heatpath_core::mesh::{CurvatureError, GeodesicsError, MediumError, PointError};

impl From<PointError> for Failure {
    fn from(error: PointError) -> Self {
        Self::bad_input(error)
    }
}

impl From<MediumError> for Failure {
    fn from(error: MediumError) -> Self {
        match error {
            MediumError::Parameter(_) => Self::usage(error),
            _ => Self::bad_input(error),
        }
    }
}

impl From<CurvatureError> for Failure {
    fn from(error: CurvatureError) -> Self {
        match error {
            CurvatureError::Parameter(_) => Self::usage(error),
            CurvatureError::Cancelled(_) => Self::interrupted(),
        }
    }
}

impl From<HeatMethodError> for Failure {
    fn from(error: HeatMethodError) -> Self {
        match error {
            HeatMethodError::Parameter(_) => Self::usage(error),
            HeatMethodError::Linear(LinearError::TooLarge { .. }) => Self::bad_input(format!(
                "{error}; --memory allows more, `--method eikonal` needs none"
            )),
            HeatMethodError::Linear(LinearError::Cancelled(_)) | HeatMethodError::Cancelled(_) => {
                Self::interrupted()
            }
            HeatMethodError::Linear(_) => Self::no_answer(error),
            HeatMethodError::Point(error) => error.into(),
        }
    }
}

impl From<ExactError> for Failure {
    fn from(error: ExactError) -> Self {
        match error {
            ExactError::Cancelled(_) => Self::interrupted(),
            ExactError::Windows { .. } => Self::no_answer(error),
            ExactError::Slowness { .. } => {
                Self::usage(format!("{error}; `--method eikonal` takes any medium"))
            }
            _ => Self::usage(error),
        }
    }
}

impl From<EikonalError> for Failure {
    fn from(error: EikonalError) -> Self {
        match error {
            EikonalError::Parameter(_) => Self::usage(error),
            EikonalError::Cancelled(_) => Self::interrupted(),
        }
    }
}

impl From<GeodesicsError> for Failure {
    fn from(error: GeodesicsError) -> Self {
        match error {
            GeodesicsError::Parameter(_) => Self::usage(error),
            GeodesicsError::Heat(error) => error.into(),
            GeodesicsError::Eikonal(error) => error.into(),
            GeodesicsError::Exact(error) => error.into(),
            GeodesicsError::Explicit(error) => error.into(),
            GeodesicsError::Point(error) => error.into(),
            GeodesicsError::Values(error) => error.into(),
            GeodesicsError::Cancelled(_) => Self::interrupted(),
        }
    }
}

impl From<HeatError> for Failure {
    fn from(error: HeatError) -> Self {
        match error {
            HeatError::Cancelled(_) => Self::interrupted(),
            HeatError::StepTooLarge { .. } => {
                Self::bad_input(format!("{error}; without --step a stable one is taken"))
            }
            HeatError::Parameter(_) => Self::usage(error),
        }
    }
}

impl From<ValuesError> for Failure {
    fn from(error: ValuesError) -> Self {
        Self::no_answer(error)
    }
}

impl From<ChainError> for Failure {
    fn from(error: ChainError) -> Self {
        Self::no_answer(error)
    }
}
