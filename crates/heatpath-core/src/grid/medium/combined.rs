//! Equation (10): grey value and edges together.

use super::conductivity::alpha;
use super::perona_malik::edge_stopping;
use super::{ConductivityOptions, Diffusion, Form, Medium, MediumError, PeronaMalikOptions};
use crate::grid::{Grid, Mask};

/// The combined medium `u_t = alpha div(D grad u)` (eq. 10), with alpha of eq. (6) and D of
/// eq. (8).
///
/// Without the gradient term ([`Form::Pointwise`]) it is `u_t = alpha D laplace(u)`. Lengths are
/// `ds / sqrt(alpha D)`.
///
/// # Errors
/// Those of [`conductivity`](super::conductivity()) and [`perona_malik`](super::perona_malik()).
pub fn combined<const D: usize>(
    image: &Grid<f64, D>,
    references: &[f64],
    conductivity: ConductivityOptions,
    perona_malik: PeronaMalikOptions,
) -> Result<Medium<D>, MediumError> {
    let mut factor = alpha(image, references, conductivity)?;
    let diffusion = edge_stopping(image, perona_malik)?;
    let mask = Mask::all_open(*image.shape());
    match perona_malik.form {
        Form::Divergence => {
            let diffusion = Diffusion::Scalar(diffusion);
            Ok(Medium { factor: Some(factor), diffusion, mask })
        }
        Form::Pointwise => {
            let pairs = factor.values_mut().iter_mut().zip(diffusion.values());
            pairs.for_each(|(k, d)| *k *= d);
            Ok(Medium { factor: Some(factor), diffusion: Diffusion::Uniform, mask })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn both_forms_measure_the_same_lengths() {
        let image = Grid::from_fn(Shape::new([9, 8]).unwrap(), |[x, y]| {
            0.5 + 0.05 * (x as f64).sin() * (y as f64).cos()
        });
        let media = [Form::Divergence, Form::Pointwise].map(|form| {
            let perona_malik = PeronaMalikOptions { form, ..Default::default() };
            combined(&image, &[0.5], ConductivityOptions::default(), perona_malik).unwrap()
        });
        assert_eq!(media[0].speed_sq_field(), media[1].speed_sq_field());
        assert!(matches!(media[0].diffusion(), Diffusion::Scalar(_)));
        assert!(matches!(media[1].diffusion(), Diffusion::Uniform));
    }
}
