//! Voting: a whole vote on a picture of vessels, and the two ways to count paths.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use heatpath_core::Exec;
use heatpath_core::grid::heat::{Explicit, HeatOptions};
use heatpath_core::grid::medium::{self, Medium, VesselnessOptions};
use heatpath_core::grid::path::Descent;
use heatpath_core::grid::voting::{
    Counting, Growth, Method, VotingOptions, covered, density, front, vote,
};
use heatpath_core::grid::{Grid, Shape, Sources};
use std::hint::black_box;

/// The source: on the trunk.
fn root(size: [usize; 2]) -> [f64; 2] {
    [2.0, (size[1] / 2) as f64]
}

/// Vessels that wind through the picture from left to right, and one from top to bottom.
fn vessels(size: [usize; 2]) -> Medium<2> {
    let winding = |x: f64| 12.0 * (x / 40.0).sin();
    let image = Grid::from_fn(Shape::new(size).unwrap(), |[x, y]| {
        let (x, y) = (x as f64, y as f64);
        let across = (y - root(size)[1] - winding(x)).rem_euclid(80.0);
        let distance = across.min(80.0 - across).min((x - 30.0 - winding(y)).abs());
        (-0.5 * (distance / 2.5).powi(2)).exp()
    });
    medium::vesselness(&image, &VesselnessOptions::default(), &Exec::single_threaded()).unwrap()
}

fn votes(criterion: &mut Criterion) {
    let exec = Exec::new(2).unwrap();
    let growth = Some(Growth::new(0.15));
    let mut group = criterion.benchmark_group("vote, 2 threads");
    group.sample_size(10);
    for size in [[300, 300], [1000, 960]] {
        let medium = vessels(size);
        let sources = Sources::new(&[root(size)], medium.mask()).unwrap();
        for method in [Method::Front, Method::Multiple, Method::Accumulated] {
            let options = VotingOptions { method, growth, ..VotingOptions::default() };
            group.bench_function(BenchmarkId::new(format!("{method:?}"), size[0]), |bencher| {
                bencher.iter(|| black_box(vote(&medium, &sources, &options, &exec).unwrap()));
            });
        }
    }
    group.finish();
}

fn counting(criterion: &mut Criterion) {
    let exec = Exec::single_threaded();
    let size = [500, 480];
    let medium = vessels(size);
    let sources = Sources::new(&[root(size)], medium.mask()).unwrap();
    let heat = Explicit::new(&medium, HeatOptions::default()).unwrap();
    let heat = heat.flow(&sources, &exec).unwrap();
    let descent = Descent::new(&heat, &medium).unwrap();
    let front = front(&covered(&heat, 240.0));
    let ends: Vec<_> = front.into_iter().map(|cell| medium.shape().centre(cell)).collect();
    let mut group = criterion.benchmark_group("density, 1 thread");
    group.sample_size(10);
    for counting in [Counting::Traced, Counting::Flow] {
        group.bench_function(BenchmarkId::new(format!("{counting:?}"), ends.len()), |bencher| {
            bencher.iter(|| black_box(density(&descent, &ends, counting, None, &exec).unwrap()));
        });
    }
    group.finish();
}

criterion_group!(benches, votes, counting);
criterion_main!(benches);
