//! Any bytes as a picture, a mask and a field: an error or values that keep their promise.

#![no_main]

use heatpath_io::{
    PictureOptions, info_from_bytes, read_field_from_bytes, read_mask_from_bytes,
    read_picture_from_bytes,
};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let info = info_from_bytes(bytes, "fuzz");
    let picture = read_picture_from_bytes(bytes, "fuzz", &PictureOptions::default());
    if let Ok(picture) = &picture {
        let info = info.expect("a picture that can be read has an info");
        assert_eq!(picture.shape().size(), info.size);
        assert!(picture.values().iter().all(|value| (0.0..=1.0).contains(value)));
    }
    let _ = read_mask_from_bytes(bytes, "fuzz", [1.0; 2]);
    let _ = read_field_from_bytes(bytes, "fuzz", [1.0; 2]);
});
