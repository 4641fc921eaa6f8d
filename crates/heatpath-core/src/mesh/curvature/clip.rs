//! Lengths and areas inside the unit ball, with the weight `1 - distance^2` from its centre: a ball whose
//! border is sharp finds other curvatures the moment it touches the next ring of vertices.

use crate::mesh::vector::{Vector, add, cross, dot, subtract};

use super::frame::{Frame, unit};

/// The part of the segment from `a` to `a + d` that is inside: from which fraction of it to which;
/// none if it is outside.
fn inside<const D: usize>(a: [f64; D], d: [f64; D], radius_sq: f64) -> Option<[f64; 2]> {
    let dot = |a: [f64; D], b: [f64; D]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let (square, slope) = (dot(d, d), dot(a, d));
    let discriminant = slope * slope - square * (dot(a, a) - radius_sq);
    if square > 0.0 && discriminant > 0.0 {
        let root = discriminant.sqrt();
        let [from, to] = [((-slope - root) / square).max(0.0), ((root - slope) / square).min(1.0)];
        (from < to).then_some([from, to])
    } else {
        None
    }
}

/// The weighted length of the segment from `a` to `b` inside the unit ball.
pub(super) fn length_inside(a: Vector, b: Vector) -> f64 {
    let d = subtract(b, a);
    let (at, slope, square) = (1.0 - dot(a, a), dot(a, d), dot(d, d));
    let integral = |t: f64| t * (at - t * (slope + t * square / 3.0));
    let parts = inside(a, d, 1.0);
    parts.map_or(0.0, |[from, to]| (integral(to) - integral(from)).max(0.0) * square.sqrt())
}

/// The weighted area of a triangle inside the unit ball.
pub(super) fn area_inside(corners: [Vector; 3]) -> f64 {
    let [a, b, c] = corners;
    let normal = cross(subtract(b, a), subtract(c, a));
    if corners.iter().all(|&corner| dot(corner, corner) <= 1.0) {
        // A third of the area for the middle of each side is exact for quadratic functions.
        let middles = [add(a, b), add(b, c), add(c, a)];
        let sum: f64 = middles.iter().map(|&sum| 1.0 - 0.25 * dot(sum, sum)).sum();
        return dot(normal, normal).sqrt() * sum / 6.0;
    }
    let normal = unit(normal);
    let Some(frame) = normal.and_then(Frame::new) else { return 0.0 };
    let height = dot(frame.normal, a);
    let radius_sq = 1.0 - height * height;
    if radius_sq <= 0.0 {
        return 0.0;
    }
    let flat = corners.map(|corner| frame.coordinates(corner));
    (0..3).map(|i| wedge(flat[i], flat[(i + 1) % 3], radius_sq)).sum::<f64>().abs()
}

/// The signed weighted area of the triangle of the origin, `a` and `b` inside the disc: of what is nearer than
/// the segment where that is inside, and of sectors of the disc elsewhere.
fn wedge(a: [f64; 2], b: [f64; 2], radius_sq: f64) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let dot = |p: [f64; 2], q: [f64; 2]| p[0] * q[0] + p[1] * q[1];
    let angle = |p: [f64; 2], q: [f64; 2]| cross(p, q).atan2(dot(p, q));
    let sector = |p, q| 0.25 * radius_sq * radius_sq * angle(p, q);
    let mean = |p, q| radius_sq - (dot(p, p) + dot(q, q) + dot(p, q)) / 6.0;
    match inside(a, d, radius_sq) {
        None => sector(a, b),
        Some(parts) => {
            let [p, q] = parts.map(|t| [a[0] + t * d[0], a[1] + t * d[1]]);
            let ends = [(a, p, parts[0] > 0.0), (q, b, parts[1] < 1.0)];
            let sectors = ends.iter().filter(|end| end.2).map(|&(p, q, _)| sector(p, q));
            0.5 * cross(p, q) * mean(p, q) + sectors.sum::<f64>()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn segments_and_triangles_at_the_unit_ball() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} instead of {b}");
        close(length_inside([0.0; 3], [0.0, 3.0, 0.0]), 2.0 / 3.0);
        close(length_inside([-3.0, 0.0, 0.0], [0.5, 0.0, 0.0]), 2.0 / 3.0 + 0.5 - 0.125 / 3.0);
        close(length_inside([-3.0, 1.5, 0.0], [3.0, 1.5, 0.0]), 0.0);
        // A whole disc of radius 0.8: the weight's mean over it is half of 0.64.
        let large = [[-9.0, -9.0, 0.6], [9.0, -9.0, 0.6], [0.0, 9.0, 0.6]];
        close(area_inside(large), 0.32 * 0.64 * PI);
        let corner = [[0.0; 3], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
        close(area_inside(corner), PI / 8.0);
        // All of it: the integrals of x^2 and y^2 over a triangle with the legs 1 / 2 are 1 / 192.
        let small = [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0]];
        close(area_inside(small), 1.0 / 8.0 - 1.0 / 96.0);
        let beside = [[2.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 1.0, 0.0]];
        close(area_inside(beside), 0.0);
        // Half of the disc, cut through the centre by a long side.
        let half = [[0.0, -20.0, 0.0], [20.0, 0.0, 0.0], [0.0, 20.0, 0.0]];
        close(area_inside(half), PI / 4.0);
    }
}
