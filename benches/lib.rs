//! Benchmarks of heatpath, one topic a file: `cargo bench -p heatpath-benches`.
