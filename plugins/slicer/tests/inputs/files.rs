//! What is in the inputs; the tests of hosts have the same.

/// Columns, rows, slices.
const SIZE: [usize; 3] = [24, 20, 16];

/// A bright tube that winds through a volume.
fn tube() -> Vec<u8> {
    let voxel = |i: usize| {
        let [x, y, z] = [i % SIZE[0], i / SIZE[0] % SIZE[1], i / SIZE[0] / SIZE[1]];
        let [x, y, z] = [x, y, z].map(|n| n as f64);
        let (u, v) = (y - 10.0 - 4.0 * (0.25 * x).sin(), z - 8.0 - 3.0 * (0.2 * x).cos());
        (20.0 + 200.0 * (-(u * u + v * v) / 6.0).exp()) as u8
    };
    (0..SIZE.iter().product()).map(voxel).collect()
}

/// The tube as a file in the format NRRD, with these lines of the header about where it is in the world.
pub(crate) fn nrrd(world: &str) -> Vec<u8> {
    let [columns, rows, slices] = SIZE;
    let header = format!(
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: {columns} {rows} {slices}\n{world}\
         encoding: raw\n\n"
    );
    [header.as_bytes(), &tube()].concat()
}

/// A roof of two rectangles.
pub(crate) const MESH: &str = "OFF\n6 4 0\n0 0 0\n4 0 0\n0 3 1\n4 3 1\n0 6 0\n4 6 0\n\
                               3 0 1 2\n3 1 3 2\n3 2 3 4\n3 3 5 4\n";
