//! Meshes that several tests use.

use heatpath_core::mesh::TriMesh;
use heatpath_core::mesh::shapes::sheet;

/// The straight distance.
pub(crate) fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// The unit square of `cells` x `cells`, its inner vertices moved by up to 0.24 of a side.
pub(crate) fn jittered(cells: usize) -> TriMesh {
    let random = |seed: usize| {
        let mixed = (seed as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        ((mixed ^ (mixed >> 32)) % 10_000) as f64 / 5000.0 - 1.0
    };
    sheet(cells, cells, |x, y| {
        let is_inner = ![0, cells].contains(&x) && ![0, cells].contains(&y);
        let by = if is_inner { 0.24 } else { 0.0 };
        let [dx, dy] = [0, 1].map(|axis| by * random(2 * ((cells + 1) * y + x) + axis));
        [(x as f64 + dx) / cells as f64, (y as f64 + dy) / cells as f64, 0.0]
    })
}
