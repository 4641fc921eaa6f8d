//! Key points: by heat at several radii, and by fast marching.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use heatpath_core::Exec;
use heatpath_core::grid::keypoints::{
    KeyPointOptions, LengthOptions, key_points, key_points_by_length,
};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::{Grid, Shape, Sources};
use std::hint::black_box;

/// Fast rings, 60 cells apart and 6 wide, and two spokes that join them.
fn rings(n: usize) -> Medium<2> {
    let half = 0.5 * n as f64;
    let speed_sq = |[x, y]: [usize; 2]| {
        let (x, y) = (x as f64 - half, y as f64 - half);
        let off = (x.hypot(y) % 60.0 - 30.0).abs().min(y.abs());
        (-0.5 * (off / 2.0).powi(2)).exp() + 1e-3
    };
    medium::given(Grid::from_fn(Shape::new([n, n]).unwrap(), speed_sq), Form::Pointwise).unwrap()
}

fn keypoints(criterion: &mut Criterion) {
    let exec = Exec::new(0).unwrap();
    for n in [300, 1000] {
        let medium = rings(n);
        let seeds =
            Sources::new(&[[0.5 * n as f64 + 30.0, 0.5 * n as f64]], medium.mask()).unwrap();
        let mut group = criterion.benchmark_group("key points");
        group.sample_size(10);
        for radius in [30.0, 15.0] {
            let options = KeyPointOptions { radius, ..KeyPointOptions::default() };
            let name = BenchmarkId::new(format!("heat, radius {radius}"), n);
            group.bench_function(name, |bencher| {
                bencher.iter(|| black_box(key_points(&medium, &seeds, &options, &exec).unwrap()));
            });
        }
        group.bench_function(BenchmarkId::new("by length 30", n), |bencher| {
            let options = LengthOptions::default();
            bencher.iter(|| {
                black_box(key_points_by_length(&medium, &seeds, &options, &exec).unwrap())
            });
        });
        group.finish();
    }
}

criterion_group!(benches, keypoints);
criterion_main!(benches);
