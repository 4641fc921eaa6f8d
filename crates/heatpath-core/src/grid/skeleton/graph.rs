//! Nodes and branches with lengths and radii.

use super::network::Network;
use super::{radii, thin};
use crate::grid::path::length;
use crate::grid::{Grid, Shape};

/// How often [`averaged`] averages: a Gaussian of standard deviation 2 cells.
const PASSES: usize = 8;

/// A centreline as a graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph<const D: usize> {
    /// The grid that it comes from.
    pub shape: Shape<D>,
    /// Ends, junctions, and one node on each closed curve that has neither.
    pub nodes: Vec<Node<D>>,
    /// The curves between them.
    pub branches: Vec<Branch<D>>,
}

/// An end or a junction of branches.
#[derive(Clone, Debug, PartialEq)]
pub struct Node<const D: usize> {
    /// Where it is, in pixel coordinates.
    pub point: [f64; D],
    /// The radius there, in physical units.
    pub radius: f64,
    /// How many ends of branches meet: 0 of a single cell, 1 at an end, 2 on a closed curve, 3 and
    /// more at a junction.
    pub degree: usize,
}

/// A curve between two nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch<const D: usize> {
    /// The node at its first point.
    pub from: usize,
    /// The node at its last point; the same on a closed curve.
    pub to: usize,
    /// The points in pixel coordinates: those of the nodes and, between them, one a cell, smoothed so
    /// that the steps of the grid do not lengthen it.
    pub points: Vec<[f64; D]>,
    /// The radius at each point, in physical units.
    pub radii: Vec<f64>,
    /// The length of the polyline in pixels.
    pub length: f64,
    /// The length of the polyline in physical units.
    pub physical_length: f64,
    /// The physical length over that of the straight line between the ends; infinite on a closed curve.
    pub tortuosity: f64,
    /// The mean of the radii along the length.
    pub mean_radius: f64,
}

impl<const D: usize> Graph<D> {
    /// The graph of a mask: of its centreline ([`thin`]), with the distances to its edge as
    /// [`radii`].
    #[must_use]
    pub fn of_mask(mask: &Grid<bool, D>) -> Self {
        Self::new(&thin(mask), &radii(mask))
    }

    /// The graph of a centreline, whose cells hang together by faces, edges and corners, with the
    /// radii that `radii` has in its cells: those of a mask ([`radii`]), or the scale of the strongest
    /// response of a vesselness. `None` if the sizes differ.
    ///
    /// Points are averaged along the curve, the nodes fixed, without drawing it together: the length of
    /// straight lines is then right to 1 % at any angle, where the bare steps of the grid are up to
    /// 8 % too long.
    #[must_use]
    pub fn of_centreline(centreline: &Grid<bool, D>, radii: &Grid<f64, D>) -> Option<Self> {
        let is_one_grid = centreline.shape().size() == radii.shape().size();
        is_one_grid.then(|| Self::new(centreline, radii))
    }

    fn new(centreline: &Grid<bool, D>, radii: &Grid<f64, D>) -> Self {
        let shape = *centreline.shape();
        let network = Network::new(centreline);
        let node = |&cell: &usize| Node {
            point: shape.centre(cell),
            radius: radii.values()[cell],
            degree: 0,
        };
        let mut nodes: Vec<Node<D>> = network.nodes.iter().map(node).collect();
        let mut branches = Vec::new();
        for chain in &network.chains {
            nodes[chain.from].degree += 1;
            nodes[chain.to].degree += 1;
            let centres: Vec<_> = chain.cells.iter().map(|&cell| shape.centre(cell)).collect();
            let radii = chain.cells.iter().map(|&cell| radii.values()[cell]).collect();
            let ends = [chain.from, chain.to];
            branches.push(Branch::new(ends, smoothed(&centres), radii, &shape));
        }
        Self { shape, nodes, branches }
    }

    /// The physical length of all branches.
    #[must_use]
    pub fn physical_length(&self) -> f64 {
        self.branches.iter().map(|branch| branch.physical_length).sum()
    }
}

impl<const D: usize> Branch<D> {
    /// The branch through `points` with their `radii`, and what follows from these.
    pub(super) fn new(
        [from, to]: [usize; 2],
        points: Vec<[f64; D]>,
        radii: Vec<f64>,
        shape: &Shape<D>,
    ) -> Self {
        let steps = || points.windows(2).map(|pair| shape.physical_distance(pair[0], pair[1]));
        let physical_length: f64 = steps().sum();
        let means = radii.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let integral: f64 = steps().zip(means).map(|(step, mean)| step * mean).sum();
        let chord = shape.physical_distance(points[0], points[points.len() - 1]);
        Self {
            from,
            to,
            length: length(&points, &shape.unit_spacing()),
            physical_length,
            tortuosity: if chord > 0.0 { physical_length / chord } else { f64::INFINITY },
            mean_radius: integral / physical_length,
            points,
            radii,
        }
    }
}

/// The points without the steps of the grid, the first and the last fixed: `A(2 - A)` of them, where
/// `A` averages; of curves wider than the average that shortens next to nothing.
pub(crate) fn smoothed<const D: usize>(points: &[[f64; D]]) -> Vec<[f64; D]> {
    let once = averaged(points.to_vec());
    let both = points.iter().zip(once);
    averaged(both.map(|(p, a)| std::array::from_fn(|axis| 2.0 * p[axis] - a[axis])).collect())
}

fn averaged<const D: usize>(mut points: Vec<[f64; D]>) -> Vec<[f64; D]> {
    for _ in 0..PASSES {
        let before = points.clone();
        for i in 1..points.len().saturating_sub(1) {
            let [a, b, c] = [before[i - 1], before[i], before[i + 1]];
            points[i] = std::array::from_fn(|axis| 0.25 * (a[axis] + 2.0 * b[axis] + c[axis]));
        }
    }
    points
}
