//! Pictures of trees whose centrelines are known.
#![allow(dead_code, reason = "each test program uses a part")]

use heatpath_core::grid::{Grid, Shape};

/// A straight branch.
#[derive(Clone, Copy)]
pub(crate) struct Branch<const D: usize> {
    pub(crate) from: [f64; D],
    pub(crate) to: [f64; D],
    pub(crate) radius: f64,
}

impl<const D: usize> Branch<D> {
    pub(crate) fn distance(&self, point: [f64; D]) -> f64 {
        let along: [f64; D] = std::array::from_fn(|axis| self.to[axis] - self.from[axis]);
        let dot = |a: [f64; D], b: [f64; D]| (0..D).map(|axis| a[axis] * b[axis]).sum::<f64>();
        let offset: [f64; D] = std::array::from_fn(|axis| point[axis] - self.from[axis]);
        let part = (dot(offset, along) / dot(along, along)).clamp(0.0, 1.0);
        let rest: [f64; D] = std::array::from_fn(|axis| offset[axis] - part * along[axis]);
        dot(rest, rest).sqrt()
    }

    /// Points of the centreline, half a cell apart.
    pub(crate) fn samples(&self) -> Vec<[f64; D]> {
        let axis_length = |axis: usize| self.to[axis] - self.from[axis];
        let length = (0..D).map(|axis| axis_length(axis).powi(2)).sum::<f64>().sqrt();
        let count = (2.0 * length).ceil() as usize;
        let at = |i: usize| i as f64 / count as f64;
        let point =
            |i: usize| std::array::from_fn(|axis| self.from[axis] + at(i) * axis_length(axis));
        (0..=count).map(point).collect()
    }
}

/// A tree of some 30 branches from the trunk's root, which is where the first branch begins, in a
/// picture of `side` cells: branches fork, and each child is thinner.
pub(crate) fn tree(side: usize, random: &mut impl FnMut() -> f64) -> Vec<Branch<2>> {
    let scale = side as f64 / 300.0;
    let mut branches = Vec::new();
    let mut growing = vec![([150.0 * scale, 292.0 * scale], -1.57, 62.0 * scale, 4.0, 0)];
    while let Some((from, angle, length, radius, generation)) = growing.pop() {
        // Each branch is bent a little, in two pieces.
        let mut here = from;
        for turn in [0.15, -0.15] {
            let angle: f64 = angle + turn * (2.0 * random() - 1.0);
            let to = [here[0] + 0.5 * length * angle.cos(), here[1] + 0.5 * length * angle.sin()];
            branches.push(Branch { from: here, to, radius });
            here = to;
        }
        if generation < 4 {
            for side in [-1.0, 1.0] {
                let angle = angle + side * (0.35 + 0.35 * random());
                let child = (0.8 * radius_of(radius), length * (0.75 + 0.2 * random()));
                growing.push((here, angle, child.1, child.0, generation + 1));
            }
        }
    }
    branches
}

/// Branches are at least 1 cell thick.
fn radius_of(radius: f64) -> f64 {
    radius.max(1.25)
}

/// Branches of value 0.8 on 0.2, with borders a cell wide and noise of this amplitude.
pub(crate) fn picture<const D: usize>(
    shape: Shape<D>,
    branches: &[Branch<D>],
    noise: f64,
    random: &mut impl FnMut() -> f64,
) -> Grid<f64, D> {
    Grid::from_fn(shape, |index| {
        let point = index.map(|i| i as f64);
        let inside = |branch: &Branch<D>| branch.radius - branch.distance(point) + 0.5;
        let share = branches.iter().map(inside).fold(0.0, f64::max).min(1.0);
        (0.2 + 0.6 * share + noise * (2.0 * random() - 1.0)).clamp(0.0, 1.0)
    })
}

/// The recall and precision of cells against centrelines within some cells: the share of
/// centreline samples with a cell that near, and the share of cells with a centreline that near.
pub(crate) fn recall_and_precision<const D: usize>(
    cells: &Grid<bool, D>,
    branches: &[Branch<D>],
    tolerance: f64,
) -> (f64, f64) {
    let shape = cells.shape();
    let found = (0..shape.cells()).filter(|&cell| cells.values()[cell]);
    let found: Vec<[f64; D]> = found.map(|cell| shape.centre(cell)).collect();
    let samples: Vec<[f64; D]> = branches.iter().flat_map(Branch::samples).collect();
    let inside = samples.iter().filter(|&&point| shape.contains(point)).copied();
    let samples: Vec<[f64; D]> = inside.collect();
    let is_found = |sample: &&[f64; D]| {
        found.iter().any(|&cell| shape.physical_distance(cell, **sample) <= tolerance)
    };
    let is_true =
        |cell: &&[f64; D]| branches.iter().any(|branch| branch.distance(**cell) <= tolerance);
    let share = |count: usize, all: usize| count as f64 / all as f64;
    (
        share(samples.iter().filter(is_found).count(), samples.len()),
        share(found.iter().filter(is_true).count(), found.len()),
    )
}
