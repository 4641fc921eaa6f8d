//! The normalised Laplacian of eq. (15).

use crate::mesh::triangle::cotangents;
use crate::mesh::{Lists, Medium};
use std::ops::Range;

/// What is done with negative weights, which edges have whose opposite angles add up to more than
/// 180 degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// They stay as eq. (15) has them: heat may become negative around them, and such vertices
    /// count as not reached.
    #[default]
    Literal,
    /// They are set to zero: no heat flows along such edges, and all of it stays positive.
    Positive,
}

/// `D^-1 W` with `W_ij = cot a_ij + cot b_ij` and the row sums D (eq. 15), by rows.
#[derive(Clone, Debug)]
pub(super) struct Operator {
    neighbours: Lists,
    /// In the order of the neighbours.
    weights: Vec<f64>,
    /// `2 A / D` of each vertex with the area A of a third of its faces: the squared unit of length in
    /// which heat flows here.
    kappa: Vec<f64>,
    negative: usize,
}

impl Operator {
    /// The operator by the medium's lengths.
    pub(super) fn new(medium: &Medium, choice: Weights) -> Self {
        let adjacency = medium.mesh().adjacency();
        let [areas, sums] = areas_and_sums(medium);
        let mut edge_weights = edge_weights(medium);
        let negative = edge_weights.iter().filter(|&&weight| weight < 0.0).count();
        if choice == Weights::Positive {
            edge_weights.iter_mut().for_each(|weight| *weight = weight.max(0.0));
        }
        let both_ways = || adjacency.edges().iter().flat_map(|&[a, b]| [(a, b), (b, a)]);
        // A vertex has its neighbours in the order of its edges.
        let neighbours = Lists::new(areas.len(), both_ways);
        let (mut weights, mut kappa) = (Vec::new(), Vec::new());
        for (vertex, (area, &sum)) in areas.iter().zip(&sums).enumerate() {
            let edges = adjacency.vertex_edges().of(vertex);
            let row = edges.iter().map(|&edge| edge_weights[edge as usize]);
            // Without the negative ones weights add up to more, but rounded perhaps not.
            let sum =
                if choice == Weights::Literal { sum } else { row.clone().sum::<f64>().max(sum) };
            weights.extend(row.map(|weight| weight / sum));
            kappa.push(2.0 * area / sum);
        }
        Self { neighbours, weights, kappa, negative }
    }

    /// The neighbours of a vertex and their parts in it, which add up to 1.
    pub(super) fn row(&self, vertex: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let weights = self.weights[self.range(vertex)].iter().copied();
        self.neighbours(vertex).iter().map(|&next| next as usize).zip(weights)
    }

    pub(super) fn neighbours(&self, vertex: usize) -> &[u32] {
        self.neighbours.of(vertex)
    }

    /// Where a row lies among all rows.
    pub(super) fn range(&self, vertex: usize) -> Range<usize> {
        self.neighbours.range(vertex)
    }

    pub(super) fn kappa(&self) -> &[f64] {
        &self.kappa
    }

    /// How many edges have a negative weight by eq. (15).
    pub(super) fn negative(&self) -> usize {
        self.negative
    }

    /// The largest step at which `I - step P L` shrinks what it should: `2 / (P (1 + sum |w|))` by
    /// Gershgorin's circles, which is `1 / P` where no weight is negative, and heat stays
    /// positive then.
    pub(super) fn largest_stable_step(&self, speed_sq: &[f64]) -> f64 {
        let at = |vertex: usize| {
            let sum: f64 = self.row(vertex).map(|(_, weight)| weight.abs()).sum();
            2.0 / (speed_sq[vertex] * (1.0 + sum))
        };
        let used = (0..speed_sq.len()).filter(|&vertex| !self.neighbours.of(vertex).is_empty());
        used.map(at).fold(f64::INFINITY, f64::min)
    }
}

/// Smaller weights are those of two right angles.
const ROUNDING: f64 = 1e-12;

/// `cot a + cot b` of each edge (eq. 15), or of as many angles as it is opposite to.
fn edge_weights(medium: &Medium) -> Vec<f64> {
    let adjacency = medium.mesh().adjacency();
    let mut weights = vec![0.0; adjacency.edges().len()];
    for (face, edges) in adjacency.face_edges().iter().enumerate() {
        let cotangents = cotangents(medium.sides(face));
        (0..3).for_each(|i| weights[edges[i] as usize] += cotangents[i]);
    }
    weights.iter_mut().filter(|weight| weight.abs() < ROUNDING).for_each(|weight| *weight = 0.0);
    weights
}

/// A third of the area of the faces at each vertex, and its sum of weights. In each triangle
/// `cot j + cot k = side_i^2 / 2 area`, which is positive however much the cotangents cancel.
fn areas_and_sums(medium: &Medium) -> [Vec<f64>; 2] {
    let mesh = medium.mesh();
    let (mut areas, mut sums) = (vec![0.0; mesh.points().len()], vec![0.0; mesh.points().len()]);
    for (face, vertices) in mesh.faces().iter().enumerate() {
        let (sides, area) = (medium.sides(face), medium.area(face));
        for (&vertex, side) in vertices.iter().zip(sides) {
            areas[vertex as usize] += area / 3.0;
            sums[vertex as usize] += side * side / (2.0 * area);
        }
    }
    [areas, sums]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::sheet;

    #[test]
    fn equation_15_in_numbers() {
        // An equilateral strip: the weight is 2 cot 60 inside and half of that at borders.
        let strip =
            sheet(4, 1, |x, y| [x as f64 - 0.5 * y as f64, 0.75_f64.sqrt() * y as f64, 0.0]);
        let operator = Operator::new(&Medium::uniform(strip).unwrap(), Weights::Literal);
        assert_eq!(operator.negative(), 0);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} instead of {b}");
        let row: Vec<_> = operator.row(2).collect();
        assert_eq!(row.iter().map(|&(next, _)| next).collect::<Vec<_>>(), [1, 3, 7, 8]);
        let expected = [1.0, 1.0, 2.0, 2.0].map(|weight| weight / 6.0);
        row.iter().zip(expected).for_each(|(&(_, weight), expected)| close(weight, expected));
        // Three faces of the area sqrt(3) / 4, and weights that add up to 6 / sqrt(3).
        close(operator.kappa()[2], 0.25);
        close(operator.largest_stable_step(&[0.5; 10]), 2.0);
    }

    #[test]
    fn negative_weights_are_counted_and_shorten_the_step() {
        let slanted = sheet(6, 6, |x, y| [x as f64 + 3.0 * y as f64, y as f64, 0.0]);
        let medium = Medium::uniform(slanted).unwrap();
        let literal = Operator::new(&medium, Weights::Literal);
        let positive = Operator::new(&medium, Weights::Positive);
        assert!(literal.negative() > 0);
        assert_eq!(positive.negative(), literal.negative());
        assert!(literal.largest_stable_step(&[1.0; 49]) < 0.9);
        assert!((positive.largest_stable_step(&[1.0; 49]) - 1.0).abs() < 1e-12);
        for operator in [literal, positive] {
            for vertex in 0..49 {
                let sum: f64 = operator.row(vertex).map(|(_, weight)| weight).sum();
                assert!((sum - 1.0).abs() < 1e-12);
            }
        }
    }
}
