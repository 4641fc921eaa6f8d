//! Any bytes as a mesh: an error of one line, or points and polygons that clean into a mesh or not.

#![no_main]

use heatpath_io::{MeshFile, ReadError, read_mesh_from_bytes};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Some formats are known by their ending only.
    for name in ["fuzz", "fuzz.obj", "fuzz.off", "fuzz.stl"] {
        check(read_mesh_from_bytes(bytes, name));
    }
});

fn check(file: Result<MeshFile, ReadError>) {
    let cleaned = file.and_then(|file| {
        let points = file.soup.points().len();
        assert!(file.arrays.iter().all(|(_, values)| values.len() == points));
        file.clean(file.usual_options())
    });
    if let Err(error) = cleaned {
        assert_eq!(error.to_string().lines().count(), 1);
    }
}
