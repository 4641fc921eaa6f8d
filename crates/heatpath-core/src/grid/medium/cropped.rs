//! A part of a medium.

use super::{Diffusion, Medium};
use crate::grid::{Grid, Mask, TensorField};

impl<const D: usize> Medium<D> {
    /// The box of `size` cells that begins at the cell `low`, cut to the grid and at least a cell. Heat in
    /// it flows as it does in the whole until it comes to the border of the box.
    #[must_use]
    pub fn cropped(&self, low: [usize; D], size: [usize; D]) -> Self {
        let whole = self.shape().size();
        let low: [usize; D] = std::array::from_fn(|axis| low[axis].min(whole[axis] - 1));
        let size = std::array::from_fn(|axis| size[axis].clamp(1, whole[axis] - low[axis]));
        let shape = self.shape().with_size(size);
        let outside = |index: [usize; D]| std::array::from_fn(|axis| low[axis] + index[axis]);
        let field = |whole: &Grid<f64, D>| Grid::from_fn(shape, |index| whole[outside(index)]);
        Self {
            factor: self.factor.as_ref().map(field),
            diffusion: match &self.diffusion {
                Diffusion::Uniform => Diffusion::Uniform,
                Diffusion::Scalar(whole) => Diffusion::Scalar(field(whole)),
                Diffusion::Tensor(whole) => {
                    let at = |index| whole.at(self.shape().position(outside(index)));
                    Diffusion::Tensor(TensorField::from_fn(shape, at))
                }
            },
            mask: Mask::new(Grid::from_fn(shape, |index| {
                self.mask.is_open(self.shape().position(outside(index)))
            })),
        }
    }
}
