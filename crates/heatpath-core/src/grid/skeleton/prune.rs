//! Spurs taken off a graph.

use super::{Branch, Graph, Node, smoothed};

/// Which end branches are spurs: those shorter than the larger of two lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PruneOptions {
    /// A length in physical units, at least 0. Default 0.
    pub length: f64,
    /// A multiple of the radius at the junction where the branch leaves, at least 0: a bump on the
    /// edge of a tube makes a branch of about the tube's radius. Default 1.5.
    pub radii: f64,
}

impl Default for PruneOptions {
    fn default() -> Self {
        Self { length: 0.0, radii: 1.5 }
    }
}

impl<const D: usize> Graph<D> {
    /// The graph without its spurs: branches from a junction to an end that are too short.
    ///
    /// Each round takes the shortest spur of every junction and joins the two branches that may be
    /// left there; it ends when there are no spurs. Curves without a junction stay, however short.
    #[must_use]
    pub fn pruned(&self, options: PruneOptions) -> Self {
        let mut surgery = Surgery::new(self);
        loop {
            let spurs = surgery.spurs(options);
            if spurs.is_empty() {
                return surgery.graph();
            }
            spurs.iter().for_each(|&spur| surgery.remove(spur));
            (0..self.nodes.len()).for_each(|node| surgery.join_at(node));
        }
    }
}

/// A graph of which branches go.
struct Surgery<'a, const D: usize> {
    graph: &'a Graph<D>,
    branches: Vec<Option<Branch<D>>>,
    /// The branches at each node, closed ones twice.
    at: Vec<Vec<usize>>,
}

impl<'a, const D: usize> Surgery<'a, D> {
    fn new(graph: &'a Graph<D>) -> Self {
        let mut at = vec![Vec::new(); graph.nodes.len()];
        for (number, branch) in graph.branches.iter().enumerate() {
            at[branch.from].push(number);
            at[branch.to].push(number);
        }
        Self { graph, branches: graph.branches.iter().cloned().map(Some).collect(), at }
    }

    /// The shortest spur of each junction that has one.
    fn spurs(&self, options: PruneOptions) -> Vec<usize> {
        let length = |number: usize| self.length(number);
        let shorter = |a: &usize, b: &usize| length(*a).total_cmp(&length(*b)).then(a.cmp(b));
        let junctions = (0..self.at.len()).filter(|&node| self.at[node].len() > 2);
        junctions
            .filter_map(|node| {
                let least = options.length.max(options.radii * self.graph.nodes[node].radius);
                let is_spur = |&number: &usize| {
                    length(number) < least && self.at[self.other_end(number, node)].len() == 1
                };
                self.at[node].iter().copied().filter(is_spur).min_by(shorter)
            })
            .collect()
    }

    fn length(&self, number: usize) -> f64 {
        self.branches[number].as_ref().map_or(0.0, |branch| branch.physical_length)
    }

    fn other_end(&self, number: usize, node: usize) -> usize {
        match &self.branches[number] {
            Some(branch) if branch.from == node => branch.to,
            Some(branch) => branch.from,
            None => node,
        }
    }

    fn remove(&mut self, number: usize) {
        if let Some(branch) = self.branches[number].take() {
            for node in [branch.from, branch.to] {
                self.at[node].retain(|&other| other != number);
            }
        }
    }

    /// Makes one branch of the only two that meet at a node, without the kink that the spur left.
    fn join_at(&mut self, node: usize) {
        let [first, second] = match self.at[node][..] {
            [first, second] if first != second => [first, second],
            _ => return,
        };
        let (Some(a), Some(b)) = (self.branches[first].take(), self.branches[second].take()) else {
            return;
        };
        let (a, b) = (oriented(a, |a| a.to == node), oriented(b, |b| b.from == node));
        let (from, to) = (a.from, b.to);
        let points: Vec<_> = a.points.into_iter().chain(b.points.into_iter().skip(1)).collect();
        let radii = a.radii.into_iter().chain(b.radii.into_iter().skip(1)).collect();
        self.branches[first] =
            Some(Branch::new([from, to], smoothed(&points), radii, &self.graph.shape));
        self.at[node].clear();
        for number in &mut self.at[to] {
            if *number == second {
                *number = first;
            }
        }
    }

    /// What is left, without the nodes that are no more.
    fn graph(self) -> Graph<D> {
        let mut places = vec![None; self.at.len()];
        let mut nodes: Vec<Node<D>> = Vec::new();
        for (node, at) in self.at.iter().enumerate() {
            if !at.is_empty() || self.graph.nodes[node].degree == 0 {
                places[node] = Some(nodes.len());
                nodes.push(Node { degree: at.len(), ..self.graph.nodes[node].clone() });
            }
        }
        let place = |node: usize| places[node].unwrap_or_default();
        let branches = self.branches.into_iter().flatten();
        let branches = branches
            .map(|branch| Branch { from: place(branch.from), to: place(branch.to), ..branch })
            .collect();
        Graph { shape: self.graph.shape, nodes, branches }
    }
}

/// The branch, turned round unless it is `right`.
fn oriented<const D: usize>(
    mut branch: Branch<D>,
    right: impl Fn(&Branch<D>) -> bool,
) -> Branch<D> {
    if !right(&branch) {
        branch.points.reverse();
        branch.radii.reverse();
        std::mem::swap(&mut branch.from, &mut branch.to);
    }
    branch
}
