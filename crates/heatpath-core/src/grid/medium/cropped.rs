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

#[cfg(test)]
mod tests {
    use crate::grid::medium::{Form, given};
    use crate::grid::{Grid, Mask, Shape};

    #[test]
    fn a_box_keeps_its_cells_and_ends_with_the_grid() {
        let shape = Shape::with_spacing([9, 7], [0.5, 2.0]).unwrap();
        let field = Grid::from_fn(shape, |[x, y]| (1 + x + 10 * y) as f64);
        let walls = Mask::new(Grid::from_fn(shape, |index| index != [5, 3]));
        let medium = given(field, Form::Divergence).unwrap().with_walls(walls).unwrap();
        let part = medium.cropped([4, 2], [3, 4]);
        assert_eq!((part.shape().size(), part.shape().spacing()), ([3, 4], [0.5, 2.0]));
        let at = |index| part.shape().position(index);
        assert_eq!(part.speed_sq(at([2, 3])), 57.0);
        assert!(!part.mask().is_open(at([1, 1])) && part.mask().is_open(at([1, 2])));
        assert_eq!(medium.cropped([7, 5], [99, 99]).shape().size(), [2, 2]);
        assert_eq!(medium.cropped([99, 0], [3, 0]).shape().size(), [1, 1]);
    }
}
