//! Implicit heat and the heat method: preparing a medium, and one source and many.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use heatpath_core::Exec;
use heatpath_core::grid::distance::{HeatMethod, HeatMethodOptions, normalized};
use heatpath_core::grid::heat::{Implicit, ImplicitOptions};
use heatpath_core::grid::medium::{self, Medium};
use heatpath_core::grid::{Grid, Shape, Sources};
use std::hint::black_box;

fn waves<const D: usize>(size: [usize; D]) -> Medium<D> {
    let shape = Shape::new(size).unwrap();
    let image = Grid::from_fn(shape, |index| {
        let waves = index.iter().zip([0.05, 0.07, 0.06]).map(|(&i, k)| (k * i as f64).sin());
        0.5 + 0.5 * waves.sum::<f64>() / D as f64
    });
    medium::conductivity(&image, &[0.8], Default::default()).unwrap()
}

fn implicit(criterion: &mut Criterion) {
    grid(criterion, "picture", [300, 300]);
    grid(criterion, "picture", [512, 512]);
    grid(criterion, "picture", [1024, 1024]);
    grid(criterion, "volume", [32, 32, 32]);
    grid(criterion, "volume", [64, 64, 64]);
}

fn grid<const D: usize>(criterion: &mut Criterion, name: &str, size: [usize; D]) {
    let mut group = criterion.benchmark_group(format!("implicit heat, {name}"));
    group.sample_size(10);
    let medium = waves(size);
    let point = |i: usize| std::array::from_fn(|axis| ((i * 37 + axis * 91) % size[axis]) as f64);
    let sources: Vec<Sources<D>> =
        (0..100).map(|i| Sources::new(&[point(i)], medium.mask()).unwrap()).collect();
    for (threads, exec) in
        [("one thread", Exec::single_threaded()), ("all threads", Exec::new(0).unwrap())]
    {
        let id = |what: &str| BenchmarkId::new(format!("{what}, {threads}"), size[0]);
        let prepare = || Implicit::new(&medium, ImplicitOptions::default(), &exec).unwrap();
        group.bench_function(id("prepare"), |bencher| bencher.iter(|| black_box(prepare())));
        let implicit = prepare();
        group.bench_function(id("1 source"), |bencher| {
            bencher.iter(|| black_box(implicit.flow(&sources[0], &exec).unwrap()));
        });
        let heat = implicit.flow(&sources[0], &exec).unwrap();
        group.bench_function(id("distances"), |bencher| {
            bencher.iter(|| black_box(normalized(&heat)));
        });
        if size == [512; D] {
            group.bench_function(id("100 sources"), |bencher| {
                bencher.iter(|| black_box(implicit.flow_many(&sources, &exec).unwrap()));
            });
            let id =
                |what: &str| BenchmarkId::new(format!("heat method, {what}, {threads}"), size[0]);
            let prepare = || HeatMethod::new(&medium, HeatMethodOptions::default(), &exec).unwrap();
            group.bench_function(id("prepare"), |bencher| bencher.iter(|| black_box(prepare())));
            let method = prepare();
            group.bench_function(id("1 source"), |bencher| {
                bencher.iter(|| black_box(method.distance(&sources[0], &exec).unwrap()));
            });
            group.bench_function(id("8 sources"), |bencher| {
                bencher.iter(|| black_box(method.distances(&sources[..8], &exec).unwrap()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, implicit);
criterion_main!(benches);
