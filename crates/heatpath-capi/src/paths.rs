//! Minimal paths.

use crate::buffer::hp_buffer;
use crate::handles::{borrow, free, hand_out};
use crate::options::hp_options;
use crate::prepared::Prepared;
use crate::problem::{Arguments, Problem, read_points};
use crate::settings::Settings;
use crate::status::{Failure, guard, hp_status};
use crate::structs::{self, Versioned, check_pointer};
use crate::view;
use heatpath_core::Exec;
use heatpath_core::grid::path::{Ending, Path, PathOptions};
use heatpath_core::grid::{Sources, check_points};
use heatpath_core::mesh::SurfacePoint;

/// The path ends at a source.
pub const HP_ENDED_SOURCE: u32 = 1;
/// There is no path: walls separate the end point from every source.
pub const HP_ENDED_UNREACHABLE: u32 = 2;
/// There is no path: no heat has arrived at the end point, and more iterations would bring it there;
/// or it lies beyond hp_options.farthest.
pub const HP_ENDED_NOT_REACHED: u32 = 3;
/// The path was given up on the way: after more steps than the image should need, or where nothing
/// leads down the distances of a mesh.
pub const HP_ENDED_STEP_LIMIT: u32 = 4;
/// An isoline that ends at the border of a mesh, or where others meet it.
pub const HP_ENDED_OPEN: u32 = 5;
/// An isoline or loop whose last point is joined to the first.
pub const HP_ENDED_CLOSED: u32 = 6;

/// The part of the distances in the progress of paths.
pub(crate) const DISTANCE_SHARE: f64 = 0.9;

/// Paths, one for each end point, in the order of the end points; or isolines and loops.
///
/// Made by hp_paths_create() and the functions whose last argument is such a handle, and freed by
/// hp_paths_free(). It does not change, so any number of threads may use it at once, and any thread may
/// free it once the others are done.
pub struct hp_paths {
    pub(crate) paths: Vec<Traced>,
}

/// A path in any dimension.
pub(crate) struct Traced {
    pub(crate) info: hp_path_info,
    /// Those of all points, one after the other.
    pub(crate) coordinates: Vec<f64>,
    /// The same points on the faces of a mesh; none of an image.
    pub(crate) places: Vec<SurfacePoint>,
}

/// What is known about a path besides its points. Set struct_size, then call hp_paths_info().
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_path_info {
    /// sizeof(hp_path_info).
    pub struct_size: u32,
    /// One of HP_ENDED_...
    pub ending: u32,
    /// Which of the sources the path ends at, counted from 0, or its label; -1 if at none.
    pub source: i64,
    /// The number of points, at least 1.
    pub point_count: u64,
    /// The length in pixels; on a mesh, that in space.
    pub length: f64,
    /// The length in physical units; on a mesh, that in space.
    pub physical_length: f64,
    /// The distance of the end point from the sources, infinite if the path reaches none.
    pub distance: f64,
    /// The length of the path in the metric of the medium: its distance, if it is a shortest path. Well
    /// above the distance, say 1.5 times, one of the two is wrong: heat took a short cut in a medium of
    /// strong contrast, or flowed so long that it filled the image. HP_EIKONAL finds both. Not a
    /// number (NAN) on meshes.
    pub cost: f64,
}

// SAFETY: integers and floats, 8-byte numbers at the end.
unsafe impl Versioned for hp_path_info {
    const NAME: &'static str = "hp_path_info";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            ending: 0,
            source: -1,
            point_count: 0,
            length: 0.0,
            physical_length: 0.0,
            distance: f64::INFINITY,
            cost: f64::NAN,
        }
    }
}

/// Traces the minimal path from each end point to a source.
///
/// image, mask, sources, source_count and options are those of hp_distance().
///
/// ends: end_count points like the sources.
///
/// paths: receives the paths, to be freed with hp_paths_free(), or NULL if anything but HP_OK is
/// returned.
///
/// An end point from which no source can be reached is not an error: hp_path_info tells.
///
/// # Safety
/// The structs are as large as their `struct_size` says, and buffers and points are as large as
/// their description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_paths_create(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    sources: *const f64,
    source_count: u64,
    ends: *const f64,
    end_count: u64,
    options: *const hp_options,
    paths: *mut *mut hp_paths,
) -> hp_status {
    let arguments = Arguments { image, mask, sources, source_count, options };
    let make = || {
        // SAFETY: the caller's promise.
        let paths = unsafe {
            match view::dimension(image)? {
                2 => trace::<2>(&arguments, &read_points(ends, end_count, "ends")?)?,
                _ => trace::<3>(&arguments, &read_points(ends, end_count, "ends")?)?,
            }
        };
        Ok(hp_paths { paths })
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(paths, "paths", make) })
}

/// # Safety
/// As [`hp_paths_create`].
unsafe fn trace<const D: usize>(
    arguments: &Arguments,
    ends: &[[f64; D]],
) -> Result<Vec<Traced>, Failure> {
    // SAFETY: the caller's promise.
    let settings = unsafe { Settings::read(arguments.options)? };
    let exec = settings.run.exec()?;
    // SAFETY: the caller's promise.
    let problem = unsafe { Problem::<D>::read(arguments, &settings, &exec)? };
    check_points("end", ends, problem.mask())?;
    let (prepared, rest) = problem.prepare(settings.approach, &exec)?;
    trace_prepared(&prepared, &problem.sources, ends, &settings, &rest)
}

/// The paths from `ends` to the `sources`.
pub(crate) fn trace_prepared<const D: usize>(
    prepared: &Prepared<D>,
    sources: &Sources<D>,
    ends: &[[f64; D]],
    settings: &Settings,
    exec: &Exec,
) -> Result<Vec<Traced>, Failure> {
    let distances = exec.part(0.0, DISTANCE_SHARE);
    let solved = prepared.solve(sources, ends, settings.readout, &distances)?;
    let descent = prepared.descent(sources, &solved)?;
    let mut paths = Vec::with_capacity(ends.len());
    let tracing = exec.part(DISTANCE_SHARE, 1.0);
    for (number, &end) in ends.iter().enumerate() {
        tracing.report(number as f64 / ends.len() as f64)?;
        paths.push(Traced::new(&descent.path(end, &solved.distances, PathOptions::default())?));
    }
    settings.run.finish()?;
    Ok(paths)
}

/// Frees paths; NULL is fine.
///
/// # Safety
/// `paths` is NULL or comes from one of the functions that make paths, and was not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_paths_free(paths: *mut hp_paths) {
    // SAFETY: the caller's promise.
    guard(|| unsafe { free(paths, "paths") });
}

/// Writes the number of paths to *count.
///
/// # Safety
/// `paths` is NULL or comes from one of the functions that make paths; `count` is NULL or points to a uint64_t.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_paths_count(paths: *const hp_paths, count: *mut u64) -> hp_status {
    guard(|| {
        check_pointer(count, "count")?;
        // SAFETY: the caller's promise; the pointers were checked.
        unsafe { count.write(borrow(paths, "paths")?.paths.len() as u64) };
        Ok(())
    })
}

/// Writes what is known about a path to *info, whose struct_size must be set.
///
/// # Safety
/// `paths` is NULL or comes from one of the functions that make paths; `info` is NULL or points to as many bytes as
/// its `struct_size` says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_paths_info(
    paths: *const hp_paths,
    index: u64,
    info: *mut hp_path_info,
) -> hp_status {
    guard(|| {
        // SAFETY: the caller's promise.
        let path = unsafe { one_of(paths, index)? };
        // SAFETY: the caller's promise.
        unsafe { structs::answer(info, &path.info, "info") }
    })
}

impl Traced {
    fn new<const D: usize>(path: &Path<D>) -> Self {
        let (ending, source) = match path.ending {
            Ending::Source(number) => (HP_ENDED_SOURCE, number as i64),
            Ending::Unreachable => (HP_ENDED_UNREACHABLE, -1),
            Ending::NotReached => (HP_ENDED_NOT_REACHED, -1),
            Ending::StepLimit => (HP_ENDED_STEP_LIMIT, -1),
        };
        let info = hp_path_info {
            ending,
            source,
            point_count: path.points.len() as u64,
            length: path.length,
            physical_length: path.physical_length,
            distance: path.distance,
            cost: path.cost,
            ..hp_path_info::defaults()
        };
        Self { info, coordinates: path.points.as_flattened().to_vec(), places: Vec::new() }
    }
}

/// Copies the points of a path, in pixel coordinates or those of the mesh, from the end point
/// to the source.
///
/// coordinates: receives x, y of each point or, of a volume or mesh, x, y, z: two or three
/// times as many doubles as hp_path_info.point_count says.
///
/// capacity: how many points there is room for. If it is too small nothing is written.
///
/// # Safety
/// `paths` is NULL or comes from one of the functions that make paths; `coordinates` is NULL or has room for
/// `capacity` points of two or, of a volume or mesh, three doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_paths_points(
    paths: *const hp_paths,
    index: u64,
    coordinates: *mut f64,
    capacity: u64,
) -> hp_status {
    guard(|| {
        // SAFETY: the caller's promise.
        let path = unsafe { one_of(paths, index)? };
        if coordinates.is_null() {
            return Err(Failure::argument("coordinates is NULL"));
        }
        let count = path.info.point_count;
        if count > capacity {
            return Err(Failure::argument(format!(
                "capacity is {capacity}, but path {index} has {count} points"
            )));
        }
        // SAFETY: there is room for these points, as the caller promises; bytes need no alignment.
        unsafe {
            let (from, bytes) = (&path.coordinates, size_of_val(path.coordinates.as_slice()));
            coordinates.cast::<u8>().copy_from_nonoverlapping(from.as_ptr().cast(), bytes);
        }
        Ok(())
    })
}

/// # Safety
/// `paths` is NULL or points to paths that live as long as they are borrowed.
pub(crate) unsafe fn one_of<'a>(paths: *const hp_paths, index: u64) -> Result<&'a Traced, Failure> {
    // SAFETY: the caller's promise.
    let paths = unsafe { &borrow(paths, "paths")?.paths };
    let found = usize::try_from(index).ok().and_then(|index| paths.get(index));
    found.ok_or_else(|| {
        let count = paths.len();
        Failure::argument(format!("path {index} does not exist: there are {count}, from 0"))
    })
}
