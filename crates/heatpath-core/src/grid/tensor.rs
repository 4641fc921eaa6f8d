//! One symmetric matrix per cell.

use super::{Grid, LengthError, Shape};

/// A symmetric matrix in the axes of the grid, in physical units along each of them.
pub type Matrix<const D: usize> = [[f64; D]; D];

/// One symmetric matrix per cell of a grid: a diffusion tensor, a Hessian, a structure tensor.
///
/// The components on and above the diagonal are stored row by row, cell after cell, x fastest:
/// `xx, xy, yy` of an image and `xx, xy, xz, yy, yz, zz` of a volume.
///
/// ```
/// use heatpath_core::grid::{Shape, TensorField};
///
/// let field = TensorField::from_components(Shape::new([2, 1])?, vec![1.0, 0.0, 1.0, 2.0, 0.5, 3.0])?;
/// assert_eq!(field.at(1), [[2.0, 0.5], [0.5, 3.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TensorField<const D: usize> {
    shape: Shape<D>,
    components: Vec<f64>,
}

impl<const D: usize> TensorField<D> {
    /// The components of a cell: 3 in an image, 6 in a volume.
    pub const COMPONENTS: usize = D * (D + 1) / 2;

    /// A field of as many `components` as the grid has cells times
    /// [`COMPONENTS`](Self::COMPONENTS).
    ///
    /// # Errors
    /// There are more or fewer.
    pub fn from_components(shape: Shape<D>, components: Vec<f64>) -> Result<Self, LengthError> {
        let (expected, given) = (shape.cells() * Self::COMPONENTS, components.len());
        if expected == given {
            Ok(Self { shape, components })
        } else {
            Err(LengthError { expected, given })
        }
    }

    /// A field of as many `components` as it has.
    pub(crate) fn from_parts(shape: Shape<D>, components: Vec<f64>) -> Self {
        debug_assert_eq!(shape.cells() * Self::COMPONENTS, components.len());
        Self { shape, components }
    }

    /// A field whose cell at index `i` holds `matrix(i)`, of which the part on and above the
    /// diagonal counts.
    pub fn from_fn(shape: Shape<D>, mut matrix: impl FnMut([usize; D]) -> Matrix<D>) -> Self {
        let mut components = Vec::with_capacity(shape.cells() * Self::COMPONENTS);
        for position in 0..shape.cells() {
            let matrix = matrix(shape.index(position));
            (0..D).for_each(|row| components.extend_from_slice(&matrix[row][row..]));
        }
        Self { shape, components }
    }

    /// The size and spacing.
    #[must_use]
    pub fn shape(&self) -> &Shape<D> {
        &self.shape
    }

    /// The components of all cells.
    #[must_use]
    pub fn components(&self) -> &[f64] {
        &self.components
    }

    /// The matrix of the cell stored at `position`.
    #[must_use]
    #[inline]
    pub fn at(&self, position: usize) -> Matrix<D> {
        let components = &self.components[position * Self::COMPONENTS..];
        std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let (low, high) = (row.min(column), row.max(column));
                components[low * (2 * D - low + 1) / 2 + high - low]
            })
        })
    }

    /// The field of `change(matrix)` for each matrix.
    #[must_use]
    pub fn map<T>(&self, mut change: impl FnMut(Matrix<D>) -> T) -> Grid<T, D> {
        let values = (0..self.shape.cells()).map(|cell| change(self.at(cell))).collect();
        Grid::from_parts(self.shape, values)
    }
}

/// A diffusion tensor for derivatives per cell instead of per unit of length, in which the smallest
/// spacing is 1.
#[must_use]
pub(crate) fn per_cell<const D: usize>(matrix: &Matrix<D>, shape: &Shape<D>) -> Matrix<D> {
    let scale = shape.spacing().map(|spacing| shape.smallest_spacing() / spacing);
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[i][j] * (scale[i] * scale[j])))
}

/// The determinant of a symmetric matrix of one to three rows.
#[must_use]
pub(crate) fn determinant<const D: usize>(m: &Matrix<D>) -> f64 {
    let minor = |a: usize, b: usize| m[a][a] * m[b][b] - m[a][b] * m[a][b];
    match D {
        1 => m[0][0],
        2 => minor(0, 1),
        _ => {
            m[0][0] * minor(1, 2) - m[0][1] * (m[0][1] * m[2][2] - m[0][2] * m[1][2])
                + m[0][2] * (m[0][1] * m[1][2] - m[0][2] * m[1][1])
        }
    }
}

/// The inverse of a symmetric positive definite matrix of one to three rows.
#[must_use]
pub(crate) fn inverse<const D: usize>(matrix: &Matrix<D>) -> Matrix<D> {
    // The products of three numbers of any size would leave the range of floating point.
    let size: f64 = (0..D).map(|axis| matrix[axis][axis]).sum();
    let m = matrix.map(|row| row.map(|component| component / size));
    let determinant = determinant(&m) * size;
    let cofactor = |row: usize, column: usize| match D {
        1 => 1.0,
        2 if row == column => m[1 - row][1 - row],
        2 => -m[0][1],
        _ => {
            let [a, b] = [(row + 1) % 3, (row + 2) % 3];
            let [c, d] = [(column + 1) % 3, (column + 2) % 3];
            m[a][c] * m[b][d] - m[a][d] * m[b][c]
        }
    };
    std::array::from_fn(|row| std::array::from_fn(|column| cofactor(row, column) / determinant))
}

/// The product of a matrix and a vector.
#[must_use]
#[inline]
pub(crate) fn apply<const D: usize>(m: &Matrix<D>, v: [f64; D]) -> [f64; D] {
    std::array::from_fn(|row| (0..D).map(|column| m[row][column] * v[column]).sum())
}

/// The length of a vector in a metric.
pub(crate) fn length<const D: usize>(metric: &Matrix<D>, vector: [f64; D]) -> f64 {
    let covector = apply(metric, vector);
    (0..D).map(|axis| vector[axis] * covector[axis]).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_undoes_the_matrix() {
        let matrix = [[4.0, 1.0, -0.5], [1.0, 3.0, 0.25], [-0.5, 0.25, 2.0]];
        let vector = [1.0, -2.0, 0.5];
        let back = apply(&inverse(&matrix), apply(&matrix, vector));
        (0..3).for_each(|axis| assert!((back[axis] - vector[axis]).abs() < 1e-14));
        assert!((determinant(&matrix) * determinant(&inverse(&matrix)) - 1.0).abs() < 1e-14);
        let plane = [[2.0, 1.0], [1.0, 5.0]];
        assert_eq!(determinant(&plane), 9.0);
        let [x, y] = apply(&plane, apply(&inverse(&plane), [9.0, 0.0]));
        assert!((x - 9.0).abs() < 1e-14 && y.abs() < 1e-14);
    }

    #[test]
    fn components_stand_row_by_row() {
        let shape = Shape::new([1, 2, 1]).unwrap();
        let field = TensorField::from_fn(shape, |[_, y, _]| {
            let y = y as f64;
            [[1.0 + y, 2.0, 3.0], [2.0, 4.0, 5.0], [3.0, 5.0, 6.0]]
        });
        assert_eq!(field.components()[..6], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(field.at(1)[2], [3.0, 5.0, 6.0]);
        let back = TensorField::from_components(shape, field.components().to_vec());
        assert_eq!(back.as_ref(), Ok(&field));
        assert!(TensorField::from_components(shape, vec![0.0; 11]).is_err());
    }
}
