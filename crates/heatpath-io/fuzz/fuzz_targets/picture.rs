//! Any bytes as a picture or volume, a mask and fields: an error or values that keep their promise.

#![no_main]

use heatpath_io::{ImageFile, PictureOptions};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(file) = ImageFile::from_bytes(bytes, "fuzz") {
        check::<2>(&file);
        check::<3>(&file);
    }
});

fn check<const D: usize>(file: &ImageFile) {
    let info = file.info();
    let usual = file.dimensions()[0] == D;
    if let Ok(picture) = file.clone().into_picture::<D>(&PictureOptions::default()) {
        assert!(file.dimensions().contains(&D));
        assert!(!usual || picture.shape().size().to_vec() == info.size);
        assert!(picture.values().iter().all(|value| (0.0..=1.0).contains(value)));
    }
    let _ = file.clone().into_mask([1.0; D]);
    let _ = file.clone().into_field([1.0; D]);
    let _ = file.clone().into_tensors([1.0; D]);
}
