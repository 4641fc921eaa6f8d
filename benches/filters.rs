//! What media of directions and tubes are made of: cells per second, in pictures and volumes.
#![allow(missing_docs, reason = "criterion's macros make functions without documentation")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on should stop")]

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use heatpath_core::Exec;
use heatpath_core::exec::SimdLevel;
use heatpath_core::grid::filter::{
    Measure, Tubes, gaussian_gradient, hessian, structure_tensor, vesselness,
};
use heatpath_core::grid::medium::{self, VesselnessOptions};
use heatpath_core::grid::{Grid, Shape, eigen};
use std::hint::black_box;
use std::time;

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// Derivatives at three scales, on one thread at each level of vector instructions.
fn derivatives(criterion: &mut Criterion) {
    let mut group = group(criterion, "derivatives");
    let (plane, space) = (picture([1024; 2]), picture([128; 3]));
    for level in [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512] {
        if level > SimdLevel::best() {
            continue;
        }
        let exec = Exec::single_threaded().with_simd(level);
        for sigma in [1.0, 2.0, 4.0] {
            group.throughput(Throughput::Elements(plane.shape().cells() as u64));
            let id = BenchmarkId::new(format!("Hessian 2-D, {}", level.name()), sigma);
            group.bench_function(id, |b| b.iter(|| black_box(hessian(&plane, sigma, &exec))));
        }
        group.throughput(Throughput::Elements(space.shape().cells() as u64));
        let id = BenchmarkId::new(format!("Hessian 3-D, {}", level.name()), 2.0);
        group.bench_function(id, |b| b.iter(|| black_box(hessian(&space, 2.0, &exec))));
    }
    let exec = Exec::single_threaded();
    group.throughput(Throughput::Elements(plane.shape().cells() as u64));
    let id = BenchmarkId::new("gradient 2-D", 2.0);
    group.bench_function(id, |b| b.iter(|| black_box(gaussian_gradient(&plane, 2.0, &exec))));
    let id = BenchmarkId::new("structure tensor 2-D", 2.0);
    group.bench_function(id, |b| b.iter(|| black_box(structure_tensor(&plane, 1.0, 2.0, &exec))));
}

/// Eigenvalues and eigenvectors of one matrix per cell.
fn principal_axes(criterion: &mut Criterion) {
    let mut group = group(criterion, "eigen");
    of_each_cell(&mut group, &picture([1024; 2]));
    of_each_cell(&mut group, &picture([96; 3]));
}

fn of_each_cell<const D: usize>(group: &mut Group, image: &Grid<f64, D>) {
    let field = hessian(image, 2.0, &Exec::single_threaded()).unwrap();
    let cells = image.shape().cells();
    group.throughput(Throughput::Elements(cells as u64));
    group.bench_function(BenchmarkId::from_parameter(D), |bencher| {
        bencher.iter(|| {
            for cell in 0..cells {
                black_box(eigen(&field.at(cell)));
            }
        });
    });
}

/// The default scales by each measure, on one thread and on all.
fn tubes(criterion: &mut Criterion) {
    let mut group = group(criterion, "tubes");
    let (plane, space) = (picture([1024; 2]), picture([128; 3]));
    for (name, exec) in
        [("one thread", Exec::single_threaded()), ("all threads", Exec::new(0).unwrap())]
    {
        for measure in [Measure::FRANGI, Measure::Sato, Measure::OrientedFlux] {
            let tubes = Tubes { measure, ..Default::default() };
            search(&mut group, &plane, &tubes, name, &exec);
            search(&mut group, &space, &tubes, name, &exec);
        }
        group.throughput(Throughput::Elements(plane.shape().cells() as u64));
        let options = VesselnessOptions { anisotropy: 0.9, ..Default::default() };
        group.bench_function(BenchmarkId::new("medium 2-D", name), |bencher| {
            bencher.iter(|| black_box(medium::vesselness(&plane, &options, &exec)));
        });
    }
}

fn search<const D: usize>(
    group: &mut Group,
    image: &Grid<f64, D>,
    tubes: &Tubes,
    threads: &str,
    exec: &Exec,
) {
    let measure = match tubes.measure {
        Measure::Frangi { .. } => "Frangi",
        Measure::Sato => "Sato",
        Measure::OrientedFlux => "flux",
    };
    group.throughput(Throughput::Elements(image.shape().cells() as u64));
    group.bench_function(BenchmarkId::new(format!("{measure} {D}-D"), threads), |bencher| {
        bencher.iter(|| black_box(vesselness(image, tubes, exec)));
    });
}

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> Group<'a> {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10).warm_up_time(time::Duration::from_millis(300));
    group.measurement_time(time::Duration::from_secs(1));
    group
}

/// Grey values of waves and a little noise, so that no cell is like another.
fn picture<const D: usize>(sides: [usize; D]) -> Grid<f64, D> {
    Grid::from_fn(Shape::new(sides).unwrap(), |index| {
        let wave = |axis: usize| (0.3 * (1.0 + 0.4 * axis as f64) * index[axis] as f64).sin();
        let noise = index.iter().fold(7, |hash, i| (hash * 31 + i) % 1009) as f64 / 1009.0;
        0.4 + 0.4 / D as f64 * (0..D).map(wave).sum::<f64>() + 0.1 * noise
    })
}

criterion_group!(benches, derivatives, principal_axes, tubes);
criterion_main!(benches);
