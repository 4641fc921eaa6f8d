//! Points on a mesh.

use super::surface::{Surface, ranges};
use crate::array::hp_array;
use crate::items::Items;
use crate::numbers::{integers, reals};
use crate::status::{Failure, HP_INVALID_BUFFER, HP_INVALID_POINT, guard, hp_status};
use crate::structs::{self, Versioned};
use heatpath_core::mesh::{Locator, Source, Sources, SurfacePoint};
use std::mem::size_of;

/// Points on the surface of a mesh: vertices, or positions in space, or places on faces.
///
/// Fill it with hp_surface_points_init(), then set one of vertices, positions, or faces with weights,
/// and leave the others NULL. It is only read, and not kept.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_surface_points {
    /// sizeof(hp_surface_points).
    pub struct_size: u32,
    /// For sources at positions: anything but 0 makes them a curve, with straight lines between
    /// them that are laid onto the surface; all of it is one source, 0. offsets, labels and sets must
    /// be NULL then. 0 by default.
    pub curve: u32,
    /// The numbers of vertices; integers.
    pub vertices: *const hp_array,
    /// x, y, z of points in space: the nearest point of the surface is taken.
    pub positions: *const hp_array,
    /// The numbers of the faces that the points lie on; integers.
    pub faces: *const hp_array,
    /// The weights of the three corners of those faces (barycentric coordinates): not negative, adding
    /// up to 1.
    pub weights: *const hp_array,
    /// For sources: the distance at each of them. NULL, the default, is 0 for all.
    pub offsets: *const hp_array,
    /// For sources: how they are called in results, integers from 0 to 2147483647. NULL, the default,
    /// are their numbers. The points of a curve should share a label: with HP_MESH_HEAT the
    /// time grows with the number of labels.
    pub labels: *const hp_array,
    /// For sources of distances: where each set begins, and, last, where the last one ends: one
    /// more number than there are sets. The sources of a set count together, and each set has its
    /// own map. NULL, the default, makes all sources one set.
    pub sets: *const hp_array,
}

// SAFETY: integers and pointers of which any can be NULL; 8 bytes at the end.
unsafe impl Versioned for hp_surface_points {
    const NAME: &'static str = "hp_surface_points";
    const SHORTEST: usize = 16;

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            curve: 0,
            vertices: std::ptr::null(),
            positions: std::ptr::null(),
            faces: std::ptr::null(),
            weights: std::ptr::null(),
            offsets: std::ptr::null(),
            labels: std::ptr::null(),
            sets: std::ptr::null(),
        }
    }
}

/// Fills *points with NULL pointers; struct_size is sizeof(hp_surface_points).
///
/// # Safety
/// `points` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_surface_points_init(
    points: *mut hp_surface_points,
    struct_size: u32,
) -> hp_status {
    let defaults = hp_surface_points::defaults();
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(points, struct_size, &defaults, "points") })
}

/// Reads points that are not sources; `role` and `name` stand in messages.
///
/// # Safety
/// `points` is NULL, misaligned, or points to descriptions of readable items.
pub(crate) unsafe fn read_points(
    surface: &Surface,
    points: *const hp_surface_points,
    [role, name]: [&'static str; 2],
) -> Result<Vec<SurfacePoint>, Failure> {
    // SAFETY: the caller's promise.
    let points = unsafe { structs::read(points, name)? };
    if points.curve != 0 || points.has_lists() {
        let message = "curve, offsets, labels and sets are for sources; they must be 0 and NULL";
        return Err(Failure::argument(message).of(name));
    }
    // SAFETY: the caller's promise.
    unsafe { points.places(surface, role).map_err(|failure| failure.of(name)) }
}

/// Reads sources that count together.
///
/// # Safety
/// As [`read_points`].
pub(crate) unsafe fn read_sources(
    surface: &Surface,
    points: *const hp_surface_points,
) -> Result<Sources, Failure> {
    // SAFETY: the caller's promise.
    let mut sets = unsafe { read_sets(surface, points)? };
    match sets.pop().filter(|_| sets.is_empty()) {
        Some(sources) => Ok(sources),
        None => Err(Failure::argument("sources: sets must be NULL, paths begin with one set")),
    }
}

/// Reads sets of sources.
///
/// # Safety
/// As [`read_points`].
pub(crate) unsafe fn read_sets(
    surface: &Surface,
    points: *const hp_surface_points,
) -> Result<Vec<Sources>, Failure> {
    // SAFETY: the caller's promise.
    unsafe {
        let points = structs::read(points, "sources")?;
        points.sets(surface).map_err(|failure| failure.of("sources"))
    }
}

impl hp_surface_points {
    fn has_lists(&self) -> bool {
        ![self.offsets, self.labels, self.sets].iter().all(|list| list.is_null())
    }

    /// # Safety
    /// The pointers are NULL, misaligned, or point to descriptions of readable items.
    unsafe fn sets(&self, surface: &Surface) -> Result<Vec<Sources>, Failure> {
        // SAFETY: the caller's promise.
        let (list, sets) = unsafe { (self.list(surface)?, integers(self.sets, "sets")?) };
        let Some(starts) = sets else {
            return Ok(vec![Sources::with_offsets(surface.mesh(), list)?]);
        };
        if starts.len() < 2 {
            return Err(Failure::new(
                HP_INVALID_POINT,
                "there are no sets; at least one is needed",
            ));
        }
        let set = |(number, range): (usize, Option<std::ops::Range<usize>>)| {
            let Some(range) = range.filter(|range| !range.is_empty()) else {
                let (from, to, count) = (starts[number], starts[number + 1], list.len());
                let message =
                    format!("set {number} goes from {from} to {to}, but there are {count} sources");
                return Err(Failure::new(HP_INVALID_POINT, message));
            };
            Ok(Sources::with_offsets(surface.mesh(), list[range].to_vec())?)
        };
        ranges(&starts, list.len()).enumerate().map(set).collect()
    }

    /// # Safety
    /// As [`sets`](Self::sets).
    unsafe fn list(&self, surface: &Surface) -> Result<Vec<Source>, Failure> {
        // SAFETY: the caller's promise.
        let (places, offsets, labels) = unsafe {
            let places = self.places(surface, "source")?;
            (places, reals(self.offsets, "offsets")?, integers(self.labels, "labels")?)
        };
        let offsets = offsets.unwrap_or_else(|| vec![0.0; places.len()]);
        let number = |place: usize| if self.curve == 0 { place as i128 } else { 0 };
        let labels = labels.unwrap_or_else(|| (0..places.len()).map(number).collect());
        for (name, count) in [("offsets", offsets.len()), ("labels", labels.len())] {
            check_count(name, count, places.len())?;
        }
        let source = |(number, point): (usize, SurfacePoint)| {
            let offset = offsets[number];
            if !offset.is_finite() {
                let message = format!("offset {number} is {offset}; it must be finite");
                return Err(Failure::new(HP_INVALID_POINT, message));
            }
            let label = i32::try_from(labels[number]).ok().and_then(|n| u32::try_from(n).ok());
            let Some(label) = label else {
                let (label, most) = (labels[number], i32::MAX);
                let message = format!("label {number} is {label}; it must be from 0 to {most}");
                return Err(Failure::new(HP_INVALID_POINT, message));
            };
            Ok(Source { point, offset, label })
        };
        places.into_iter().enumerate().map(source).collect()
    }

    /// # Safety
    /// As [`sets`](Self::sets).
    unsafe fn places(
        &self,
        surface: &Surface,
        role: &'static str,
    ) -> Result<Vec<SurfacePoint>, Failure> {
        let [vertices, positions, faces, weights] =
            [self.vertices, self.positions, self.faces, self.weights].map(|list| !list.is_null());
        if self.curve != 0 && (!positions || self.has_lists()) {
            let message = "a curve is made of positions; offsets, labels and sets must be NULL";
            return Err(Failure::argument(message));
        }
        // SAFETY: the caller's promise.
        let places = unsafe {
            match [vertices, positions, faces, weights] {
                [true, false, false, false] => self.at_vertices(surface, role)?,
                [false, true, false, false] => self.near_positions(surface, role)?,
                [false, false, true, true] => self.on_faces(role)?,
                _ => {
                    let message = "one of vertices, positions, or faces with weights must be set, \
                                   and the others must be NULL";
                    return Err(Failure::argument(message));
                }
            }
        };
        surface.mesh().check_points(role, places.iter().copied())?;
        Ok(places)
    }

    /// # Safety
    /// As [`sets`](Self::sets).
    unsafe fn at_vertices(
        &self,
        surface: &Surface,
        role: &'static str,
    ) -> Result<Vec<SurfacePoint>, Failure> {
        // SAFETY: the caller's promise.
        let numbers = unsafe { Items::<1>::read(self.vertices, "vertices")?.integers()? };
        let at = |(number, [vertex]): (usize, [i128; 1])| surface.at_vertex(role, number, vertex);
        numbers.into_iter().enumerate().map(at).collect()
    }

    /// # Safety
    /// As [`sets`](Self::sets).
    unsafe fn near_positions(
        &self,
        surface: &Surface,
        role: &'static str,
    ) -> Result<Vec<SurfacePoint>, Failure> {
        // SAFETY: the caller's promise.
        let positions = unsafe { Items::<3>::read(self.positions, "positions")?.values()? };
        let fits = |position: &[f64; 3]| position.iter().all(|x| x.abs() <= 1e100);
        if let Some(number) = positions.iter().position(|position| !fits(position)) {
            let position = positions[number];
            let message =
                format!("{role} {number} lies at {position:?}; it must be finite, up to 1e100");
            return Err(Failure::new(HP_INVALID_POINT, message));
        }
        let locator = Locator::new(surface.mesh());
        if self.curve != 0 {
            return Ok(locator.along(&positions));
        }
        Ok(positions.into_iter().map(|position| locator.nearest(position).0).collect())
    }

    /// # Safety
    /// As [`sets`](Self::sets).
    unsafe fn on_faces(&self, role: &'static str) -> Result<Vec<SurfacePoint>, Failure> {
        // SAFETY: the caller's promise.
        let (faces, weights) = unsafe {
            let faces = Items::<1>::read(self.faces, "faces")?.integers()?;
            (faces, Items::<3>::read(self.weights, "weights")?.values()?)
        };
        check_count("weights", weights.len(), faces.len())?;
        let place = |(number, ([face], weights)): (usize, ([i128; 1], [f64; 3]))| {
            let Ok(face) = u32::try_from(face) else {
                let message = format!("{role} {number} lies on face {face}, which does not exist");
                return Err(Failure::new(HP_INVALID_POINT, message));
            };
            Ok(SurfacePoint { face, weights })
        };
        faces.into_iter().zip(weights).enumerate().map(place).collect()
    }
}

fn check_count(name: &str, given: usize, expected: usize) -> Result<(), Failure> {
    if given == expected {
        return Ok(());
    }
    let message = format!("{name}: {given} items were given for {expected} points");
    Err(Failure::new(HP_INVALID_BUFFER, message))
}
