//! How curves are looked for.

use crate::status::{guard, hp_status};
use crate::structs::{self, Versioned};
use std::mem::size_of;

/// Heat begins again from all that has been found. The default.
pub const HP_VOTES_ACCUMULATED: u32 = 0;
/// One vote from the front of heat that has flowed for long.
pub const HP_VOTES_FRONT: u32 = 1;
/// Heat flows on from vote to vote.
pub const HP_VOTES_MULTIPLE: u32 = 2;
/// Fast marching, and the paths from 500 random pixels.
pub const HP_VOTES_RANDOM: u32 = 3;
/// Fast marching, and the paths from all pixels of the border.
pub const HP_VOTES_BORDER: u32 = 4;

/// Peaks of heat on circles. The default.
pub const HP_KEY_POINTS_HEAT: u32 = 0;
/// Points that paths of one length lead to, by fast marching.
pub const HP_KEY_POINTS_LENGTH: u32 = 1;

/// How hp_votes_create() looks for curves. NULL in place of it means all defaults.
///
/// Fill it with hp_vote_options_init(), then change fields. What the method does not use is ignored.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_vote_options {
    /// sizeof(hp_vote_options).
    pub struct_size: u32,
    /// One of HP_VOTES_...
    pub method: u32,
    /// The squared speed of the medium from which on a pixel is part of the structure. Not a number
    /// (NAN), the default: it is chosen from the medium.
    pub structure: f64,
    /// If no sources are given: pieces of the structure whose bounding box has at least this diagonal
    /// get one. In multiples of the smallest spacing; not a number (NAN), the default, stands for a
    /// sixteenth of the longest side.
    pub extent: f64,
    /// Anything but 0: the paper's rules alone, by which also the front votes and voting goes on into the
    /// background, instead of growth that stops at the edge of the structure. 0 by default.
    pub no_growth: u32,
    /// With growth: pixels are kept beyond which more of the structure's pixels lie; 0, the default,
    /// stands for 10.
    pub least_votes: u32,
    /// With growth: the longest way outside of the structure that a path may bridge, in multiples of
    /// the smallest spacing. Not a number (NAN), the default, stands for 6.
    pub gap: f64,
    /// Without growth: pixels are kept whose density is above this part of the largest one. From 0 to
    /// below 1. Not a number (NAN), the default, stands for the paper's, 1/30 or 1/7.
    pub threshold: f64,
    /// How far below the highest temperature heat counts as having come, in logarithms. Not a number
    /// (NAN), the default, stands for 36, or 240 of the front and multiple votes.
    pub level: f64,
    /// Voting ends when more than this part of the kept pixels was kept before. From 0 to 1. Not a
    /// number (NAN), the default, stands for 0.95, and 0.99 with growth.
    pub settled: f64,
    /// The time steps of heat before each vote; 0, the default, stands for the method's own.
    pub iterations: u64,
    /// Branches with a free end that are shorter than this, in physical units, or than 1.5 radii of the
    /// junction are taken off the graph; 0 by default.
    pub prune: f64,
}

// SAFETY: integers and floats, 8-byte numbers at the end.
unsafe impl Versioned for hp_vote_options {
    const NAME: &'static str = "hp_vote_options";
    const SHORTEST: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            method: HP_VOTES_ACCUMULATED,
            structure: f64::NAN,
            extent: f64::NAN,
            no_growth: 0,
            least_votes: 0,
            gap: f64::NAN,
            threshold: f64::NAN,
            level: f64::NAN,
            settled: f64::NAN,
            iterations: 0,
            prune: 0.0,
        }
    }
}

/// How hp_key_points_create() looks for curves. NULL in place of it means all defaults.
///
/// Fill it with hp_key_point_options_init(), then change fields.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_key_point_options {
    /// sizeof(hp_key_point_options).
    pub struct_size: u32,
    /// HP_KEY_POINTS_HEAT, the default, or HP_KEY_POINTS_LENGTH.
    pub method: u32,
    /// As in hp_vote_options; paths may run where the medium is half as fast squared, unless it is set.
    pub structure: f64,
    /// As in hp_vote_options.
    pub extent: f64,
    /// The distance between key points, in multiples of the smallest spacing, at least 4. Not a number
    /// (NAN), the default, stands for 4 half widths of the structure, from 10 to 30.
    pub radius: f64,
    /// For HP_KEY_POINTS_HEAT: the time steps of heat for each key point; 0, the default, stands for
    /// 50, or as many as heat needs to come so far.
    pub iterations: u64,
}

// SAFETY: integers and floats, 8-byte numbers at the end.
unsafe impl Versioned for hp_key_point_options {
    const NAME: &'static str = "hp_key_point_options";
    const SHORTEST: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            method: HP_KEY_POINTS_HEAT,
            structure: f64::NAN,
            extent: f64::NAN,
            radius: f64::NAN,
            iterations: 0,
        }
    }
}

/// Fills *options with the defaults; struct_size is sizeof(hp_vote_options).
///
/// # Safety
/// `options` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_vote_options_init(
    options: *mut hp_vote_options,
    struct_size: u32,
) -> hp_status {
    let defaults = hp_vote_options::defaults();
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(options, struct_size, &defaults, "options") })
}

/// Fills *options with the defaults; struct_size is sizeof(hp_key_point_options).
///
/// # Safety
/// `options` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_key_point_options_init(
    options: *mut hp_key_point_options,
    struct_size: u32,
) -> hp_status {
    let defaults = hp_key_point_options::defaults();
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(options, struct_size, &defaults, "options") })
}
