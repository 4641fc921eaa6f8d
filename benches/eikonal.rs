//! Exact distances: preparing a medium, and a whole march from one source.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use heatpath_core::Exec;
use heatpath_core::grid::distance::{Eikonal, EikonalOptions};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::{Grid, Shape, Sources, TensorField};
use std::array;
use std::hint::black_box;

/// The speed grows with x from 0.5 to 1.5.
fn growing<const D: usize>(size: [usize; D]) -> Medium<D> {
    let width = (size[0] - 1) as f64;
    let field = |index: [usize; D]| (0.5 + index[0] as f64 / width).powi(2);
    medium::given(Grid::from_fn(Shape::new(size).unwrap(), field), Form::Pointwise).unwrap()
}

/// Anisotropy 0.9 along circles around an axis beside the source.
fn swirl<const D: usize>(size: [usize; D]) -> Medium<D> {
    let (along, across) = (1.0, 1.0 / 19.0);
    let center = [0.3 * size[0] as f64, 0.45 * size[1] as f64];
    let field = TensorField::from_fn(Shape::new(size).unwrap(), |index| {
        let [x, y] = [0, 1].map(|axis| index[axis] as f64 - center[axis]);
        let mut tangent = [0.0; D];
        (tangent[1], tangent[0]) = x.atan2(y).sin_cos();
        let entry = |i: usize, j: usize| {
            let identity = f64::from(u8::from(i == j));
            across * identity + (along - across) * tangent[i] * tangent[j]
        };
        array::from_fn(|i| array::from_fn(|j| entry(i, j)))
    });
    medium::given_tensor(field).unwrap()
}

fn march<const D: usize>(criterion: &mut Criterion, name: &str, medium: &Medium<D>) {
    let exec = Exec::single_threaded();
    let size = medium.shape().size();
    let sources = Sources::new(&[size.map(|n| (n / 2) as f64)], medium.mask()).unwrap();
    let mut group = criterion.benchmark_group(format!("eikonal, {name}"));
    group.sample_size(10).throughput(Throughput::Elements(medium.shape().cells() as u64));
    group.bench_function(BenchmarkId::new("prepare", size[0]), |bencher| {
        bencher.iter(|| black_box(Eikonal::new(medium, &exec).unwrap()));
    });
    let eikonal = Eikonal::new(medium, &exec).unwrap();
    group.bench_function(BenchmarkId::new("1 source", size[0]), |bencher| {
        let options = EikonalOptions::default();
        bencher.iter(|| black_box(eikonal.distance(&sources, &options, &exec).unwrap()));
    });
    group.finish();
}

fn eikonal(criterion: &mut Criterion) {
    march(criterion, "picture", &growing([512, 512]));
    march(criterion, "picture", &growing([1024, 1024]));
    march(criterion, "picture, tensors", &swirl([1024, 1024]));
    march(criterion, "volume", &growing([64, 64, 64]));
    march(criterion, "volume", &growing([128, 128, 128]));
    march(criterion, "volume, tensors", &swirl([64, 64, 64]));
}

criterion_group!(benches, eikonal);
criterion_main!(benches);
