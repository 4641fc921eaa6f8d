//! The distance from a point to the nearest of many segments.

use std::ops::Range;

/// So many segments at most are not worth a division.
const LEAF: usize = 4;

/// Straight segments in a tree of boxes, each halved across its longest side.
pub(super) struct Nearest<const D: usize> {
    segments: Vec<[[f64; D]; 2]>,
    /// A node's first child follows it.
    nodes: Vec<Node<D>>,
}

struct Node<const D: usize> {
    low: [f64; D],
    high: [f64; D],
    segments: Range<usize>,
    /// The second child; none in a leaf.
    second: Option<usize>,
}

impl<const D: usize> Nearest<D> {
    pub(super) fn new(segments: Vec<[[f64; D]; 2]>) -> Self {
        let mut tree = Self { segments, nodes: Vec::new() };
        if !tree.segments.is_empty() {
            tree.divide(0..tree.segments.len());
        }
        tree
    }

    /// The distance of `point` from the nearest segment; infinite if there are none.
    pub(super) fn distance(&self, point: [f64; D]) -> f64 {
        match self.nodes.len() {
            0 => f64::INFINITY,
            _ => self.search(0, point, f64::INFINITY).sqrt(),
        }
    }

    fn divide(&mut self, range: Range<usize>) {
        let (low, high) = bounds(&self.segments[range.clone()]);
        let place = self.nodes.len();
        self.nodes.push(Node { low, high, segments: range.clone(), second: None });
        if range.len() <= LEAF {
            return;
        }
        let longer = |a: &usize, b: &usize| (high[*a] - low[*a]).total_cmp(&(high[*b] - low[*b]));
        let axis = (0..D).max_by(longer).unwrap_or(0);
        let middle = |[a, b]: &[[f64; D]; 2]| a[axis] + b[axis];
        let half = range.len() / 2;
        self.segments[range.clone()]
            .select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
        self.divide(range.start..range.start + half);
        self.nodes[place].second = Some(self.nodes.len());
        self.divide(range.start + half..range.end);
    }

    /// The squared distance to the nearest segment below a node, or `best` if that is less.
    fn search(&self, place: usize, point: [f64; D], best: f64) -> f64 {
        let node = &self.nodes[place];
        let Some(second) = node.second else {
            let segments = self.segments[node.segments.clone()].iter();
            return segments.map(|&ends| distance_sq(point, ends)).fold(best, f64::min);
        };
        let children =
            [place + 1, second].map(|child| (self.nodes[child].distance_sq(point), child));
        let [near, far] =
            if children[0].0 <= children[1].0 { children } else { [children[1], children[0]] };
        [near, far].into_iter().fold(best, |best, (bound, child)| {
            if bound < best { self.search(child, point, best) } else { best }
        })
    }
}

impl<const D: usize> Node<D> {
    fn distance_sq(&self, point: [f64; D]) -> f64 {
        let beyond = |axis: usize| {
            (self.low[axis] - point[axis]).max(point[axis] - self.high[axis]).max(0.0)
        };
        (0..D).map(|axis| beyond(axis).powi(2)).sum()
    }
}

fn bounds<const D: usize>(segments: &[[[f64; D]; 2]]) -> ([f64; D], [f64; D]) {
    let along = |axis: usize| segments.iter().flatten().map(move |point| point[axis]);
    let low = std::array::from_fn(|axis| along(axis).fold(f64::INFINITY, f64::min));
    (low, std::array::from_fn(|axis| along(axis).fold(f64::NEG_INFINITY, f64::max)))
}

/// The squared distance of a point from a segment, which may be a point itself.
fn distance_sq<const D: usize>(point: [f64; D], [from, to]: [[f64; D]; 2]) -> f64 {
    let dot = |a: [f64; D], b: [f64; D]| (0..D).map(|axis| a[axis] * b[axis]).sum::<f64>();
    let minus = |a: [f64; D], b: [f64; D]| std::array::from_fn(|axis| a[axis] - b[axis]);
    let (along, offset) = (minus(to, from), minus(point, from));
    let length_sq = dot(along, along);
    let part = if length_sq > 0.0 { (dot(offset, along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    let apart = std::array::from_fn(|axis| offset[axis] - part * along[axis]);
    dot(apart, apart)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_what_a_search_of_all_finds() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        for count in [0, 1, 3, 5, 64, 333] {
            let segments: Vec<[[f64; 3]; 2]> = (0..count)
                .map(|_| {
                    let from: [f64; 3] = std::array::from_fn(|_| 10.0 * random());
                    [from, from.map(|x| x + random() - 0.5)]
                })
                .collect();
            let tree = Nearest::new(segments.clone());
            for _ in 0..100 {
                let point = std::array::from_fn(|_| 14.0 * random() - 2.0);
                let all = segments.iter().map(|&ends| distance_sq(point, ends));
                assert_eq!(tree.distance(point), all.fold(f64::INFINITY, f64::min).sqrt());
            }
        }
    }

    #[test]
    fn distances_to_the_inside_the_ends_and_a_point() {
        let segment = [[0.0, 0.0], [4.0, 0.0]];
        assert_eq!(distance_sq([2.0, 3.0], segment), 9.0);
        assert_eq!(distance_sq([7.0, 4.0], segment), 25.0);
        assert_eq!(distance_sq([-3.0, 4.0], segment), 25.0);
        assert_eq!(distance_sq([1.0, 1.0], [[0.0, 0.0]; 2]), 2.0);
    }
}
