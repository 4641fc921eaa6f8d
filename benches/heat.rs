//! Explicit heat from a point source, with the default options: cell updates per second.
//!
//! A point source is the honest start: most of the picture is cold for a while, and where heat
//! arrives first it is small beyond the range of f64.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use heatpath_core::Exec;
use heatpath_core::exec::SimdLevel;
use heatpath_core::grid::heat::{Explicit, HeatOptions};
use heatpath_core::grid::{Grid, Shape, Sources, medium};
use std::hint::black_box;

fn heat(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("explicit heat, conductivity");
    group.sample_size(10);
    for side in [300, 600, 1200] {
        let shape = Shape::new([side, side]).unwrap();
        let image = Grid::from_fn(shape, |[x, y]| {
            0.5 + 0.25 * (0.05 * x as f64).sin() + 0.25 * (0.07 * y as f64).cos()
        });
        let medium = medium::conductivity(&image, &[0.8], Default::default()).unwrap();
        let middle = [side as f64 / 2.0; 2];
        let sources = Sources::new(&[middle], medium.mask()).unwrap();
        let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
        group.throughput(Throughput::Elements((shape.cells() * explicit.iterations()) as u64));
        let mut run = |name: String, exec: &Exec| {
            group.bench_function(BenchmarkId::new(name, side), |bencher| {
                bencher.iter(|| black_box(explicit.flow(&sources, exec).unwrap()));
            });
        };
        for level in [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512] {
            if level <= SimdLevel::best() {
                let exec = Exec::single_threaded().with_simd(level);
                run(format!("one thread, {}", level.name()), &exec);
            }
        }
        run("all threads".to_owned(), &Exec::new(0).unwrap());
    }
    group.finish();
}

criterion_group!(benches, heat);
criterion_main!(benches);
