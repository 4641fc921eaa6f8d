//! Polygons into triangles.

use crate::mesh::vector::{Vector, add, cross, distance, dot, subtract};

/// Cuts a polygon into triangles by clipping ears (Meisters, Polygons Have Ears, 1975), the one with
/// the shortest cut first; polygons that cross themselves are cut somehow. None if there are fewer
/// than three corners.
pub(super) fn triangulate(points: &[Vector], mut ring: Vec<u32>, triangles: &mut Vec<[u32; 3]>) {
    if ring.len() > 3 {
        let normal = normal(points, &ring);
        let mut ears: Vec<Ear> =
            (0..ring.len()).map(|at| Ear::new(points, &ring, at, normal)).collect();
        while ring.len() > 3 {
            let at = (0..ears.len()).min_by(|&a, &b| ears[a].order(&ears[b])).unwrap_or(0);
            triangles.push(around(&ring, at));
            ring.remove(at);
            ears.remove(at);
            // Only the neighbours of a clipped ear change.
            for at in [(at + ring.len() - 1) % ring.len(), at % ring.len()] {
                ears[at] = Ear::new(points, &ring, at, normal);
            }
        }
    }
    if let [a, b, c] = ring[..] {
        triangles.push([a, b, c]);
    }
}

/// The corner `at` of the ring with its neighbours.
fn around(ring: &[u32], at: usize) -> [u32; 3] {
    let n = ring.len();
    [ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]]
}

/// Twice the area of the polygon as a vector, also of one that is not quite flat (Newell's method).
fn normal(points: &[Vector], ring: &[u32]) -> Vector {
    let origin = points[ring[0] as usize];
    let from_origin = |vertex: u32| subtract(points[vertex as usize], origin);
    let parts = ring.windows(2).map(|pair| cross(from_origin(pair[0]), from_origin(pair[1])));
    parts.fold([0.0; 3], add)
}

/// What a corner would be as the tip of a triangle that is cut off.
struct Ear {
    /// Whether the triangle lies inside the polygon and holds no other corner.
    is_free: bool,
    /// The length of the cut.
    cut: f64,
}

impl Ear {
    fn new(points: &[Vector], ring: &[u32], at: usize, normal: Vector) -> Self {
        let corners = around(ring, at).map(|vertex| points[vertex as usize]);
        let [a, b, c] = corners;
        let left = |a, b, p| dot(cross(subtract(b, a), subtract(p, a)), normal);
        let holds = |p: Vector| {
            left(a, b, p) >= 0.0
                && left(b, c, p) >= 0.0
                && left(c, a, p) >= 0.0
                && !corners.contains(&p)
        };
        let is_free =
            left(a, b, c) > 0.0 && !ring.iter().any(|&vertex| holds(points[vertex as usize]));
        Self { is_free, cut: distance(a, c) }
    }

    /// Free ones first, then those with short cuts.
    fn order(&self, other: &Self) -> std::cmp::Ordering {
        other.is_free.cmp(&self.is_free).then(self.cut.total_cmp(&other.cut))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::vector::length;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn cut(points: &[Vector]) -> Vec<[u32; 3]> {
        let mut triangles = Vec::new();
        triangulate(points, (0..points.len() as u32).collect(), &mut triangles);
        triangles
    }

    fn areas(points: &[Vector], triangles: &[[u32; 3]]) -> Vec<f64> {
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| points[vertex as usize]);
            0.5 * cross(subtract(b, a), subtract(c, a))[2]
        };
        triangles.iter().map(area).collect()
    }

    #[test]
    fn an_arrowhead_is_cut_at_its_notch_wherever_it_starts() {
        let arrow = [[0.0, 0.0, 0.0], [4.0, -2.0, 0.0], [1.0, 0.0, 0.0], [4.0, 2.0, 0.0]];
        for start in 0..4 {
            let mut points = arrow;
            points.rotate_left(start);
            let triangles = cut(&points);
            assert!(areas(&points, &triangles).iter().all(|&area| area == 1.0), "{triangles:?}");
        }
    }

    #[test]
    fn a_corner_on_a_straight_side_leaves_no_flat_triangle() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 5.0, 0.0]];
        assert_eq!(areas(&points, &cut(&points)), [2.5, 2.5]);
    }

    #[test]
    fn polygons_without_area_still_give_triangles() {
        let points = [0.0, 1.0, 2.0, 3.0].map(|x| [x, 0.0, 0.0]);
        assert_eq!(cut(&points).len(), 2);
        assert_eq!(cut(&points[..2]).len(), 0);
    }

    proptest! {
        /// A polygon that a point sees whole: any radius at increasing angles.
        #[test]
        fn star_shaped_polygons_keep_their_area(
            radii in prop::collection::vec(0.1..1.0, 4..40),
            tilt in 0.0..3.0_f64,
        ) {
            let (up, along) = tilt.sin_cos();
            let place = |(i, radius): (usize, &f64)| {
                let (y, x) = (TAU * i as f64 / radii.len() as f64).sin_cos();
                [radius * x, radius * y * along, radius * y * up]
            };
            let points: Vec<Vector> = radii.iter().enumerate().map(place).collect();
            let triangles = cut(&points);
            prop_assert_eq!(triangles.len(), points.len() - 2);
            let whole = normal(&points, &(0..points.len() as u32).collect::<Vec<_>>());
            let parts = triangles.iter().map(|triangle| {
                let [a, b, c] = triangle.map(|vertex| points[vertex as usize]);
                cross(subtract(b, a), subtract(c, a))
            });
            for part in parts.clone() {
                prop_assert!(dot(part, whole) > -1e-12);
            }
            let sum: f64 = parts.map(length).sum();
            prop_assert!((sum - length(whole)).abs() < 1e-12, "{} of {}", sum, length(whole));
        }
    }
}
