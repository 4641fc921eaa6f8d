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

/// The conductances of all faces.
///
/// Rows can be read beyond their last cell as far as the kernel's vectors go; there is nothing but
/// faces without conductance there.
#[derive(Debug)]
pub(super) struct FaceStencil<const D: usize> {
    shape: Shape<D>,
    faces: Faces<D>,
}

#[derive(Debug)]
enum Faces<const D: usize> {
    /// All faces across an axis are equal inside the grid. Along x one row stands for all.
    Uniform { along: Aligned, across: [f64; D] },
    /// Those across each axis row by row, each belonging to the cell before it.
    Varying([Aligned; D]),
}

/// The conductances from the cells of a row to those of the next along axis 1 and along axis 2, if
/// there is one (else along axis 1 again).
pub(super) enum Across<'a> {
    Equal([f64; 2]),
    Varying([&'a [f64]; 2]),
}

impl<const D: usize> FaceStencil<D> {
    fn new(operator: &Operator<D>) -> Self {
        let shape = *operator.medium().shape();
        let faces = if operator.is_uniform() {
            let across = std::array::from_fn(|axis| operator.uniform_conductance(axis));
            let mut along = Aligned::zeros(padded(&shape));
            along[..shape.size()[0] - 1].fill(across[0]);
            Faces::Uniform { along, across }
        } else {
            Faces::Varying(std::array::from_fn(|axis| varying(operator, axis)))
        };
        Self { shape, faces }
    }

    /// The conductances from each cell of a row to the next, from `cell` on.
    #[inline(always)]
    pub(super) fn along(&self, cell: [usize; D]) -> &[f64] {
        match &self.faces {
            Faces::Uniform { along, .. } => &along[cell[0]..],
            Faces::Varying(axes) => &axes[0][self.place(cell)..],
        }
    }

    /// The conductances from the cells of a row to those of the next rows, from `cell` on.
    #[inline(always)]
    pub(super) fn across(&self, cell: [usize; D]) -> Across<'_> {
        let axes = [1, D - 1];
        match &self.faces {
            Faces::Uniform { across, .. } => Across::Equal(axes.map(|axis| {
                if cell[axis] + 1 == self.shape.size()[axis] { 0.0 } else { across[axis] }
            })),
            Faces::Varying(numbers) => {
                let place = self.place(cell);
                Across::Varying(axes.map(|axis| &numbers[axis][place..]))
            }
        }
    }

    /// Where the numbers of a cell stand.
    #[inline(always)]
    fn place(&self, cell: [usize; D]) -> usize {
        let row = (1..D).rev().fold(0, |row, axis| row * self.shape.size()[axis] + cell[axis]);
        row * padded(&self.shape) + cell[0]
    }
}

/// The numbers from one row to the next.
fn padded<const D: usize>(shape: &Shape<D>) -> usize {
    shape.size()[0].next_multiple_of(ROW_MULTIPLE) + ROW_MULTIPLE
}

fn varying<const D: usize>(operator: &Operator<D>, axis: usize) -> Aligned {
    let shape = operator.medium().shape();
    let row_length = padded(shape);
    let mut faces = Aligned::zeros(shape.cells() / shape.size()[0] * row_length);
    for (number, row) in shape.rows().enumerate() {
        let numbers = faces[number * row_length..].iter_mut();
        let conductances = operator.conductances(axis, row);
        numbers.zip(conductances).for_each(|(number, c)| *number = c);
    }
    faces
}
