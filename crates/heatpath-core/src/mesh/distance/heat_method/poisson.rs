//! The distances whose differences are nearest to given ones.

use super::laplacian::Laplacian;
use crate::Exec;
use crate::linear::{Cholesky, Pin, Pinned};

/// The Laplacian, factored. It does not see a constant in each component; pins say which is right.
#[derive(Debug)]
pub(super) struct Poisson {
    cholesky: Cholesky,
    /// The component of each vertex, named by one of its vertices.
    components: Vec<usize>,
}

impl Poisson {
    pub(super) fn new(cholesky: Cholesky, components: Vec<usize>) -> Self {
        Self { cholesky, components }
    }

    /// The component of each vertex.
    pub(super) fn components(&self) -> &[usize] {
        &self.components
    }

    /// Solves for several right-hand sides with their pins. Infinite in components without pins.
    pub(super) fn solve(
        &self,
        laplacian: &Laplacian,
        systems: Vec<(Vec<Pin>, Vec<f64>)>,
        exec: &Exec,
    ) -> Vec<Vec<f64>> {
        let (pins, sides): (Vec<_>, Vec<_>) = systems.into_iter().unzip();
        let solutions = self.solutions(laplacian, &sides, exec);
        let mut systems: Vec<Pinned> =
            pins.into_iter().zip(solutions).map(|(pins, x)| Pinned::new(pins, x)).collect();
        loop {
            let mut active: Vec<&mut Pinned> =
                systems.iter_mut().filter(|system| !system.is_finished()).collect();
            if active.is_empty() {
                break;
            }
            let sides: Vec<_> = active.iter().map(|system| self.side(system)).collect();
            let solutions = self.solutions(laplacian, &sides, exec);
            active.iter_mut().zip(&solutions).for_each(|(system, x)| system.step(x));
        }
        systems.into_iter().map(|system| system.finish(&self.components)).collect()
    }

    fn side(&self, system: &Pinned) -> Vec<f64> {
        let mut side = vec![0.0; self.components.len()];
        system.side().into_iter().for_each(|(vertex, charge)| side[vertex] += charge);
        side
    }

    fn solutions(&self, laplacian: &Laplacian, sides: &[Vec<f64>], exec: &Exec) -> Vec<Vec<f64>> {
        let mut solutions: Vec<Vec<f64>> =
            sides.iter().map(|side| laplacian.ordered(side)).collect();
        self.cholesky.solve_plain(&mut solutions, exec);
        solutions.iter().map(|solution| laplacian.restored(solution)).collect()
    }
}
