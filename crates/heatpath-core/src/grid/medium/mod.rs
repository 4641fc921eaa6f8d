//! What the heat sees: `k(x)` and `D(x)` of `u_t = k div(D grad u)` (Yang & Cohen, eq. 2).
//!
//! A medium fixes the metric. By Varadhan's theorem the heat measures length by `ds / sqrt(k D)`:
//! where `k D` is large, heat is fast and distances are short. A solver that is to be compared
//! with it, such as fast marching, must be given the speed `sqrt(k D)`.

mod combined;
mod conductivity;
mod cropped;
mod edges;
mod given;
mod perona_malik;
mod tensor;
mod uniform;
mod vesselness;

pub use combined::combined;
pub use conductivity::{ConductivityOptions, conductivity};
pub use edges::{EdgesOptions, edges};
pub use given::{GIVEN_RANGE, given, given_tensor};
pub use perona_malik::{EdgeStop, PeronaMalikOptions, SMALLEST_DIFFUSION, perona_malik};
pub use tensor::{Directions, MOST_ANISOTROPY, TensorOptions, tensor};
pub use uniform::uniform;
pub use vesselness::{VesselnessOptions, vesselness};

use super::filter::{FilterError, SigmaError};
use super::source::shares;
use super::tensor::{determinant, inverse, length};
use super::{Grid, Mask, Matrix, NotFinite, Shape, TensorField};
use crate::error::ParameterError;
use crate::exec::Cancelled;
use std::borrow::Cow;
use thiserror::Error;

/// A medium through which heat flows.
#[derive(Clone, Debug)]
pub struct Medium<const D: usize> {
    factor: Option<Grid<f64, D>>,
    diffusion: Diffusion<D>,
    mask: Mask<D>,
}

/// The diffusion coefficient D inside the divergence.
#[derive(Clone, Debug)]
pub enum Diffusion<const D: usize> {
    /// 1 everywhere.
    Uniform,
    /// A positive number per cell: heat flows alike in all directions.
    Scalar(Grid<f64, D>),
    /// A symmetric positive definite matrix per cell (eq. 12): the diffusion tensor, which is the
    /// inverse of the metric tensor.
    Tensor(TensorField<D>),
}

impl<const D: usize> Diffusion<D> {
    /// The number of each cell, if it is a [`Scalar`](Self::Scalar) field.
    #[must_use]
    pub fn scalar(&self) -> Option<&Grid<f64, D>> {
        if let Self::Scalar(field) = self { Some(field) } else { None }
    }

    /// The matrix of each cell, if it is a [`Tensor`](Self::Tensor) field.
    #[must_use]
    pub fn tensor(&self) -> Option<&TensorField<D>> {
        if let Self::Tensor(field) = self { Some(field) } else { None }
    }
}

impl<const D: usize> From<Medium<D>> for Cow<'_, Medium<D>> {
    fn from(medium: Medium<D>) -> Self {
        Self::Owned(medium)
    }
}

impl<'a, const D: usize> From<&'a Medium<D>> for Cow<'a, Medium<D>> {
    fn from(medium: &'a Medium<D>) -> Self {
        Self::Borrowed(medium)
    }
}

/// Where a field stands in `u_t = k div(D grad u)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Inside the divergence, as D: heat is conserved. Written out this is eq. (9), with its
    /// gradient term `grad D . grad u`.
    #[default]
    Divergence,
    /// In front, as k: `u_t = k laplace(u)`, which is eq. (9) without its gradient term.
    Pointwise,
}

/// Why a medium cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MediumError {
    /// A value of the picture or field is infinite or not a number.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// A given field is zero, negative or absurd somewhere.
    #[error(
        "the given field is {value} at {index:?}; a medium must be positive everywhere, from 1e-100 \
         to 1e100 (use a mask for walls)"
    )]
    GivenValue {
        /// The index of the first such cell.
        index: Vec<usize>,
        /// Its value.
        value: f64,
    },
    /// A given tensor is not positive definite somewhere, or absurd.
    #[error(
        "the given tensor is {value:?} at {index:?}; it must be symmetric and positive definite \
         everywhere, with eigenvalues from 1e-100 to 1e100 (use a mask for walls)"
    )]
    GivenTensor {
        /// The index of the first such cell.
        index: Vec<usize>,
        /// Its rows.
        value: Vec<Vec<f64>>,
    },
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The smoothing before derivatives makes no sense.
    #[error(transparent)]
    Smoothing(#[from] SigmaError),
    /// The mask is for another grid.
    #[error("the mask has {mask:?} cells but the image has {image:?}")]
    MaskSize {
        /// The mask's cells along each axis.
        mask: Vec<usize>,
        /// The image's cells along each axis.
        image: Vec<usize>,
    },
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<FilterError> for MediumError {
    fn from(error: FilterError) -> Self {
        match error {
            FilterError::NotFinite(error) => error.into(),
            FilterError::Sigma(error) => error.into(),
            FilterError::Parameter(error) => error.into(),
            FilterError::MaskSize { mask, image } => Self::MaskSize { mask, image },
            FilterError::Cancelled(error) => error.into(),
        }
    }
}

impl<const D: usize> Medium<D> {
    /// The same medium with walls: heat neither enters nor crosses the closed cells of `mask`.
    ///
    /// # Errors
    /// The mask is for a grid of another size.
    pub fn with_walls(mut self, mask: Mask<D>) -> Result<Self, MediumError> {
        let (given, expected) = (mask.shape().size(), self.shape().size());
        if given != expected {
            return Err(MediumError::MaskSize { mask: given.to_vec(), image: expected.to_vec() });
        }
        // The mask's file may not know the spacing; the image's counts.
        self.mask = mask.with_spacing_of(self.shape());
        Ok(self)
    }

    /// The size and spacing.
    #[must_use]
    pub fn shape(&self) -> &Shape<D> {
        self.mask.shape()
    }

    /// Which cells are open.
    #[must_use]
    pub fn mask(&self) -> &Mask<D> {
        &self.mask
    }

    /// The factor k in front of the divergence; `None` stands for 1 everywhere.
    #[must_use]
    pub fn factor(&self) -> Option<&Grid<f64, D>> {
        self.factor.as_ref()
    }

    /// The diffusion coefficient D inside the divergence.
    #[must_use]
    pub fn diffusion(&self) -> &Diffusion<D> {
        &self.diffusion
    }

    /// The squared speed `k D` in the cell at `position`: lengths are `ds / sqrt(k D)`.
    ///
    /// Of a tensor it is the geometric mean over its principal directions, `k det(D)^(1/N)`.
    #[must_use]
    pub fn speed_sq(&self, position: usize) -> f64 {
        self.factor_at(position)
            * match &self.diffusion {
                Diffusion::Uniform => 1.0,
                Diffusion::Scalar(field) => field.values()[position],
                Diffusion::Tensor(field) => determinant(&field.at(position)).powf(1.0 / D as f64),
            }
    }

    /// The matrix `k D` in the cell at `position`: lengths are `sqrt(dx' (k D)^-1 dx)`.
    #[must_use]
    pub fn speed_sq_tensor(&self, position: usize) -> Matrix<D> {
        let factor = self.factor_at(position);
        if let Diffusion::Tensor(field) = &self.diffusion {
            return field.at(position).map(|row| row.map(|component| factor * component));
        }
        let speed_sq = self.speed_sq(position);
        let mut matrix = [[0.0; D]; D];
        (0..D).for_each(|axis| matrix[axis][axis] = speed_sq);
        matrix
    }

    /// The length of a polyline (pixel coordinates) in the metric of the medium,
    /// `integral of sqrt(dx' (k D)^-1 dx)` in physical units: what it costs to go along it.
    ///
    /// The midpoint rule over pieces of at most a quarter of a pixel, in which k D is interpolated
    /// linearly between the open cells around. Infinite through walls.
    #[must_use]
    pub fn cost(&self, points: &[[f64; D]]) -> f64 {
        points.windows(2).fold(0.0, |sum, pair| sum + self.cost_of_segment(pair[0], pair[1]))
    }

    fn cost_of_segment(&self, from: [f64; D], to: [f64; D]) -> f64 {
        let shape = self.shape();
        let pieces = (4.0 * shape.unit_spacing().physical_distance(from, to)).ceil().max(1.0);
        let step: [f64; D] = std::array::from_fn(|axis| (to[axis] - from[axis]) / pieces);
        let physical = std::array::from_fn(|axis| step[axis] * shape.spacing()[axis]);
        let cost_of_piece = |number: usize| {
            let middle =
                std::array::from_fn(|axis| from[axis] + (number as f64 + 0.5) * step[axis]);
            self.metric_between(middle).map_or(f64::INFINITY, |metric| length(&metric, physical))
        };
        (0..pieces as usize).map(cost_of_piece).sum()
    }

    /// The metric at a point between cells; `None` in walls.
    fn metric_between(&self, point: [f64; D]) -> Option<Matrix<D>> {
        let shares = shares(&self.mask, point);
        let mut speed_sq = [[0.0; D]; D];
        for &(cell, weight) in &shares {
            let there = self.speed_sq_tensor(cell);
            (0..D).for_each(|i| (0..D).for_each(|j| speed_sq[i][j] += weight * there[i][j]));
        }
        (!shares.is_empty()).then(|| inverse(&speed_sq))
    }

    fn factor_at(&self, position: usize) -> f64 {
        self.factor.as_ref().map_or(1.0, |factor| factor.values()[position])
    }

    /// The squared speed `k D` of every cell, 0 in walls: a picture of what the heat sees.
    #[must_use]
    pub fn speed_sq_field(&self) -> Grid<f64, D> {
        let shape = *self.shape();
        Grid::from_fn(shape, |index| {
            let position = shape.position(index);
            if self.mask.is_open(position) { self.speed_sq(position) } else { 0.0 }
        })
    }

    /// A medium of one positive field in the given form, without walls.
    fn from_field(field: Grid<f64, D>, form: Form) -> Self {
        let mask = Mask::all_open(*field.shape());
        match form {
            Form::Divergence => Self { factor: None, diffusion: Diffusion::Scalar(field), mask },
            Form::Pointwise => Self { factor: Some(field), diffusion: Diffusion::Uniform, mask },
        }
    }
}
