//! How the cells of a centreline hang together.

use crate::grid::{Grid, Shape};

/// Curves of cells between nodes: ends, junctions and cells that stand alone.
pub(crate) struct Network {
    /// The cell of each node.
    pub(crate) nodes: Vec<usize>,
    pub(crate) chains: Vec<Chain>,
}

/// The cells from one node to another, both included.
pub(crate) struct Chain {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) cells: Vec<usize>,
}

impl Network {
    /// The network of a centreline. Junctions that touch are one node, at the one of their cells that is
    /// the nearest to their centre; a closed curve without a node gets one.
    pub(crate) fn new<const D: usize>(thin: &Grid<bool, D>) -> Self {
        let mut tracing = Tracing::new(thin);
        tracing.place_nodes(thin.shape());
        for start in 0..tracing.cells.len() {
            tracing.leave(start);
        }
        for start in 0..tracing.cells.len() {
            if tracing.node[start].is_none() && !tracing.passed[start] {
                tracing.node[start] = Some(tracing.nodes.len());
                tracing.nodes.push(start);
                tracing.follow(start, tracing.links[start][0]);
            }
        }
        let cells = &tracing.cells;
        for chain in &mut tracing.chains {
            chain.cells.iter_mut().for_each(|place| *place = cells[*place]);
        }
        let nodes = tracing.nodes.iter().map(|&place| cells[place]).collect();
        Self { nodes, chains: tracing.chains }
    }
}

/// Cells are known by their place among the true ones.
struct Tracing {
    cells: Vec<usize>,
    /// The places that a cell is joined to.
    links: Vec<Vec<usize>>,
    /// The node that a cell belongs to.
    node: Vec<Option<usize>>,
    passed: Vec<bool>,
    nodes: Vec<usize>,
    chains: Vec<Chain>,
}

impl Tracing {
    fn new<const D: usize>(thin: &Grid<bool, D>) -> Self {
        let shape = thin.shape();
        let cells: Vec<usize> = (0..shape.cells()).filter(|&cell| thin.values()[cell]).collect();
        let place = |cell: usize| cells.partition_point(|&other| other < cell);
        let links = |&cell: &usize| {
            let around = shape.box_around(cell, 1);
            let linked = around.filter(|&next| next != cell && thin.values()[next]);
            linked.filter(|&next| is_direct(thin, cell, next)).map(place).collect()
        };
        Self {
            links: cells.iter().map(links).collect(),
            node: vec![None; cells.len()],
            passed: vec![false; cells.len()],
            nodes: Vec::new(),
            chains: Vec::new(),
            cells,
        }
    }

    fn place_nodes<const D: usize>(&mut self, shape: &Shape<D>) {
        for start in 0..self.cells.len() {
            if self.links[start].len() == 2 || self.node[start].is_some() {
                continue;
            }
            let number = self.nodes.len();
            self.node[start] = Some(number);
            let mut cluster = vec![start];
            let mut seen = 0;
            while let Some(&place) = cluster.get(seen) {
                seen += 1;
                for &next in self.links[place].iter().filter(|_| self.links[place].len() > 2) {
                    if self.links[next].len() > 2 && self.node[next].is_none() {
                        self.node[next] = Some(number);
                        cluster.push(next);
                    }
                }
            }
            self.nodes.push(self.middle(&cluster, shape));
        }
    }

    /// The one of `cluster` that is the nearest to its centre.
    fn middle<const D: usize>(&self, cluster: &[usize], shape: &Shape<D>) -> usize {
        let centre = |place: usize| shape.centre(self.cells[place]);
        let sum = |axis: usize| cluster.iter().map(|&place| centre(place)[axis]).sum::<f64>();
        let mean = std::array::from_fn(|axis| sum(axis) / cluster.len() as f64);
        let distance = |place: usize| shape.physical_distance(centre(place), mean);
        let nearer = |a: &usize, b: &usize| distance(*a).total_cmp(&distance(*b)).then(a.cmp(b));
        cluster.iter().copied().min_by(nearer).unwrap_or(cluster[0])
    }

    /// Follows the curves that leave a node's cell and have not been followed yet.
    fn leave(&mut self, start: usize) {
        let Some(node) = self.node[start] else {
            return;
        };
        for next in self.links[start].clone() {
            let is_new = match self.node[next] {
                Some(other) => other != node && start < next,
                None => !self.passed[next],
            };
            if is_new {
                self.follow(start, next);
            }
        }
    }

    /// Follows the curve from a node's cell over `next` to the next node.
    fn follow(&mut self, start: usize, next: usize) {
        let (mut last, mut here, mut cells) = (start, next, vec![start]);
        let to = loop {
            cells.push(here);
            if let Some(node) = self.node[here] {
                break node;
            }
            self.passed[here] = true;
            let links = &self.links[here];
            (last, here) = (here, if links[0] == last { links[1] } else { links[0] });
        };
        let from = self.node[start].unwrap_or(to);
        if cells[0] != self.nodes[from] {
            cells.insert(0, self.nodes[from]);
        }
        if here != self.nodes[to] {
            cells.push(self.nodes[to]);
        }
        self.chains.push(Chain { from, to, cells });
    }
}

/// Whether no true cell lies in the box that two neighbours span: steps over an edge or a corner are
/// left out where there is one beside them.
fn is_direct<const D: usize>(mask: &Grid<bool, D>, a: usize, b: usize) -> bool {
    let (from, to) = (mask.shape().index(a), mask.shape().index(b));
    (0..1_usize << D).all(|corner| {
        let index =
            std::array::from_fn(|axis| if corner >> axis & 1 == 0 { from[axis] } else { to[axis] });
        index == from || index == to || !mask[index]
    })
}
