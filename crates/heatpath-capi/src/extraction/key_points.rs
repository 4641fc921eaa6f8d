//! Key points.

use super::graph::{HP_STOP_COMPLETE, HP_STOP_MOST, hp_graph};
use super::options::{HP_KEY_POINTS_HEAT, HP_KEY_POINTS_LENGTH, hp_key_point_options};
use super::start::{Look, chosen, start};
use crate::buffer::hp_buffer;
use crate::handles::hand_out;
use crate::options::hp_options;
use crate::problem::Arguments;
use crate::scene::MEDIUM_SHARE;
use crate::settings::{Settings, number, unknown};
use crate::status::{Failure, guard, hp_status};
use crate::structs;
use crate::view;
use heatpath_core::Exec;
use heatpath_core::grid::Structure;
use heatpath_core::grid::keypoints::{
    KeyPointOptions, KeyPoints, LengthOptions, Stop, key_points, key_points_by_length,
};

/// Finds the curves of an image from key point to key point (section 4.2 of the paper), as a graph whose
/// nodes are the key points.
///
/// image, mask, sources, source_count and options are those of hp_votes_create().
///
/// key_point_options: NULL for the defaults.
///
/// graph: receives the key points and the paths between them, to be freed with hp_graph_free(), or
/// NULL if anything but HP_OK is returned. The first nodes are the sources, or the seeds that were
/// found; all other nodes have a parent, to which a branch leads. Branches between nodes neither of
/// which is the parent of the other close a curve.
///
/// HP_NO_ANSWER is returned if the image shows no structure.
///
/// # Safety
/// The structs are as large as their `struct_size` says, and buffers and points are as large as
/// their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_key_points_create(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    sources: *const f64,
    source_count: u64,
    options: *const hp_options,
    key_point_options: *const hp_key_point_options,
    graph: *mut *mut hp_graph,
) -> hp_status {
    let arguments = Arguments { image, mask, sources, source_count, options };
    // SAFETY: the caller's promise.
    let make = || unsafe {
        match view::dimension(image)? {
            2 => find::<2>(&arguments, key_point_options),
            _ => find::<3>(&arguments, key_point_options),
        }
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(graph, "graph", make) })
}

/// # Safety
/// As [`hp_key_points_create`].
unsafe fn find<const D: usize>(
    arguments: &Arguments,
    key_point_options: *const hp_key_point_options,
) -> Result<hp_graph, Failure> {
    // SAFETY: the caller's promise, for each of the pointers.
    let (options, settings) = unsafe {
        let options = structs::read_or_defaults(key_point_options, "key_point_options")?;
        (options, Settings::read(arguments.options)?)
    };
    let look = Look::new(options.structure, options.extent);
    let look = look.map_err(|failure| failure.of("key_point_options"))?;
    let exec = settings.run.exec()?;
    // SAFETY: the caller's promise.
    let found = unsafe { start::<D>(arguments, &settings, look, &exec.part(0.0, MEDIUM_SHARE))? };
    let exec = exec.part(MEDIUM_SHARE, 1.0);
    let points = options.search(&found, &exec)?;
    settings.run.finish()?;
    let stop = match points.stop {
        Stop::Complete => HP_STOP_COMPLETE,
        Stop::Most => HP_STOP_MOST,
    };
    Ok(hp_graph::of_key_points(&points, found.medium.shape(), found.sources.points(), stop))
}

impl hp_key_point_options {
    fn search<const D: usize>(
        &self,
        found: &Structure<D>,
        exec: &Exec,
    ) -> Result<KeyPoints<D>, Failure> {
        let usual = KeyPointOptions::of_structure(&found.medium, found.level()?);
        let options = KeyPointOptions {
            radius: chosen(self.radius).unwrap_or(usual.radius),
            iterations: number(self.iterations, usual.iterations),
            least_speed_sq: chosen(self.structure).unwrap_or(usual.least_speed_sq),
            ..usual
        };
        let (medium, sources) = (&found.medium, &found.sources);
        match self.method {
            HP_KEY_POINTS_HEAT => Ok(key_points(medium, sources, &options, exec)?),
            HP_KEY_POINTS_LENGTH => {
                let KeyPointOptions { radius: length, least_speed_sq, most, .. } = options;
                let options = LengthOptions { length, least_speed_sq, most };
                Ok(key_points_by_length(medium, sources, &options, exec)?)
            }
            other => {
                let right = "HP_KEY_POINTS_HEAT or HP_KEY_POINTS_LENGTH";
                Err(unknown("method", other, right).of("key_point_options"))
            }
        }
    }
}
