//! Principal axes of symmetric matrices.

use super::Matrix;
use super::tensor::apply;

/// The eigenvalues of a symmetric matrix of one to three rows, ascending, and a unit eigenvector
/// for each of them.
///
/// Of each pair of opposite vectors it is the one whose component of largest size is positive. The
/// vectors are orthogonal to rounding error however close the values are, and where values are
/// equal they are some orthogonal basis. Every value is within a few units in the last place of the
/// largest one.
///
/// There is no iteration to converge: of three values the one that stands apart comes from the
/// characteristic polynomial, and what is orthogonal to its vector is a matrix of two rows, which
/// one rotation solves. (The closed form for all three loses half of the digits where two are nearly
/// equal; deflation by the one that is apart is due to Eberly, "A robust eigensolver for 3 x 3
/// symmetric matrices", 2014.)
///
/// ```
/// use heatpath_core::grid::eigen;
///
/// let (values, vectors) = eigen(&[[2.0, 1.0], [1.0, 2.0]]);
/// assert_eq!(values, [1.0, 3.0]);
/// assert!((vectors[1][0] - 0.5_f64.sqrt()).abs() < 1e-15);
/// assert_eq!(vectors[1][0], vectors[1][1]);
/// ```
#[must_use]
#[inline]
pub fn eigen<const D: usize>(matrix: &Matrix<D>) -> ([f64; D], [[f64; D]; D]) {
    let mut size = 0.0_f64;
    for (i, row) in matrix.iter().enumerate() {
        row[i..].iter().for_each(|entry| size = size.max(entry.abs()));
    }
    if size == 0.0 {
        return ([0.0; D], identity());
    }
    // Squares and cubes of the entries must not leave the range of floating point.
    let scaled = std::array::from_fn(|i| std::array::from_fn(|j| matrix[i][j] / size));
    let (mut values, mut vectors) = match D {
        1 => ([scaled[0][0]; D], identity()),
        2 => plane(&scaled, axis(0), axis(1)),
        _ => space(&scaled),
    };
    values.iter_mut().for_each(|value| *value *= size);
    vectors.iter_mut().for_each(with_sign);
    (values, vectors)
}

/// The eigenvalues and eigenvectors within the plane of `u` and `w`, which are orthonormal, in the
/// first two places.
#[inline]
fn plane<const D: usize>(m: &Matrix<D>, u: [f64; D], w: [f64; D]) -> ([f64; D], [[f64; D]; D]) {
    let (mu, mw) = (apply(m, u), apply(m, w));
    let (a, b, c) = (dot(u, mu), dot(u, mw), dot(w, mw));
    let (mean, difference) = (0.5 * (a + c), 0.5 * (a - c));
    let radius = (difference * difference + b * b).sqrt();
    // Of the two ways to write the direction of the larger value, the one without cancellation.
    let (x, y) =
        if difference >= 0.0 { (radius + difference, b) } else { (b, radius - difference) };
    let length = (x * x + y * y).sqrt();
    let (cos, sin) = if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) };
    let (mut values, mut vectors) = ([0.0; D], [[0.0; D]; D]);
    (values[0], values[1]) = (mean - radius, mean + radius);
    vectors[0] = std::array::from_fn(|axis| cos * w[axis] - sin * u[axis]);
    vectors[1] = std::array::from_fn(|axis| cos * u[axis] + sin * w[axis]);
    (values, vectors)
}

/// The eigenvalues and eigenvectors of three rows whose entries are at most 1 in size.
#[inline]
fn space<const D: usize>(m: &Matrix<D>) -> ([f64; D], [[f64; D]; D]) {
    let mean = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    let [a, b, c] = [m[0][0] - mean, m[1][1] - mean, m[2][2] - mean];
    let [d, e, f] = [m[0][1], m[0][2], m[1][2]];
    let spread = ((a * a + b * b + c * c + 2.0 * (d * d + e * e + f * f)) / 6.0).sqrt();
    if spread <= 1e-150 {
        return ([mean; D], identity());
    }
    let determinant = a * (b * c - f * f) - d * (d * c - e * f) + e * (d * f - b * e);
    let apart = spread * apart(0.5 * determinant / spread.powi(3));
    let rows = [[a - apart, d, e], [d, b - apart, f], [e, f, c - apart]];
    let alone = null_vector(rows);
    let (u, w) = complement(alone);
    let [alone, u, w] = [alone, u, w].map(embed);
    let mut deviator = *m;
    (0..D).for_each(|axis| deviator[axis][axis] -= mean);
    let (mut values, mut vectors) = plane(&deviator, u, w);
    (values[2], vectors[2]) = (dot(alone, apply(&deviator, alone)), alone);
    if apart < 0.0 {
        // To the front.
        values.swap(1, 2);
        values.swap(0, 1);
        vectors.swap(1, 2);
        vectors.swap(0, 1);
    }
    values.iter_mut().for_each(|value| *value += mean);
    (values, vectors)
}

/// Of the roots of `x^3 - 3 x = 2 h` with h from -1 to 1, the one that stands apart: between root 3
/// and 2 in size, with the sign of h.
#[inline]
fn apart(h: f64) -> f64 {
    let size = h.abs().min(1.0);
    let root_3 = 3.0_f64.sqrt();
    // The straight line is within 0.01 of the root; each step of Newton's squares the error.
    let newton = |x: f64| x - (x * (x * x - 3.0) - 2.0 * size) / (3.0 * (x * x - 1.0));
    newton(newton(newton(root_3 + (2.0 - root_3) * size))).copysign(h)
}

/// The unit vector orthogonal to the rows of a matrix of rank two: the longest of their cross
/// products.
#[inline]
fn null_vector(rows: [[f64; 3]; 3]) -> [f64; 3] {
    let products = [cross(rows[0], rows[1]), cross(rows[1], rows[2]), cross(rows[2], rows[0])];
    let lengths_sq = products.map(|v| dot(v, v));
    let longest = (1..3).fold(0, |best, i| if lengths_sq[i] > lengths_sq[best] { i } else { best });
    let length = lengths_sq[longest].sqrt();
    products[longest].map(|component| component / length)
}

/// Two unit vectors that are orthogonal to a third and to each other.
#[inline]
fn complement(v: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let [x, y, z] = v;
    let u = if x.abs() > y.abs() {
        let length = (x * x + z * z).sqrt();
        [-z / length, 0.0, x / length]
    } else {
        let length = (y * y + z * z).sqrt();
        [0.0, z / length, -y / length]
    };
    (u, cross(v, u))
}

#[inline]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline]
fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).map(|axis| a[axis] * b[axis]).sum()
}

/// The same vector, of a length that the compiler takes for another.
#[inline]
fn embed<const D: usize>(v: [f64; 3]) -> [f64; D] {
    std::array::from_fn(|axis| v[axis])
}

#[inline]
fn axis<const D: usize>(along: usize) -> [f64; D] {
    let mut vector = [0.0; D];
    vector[along] = 1.0;
    vector
}

fn identity<const D: usize>() -> Matrix<D> {
    std::array::from_fn(axis)
}

/// Turns the vector round unless its component of largest size is positive.
#[inline]
fn with_sign<const D: usize>(vector: &mut [f64; D]) {
    let larger = |best: f64, &x: &f64| if x.abs() > best.abs() { x } else { best };
    if vector.iter().fold(0.0, larger) < 0.0 {
        vector.iter_mut().for_each(|component| *component = -*component);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The largest error of `M v = value v`, of the lengths and of the angles.
    fn error<const D: usize>(m: &Matrix<D>) -> f64 {
        let (values, vectors) = eigen(m);
        let size = m.iter().flatten().fold(0.0, |size: f64, entry| size.max(entry.abs()));
        assert!(values.is_sorted(), "{values:?}");
        let mut error = 0.0_f64;
        for i in 0..D {
            let product = apply(m, vectors[i]);
            for (axis, component) in product.into_iter().enumerate() {
                error = error.max((component - values[i] * vectors[i][axis]).abs() / size);
            }
            for (j, other) in vectors.into_iter().enumerate() {
                let expected = f64::from(u8::from(i == j));
                error = error.max((dot(vectors[i], other) - expected).abs());
            }
            let largest = vectors[i].into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()));
            assert!(largest.unwrap() > 0.0);
        }
        error
    }

    fn symmetric([a, b, c, d, e, f]: [f64; 6]) -> Matrix<3> {
        [[a, d, e], [d, b, f], [e, f, c]]
    }

    /// `Q diag(values) Q'` with the reflection Q about the plane across `v`.
    fn with_values(values: [f64; 3], v: [f64; 3]) -> Matrix<3> {
        let q: Matrix<3> = std::array::from_fn(|i| {
            std::array::from_fn(|j| f64::from(u8::from(i == j)) - 2.0 * v[i] * v[j] / dot(v, v))
        });
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| q[i][k] * values[k] * q[j][k]).sum())
        })
    }

    #[test]
    fn known_matrices() {
        assert_eq!(eigen(&[[-3.0]]), ([-3.0], [[1.0]]));
        assert_eq!(eigen(&[[2.0, 0.0], [0.0, 1.0]]), ([1.0, 2.0], [[0.0, 1.0], [1.0, 0.0]]));
        let (values, vectors) = eigen(&with_values([5.0, -1.0, 2.0], [0.0, 0.0, 1.0]));
        (0..3).for_each(|i| assert!((values[i] - [-1.0, 2.0, 5.0][i]).abs() < 1e-15));
        assert_eq!(vectors, [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
        assert_eq!(eigen(&[[0.0; 3]; 3]), ([0.0; 3], identity()));
        assert_eq!(eigen(&with_values([7.0; 3], [0.0, 0.0, 1.0])).0, [7.0; 3]);
    }

    #[test]
    fn nearly_equal_values_are_told_apart() {
        let v = [0.3, -0.5, 0.7];
        for gap in [1e-3, 1e-7, 1e-9, 1e-12] {
            for values in [[1.0, 1.0 + gap, 3.0], [-2.0, 1.0, 1.0 + gap], [1.0, 1.0, 1.0 + gap]] {
                let matrix = with_values(values, v);
                let (found, _) = eigen(&matrix);
                (0..3).for_each(|i| assert!((found[i] - values[i]).abs() < 3e-15, "{found:?}"));
                assert!(error(&matrix) < 3e-15, "{}", error(&matrix));
            }
            assert!(error(&[[1.0, gap], [gap, 1.0 + gap]]) < 3e-15);
        }
    }

    #[test]
    fn sizes_at_the_ends_of_the_range() {
        for size in [1e-300, 1e-160, 1e160, 1e300] {
            let matrix =
                with_values([1.0, 2.0, 4.0], [0.2, 0.9, -0.4]).map(|r| r.map(|x| x * size));
            let (values, _) = eigen(&matrix);
            (0..3).for_each(|i| assert!((values[i] / size - [1.0, 2.0, 4.0][i]).abs() < 1e-14));
        }
    }

    proptest! {
        #[test]
        fn every_matrix_of_three_rows(entries in prop::array::uniform6(-1.0..1.0), exponent in -20..20_i32) {
            let matrix = symmetric(entries);
            prop_assert!(error(&matrix) < 1e-14, "{}", error(&matrix));
            // A matrix that is nearly a multiple of the identity, or nearly diagonal.
            let small = 2.0_f64.powi(3 * exponent);
            let near = symmetric(entries.map(|x| x * small));
            let near: Matrix<3> = std::array::from_fn(|i| {
                std::array::from_fn(|j| near[i][j] + f64::from(u8::from(i == j)))
            });
            prop_assert!(error(&near) < 1e-14, "{}", error(&near));
        }

        #[test]
        fn every_matrix_of_two_rows(a in -1.0..1.0, b in -1.0..1.0, c in -1.0..1.0) {
            let matrix = [[a, b], [b, c]];
            prop_assert!(error(&matrix) < 1e-14, "{}", error(&matrix));
        }
    }
}
