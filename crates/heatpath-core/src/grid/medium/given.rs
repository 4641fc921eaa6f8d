//! Any positive field, of numbers or of tensors.

use super::{Diffusion, Form, Medium, MediumError};
use crate::grid::tensor::determinant;
use crate::grid::{Grid, Mask, Matrix, TensorField};
use std::ops::RangeInclusive;

/// The values that a given field may have: beyond them products and quotients leave the range of
/// floating point.
pub const GIVEN_RANGE: RangeInclusive<f64> = 1e-100..=1e100;

/// The medium of a given positive field: lengths are `ds / sqrt(field)`.
///
/// A cost `c` per unit length, as fast marching takes it, is the field `1 / c^2`. For distances take
/// [`Form::Pointwise`]: in two dimensions `k laplace(u)` is the heat of the metric itself, while
/// [`Form::Divergence`] adds a drift that shifts `log u` by `log(D) / 2` from place to place.
///
/// # Errors
/// A value that is not finite, not positive or outside [`GIVEN_RANGE`]; the first such cell is
/// named.
pub fn given<const D: usize>(field: Grid<f64, D>, form: Form) -> Result<Medium<D>, MediumError> {
    field.check_finite()?;
    match field.values().iter().position(|value| !GIVEN_RANGE.contains(value)) {
        Some(position) => Err(MediumError::GivenValue {
            index: field.shape().index(position).to_vec(),
            value: field.values()[position],
        }),
        None => Ok(Medium::from_field(field, form)),
    }
}

/// The medium of a given diffusion tensor: `u_t = div(D grad u)` (eq. 12), lengths are
/// `sqrt(dx' D^-1 dx)`.
///
/// `field` is the diffusion tensor D: heat is fast, and distances are short, along its eigenvectors
/// of large eigenvalues. A metric tensor M, as Riemannian fast marching takes it, is the field of its
/// inverses.
///
/// # Errors
/// A matrix that is not finite, not positive definite or beyond [`GIVEN_RANGE`]; the first such cell
/// is named.
pub fn given_tensor<const D: usize>(field: TensorField<D>) -> Result<Medium<D>, MediumError> {
    let shape = *field.shape();
    match (0..shape.cells()).find(|&cell| !is_positive_definite(&field.at(cell))) {
        Some(cell) => Err(MediumError::GivenTensor {
            index: shape.index(cell).to_vec(),
            value: field.at(cell).iter().map(|row| row.to_vec()).collect(),
        }),
        None => Ok(Medium {
            factor: None,
            diffusion: Diffusion::Tensor(field),
            mask: Mask::all_open(shape),
        }),
    }
}

/// Whether every leading minor of the matrix over its size is positive (Sylvester's criterion), and
/// its diagonal within [`GIVEN_RANGE`].
fn is_positive_definite<const D: usize>(matrix: &Matrix<D>) -> bool {
    let in_range = (0..D).all(|axis| GIVEN_RANGE.contains(&matrix[axis][axis]));
    let size: f64 = (0..D).map(|axis| matrix[axis][axis]).sum();
    let m = matrix.map(|row| row.map(|component| component / size));
    let minor = |a: usize, b: usize| m[a][a] * m[b][b] - m[a][b] * m[a][b];
    let determinant = determinant(&m);
    in_range && (D < 2 || minor(0, 1) > 0.0) && determinant.is_finite() && determinant > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn tensors_must_be_positive_definite() {
        let shape = Shape::new([2, 1]).unwrap();
        let of = |components: [f64; 6]| {
            given_tensor(TensorField::from_components(shape, components.to_vec()).unwrap())
        };
        let medium = of([1.0, 0.0, 1.0, 4.0, 1.0, 9.0]).unwrap();
        assert!((medium.speed_sq(1) - 35.0_f64.sqrt()).abs() < 1e-14);
        assert_eq!(medium.speed_sq_tensor(1), [[4.0, 1.0], [1.0, 9.0]]);
        for bad in [[1.0, 1.0, 1.0], [1.0, 2.0, 1.0], [-1.0, 0.0, 1.0], [1.0, f64::NAN, 1.0]] {
            let error = of([1.0, 0.0, 1.0, bad[0], bad[1], bad[2]]).unwrap_err();
            assert!(matches!(error, MediumError::GivenTensor { index, .. } if index == [1, 0]));
        }
    }
}
