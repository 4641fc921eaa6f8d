//! Explicit heat: cell updates per second, by processor level, size, source and dimension; and what
//! stands around it, from picture to distance.
//!
//! A point source is the usual start: most of the picture is cold for a while, and where heat
//! arrives first it is small beyond the range of f64. Only cells that heat can have reached count.
//! From noise, a source in every 64th cell, the whole picture is hot at once.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use heatpath_core::Exec;
use heatpath_core::exec::SimdLevel;
use heatpath_core::grid::distance::normalized;
use heatpath_core::grid::heat::{Duration, Explicit, HeatOptions, Step};
use heatpath_core::grid::medium::{self, Medium};
use heatpath_core::grid::{Grid, Shape, Sources, TensorField};
use std::hint::black_box;
use std::ops::{Add, Mul, Sub};
use std::time;

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// From a point with the default options; on one thread at each level of vector instructions.
fn levels(criterion: &mut Criterion) {
    let mut group = group(criterion, "levels");
    for side in [300, 600, 1200] {
        let medium = conductivity(&picture([side; 2]));
        let sources = point(&medium);
        let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
        let updates = medium.shape().cells() * explicit.iterations();
        group.throughput(Throughput::Elements(updates as u64));
        for level in [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512] {
            if level <= SimdLevel::best() {
                let exec = Exec::single_threaded().with_simd(level);
                let id = BenchmarkId::new(level.name(), side);
                flow(&mut group, id, &explicit, &sources, &exec);
            }
        }
        let id = BenchmarkId::new("all threads", side);
        flow(&mut group, id, &explicit, &sources, &Exec::new(0).unwrap());
    }
}

/// Pictures, and the unit of speed on the same pictures.
fn plane(criterion: &mut Criterion) {
    let mut group = group(criterion, "2-D");
    for (side, point_steps, noise_steps) in [(1024, 1024, 640), (4096, 400, 128)] {
        let medium = conductivity(&picture([side; 2]));
        from_point(&mut group, &medium, point_steps);
        from_noise(&mut group, &medium, noise_steps);
        unit_of_speed::<f64>(&mut group, "unit, f64", side, noise_steps);
        unit_of_speed::<f32>(&mut group, "unit, f32", side, noise_steps);
    }
}

/// Volumes.
fn space(criterion: &mut Criterion) {
    let mut group = group(criterion, "3-D");
    for (side, point_steps, noise_steps) in [(128, 128, 120), (256, 160, 40)] {
        let medium = conductivity(&picture([side; 3]));
        from_point(&mut group, &medium, point_steps);
        from_noise(&mut group, &medium, noise_steps);
        unit_in_space(&mut group, side, noise_steps);
    }
}

/// Tensors whose directions turn around the middle, with an anisotropy of 0.9, beside numbers: with
/// exposure, from noise.
fn tensors(criterion: &mut Criterion) {
    fn compare<const D: usize>(group: &mut Group, side: usize, iterations: usize) {
        let image = picture([side; D]);
        let number = medium::given(image.map(|v| 0.1 + 0.9 * v), medium::Form::Divergence).unwrap();
        let tensor = medium::given_tensor(turning(*image.shape())).unwrap();
        let options = HeatOptions { exposure: true, ..steps(iterations) };
        let exec = Exec::single_threaded();
        group.throughput(Throughput::Elements((image.shape().cells() * iterations) as u64));
        for (name, medium) in [("number", &number), ("tensor", &tensor)] {
            let explicit = Explicit::new(medium, options).unwrap();
            flow(group, BenchmarkId::new(name, side), &explicit, &noise(medium), &exec);
        }
    }
    let mut group = group(criterion, "tensors");
    for side in [300, 600, 1024] {
        compare::<2>(&mut group, side, 200);
    }
    compare::<3>(&mut group, 128, 20);
}

/// From heat to distance.
fn transform(criterion: &mut Criterion) {
    let mut group = group(criterion, "transform");
    for side in [1024, 4096] {
        let medium = conductivity(&picture([side; 2]));
        let explicit = Explicit::new(&medium, steps(16)).unwrap();
        let heat = explicit.flow(&noise(&medium), &Exec::new(0).unwrap()).unwrap();
        group.throughput(Throughput::Elements(medium.shape().cells() as u64));
        group.bench_function(BenchmarkId::new("normalized", side), |bencher| {
            bencher.iter(|| black_box(normalized(&heat)));
        });
    }
}

/// From picture to distance, with the default options.
fn whole(criterion: &mut Criterion) {
    let mut group = group(criterion, "whole");
    for side in [512, 1024] {
        let image = picture([side; 2]);
        group.throughput(Throughput::Elements(image.shape().cells() as u64));
        for (name, exec) in threads() {
            group.bench_function(BenchmarkId::new(name, side), |bencher| {
                bencher.iter(|| {
                    let medium = conductivity(&image);
                    let options = HeatOptions { exposure: false, ..Default::default() };
                    let explicit = Explicit::new(&medium, options).unwrap();
                    let heat = explicit.flow(&point(&medium), &exec).unwrap();
                    black_box(normalized(&heat))
                });
            });
        }
    }
}

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> Group<'a> {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10).warm_up_time(time::Duration::from_secs(1));
    group
}

fn threads() -> [(&'static str, Exec<'static>); 2] {
    [("one thread", Exec::single_threaded()), ("all threads", Exec::new(0).unwrap())]
}

fn from_point<const D: usize>(group: &mut Group, medium: &Medium<D>, iterations: usize) {
    let explicit = Explicit::new(medium, steps(iterations)).unwrap();
    group.throughput(Throughput::Elements(updates_from_middle(medium.shape(), iterations)));
    for (name, exec) in threads() {
        let id = BenchmarkId::new(format!("point, {name}"), medium.shape().longest_side());
        flow(group, id, &explicit, &point(medium), &exec);
    }
}

fn from_noise<const D: usize>(group: &mut Group, medium: &Medium<D>, iterations: usize) {
    let explicit = Explicit::new(medium, steps(iterations)).unwrap();
    group.throughput(Throughput::Elements((medium.shape().cells() * iterations) as u64));
    for (name, exec) in threads() {
        let id = BenchmarkId::new(format!("noise, {name}"), medium.shape().longest_side());
        flow(group, id, &explicit, &noise(medium), &exec);
    }
}

fn flow<const D: usize>(
    group: &mut Group,
    id: BenchmarkId,
    explicit: &Explicit<D>,
    sources: &Sources<D>,
    exec: &Exec,
) {
    group.bench_function(id, |bencher| {
        bencher.iter(|| black_box(explicit.flow(sources, exec).unwrap()));
    });
}

fn steps(iterations: usize) -> HeatOptions {
    let duration = Duration::Iterations(iterations);
    HeatOptions { duration, step: Step::Auto, exposure: false, ..Default::default() }
}

/// Grey values of waves.
fn picture<const D: usize>(sides: [usize; D]) -> Grid<f64, D> {
    Grid::from_fn(Shape::new(sides).unwrap(), |index| {
        let wave = |axis: usize| (0.05 * (1.0 + 0.4 * axis as f64) * index[axis] as f64).sin();
        0.5 + 0.5 / D as f64 * (0..D).map(wave).sum::<f64>()
    })
}

fn conductivity<const D: usize>(image: &Grid<f64, D>) -> Medium<D> {
    medium::conductivity(image, &[0.8], Default::default()).unwrap()
}

/// Tensors of 1 along circles around an axis through the middle, and 1 / 19 across.
fn turning<const D: usize>(shape: Shape<D>) -> TensorField<D> {
    TensorField::from_fn(shape, |index| {
        let from_middle = |axis: usize| index[axis] as f64 - 0.487 * shape.size()[axis] as f64;
        let radius = from_middle(0).hypot(from_middle(1));
        let mut along = [0.0; D];
        (along[0], along[1]) = (-from_middle(1) / radius, from_middle(0) / radius);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                18.0 / 19.0 * along[i] * along[j] + if i == j { 1.0 / 19.0 } else { 0.0 }
            })
        })
    })
}

/// The cell in the middle.
fn point<const D: usize>(medium: &Medium<D>) -> Sources<D> {
    let middle = medium.shape().size().map(|side| (side / 2) as f64);
    Sources::new(&[middle], medium.mask()).unwrap()
}

/// Every 64th cell.
fn noise<const D: usize>(medium: &Medium<D>) -> Sources<D> {
    let apart = if D == 2 { 8 } else { 4 };
    let shape = medium.shape();
    let points: Vec<[f64; D]> = (0..shape.cells())
        .map(|cell| shape.index(cell))
        .filter(|index| index.iter().all(|i| i % apart == 0))
        .map(|index| index.map(|i| i as f64))
        .collect();
    Sources::new(&points, medium.mask()).unwrap()
}

/// The updates of cells that heat from the middle can have reached: it moves one cell a step.
fn updates_from_middle<const D: usize>(shape: &Shape<D>, iterations: usize) -> u64 {
    let from_middle = |index: [usize; D]| -> usize {
        index.iter().zip(shape.size()).map(|(i, side)| i.abs_diff(side / 2)).sum()
    };
    (0..shape.cells())
        .map(|cell| (iterations + 1).saturating_sub(from_middle(shape.index(cell)).max(1)) as u64)
        .sum()
}

/// The unit of speed: what anybody would write first, compiled for any processor of the target.
///
/// It does less than the engine: no k, and no range beyond that of `T`.
fn unit_of_speed<T: Number>(group: &mut Group, name: &str, side: usize, iterations: usize) {
    let across = vec![T::from(0.2_f32); side * side];
    let down = across.clone();
    let step = |next: &mut [T], u: &[T]| unit_step(next, u, &across, &down, side);
    repeat(group, BenchmarkId::new(name, side), side * side, iterations, step);
}

/// The unit of speed in volumes.
fn unit_in_space(group: &mut Group, side: usize, iterations: usize) {
    let across = vec![0.1; side.pow(3)];
    let (down, behind) = (across.clone(), across.clone());
    let step = |next: &mut [f64], u: &[f64]| {
        unit_step_in_space(next, u, [&across, &down, &behind], side);
    };
    repeat(group, BenchmarkId::new("unit, f64", side), side.pow(3), iterations, step);
}

fn repeat<T: Number>(
    group: &mut Group,
    id: BenchmarkId,
    cells: usize,
    iterations: usize,
    step: impl Fn(&mut [T], &[T]),
) {
    let mut u: Vec<T> = (0..cells).map(|cell| T::from((cell % 64 == 0).into())).collect();
    let mut next = u.clone();
    group.throughput(Throughput::Elements((cells * iterations) as u64));
    group.bench_function(id, |bencher| {
        bencher.iter(|| {
            for _ in 0..iterations {
                step(&mut next, &u);
                std::mem::swap(&mut next, &mut u);
            }
            black_box(&u);
        });
    });
}

trait Number: Copy + From<f32> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}
impl Number for f32 {}
impl Number for f64 {}

/// One step inside a border one cell wide, which stays as it is. `across` and `down` hold the
/// conductances to the cell before, times the step.
#[inline(never)]
fn unit_step<T: Number>(next: &mut [T], u: &[T], across: &[T], down: &[T], side: usize) {
    for y in 1..side - 1 {
        for i in y * side + 1..(y + 1) * side - 1 {
            next[i] = u[i]
                + (across[i + 1] * (u[i + 1] - u[i]) - across[i] * (u[i] - u[i - 1]))
                + (down[i + side] * (u[i + side] - u[i]) - down[i] * (u[i] - u[i - side]));
        }
    }
}

/// The same in a volume.
#[inline(never)]
fn unit_step_in_space(next: &mut [f64], u: &[f64], faces: [&[f64]; 3], side: usize) {
    let [across, down, behind] = faces;
    let (row, plane) = (side, side * side);
    for z in 1..side - 1 {
        for y in 1..side - 1 {
            for i in z * plane + y * row + 1..z * plane + (y + 1) * row - 1 {
                next[i] = u[i]
                    + (across[i + 1] * (u[i + 1] - u[i]) - across[i] * (u[i] - u[i - 1]))
                    + (down[i + row] * (u[i + row] - u[i]) - down[i] * (u[i] - u[i - row]))
                    + (behind[i + plane] * (u[i + plane] - u[i])
                        - behind[i] * (u[i] - u[i - plane]));
            }
        }
    }
}

criterion_group!(benches, levels, plane, space, tensors, transform, whole);
criterion_main!(benches);
