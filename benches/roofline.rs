//! What this machine can do at most, and what that means for explicit heat.
//!
//! `cargo bench -p heatpath-benches --bench roofline` prints the bandwidth of each cache and of the
//! memory, the rate of additions and multiplications, and the rates of cell updates that follow. All
//! are the best of a few tenths of a second: limits, not averages. Fused multiply-add is not counted
//! because heatpath does not use it, so that every processor rounds alike.
#![allow(clippy::print_stdout, reason = "this program prints a table")]

use heatpath_core::exec::SimdLevel;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};
use pulp::{Scalar128b, Simd, WithSimd};
use std::array;
use std::fs;
use std::hint::black_box;
use std::sync::Barrier;
use std::thread;
use std::time::{Duration, Instant};

/// What one update of a cell costs, if every number is moved once between registers and a cache, in
/// bytes (f64) and in additions and multiplications.
struct Kernel {
    name: &'static str,
    bytes: f64,
    flops: f64,
}

/// u, k and a conductance for each axis come in, the new u goes out; the exposure comes in and goes
/// out. Each axis takes 3 operations, `g (u' - u)` once and its difference from the flux before, and
/// every axis but the first 1 to add it; k takes 2, the exposure 1. The limits take the bandwidth of the triad, without what the memory moves besides to
/// fetch the lines that are written.
const KERNELS: [Kernel; 3] = [
    Kernel { name: "2-D", bytes: 40.0, flops: 9.0 },
    Kernel { name: "2-D with exposure", bytes: 56.0, flops: 10.0 },
    Kernel { name: "3-D with exposure", bytes: 64.0, flops: 14.0 },
];

/// Enough for every pipeline to be busy: two of each kind, six steps long; and few enough to stay in
/// sixteen registers with two constants.
const CHAINS: usize = 12;
const CHAIN_STEPS: usize = 1_000;
const ROUNDS: usize = 5;
const ROUND: Duration = Duration::from_millis(60);
/// So much is done between two looks at the clock, which take some time themselves.
const ITEMS_BETWEEN_LOOKS: usize = 1 << 17;
const CACHE_LINE: usize = 64;

fn main() {
    let levels = [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512];
    let all = thread::available_parallelism().map_or(1, usize::from);
    for level in levels.into_iter().filter(|&level| level <= SimdLevel::best()) {
        for threads in if all == 1 { vec![1] } else { vec![1, all] } {
            println!("\n{}, {threads} thread{}", level.name(), if threads == 1 { "" } else { "s" });
            print_limits(level, threads);
        }
    }
}

fn print_limits(level: SimdLevel, threads: usize) {
    let f32_rate = best_rate(level, threads, || ChainsF32);
    let f64_rate = best_rate(level, threads, || ChainsF64);
    println!("  add and multiply: f64 {:.1}, f32 {:.1} Gflop/s", f64_rate / 1e9, f32_rate / 1e9);
    print_row("", "read", "triad", KERNELS.map(|kernel| kernel.name.to_owned()));
    let unlimited = KERNELS.map(|kernel| updates(f64_rate / kernel.flops));
    print_row("arithmetic", "", "", unlimited);
    for memory in memories(threads) {
        let read = 8.0 * best_rate(level, threads, || Read::new(memory.bytes));
        let triad = 24.0 * best_rate(level, threads, || Triad::new(memory.bytes));
        let limits = KERNELS.map(|kernel| updates(triad / kernel.bytes));
        print_row(memory.name, &gigabytes(read), &gigabytes(triad), limits);
    }
}

fn print_row(name: &str, read: &str, triad: &str, kernels: [String; 3]) {
    let [plane, exposure, space] = kernels;
    println!("  {name:10} {read:>10} {triad:>10} {plane:>10} {exposure:>18} {space:>18}");
}

fn gigabytes(bytes_per_second: f64) -> String {
    format!("{:.1} GB/s", bytes_per_second / 1e9)
}

fn updates(per_second: f64) -> String {
    format!("{:.2} G/s", per_second / 1e9)
}

/// A level of the memory, and how much of it each thread uses.
struct Memory {
    name: &'static str,
    bytes: usize,
}

/// Half of what each thread has of each cache, and so much memory that the caches do not help.
fn memories(threads: usize) -> [Memory; 4] {
    let (first, second, third) = (cache(0, 32 << 10), cache(2, 1 << 20), cache(3, 32 << 20));
    [
        Memory { name: "L1", bytes: first / 2 },
        Memory { name: "L2", bytes: second / 2 },
        Memory { name: "L3", bytes: (third / 2).max(2 * second) / threads },
        Memory { name: "memory", bytes: (8 * third).max(256 << 20) / threads },
    ]
}

/// The size of a cache as Linux tells it: 0 is L1 for data, 2 is L2, 3 is L3.
fn cache(index: usize, otherwise: usize) -> usize {
    let path = format!("/sys/devices/system/cpu/cpu0/cache/index{index}/size");
    let size = fs::read_to_string(path).unwrap_or_default();
    let kilobytes = size.trim().strip_suffix('K').and_then(|size| size.parse::<usize>().ok());
    kilobytes.map_or(otherwise, |kilobytes| kilobytes << 10)
}

/// Something that is done again and again.
trait Work {
    /// Does it once with the vectors of `simd`; returns how many items that were.
    fn pass<S: Simd>(&mut self, simd: S) -> usize;
}

/// The sum of an array.
struct Read(Array);

/// `a = b + s c`.
struct Triad {
    sum: Array,
    left: Array,
    right: Array,
}

/// `value = value * factor + term` again and again.
struct ChainsF64;
struct ChainsF32;

impl Read {
    fn new(bytes: usize) -> Self {
        Self(Array::new(bytes, 0))
    }
}

impl Triad {
    /// Arrays that begin at different places of a page: the processor confuses others.
    fn new(bytes: usize) -> Self {
        let array = |place: usize| Array::new(bytes / 3, 17 * place);
        Self { sum: array(0), left: array(1), right: array(2) }
    }
}

impl Work for Read {
    #[inline(always)]
    fn pass<S: Simd>(&mut self, simd: S) -> usize {
        let (vectors, _) = S::as_simd_f64s(self.0.values());
        let mut sums = [simd.splat_f64s(0.0); CHAINS];
        for group in vectors.chunks_exact(CHAINS) {
            for (sum, &vector) in sums.iter_mut().zip(group) {
                *sum = simd.add_f64s(*sum, vector);
            }
        }
        black_box(sums);
        vectors.len() / CHAINS * CHAINS * S::F64_LANES
    }
}

impl Work for Triad {
    #[inline(always)]
    fn pass<S: Simd>(&mut self, simd: S) -> usize {
        let (sums, _) = S::as_mut_simd_f64s(self.sum.values_mut());
        let (left, _) = S::as_simd_f64s(self.left.values());
        let (right, _) = S::as_simd_f64s(self.right.values());
        let factor = simd.splat_f64s(0.5);
        for ((sum, &left), &right) in sums.iter_mut().zip(left).zip(right) {
            *sum = simd.add_f64s(left, simd.mul_f64s(factor, right));
        }
        black_box(&self.sum).length
    }
}

impl Work for ChainsF64 {
    #[inline(always)]
    fn pass<S: Simd>(&mut self, simd: S) -> usize {
        let half = simd.splat_f64s(black_box(0.5));
        let mut values = [simd.splat_f64s(1.0); CHAINS];
        for _ in 0..CHAIN_STEPS {
            for value in &mut values {
                *value = simd.add_f64s(simd.mul_f64s(*value, half), half);
            }
        }
        black_box(values);
        2 * CHAIN_STEPS * CHAINS * S::F64_LANES
    }
}

impl Work for ChainsF32 {
    #[inline(always)]
    fn pass<S: Simd>(&mut self, simd: S) -> usize {
        let half = simd.splat_f32s(black_box(0.5));
        let mut values = [simd.splat_f32s(1.0); CHAINS];
        for _ in 0..CHAIN_STEPS {
            for value in &mut values {
                *value = simd.add_f32s(simd.mul_f32s(*value, half), half);
            }
        }
        black_box(values);
        2 * CHAIN_STEPS * CHAINS * S::F32_LANES
    }
}

/// Numbers that begin at a cache line.
struct Array {
    memory: Vec<f64>,
    begin: usize,
    length: usize,
}

impl Array {
    /// `bytes` in whole cache lines, `lines` behind the first place possible.
    fn new(bytes: usize, lines: usize) -> Self {
        let line = CACHE_LINE / size_of::<f64>();
        let length = bytes / CACHE_LINE * line;
        let memory = vec![1.0; length + (lines + 1) * line];
        let begin = memory.as_ptr().align_offset(CACHE_LINE) + lines * line;
        Self { memory, begin, length }
    }

    fn values(&self) -> &[f64] {
        &self.memory[self.begin..][..self.length]
    }

    fn values_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.begin..][..self.length]
    }
}

/// Does `work` once with the vectors of `level`.
fn at_level(level: SimdLevel, work: &mut impl Work) -> usize {
    #[cfg(target_arch = "x86_64")]
    match (level, V3::try_new(), V4::try_new()) {
        (SimdLevel::Avx512, _, Some(simd)) => return Simd::vectorize(simd, Pass(work)),
        (SimdLevel::Avx2, Some(simd), _) => return Simd::vectorize(simd, Pass(work)),
        _ => {}
    }
    Simd::vectorize(Scalar128b, Pass(work))
}

struct Pass<'a, W>(&'a mut W);

impl<W: Work> WithSimd for Pass<'_, W> {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> usize {
        self.0.pass(simd)
    }
}

/// The best of some rounds of the items per second that all threads do together. Each makes its own
/// work first.
fn best_rate<W: Work>(level: SimdLevel, threads: usize, make: impl Fn() -> W + Sync) -> f64 {
    let barrier = Barrier::new(threads);
    let rates = || {
        let mut work = make();
        rate(level, &mut work);
        array::from_fn::<f64, ROUNDS, _>(|_| {
            barrier.wait();
            rate(level, &mut work)
        })
    };
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(rates)).collect();
        let rates: Vec<_> = workers.into_iter().filter_map(|worker| worker.join().ok()).collect();
        (0..ROUNDS).map(|round| rates.iter().map(|rates| rates[round]).sum()).fold(0.0, f64::max)
    })
}

/// Items per second of one round of one thread.
fn rate(level: SimdLevel, work: &mut impl Work) -> f64 {
    let (begin, mut done) = (Instant::now(), 0);
    while begin.elapsed() < ROUND {
        let look = done + ITEMS_BETWEEN_LOOKS;
        while done < look {
            done += at_level(level, work);
        }
    }
    done as f64 / begin.elapsed().as_secs_f64()
}
