//! What was found in a file, and what its mesh is like.

use crate::mesh::vector::{cross, distance, length, subtract};
use crate::mesh::{Adjacency, TriMesh};
use std::fmt;

/// A face is flat if its height is below this part of its longest side: rounding.
const FLAT: f64 = 1e-12;

/// What [`clean`](super::clean) did, and what the mesh is like.
///
/// As text, it is one line for each thing found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct CleanReport {
    /// Polygons of more than three corners that were cut into triangles.
    pub polygons: usize,
    /// Dropped faces: they had fewer than three different vertices.
    pub repeated: usize,
    /// Dropped faces: another one has the same three vertices.
    pub duplicates: usize,
    /// Faces without area.
    pub flat: usize,
    /// Points that were joined with an earlier one.
    pub welded: usize,
    /// Vertices at the very position of an earlier one that were not welded: the mesh may be torn
    /// there.
    pub shared_positions: usize,
    /// Vertices that no face uses.
    pub unreferenced: usize,
    /// Edges with more than two faces.
    pub non_manifold_edges: usize,
    /// Edges with one face.
    pub border_edges: usize,
    /// The closed curves that the border edges form; none if they meet in other ways.
    pub border_loops: Option<usize>,
    /// Edges whose two faces run along them in the same direction.
    pub inconsistent_edges: usize,
    /// Components, those of single vertices left out.
    pub components: usize,
    /// Vertices (those without faces left out) - edges + faces.
    pub euler_characteristic: i64,
}

impl CleanReport {
    /// Fills in what can be seen from the mesh.
    pub(super) fn describe(&mut self, mesh: &TriMesh) {
        let adjacency = mesh.adjacency();
        let is_used = |vertex: &usize| !adjacency.vertex_faces().of(*vertex).is_empty();
        let edges = || (0..adjacency.edges().len()).map(|edge| adjacency.edge_faces().of(edge));
        let components = adjacency.components();
        self.flat = (0..mesh.faces().len()).filter(|&face| is_flat(mesh, face)).count();
        let used = (0..mesh.points().len()).filter(is_used).count();
        self.unreferenced = mesh.points().len() - used;
        self.non_manifold_edges = edges().filter(|faces| faces.len() > 2).count();
        self.border_edges = edges().filter(|faces| faces.len() == 1).count();
        self.border_loops = border_loops(adjacency);
        self.inconsistent_edges = inconsistent_edges(mesh);
        self.components = (0..components.len())
            .filter(|vertex| components[*vertex] as usize == *vertex && is_used(vertex))
            .count();
        self.euler_characteristic =
            used as i64 - adjacency.edges().len() as i64 + mesh.faces().len() as i64;
    }
}

fn is_flat(mesh: &TriMesh, face: usize) -> bool {
    let [a, b, c] = mesh.corners(face);
    let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
    if longest == 0.0 {
        return true;
    }
    let unit = |a, b| subtract(b, a).map(|x| x / longest);
    length(cross(unit(a, b), unit(a, c))) <= FLAT
}

/// The number of closed curves of border edges, if each border vertex has two of them.
fn border_loops(adjacency: &Adjacency) -> Option<usize> {
    let is_border = |edge: u32| adjacency.edge_faces().of(edge as usize).len() == 1;
    let vertices = adjacency.vertex_edges();
    let border =
        |vertex: u32| vertices.of(vertex as usize).iter().copied().filter(|&edge| is_border(edge));
    let count = |vertex: u32| border(vertex).count();
    if !(0..vertices.len() as u32).all(|vertex| matches!(count(vertex), 0 | 2)) {
        return None;
    }
    let (mut seen, mut loops) = (vec![false; vertices.len()], 0);
    for start in 0..vertices.len() as u32 {
        if seen[start as usize] || count(start) == 0 {
            continue;
        }
        loops += 1;
        let mut next = Some(start);
        while let Some(vertex) = next {
            seen[vertex as usize] = true;
            let ends = border(vertex).map(|edge| adjacency.other_end(edge, vertex));
            next = ends.into_iter().find(|&end| !seen[end as usize]);
        }
    }
    Some(loops)
}

/// The edges with two faces that both run from the same end to the other.
fn inconsistent_edges(mesh: &TriMesh) -> usize {
    let adjacency = mesh.adjacency();
    let runs_up = |face: u32, low: u32| {
        let corners = mesh.faces()[face as usize];
        corners.iter().position(|&corner| corner == low).map(|i| corners[(i + 1) % 3])
    };
    let is_inconsistent = |&(edge, &[low, high]): &(usize, &[u32; 2])| {
        let faces = adjacency.edge_faces().of(edge);
        let up = |&&face: &&u32| runs_up(face, low) == Some(high);
        faces.len() == 2 && faces.iter().filter(up).count() != 1
    };
    adjacency.edges().iter().enumerate().filter(is_inconsistent).count()
}

impl fmt::Display for CleanReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let facts = [
            (self.polygons, "polygons cut into triangles"),
            (self.repeated, "faces dropped for fewer than three different vertices"),
            (self.duplicates, "faces dropped for having the vertices of another one"),
            (self.flat, "faces without area"),
            (self.welded, "vertices joined with one at their position"),
            (self.shared_positions, "vertices at the position of another one, not joined"),
            (self.unreferenced, "vertices without faces"),
            (self.non_manifold_edges, "edges with more than two faces"),
            (self.border_edges, "edges at a border"),
            (self.border_loops.unwrap_or(0), "borders, each a closed curve"),
            (self.inconsistent_edges, "edges between faces of opposite orientation"),
            (self.components, "components"),
        ];
        for (count, fact) in facts.into_iter().filter(|&(count, _)| count > 0) {
            writeln!(formatter, "{fact}: {count}")?;
        }
        write!(formatter, "Euler characteristic: {}", self.euler_characteristic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{icosphere, sheet, torus};

    fn report(mesh: &TriMesh) -> CleanReport {
        let mut report = CleanReport::default();
        report.describe(mesh);
        report
    }

    #[test]
    fn closed_surfaces_have_no_border() {
        let [sphere, torus] = [icosphere(1), torus(2.0, 1.0, 8, 6)].map(|mesh| report(&mesh));
        assert_eq!((sphere.euler_characteristic, torus.euler_characteristic), (2, 0));
        assert_eq!((sphere.border_edges, sphere.border_loops), (0, Some(0)));
        assert_eq!(sphere.to_string(), "components: 1\nEuler characteristic: 2");
    }

    #[test]
    fn a_sheet_has_one_border() {
        let report = report(&sheet(3, 2, |x, y| [x as f64, y as f64, 0.0]));
        assert_eq!((report.border_edges, report.border_loops), (10, Some(1)));
        assert_eq!((report.inconsistent_edges, report.euler_characteristic), (0, 1));
    }

    #[test]
    fn oddities_are_counted() {
        let points: Vec<[f64; 3]> = [[0, 0], [1, 0], [0, 1], [2, 0], [0, -1], [9, 9]]
            .map(|[x, y]| [f64::from(x), f64::from(y), 0.0])
            .into();
        // Three faces at edge 0-1, one of them flat and one upside down; vertex 5 is alone.
        let mesh = TriMesh::new(points, vec![[0, 1, 2], [0, 1, 3], [0, 1, 4], [1, 3, 2]]).unwrap();
        let report = report(&mesh);
        assert_eq!((report.flat, report.unreferenced, report.non_manifold_edges), (1, 1, 1));
        assert_eq!((report.inconsistent_edges, report.border_loops), (1, None));
        assert_eq!((report.components, report.euler_characteristic), (1, 5 - 8 + 4));
    }
}
