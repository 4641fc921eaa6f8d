//! What flows between which cells, laid out for the kernels.

use super::super::operator::Operator;
use super::gather::{BUNDLE, Gather};
use crate::grid::Shape;
use crate::simd::Aligned;

/// Rows of the kernel are a whole number of vectors, the longest of which hold 8 numbers.
pub(super) const ROW_MULTIPLE: usize = 8;

/// The stencil of all cells.
#[derive(Debug)]
pub(super) enum Stencil<const D: usize> {
    /// Heat flows through faces.
    Faces(FaceStencil<D>),
    /// D is a tensor.
    Gather(Gather<D>),
}

impl<const D: usize> Stencil<D> {
    pub(super) fn new(operator: &Operator<D>, step: f64) -> Self {
        match operator.links() {
            Some(links) => Self::Gather(Gather::new(operator, links, step)),
            None => Self::Faces(FaceStencil::new(operator)),
        }
    }

    /// Rows begin at a multiple of so many cells, and are computed that many at a time.
    pub(super) fn row_multiple(&self) -> usize {
        match self {
            Self::Faces(_) => ROW_MULTIPLE,
            Self::Gather(_) => BUNDLE,
        }
    }

    /// How many cells heat moves along each axis in one step at most.
    pub(super) fn reach(&self) -> [usize; D] {
        match self {
            Self::Faces(_) => [1; D],
            Self::Gather(gather) => gather.reach(),
        }
    }
}

/// The conductances of all faces: row by row, each belonging to the cell before it.
///
/// Rows can be read beyond their last cell as far as the kernel's vectors go; there is nothing but
/// faces without conductance there.
#[derive(Debug)]
pub(super) struct FaceStencil<const D: usize> {
    shape: Shape<D>,
    axes: [Faces; D],
}

/// The faces across one axis.
#[derive(Debug)]
enum Faces {
    /// All faces inside the grid are equal: one row stands for all, and one for the border.
    Uniform { inside: Aligned, border: Aligned },
    /// A number a face.
    Varying(Aligned),
}

impl<const D: usize> FaceStencil<D> {
    fn new(operator: &Operator<D>) -> Self {
        let shape = *operator.medium().shape();
        let faces = |axis| if operator.is_uniform() { uniform } else { varying }(operator, axis);
        Self { shape, axes: std::array::from_fn(faces) }
    }

    /// The conductances across `axis` behind the cells of a row: `n` numbers from `cell` on.
    #[inline(always)]
    pub(super) fn row(&self, axis: usize, cell: [usize; D], n: usize) -> &[f64] {
        let numbers = match &self.axes[axis] {
            Faces::Uniform { border, .. }
                if axis > 0 && cell[axis] + 1 == self.shape.size()[axis] =>
            {
                &border[cell[0]..]
            }
            Faces::Uniform { inside, .. } => &inside[cell[0]..],
            Faces::Varying(numbers) => {
                let row = self.shape.position(cell) / self.shape.size()[0];
                &numbers[row * padded(&self.shape) + cell[0]..]
            }
        };
        &numbers[..n]
    }
}

/// The numbers from one row to the next.
fn padded<const D: usize>(shape: &Shape<D>) -> usize {
    shape.size()[0].next_multiple_of(ROW_MULTIPLE) + ROW_MULTIPLE
}

fn uniform<const D: usize>(operator: &Operator<D>, axis: usize) -> Faces {
    let shape = operator.medium().shape();
    let width = shape.size()[0];
    let border = Aligned::zeros(padded(shape));
    let mut inside = border.clone();
    let last = if axis == 0 { width - 1 } else { width };
    inside[..last].fill(operator.uniform_conductance(axis));
    Faces::Uniform { inside, border }
}

fn varying<const D: usize>(operator: &Operator<D>, axis: usize) -> Faces {
    let shape = operator.medium().shape();
    let row_length = padded(shape);
    let mut faces = Aligned::zeros(shape.cells() / shape.size()[0] * row_length);
    for (number, row) in shape.rows().enumerate() {
        let numbers = faces[number * row_length..].iter_mut();
        let conductances = operator.conductances(axis, row);
        numbers.zip(conductances).for_each(|(number, c)| *number = c);
    }
    Faces::Varying(faces)
}
