//! Values between cell centres.

use super::{Grid, Shape};

/// The cells around a point and their multilinear weights.
///
/// Up to `2^D` pairs of memory position and weight; the weights are not negative and add up to 1.
/// A point beyond the outermost cell centres gets the value of the border.
pub(crate) fn corners<const D: usize>(
    shape: &Shape<D>,
    point: [f64; D],
) -> impl Iterator<Item = (usize, f64)> + use<D> {
    let size = shape.size();
    let clamped: [f64; D] =
        std::array::from_fn(|axis| point[axis].clamp(0.0, (size[axis] - 1) as f64));
    let shape = *shape;
    (0..1_usize << D).filter_map(move |corner| {
        let mut weight = 1.0;
        let index = std::array::from_fn(|axis| {
            let lower = clamped[axis].floor();
            let fraction = clamped[axis] - lower;
            let upper = corner >> axis & 1;
            weight *= if upper == 1 { fraction } else { 1.0 - fraction };
            lower as usize + upper
        });
        (weight > 0.0).then(|| (shape.position(index), weight))
    })
}

impl<const D: usize> Grid<f64, D> {
    /// The multilinear interpolation of the cell values at `point`, in pixel coordinates.
    #[must_use]
    pub fn sample(&self, point: [f64; D]) -> f64 {
        corners(self.shape(), point).map(|(cell, weight)| weight * self.values()[cell]).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_is_exact_for_linear_functions() {
        let shape = Shape::new([5, 4, 3]).unwrap();
        let field =
            Grid::from_fn(shape, |[x, y, z]| 1.0 + 2.0 * x as f64 - y as f64 + 3.0 * z as f64);
        let [x, y, z] = [1.25, 2.5, 0.75];
        assert!((field.sample([x, y, z]) - (1.0 + 2.0 * x - y + 3.0 * z)).abs() < 1e-14);
        assert_eq!(field.sample([-0.5, 0.0, 0.0]), 1.0);
        assert_eq!(field.sample([4.5, 3.5, 2.5]), field[[4, 3, 2]]);
    }
}
