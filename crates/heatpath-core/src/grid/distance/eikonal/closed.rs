//! Derivatives along offsets that lead into a wall or off the grid.

use super::factor::{Factor, Upwind};
use super::stencil::Stencil;
use super::update::{Difference, Differences};
use crate::grid::tensor::{apply, determinant, inverse};

impl<const D: usize, const N: usize, S: Stencil<D, N>> Factor<'_, D, N, S> {
    /// The same with the derivatives along directions of which the nearer side is closed, so that no
    /// neighbour tells them: those of the gradient that the others imply.
    #[cold]
    pub(super) fn solve_with_closed_sides(
        &self,
        upwinds: &[Upwind; N],
        mut differences: Differences<N>,
        second_order: bool,
        distance: f64,
    ) -> Option<f64> {
        let nearest = upwinds.iter().map(|upwind| upwind.near).fold(f64::INFINITY, f64::min);
        let Some(gradient) = self.gradient(upwinds, second_order) else { return Some(distance) };
        if !self.comes_from_inside(gradient, distance) {
            return Some(distance);
        }
        let mut missing = false;
        let unknown = |(direction, upwind): &(usize, &Upwind)| {
            upwind.near == f64::INFINITY && self.of_r_alone(*direction, upwind, nearest).is_none()
        };
        for (direction, _) in upwinds.iter().enumerate().filter(unknown) {
            let [slope, rest] =
                gradient.map(|covector| self.stencil.along(self.place, direction, &covector));
            let side = if slope * distance > rest { -1 } else { 1 };
            let weight = self.stencil.weight(self.place, direction);
            if weight > 0.0 && self.stencil.neighbour(self.place, direction, side).is_none() {
                let sign = -side as f64;
                differences.insert(Difference {
                    weight,
                    slope: sign * slope,
                    rest: sign * rest,
                    near: nearest,
                });
                missing = true;
            }
        }
        if missing { differences.solve().or(Some(distance)) } else { Some(distance) }
    }

    /// Whether the geodesic with that gradient reaches the cell through open cells, not along the wall
    /// or the border.
    fn comes_from_inside(&self, [slopes, rests]: [[f64; D]; 2], distance: f64) -> bool {
        let mut velocity = [0.0; D];
        for direction in 0..N {
            let along = |covector| self.stencil.along(self.place, direction, covector);
            let flow = self.stencil.weight(self.place, direction)
                * (along(&slopes) * distance - along(&rests));
            let vector = self.stencil.vector(self.place, direction);
            (0..D).for_each(|axis| velocity[axis] += flow * vector[axis]);
        }
        let largest = velocity.iter().fold(0.0, |largest, part| part.abs().max(largest));
        (1..=4).all(|cells| {
            let back = f64::from(cells) / largest;
            self.stencil
                .is_open_at(std::array::from_fn(|axis| self.index[axis] - back * velocity[axis]))
        })
    }

    /// The gradient as a function of the distance T, `slopes T - rests`, by least squares from the
    /// differences; `None` if they are too few.
    fn gradient(&self, upwinds: &[Upwind; N], second_order: bool) -> Option<[[f64; D]; 2]> {
        let mut normal = [[0.0; D]; D];
        let (mut slopes, mut rests) = ([0.0; D], [0.0; D]);
        for (direction, upwind) in upwinds.iter().enumerate() {
            if upwind.near == f64::INFINITY {
                continue;
            }
            let difference = self.difference(direction, upwind, second_order);
            let away =
                self.stencil.vector(self.place, direction).map(|part| -(upwind.side as f64) * part);
            for i in 0..D {
                (0..D).for_each(|j| normal[i][j] += away[i] * away[j]);
                slopes[i] += away[i] * difference.slope;
                rests[i] += away[i] * difference.rest;
            }
        }
        // Of whole numbers.
        if determinant(&normal) < 0.5 {
            return None;
        }
        let inverse = inverse(&normal);
        Some([apply(&inverse, slopes), apply(&inverse, rests)])
    }
}
