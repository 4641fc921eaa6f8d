//! Vector instructions, chosen when the program runs.
//!
//! Two doors. [`SimdLevel::run`] compiles a plain loop once for each level and leaves the vectors to
//! the compiler: enough for loops that read each slice at one place. [`SimdLevel::with_lanes`] hands out
//! [`Lanes`], vectors with names, for the stencil, whose neighbours along a row are lanes of the
//! same or the next vector.
//!
//! On x86-64 the lanes of AVX2 and AVX-512 come from `pulp`, which checks the processor when it
//! runs. `wide` chooses when it is compiled; its vectors serve where nothing is to choose: as the
//! lanes that every processor of the target has (SSE2, NEON).

use bytemuck::{Pod, cast_slice, pod_read_unaligned};
use std::ops::{Deref, DerefMut};
use wide::{f64x2, f64x8};

#[cfg(target_arch = "x86_64")]
use bytemuck::cast;
#[cfg(target_arch = "x86_64")]
use pulp::{
    Simd,
    x86::{V3, V4},
};

/// Has the memory of an item fetched into the cache while the program goes on; where there is no such
/// instruction, reads it.
#[inline(always)]
pub(crate) fn prefetch<T: Copy>(item: &T) {
    #[cfg(target_arch = "x86_64")]
    safe_arch::prefetch_t0(item);
    #[cfg(not(target_arch = "x86_64"))]
    std::hint::black_box(*item);
}

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

    /// Runs `work` with the lanes of this level.
    #[inline(always)]
    pub(crate) fn with_lanes<W: WithLanes>(self, work: W) -> W::Output {
        #[cfg(target_arch = "x86_64")]
        match self {
            Self::Avx512 => {
                if let Some(lanes) = V4::try_new() {
                    return lanes.vectorize(
                        #[inline(always)]
                        || work.run(lanes),
                    );
                }
            }
            Self::Avx2 => {
                if let Some(lanes) = V3::try_new() {
                    return lanes.vectorize(
                        #[inline(always)]
                        || work.run(lanes),
                    );
                }
            }
            Self::Baseline => {}
        }
        work.run(Portable)
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

/// A vector of numbers and what the stencil does with it.
///
/// Every operation rounds as the same operation on single numbers does, and there is no fused
/// multiply-add, so results are the same bits at every level.
pub(crate) trait Lanes: Copy {
    type Vector: Pod;
    fn splat(self, value: f64) -> Self::Vector;
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// As many of some numbers as a vector holds, from number `from` on.
    fn widen(self, numbers: &[f32], from: usize) -> Self::Vector;
    /// The numbers one place before those of `here`: the last of `before`, then `here` without its
    /// last.
    fn one_before(self, before: Self::Vector, here: Self::Vector) -> Self::Vector;
    /// The numbers one place after those of `here`: `here` without its first, then the first of
    /// `after`.
    fn one_after(self, here: Self::Vector, after: Self::Vector) -> Self::Vector;
}

/// Work that is compiled once for each level.
pub(crate) trait WithLanes {
    type Output;
    /// Must be `#[inline(always)]`, as must be what it calls in its inner loops: only what is inlined
    /// into it uses the level's instructions.
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// The lanes that every processor of the target has.
#[derive(Clone, Copy)]
struct Portable;

impl Lanes for Portable {
    type Vector = f64x2;

    #[inline(always)]
    fn splat(self, value: f64) -> f64x2 {
        f64x2::splat(value)
    }

    #[inline(always)]
    fn add(self, a: f64x2, b: f64x2) -> f64x2 {
        a + b
    }

    #[inline(always)]
    fn sub(self, a: f64x2, b: f64x2) -> f64x2 {
        a - b
    }

    #[inline(always)]
    fn mul(self, a: f64x2, b: f64x2) -> f64x2 {
        a * b
    }

    #[inline(always)]
    fn widen(self, numbers: &[f32], from: usize) -> f64x2 {
        f64x2::from([f64::from(numbers[from]), f64::from(numbers[from + 1])])
    }

    #[inline(always)]
    fn one_before(self, before: f64x2, here: f64x2) -> f64x2 {
        f64x2::from([before.to_array()[1], here.to_array()[0]])
    }

    #[inline(always)]
    fn one_after(self, here: f64x2, after: f64x2) -> f64x2 {
        f64x2::from([here.to_array()[1], after.to_array()[0]])
    }
}

#[cfg(target_arch = "x86_64")]
macro_rules! impl_lanes {
    (
        $level:ty,
        |$simd:ident, $low:ident, $high:ident| $before:expr,
        $after:expr,
        |$numbers:ident| $widen:expr
    ) => {
        impl Lanes for $level {
            type Vector = <$level as Simd>::f64s;

            #[inline(always)]
            fn splat(self, value: f64) -> Self::Vector {
                self.splat_f64s(value)
            }

            #[inline(always)]
            fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                self.add_f64s(a, b)
            }

            #[inline(always)]
            fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                self.sub_f64s(a, b)
            }

            #[inline(always)]
            fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
                self.mul_f64s(a, b)
            }

            #[inline(always)]
            fn widen(self, numbers: &[f32], from: usize) -> Self::Vector {
                let $simd = self;
                let $numbers = &numbers[from..from + size_of::<Self::Vector>() / size_of::<f64>()];
                cast($widen)
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

#[cfg(target_arch = "x86_64")]
impl_lanes!(
    V4,
    |simd, low, high| simd.avx512f._mm512_alignr_epi64::<7>(cast(high), cast(low)),
    simd.avx512f._mm512_alignr_epi64::<1>(cast(high), cast(low)),
    |numbers| simd.avx512f._mm512_cvtps_pd(pod_read_unaligned(cast_slice(numbers)))
);

#[cfg(target_arch = "x86_64")]
impl_lanes!(
    V3,
    |simd, low, high| simd.avx._mm256_shuffle_pd::<0b0101>(middle(simd, low, high), cast(high)),
    simd.avx._mm256_shuffle_pd::<0b0101>(cast(low), middle(simd, low, high)),
    |numbers| simd.avx._mm256_cvtps_pd(pod_read_unaligned(cast_slice(numbers)))
);

/// The upper half of `low`, then the lower half of `high`.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn middle<V: Pod>(simd: V3, low: V, high: V) -> std::arch::x86_64::__m256d {
    simd.avx._mm256_permute2f128_pd::<0x21>(cast(low), cast(high))
}

/// Numbers that begin at a cache line, so that no vector straddles two.
#[derive(Clone, Debug, Default)]
pub(crate) struct Aligned {
    lines: Vec<f64x8>,
}

impl Aligned {
    /// At least `len` zeros.
    pub(crate) fn zeros(len: usize) -> Self {
        Self { lines: vec![f64x8::ZERO; len.div_ceil(8)] }
    }
}

impl Deref for Aligned {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        cast_slice(&self.lines)
    }
}

impl DerefMut for Aligned {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(&mut self.lines)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks every operation of a level against plain numbers.
    struct Check(Vec<f64>);

    impl WithLanes for Check {
        type Output = usize;

        #[inline(always)]
        fn run<L: Lanes>(self, lanes: L) -> usize {
            let n = size_of::<L::Vector>() / size_of::<f64>();
            let given = &self.0;
            let vector = |from: usize| -> L::Vector {
                pod_read_unaligned(cast_slice(&given[from..from + n]))
            };
            let plain = |vector: L::Vector| cast_slice::<_, f64>(&[vector]).to_vec();
            let (low, high) = (vector(0), vector(n));
            assert_eq!(plain(lanes.one_before(low, high)), given[n - 1..2 * n - 1]);
            assert_eq!(plain(lanes.one_after(low, high)), given[1..=n]);
            let expected = |operation: fn(f64, f64) -> f64| -> Vec<f64> {
                given[..n].iter().zip(&given[n..]).map(|(&a, &b)| operation(a, b)).collect()
            };
            assert_eq!(plain(lanes.add(low, high)), expected(|a, b| a + b));
            assert_eq!(plain(lanes.sub(low, high)), expected(|a, b| a - b));
            assert_eq!(plain(lanes.mul(low, high)), expected(|a, b| a * b));
            assert_eq!(plain(lanes.splat(given[3])), vec![given[3]; n]);
            // All of them are short enough.
            let short: Vec<f32> = given.iter().map(|&number| number as f32).collect();
            assert_eq!(plain(lanes.widen(&short, 3)), given[3..3 + n]);
            n
        }
    }

    #[test]
    fn lanes_do_what_plain_numbers_do() {
        let numbers: Vec<_> = (0..16).map(|i| 1.0 + 0.375 * f64::from(i * i % 37)).collect();
        for (level, lanes) in
            [(SimdLevel::Baseline, 2), (SimdLevel::Avx2, 4), (SimdLevel::Avx512, 8)]
        {
            if level <= SimdLevel::best() {
                assert_eq!(level.with_lanes(Check(numbers.clone())), lanes);
            }
        }
    }

    #[test]
    fn aligned_numbers_begin_at_a_cache_line() {
        let numbers = Aligned::zeros(33);
        assert_eq!(numbers.as_ptr().align_offset(64), 0);
        assert!(numbers.len() >= 33 && numbers.iter().all(|&number| number == 0.0));
    }
}
