//! The picture of the modules: distances around a source, with a path to it.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use heatpath_io::colour::viridis;
use std::io::Write;

const SIDE: usize = 48;

/// Where the distances are 0.
const SOURCE: [f64; 2] = [14.0, 33.0];

/// The picture as Slicer reads it: width, height, numbers of a pixel, the length of what follows, and
/// the pixels, compressed and in base64.
pub(crate) fn logo() -> String {
    let pixels: Vec<u8> = (0..SIDE * SIDE).flat_map(|i| pixel([i % SIDE, i / SIDE])).collect();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    // Memory never refuses.
    let _ = encoder.write_all(&pixels);
    let text = STANDARD.encode(encoder.finish().unwrap_or_default());
    format!("LOGO\n{SIDE}\n{SIDE}\n3\n{}\n{text}\n", text.len())
}

fn pixel(place: [usize; 2]) -> [u8; 3] {
    let [x, y] = place.map(|n| n as f64);
    let distance = (x - SOURCE[0]).hypot(y - SOURCE[1]);
    // A bent line from the source to the upper right corner.
    let line = SOURCE[1] - 26.0 * ((x - SOURCE[0]) / 29.0).powi(2);
    if distance < 3.5 || (x > SOURCE[0] && x < 43.0 && (y - line).abs() < 1.5) {
        return [255, 255, 255];
    }
    // Rings eight pixels apart.
    viridis((distance / 8.0).floor() / 5.0)
}
