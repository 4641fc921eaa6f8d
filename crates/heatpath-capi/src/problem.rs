//! What computations have in common: the caller's image, walls, sources and options.

use crate::buffer::hp_buffer;
use crate::options::hp_options;
use crate::prepared::{Approach, Prepared};
use crate::scene::{MEDIUM_SHARE, Scene};
use crate::settings::Settings;
use crate::status::{Failure, HP_OUT_OF_MEMORY};
use crate::view::View;
use heatpath_core::Exec;
use heatpath_core::grid::medium::Medium;
use heatpath_core::grid::{Mask, Sources};

/// The arguments that all computations begin with.
pub(crate) struct Arguments {
    pub(crate) image: *const hp_buffer,
    pub(crate) mask: *const hp_buffer,
    pub(crate) sources: *const f64,
    pub(crate) source_count: u64,
    pub(crate) options: *const hp_options,
}

/// A medium and the sources in it.
pub(crate) struct Problem<const D: usize> {
    medium: Medium<D>,
    pub(crate) sources: Sources<D>,
}

impl<const D: usize> Problem<D> {
    /// Reads and checks everything but the options.
    ///
    /// # Safety
    /// The pointers are NULL, misaligned, or point to what the header asks for.
    pub(crate) unsafe fn read(
        arguments: &Arguments,
        settings: &Settings,
        exec: &Exec,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller's promise, for each of the pointers.
        unsafe {
            let image = View::read(arguments.image, "image")?;
            let points = read_points(arguments.sources, arguments.source_count, "sources")?;
            let scene = Scene::read(&image, arguments.mask, settings)?;
            let sources = Sources::new(&points, &scene.mask)?;
            let exec = exec.part(0.0, MEDIUM_SHARE);
            let medium = scene.medium(&settings.recipe, sources.points(), &exec)?;
            Ok(Self { medium, sources })
        }
    }

    pub(crate) fn mask(&self) -> &Mask<D> {
        self.medium.mask()
    }

    /// Makes the medium ready, and what the rest of the work runs on.
    pub(crate) fn prepare<'a>(
        &'a self,
        approach: Approach,
        exec: &'a Exec<'_>,
    ) -> Result<(Prepared<'a, D>, Exec<'a>), Failure> {
        let rest = exec.part(MEDIUM_SHARE, 1.0);
        Ok((Prepared::new(&self.medium, approach, &rest)?, rest))
    }
}

/// Copies `count` points of the caller.
///
/// # Safety
/// `points` is NULL or points to `D` times `count` readable doubles; they need not be aligned.
pub(crate) unsafe fn read_points<const D: usize>(
    points: *const f64,
    count: u64,
    name: &str,
) -> Result<Vec<[f64; D]>, Failure> {
    if count == 0 {
        return Ok(Vec::new());
    }
    if points.is_null() {
        return Err(Failure::argument(format!("{name} is NULL but there are {count} of them")));
    }
    let largest = isize::MAX as usize / size_of::<[f64; D]>();
    let Some(count) = usize::try_from(count).ok().filter(|&count| count <= largest) else {
        return Err(Failure::argument(format!(
            "{name}: {count} points are more than memory holds"
        )));
    };
    let mut copy = Vec::new();
    copy.try_reserve_exact(count).map_err(|_| {
        Failure::new(HP_OUT_OF_MEMORY, format!("{name}: there is no memory for {count} points"))
    })?;
    let points = points.cast::<[f64; D]>();
    // SAFETY: the caller promises `count` points; loads that need no alignment.
    copy.extend((0..count).map(|i| unsafe { points.add(i).read_unaligned() }));
    Ok(copy)
}
