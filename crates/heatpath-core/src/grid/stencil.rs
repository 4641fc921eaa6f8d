//! Matrices as sums of squares along the lattice: Selling's decomposition.

use super::Matrix;
use super::tensor::{apply, inverse};
use std::array;

/// The weights along the lattice are exact to this many binary digits below the largest component.
/// Selling's algorithm only shortens vectors, which begin at most twelve times as long (squared) as the
/// longest axis: all products are below 2^63.
const DIGITS: i32 = 59;

/// The largest ratio of eigenvalues that is decomposed as it is. Offsets have up to its square root
/// in cells.
const LARGEST_CONDITION: f64 = 1e8;

/// A vector is shortened by another only if it reaches this much further along it than half its length:
/// less may be rounding, back and forth.
const ROUNDING: f64 = 1e-6;

/// Integer vectors.
type Vectors<const D: usize, const N: usize> = [[i64; D]; N];

/// Writes a symmetric positive definite matrix as a sum of `weight offset offset'` over whole
/// offsets: at most 3 in the plane, 6 in space, with positive weights.
///
/// So `div(D grad u)` becomes a sum of second differences along the lattice that keeps u positive,
/// and `x' D x` a sum of squares. Of each pair of opposite offsets the one that points forward in
/// memory is given; none is a multiple of another whole one. A diagonal matrix gives the axes. A
/// matrix whose eigenvalues differ by more than a factor of about 1e8 is first brought down to
/// that.
///
/// The offsets come from an obtuse superbase, which Selling's algorithm finds (Selling 1874;
/// Fehrenbach & Mirebeau, "Sparse non-negative stencils for anisotropic diffusion", 2014). Floating
/// point brings it near; the last steps and the weights are in whole numbers: no rounding can make
/// it go in circles or a weight negative.
pub(crate) fn selling<const D: usize>(
    matrix: &Matrix<D>,
) -> impl Iterator<Item = ([i32; D], f64)> + use<D> {
    let sum = if is_diagonal(matrix) { axes(matrix) } else { decompose(&conditioned(matrix)) };
    sum.into_iter().filter(|&(_, weight)| weight > 0.0)
}

fn is_diagonal<const D: usize>(matrix: &Matrix<D>) -> bool {
    (0..D).all(|row| (0..D).all(|column| row == column || matrix[row][column] == 0.0))
}

fn axes<const D: usize>(matrix: &Matrix<D>) -> [([i32; D], f64); 6] {
    let mut sum = [([0; D], 0.0); 6];
    for axis in 0..D {
        sum[axis].0[axis] = 1;
        sum[axis].1 = matrix[axis][axis];
    }
    sum
}

/// The matrix, or if its eigenvalues differ too much for [`selling`], with something added to all
/// of them.
pub(crate) fn conditioned<const D: usize>(matrix: &Matrix<D>) -> Matrix<D> {
    if is_diagonal(matrix) {
        return *matrix;
    }
    let floor = trace(matrix) / LARGEST_CONDITION;
    let mut raised = *matrix;
    let lacking = floor - smallest_eigenvalue(matrix);
    (0..D).for_each(|axis| raised[axis][axis] += lacking.max(0.0));
    raised
}

fn trace<const D: usize>(matrix: &Matrix<D>) -> f64 {
    (0..D).map(|axis| matrix[axis][axis]).sum()
}

/// One over the trace of the inverse: the smallest eigenvalue of a symmetric positive definite
/// matrix, or less, but not below a D-th of it.
pub(crate) fn smallest_eigenvalue<const D: usize>(matrix: &Matrix<D>) -> f64 {
    1.0 / trace(&inverse(matrix))
}

fn decompose<const D: usize>(matrix: &Matrix<D>) -> [([i32; D], f64); 6] {
    let largest = (0..D).map(|axis| matrix[axis][axis]).fold(0.0, f64::max);
    let unit = largest / 2_f64.powi(DIGITS);
    let whole = matrix.map(|row| row.map(|component| (component / unit) as i64));
    let superbase = obtuse(&whole, reduced_basis(matrix));
    let mut sum = [([0; D], 0.0); 6];
    let pairs = (0..=D).flat_map(|i| (0..i).map(move |j| [i, j]));
    for (term, [i, j]) in sum.iter_mut().zip(pairs) {
        let others = (0..=D).filter(|&k| k != i && k != j).map(|k| superbase[k]);
        let weight = -product(&whole, &superbase[i], &superbase[j]);
        *term = (forward(across(others)), weight as f64 * unit);
    }
    sum
}

/// `a' M b`, which is in range; what overflows on the way there comes back.
fn product<const D: usize>(m: &[[i64; D]; D], a: &[i64; D], b: &[i64; D]) -> i64 {
    let dot = |a: &[i64; D], b: &[i64; D]| {
        (0..D).fold(0_i64, |sum, i| sum.wrapping_add(a[i].wrapping_mul(b[i])))
    };
    dot(a, &m.map(|row| dot(&row, b)))
}

/// A basis of the lattice in which, but for rounding, no vector can be shortened, in the norm of `m`,
/// by one other.
fn reduced_basis<const D: usize>(m: &Matrix<D>) -> Vectors<D, D> {
    let mut basis = [[0.0; D]; D];
    (0..D).for_each(|axis| basis[axis][axis] = 1.0);
    let pairs = || (0..D).flat_map(|i| (0..D).map(move |j| [i, j])).filter(|[i, j]| i != j);
    let mut pairs_left = pairs();
    while let Some([i, j]) = pairs_left.next() {
        let covector = apply(m, basis[i]);
        let along = |b: &[f64; D]| -> f64 { (0..D).map(|axis| covector[axis] * b[axis]).sum() };
        let times = along(&basis[j]) / along(&basis[i]);
        if times.abs() > 0.5 + ROUNDING {
            let whole = times.round();
            basis[j] = array::from_fn(|axis| basis[j][axis] - whole * basis[i][axis]);
            pairs_left = pairs();
        }
    }
    basis.map(|vector| vector.map(|part| part as i64))
}

/// The vectors of a basis and minus their sum, changed until no two of them make an acute angle: an
/// array of four, of which the plane uses three.
fn obtuse<const D: usize>(m: &[[i64; D]; D], basis: Vectors<D, D>) -> Vectors<D, 4> {
    let mut superbase = [[0; D]; 4];
    superbase[..D].copy_from_slice(&basis);
    superbase[D] = array::from_fn(|axis| -basis.iter().map(|b| b[axis]).sum::<i64>());
    let pairs = || (0..=D).flat_map(|i| (0..i).map(move |j| [i, j]));
    while let Some([i, j]) = pairs().find(|&[i, j]| product(m, &superbase[i], &superbase[j]) > 0) {
        let turned = superbase[i];
        // Their sum stays zero: in the plane one other vector takes it all, in space two share it.
        let share = if D == 2 { 2 } else { 1 };
        for (k, vector) in superbase[..=D].iter_mut().enumerate().filter(|(k, _)| *k != j) {
            let times = if k == i { -2 } else { share };
            (0..D).for_each(|axis| vector[axis] += times * turned[axis]);
        }
    }
    superbase
}

/// The vector perpendicular to the one other (in the plane) or to both (in space).
fn across<const D: usize>(mut others: impl Iterator<Item = [i64; D]>) -> [i64; D] {
    let a = others.next().unwrap_or([0; D]);
    let Some(b) = others.next() else {
        return array::from_fn(|axis| if axis == 0 { -a[1] } else { a[0] });
    };
    array::from_fn(|axis| {
        let [i, j] = [(axis + 1) % D, (axis + 2) % D];
        a[i] * b[j] - a[j] * b[i]
    })
}

/// The offset or its opposite, whichever points forward in memory.
fn forward<const D: usize>(offset: [i64; D]) -> [i32; D] {
    let last = offset.into_iter().rev().find(|&part| part != 0).unwrap_or(1);
    offset.map(|part| (last.signum() * part) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn outer<const D: usize>(sum: &[([i32; D], f64)]) -> Matrix<D> {
        array::from_fn(|i| {
            array::from_fn(|j| {
                sum.iter().map(|(e, weight)| weight * f64::from(e[i]) * f64::from(e[j])).sum()
            })
        })
    }

    fn divisor(a: i32, b: i32) -> i32 {
        if b == 0 { a.abs() } else { divisor(b, a % b) }
    }

    fn check<const D: usize>(matrix: Matrix<D>, condition: f64) {
        let sum: Vec<_> = selling(&matrix).collect();
        assert!(sum.len() <= D * (D + 1) / 2);
        let (back, size) = (outer(&sum), trace(&matrix));
        for (row, expected) in back.iter().zip(&matrix) {
            for (a, b) in row.iter().zip(expected) {
                assert!((a - b).abs() <= 4e-15 * size, "{back:?} for {matrix:?}");
            }
        }
        for (e, weight) in sum {
            assert!(weight > 0.0);
            assert_eq!(e.iter().fold(0, |all, &part| divisor(all, part)), 1, "{e:?}");
            assert!(e.iter().rev().find(|&&part| part != 0) > Some(&0), "{e:?}");
            let largest = f64::from(e.iter().map(|part| part.abs()).max().unwrap());
            assert!(largest <= 2.0 * condition.sqrt(), "{e:?} for {matrix:?}");
        }
    }

    /// The matrix with these eigenvalues, turned by these angles.
    fn space(eigenvalues: [f64; 3], angles: [f64; 3]) -> Matrix<3> {
        let mut matrix = [[0.0; 3]; 3];
        (0..3).for_each(|axis| matrix[axis][axis] = eigenvalues[axis]);
        for (turn, angle) in angles.into_iter().enumerate() {
            let [a, b] = [turn % 3, (turn + 1) % 3];
            let (sin, cos) = angle.sin_cos();
            for row in &mut matrix {
                (row[a], row[b]) = (cos * row[a] - sin * row[b], sin * row[a] + cos * row[b]);
            }
            let (p, q) = (matrix[a], matrix[b]);
            matrix[a] = array::from_fn(|column| cos * p[column] - sin * q[column]);
            matrix[b] = array::from_fn(|column| sin * p[column] + cos * q[column]);
        }
        // The same bits above and below the diagonal.
        array::from_fn(|i| array::from_fn(|j| matrix[i.min(j)][i.max(j)]))
    }

    proptest! {
        #[test]
        fn matrices_of_the_plane(ln in 0.0..7.5, angle in -7.0..7.0, scale in -90.0..90.0) {
            let (condition, scale): (f64, f64) = (10_f64.powf(ln), 10_f64.powf(scale));
            let (sin, cos) = f64::sin_cos(angle);
            let xy = scale * (1.0 - 1.0 / condition) * sin * cos;
            let xx = scale * (cos * cos + sin * sin / condition);
            let yy = scale * (sin * sin + cos * cos / condition);
            check([[xx, xy], [xy, yy]], condition);
        }

        #[test]
        fn matrices_of_space(
            ln in 0.0..7.5, middle in 0.0..1.0_f64, angles in prop::array::uniform3(-7.0..7.0),
        ) {
            let condition = 10_f64.powf(ln);
            check(space([1.0, condition.powf(-middle), 1.0 / condition], angles), condition);
        }
    }

    #[test]
    fn a_direction_near_an_axis_has_long_offsets() {
        let angle = 0.999e-3_f64;
        let (sin, cos) = angle.sin_cos();
        let xy = (1.0 - 1e-6) * sin * cos;
        check([[cos * cos + 1e-6 * sin * sin, xy], [xy, sin * sin + 1e-6 * cos * cos]], 1e6);
    }

    #[test]
    fn a_diagonal_matrix_gives_the_axes() {
        let sum: Vec<_> = selling(&[[2.0, 0.0], [0.0, 1e-20]]).collect();
        assert_eq!(sum, [([1, 0], 2.0), ([0, 1], 1e-20)]);
        let sum: Vec<_> = selling(&[[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 0.3]]).collect();
        assert_eq!(sum, [([1, 0, 0], 2.0), ([0, 1, 0], 3.0), ([0, 0, 1], 0.3)]);
    }

    #[test]
    fn a_matrix_that_is_almost_flat_is_decomposed_all_the_same() {
        let sum: Vec<_> =
            selling(&[[1.0, 0.999_999_999_999_9], [0.999_999_999_999_9, 1.0]]).collect();
        let back = outer(&sum);
        assert!(sum.iter().all(|(_, weight)| *weight > 0.0));
        assert!((back[0][0] - 1.0).abs() < 3e-8 && (back[0][1] - 1.0).abs() < 3e-8);
    }

    #[test]
    fn the_smallest_eigenvalue_is_bounded() {
        assert_eq!(smallest_eigenvalue(&[[2.0, 0.0], [0.0, 2.0]]), 1.0);
        assert!(
            (smallest_eigenvalue(&space([1.0, 0.5, 1e-3], [1.0, 2.0, 3.0])) / 1e-3 - 1.0).abs()
                < 4e-3
        );
    }
}
