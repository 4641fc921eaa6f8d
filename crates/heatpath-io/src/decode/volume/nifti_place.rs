//! Where a `NIfTI` file says that its voxels lie, which is in RAS.

use super::nifti::Words;
use crate::placement::{Geometry, Placement, Vector, ras_to_lps};

/// From the sform, else from the qform, else from the spacing alone.
pub(super) fn geometry(words: &Words<'_>, axes: usize) -> Result<Geometry, String> {
    let (columns, origin) = match (words.code(1) > 0, words.code(0) > 0) {
        (true, _) => sform(words),
        (false, true) => qform(words),
        (false, false) => {
            let straight = Placement::default().direction;
            let column = |axis: usize| straight[axis].map(|part| part * spacing(words, axis));
            return Geometry::from_axes(&[0, 1, 2].map(column)[..axes], [0.0; 3]);
        }
    };
    let unit = unit(words);
    let world = |vector: Vector| ras_to_lps(vector.map(|part| unit * part));
    Geometry::from_axes(&columns.map(world)[..axes], world(origin))
}

/// Millimetres in the unit of length.
fn unit(words: &Words<'_>) -> f64 {
    match words.array::<1>(units_at(words))[0] & 7 {
        1 => 1000.0,
        3 => 0.001,
        _ => 1.0,
    }
}

/// The byte that counts of the units.
fn units_at(words: &Words<'_>) -> usize {
    let last = if words.is_second() && words.is_big_endian { 3 } else { 0 };
    words.layout.units + last
}

fn spacing(words: &Words<'_>, axis: usize) -> f64 {
    let given = words.float(words.layout.pixdim, axis + 1).abs();
    if given.is_finite() && given > 0.0 { given } else { 1.0 }
}

/// The columns of the matrix and the origin.
fn sform(words: &Words<'_>) -> ([Vector; 3], Vector) {
    let column = |axis: usize| [0, 1, 2].map(|row| words.float(words.layout.rows, 4 * row + axis));
    ([column(0), column(1), column(2)], column(3))
}

/// The same from a rotation as a quaternion.
fn qform(words: &Words<'_>) -> ([Vector; 3], Vector) {
    let [b, c, d, x, y, z] = [0, 1, 2, 3, 4, 5].map(|i| words.float(words.layout.quaternion, i));
    let a_sq = 1.0 - (b * b + c * c + d * d);
    // Rounding can make the vector part longer than 1.
    let [a, b, c, d] = if a_sq < 1e-7 {
        let length = (b * b + c * c + d * d).sqrt();
        [0.0, b / length, c / length, d / length]
    } else {
        [a_sq.sqrt(), b, c, d]
    };
    let rotation = [
        [a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)],
        [2.0 * (b * c - a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d + a * b)],
        [2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a + d * d - b * b - c * c],
    ];
    let handed = if words.float(words.layout.pixdim, 0) < 0.0 { -1.0 } else { 1.0 };
    let signs = [1.0, 1.0, handed];
    let column = |axis: usize| rotation[axis].map(|part| part * signs[axis] * spacing(words, axis));
    ([column(0), column(1), column(2)], [x, y, z])
}
