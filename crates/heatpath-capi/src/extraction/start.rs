//! Where the structure is, and where extraction begins.

use crate::problem::{Arguments, read_points};
use crate::recipe::Recipe;
use crate::scene::Scene;
use crate::settings::Settings;
use crate::status::Failure;
use crate::view::View;
use heatpath_core::Exec;
use heatpath_core::grid::Structure;

/// What `hp_vote_options` and `hp_key_point_options` say about the structure; `None` is chosen.
#[derive(Clone, Copy)]
pub(super) struct Look {
    pub(super) level: Option<f64>,
    pub(super) extent: Option<f64>,
}

impl Look {
    pub(super) fn new(structure: f64, extent: f64) -> Result<Self, Failure> {
        let look = Self { level: chosen(structure), extent: chosen(extent) };
        for (name, number) in [("structure", look.level), ("extent", look.extent)] {
            if number.is_some_and(|number| !number.is_finite() || number < 0.0) {
                let number = number.unwrap_or_default();
                let message =
                    format!("{name} is {number}; it must be finite and 0 or more, or NAN");
                return Err(Failure::argument(message));
            }
        }
        Ok(look)
    }
}

/// A number of the caller's, for which NAN stands for the usual one.
pub(super) fn chosen(number: f64) -> Option<f64> {
    (!number.is_nan()).then_some(number)
}

/// Finds the structure; without sources, seeds in it.
///
/// # Safety
/// The pointers are NULL, misaligned, or point to what the header asks for.
pub(super) unsafe fn start<const D: usize>(
    arguments: &Arguments,
    settings: &Settings,
    look: Look,
    exec: &Exec,
) -> Result<Structure<D>, Failure> {
    // SAFETY: the caller's promise, for each of the pointers.
    let (image, mut points) = unsafe {
        let points = read_points(arguments.sources, arguments.source_count, "sources")?;
        (View::<D>::read(arguments.image, "image")?, points)
    };
    // SAFETY: the caller's promise.
    let scene = unsafe { Scene::read(&image, arguments.mask, settings)? };
    let extent = look.extent.unwrap_or_else(|| Structure::usual_extent(&image.shape));
    let compares = matches!(settings.recipe, Recipe::Conductivity(_) | Recipe::Combined(..));
    let mut begin = 0.0;
    if points.is_empty() && compares && settings.reference.is_none() {
        // Tubes have seeds, and these the grey values to compare with.
        let recipe = Recipe::Vesselness(settings.tubes.clone());
        begin = 0.5;
        let tubes = scene.medium(&recipe, &[], &exec.part(0.0, begin))?;
        points = Structure::new(tubes, &[], None, extent)?.sources.points().to_vec();
    }
    let medium = scene.medium(&settings.recipe, &points, &exec.part(begin, 1.0))?;
    Ok(Structure::new(medium, &points, look.level, extent)?)
}
