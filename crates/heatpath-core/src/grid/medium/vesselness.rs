//! Heat runs through tubes, and if asked along them.

use super::tensor::{check_anisotropy, speed_across, with_axis};
use super::{Diffusion, Form, Medium, MediumError};
use crate::error::{check, check_positive};
use crate::exec::Exec;
use crate::grid::filter::{self, Tubes};
use crate::grid::{Grid, Mask, TensorField};

/// The parameters of [`vesselness`].
#[derive(Clone, Debug, PartialEq)]
pub struct VesselnessOptions {
    /// Which tubes, and how they are found.
    pub tubes: Tubes,
    /// How strongly weak responses are held back. Positive; default 2.
    pub power: f64,
    /// The squared speed where there is no tube. Positive; default 1e-4.
    pub floor: f64,
    /// How much faster along a tube than across: where the response is v the anisotropy of
    /// eq. (14) is `A v^q`, with q the [`anisotropy_power`](Self::anisotropy_power). From 0, the
    /// default, which is none, to [`MOST_ANISOTROPY`](super::MOST_ANISOTROPY).
    pub anisotropy: f64,
    /// How soon the anisotropy falls where the response does: the q of `A v^q`. From 0, where all
    /// responses above 0 have the anisotropy A; default 1.
    pub anisotropy_power: f64,
}

impl Default for VesselnessOptions {
    fn default() -> Self {
        Self {
            tubes: Tubes::default(),
            power: 2.0,
            floor: 1e-4,
            anisotropy: 0.0,
            anisotropy_power: 1.0,
        }
    }
}

/// The medium of tubes: `u_t = k laplace(u)` with `k = v^power + floor`, where v is the response of
/// [`filter::vesselness`], from 0 to 1.
///
/// With an anisotropy it is `u_t = k div(D grad u)` with the D of eq. (13), whose e2 is the direction
/// of the tube. Lengths are `ds / sqrt(k)` and `sqrt(dx' (k D)^-1 dx)`.
///
/// The default power and floor, with the default tubes, were chosen by minimal paths along an
/// observer's vessels of the retina (12 pictures of `CHASE_DB1` and STARE, ends 100 and 350 cells apart,
/// recall and precision within 2 cells): their F1 is 0.83 and 0.59, and 0.01 to 0.03 less with a floor
/// of 1e-3 or a power of 3. A floor of 1e-5 gains 0.01 to 0.02, but heat is ten times slower then
/// where there is no tube. Frangi's measure, whose response is about the square of Sato's, wants a
/// power of 1: 0.82 and 0.60.
///
/// # Errors
/// A grey value that is not finite, a parameter out of range, or the caller cancelled.
pub fn vesselness<const D: usize>(
    image: &Grid<f64, D>,
    options: &VesselnessOptions,
    exec: &Exec,
) -> Result<Medium<D>, MediumError> {
    check_positive("power", options.power)?;
    check_positive("floor", options.floor)?;
    check_anisotropy(options.anisotropy)?;
    let power = options.anisotropy_power;
    let is_right = power.is_finite() && power >= 0.0;
    check("anisotropy power", power, is_right, "a finite number, 0 or above")?;
    let found = filter::vesselness(image, &options.tubes, exec)?;
    let speed_sq = found.response.map(|v| v.powf(options.power) + options.floor);
    if options.anisotropy == 0.0 {
        return Ok(Medium::from_field(speed_sq, Form::Pointwise));
    }
    let field = TensorField::from_fn(*image.shape(), |index| {
        let v = found.response[index];
        // A response of 0 has no direction, and 0 to the power of 0 is 1.
        let confidence = if v > 0.0 { v.powf(options.anisotropy_power) } else { 0.0 };
        let across = speed_across(options.anisotropy * confidence);
        with_axis(&found.direction[index], 1.0, across)
    });
    let mask = Mask::all_open(*image.shape());
    Ok(Medium { factor: Some(speed_sq), diffusion: Diffusion::Tensor(field), mask })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn speed_and_direction_in_numbers() {
        let line = Grid::from_fn(Shape::new([40, 30]).unwrap(), |[_, y]| {
            (-0.5 * ((y as f64 - 15.0) / 2.0).powi(2)).exp()
        });
        let options = VesselnessOptions { floor: 0.01, anisotropy: 0.5, ..Default::default() };
        let medium = vesselness(&line, &options, &Exec::single_threaded()).unwrap();
        let matrix = medium.speed_sq_tensor(line.shape().position([20, 15]));
        assert!((matrix[0][0] - 1.01).abs() < 1e-12, "the largest response is 1: {matrix:?}");
        assert!((matrix[1][1] - 1.01 / 3.0).abs() < 1e-12 && matrix[0][1].abs() < 1e-12);
        let far = medium.speed_sq_tensor(line.shape().position([20, 0]));
        assert_eq!(far, [[0.01, 0.0], [0.0, 0.01]]);
        let scalar = VesselnessOptions { anisotropy: 0.0, ..options };
        let medium = vesselness(&line, &scalar, &Exec::single_threaded()).unwrap();
        assert!((medium.speed_sq(line.shape().position([20, 15])) - 1.01).abs() < 1e-12);
        assert!(medium.factor().is_some());
    }

    #[test]
    fn weak_tubes_keep_their_direction() {
        let bump = |y: f64, middle: f64| (-0.5 * ((y - middle) / 2.0).powi(2)).exp();
        let lines = Grid::from_fn(Shape::new([40, 60]).unwrap(), |[_, y]| {
            bump(y as f64, 15.0) + 0.1 * bump(y as f64, 45.0)
        });
        let across = |anisotropy_power: f64, y: usize| {
            let options =
                VesselnessOptions { anisotropy: 0.5, anisotropy_power, ..Default::default() };
            let medium = vesselness(&lines, &options, &Exec::single_threaded()).unwrap();
            medium.diffusion().tensor().unwrap().at(lines.shape().position([20, y]))[1][1]
        };
        for power in [0.0, 0.5, 1.0] {
            assert!((across(power, 15) - 1.0 / 3.0).abs() < 1e-12, "the strongest: A");
            let expected = speed_across(0.5 * 0.1_f64.powf(power));
            assert!((across(power, 45) - expected).abs() < 1e-3, "power {power}");
            assert_eq!(across(power, 30), 1.0, "no tube, no direction");
        }
        let bad = VesselnessOptions { anisotropy_power: -1.0, ..Default::default() };
        let error = vesselness(&lines, &bad, &Exec::single_threaded()).unwrap_err();
        assert!(matches!(error, MediumError::Parameter(error) if error.name == "anisotropy power"));
    }
}
