//! How well curves agree with a truth.

use crate::array::hp_array;
use crate::buffer::hp_buffer;
use crate::items::Items;
use crate::numbers::integers;
use crate::pixels;
use crate::status::{Failure, HP_INVALID_BUFFER, guard, hp_status};
use crate::structs::{self, Versioned};
use crate::view::{self, View};
use heatpath_core::evaluation::{CurveSet, evaluate};
use heatpath_core::grid::Mask;
use std::mem::size_of;

/// Curves of the caller: polylines, or the pixels of a mask.
///
/// Fill it with hp_curves_init(), then set points, or mask. It is only read, and not kept.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_curves {
    /// sizeof(hp_curves).
    pub struct_size: u32,
    /// The number of coordinates of a point: 2, the default, or 3. That of a mask counts instead.
    pub dimension: u32,
    /// The points of all polylines, one polyline after the other; any type. An item is x, y or x, y, z
    /// in pixel coordinates.
    pub points: *const hp_array,
    /// Where the points of each polyline begin, and, last, where those of the last one end; integers.
    /// NULL, the default, if there is one polyline.
    pub starts: *const hp_array,
    /// The physical distance of neighbouring pixels along each axis, positive; 1 by default. That of a
    /// mask counts instead.
    pub spacing: [f64; 3],
    /// Instead of points: the pixels that are not 0, of which the centreline counts; any type.
    pub mask: *const hp_buffer,
}

/// How well curves agree. Set struct_size, then call hp_evaluate().
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_score {
    /// sizeof(hp_score).
    pub struct_size: u32,
    /// 0.
    pub reserved: u32,
    /// The part of the truth's length within the tolerance of the extraction, 0 to 1; 1 if the truth
    /// has no length.
    pub recall: f64,
    /// The part of the extracted length within the tolerance of the truth, 0 to 1; 1 if nothing was
    /// extracted.
    pub precision: f64,
    /// Their harmonic mean; 0 if both are.
    pub f1: f64,
    /// The truth's length, in physical units.
    pub truth_length: f64,
    /// The extraction's length, in physical units.
    pub extracted_length: f64,
    /// The mean distance of the truth from the extraction, in physical units.
    pub truth_distance: f64,
    /// The mean distance of the extraction from the truth, in physical units.
    pub extracted_distance: f64,
}

// SAFETY: integers, floats and pointers, 8-byte numbers at the end.
unsafe impl Versioned for hp_curves {
    const NAME: &'static str = "hp_curves";
    const SHORTEST: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            dimension: 2,
            points: std::ptr::null(),
            starts: std::ptr::null(),
            spacing: [1.0; 3],
            mask: std::ptr::null(),
        }
    }
}

// SAFETY: integers and floats, 8-byte numbers at the end.
unsafe impl Versioned for hp_score {
    const NAME: &'static str = "hp_score";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved: 0,
            recall: 0.0,
            precision: 0.0,
            f1: 0.0,
            truth_length: 0.0,
            extracted_length: 0.0,
            truth_distance: 0.0,
            extracted_distance: 0.0,
        }
    }
}

/// Fills *curves with the defaults; struct_size is sizeof(hp_curves).
///
/// # Safety
/// `curves` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_curves_init(curves: *mut hp_curves, struct_size: u32) -> hp_status {
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(curves, struct_size, &hp_curves::defaults(), "curves") })
}

/// Compares extracted curves with a truth: recall and precision by length.
///
/// extracted, truth: of the same dimension and spacing.
///
/// view: pixels that are 0 do not count, on either side; any type. NULL if all do.
///
/// tolerance: the largest distance at which curves agree, in physical units; from 0.
///
/// score: receives the answer; its struct_size must be set.
///
/// # Safety
/// The structs are as large as their `struct_size` says, and buffers and lists are as large as their
/// description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_evaluate(
    extracted: *const hp_curves,
    truth: *const hp_curves,
    view: *const hp_buffer,
    tolerance: f64,
    score: *mut hp_score,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let value = match dimension(truth)? {
            2 => compare::<2>([extracted, truth], view, tolerance)?,
            _ => compare::<3>([extracted, truth], view, tolerance)?,
        };
        structs::answer(score, &value, "score")
    })
}

/// # Safety
/// As [`hp_evaluate`].
unsafe fn dimension(truth: *const hp_curves) -> Result<u32, Failure> {
    // SAFETY: the caller's promise.
    unsafe {
        let truth = structs::read(truth, "truth")?;
        if !truth.mask.is_null() {
            return view::dimension(truth.mask);
        }
        if matches!(truth.dimension, 2 | 3) {
            return Ok(truth.dimension);
        }
        let message = format!("truth: dimension is {}; it must be 2 or 3", truth.dimension);
        Err(Failure::argument(message))
    }
}

/// # Safety
/// As [`hp_evaluate`].
unsafe fn compare<const D: usize>(
    [extracted, truth]: [*const hp_curves; 2],
    view: *const hp_buffer,
    tolerance: f64,
) -> Result<hp_score, Failure> {
    // SAFETY: the caller's promise.
    let (extracted, truth, view) = unsafe {
        let view = if view.is_null() { None } else { Some(read_mask::<D>(view, "view")?) };
        (read_curves::<D>(extracted, "extracted")?, read_curves::<D>(truth, "truth")?, view)
    };
    let found = evaluate(&extracted, &truth, &[tolerance], view.as_ref())?;
    let score = &found.scores[0];
    Ok(hp_score {
        recall: score.recall,
        precision: score.precision,
        f1: score.f1,
        truth_length: score.truth_length,
        extracted_length: score.extracted_length,
        truth_distance: found.truth_to_extracted.mean,
        extracted_distance: found.extracted_to_truth.mean,
        ..hp_score::defaults()
    })
}

/// # Safety
/// As [`hp_evaluate`].
unsafe fn read_curves<const D: usize>(
    curves: *const hp_curves,
    name: &'static str,
) -> Result<CurveSet<D>, Failure> {
    // SAFETY: the caller's promise.
    let curves = unsafe { structs::read(curves, name)? };
    if !curves.mask.is_null() {
        // SAFETY: as above.
        let mask = unsafe { read_mask::<D>(curves.mask, name)? };
        return Ok(CurveSet::of_mask(mask.open()));
    }
    if curves.dimension as usize != D {
        let message =
            format!("{name}: dimension is {}, but that of the truth is {D}", curves.dimension);
        return Err(Failure::argument(message));
    }
    // SAFETY: as above.
    let (points, starts) = unsafe {
        let points = Items::<D>::read(curves.points, name)?.values()?;
        (points, integers(curves.starts, name)?)
    };
    let polylines = match starts {
        None => vec![points],
        Some(starts) => cut(&points, &starts).map_err(|failure| failure.of(name))?,
    };
    let spacing = std::array::from_fn(|axis| curves.spacing[axis]);
    CurveSet::of_polylines(&polylines, spacing).map_err(|error| Failure::from(error).of(name))
}

/// The points of each polyline.
fn cut<const D: usize>(
    points: &[[f64; D]],
    starts: &[i128],
) -> Result<Vec<Vec<[f64; D]>>, Failure> {
    let one = |pair: &[i128]| {
        let range = usize::try_from(pair[0]).ok()?..usize::try_from(pair[1]).ok()?;
        points.get(range).map(<[_]>::to_vec)
    };
    starts.windows(2).map(one).collect::<Option<_>>().ok_or_else(|| {
        let message = format!("starts must rise from 0 to the number of points, {}", points.len());
        Failure::new(HP_INVALID_BUFFER, message)
    })
}

/// # Safety
/// As [`hp_evaluate`].
unsafe fn read_mask<const D: usize>(
    mask: *const hp_buffer,
    name: &'static str,
) -> Result<Mask<D>, Failure> {
    // SAFETY: the caller's promise.
    let cells = unsafe { pixels::read(&View::<D>::read(mask, name)?)? };
    cells.check_finite().map_err(|error| Failure::from(error).of(name))?;
    Ok(Mask::new(cells.map(|&value| value != 0.0)))
}
