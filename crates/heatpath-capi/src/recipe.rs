//! The caller's medium in the engine's words, checked.

use crate::options::{
    HP_DIRECTIONS_GRADIENT, HP_DIRECTIONS_HESSIAN, HP_DIRECTIONS_STRUCTURE,
    HP_EDGE_STOP_EXPONENTIAL, HP_EDGE_STOP_RATIONAL, HP_FORM_DEFAULT, HP_FORM_DIVERGENCE,
    HP_FORM_POINTWISE, HP_MEDIUM_COMBINED, HP_MEDIUM_CONDUCTIVITY, HP_MEDIUM_EDGES,
    HP_MEDIUM_GIVEN, HP_MEDIUM_GIVEN_TENSOR, HP_MEDIUM_PERONA_MALIK, HP_MEDIUM_TENSOR,
    HP_MEDIUM_UNIFORM, HP_MEDIUM_VESSELNESS, HP_POLARITY_BOTH, HP_POLARITY_BRIGHT,
    HP_POLARITY_DARK, HP_POLARITY_DEFAULT, hp_options,
};
use crate::settings::unknown;
use crate::status::Failure;
use heatpath_core::grid::filter::{DEVIATION, Polarity, Tubes};
use heatpath_core::grid::medium::{
    ConductivityOptions, Directions, EdgeStop, EdgesOptions, Form, PeronaMalikOptions,
    TensorOptions, VesselnessOptions,
};

/// The most scales; each takes time.
const MOST_SCALES: u64 = 64;

/// A medium with its parameters.
#[derive(Clone)]
pub(crate) enum Recipe {
    Uniform,
    Conductivity(ConductivityOptions),
    PeronaMalik(PeronaMalikOptions),
    Combined(ConductivityOptions, PeronaMalikOptions),
    Edges(EdgesOptions),
    Tensor(TensorOptions),
    Vesselness(VesselnessOptions),
    Given(Form),
    GivenTensor { components: *const f64, count: u64 },
}

/// Copies the caller's scales.
///
/// # Safety
/// `scales` is NULL or points to `count` readable doubles; they need not be aligned.
pub(crate) unsafe fn read_scales(scales: *const f64, count: u64) -> Result<Vec<f64>, Failure> {
    if count > MOST_SCALES {
        let message = format!("scale_count is {count}; it must be at most {MOST_SCALES}");
        return Err(Failure::argument(message));
    }
    if scales.is_null() && count > 0 {
        return Err(Failure::argument(format!("scales is NULL, but scale_count is {count}")));
    }
    // SAFETY: the caller promises `count` doubles; loads that need no alignment.
    Ok((0..count as usize).map(|i| unsafe { scales.add(i).read_unaligned() }).collect())
}

impl hp_options {
    pub(crate) fn recipe(&self, scales: Vec<f64>) -> Result<Recipe, Failure> {
        let usual = ConductivityOptions::default();
        let conductivity = ConductivityOptions {
            power: given(self.power).unwrap_or(usual.power),
            floor: given(self.floor).unwrap_or(usual.floor),
        };
        let form = self.form()?;
        let perona_malik = PeronaMalikOptions {
            contrast: given(self.contrast).unwrap_or(PeronaMalikOptions::default().contrast),
            edge_stop: self.edge_stop()?,
            smoothing: self.smoothing,
            form: form.unwrap_or_default(),
        };
        let edges = EdgesOptions {
            floor: conductivity.floor,
            smoothing: self.smoothing,
            form: form.unwrap_or_default(),
        };
        Ok(match self.medium {
            HP_MEDIUM_UNIFORM => Recipe::Uniform,
            HP_MEDIUM_CONDUCTIVITY => Recipe::Conductivity(conductivity),
            HP_MEDIUM_PERONA_MALIK => Recipe::PeronaMalik(perona_malik),
            HP_MEDIUM_COMBINED => Recipe::Combined(conductivity, perona_malik),
            HP_MEDIUM_EDGES => Recipe::Edges(edges),
            HP_MEDIUM_TENSOR => Recipe::Tensor(self.tensor_options(&scales)?),
            HP_MEDIUM_VESSELNESS => Recipe::Vesselness(self.vesselness(scales)?),
            HP_MEDIUM_GIVEN => Recipe::Given(form.unwrap_or(Form::Pointwise)),
            HP_MEDIUM_GIVEN_TENSOR => {
                Recipe::GivenTensor { components: self.tensor, count: self.tensor_count }
            }
            other => return Err(unknown("medium", other, "one of HP_MEDIUM_... (1 to 9)")),
        })
    }

    /// Tubes in the same image, of both kinds if none is named.
    pub(crate) fn tubes(&self, scales: Vec<f64>) -> Result<VesselnessOptions, Failure> {
        let polarity = match self.polarity {
            HP_POLARITY_DEFAULT => HP_POLARITY_BOTH,
            named => named,
        };
        Self { power: f64::NAN, floor: f64::NAN, polarity, ..*self }.vesselness(scales)
    }

    fn form(&self) -> Result<Option<Form>, Failure> {
        match self.form {
            HP_FORM_DEFAULT => Ok(None),
            HP_FORM_DIVERGENCE => Ok(Some(Form::Divergence)),
            HP_FORM_POINTWISE => Ok(Some(Form::Pointwise)),
            other => Err(unknown("form", other, "one of HP_FORM_... (0 to 2)")),
        }
    }

    fn edge_stop(&self) -> Result<EdgeStop, Failure> {
        match self.edge_stop {
            HP_EDGE_STOP_EXPONENTIAL => Ok(EdgeStop::Exponential),
            HP_EDGE_STOP_RATIONAL => Ok(EdgeStop::Rational),
            other => Err(unknown("edge_stop", other, "one of HP_EDGE_STOP_... (1 or 2)")),
        }
    }

    fn polarity(&self) -> Result<Option<Polarity>, Failure> {
        match self.polarity {
            HP_POLARITY_DEFAULT => Ok(None),
            HP_POLARITY_BRIGHT => Ok(Some(Polarity::Bright)),
            HP_POLARITY_DARK => Ok(Some(Polarity::Dark)),
            HP_POLARITY_BOTH => Ok(Some(Polarity::Both)),
            other => Err(unknown("polarity", other, "one of HP_POLARITY_... (0 to 3)")),
        }
    }

    fn tensor_options(&self, scales: &[f64]) -> Result<TensorOptions, Failure> {
        let usual = TensorOptions::default();
        let sigma = match scales {
            [] => 2.0,
            [sigma] => *sigma,
            _ => {
                let message = "HP_MEDIUM_TENSOR takes one scale";
                return Err(Failure::argument(format!(
                    "scale_count is {}; {message}",
                    scales.len()
                )));
            }
        };
        let polarity = self.polarity()?.unwrap_or(Polarity::Both);
        let directions = match self.directions {
            HP_DIRECTIONS_HESSIAN => Directions::Hessian { sigma, polarity },
            HP_DIRECTIONS_STRUCTURE => Directions::Structure { sigma, rho: 2.0 * sigma },
            HP_DIRECTIONS_GRADIENT => Directions::Gradient { sigma },
            other => return Err(unknown("directions", other, "one of HP_DIRECTIONS_... (0 to 2)")),
        };
        let anisotropy = if self.anisotropy == 0.0 { usual.anisotropy } else { self.anisotropy };
        Ok(TensorOptions { directions, anisotropy, ..usual })
    }

    fn vesselness(&self, scales: Vec<f64>) -> Result<VesselnessOptions, Failure> {
        let usual = VesselnessOptions::default();
        let even = (self.normalize != 0.0).then_some(DEVIATION);
        let tubes = Tubes {
            polarity: self.polarity()?.unwrap_or(usual.tubes.polarity),
            elongation: if self.elongation == 0.0 { 1.0 } else { self.elongation },
            scales: if scales.is_empty() { usual.tubes.scales } else { scales },
            contrast: given(self.contrast).or(even),
            ..usual.tubes
        };
        Ok(VesselnessOptions {
            power: given(self.power).unwrap_or(usual.power),
            floor: given(self.floor).unwrap_or(usual.floor),
            anisotropy: self.anisotropy,
            tubes,
            ..usual
        })
    }
}

/// A number of the caller's, if it is one.
fn given(number: f64) -> Option<f64> {
    (!number.is_nan()).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structs::Versioned;

    fn recipe(medium: u32) -> Recipe {
        let options = hp_options { medium, ..hp_options::defaults() };
        options.recipe(Vec::new()).map_err(|failure| failure.message).unwrap()
    }

    #[test]
    fn the_defaults_are_those_of_the_engine() {
        assert_eq!(hp_options::defaults().medium, HP_MEDIUM_CONDUCTIVITY);
        assert!(matches!(
            recipe(HP_MEDIUM_COMBINED),
            Recipe::Combined(conductivity, perona_malik)
                if conductivity == ConductivityOptions::default()
                && perona_malik == PeronaMalikOptions::default()
        ));
        assert!(matches!(
            recipe(HP_MEDIUM_EDGES), Recipe::Edges(options) if options == EdgesOptions::default()
        ));
        assert!(matches!(
            recipe(HP_MEDIUM_TENSOR), Recipe::Tensor(options) if options == TensorOptions::default()
        ));
        assert!(matches!(
            recipe(HP_MEDIUM_VESSELNESS),
            Recipe::Vesselness(options) if options == VesselnessOptions::default()
        ));
    }
}
