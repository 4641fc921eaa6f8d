//! Vector instructions, chosen when the program runs.
//!
//! Two doors. [`SimdLevel::run`] compiles a plain loop once for each level and leaves the vectors to
//! the compiler: enough for loops that read each slice at one place. [`Real::with_lanes`] hands out
//! [`Lanes`], vectors with names, for the stencil, whose neighbours along a row are lanes of the
//! same or the next vector.
//!
//! On x86-64 the lanes of AVX2 and AVX-512 come from `pulp`, which checks the processor when it
//! runs. `wide` chooses when it is compiled; its vectors serve where nothing is to choose: as the
//! lanes that every processor of the target has (SSE2, NEON).

use bytemuck::Pod;
use std::ops::AddAssign;
use wide::{f32x4, f64x2, f64x8};

#[cfg(target_arch = "x86_64")]
use bytemuck::cast;
#[cfg(target_arch = "x86_64")]
use pulp::{
    Simd,
    x86::{V3, V4},
};

/// The vector instructions that a computation uses. Results do not depend on them.
///
/// One binary holds the inner loops once for each level and takes the best that the processor has.
/// On other processors than x86-64 the loops are compiled once, for what the target always has
/// (NEON on 64-bit ARM).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SimdLevel {
    /// What every processor of the target has: SSE2 on x86-64, NEON on 64-bit ARM.
    Baseline,
    /// 256-bit vectors of x86-64.
    Avx2,
    /// 512-bit vectors of x86-64.
    Avx512,
}

impl SimdLevel {
    /// The best level of this processor.
    #[must_use]
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if V4::is_available() {
                return Self::Avx512;
            }
            if V3::is_available() {
                return Self::Avx2;
            }
        }
        Self::Baseline
    }

    /// The usual name: `sse2`, `avx2`, `avx512`, `neon`, or `baseline` on other targets.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Avx512 => "avx512",
            Self::Avx2 => "avx2",
            Self::Baseline if cfg!(target_feature = "sse2") => "sse2",
            Self::Baseline if cfg!(target_feature = "neon") => "neon",
            Self::Baseline => "baseline",
        }
    }

    /// Runs `work` compiled for this level: whatever is inlined into it uses its instructions.
    #[inline(always)]
    pub(crate) fn run<R>(self, work: impl FnOnce() -> R) -> R {
        #[cfg(target_arch = "x86_64")]
        match self {
            Self::Avx512 => {
                if let Some(level) = V4::try_new() {
                    return level.vectorize(work);
                }
            }
            Self::Avx2 => {
                if let Some(level) = V3::try_new() {
                    return level.vectorize(work);
                }
            }
            Self::Baseline => {}
        }
        work()
    }
}

/// A vector of floating-point numbers and what the stencil does with it.
///
/// Every operation rounds as the same operation on single numbers does, and there is no fused
/// multiply-add, so results are the same bits at every level.
pub(crate) trait Lanes<T>: Copy {
    /// The numbers; as large and as aligned as a plain array of them, or less.
    type Vector: Pod;
    fn splat(self, value: T) -> Self::Vector;
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// The numbers one place before those of `here`: the last of `before`, then `here` without its
    /// last.
    fn one_before(self, before: Self::Vector, here: Self::Vector) -> Self::Vector;
    /// The numbers one place after those of `here`: `here` without its first, then the first of
    /// `after`.
    fn one_after(self, here: Self::Vector, after: Self::Vector) -> Self::Vector;
}

/// Work that is compiled once for each level.
pub(crate) trait WithLanes<T> {
    type Output;
    /// Must be `#[inline(always)]`, as must be what it calls in its inner loops: only what is inlined
    /// into it uses the level's instructions.
    fn run<L: Lanes<T>>(self, lanes: L) -> Self::Output;
}

/// A floating-point type that has [`Lanes`].
pub(crate) trait Real: Pod + Default + AddAssign + Send + Sync {
    /// Runs `work` with the lanes of `level`.
    fn with_lanes<W: WithLanes<Self>>(level: SimdLevel, work: W) -> W::Output;
    fn from_f64(value: f64) -> Self;
    fn to_f64(self) -> f64;
}

macro_rules! impl_real {
    ($real:ty) => {
        impl Real for $real {
            #[inline(always)]
            fn with_lanes<W: WithLanes<Self>>(level: SimdLevel, work: W) -> W::Output {
                #[cfg(target_arch = "x86_64")]
                match level {
                    SimdLevel::Avx512 => {
                        if let Some(lanes) = V4::try_new() {
                            return lanes.vectorize(
                                #[inline(always)]
                                || work.run(lanes),
                            );
                        }
                    }
                    SimdLevel::Avx2 => {
                        if let Some(lanes) = V3::try_new() {
                            return lanes.vectorize(
                                #[inline(always)]
                                || work.run(lanes),
                            );
                        }
                    }
                    SimdLevel::Baseline => {}
                }
                let _ = level;
                work.run(Portable)
            }

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as Self
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
        }
    };
}

impl_real!(f64);
impl_real!(f32);

/// The lanes that every processor of the target has.
#[derive(Clone, Copy)]
struct Portable;

macro_rules! impl_portable {
    ($real:ty, $vector:ty, |$low:ident, $high:ident| $before:expr, $after:expr) => {
        impl Lanes<$real> for Portable {
            type Vector = $vector;

            #[inline(always)]
            fn splat(self, value: $real) -> Self::Vector {
                <$vector>::splat(value)
            }

            #[inline(always)]
            fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                a + b
            }

            #[inline(always)]
            fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                a - b
            }

            #[inline(always)]
            fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                a * b
            }

            #[inline(always)]
            fn one_before(self, before: Self::Vector, here: Self::Vector) -> Self::Vector {
                let ($low, $high) = (before.to_array(), here.to_array());
                <$vector>::from($before)
            }

            #[inline(always)]
            fn one_after(self, here: Self::Vector, after: Self::Vector) -> Self::Vector {
                let ($low, $high) = (here.to_array(), after.to_array());
                <$vector>::from($after)
            }
        }
    };
}

impl_portable!(f64, f64x2, |low, high| [low[1], high[0]], [low[1], high[0]]);
impl_portable!(
    f32,
    f32x4,
    |low, high| [low[3], high[0], high[1], high[2]],
    [low[1], low[2], low[3], high[0]]
);

#[cfg(target_arch = "x86_64")]
macro_rules! impl_x86 {
    (
        $level:ty, $real:ty, $vector:ident, $splat:ident, $add:ident, $sub:ident, $mul:ident,
        |$simd:ident, $low:ident, $high:ident| $before:expr, $after:expr
    ) => {
        impl Lanes<$real> for $level {
            type Vector = <$level as Simd>::$vector;

            #[inline(always)]
            fn splat(self, value: $real) -> Self::Vector {
                Simd::$splat(self, value)
            }

            #[inline(always)]
            fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                Simd::$add(self, a, b)
            }

            #[inline(always)]
            fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                Simd::$sub(self, a, b)
            }

            #[inline(always)]
            fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                Simd::$mul(self, a, b)
            }

            #[inline(always)]
            fn one_before(self, $low: Self::Vector, $high: Self::Vector) -> Self::Vector {
                let $simd = self;
                cast($before)
            }

            #[inline(always)]
            fn one_after(self, $low: Self::Vector, $high: Self::Vector) -> Self::Vector {
                let $simd = self;
                cast($after)
            }
        }
    };
}

/// The upper half of `low`, then the lower half of `high`.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn middle<V: Pod>(simd: V3, low: V, high: V) -> std::arch::x86_64::__m256d {
    simd.avx._mm256_permute2f128_pd::<0x21>(cast(low), cast(high))
}

#[cfg(target_arch = "x86_64")]
impl_x86!(
    V4,
    f64,
    f64s,
    splat_f64s,
    add_f64s,
    sub_f64s,
    mul_f64s,
    |simd, low, high| simd.avx512f._mm512_alignr_epi64::<7>(cast(high), cast(low)),
    simd.avx512f._mm512_alignr_epi64::<1>(cast(high), cast(low))
);
#[cfg(target_arch = "x86_64")]
impl_x86!(
    V4,
    f32,
    f32s,
    splat_f32s,
    add_f32s,
    sub_f32s,
    mul_f32s,
    |simd, low, high| simd.avx512f._mm512_alignr_epi32::<15>(cast(high), cast(low)),
    simd.avx512f._mm512_alignr_epi32::<1>(cast(high), cast(low))
);
#[cfg(target_arch = "x86_64")]
impl_x86!(
    V3,
    f64,
    f64s,
    splat_f64s,
    add_f64s,
    sub_f64s,
    mul_f64s,
    |simd, low, high| simd.avx._mm256_shuffle_pd::<0b0101>(middle(simd, low, high), cast(high)),
    simd.avx._mm256_shuffle_pd::<0b0101>(cast(low), middle(simd, low, high))
);
#[cfg(target_arch = "x86_64")]
impl_x86!(
    V3,
    f32,
    f32s,
    splat_f32s,
    add_f32s,
    sub_f32s,
    mul_f32s,
    |simd, low, high| {
        simd.avx2._mm256_alignr_epi8::<12>(cast(high), cast(middle(simd, low, high)))
    },
    simd.avx2._mm256_alignr_epi8::<4>(cast(middle(simd, low, high)), cast(low))
);

/// Numbers that begin at a cache line, so that no vector straddles two.
#[derive(Clone, Debug, Default)]
pub(crate) struct Aligned<T> {
    lines: Vec<f64x8>,
    _numbers: std::marker::PhantomData<T>,
}

impl<T: Pod> Aligned<T> {
    /// At least `len` zeros.
    pub(crate) fn zeros(len: usize) -> Self {
        let lines = vec![f64x8::ZERO; (len * size_of::<T>()).div_ceil(size_of::<f64x8>())];
        Self { lines, _numbers: std::marker::PhantomData }
    }
}

impl<T: Pod> std::ops::Deref for Aligned<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        bytemuck::cast_slice(&self.lines)
    }
}

impl<T: Pod> std::ops::DerefMut for Aligned<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        bytemuck::cast_slice_mut(&mut self.lines)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks every operation of a level against plain numbers.
    struct Check<T>(Vec<T>);

    impl<T: Real> WithLanes<T> for Check<T> {
        type Output = usize;

        #[inline(always)]
        fn run<L: Lanes<T>>(self, lanes: L) -> usize {
            let n = size_of::<L::Vector>() / size_of::<T>();
            let vector = |from: usize| {
                bytemuck::pod_read_unaligned::<L::Vector>(bytemuck::cast_slice(
                    &self.0[from..from + n],
                ))
            };
            let numbers =
                |vector: L::Vector| -> Vec<T> { bytemuck::cast_slice(&[vector]).to_vec() };
            let (low, high): (L::Vector, L::Vector) = (vector(0), vector(n));
            let plain =
                |vector| -> Vec<f64> { numbers(vector).into_iter().map(T::to_f64).collect() };
            let given: Vec<f64> = self.0.iter().map(|number| number.to_f64()).collect();
            assert_eq!(plain(lanes.one_before(low, high)), given[n - 1..2 * n - 1]);
            assert_eq!(plain(lanes.one_after(low, high)), given[1..=n]);
            let expected = |operation: fn(f64, f64) -> f64| -> Vec<f64> {
                given[..n].iter().zip(&given[n..]).map(|(&a, &b)| operation(a, b)).collect()
            };
            assert_eq!(plain(lanes.add(low, high)), expected(|a, b| a + b));
            assert_eq!(plain(lanes.sub(low, high)), expected(|a, b| a - b));
            assert_eq!(plain(lanes.mul(low, high)), expected(|a, b| a * b));
            assert_eq!(plain(lanes.splat(self.0[3])), vec![given[3]; n]);
            n
        }
    }

    #[test]
    fn lanes_do_what_plain_numbers_do() {
        let numbers = || (0..32).map(|i| 1.0 + 0.375 * f64::from(i * i % 37));
        for level in [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512] {
            if level > SimdLevel::best() {
                continue;
            }
            let bytes = 16 << level as usize;
            assert_eq!(f64::with_lanes(level, Check(numbers().collect())), bytes / 8);
            let singles = numbers().map(|number| number as f32).collect();
            assert_eq!(f32::with_lanes(level, Check::<f32>(singles)), bytes / 4);
        }
    }

    #[test]
    fn aligned_numbers_begin_at_a_cache_line() {
        let numbers = Aligned::<f32>::zeros(33);
        assert_eq!(numbers.as_ptr().align_offset(64), 0);
        assert!(numbers.len() >= 33 && numbers.iter().all(|&number| number == 0.0));
    }
}
