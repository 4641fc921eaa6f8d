//! Exact distances: preparing a medium, and a whole march from one source.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use heatpath_core::Exec;
use heatpath_core::grid::distance::{Eikonal, EikonalOptions};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::{Grid, Shape, Sources, TensorField};
use std::hint::black_box;

/// The speed grows with x from 0.5 to 1.5.
fn growing<const D: usize>(size: [usize; D]) -> Medium<D> {
    let width = (size[0] - 1) as f64;
    let field = |index: [usize; D]| (0.5 + index[0] as f64 / width).powi(2);
    medium::given(Grid::from_fn(Shape::new(size).unwrap(), field), Form::Pointwise).unwrap()
}

/// Anisotropy 0.9 along circles around a point beside the source.
fn swirl(n: usize) -> Medium<2> {
    let (along, across) = (1.0, 1.0 / 19.0);
    let field = TensorField::from_fn(Shape::new([n, n]).unwrap(), |[x, y]| {
        let (sin, cos) = (x as f64 - 0.3 * n as f64).atan2(y as f64 - 0.45 * n as f64).sin_cos();
        let (xx, yy) = (cos * cos, sin * sin);
        let xy = (across - along) * sin * cos;
        [[along * xx + across * yy, xy], [xy, along * yy + across * xx]]
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
    march(criterion, "picture, tensors", &swirl(1024));
    march(criterion, "volume", &growing([64, 64, 64]));
    march(criterion, "volume", &growing([128, 128, 128]));
}

criterion_group!(benches, eikonal);
criterion_main!(benches);
