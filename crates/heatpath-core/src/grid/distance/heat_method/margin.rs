//! More cells around the grid, so that its border does not reflect heat.

use crate::grid::medium::{Form, Medium, MediumError, given};
use crate::grid::{Grid, Mask, PointError, Sources};

/// The medium `k D laplace(u)` of a medium, on a grid with `width` more cells on both sides of each
/// axis (but those with one cell). They are as the nearest cell of the border, so no way outside is
/// shorter than the one along the border, and no walls are passed.
pub(super) fn with_margin<const D: usize>(
    medium: &Medium<D>,
    width: usize,
) -> Result<Medium<D>, MediumError> {
    let (shape, widths) = (*medium.shape(), widths(medium, width));
    let size = std::array::from_fn(|axis| shape.size()[axis] + 2 * widths[axis]);
    let inner = |index: [usize; D]| {
        shape.position(std::array::from_fn(|axis| {
            index[axis].saturating_sub(widths[axis]).min(shape.size()[axis] - 1)
        }))
    };
    let wide = shape.with_size(size);
    let open = Mask::new(Grid::from_fn(wide, |index| medium.mask().is_open(inner(index))));
    let field = Grid::from_fn(wide, |index| {
        let cell = inner(index);
        if medium.mask().is_open(cell) { medium.speed_sq(cell) } else { 1.0 }
    });
    given(field, Form::Pointwise)?.with_walls(open)
}

/// The sources on the grid `with_margin`.
pub(super) fn moved<const D: usize>(
    sources: &Sources<D>,
    medium: &Medium<D>,
    wide: &Medium<D>,
) -> Result<Sources<D>, PointError> {
    let shift: [f64; D] = offset(medium, wide).map(|shift| shift as f64);
    let moved = |point: &[f64; D]| std::array::from_fn(|axis| point[axis] + shift[axis]);
    let points: Vec<[f64; D]> = sources.points().iter().map(moved).collect();
    Sources::new(&points, wide.mask())
}

/// A field without its margin.
pub(super) fn without_margin<const D: usize>(
    field: &Grid<f64, D>,
    medium: &Medium<D>,
    wide: &Medium<D>,
) -> Grid<f64, D> {
    let shift = offset(medium, wide);
    Grid::from_fn(*medium.shape(), |index| {
        field[std::array::from_fn(|axis| index[axis] + shift[axis])]
    })
}

fn widths<const D: usize>(medium: &Medium<D>, width: usize) -> [usize; D] {
    medium.shape().size().map(|side| if side > 1 { width } else { 0 })
}

fn offset<const D: usize>(medium: &Medium<D>, wide: &Medium<D>) -> [usize; D] {
    std::array::from_fn(|axis| (wide.shape().size()[axis] - medium.shape().size()[axis]) / 2)
}
