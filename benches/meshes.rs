//! Distances on meshes: the unit sphere, from one vertex.

use criterion::{Criterion, criterion_group, criterion_main};
use heatpath_core::Exec;
use heatpath_core::mesh::{Geodesics, GeodesicsOptions, Medium, Method, Sources, shapes};
use std::sync::Arc;

fn meshes(criterion: &mut Criterion) {
    let exec = Exec::single_threaded();
    let mut group = criterion.benchmark_group("meshes");
    group.sample_size(10);
    for (method, name, level) in
        [(Method::Heat, "heat", 6), (Method::Eikonal, "eikonal", 6), (Method::Exact, "exact", 5)]
    {
        let mesh = shapes::icosphere(level);
        let vertices = mesh.points().len();
        let sources = Sources::at_vertices(&mesh, &[0]).expect("there is a vertex");
        let medium = Arc::new(Medium::uniform(mesh).expect("a sphere has an extent"));
        let options = GeodesicsOptions { method, ..GeodesicsOptions::default() };
        let prepare =
            || Geodesics::new(Arc::clone(&medium), options, &exec).expect("nothing is refused");
        group.bench_function(format!("{name}/prepare/{vertices}"), |bench| bench.iter(prepare));
        let prepared = prepare();
        group.bench_function(format!("{name}/solve/{vertices}"), |bench| {
            bench.iter(|| prepared.distance(&sources, &exec));
        });
    }
    group.finish();
}

criterion_group!(benches, meshes);
criterion_main!(benches);
