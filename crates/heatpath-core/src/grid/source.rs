//! Where the heat starts.

use super::sample::corners;
use super::{Grid, Mask};
use thiserror::Error;

/// Points on open cells of a grid from which heat starts and distances count.
///
/// A source may lie between cell centres: its heat is shared between the cells around it with
/// multilinear weights, so that the centre of the heat is the source.
#[derive(Clone, Debug, PartialEq)]
pub struct Sources<const D: usize> {
    points: Vec<[f64; D]>,
}

/// Why a point cannot be a source or an end of a path.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PointError {
    /// There is no point at all.
    #[error("no {role} point was given; at least one is needed")]
    Missing {
        /// What the point is for: `source` or `end`.
        role: &'static str,
    },
    /// The point is not on the grid.
    #[error(
        "{role} {number} at {point:?} lies outside the grid of {size:?} cells; \
         pixel coordinates run from -0.5 to the size minus 0.5"
    )]
    Outside {
        /// What the point is for: `source` or `end`.
        role: &'static str,
        /// Which of them, counted from 0.
        number: usize,
        /// The point in pixel coordinates.
        point: Vec<f64>,
        /// The cells along each axis.
        size: Vec<usize>,
    },
    /// The point lies in a wall.
    #[error("{role} {number} at {point:?} lies inside a wall of the mask; move it to an open cell")]
    InsideWall {
        /// What the point is for: `source` or `end`.
        role: &'static str,
        /// Which of them, counted from 0.
        number: usize,
        /// The point in pixel coordinates.
        point: Vec<f64>,
    },
}

/// Checks that `points` exist and lie on open cells.
///
/// # Errors
/// The first of them that does not.
pub fn check_points<const D: usize>(
    role: &'static str,
    points: &[[f64; D]],
    mask: &Mask<D>,
) -> Result<(), PointError> {
    if points.is_empty() {
        return Err(PointError::Missing { role });
    }
    for (number, &point) in points.iter().enumerate() {
        if !mask.shape().contains(point) {
            let size = mask.shape().size().to_vec();
            return Err(PointError::Outside { role, number, point: point.to_vec(), size });
        }
        if !mask.is_open_at(point) {
            return Err(PointError::InsideWall { role, number, point: point.to_vec() });
        }
    }
    Ok(())
}

impl<const D: usize> Sources<D> {
    /// Sources at `points`, in pixel coordinates.
    ///
    /// # Errors
    /// There are none, or one lies outside the grid or inside a wall.
    pub fn new(points: &[[f64; D]], mask: &Mask<D>) -> Result<Self, PointError> {
        check_points("source", points, mask)?;
        Ok(Self { points: points.to_vec() })
    }

    /// The points, in pixel coordinates.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// Adds points on open cells.
    pub(crate) fn extend(&mut self, points: impl IntoIterator<Item = [f64; D]>) {
        self.points.extend(points);
    }

    /// Each of the points as a set of its own.
    #[must_use]
    pub fn each(&self) -> Vec<Self> {
        self.points.iter().map(|&point| Self { points: vec![point] }).collect()
    }

    /// The values of `image` at the sources, by multilinear interpolation.
    #[must_use]
    pub fn values(&self, image: &Grid<f64, D>) -> Vec<f64> {
        self.points.iter().map(|&point| image.sample(point)).collect()
    }
}

/// The open cells that share the heat of a source at `point`, with weights that add up to 1.
///
/// Cells on the other side of a wall get nothing.
pub(crate) fn shares<const D: usize>(mask: &Mask<D>, point: [f64; D]) -> Vec<(usize, f64)> {
    let shape = mask.shape();
    let mut shares: Vec<(usize, f64)> = corners(shape, point)
        .filter(|&(cell, _)| mask.segment_is_open(point, shape.index(cell).map(|i| i as f64)))
        .collect();
    let total: f64 = shares.iter().map(|&(_, weight)| weight).sum();
    shares.iter_mut().for_each(|(_, weight)| *weight /= total);
    shares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn a_source_shares_its_heat_around_itself() {
        let mask = Mask::all_open(Shape::new([4, 4]).unwrap());
        assert_eq!(shares(&mask, [1.25, 2.0]), [(9, 0.75), (10, 0.25)]);
        assert_eq!(shares(&mask, [3.5, 3.5]), [(15, 1.0)]);
    }

    #[test]
    fn a_source_beside_a_wall_keeps_its_heat_on_its_side() {
        let shape = Shape::new([3, 3]).unwrap();
        let mask = Mask::new(Grid::from_fn(shape, |[x, _]| x != 1));
        assert_eq!(shares(&mask, [0.4, 1.0]), [(3, 1.0)]);
        assert!(matches!(
            Sources::new(&[[1.0, 1.0]], &mask),
            Err(PointError::InsideWall { number: 0, .. })
        ));
    }

    #[test]
    fn points_off_the_grid_are_named() {
        let mask = Mask::all_open(Shape::new([3, 2]).unwrap());
        let error = Sources::new(&[[0.0, 0.0], [3.0, 0.0]], &mask).unwrap_err();
        assert_eq!(
            error.to_string(),
            "source 1 at [3.0, 0.0] lies outside the grid of [3, 2] cells; \
             pixel coordinates run from -0.5 to the size minus 0.5"
        );
        assert_eq!(Sources::<2>::new(&[], &mask), Err(PointError::Missing { role: "source" }));
        assert!(Sources::new(&[[f64::NAN, 0.0]], &mask).is_err());
    }
}
