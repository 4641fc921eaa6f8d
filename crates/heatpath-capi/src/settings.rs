//! The caller's options in the engine's words, checked.

use crate::heat::{Readout, Solver};
use crate::options::{
    HP_EIKONAL, HP_HEAT_METHOD, HP_NORMALIZED, HP_SOLVER_EXPLICIT, HP_SOLVER_IMPLICIT, HP_VARADHAN,
    hp_options,
};
use crate::prepared::Approach;
use crate::recipe::{self, Recipe};
use crate::run::Run;
use crate::status::Failure;
use crate::structs;
use heatpath_core::grid::distance::HeatMethodOptions;
use heatpath_core::grid::heat::{Duration, HeatOptions, ImplicitOptions, Step};
use heatpath_core::grid::medium::VesselnessOptions;

/// The options, in the engine's words.
pub(crate) struct Settings {
    pub(crate) recipe: Recipe,
    /// The medium that shows where a structure begins whose grey values are not known yet.
    pub(crate) tubes: VesselnessOptions,
    /// What becomes 0 and 1; `None` stands for the natural value.
    pub(crate) range: [Option<f64>; 2],
    /// Over how many cells light is evened out, and how much thicker walls are; 0 is none.
    pub(crate) normalize: f64,
    pub(crate) margin: f64,
    /// The grey value to compare with, if not that of the sources.
    pub(crate) reference: Option<f64>,
    pub(crate) approach: Approach,
    /// How heat is read; `None` for a method without heat.
    pub(crate) readout: Option<Readout>,
    pub(crate) run: Run,
}

impl Settings {
    /// Reads the caller's options.
    ///
    /// # Safety
    /// `options` is NULL, misaligned, or points to as many readable bytes as its `struct_size` says.
    pub(crate) unsafe fn read(options: *const hp_options) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let options = unsafe { structs::read_or_defaults(options, "options")? };
        // SAFETY: the caller promises readable scales.
        let scales = unsafe { recipe::read_scales(options.scales, options.scale_count) };
        let new = |scales| Self::new(&options, scales);
        scales.and_then(new).map_err(|failure| failure.of("options"))
    }

    fn new(options: &hp_options, scales: Vec<f64>) -> Result<Self, Failure> {
        let run = Run::new(options.threads, options.progress, options.user)?;
        if options.reserved != 0 {
            let message = format!("reserved is {}; it must be 0", options.reserved);
            return Err(Failure::argument(message));
        }
        let readout = options.readout()?;
        let approach = match options.estimator {
            HP_EIKONAL => Approach::Eikonal { farthest: farthest(options.farthest)? },
            HP_HEAT_METHOD => Approach::HeatMethod(options.heat_method()),
            _ => Approach::Heat(options.heat()?),
        };
        let [normalize, margin] =
            [("normalize", options.normalize), ("margin", options.margin)].map(not_negative);
        Ok(Self {
            tubes: options.tubes(scales.clone())?,
            recipe: options.recipe(scales)?,
            normalize: normalize?,
            margin: margin?,
            range: [options.range_low, options.range_high].map(|v| (!v.is_nan()).then_some(v)),
            reference: options.reference()?,
            approach,
            readout,
            run,
        })
    }
}

impl hp_options {
    fn reference(&self) -> Result<Option<f64>, Failure> {
        if self.reference.is_infinite() {
            let message = format!("reference is {}; it must be finite or NAN", self.reference);
            return Err(Failure::argument(message));
        }
        Ok((!self.reference.is_nan()).then_some(self.reference))
    }

    fn readout(&self) -> Result<Option<Readout>, Failure> {
        match self.estimator {
            HP_NORMALIZED => Ok(Some(Readout::Normalized)),
            HP_VARADHAN => Ok(Some(Readout::Varadhan)),
            HP_EIKONAL | HP_HEAT_METHOD => Ok(None),
            other => {
                Err(unknown("estimator", other, "one of HP_NORMALIZED to HP_HEAT_METHOD (1 to 4)"))
            }
        }
    }

    fn heat(&self) -> Result<Solver, Failure> {
        match self.solver {
            HP_SOLVER_EXPLICIT => Ok(Solver::Explicit(self.explicit()?)),
            HP_SOLVER_IMPLICIT => Ok(Solver::Implicit(self.implicit()?)),
            other => Err(unknown("solver", other, "HP_SOLVER_EXPLICIT or HP_SOLVER_IMPLICIT")),
        }
    }

    fn heat_method(&self) -> HeatMethodOptions {
        let usual = HeatMethodOptions::default();
        HeatMethodOptions {
            time: if self.time == 0.0 { usual.time } else { self.time },
            memory_limit: number(self.memory, usual.memory_limit),
        }
    }

    fn implicit(&self) -> Result<ImplicitOptions, Failure> {
        if !self.step.is_nan() {
            return Err(Failure::argument(format!(
                "step is {}; HP_SOLVER_IMPLICIT has none, it must be NAN",
                self.step
            )));
        }
        let usual = ImplicitOptions::default();
        Ok(ImplicitOptions {
            time: if self.time == 0.0 { usual.time } else { self.time },
            steps: number(self.iterations, usual.steps),
            memory_limit: number(self.memory, usual.memory_limit),
            ..usual
        })
    }

    fn explicit(&self) -> Result<HeatOptions, Failure> {
        let iterations = usize::try_from(self.iterations).unwrap_or(usize::MAX);
        let duration = match (iterations, self.time) {
            (0, 0.0) => Duration::Usual,
            (0, time) => Duration::Time(time),
            (iterations, 0.0) => Duration::Iterations(iterations),
            (iterations, time) => {
                return Err(Failure::argument(format!(
                    "iterations is {iterations} and time is {time}; one of them must be 0"
                )));
            }
        };
        let step = match self.step {
            0.0 => Step::Auto,
            step if step.is_nan() => Step::Usual,
            step => Step::Fixed(step),
        };
        Ok(HeatOptions { duration, step, ..HeatOptions::default() })
    }
}

/// A number of the caller's, of which 0 stands for the usual one.
pub(crate) fn number(given: u64, usual: usize) -> usize {
    match given {
        0 => usual,
        given => usize::try_from(given).unwrap_or(usize::MAX),
    }
}

fn not_negative((field, value): (&str, f64)) -> Result<f64, Failure> {
    if value.is_finite() && value >= 0.0 {
        return Ok(value);
    }
    Err(Failure::argument(format!("{field} is {value}; it must be finite and 0 or more")))
}

/// Where distances end; 0 stands for nowhere.
pub(crate) fn farthest(given: f64) -> Result<f64, Failure> {
    match given {
        0.0 => Ok(f64::INFINITY),
        given if given > 0.0 => Ok(given),
        given => Err(Failure::argument(format!(
            "farthest is {given}; it must be positive, or 0 for no end"
        ))),
    }
}

pub(crate) fn unknown(field: &str, number: u32, right: &str) -> Failure {
    Failure::argument(format!("{field} is {number}; it must be {right}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structs::Versioned;
    use heatpath_core::grid::distance::EikonalOptions;

    fn settings(options: hp_options) -> Settings {
        Settings::new(&options, Vec::new()).map_err(|failure| failure.message).unwrap()
    }

    #[test]
    fn the_defaults_are_those_of_the_engine() {
        assert!(matches!(
            settings(hp_options::defaults()).approach,
            Approach::Heat(Solver::Explicit(options)) if options == HeatOptions::default()
        ));
        let implicit = hp_options { solver: HP_SOLVER_IMPLICIT, ..hp_options::defaults() };
        assert!(matches!(
            settings(implicit).approach,
            Approach::Heat(Solver::Implicit(options)) if options == ImplicitOptions::default()
        ));
        let eikonal = hp_options { estimator: HP_EIKONAL, ..hp_options::defaults() };
        let usual = EikonalOptions::<2>::default();
        assert!(matches!(
            settings(eikonal).approach,
            Approach::Eikonal { farthest } if farthest == usual.farthest
        ));
        let heat_method = hp_options { estimator: HP_HEAT_METHOD, ..hp_options::defaults() };
        assert!(matches!(
            settings(heat_method).approach,
            Approach::HeatMethod(options) if options == HeatMethodOptions::default()
        ));
    }
}
