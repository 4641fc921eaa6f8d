//! What to compute on a mesh and how.

use crate::array::hp_array;
use crate::options::hp_progress;
use crate::status::{guard, hp_status};
use crate::structs::{self, Versioned};
use std::ffi::c_void;
use std::mem::size_of;

/// Distances are lengths on the surface. The default.
pub const HP_MESH_UNIFORM: u32 = 1;
/// hp_mesh_options.values are the squared speed P at each vertex: lengths are ds / sqrt(P). The
/// slowness of a face is the mean of 1 / sqrt(P) at its corners.
pub const HP_MESH_SPEED_SQ: u32 = 2;
/// hp_mesh_options.values are the slowness F of each face: lengths are F ds.
pub const HP_MESH_SLOWNESS: u32 = 3;
/// hp_mesh_options.values are the metric G of each face, a symmetric positive definite matrix xx, xy,
/// xz, yy, yz, zz: lengths are sqrt(dx' G dx).
pub const HP_MESH_METRIC: u32 = 4;
/// hp_mesh_options.values are a texture or measurement f, from 0 to 1, at each vertex, and P = |1 -
/// |reference - f||^power + floor: ways are short where f resembles the reference.
pub const HP_MESH_SCALARS: u32 = 5;
/// P = floor + (1 - floor) min(kappa / kappa_q, 1)^power with the curvature kappa and its quantile
/// kappa_q: ways are short where the surface bends, along ridges and valleys.
pub const HP_MESH_CURVATURE: u32 = 6;
/// As HP_MESH_CURVATURE along the direction of the ridge or valley, and 1 / sqrt(floor) across it.
pub const HP_MESH_CREASE: u32 = 7;

/// HP_MESH_EXACT for up to 20,000 faces that are all equally slow; else HP_MESH_EIKONAL. The default.
pub const HP_MESH_AUTO: u32 = 0;
/// The heat method: heat flows for a short time, and distances are the function that rises along its
/// direction. Prepared once, it is then faster than the others for many sources. Distances are
/// smooth, and too short where the surface is coarse or narrow. Not for media whose slowness
/// jumps.
pub const HP_MESH_HEAT: u32 = 1;
/// Fast marching with round fronts: little to prepare, for any medium.
pub const HP_MESH_EIKONAL: u32 = 2;
/// The exact distance on the triangles, by straight lines unfolded over the faces. For media that are
/// the same everywhere, and meshes of up to some 100,000 vertices.
pub const HP_MESH_EXACT: u32 = 3;
/// Explicit heat in many small steps, as the paper has it: right where all edges are about equally
/// long, and to compare with. Sources must have no offsets.
pub const HP_MESH_EXPLICIT: u32 = 4;

/// Ridges and valleys count. The default.
pub const HP_BEND_BOTH: u32 = 0;
/// Ridges: where the surface is convex as seen from outside.
pub const HP_BEND_CONVEX: u32 = 1;
/// Valleys: where it is concave.
pub const HP_BEND_CONCAVE: u32 = 2;

/// Signed angles between faces, added up over a ball: for sharp edges and noisy meshes. The default.
pub const HP_CURVATURE_NORMAL_CYCLES: u32 = 0;
/// The changes of the normals, by least squares: the most accurate on smooth surfaces without noise.
pub const HP_CURVATURE_LEAST_SQUARES: u32 = 1;

/// What to compute on a mesh and how. NULL in place of it means all defaults.
///
/// Fill it with hp_mesh_options_init(), then change fields. It is only read, and not kept; several
/// threads may use the same one if its callback allows that.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_mesh_options {
    /// sizeof(hp_mesh_options).
    pub struct_size: u32,
    /// The number of threads, up to 1024; 0, the default, is one per processor, and 1 the calling
    /// thread alone. Results do not depend on it.
    pub threads: u32,
    /// Is told how far the computation is, and may cancel it. NULL by default.
    pub progress: hp_progress,
    /// What the progress callback gets as its second argument.
    pub user: *mut c_void,
    /// For hp_mesh_create(): vertices at most this far apart are joined; 0 joins those at equal
    /// positions only. Not a number (NAN), the default, joins none. Files of triangles without
    /// shared vertices, such as STL, need it.
    pub weld: f64,
    /// For hp_mesh_solver_create(): HP_MESH_UNIFORM, the default, or another one up to HP_MESH_CREASE.
    pub medium: u32,
    /// For hp_mesh_solver_create(): HP_MESH_AUTO, the default, or another one up to
    /// HP_MESH_EXPLICIT.
    pub method: u32,
    /// For the media that are made of values: one for each vertex or face; see hp_mesh_faces() for
    /// faces. NULL by default. It is not needed any more once the solver is made.
    pub values: *const hp_array,
    /// For HP_MESH_HEAT: how long heat flows, in multiples of the mean squared side of a face. 0, the
    /// default, stands for 4 on smooth meshes, down to 0.5 where faces meet at sharp angles.
    pub time: f64,
    /// For HP_MESH_HEAT: the most bytes that each of two or three factorisations may take. 0, the
    /// default, stands for 4 GiB.
    pub memory: u64,
    /// For hp_mesh_solver_create(): the distance beyond which nothing is reached. 0, the default,
    /// stands for no end. It saves time with HP_MESH_EIKONAL and HP_MESH_EXACT.
    pub farthest: f64,
    /// For hp_mesh_curvature() and media of curvature: the radius of the ball over which it is
    /// averaged. 0, the default, stands for 4 mean edges with HP_CURVATURE_NORMAL_CYCLES, and for
    /// the faces at the vertex alone with HP_CURVATURE_LEAST_SQUARES.
    pub radius: f64,
    /// For hp_mesh_curvature() and media of curvature: HP_CURVATURE_NORMAL_CYCLES, the default, or
    /// HP_CURVATURE_LEAST_SQUARES.
    pub curvature: u32,
    /// For paths: anything but 0 makes them locally shortest, straight across all edges. For
    /// HP_MESH_UNIFORM only. 0 by default.
    pub shorten: u32,
    /// For HP_MESH_CURVATURE and HP_MESH_CREASE: HP_BEND_BOTH, the default, HP_BEND_CONVEX or
    /// HP_BEND_CONCAVE.
    pub bend: u32,
    /// 0.
    pub reserved: u32,
    /// For scalars, curvature and crease: what keeps P above zero. Not a number (NAN), the default,
    /// stands for 0.001 with scalars, and for 0.01 with the others, where it is at most 1.
    pub floor: f64,
    /// For scalars, curvature and crease: the power, positive. Not a number (NAN), the default,
    /// stands for 3 with scalars, and for 1 with the others.
    pub power: f64,
    /// For curvature and crease: the part of the vertices that bend less than what counts as fully
    /// bent; above 0, at most 1. 0.99 by default.
    pub quantile: f64,
    /// For scalars: the value f that the others are compared with. There is no default.
    pub reference: f64,
    /// For HP_MESH_EXPLICIT: the number of time steps, up to 10^9. 0, the default, stands for enough to
    /// reach all vertices.
    pub iterations: u64,
    /// For HP_MESH_EXPLICIT: the time step, where P is 1 the mean number of edges that heat goes in
    /// one. Not a number (NAN), the default, stands for 0.2, or less where that is unstable; 0 takes a
    /// safe fraction of the largest one that is stable.
    pub step: f64,
}

// SAFETY: integers, floats and pointers of which any can be NULL; 8 bytes at the end.
unsafe impl Versioned for hp_mesh_options {
    const NAME: &'static str = "hp_mesh_options";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            threads: 0,
            progress: None,
            user: std::ptr::null_mut(),
            weld: f64::NAN,
            medium: HP_MESH_UNIFORM,
            method: HP_MESH_AUTO,
            values: std::ptr::null(),
            time: 0.0,
            memory: 0,
            farthest: 0.0,
            radius: 0.0,
            curvature: HP_CURVATURE_NORMAL_CYCLES,
            shorten: 0,
            bend: HP_BEND_BOTH,
            reserved: 0,
            floor: f64::NAN,
            power: f64::NAN,
            quantile: 0.99,
            reference: f64::NAN,
            iterations: 0,
            step: f64::NAN,
        }
    }
}

/// Fills *options with the defaults; struct_size is sizeof(hp_mesh_options).
///
/// # Safety
/// `options` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_mesh_options_init(
    options: *mut hp_mesh_options,
    struct_size: u32,
) -> hp_status {
    let defaults = hp_mesh_options::defaults();
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(options, struct_size, &defaults, "options") })
}
