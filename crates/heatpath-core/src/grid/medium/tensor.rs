//! Equations (12) to (14): heat runs along the directions of the image.

use super::{Diffusion, Medium, MediumError};
use crate::error::{ParameterError, check};
use crate::exec::Exec;
use crate::grid::filter::{Polarity, QUIET, gaussian_gradient, hessian, rise, structure_tensor};
use crate::grid::{Grid, Mask, Matrix, TensorField, eigen};

/// The largest anisotropy: heat is then ten thousand times as fast along as across.
pub const MOST_ANISOTROPY: f64 = 0.9998;

/// Where the eigenvectors of eq. (13) come from. Widths are standard deviations in cell units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Directions {
    /// e1 is the direction of the gradient (figure 5), in which heat is held back; it runs along the
    /// curves or surfaces of equal grey value.
    Gradient {
        /// The Gaussian before the gradient, in cells; 0 is none.
        sigma: f64,
    },
    /// Heat runs along the eigenvector of the Hessian whose eigenvalue is smallest in size, which is
    /// the direction of a tube (figures 6 and 10).
    Hessian {
        /// The Gaussian before the second derivatives, in cells: about the half width of the tubes.
        sigma: f64,
        /// Which tubes: where the largest eigenvalue in size has the sign of other tubes, the tensor is
        /// isotropic. The paper takes both.
        polarity: Polarity,
    },
    /// Heat runs along the eigenvector of the structure tensor with the smallest eigenvalue: the
    /// direction of lines and texture (Weickert 1999).
    Structure {
        /// The Gaussian before the gradient, in cells; 0 is none.
        sigma: f64,
        /// The Gaussian over which directions are averaged, in cells.
        rho: f64,
    },
}

impl Default for Directions {
    fn default() -> Self {
        Self::Hessian { sigma: 2.0, polarity: Polarity::Both }
    }
}

/// The parameters of [`tensor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensorOptions {
    /// Where the eigenvectors come from; default the Hessian at 2 cells.
    pub directions: Directions,
    /// The anisotropy A of eq. (14): heat is `(1 + A) / (1 - A)` times as fast along as across, in
    /// `u_t`. From 0 to [`MOST_ANISOTROPY`]; default 0.9.
    pub anisotropy: f64,
    /// Whether the anisotropy falls to 0 where the image shows no direction. As in the paper it
    /// does not by default, and flat parts have the directions of their noise.
    ///
    /// With `s` the difference of the two eigenvalues that tell the direction, in size, or the
    /// length of the gradient, it is then `A (1 - exp(-s^2 / 2 c^2))` with c half of the largest s.
    pub fading: bool,
}

impl Default for TensorOptions {
    fn default() -> Self {
        Self { directions: Directions::default(), anisotropy: 0.9, fading: false }
    }
}

/// The anisotropic medium `u_t = div(D grad u)` with `D = l1 e1 e1' + l2 e2 e2'` (eqs. 12 and 13).
///
/// Along e2 heat is as fast as in the uniform medium, `l2 = 1`, and across it is slower,
/// `l1 = (1 - A) / (1 + A)` (eq. 14). In a volume there are two directions across a tube and both
/// have l1; of the gradient there is one, and both directions along the surface have l2. Lengths are
/// `sqrt(dx' D^-1 dx)`. Where there is no direction at all, the eigenvalues being equal, D is
/// the identity.
///
/// # Errors
/// A grey value that is not finite, a parameter out of range, or the caller cancelled.
pub fn tensor<const D: usize>(
    image: &Grid<f64, D>,
    options: TensorOptions,
    exec: &Exec,
) -> Result<Medium<D>, MediumError> {
    check_anisotropy(options.anisotropy)?;
    let axes = principal_axes(image, options.directions, exec)?;
    let half_largest =
        0.5 * axes.values().iter().fold(0.0, |most: f64, axis| most.max(axis.strength));
    let along_surface = matches!(options.directions, Directions::Gradient { .. });
    let field = TensorField::from_fn(*image.shape(), |index| {
        let axis = &axes[index];
        let confidence = match options.fading {
            _ if axis.strength == 0.0 => 0.0,
            true => rise(axis.strength, half_largest),
            false => 1.0,
        };
        let across = speed_across(confidence * options.anisotropy);
        let (other, this) = if along_surface { (1.0, across) } else { (across, 1.0) };
        with_axis(&axis.direction, this, other)
    });
    let mask = Mask::all_open(*image.shape());
    Ok(Medium { factor: None, diffusion: Diffusion::Tensor(field), mask })
}

/// Checks the A of eq. (14).
pub(super) fn check_anisotropy(value: f64) -> Result<(), ParameterError> {
    check("anisotropy", value, (0.0..=MOST_ANISOTROPY).contains(&value), "from 0 to 0.9998")
}

/// The l1 of eq. (14), for `l2 = 1`.
pub(super) fn speed_across(anisotropy: f64) -> f64 {
    (1.0 - anisotropy) / (1.0 + anisotropy)
}

/// The matrix with eigenvalue `this` along the unit vector `axis` and `other` across it.
pub(super) fn with_axis<const D: usize>(axis: &[f64; D], this: f64, other: f64) -> Matrix<D> {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let identity = if i == j { other } else { 0.0 };
            identity + (this - other) * axis[i] * axis[j]
        })
    })
}

/// The direction that stands apart from those orthogonal to it.
#[derive(Clone, Copy)]
struct Axis<const D: usize> {
    direction: [f64; D],
    /// By how much it stands apart; 0 if it does not.
    strength: f64,
}

/// The gradient, or the direction along tubes.
fn principal_axes<const D: usize>(
    image: &Grid<f64, D>,
    directions: Directions,
    exec: &Exec,
) -> Result<Grid<Axis<D>, D>, MediumError> {
    let largest = image.largest_size();
    Ok(match directions {
        Directions::Gradient { sigma } => gaussian_gradient(image, sigma, exec)?.map(|gradient| {
            let length = gradient.iter().map(|g| g * g).sum::<f64>().sqrt();
            if length <= QUIET * largest {
                return Axis { direction: [0.0; D], strength: 0.0 };
            }
            Axis { direction: gradient.map(|g| g / length), strength: length }
        }),
        Directions::Hessian { sigma, polarity } => hessian(image, sigma, exec)?
            .map(|matrix| along_tube(&matrix, polarity, QUIET * largest)),
        Directions::Structure { sigma, rho } => {
            let quiet = (QUIET * largest).powi(2);
            structure_tensor(image, sigma, rho, exec)?
                .map(|matrix| along_tube(&matrix, Polarity::Both, quiet))
        }
    })
}

/// The eigenvector whose eigenvalue is smallest in size, and how far that is from the next.
fn along_tube<const D: usize>(matrix: &Matrix<D>, polarity: Polarity, quiet: f64) -> Axis<D> {
    let (values, vectors) = eigen(matrix);
    let mut order: [usize; D] = std::array::from_fn(|i| i);
    order.sort_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs()));
    let [along, next, most] = [order[0], order[1], order[D - 1]];
    let wanted = match polarity {
        Polarity::Bright => values[most] < 0.0,
        Polarity::Dark => values[most] > 0.0,
        Polarity::Both => true,
    };
    let apart = values[next].abs() - values[along].abs();
    let clear = apart > quiet.max(QUIET * values[most].abs());
    Axis { direction: vectors[along], strength: if wanted && clear { apart } else { 0.0 } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn equation_14_in_numbers() {
        let across = speed_across(0.8);
        assert!(((1.0 - across) / (1.0 + across) - 0.8).abs() < 1e-15);
        let diagonal = [0.5_f64.sqrt(); 2];
        let matrix = with_axis(&diagonal, 1.0, 0.2);
        (0..2).for_each(|i| assert!((matrix[i][i] - 0.6).abs() < 1e-15));
        assert!((matrix[0][1] - 0.4).abs() < 1e-15);
    }

    #[test]
    fn the_polarity_chooses_tubes() {
        let bright_along_x = [[-0.1, 0.0], [0.0, -2.0]];
        let strength = |polarity| along_tube(&bright_along_x, polarity, 0.0).strength;
        assert_eq!(along_tube(&bright_along_x, Polarity::Bright, 0.0).direction, [1.0, 0.0]);
        assert_eq!(strength(Polarity::Bright), 1.9);
        assert_eq!(strength(Polarity::Both), 1.9);
        assert_eq!(strength(Polarity::Dark), 0.0);
        assert_eq!(along_tube(&[[1.0, 0.0], [0.0, 1.0]], Polarity::Both, 0.0).strength, 0.0);
    }

    #[test]
    fn an_anisotropy_out_of_range_is_refused() {
        let image = Grid::from_fn(Shape::new([4, 4]).unwrap(), |[x, _]| x as f64);
        for anisotropy in [-0.1, 1.0, f64::NAN] {
            let options = TensorOptions { anisotropy, ..Default::default() };
            let error = tensor(&image, options, &Exec::single_threaded()).unwrap_err();
            assert!(matches!(
                error,
                MediumError::Parameter(ParameterError { name: "anisotropy", .. })
            ));
        }
    }
}
