//! The caller's options in the engine's words, checked.

use super::options::{
    HP_BEND_BOTH, HP_BEND_CONCAVE, HP_BEND_CONVEX, HP_CURVATURE_LEAST_SQUARES,
    HP_CURVATURE_NORMAL_CYCLES, HP_MESH_AUTO, HP_MESH_CREASE, HP_MESH_CURVATURE, HP_MESH_EIKONAL,
    HP_MESH_EXACT, HP_MESH_EXPLICIT, HP_MESH_HEAT, HP_MESH_METRIC, HP_MESH_SCALARS,
    HP_MESH_SLOWNESS, HP_MESH_SPEED_SQ, HP_MESH_UNIFORM, hp_mesh_options,
};
use crate::array::hp_array;
use crate::run::Run;
use crate::settings::{farthest, number, unknown};
use crate::status::Failure;
use crate::structs;
use heatpath_core::mesh::clean::CleanOptions;
use heatpath_core::mesh::distance::HeatMethodOptions;
use heatpath_core::mesh::heat::{HeatOptions, Step};
use heatpath_core::mesh::{
    Bend, CurvatureMediumOptions, CurvatureMethod, CurvatureOptions, GeodesicsOptions, Method,
    ScalarsOptions,
};

/// A medium with what it is made from.
#[derive(Clone, Copy)]
pub(crate) enum Recipe {
    Uniform,
    SpeedSq(*const hp_array),
    Slowness(*const hp_array),
    Metric(*const hp_array),
    Scalars(*const hp_array, f64, ScalarsOptions),
    Curvature(CurvatureMediumOptions),
    Crease(CurvatureMediumOptions),
}

/// The options, in the engine's words.
pub(crate) struct Settings {
    pub(crate) clean: CleanOptions,
    pub(crate) recipe: Recipe,
    pub(crate) geodesics: GeodesicsOptions,
    pub(crate) curvature: CurvatureOptions,
    pub(crate) shortens: bool,
    pub(crate) run: Run,
}

impl Settings {
    /// Reads the caller's options.
    ///
    /// # Safety
    /// `options` is NULL, misaligned, or points to as many readable bytes as its `struct_size` says.
    pub(crate) unsafe fn read(options: *const hp_mesh_options) -> Result<Self, Failure> {
        // SAFETY: the caller's promise.
        let options = unsafe { structs::read_or_defaults(options, "options")? };
        Self::new(&options).map_err(|failure| failure.of("options"))
    }

    fn new(options: &hp_mesh_options) -> Result<Self, Failure> {
        if options.reserved != 0 {
            let message = format!("reserved is {}; it must be 0", options.reserved);
            return Err(Failure::argument(message));
        }
        Ok(Self {
            clean: CleanOptions { weld: (!options.weld.is_nan()).then_some(options.weld) },
            recipe: options.recipe()?,
            geodesics: GeodesicsOptions {
                method: options.method()?,
                heat: options.heat(),
                explicit: options.explicit(),
                farthest: farthest(options.farthest)?,
            },
            curvature: options.curvature()?,
            shortens: options.shorten != 0,
            run: Run::new(options.threads, options.progress, options.user)?,
        })
    }
}

impl hp_mesh_options {
    fn recipe(&self) -> Result<Recipe, Failure> {
        Ok(match self.medium {
            HP_MESH_UNIFORM => Recipe::Uniform,
            HP_MESH_SPEED_SQ => Recipe::SpeedSq(self.values),
            HP_MESH_SLOWNESS => Recipe::Slowness(self.values),
            HP_MESH_METRIC => Recipe::Metric(self.values),
            HP_MESH_SCALARS => Recipe::Scalars(self.values, self.reference, self.scalars()),
            HP_MESH_CURVATURE => Recipe::Curvature(self.bending()?),
            HP_MESH_CREASE => Recipe::Crease(self.bending()?),
            other => {
                let right = "one of HP_MESH_UNIFORM (1) to HP_MESH_CREASE (7)";
                return Err(unknown("medium", other, right));
            }
        })
    }

    fn scalars(&self) -> ScalarsOptions {
        let usual = ScalarsOptions::default();
        ScalarsOptions {
            power: or_usual(self.power, usual.power),
            floor: or_usual(self.floor, usual.floor),
        }
    }

    fn bending(&self) -> Result<CurvatureMediumOptions, Failure> {
        let usual = CurvatureMediumOptions::default();
        let bend = match self.bend {
            HP_BEND_BOTH => Bend::Both,
            HP_BEND_CONVEX => Bend::Convex,
            HP_BEND_CONCAVE => Bend::Concave,
            other => return Err(unknown("bend", other, "one of HP_BEND_... (0 to 2)")),
        };
        Ok(CurvatureMediumOptions {
            bend,
            floor: or_usual(self.floor, usual.floor),
            power: or_usual(self.power, usual.power),
            quantile: self.quantile,
        })
    }

    fn method(&self) -> Result<Method, Failure> {
        match self.method {
            HP_MESH_AUTO => Ok(Method::Auto),
            HP_MESH_HEAT => Ok(Method::Heat),
            HP_MESH_EIKONAL => Ok(Method::Eikonal),
            HP_MESH_EXACT => Ok(Method::Exact),
            HP_MESH_EXPLICIT => Ok(Method::Explicit),
            other => {
                Err(unknown("method", other, "one of HP_MESH_AUTO (0) to HP_MESH_EXPLICIT (4)"))
            }
        }
    }

    fn heat(&self) -> HeatMethodOptions {
        let usual = HeatMethodOptions::default();
        HeatMethodOptions {
            time: (self.time != 0.0).then_some(self.time),
            memory_limit: number(self.memory, usual.memory_limit),
        }
    }

    fn explicit(&self) -> HeatOptions {
        let step = match self.step {
            0.0 => Step::Auto,
            step if step.is_nan() => Step::Usual,
            step => Step::Fixed(step),
        };
        let iterations = (self.iterations > 0).then(|| number(self.iterations, 0));
        HeatOptions { step, iterations, ..HeatOptions::default() }
    }

    fn curvature(&self) -> Result<CurvatureOptions, Failure> {
        let method = match self.curvature {
            HP_CURVATURE_NORMAL_CYCLES => CurvatureMethod::NormalCycles,
            HP_CURVATURE_LEAST_SQUARES => CurvatureMethod::LeastSquares,
            other => return Err(unknown("curvature", other, "one of HP_CURVATURE_... (0 or 1)")),
        };
        Ok(CurvatureOptions { method, radius: (self.radius != 0.0).then_some(self.radius) })
    }
}

fn or_usual(given: f64, usual: f64) -> f64 {
    if given.is_nan() { usual } else { given }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structs::Versioned;

    #[test]
    fn the_defaults_are_those_of_the_engine() {
        let options = hp_mesh_options::defaults();
        let settings = Settings::new(&options).map_err(|f| f.message).unwrap();
        assert_eq!(settings.clean, CleanOptions::default());
        assert_eq!(settings.geodesics, GeodesicsOptions::default());
        assert_eq!(settings.curvature, CurvatureOptions::default());
        assert!(!settings.shortens);
        assert_eq!(options.scalars(), ScalarsOptions::default());
        let bending = options.bending().map_err(|failure| failure.message).unwrap();
        assert_eq!(bending, CurvatureMediumOptions::default());
    }
}
