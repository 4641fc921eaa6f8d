//! What the heat sees: `k(x)` and `D(x)` of `u_t = k div(D grad u)` (Yang & Cohen, eq. 2).
//!
//! A medium fixes the metric. By Varadhan's theorem the heat measures length by `ds / sqrt(k D)`:
//! where `k D` is large, heat is fast and distances are short. A solver that is to be compared
//! with it, such as fast marching, must be given the speed `sqrt(k D)`.

mod combined;
mod conductivity;
mod edges;
mod given;
mod perona_malik;
mod uniform;

pub use combined::combined;
pub use conductivity::{ConductivityOptions, conductivity};
pub use edges::{EdgesOptions, edges};
pub use given::{GIVEN_RANGE, given};
pub use perona_malik::{EdgeStop, PeronaMalikOptions, SMALLEST_DIFFUSION, perona_malik};
pub use uniform::uniform;

use super::filter::SigmaError;
use super::{Grid, Mask, NotFinite, Shape};
use std::borrow::Cow;
use thiserror::Error;

/// A medium through which heat flows.
#[derive(Clone, Debug)]
pub struct Medium<const D: usize> {
    factor: Option<Grid<f64, D>>,
    diffusion: Option<Grid<f64, D>>,
    mask: Mask<D>,
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
    /// A parameter is outside its range.
    #[error("{name} is {value}; it must be {range}")]
    Parameter {
        /// The parameter's name.
        name: &'static str,
        /// The rejected value.
        value: f64,
        /// What would be right.
        range: &'static str,
    },
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

    /// The diffusion coefficient D inside the divergence; `None` stands for 1 everywhere.
    #[must_use]
    pub fn diffusion(&self) -> Option<&Grid<f64, D>> {
        self.diffusion.as_ref()
    }

    /// The squared speed `k D` in the cell at `position`: lengths are `ds / sqrt(k D)`.
    #[must_use]
    pub fn speed_sq(&self, position: usize) -> f64 {
        let at =
            |field: &Option<Grid<f64, D>>| field.as_ref().map_or(1.0, |f| f.values()[position]);
        at(&self.factor) * at(&self.diffusion)
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
            Form::Divergence => Self { factor: None, diffusion: Some(field), mask },
            Form::Pointwise => Self { factor: Some(field), diffusion: None, mask },
        }
    }
}

/// Checks that a parameter is a positive finite number.
fn check_positive(name: &'static str, value: f64) -> Result<(), MediumError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(MediumError::Parameter { name, value, range: "a positive finite number" })
    }
}
