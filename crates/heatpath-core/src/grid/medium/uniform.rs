//! Equation (1): the same everywhere.

use super::{Diffusion, Medium};
use crate::grid::{Mask, Shape};

/// The uniform medium `u_t = laplace(u)` (eq. 1): distances are Euclidean.
#[must_use]
pub fn uniform<const D: usize>(shape: Shape<D>) -> Medium<D> {
    Medium { factor: None, diffusion: Diffusion::Uniform, mask: Mask::all_open(shape) }
}
