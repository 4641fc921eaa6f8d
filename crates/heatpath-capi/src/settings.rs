//! The caller's options in the engine's words, checked.

use crate::heat::{Readout, Solver};
use crate::options::{
    HP_EDGE_STOP_EXPONENTIAL, HP_EDGE_STOP_RATIONAL, HP_EIKONAL, HP_FORM_DEFAULT,
    HP_FORM_DIVERGENCE, HP_FORM_POINTWISE, HP_MEDIUM_COMBINED, HP_MEDIUM_CONDUCTIVITY,
    HP_MEDIUM_EDGES, HP_MEDIUM_GIVEN, HP_MEDIUM_GIVEN_TENSOR, HP_MEDIUM_PERONA_MALIK,
    HP_MEDIUM_UNIFORM, HP_NORMALIZED, HP_SOLVER_EXPLICIT, HP_SOLVER_IMPLICIT, HP_VARADHAN,
    hp_options,
};
use crate::prepared::Method;
use crate::progress::Progress;
use crate::status::Failure;
use crate::structs::{self, Versioned};
use heatpath_core::Exec;
use heatpath_core::grid::heat::{Duration, HeatOptions, ImplicitOptions, Step};
use heatpath_core::grid::medium::{
    ConductivityOptions, EdgeStop, EdgesOptions, Form, PeronaMalikOptions,
};
use std::ops::ControlFlow;

/// A medium with its parameters.
pub(crate) enum Recipe {
    Uniform,
    Conductivity(ConductivityOptions),
    PeronaMalik(PeronaMalikOptions),
    Combined(ConductivityOptions, PeronaMalikOptions),
    Edges(EdgesOptions),
    Given(Form),
    GivenTensor { components: *const f64, count: u64 },
}

/// The options, in the engine's words.
pub(crate) struct Settings {
    pub(crate) recipe: Recipe,
    /// What becomes 0 and 1; `None` stands for the natural value.
    pub(crate) range: [Option<f64>; 2],
    /// The grey value to compare with, if not that of the sources.
    pub(crate) reference: Option<f64>,
    pub(crate) method: Method,
    /// How heat is read; `None` for a method without heat.
    pub(crate) readout: Option<Readout>,
    pub(crate) threads: usize,
    pub(crate) progress: Progress,
}

impl Settings {
    /// Reads the caller's options.
    ///
    /// # Safety
    /// `options` is NULL, misaligned, or points to as many readable bytes as its `struct_size` says.
    pub(crate) unsafe fn read(options: *const hp_options) -> Result<Self, Failure> {
        let options = if options.is_null() {
            hp_options::defaults()
        } else {
            // SAFETY: the caller's promise.
            unsafe { structs::read(options, "options")? }
        };
        Self::new(&options).map_err(|failure| failure.of("options"))
    }

    /// The threads, watched.
    pub(crate) fn exec<'a>(
        &self,
        watch: impl Fn(f64) -> ControlFlow<()> + Sync + 'a,
    ) -> Result<Exec<'a>, Failure> {
        exec(self.threads, watch)
    }

    fn new(options: &hp_options) -> Result<Self, Failure> {
        let threads = check_threads(options.threads)?;
        if options.reserved != 0 {
            let message = format!("reserved is {}; it must be 0", options.reserved);
            return Err(Failure::argument(message));
        }
        let readout = options.readout()?;
        let method = match readout {
            Some(_) => Method::Heat(options.heat()?),
            None => Method::Eikonal { farthest: options.farthest()? },
        };
        Ok(Self {
            recipe: options.recipe()?,
            range: [options.range_low, options.range_high].map(|v| (!v.is_nan()).then_some(v)),
            reference: options.reference()?,
            method,
            readout,
            threads,
            progress: Progress::new(options.progress, options.user),
        })
    }
}

impl hp_options {
    fn recipe(&self) -> Result<Recipe, Failure> {
        let conductivity = ConductivityOptions { power: self.power, floor: self.floor };
        let form = self.form()?;
        let perona_malik = PeronaMalikOptions {
            contrast: self.contrast,
            edge_stop: self.edge_stop()?,
            smoothing: self.smoothing,
            form: form.unwrap_or_default(),
        };
        let edges = EdgesOptions {
            floor: self.floor,
            smoothing: self.smoothing,
            form: form.unwrap_or_default(),
        };
        Ok(match self.medium {
            HP_MEDIUM_UNIFORM => Recipe::Uniform,
            HP_MEDIUM_CONDUCTIVITY => Recipe::Conductivity(conductivity),
            HP_MEDIUM_PERONA_MALIK => Recipe::PeronaMalik(perona_malik),
            HP_MEDIUM_COMBINED => Recipe::Combined(conductivity, perona_malik),
            HP_MEDIUM_EDGES => Recipe::Edges(edges),
            HP_MEDIUM_GIVEN => Recipe::Given(form.unwrap_or(Form::Pointwise)),
            HP_MEDIUM_GIVEN_TENSOR => {
                Recipe::GivenTensor { components: self.tensor, count: self.tensor_count }
            }
            other => return Err(unknown("medium", other, "one of HP_MEDIUM_... (1 to 7)")),
        })
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
            HP_EIKONAL => Ok(None),
            other => Err(unknown("estimator", other, "HP_NORMALIZED, HP_VARADHAN or HP_EIKONAL")),
        }
    }

    fn farthest(&self) -> Result<f64, Failure> {
        match self.farthest {
            0.0 => Ok(f64::INFINITY),
            farthest if farthest > 0.0 => Ok(farthest),
            farthest => Err(Failure::argument(format!(
                "farthest is {farthest}; it must be positive, or 0 for no end"
            ))),
        }
    }

    fn heat(&self) -> Result<Solver, Failure> {
        match self.solver {
            HP_SOLVER_EXPLICIT => Ok(Solver::Explicit(self.explicit()?)),
            HP_SOLVER_IMPLICIT => Ok(Solver::Implicit(self.implicit()?)),
            other => Err(unknown("solver", other, "HP_SOLVER_EXPLICIT or HP_SOLVER_IMPLICIT")),
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
        let number = |given: u64, usual: usize| match given {
            0 => usual,
            given => usize::try_from(given).unwrap_or(usize::MAX),
        };
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

/// The caller's number of threads, if it is possible.
pub(crate) fn check_threads(threads: u32) -> Result<usize, Failure> {
    let most = Exec::MOST_THREADS;
    if threads as usize <= most {
        return Ok(threads as usize);
    }
    Err(Failure::argument(format!("threads is {threads}; it must be at most {most}")))
}

/// So many threads, watched.
pub(crate) fn exec<'a>(
    threads: usize,
    watch: impl Fn(f64) -> ControlFlow<()> + Sync + 'a,
) -> Result<Exec<'a>, Failure> {
    let exec = match threads {
        1 => Exec::single_threaded(),
        threads => Exec::new(threads)?,
    };
    Ok(exec.with_watch(watch))
}

pub(crate) fn unknown(field: &str, number: u32, right: &str) -> Failure {
    Failure::argument(format!("{field} is {number}; it must be {right}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use heatpath_core::grid::distance::EikonalOptions;

    #[test]
    fn the_defaults_are_those_of_the_engine() {
        let settings = Settings::new(&hp_options::defaults()).map_err(|f| f.message).unwrap();
        assert!(matches!(
            settings.method,
            Method::Heat(Solver::Explicit(options)) if options == HeatOptions::default()
        ));
        let implicit = hp_options { solver: HP_SOLVER_IMPLICIT, ..hp_options::defaults() };
        assert!(matches!(
            implicit.heat(),
            Ok(Solver::Implicit(options)) if options == ImplicitOptions::default()
        ));
        let eikonal = hp_options { estimator: HP_EIKONAL, ..hp_options::defaults() };
        let settings = Settings::new(&eikonal).map_err(|f| f.message).unwrap();
        let usual = EikonalOptions::<2>::default();
        assert!(matches!(
            settings.method,
            Method::Eikonal { farthest } if farthest == usual.farthest
        ));
        assert!(matches!(
            settings.recipe,
            Recipe::Conductivity(options) if options == ConductivityOptions::default()
        ));
        let all = hp_options { medium: HP_MEDIUM_COMBINED, ..hp_options::defaults() };
        assert!(matches!(
            all.recipe(),
            Ok(Recipe::Combined(_, options)) if options == PeronaMalikOptions::default()
        ));
        let edges = hp_options { medium: HP_MEDIUM_EDGES, ..hp_options::defaults() };
        assert!(matches!(
            edges.recipe(),
            Ok(Recipe::Edges(options)) if options == EdgesOptions::default()
        ));
    }
}
