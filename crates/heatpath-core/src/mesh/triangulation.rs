//! Another triangulation of the same surface, with better triangles.

use super::adjacency::numbered;
use super::triangle::{area, cotangents, third_corner};
use super::{Lists, Medium};
use std::collections::BTreeMap;

/// Triangles on a surface whose sides are straight on it, not in space.
///
/// It starts as the mesh itself. [`delaunay`](Self::delaunay) makes the cotangent weights of all edges
/// positive or zero; the surface does not change, only how it is cut.
#[derive(Clone, Debug)]
pub struct Triangulation {
    points: Vec<[f64; 3]>,
    faces: Vec<[u32; 3]>,
    face_edges: Vec<[u32; 3]>,
    lengths: Vec<f64>,
    slowness: Vec<f64>,
    /// The sides that each edge is, the second one [`NONE`] at a border; both at seams. A side is
    /// three times the face plus the corner opposite.
    sides: Vec<[u32; 2]>,
    /// The sides of seams: edges with more than two faces, and those where a one-sided surface (such
    /// as Möbius' strip) turns over.
    seams: BTreeMap<u32, Vec<u32>>,
}

/// In place of a side that an edge does not have.
const NONE: u32 = u32::MAX;

/// How many vertices may be added for each edge; meshes of good triangles need none.
const MOST_ADDED: usize = 2;

/// How many flips there may be for each edge: a few on usual meshes, as many as triangles are oblique on
/// others; among triangles that are flat but for rounding they would not end.
const MOST_FLIPS: usize = 200;

/// Angles that exceed π by no more than rounding are left alone.
const ROUNDING: f64 = 1e-9;

/// Edges are split no nearer to their ends than this part of them.
const LEAST_PART: f64 = 1e-4;

/// Whether these sides make a triangle with an area, beyond rounding.
fn is_sound(sides: [f64; 3]) -> bool {
    let longest = sides.into_iter().fold(0.0, f64::max);
    sides.iter().sum::<f64>() - 2.0 * longest > 1e-10 * longest
}

impl Triangulation {
    /// The triangles of the mesh as they are, all of a component turned alike as far as possible.
    fn new(medium: &Medium) -> Self {
        let adjacency = medium.mesh().adjacency();
        let mut triangulation = Self {
            points: medium.mesh().points().to_vec(),
            faces: medium.mesh().faces().to_vec(),
            face_edges: adjacency.face_edges().to_vec(),
            lengths: medium.lengths().to_vec(),
            slowness: medium.slowness().to_vec(),
            sides: vec![[NONE; 2]; adjacency.edges().len()],
            seams: BTreeMap::new(),
        };
        triangulation.turn_alike(medium);
        for edge in 0..triangulation.sides.len() as u32 {
            let faces = adjacency.edge_faces().of(edge as usize).iter();
            let sides: Vec<u32> = faces.map(|&face| triangulation.side(face, edge)).collect();
            match sides[..] {
                [side] => triangulation.sides[edge as usize] = [side, NONE],
                [a, b] if triangulation.are_opposed([a, b]) => {
                    triangulation.sides[edge as usize] = [a, b];
                }
                _ => drop(triangulation.seams.insert(edge, sides)),
            }
        }
        triangulation
    }

    /// The intrinsic Delaunay triangulation of the surface, with a few vertices more where borders need
    /// them.
    ///
    /// Edges are flipped until the two angles opposite to each add up to at most π (Bobenko and
    /// Springborn 2007). Edges at borders and seams cannot be flipped: where the angle opposite to
    /// one is obtuse, it gets a vertex at the foot of the altitude, or, if the next side is such an
    /// edge too, as far from their common end as the other one (Ruppert 1995 has the reason: feet
    /// alone would go on for ever). No more than two vertices are added for each edge.
    ///
    /// An edge between faces of different slowness is flipped only if `mixes` is set: both then take
    /// the mean.
    #[must_use]
    pub fn delaunay(medium: &Medium, mixes: bool) -> Self {
        let mut triangulation = Self::new(medium);
        let most = triangulation.points.len() + MOST_ADDED * triangulation.lengths.len();
        let mut flips = MOST_FLIPS * triangulation.lengths.len();
        let mut waiting = Waiting::default();
        (0..triangulation.lengths.len() as u32).rev().for_each(|edge| waiting.push(edge));
        while let Some(edge) = waiting.pop() {
            let sides = triangulation.sides_of(edge);
            if triangulation.sum_of_cotangents(&sides) >= -ROUNDING {
                continue;
            }
            if triangulation.is_flippable(edge) {
                let is_allowed = mixes || triangulation.is_even(&sides);
                if flips == 0 || !is_allowed || !triangulation.flips_well(edge) {
                    continue;
                }
                flips -= 1;
                triangulation.flip(edge).into_iter().for_each(|edge| waiting.push(edge));
            } else if triangulation.points.len() < most && triangulation.splits_well(edge, &sides) {
                triangulation.split(edge, &sides).into_iter().for_each(|edge| waiting.push(edge));
            }
        }
        triangulation
    }

    /// Where the vertices lie in space: those of the mesh, then those that were added.
    #[must_use]
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The vertices of each face; a face may meet itself in a vertex.
    #[must_use]
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The edges of each face: the first one is opposite its first corner, and so on.
    #[must_use]
    pub fn face_edges(&self) -> &[[u32; 3]] {
        &self.face_edges
    }

    /// The length of each edge.
    #[must_use]
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// The slowness of each face. When an edge is flipped both faces take the mean of theirs, by area.
    #[must_use]
    pub fn slowness(&self) -> &[f64] {
        &self.slowness
    }

    /// The sides of a face: side i is opposite corner i.
    #[inline]
    #[must_use]
    pub fn sides(&self, face: usize) -> [f64; 3] {
        self.face_edges[face].map(|edge| self.lengths[edge as usize])
    }

    /// Whether two sides of an edge go along it in opposite directions.
    fn are_opposed(&self, sides: [u32; 2]) -> bool {
        let [one, two] =
            sides.map(|side| self.faces[side as usize / 3][(side as usize % 3 + 1) % 3]);
        one != two
    }

    /// The faces at each vertex.
    #[must_use]
    pub(crate) fn vertex_faces(&self) -> Lists {
        Lists::new(self.points.len(), || numbered(&self.faces))
    }

    /// Whether each vertex lies on a border.
    pub(crate) fn border_vertices(&self) -> Vec<bool> {
        let mut border = vec![false; self.points.len()];
        for &[side, other] in self.sides.iter().filter(|sides| sides[0] != NONE) {
            if other == NONE {
                let ends = [1, 2].map(|after| self.corner(side, after));
                ends.iter().for_each(|&end| border[end as usize] = true);
            }
        }
        border
    }

    /// The component of each vertex, named by its smallest vertex.
    pub(crate) fn components(&self) -> Vec<usize> {
        let mut parents: Vec<usize> = (0..self.points.len()).collect();
        let root = |parents: &mut Vec<usize>, mut vertex: usize| {
            while parents[vertex] != vertex {
                parents[vertex] = parents[parents[vertex]];
                vertex = parents[vertex];
            }
            vertex
        };
        for &[a, b, c] in &self.faces {
            for other in [b, c] {
                let roots = [a, other].map(|vertex| root(&mut parents, vertex as usize));
                parents[roots[0].max(roots[1])] = roots[0].min(roots[1]);
            }
        }
        (0..self.points.len()).map(|vertex| root(&mut parents, vertex)).collect()
    }

    /// Turns faces so that neighbours go along their edge in opposite directions, as far as possible.
    fn turn_alike(&mut self, medium: &Medium) {
        let edge_faces = medium.mesh().adjacency().edge_faces();
        let mut is_seen = vec![false; self.faces.len()];
        let mut stack = Vec::new();
        for seed in 0..self.faces.len() as u32 {
            if !std::mem::replace(&mut is_seen[seed as usize], true) {
                stack.push(seed);
            }
            while let Some(face) = stack.pop() {
                for edge in self.face_edges[face as usize] {
                    let &[a, b] = edge_faces.of(edge as usize) else { continue };
                    let other = if a == face { b } else { a };
                    if std::mem::replace(&mut is_seen[other as usize], true) {
                        continue;
                    }
                    if !self.are_opposed([face, other].map(|face| self.side(face, edge))) {
                        self.faces[other as usize].swap(1, 2);
                        self.face_edges[other as usize].swap(1, 2);
                    }
                    stack.push(other);
                }
            }
        }
    }

    /// The side of a face that is this edge.
    fn side(&self, face: u32, edge: u32) -> u32 {
        let corner = self.face_edges[face as usize].iter().position(|&other| other == edge);
        3 * face + corner.unwrap_or(0) as u32
    }

    /// All sides that an edge is.
    fn sides_of(&self, edge: u32) -> Vec<u32> {
        match self.seams.get(&edge) {
            Some(sides) => sides.clone(),
            None => self.sides[edge as usize].into_iter().filter(|&side| side != NONE).collect(),
        }
    }

    /// Whether the faces of these sides are equally slow.
    fn is_even(&self, sides: &[u32]) -> bool {
        let slowness = |side: &u32| self.slowness[*side as usize / 3];
        sides.iter().all(|side| slowness(side) == slowness(&sides[0]))
    }

    fn is_flippable(&self, edge: u32) -> bool {
        !self.sides[edge as usize].contains(&NONE)
    }

    /// Negative if the two angles opposite to an edge add up to more than π.
    fn sum_of_cotangents(&self, sides: &[u32]) -> f64 {
        sides.iter().map(|&side| self.cotangent(side)).sum()
    }

    /// The cotangent of the angle opposite to a side.
    fn cotangent(&self, side: u32) -> f64 {
        cotangents(self.sides(side as usize / 3))[side as usize % 3]
    }

    /// The distance of the corners opposite to an edge when its two faces lie in a plane.
    fn other_diagonal(&self, edge: u32) -> f64 {
        let [one, two] = self.sides[edge as usize];
        let apex = |side: u32, [first, second]: [usize; 2]| {
            let length = |after| self.lengths[self.edge(side, after) as usize];
            third_corner([length(first), length(second), length(0)])
        };
        let [[px, py], [qx, qy]] = [apex(one, [1, 2]), apex(two, [2, 1])];
        (px - qx).hypot(py + qy)
    }

    /// Whether the faces after a flip have areas, beyond rounding.
    fn flips_well(&self, edge: u32) -> bool {
        let [one, two] = self.sides[edge as usize];
        let diagonal = self.other_diagonal(edge);
        let length = |side: u32, after| self.lengths[self.edge(side, after) as usize];
        [[length(one, 2), length(two, 1)], [length(one, 1), length(two, 2)]]
            .into_iter()
            .all(|[a, b]| is_sound([a, b, diagonal]))
    }

    /// Whether the faces after a split have areas, beyond rounding.
    fn splits_well(&self, edge: u32, sides: &[u32]) -> bool {
        let (_, part) = self.place_to_split(edge, sides);
        (LEAST_PART..1.0 - LEAST_PART).contains(&part)
    }

    /// Replaces an edge by the other diagonal of its two faces; the four edges around it.
    fn flip(&mut self, edge: u32) -> [u32; 4] {
        let [one, two] = self.sides[edge as usize];
        // The first face is p a b, the second q b a; the edge goes from a to b.
        let [p, a, b] = [0, 1, 2].map(|after| self.corner(one, after));
        let q = self.corner(two, 0);
        let [bp, pa] = [1, 2].map(|after| self.edge(one, after));
        let [aq, qb] = [1, 2].map(|after| self.edge(two, after));
        let diagonal = self.other_diagonal(edge);
        // === The slowness of both
        let faces = [one, two].map(|side| side as usize / 3);
        let areas = faces.map(|face| area(self.sides(face)));
        let slowness = faces.map(|face| self.slowness[face]);
        let mean = (areas[0] * slowness[0] + areas[1] * slowness[1]) / (areas[0] + areas[1]);
        // === The new faces p a q and q b p
        let [first, second] = faces.map(|face| 3 * face as u32);
        self.move_sides([
            (bp, first + (one + 1) % 3, second),
            (pa, first + (one + 2) % 3, first + 2),
            (aq, second + (two + 1) % 3, first),
            (qb, second + (two + 2) % 3, second + 2),
        ]);
        self.sides[edge as usize] = [first + 1, second + 1];
        self.lengths[edge as usize] = diagonal;
        self.faces[faces[0]] = [p, a, q];
        self.face_edges[faces[0]] = [aq, edge, pa];
        self.faces[faces[1]] = [q, b, p];
        self.face_edges[faces[1]] = [bp, edge, qb];
        faces.iter().for_each(|&face| self.slowness[face] = mean);
        [bp, pa, aq, qb]
    }

    /// Puts a vertex on an edge that may not be flipped; the edges whose angles changed.
    fn split(&mut self, edge: u32, sides: &[u32]) -> Vec<u32> {
        let (start, part) = self.place_to_split(edge, sides);
        let ends = [1, 2].map(|k| self.corner(sides[0], k));
        let [from, to] = [ends[start], ends[1 - start]];
        let vertex = self.points.len() as u32;
        let [a, b] = [from, to].map(|end| self.points[end as usize]);
        self.points.push(std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis])));
        // === The edge keeps the part that begins in `from`
        let length = self.lengths[edge as usize];
        let rest = self.add_edge((1.0 - part) * length);
        let (mut first, mut second, mut changed) = (Vec::new(), Vec::new(), vec![edge, rest]);
        for &side in sides {
            let is_from = self.corner(side, 1) == from;
            let part = if is_from { part } else { 1.0 - part };
            let halves = if is_from { [edge, rest] } else { [rest, edge] };
            let around = [1, 2].map(|k| self.edge(side, k));
            let [one, two, inner] = self.cut(side, vertex, part * length, halves);
            let (a, b) = if is_from { (one, two) } else { (two, one) };
            first.push(a);
            second.push(b);
            changed.extend(around);
            changed.push(inner);
        }
        self.lengths[edge as usize] = part * length;
        for (edge, sides) in [(edge, first), (rest, second)] {
            match sides[..] {
                [side] => self.sides[edge as usize] = [side, NONE],
                _ => drop(self.seams.insert(edge, sides)),
            }
        }
        changed
    }

    /// Where to split an edge: from which of its ends (the corners after and before that opposite to
    /// the first side), and at which part of its length.
    fn place_to_split(&self, edge: u32, sides: &[u32]) -> (usize, f64) {
        let widest = |a: &&u32, b: &&u32| self.cotangent(**a).total_cmp(&self.cotangent(**b));
        let side = *sides.iter().min_by(widest).unwrap_or(&sides[0]);
        let length = |edge: u32| self.lengths[edge as usize];
        let [after, before] = [self.edge(side, 1), self.edge(side, 2)];
        let (end, part) = if !self.is_flippable(before) {
            (1, length(before) / length(edge))
        } else if !self.is_flippable(after) {
            (2, length(after) / length(edge))
        } else {
            let [foot, _] = third_corner([length(after), length(before), length(edge)]);
            (1, foot / length(edge))
        };
        let start = usize::from(self.corner(side, end) != self.corner(sides[0], 1));
        (start, part)
    }

    /// Cuts the face of a side in two by a line from the corner opposite to a new vertex on the side,
    /// `along` from where the side begins; the new sides of both halves, and the line.
    fn cut(&mut self, side: u32, vertex: u32, along: f64, halves: [u32; 2]) -> [u32; 3] {
        let [corner, from, to] = [0, 1, 2].map(|k| self.corner(side, k));
        let [edge, after, before] = [0, 1, 2].map(|k| self.edge(side, k));
        let length = |edge: u32| self.lengths[edge as usize];
        let [x, y] = third_corner([length(after), length(before), length(edge)]);
        let inner = self.add_edge((x - along).hypot(y));
        let (face, added) = (side as usize / 3, self.faces.len());
        let (first, second) = (3 * face as u32, 3 * added as u32);
        self.move_sides([
            (after, first + (side + 1) % 3, second + 1),
            (before, first + (side + 2) % 3, first + 2),
        ]);
        self.faces[face] = [corner, from, vertex];
        self.face_edges[face] = [halves[0], inner, before];
        self.faces.push([corner, vertex, to]);
        self.face_edges.push([halves[1], after, inner]);
        self.slowness.push(self.slowness[face]);
        self.sides[inner as usize] = [first + 1, second + 2];
        [first, second, inner]
    }

    fn add_edge(&mut self, length: f64) -> u32 {
        self.lengths.push(length);
        self.sides.push([NONE; 2]);
        self.lengths.len() as u32 - 1
    }

    /// The corner so many places after that opposite to a side.
    fn corner(&self, side: u32, after: usize) -> u32 {
        self.faces[side as usize / 3][(side as usize + after) % 3]
    }

    /// The edge so many places after a side.
    fn edge(&self, side: u32, after: usize) -> u32 {
        self.face_edges[side as usize / 3][(side as usize + after) % 3]
    }

    /// Sides of edges that are others now: edge, old side, new side.
    fn move_sides<const N: usize>(&mut self, moves: [(u32, u32, u32); N]) {
        let places =
            moves.map(|(edge, old, _)| self.list(edge).iter().position(|&side| side == old));
        for ((edge, _, new), place) in moves.into_iter().zip(places) {
            if let Some(place) = place {
                self.list(edge)[place] = new;
            }
        }
    }

    /// The sides of an edge, to be changed.
    fn list(&mut self, edge: u32) -> &mut [u32] {
        match self.seams.get_mut(&edge) {
            Some(sides) => sides,
            None => &mut self.sides[edge as usize],
        }
    }
}

/// Edges to be looked at, each once.
#[derive(Default)]
struct Waiting {
    stack: Vec<u32>,
    is_in: Vec<bool>,
}

impl Waiting {
    fn push(&mut self, edge: u32) {
        let place = edge as usize;
        self.is_in.resize(self.is_in.len().max(place + 1), false);
        if !std::mem::replace(&mut self.is_in[place], true) {
            self.stack.push(edge);
        }
    }

    fn pop(&mut self) -> Option<u32> {
        let edge = self.stack.pop()?;
        self.is_in[edge as usize] = false;
        Some(edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::sheet;
    use crate::mesh::vector::distance;
    use proptest::prelude::*;

    /// A sheet of 5 x 4 squares whose vertices are moved by up to 0.24, sheared and stretched.
    fn rough(moves: &[[f64; 2]], shear: f64, stretch: f64) -> Medium {
        let mesh = sheet(5, 4, |x, y| {
            let [dx, dy] = moves[6 * y + x];
            let (x, y) = (x as f64 + 0.24 * dx, y as f64 + 0.24 * dy);
            [stretch * (x + shear * y), y, 0.0]
        });
        Medium::uniform(mesh).unwrap()
    }

    fn total_area(triangulation: &Triangulation) -> f64 {
        (0..triangulation.faces().len()).map(|face| area(triangulation.sides(face))).sum()
    }

    proptest! {
        #[test]
        fn flips_end_at_delaunay_and_keep_the_surface(
            moves in prop::collection::vec(prop::array::uniform2(-1.0..1.0_f64), 30),
            shear in -5.0..5.0_f64,
            stretch in 0.05..1.0_f64,
        ) {
            let medium = rough(&moves, shear, stretch);
            let triangulation = Triangulation::delaunay(&medium, true);
            for edge in 0..triangulation.sides.len() as u32 {
                let sides = triangulation.sides_of(edge);
                prop_assert!(triangulation.sum_of_cotangents(&sides) >= -ROUNDING);
                prop_assert!(sides.iter().all(|&side| triangulation.edge(side, 0) == edge));
            }
            let before: f64 = (0..40).map(|face| medium.area(face)).sum();
            prop_assert!((total_area(&triangulation) / before - 1.0).abs() < 1e-6);
            // In the plane every side is as long as its ends are apart.
            if medium.mollified() == 0.0 {
                let points = triangulation.points();
                for (corners, edges) in triangulation.faces().iter().zip(triangulation.face_edges()) {
                    for i in 0..3 {
                        let [from, to] = [1, 2].map(|k| points[corners[(i + k) % 3] as usize]);
                        let length = triangulation.lengths()[edges[i] as usize];
                        prop_assert!((distance(from, to) - length).abs() < 1e-7);
                    }
                }
            }
        }
    }

    #[test]
    fn a_strip_that_turns_over_is_cut_nowhere() {
        // Five squares in a ring, glued upside down.
        let strip = sheet(5, 1, |x, y| {
            let (sin, cos) = (0.2 * std::f64::consts::PI * x as f64).sin_cos();
            let (radius, up) = (3.0 + (y as f64 - 0.5) * cos, (y as f64 - 0.5) * sin);
            let (y, x) = (0.4 * std::f64::consts::PI * x as f64).sin_cos();
            [radius * x, radius * y, up]
        });
        let glued = |vertex: u32| match vertex {
            5 => 6,
            11 => 0,
            other => other,
        };
        let faces = strip.faces().iter().map(|face| face.map(glued)).collect();
        let mesh = crate::mesh::TriMesh::new(strip.points().to_vec(), faces).unwrap();
        let medium = Medium::uniform(mesh).unwrap();
        let delaunay = Triangulation::delaunay(&medium, true);
        assert!(!delaunay.seams.is_empty(), "it turns over somewhere");
        let before = total_area(&Triangulation::new(&medium));
        assert!((total_area(&delaunay) / before - 1.0).abs() < 1e-12);
    }
}
