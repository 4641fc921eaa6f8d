//! The Laplacian of a triangulation (linear finite elements), and systems made of it.

use crate::Exec;
use crate::linear::{Analysis, Cholesky, LinearError, nested_dissection};
use crate::mesh::Triangulation;
use crate::mesh::triangle::{area, cotangents};
use std::sync::Arc;

/// The cotangent Laplacian of a triangulation and the mass of its vertices, with the order in which
/// vertices are eliminated.
#[derive(Debug)]
pub(super) struct Laplacian {
    /// Half the cotangents of each face.
    weights: Vec<[f64; 3]>,
    /// A third of the squared slowness times area of the faces around each vertex.
    masses: Vec<f64>,
    /// The place of each vertex in the order of elimination.
    places: Vec<usize>,
    /// The weight of each coupling of the analysis.
    couplings: Vec<f64>,
    analysis: Arc<Analysis>,
}

impl Laplacian {
    pub(super) fn new(
        triangulation: &Triangulation,
        memory_limit: usize,
    ) -> Result<Self, LinearError> {
        let points = triangulation.points();
        let faces = 0..triangulation.faces().len();
        let weights: Vec<[f64; 3]> =
            faces.map(|face| cotangents(triangulation.sides(face)).map(|x| 0.5 * x)).collect();
        let (pairs, couplings) = couplings(triangulation, &weights);
        let order = nested_dissection(points, &pairs);
        let mut places = vec![0; points.len()];
        order.iter().enumerate().for_each(|(place, &vertex)| places[vertex] = place);
        let pairs = pairs.iter().map(|pair| pair.map(|vertex| places[vertex])).collect();
        let analysis = Arc::new(Analysis::new(points.len(), pairs, memory_limit)?);
        let masses = masses(points.len(), triangulation);
        Ok(Self { weights, masses, places, couplings, analysis })
    }

    /// The place of each vertex in the order of elimination.
    pub(super) fn places(&self) -> &[usize] {
        &self.places
    }

    /// The memory that a factor takes, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.analysis.bytes()
    }

    /// The mass of each vertex plus the Laplacian times `time`. Vertices that are `cold` stay at zero.
    pub(super) fn heat(
        &self,
        time: f64,
        cold: impl Fn(usize) -> bool,
        exec: &Exec,
    ) -> Result<Cholesky, LinearError> {
        let is_cold: Vec<bool> = (0..self.places.len()).map(cold).collect();
        let mut diagonal = self.ordered(&self.masses);
        let is_cold = self.ordered(&is_cold);
        let mut values = Vec::with_capacity(self.couplings.len());
        for (&[a, b], &weight) in self.analysis.couplings().iter().zip(&self.couplings) {
            let value = time * weight;
            diagonal[a] += value;
            diagonal[b] += value;
            values.push(if is_cold[a] || is_cold[b] { 0.0 } else { -value });
        }
        self.factor(diagonal, &values, exec)
    }

    /// The Laplacian itself, with a spring at one vertex of each component, those for which `first`
    /// is true, so that it has an inverse.
    pub(super) fn poisson(
        &self,
        first: impl Fn(usize) -> bool,
        exec: &Exec,
    ) -> Result<Cholesky, LinearError> {
        let mut diagonal = vec![0.0; self.places.len()];
        for (ends, weight) in self.analysis.couplings().iter().zip(&self.couplings) {
            ends.iter().for_each(|&end| diagonal[end] += weight);
        }
        for (vertex, &place) in self.places.iter().enumerate() {
            if first(vertex) {
                diagonal[place] *= 2.0;
            }
        }
        let values: Vec<f64> = self.couplings.iter().map(|weight| -weight).collect();
        self.factor(diagonal, &values, exec)
    }

    /// The Laplacian of functions that are linear on each face but not the same on both sides of an
    /// edge: `values` in the corners of each face, of which only differences count.
    pub(super) fn divergence(
        &self,
        triangulation: &Triangulation,
        values: &[[f64; 3]],
    ) -> Vec<f64> {
        let mut sums = vec![0.0; self.places.len()];
        for (face, corners) in triangulation.faces().iter().enumerate() {
            for i in 0..3 {
                let [from, to] = [(i + 1) % 3, (i + 2) % 3];
                let flux = self.weights[face][i] * (values[face][to] - values[face][from]);
                sums[corners[to] as usize] += flux;
                sums[corners[from] as usize] -= flux;
            }
        }
        sums
    }

    fn factor(
        &self,
        mut diagonal: Vec<f64>,
        couplings: &[f64],
        exec: &Exec,
    ) -> Result<Cholesky, LinearError> {
        // Vertices without faces.
        diagonal.iter_mut().filter(|value| **value == 0.0).for_each(|value| *value = 1.0);
        Cholesky::new(Arc::clone(&self.analysis), &diagonal, couplings, exec)
    }

    /// Values of the vertices in the order of elimination.
    pub(super) fn ordered<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let mut ordered = values.to_vec();
        self.places.iter().zip(values).for_each(|(&place, &value)| ordered[place] = value);
        ordered
    }

    /// Values in the order of elimination as those of the vertices.
    pub(super) fn restored<T: Copy>(&self, ordered: &[T]) -> Vec<T> {
        self.places.iter().map(|&place| ordered[place]).collect()
    }
}

/// The ends of the edges, other than those that begin and end in one vertex, and their weights.
fn couplings(triangulation: &Triangulation, weights: &[[f64; 3]]) -> (Vec<[usize; 2]>, Vec<f64>) {
    let edges = triangulation.lengths().len();
    let (mut ends, mut sums) = (vec![[0; 2]; edges], vec![0.0; edges]);
    for (face, corners) in triangulation.faces().iter().enumerate() {
        for i in 0..3 {
            let edge = triangulation.face_edges()[face][i] as usize;
            ends[edge] = [1, 2].map(|k| corners[(i + k) % 3] as usize);
            sums[edge] += weights[face][i];
        }
    }
    ends.into_iter().zip(sums).filter(|([a, b], _)| a != b).unzip()
}

fn masses(vertices: usize, triangulation: &Triangulation) -> Vec<f64> {
    let mut masses = vec![0.0; vertices];
    for (face, corners) in triangulation.faces().iter().enumerate() {
        let slowness = triangulation.slowness()[face];
        let third = slowness * slowness * area(triangulation.sides(face)) / 3.0;
        corners.iter().for_each(|&vertex| masses[vertex as usize] += third);
    }
    masses
}
