//! Ends of paths along an observer's centrelines.

use heatpath_core::grid::{Mask, Shape};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A source and the observer's ways to it, each from its end, in pixel coordinates of the full size.
#[derive(Debug)]
pub(crate) struct Ways {
    pub(crate) source: [f64; 2],
    pub(crate) truths: Vec<Vec<[f64; 2]>>,
}

/// How many ways may lead to a source.
const MOST_ENDS: usize = 3;

/// How far apart the ends of ways to one source are, in pixels.
const APART: f64 = 20.0;

/// The ways of `length` pixels to `count` sources, or as many as there are.
///
/// Sources are pixels in the middle of equal parts of the centrelines in the order of rows. Of the
/// pixels that are `length` away from a source along the centrelines, those are ends that are in
/// a straight line no nearer than `straightness` times the length.
pub(crate) fn ways(
    centrelines: &Mask<2>,
    length: f64,
    count: usize,
    straightness: f64,
) -> Vec<Ways> {
    let cells: Vec<usize> =
        (0..centrelines.shape().cells()).filter(|&cell| centrelines.is_open(cell)).collect();
    // Four times as many are tried, the others where one of the first has no ways.
    let parts = 4 * count;
    let order = (0..4).flat_map(|start| (start..parts).step_by(4));
    let sources = order.map(|part| cells[cells.len() * (2 * part + 1) / (2 * parts)]);
    let ways = sources.map(|source| ways_to(centrelines, source, length, straightness, &cells));
    ways.filter(|ways| !ways.truths.is_empty()).take(count).collect()
}

fn ways_to(
    centrelines: &Mask<2>,
    source: usize,
    length: f64,
    straightness: f64,
    cells: &[usize],
) -> Ways {
    let shape = centrelines.shape();
    let tree = Tree::new(centrelines, source);
    let apart = |a: usize, b: usize| distance(shape.centre(a), shape.centre(b));
    let mut ends: Vec<usize> = Vec::new();
    for &cell in cells {
        let is_far = (length..length + 1.5).contains(&tree.distances[cell])
            && apart(cell, source) >= straightness * length;
        if is_far && ends.len() < MOST_ENDS && ends.iter().all(|&end| apart(end, cell) > APART) {
            ends.push(cell);
        }
    }
    let truths = ends.iter().map(|&end| tree.way(end, shape)).collect();
    Ways { source: shape.centre(source), truths }
}

/// The shortest ways along the centrelines from one of their pixels.
struct Tree {
    distances: Vec<f64>,
    /// The next pixel on the way to the source.
    next: Vec<usize>,
}

impl Tree {
    /// By Dijkstra, with steps of 1 and the root of 2.
    fn new(centrelines: &Mask<2>, source: usize) -> Self {
        let cells = centrelines.shape().cells();
        let mut tree = Self { distances: vec![f64::INFINITY; cells], next: vec![source; cells] };
        tree.distances[source] = 0.0;
        // Distances are not negative, so their bits have their order.
        let mut queue = BinaryHeap::from([Reverse((0, source))]);
        while let Some(Reverse((bits, cell))) = queue.pop() {
            if bits != tree.distances[cell].to_bits() {
                continue;
            }
            for near in touching(centrelines, cell) {
                let shape = centrelines.shape();
                let there = tree.distances[cell] + distance(shape.centre(cell), shape.centre(near));
                if there < tree.distances[near] {
                    (tree.distances[near], tree.next[near]) = (there, cell);
                    queue.push(Reverse((there.to_bits(), near)));
                }
            }
        }
        tree
    }

    fn way(&self, end: usize, shape: &Shape<2>) -> Vec<[f64; 2]> {
        let mut points = vec![shape.centre(end)];
        let mut cell = end;
        while self.distances[cell] > 0.0 {
            cell = self.next[cell];
            points.push(shape.centre(cell));
        }
        points
    }
}

/// The open cells that share an edge or a corner with a cell.
fn touching(mask: &Mask<2>, cell: usize) -> impl Iterator<Item = usize> {
    let ([width, height], [x, y]) = (mask.shape().size(), mask.shape().index(cell));
    let rows = y.saturating_sub(1)..(y + 2).min(height);
    let columns = x.saturating_sub(1)..(x + 2).min(width);
    let cells = rows.flat_map(move |y| columns.clone().map(move |x| mask.shape().position([x, y])));
    cells.filter(move |&near| near != cell && mask.is_open(near))
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
