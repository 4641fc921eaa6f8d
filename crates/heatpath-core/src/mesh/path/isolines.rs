//! Curves along which a function of the vertices has one value.

use super::{ValuesError, check_values};
use crate::lists::Lists;
use crate::mesh::spot::Spot;
use crate::mesh::{SurfacePoint, TriMesh};

/// A piece of an isoline.
#[derive(Clone, Debug, PartialEq)]
pub struct Isoline {
    /// The points in their order, on edges and at vertices; two neighbours share a face. Of a closed
    /// one the last point is joined to the first.
    pub points: Vec<SurfacePoint>,
    /// Whether it is closed.
    pub is_closed: bool,
}

/// The isolines of a function that is linear on each face, by its `values` at the vertices: for each
/// of the `levels` the curves where the function has that value.
///
/// Vertices exactly on a level are met once; an edge that is on it belongs to the curve, the inside of
/// a face that is does not. Where more than two pieces meet, at saddles and at edges of many faces,
/// each ends there. Faces with an infinite value are left out.
///
/// # Errors
/// There is not one value for each vertex, or one is neither finite nor positive infinity.
pub fn isolines(
    mesh: &TriMesh,
    values: &[f64],
    levels: &[f64],
) -> Result<Vec<Vec<Isoline>>, ValuesError> {
    check_values(mesh, values)?;
    Ok(levels.iter().map(|&level| Level { mesh, values, level }.isolines()).collect())
}

struct Level<'a> {
    mesh: &'a TriMesh,
    values: &'a [f64],
    level: f64,
}

/// A vertex on the level, or the number of the vertices and that of an edge across it.
type Node = u32;

impl Level<'_> {
    fn isolines(&self) -> Vec<Isoline> {
        let mut segments: Vec<[Node; 2]> =
            (0..self.mesh.faces().len()).filter_map(|face| self.segment(face)).collect();
        // Edges on the level are found from both sides.
        segments.sort_unstable();
        segments.dedup();
        let chains = chains(&segments).into_iter();
        chains.map(|(nodes, is_closed)| self.isoline(&nodes, is_closed)).collect()
    }

    fn isoline(&self, nodes: &[Node], is_closed: bool) -> Isoline {
        let point = |&node: &Node| self.spot(node).point(self.mesh);
        Isoline { points: nodes.iter().map(point).collect(), is_closed }
    }

    /// Where the level crosses a face, if it does in a line.
    fn segment(&self, face: usize) -> Option<[Node; 2]> {
        let (corners, edges) = (self.mesh.faces()[face], self.mesh.adjacency().face_edges()[face]);
        let above = corners.map(|corner| self.values[corner as usize] - self.level);
        if !above.iter().all(|value| value.is_finite()) {
            return None;
        }
        let (mut nodes, mut count) = ([0; 2], 0);
        for i in 0..3 {
            let ends = [above[(i + 1) % 3], above[(i + 2) % 3]];
            let is_across = ends[0].min(ends[1]) < 0.0 && ends[0].max(ends[1]) > 0.0;
            let vertex = (above[i] == 0.0).then_some(corners[i]);
            let edge = is_across.then_some(self.mesh.points().len() as u32 + edges[i]);
            for node in [vertex, edge].into_iter().flatten() {
                *nodes.get_mut(count)? = node;
                count += 1;
            }
        }
        nodes.sort_unstable();
        (count == 2).then_some(nodes)
    }

    fn spot(&self, node: Node) -> Spot {
        let Some(edge) = node.checked_sub(self.mesh.points().len() as u32) else {
            return Spot::Vertex(node);
        };
        let [a, b] = self.mesh.adjacency().edges()[edge as usize]
            .map(|end| self.values[end as usize] - self.level);
        Spot::Edge { edge, part: a / (a - b) }
    }
}

/// Segments strung together: the nodes of each chain, and whether it is closed. Chains end where not
/// two segments meet.
fn chains(segments: &[[Node; 2]]) -> Vec<(Vec<Node>, bool)> {
    // === Which segments are at each node
    let mut nodes: Vec<Node> = segments.iter().flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |node: Node| nodes.binary_search(&node).unwrap_or(0) as u32;
    let segments: Vec<[u32; 2]> = segments.iter().map(|ends| ends.map(number)).collect();
    let at = Lists::new(nodes.len(), || {
        let ends = |(segment, ends): (usize, &[u32; 2])| ends.map(|end| (end, segment as u32));
        segments.iter().enumerate().flat_map(ends)
    });
    // === Chains from all ends, and then what is left: rings
    let mut is_used = vec![false; segments.len()];
    let mut found = Vec::new();
    let ends = (0..nodes.len()).filter(|&node| at.of(node).len() != 2);
    for start in ends.chain(0..nodes.len()) {
        for &first in at.of(start) {
            let (mut chain, mut here, mut next) = (vec![start], start, Some(first));
            while let Some(segment) = next.filter(|&segment| !is_used[segment as usize]) {
                is_used[segment as usize] = true;
                let [a, b] = segments[segment as usize].map(|end| end as usize);
                here = if a == here { b } else { a };
                chain.push(here);
                let around = at.of(here);
                next = around.iter().copied().find(|&s| s != segment && around.len() == 2);
            }
            let is_closed = chain.len() > 2 && here == start;
            if is_closed {
                chain.pop();
            }
            if chain.len() > 1 {
                found.push((chain.iter().map(|&node| nodes[node]).collect(), is_closed));
            }
        }
    }
    found
}
