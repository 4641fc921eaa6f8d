//! The Poisson equation: the distances whose differences across faces are nearest to given ones.

use super::Faces;
use crate::Exec;
use crate::grid::heat::{Elimination, ImplicitError, check_memory, faces};
use crate::grid::medium::Medium;
use crate::grid::{Grid, Mask};
use crate::linear::{Cholesky, Entries, Pin, Pinned, Wide};

/// The weighted Laplacian with free borders, factored once for all sources.
///
/// It does not see a constant in each component (open cells that are connected), so a spring holds
/// one cell of each at zero. Right-hand sides that add up to zero in each component leave the spring
/// alone: their solutions are those of the free Laplacian, up to the constant.
#[derive(Debug)]
pub(super) struct Poisson<const D: usize> {
    elimination: Elimination,
    /// The faces between open cells: the axis, and the cell after the face.
    faces: Vec<(usize, usize)>,
    cholesky: Cholesky,
    /// The weight of each face over its length squared, in cell units.
    weights: Faces<D>,
    /// The component of each cell.
    components: Vec<usize>,
}

impl<const D: usize> Poisson<D> {
    /// Factors the Laplacian. The weight of a face is one over its slowness squared.
    pub(super) fn new(
        medium: &Medium<D>,
        slowness: &Grid<f64, D>,
        memory_limit: usize,
        exec: &Exec,
    ) -> Result<Self, ImplicitError> {
        check_memory(medium, memory_limit)?;
        let (shape, slowness) = (medium.shape(), slowness.values());
        let faces: Vec<(usize, usize)> = faces(medium).collect();
        let pairs = faces.iter().map(|&(axis, cell)| [cell, cell - shape.stride(axis)]);
        let elimination = Elimination::new(medium.mask(), [1; D], pairs, memory_limit)?;
        let mut weights: Faces<D> = std::array::from_fn(|_| vec![0.0; shape.cells()]);
        let mut diagonal = vec![0.0; shape.cells()];
        let mut couplings = Vec::with_capacity(faces.len());
        for &(axis, cell) in &faces {
            let before = cell - shape.stride(axis);
            let mean = 0.5 * (slowness[cell] + slowness[before]);
            let weight = (shape.smallest_spacing() / (mean * shape.spacing()[axis])).powi(2);
            weights[axis][cell] = weight;
            [cell, before].into_iter().for_each(|cell| diagonal[cell] += weight);
            couplings.push(-weight);
        }
        let components = components(medium.mask(), |first| {
            diagonal[first] = if diagonal[first] > 0.0 { 2.0 * diagonal[first] } else { 1.0 };
        });
        let diagonal: Vec<f64> = elimination.cells.iter().map(|&cell| diagonal[cell]).collect();
        let cholesky = elimination.factor(&diagonal, &couplings, exec)?;
        Ok(Self { elimination, faces, cholesky, weights, components })
    }

    /// The memory that the factorisation takes, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.cholesky.analysis().bytes()
    }

    /// The faces between open cells: the axis, and the cell after the face.
    pub(super) fn faces(&self) -> &[(usize, usize)] {
        &self.faces
    }

    /// A pin in a cell.
    pub(super) fn pin(&self, cell: usize, value: f64) -> Pin {
        Pin { parts: vec![(cell, 1.0)], component: self.components[cell], value }
    }

    /// The right-hand side for given differences: their weighted divergence.
    pub(super) fn side(&self, differences: &Faces<D>, stride: impl Fn(usize) -> usize) -> Entries {
        let places = &self.elimination.places;
        let mut sums = vec![0.0; self.elimination.cells.len()];
        for &(axis, cell) in self.faces() {
            let flux = self.weights[axis][cell] * differences[axis][cell];
            sums[places[cell]] += flux;
            sums[places[cell - stride(axis)]] -= flux;
        }
        sums.into_iter().map(Wide::from).enumerate().collect()
    }

    /// Solves for several right-hand sides with their pins. Infinite in walls, and in components
    /// without pins.
    pub(super) fn solve(
        &self,
        sides: &[Entries],
        pins: Vec<Vec<Pin>>,
        exec: &Exec,
    ) -> Vec<Vec<f64>> {
        let solutions = self.solutions(sides, exec);
        let mut systems: Vec<Pinned> = pins
            .into_iter()
            .zip(solutions)
            .map(|(pins, values)| Pinned::new(pins, values))
            .collect();
        loop {
            let mut active: Vec<&mut Pinned> =
                systems.iter_mut().filter(|system| !system.is_finished()).collect();
            if active.is_empty() {
                break;
            }
            let charge = |(cell, charge)| (self.elimination.places[cell], Wide::from(charge));
            let side = |system: &&mut Pinned| system.side().into_iter().map(charge).collect();
            let sides: Vec<Entries> = active.iter().map(side).collect();
            let solutions = self.solutions(&sides, exec);
            active.iter_mut().zip(&solutions).for_each(|(system, x)| system.step(x));
        }
        systems.into_iter().map(|system| system.finish(&self.components)).collect()
    }

    /// Solutions as fields, zero in walls.
    fn solutions(&self, sides: &[Entries], exec: &Exec) -> Vec<Vec<f64>> {
        let solutions = self.cholesky.solve(sides, exec).into_iter();
        let fields = solutions.map(|solution| {
            let mut field = vec![0.0; self.elimination.places.len()];
            let cells = self.elimination.cells.iter().zip(&solution);
            cells.for_each(|(&cell, &x)| field[cell] = x.to_f64());
            field
        });
        fields.collect()
    }
}

/// The number of the component of each open cell; the first cell of each is shown to `first`.
fn components<const D: usize>(mask: &Mask<D>, mut first: impl FnMut(usize)) -> Vec<usize> {
    let mut components = vec![usize::MAX; mask.shape().cells()];
    let mut stack = Vec::new();
    for seed in 0..components.len() {
        if !mask.is_open(seed) || components[seed] != usize::MAX {
            continue;
        }
        first(seed);
        stack.push(seed);
        while let Some(cell) = stack.pop() {
            if std::mem::replace(&mut components[cell], seed) == usize::MAX {
                let neighbours = mask.shape().neighbours(cell);
                stack.extend(
                    neighbours.filter(|&next| mask.is_open(next) && components[next] == usize::MAX),
                );
            }
        }
    }
    components
}
