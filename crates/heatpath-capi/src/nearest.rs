//! Which of several sources is the nearest.

use crate::buffer::hp_buffer;
use crate::options::hp_options;
use crate::pixels;
use crate::prepared::Prepared;
use crate::problem::read_points;
use crate::scene::has_memory;
use crate::settings::Settings;
use crate::solver::{hp_solver, in_medium};
use crate::status::{Failure, HP_OUT_OF_MEMORY, guard, hp_status};
use crate::view::View;
use heatpath_core::grid::distance::DistanceMap;
use heatpath_core::grid::labels::Labels;
use heatpath_core::grid::{Grid, Sources};

/// Computes how far every pixel is from the nearest of several sources, which one that is, and how
/// surely.
///
/// sources: source_count points, as for hp_distance().
///
/// options: as for hp_solver_distances().
///
/// distance: receives the distance from the nearest source, as hp_distance() does. NULL if it is not
/// wanted.
///
/// labels: receives the number of the nearest source, counted from 0, and -1 where none is reached; of
/// the same size, HP_I32, or HP_U32 with the bits of -1. NULL if they are not wanted.
///
/// shares: describes the first of source_count maps, HP_F32 or HP_F64, that receive the share of each
/// source in every pixel, from 0 to 1: 1/2 where two of them are equally near, turning to 0 and 1
/// within some sqrt(t) of there, and 0 where none is reached. NULL if they are not wanted.
///
/// share_stride: the bytes from a map of shares to the next one, as map_stride of
/// hp_solver_distances().
///
/// Labels are those of heat and of HP_EIKONAL, shares of heat alone. With heat both are as HP_NORMALIZED
/// sees them, whatever the estimator, and take 25 bytes for each pixel and source meanwhile. Nothing is
/// written unless HP_OK is returned.
///
/// # Safety
/// As hp_solver_distances().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_solver_nearest(
    solver: *const hp_solver,
    sources: *const f64,
    source_count: u64,
    options: *const hp_options,
    distance: *const hp_buffer,
    labels: *const hp_buffer,
    shares: *const hp_buffer,
    share_stride: i64,
) -> hp_status {
    let wanted = Wanted { distance, labels, shares, share_stride };
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let settings = Settings::read(options)?;
        in_medium!(solver, prepared => {
            let points = read_points(sources, source_count, "sources")?;
            write_nearest(prepared, &points, &settings, &wanted)
        })
    })
}

/// The results as the caller describes them; NULL is not wanted.
struct Wanted {
    distance: *const hp_buffer,
    labels: *const hp_buffer,
    shares: *const hp_buffer,
    share_stride: i64,
}

/// The same, checked; shares with the bytes between them.
struct Targets<const D: usize> {
    distance: Option<View<D>>,
    labels: Option<View<D>>,
    shares: Option<(View<D>, isize)>,
}

/// # Safety
/// As [`hp_solver_nearest`].
unsafe fn write_nearest<const D: usize>(
    prepared: &Prepared<D>,
    points: &[[f64; D]],
    settings: &Settings,
    wanted: &Wanted,
) -> Result<(), Failure> {
    // SAFETY: the caller's promise.
    let targets = unsafe { Targets::<D>::read(wanted, prepared, points.len())? };
    let sources = Sources::new(points, prepared.medium().mask())?;
    let found = Found::new(prepared, &sources, settings, &targets)?;
    settings.run.finish()?;
    // SAFETY: the caller promises that the pixels can be written; their types were checked, and
    // that all maps lie within memory.
    unsafe { targets.write(&found) };
    Ok(())
}

impl<const D: usize> Targets<D> {
    /// # Safety
    /// As [`hp_solver_nearest`].
    unsafe fn read(
        wanted: &Wanted,
        prepared: &Prepared<D>,
        sources: usize,
    ) -> Result<Self, Failure> {
        let read = |buffer, name| {
            // SAFETY: the caller's promise.
            let view = unsafe { View::<D>::optional(buffer, name)? };
            view.iter().try_for_each(|view| view.check_size(prepared.medium().shape()))?;
            Ok::<_, Failure>(view)
        };
        let [distance, labels, shares] = [
            read(wanted.distance, "distance")?,
            read(wanted.labels, "labels")?,
            read(wanted.shares, "shares")?,
        ];
        distance.iter().chain(&shares).try_for_each(pixels::check_writable)?;
        labels.iter().try_for_each(pixels::check_labels)?;
        if distance.is_none() && labels.is_none() && shares.is_none() {
            let message = "distance, labels and shares are all NULL: nothing is wanted";
            return Err(Failure::argument(message));
        }
        let stride = |view: &View<D>| view.map_stride(wanted.share_stride, sources);
        let stride = shares.as_ref().map_or(Ok(0), stride).map_err(|f| f.of("shares"))?;
        Ok(Self { distance, labels, shares: shares.map(|view| (view, stride)) })
    }

    /// # Safety
    /// The pixels can be written.
    unsafe fn write(&self, found: &Found<D>) {
        // SAFETY: the caller's promise.
        unsafe {
            if let (Some(view), Some(distance)) = (&self.distance, &found.distance) {
                pixels::write(view, distance.values());
            }
            let Some(labels) = &found.labels else { return };
            if let Some(view) = &self.labels {
                let label = |nearest: &Option<usize>| nearest.map_or(-1, |number| number as i32);
                pixels::write_labels(view, labels.nearest.map(label).values());
            }
            if let Some((first, stride)) = self.shares {
                for (place, share) in labels.shares.iter().enumerate() {
                    pixels::write(&first.moved(stride * place as isize), share.values());
                }
            }
        }
    }
}

/// The results that are wanted.
struct Found<const D: usize> {
    distance: Option<Grid<f64, D>>,
    labels: Option<Labels<D>>,
}

impl<const D: usize> Found<D> {
    fn new(
        prepared: &Prepared<D>,
        sources: &Sources<D>,
        settings: &Settings,
        targets: &Targets<D>,
    ) -> Result<Self, Failure> {
        let wants_labels = targets.labels.is_some() || targets.shares.is_some();
        let label_end = match (wants_labels, targets.distance.is_some()) {
            (true, true) => LABEL_SHARE,
            (true, false) => 1.0,
            (false, _) => 0.0,
        };
        let exec = settings.run.exec()?;
        let (mut distance, mut labels) = (None, None);
        if wants_labels {
            check_labels(prepared, sources.points().len(), targets.shares.is_some())?;
            let nearest = prepared.nearest(sources, &exec.part(0.0, label_end))?;
            (labels, distance) = (Some(nearest.0), nearest.1);
        }
        if targets.distance.is_some() && distance.is_none() {
            let rest = exec.part(label_end, 1.0);
            let solved = prepared.solve(sources, &[], settings.readout, &rest)?;
            distance = Some(solved.distances);
        }
        Ok(Self { distance: distance.map(DistanceMap::into_field), labels })
    }
}

/// The part of the labels in the progress if distances are wanted too.
const LABEL_SHARE: f64 = 0.6;

/// The temperatures and shares of all sources, and what belongs to them, in bytes for each pixel.
const BYTES: usize = 25;

/// Refuses shares where there are none, and more sources than memory holds temperatures of.
fn check_labels<const D: usize>(
    prepared: &Prepared<D>,
    sources: usize,
    wants_shares: bool,
) -> Result<(), Failure> {
    match prepared {
        Prepared::Heat(_) => check_memory(prepared, sources),
        Prepared::Eikonal { .. } if wants_shares => {
            Err(Failure::argument("shares are of heat: those of HP_EIKONAL would all be 0 or 1"))
        }
        Prepared::Eikonal { .. } | Prepared::HeatMethod(_) => Ok(()),
    }
}

/// Refuses more sources than memory holds temperatures of.
fn check_memory<const D: usize>(prepared: &Prepared<D>, sources: usize) -> Result<(), Failure> {
    let cells = prepared.medium().shape().cells();
    let bytes = cells.checked_mul(BYTES).and_then(|bytes| bytes.checked_mul(sources));
    if has_memory(bytes) {
        return Ok(());
    }
    Err(Failure::new(
        HP_OUT_OF_MEMORY,
        format!("sources: {sources} of them need {BYTES} bytes for each of {cells} pixels each"),
    ))
}
