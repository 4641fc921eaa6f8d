//! Media made ready for distances from any sources.

use super::medium::read_medium;
use super::settings::{Recipe, Settings};
use super::surface::Surface;
use crate::scene::MEDIUM_SHARE;
use crate::status::Failure;
use heatpath_core::mesh::Geodesics;
use std::sync::Arc;

/// A medium in which distances can be found.
pub(crate) struct Prepared {
    pub(crate) surface: Arc<Surface>,
    pub(crate) geodesics: Geodesics,
    /// Whether distances are lengths.
    pub(crate) is_uniform: bool,
    /// Where they end.
    pub(crate) farthest: f64,
}

impl Prepared {
    /// Reads the medium and prepares a method.
    ///
    /// # Safety
    /// The values of the settings are NULL, misaligned, or point to the description of readable
    /// items.
    pub(crate) unsafe fn new(surface: &Arc<Surface>, settings: &Settings) -> Result<Self, Failure> {
        let exec = settings.run.exec()?;
        // SAFETY: the caller's promise.
        let medium = unsafe { read_medium(surface, settings, &exec.part(0.0, MEDIUM_SHARE))? };
        let rest = exec.part(MEDIUM_SHARE, 1.0);
        let geodesics = Geodesics::new(medium, settings.geodesics, &rest)?;
        let is_uniform = matches!(settings.recipe, Recipe::Uniform);
        let farthest = settings.geodesics.farthest;
        Ok(Self { surface: Arc::clone(surface), geodesics, is_uniform, farthest })
    }
}
