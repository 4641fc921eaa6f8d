//! Any bytes as a list of points: an error of one line, or finite points.

#![no_main]

use heatpath_io::read_points_from_bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    check::<2>(bytes);
    check::<3>(bytes);
});

fn check<const D: usize>(bytes: &[u8]) {
    match read_points_from_bytes::<D>(bytes, "fuzz") {
        Ok(points) => {
            assert!(!points.is_empty());
            assert!(points.iter().flatten().all(|coordinate| coordinate.is_finite()));
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}
