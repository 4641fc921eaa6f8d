//! What to compute and how: medium, heat, estimator, threads, progress.

use crate::status::{guard, hp_status};
use crate::structs::{self, Versioned};
use std::ffi::{c_int, c_void};
use std::mem::size_of;

/// The same everywhere: distances are Euclidean, around the walls of the mask. Of the image only
/// the size and spacing count; its data may be NULL.
pub const HP_MEDIUM_UNIFORM: u32 = 1;
/// Heat flows where the grey value f resembles that of the sources: k = |1 - |f0 - f||^power +
/// floor. The default.
pub const HP_MEDIUM_CONDUCTIVITY: u32 = 2;
/// Heat stays inside regions without edges (Perona and Malik).
pub const HP_MEDIUM_PERONA_MALIK: u32 = 3;
/// Grey value and edges together: the product of the two above.
pub const HP_MEDIUM_COMBINED: u32 = 4;
/// Heat runs along edges and thin lines: D = |grad f|^2 + floor.
pub const HP_MEDIUM_EDGES: u32 = 5;
/// The image itself is the medium, positive everywhere and not scaled. Lengths are
/// ds / sqrt(image): a cost c per length is the image 1 / c^2.
pub const HP_MEDIUM_GIVEN: u32 = 6;
/// The medium is hp_options.tensor, one symmetric positive definite matrix for each pixel: the
/// diffusion tensor D. Heat is fast along its eigenvectors of large eigenvalues, and lengths are
/// sqrt(dx' D^-1 dx); a metric tensor must be inverted. Of the image only the size and spacing
/// count; its data may be NULL.
pub const HP_MEDIUM_GIVEN_TENSOR: u32 = 7;

/// D of eq. (12): heat runs along the directions of the image, see hp_options.directions and
/// anisotropy.
pub const HP_MEDIUM_TENSOR: u32 = 8;
/// k = v^power + floor, with the response v, from 0 to 1, of a filter for tubes: vessels, wires,
/// fibres; see hp_options.polarity, scales, elongation and anisotropy.
pub const HP_MEDIUM_VESSELNESS: u32 = 9;

/// Along the axis of least curvature of the grey values: along tubes. The default.
pub const HP_DIRECTIONS_HESSIAN: u32 = 0;
/// Along the lines of a texture.
pub const HP_DIRECTIONS_STRUCTURE: u32 = 1;
/// Along edges: across the gradient.
pub const HP_DIRECTIONS_GRADIENT: u32 = 2;

/// Bright tubes for HP_MEDIUM_VESSELNESS, both kinds for HP_MEDIUM_TENSOR. The default.
pub const HP_POLARITY_DEFAULT: u32 = 0;
/// Tubes that are brighter than what is around them.
pub const HP_POLARITY_BRIGHT: u32 = 1;
/// Tubes that are darker than what is around them.
pub const HP_POLARITY_DARK: u32 = 2;
/// Both kinds.
pub const HP_POLARITY_BOTH: u32 = 3;

/// D = exp(-(|grad f| / contrast)^2). The default.
pub const HP_EDGE_STOP_EXPONENTIAL: u32 = 1;
/// D = 1 / (1 + (|grad f| / contrast)^2).
pub const HP_EDGE_STOP_RATIONAL: u32 = 2;

/// The medium's own choice: divergence, but pointwise for HP_MEDIUM_CONDUCTIVITY and
/// HP_MEDIUM_GIVEN.
pub const HP_FORM_DEFAULT: u32 = 0;
/// u_t = div(D grad u).
pub const HP_FORM_DIVERGENCE: u32 = 1;
/// u_t = D laplace(u).
pub const HP_FORM_POINTWISE: u32 = 2;

/// sqrt(-4 t log(u / u0)), where u0 is the temperature at the sources, and the like for implicit
/// heat. The default, for lengths. With several sources explicit heat flows twice, to make them
/// equally warm.
pub const HP_NORMALIZED: u32 = 1;
/// sqrt(-4 t log u), Varadhan's formula as it stands, and -sqrt(t) log u of implicit heat: too long
/// near the sources.
pub const HP_VARADHAN: u32 = 2;
/// The heat method: heat flows for a short time, and distances are the function that rises along its
/// direction. Prepared once, it is fast for many sources; distances are smooth. Not for media of
/// tensors. It takes some 1.1 kB for each pixel of a picture, and many more for a volume; of the
/// options of heat time (0, the default, stands for 1 over the mean of the medium) and memory count.
pub const HP_HEAT_METHOD: u32 = 4;
/// The exact weighted distance, without heat: the eikonal equation by fast marching, to second order.
/// What is about heat alone is ignored: iterations, time, step, solver and memory. It takes one
/// thread.
pub const HP_EIKONAL: u32 = 3;

/// Many small time steps, for images of any size. The default.
pub const HP_SOLVER_EXPLICIT: u32 = 0;
/// One time step of any length, or a few, by a sparse factorisation: prepared once, it serves many
/// sources. It takes some 550 bytes for each pixel of a picture, and many more for a volume.
pub const HP_SOLVER_IMPLICIT: u32 = 1;

/// Is called from time to time with the finished part, from 0 to 1 and never falling, always on
/// the thread that called the library. Anything but 0 cancels: the call then returns
/// HP_CANCELLED.
///
/// It may call the library, but must not throw an exception or jump out.
pub type hp_progress = Option<unsafe extern "C" fn(finished: f64, user: *mut c_void) -> c_int>;

/// What to compute and how. NULL in place of it means all defaults.
///
/// Fill it with hp_options_init(), then change fields. It is only read, and not kept; several
/// threads may use the same one if its callback allows that. Parameters that the medium or the
/// estimator does not use are ignored.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_options {
    /// sizeof(hp_options).
    pub struct_size: u32,
    /// One of HP_MEDIUM_...; HP_MEDIUM_CONDUCTIVITY by default.
    pub medium: u32,
    /// For conductivity and combined: how strongly unlike grey values are held back. For vesselness:
    /// how strongly weak tubes are. Positive. Not a number (NAN), the default, stands for 3, of
    /// vesselness for 2.
    pub power: f64,
    /// For conductivity, combined, edges and vesselness: what keeps the medium above zero. Positive.
    /// Not a number (NAN), the default, stands for 0.001, of vesselness for 0.0001.
    pub floor: f64,
    /// For Perona-Malik and combined: the gradient, in grey values (full range 1) per pixel, at
    /// which heat is held back. For vesselness: the strength of a tube whose response is 1. Positive.
    /// Not a number (NAN), the default, stands for 0.03; of vesselness for the strongest tube of the
    /// image, and for 0.125 if normalize is set.
    pub contrast: f64,
    /// For Perona-Malik and combined: HP_EDGE_STOP_EXPONENTIAL, the default, or
    /// HP_EDGE_STOP_RATIONAL.
    pub edge_stop: u32,
    /// For Perona-Malik, combined, edges and given: one of HP_FORM_...
    pub form: u32,
    /// For Perona-Malik, combined and edges: the standard deviation, in pixels, of the Gaussian
    /// before the gradient. 0, the default, is none.
    pub smoothing: f64,
    /// The pixel value that becomes grey value 0. Not a number (NAN), the default, stands for 0 if
    /// pixels are HP_U8 or HP_U16, and else for the smallest value of the image.
    pub range_low: f64,
    /// The pixel value that becomes grey value 1. Not a number (NAN), the default, stands for the
    /// largest value of the type if pixels are HP_U8 or HP_U16, and else for that of the image.
    pub range_high: f64,
    /// The number of time steps; heat moves one pixel a step. 0, the default, takes twice the
    /// longest side of a picture and three times that of a volume, unless a time is given. Of
    /// HP_SOLVER_IMPLICIT it is 1 by default, at most 1000, and may be given besides a time.
    pub iterations: u64,
    /// The time for which heat flows, in units of the smallest spacing squared; steps are shortened
    /// to fit. 0, the default, leaves it to the iterations; of HP_SOLVER_IMPLICIT it stands for 16.
    pub time: f64,
    /// The time step, in units of the smallest spacing squared. Not a number (NAN), the default,
    /// stands for 0.2 in pictures and 2/15 in volumes; 0 takes a safe fraction of the largest one
    /// that the medium allows. HP_SOLVER_IMPLICIT has none: leave it NAN.
    pub step: f64,
    /// HP_NORMALIZED, the default, HP_VARADHAN, HP_EIKONAL or HP_HEAT_METHOD.
    pub estimator: u32,
    /// The number of threads, up to 1024; 0, the default, is one per processor, and 1 the calling
    /// thread alone. Results do not depend on it.
    pub threads: u32,
    /// Is told how far the computation is, and may cancel it. NULL by default.
    pub progress: hp_progress,
    /// What the progress callback gets as its second argument.
    pub user: *mut c_void,
    /// HP_SOLVER_EXPLICIT, the default, or HP_SOLVER_IMPLICIT.
    pub solver: u32,
    /// 0.
    pub reserved: u32,
    /// For conductivity and combined: the grey value f0, from 0 to 1, that the image is compared
    /// with. Not a number (NAN), the default, stands for that of the sources.
    pub reference: f64,
    /// For HP_SOLVER_IMPLICIT and HP_HEAT_METHOD: the most bytes that a factorisation may take. 0, the default,
    /// stands for 4 GiB.
    pub memory: u64,
    /// For HP_EIKONAL: the distance, in physical units, beyond which nothing is reached. 0, the
    /// default, stands for no end.
    pub farthest: f64,
    /// For HP_MEDIUM_GIVEN_TENSOR: the components of the matrices in physical units, those of the
    /// first pixel first, then x fastest: xx, xy, yy of each pixel of a picture and xx, xy, xz, yy,
    /// yz, zz of a volume. They follow each other without gaps, and need not be aligned.
    pub tensor: *const f64,
    /// The number of these components: 3 or, in a volume, 6 for each pixel.
    pub tensor_count: u64,
    /// For HP_MEDIUM_TENSOR: one of HP_DIRECTIONS_...; HP_DIRECTIONS_HESSIAN by default.
    pub directions: u32,
    /// For HP_MEDIUM_VESSELNESS, and HP_DIRECTIONS_HESSIAN of HP_MEDIUM_TENSOR: one of
    /// HP_POLARITY_...
    pub polarity: u32,
    /// For HP_MEDIUM_TENSOR and HP_MEDIUM_VESSELNESS: A of eq. (14), heat is (1 + A) / (1 - A) times
    /// as fast along as across. Up to 0.9998. 0, the default, stands for 0.9 of the former, and for
    /// none of the latter.
    pub anisotropy: f64,
    /// For HP_MEDIUM_VESSELNESS: the half widths of tubes to look for, in multiples of the smallest
    /// spacing; 2, 3 and 4.5 by default; hp_tube_scales() finds those of an image. For HP_MEDIUM_TENSOR:
    /// one, the Gaussian before the derivatives; 2 by default. Need not be aligned.
    pub scales: *const f64,
    /// How many scales there are, up to 64; 0, the default, stands for those above.
    pub scale_count: u64,
    /// For HP_MEDIUM_VESSELNESS: how much longer than wide the filter is, from 1 to 10: faint tubes
    /// stand out, but take ten times as long. 0, the default, stands for 1.
    pub elongation: f64,
    /// For all media that see grey values: light is evened out over so many multiples of the smallest
    /// spacing, the standard deviation of a Gaussian. 0, the default, leaves it as it is.
    pub normalize: f64,
    /// By how many multiples of the smallest spacing the walls of a mask are made thicker; 0 by
    /// default. The rim of a field of view looks like a line otherwise.
    pub margin: f64,
}

// SAFETY: integers, floats and pointers of which any can be NULL; an 8-byte number at the end.
unsafe impl Versioned for hp_options {
    const NAME: &'static str = "hp_options";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            medium: HP_MEDIUM_CONDUCTIVITY,
            power: f64::NAN,
            floor: f64::NAN,
            contrast: f64::NAN,
            edge_stop: HP_EDGE_STOP_EXPONENTIAL,
            form: HP_FORM_DEFAULT,
            smoothing: 0.0,
            range_low: f64::NAN,
            range_high: f64::NAN,
            iterations: 0,
            time: 0.0,
            step: f64::NAN,
            estimator: HP_NORMALIZED,
            threads: 0,
            progress: None,
            user: std::ptr::null_mut(),
            solver: HP_SOLVER_EXPLICIT,
            reserved: 0,
            reference: f64::NAN,
            memory: 0,
            farthest: 0.0,
            tensor: std::ptr::null(),
            tensor_count: 0,
            directions: HP_DIRECTIONS_HESSIAN,
            polarity: HP_POLARITY_DEFAULT,
            anisotropy: 0.0,
            scales: std::ptr::null(),
            scale_count: 0,
            elongation: 0.0,
            normalize: 0.0,
            margin: 0.0,
        }
    }
}

/// Fills *options with the defaults; struct_size is sizeof(hp_options).
///
/// # Safety
/// `options` is NULL or points to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_options_init(options: *mut hp_options, struct_size: u32) -> hp_status {
    // SAFETY: the caller promises the bytes.
    guard(|| unsafe { structs::write(options, struct_size, &hp_options::defaults(), "options") })
}
