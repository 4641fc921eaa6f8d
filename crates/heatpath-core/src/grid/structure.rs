//! The structure that a medium shows: the cells in which it is fast.

use super::Grid;
use super::medium::Medium;
use super::skeleton::{radii, thin};

/// The cells that are open and fast: `k D >= least_speed_sq`
/// ([`structure_level`](super::structure_level) chooses that).
#[must_use]
pub fn structure<const D: usize>(medium: &Medium<D>, least_speed_sq: f64) -> Grid<bool, D> {
    let shape = *medium.shape();
    Grid::from_fn(shape, |index| {
        let cell = shape.position(index);
        medium.mask().is_open(cell) && medium.speed_sq(cell) >= least_speed_sq
    })
}

/// Half the width of a structure, in physical units: the median of the [`radii`] on its centreline.
/// `None` if it is empty, or everywhere.
///
/// ```
/// use heatpath_core::grid::{Grid, Shape, half_width};
///
/// let bars = Grid::from_fn(Shape::new([60, 40])?, |[_, y]| (5..10).contains(&y) || y == 30);
/// assert_eq!(half_width(&bars), Some(2.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn half_width<const D: usize>(structure: &Grid<bool, D>) -> Option<f64> {
    let (centreline, radii) = (thin(structure), radii(structure));
    let on_it = centreline.values().iter().zip(radii.values()).filter(|(inside, _)| **inside);
    let mut widths: Vec<f64> = on_it.map(|(_, &radius)| radius).collect();
    widths.sort_by(f64::total_cmp);
    widths.get(widths.len() / 2).copied().filter(|width| width.is_finite())
}
