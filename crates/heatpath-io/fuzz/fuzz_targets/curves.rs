//! Any bytes as curves (JSON, CSV, SWC): an error of one line, or finite points.

#![no_main]

use heatpath_io::CurveFile;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| match CurveFile::from_bytes(bytes, "fuzz") {
    Ok(file) => {
        for &dimension in file.dimensions() {
            match dimension {
                2 => check(&file.clone().into_polylines([1.0; 2], None).unwrap()),
                _ => check(&file.clone().into_polylines([1.0; 3], None).unwrap()),
            }
        }
    }
    Err(error) => assert_eq!(error.to_string().lines().count(), 1),
});

fn check<const D: usize>(curves: &[Vec<[f64; D]>]) {
    assert!(curves.iter().flatten().flatten().all(|coordinate| coordinate.is_finite()));
}
