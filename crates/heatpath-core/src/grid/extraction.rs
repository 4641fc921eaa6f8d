//! What automatic extraction begins with: a medium, its structure, and points on it.

use super::medium::Medium;
use super::skeleton::{Graph, radii, thin};
use super::{Grid, PointError, Shape, Sources, seeds, structure, structure_level};
use thiserror::Error;

/// The structure that a medium shows, and the points from which
/// [voting](super::voting) and [key points](super::keypoints) set out.
#[derive(Clone, Debug)]
pub struct Structure<const D: usize> {
    /// The medium.
    pub medium: Medium<D>,
    /// The given points or, without any, a seed in each long piece of the structure.
    pub sources: Sources<D>,
    level: Option<f64>,
}

/// Why extraction cannot begin.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StructureError {
    /// All cells are equally fast.
    #[error("the medium is the same everywhere and shows no structure: choose another one")]
    None,
    /// No piece of the structure is long enough for a seed.
    #[error(
        "no piece of the structure, where k D is {level:.4} or more, is {least_extent:.1} pixels \
         long: give a source, or a lower extent or level of the structure"
    )]
    Short {
        /// The squared speed from which on a cell is part of the structure.
        level: f64,
        /// The length of box diagonals from which on pieces count, in cell units.
        least_extent: f64,
    },
    /// A given point lies outside the grid or in a wall.
    #[error(transparent)]
    Point(#[from] PointError),
}

impl<const D: usize> Structure<D> {
    /// The structure of `medium` from the squared speed `level` on ([`structure_level`] if that is
    /// `None`), with the given `points` or, if there are none, [`seeds`] in its pieces of at least
    /// `least_extent` cell units.
    ///
    /// # Errors
    /// A point outside the grid or in a wall; or no points, and nowhere to put seeds.
    pub fn new(
        medium: Medium<D>,
        points: &[[f64; D]],
        level: Option<f64>,
        least_extent: f64,
    ) -> Result<Self, StructureError> {
        let level = level.or_else(|| structure_level(&medium));
        let sources = if points.is_empty() {
            let level = level.ok_or(StructureError::None)?;
            let seeds = seeds(&medium, level, least_extent);
            if seeds.is_empty() {
                return Err(StructureError::Short { level, least_extent });
            }
            Sources::new(&seeds, medium.mask())?
        } else {
            Sources::new(points, medium.mask())?
        };
        Ok(Self { medium, sources, level })
    }

    /// The usual least extent of a piece: a sixteenth of the longest side, in cells.
    #[must_use]
    pub fn usual_extent(shape: &Shape<D>) -> f64 {
        shape.longest_side() as f64 / 16.0
    }

    /// The squared speed from which on a cell is part of the structure.
    ///
    /// # Errors
    /// The medium is the same everywhere.
    pub fn level(&self) -> Result<f64, StructureError> {
        self.level.ok_or(StructureError::None)
    }

    /// The graph of cells that were found, with the radii of the structure around them.
    #[must_use]
    pub fn graph(&self, found: &Grid<bool, D>) -> Graph<D> {
        let Some(level) = self.level else { return Graph::of_mask(found) };
        let mut cells = structure(&self.medium, level);
        cells.values_mut().iter_mut().zip(found.values()).for_each(|(cell, &found)| *cell |= found);
        Graph::of_centreline(&thin(found), &radii(&cells)).expect("cells of one grid")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::medium::{Form, given, uniform};

    /// Two lines, of 60 and of 5 cells.
    fn lines() -> Medium<2> {
        let speed_sq = Grid::from_fn(Shape::new([60, 40]).unwrap(), |[x, y]| match (x, y) {
            (_, 10) | (20..25, 30) => 1.0,
            _ => 1e-3,
        });
        given(speed_sq, Form::Pointwise).unwrap()
    }

    #[test]
    fn seeds_are_put_where_no_points_are_given() {
        let extraction = |points: &[[f64; 2]], extent| {
            let structure = Structure::new(lines(), points, None, extent).unwrap();
            structure.sources.points().to_vec()
        };
        let usual = Structure::usual_extent(lines().shape());
        assert_eq!(usual, 3.75);
        assert_eq!(extraction(&[], usual), [[0.0, 10.0], [20.0, 30.0]]);
        assert_eq!(extraction(&[], 20.0), [[0.0, 10.0]]);
        assert_eq!(extraction(&[[7.0, 7.0]], usual), [[7.0, 7.0]]);
    }

    #[test]
    fn nothing_to_find_is_an_error() {
        let flat = uniform(Shape::new([9, 9]).unwrap());
        let error = |medium, extent| Structure::new(medium, &[], None, extent).unwrap_err();
        assert_eq!(error(flat.clone(), 1.0), StructureError::None);
        assert!(matches!(error(lines(), 99.0), StructureError::Short { least_extent: 99.0, .. }));
        let given = Structure::new(flat, &[[4.0, 4.0]], None, 1.0).unwrap();
        assert_eq!(given.level(), Err(StructureError::None));
    }

    #[test]
    fn radii_are_those_of_the_structure() {
        let speed_sq = Grid::from_fn(Shape::new([40, 21]).unwrap(), |[_, y]| {
            if (8..13).contains(&y) { 1.0 } else { 1e-3 }
        });
        let medium = given(speed_sq, Form::Pointwise).unwrap();
        let structure = Structure::new(medium, &[[0.0, 10.0]], None, 1.0).unwrap();
        let line = Grid::from_fn(Shape::new([40, 21]).unwrap(), |[_, y]| y == 10);
        assert_eq!(structure.graph(&line).branches[0].radii[20], 2.5);
    }
}
