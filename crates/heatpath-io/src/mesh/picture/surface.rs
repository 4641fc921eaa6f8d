//! The faces of a mesh on the canvas.

use super::MeshPicture;
use super::canvas::{Canvas, SAMPLES};
use super::view::{Camera, Vector, dot, normal, unit};
use crate::colour::{NOT_FINITE, colour_of, finite_range_of};
use heatpath_core::mesh::TriMesh;

/// The colour of a mesh without values.
const PLAIN: [u8; 3] = [200, 204, 212];

/// The light on faces that are seen from the side, and what is added for those seen from the front:
/// less where colours tell values.
const PLAIN_LIGHT: [f64; 2] = [0.3, 0.7];
const COLOUR_LIGHT: [f64; 2] = [0.55, 0.45];

/// Corners share their light across edges that bend less: cos(30 degrees).
const SMOOTH: f64 = 0.866;

/// The colour of lines of equal value, and half their width in samples.
const LINE: [u8; 3] = [20, 20, 30];
const HALF_WIDTH: f64 = 0.35 * SAMPLES as f64;

/// A triangle on the canvas.
struct Triangle {
    corners: [Vector; 3],
    /// The cosine of the angle between each corner's normal and the direction to the eye.
    light: [f64; 3],
    /// The values of the corners, if they are to be shown.
    values: Option<[f64; 3]>,
}

/// How values become colours and lines.
struct Scale {
    low: f64,
    high: f64,
    /// Between lines; infinite if there are none.
    interval: f64,
}

pub(super) fn draw(
    canvas: &mut Canvas,
    mesh: &TriMesh,
    camera: &Camera,
    picture: &MeshPicture<'_>,
) {
    let (low, high) = picture.values.and_then(finite_range_of).unwrap_or((0.0, 0.0));
    let interval = if picture.isolines > 0 && high > low {
        (high - low) / picture.isolines as f64
    } else {
        f64::INFINITY
    };
    let scale = Scale { low, high, interval };
    let normals = picture.smooth.then(|| vertex_normals(mesh));
    for (face, vertices) in mesh.faces().iter().enumerate() {
        let flat = unit(normal(mesh.corners(face)));
        let light = vertices.map(|vertex| {
            let smooth = normals.as_ref().map(|normals| normals[vertex as usize]);
            dot(smooth.filter(|&smooth| dot(smooth, flat) > SMOOTH).unwrap_or(flat), camera.toward)
        });
        let values = picture.values.map(|values| vertices.map(|vertex| values[vertex as usize]));
        let corners = mesh.corners(face).map(|corner| camera.place(corner));
        Triangle { corners, light, values }.draw(canvas, &scale);
    }
}

/// The mean normal of the faces at each vertex, by their areas.
fn vertex_normals(mesh: &TriMesh) -> Vec<Vector> {
    let mut sums = vec![[0.0; 3]; mesh.points().len()];
    for (face, vertices) in mesh.faces().iter().enumerate() {
        let area = normal(mesh.corners(face));
        for &vertex in vertices {
            (0..3).for_each(|axis| sums[vertex as usize][axis] += area[axis]);
        }
    }
    sums.into_iter().map(unit).collect()
}

impl Triangle {
    fn draw(&self, canvas: &mut Canvas, scale: &Scale) {
        let [a, b, c] = self.corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let bounds = |axis: usize| {
            let sides = self.corners.map(|corner| corner[axis]);
            (sides[0].min(sides[1]).min(sides[2]), sides[0].max(sides[1]).max(sides[2]))
        };
        let ((left, right), (top, bottom)) = (bounds(0), bounds(1));
        let width = self.line_width(area, scale);
        for y in canvas.range(1, top, bottom) {
            for x in canvas.range(0, left, right) {
                let at = [x as f64 + 0.5, y as f64 + 0.5];
                let across = |p: Vector, q: Vector| {
                    ((q[0] - p[0]) * (at[1] - p[1]) - (at[0] - p[0]) * (q[1] - p[1])) / area
                };
                let weights = [across(b, c), across(c, a), across(a, b)];
                if weights.iter().all(|&weight| weight >= 0.0) {
                    let height = dot(weights, self.corners.map(|corner| corner[2]));
                    canvas.put(x, y, height, || self.colour(weights, scale, width));
                }
            }
        }
    }

    fn colour(&self, weights: Vector, scale: &Scale, width: f64) -> [u8; 3] {
        let light = dot(weights, self.light).abs().min(1.0);
        let lit = |colour: [u8; 3], [least, more]: [f64; 2]| {
            colour.map(|part| (f64::from(part) * (least + more * light)).round() as u8)
        };
        let Some(values) = self.values else { return lit(PLAIN, PLAIN_LIGHT) };
        let value = dot(weights, values);
        let Some(colour) = colour_of(value, scale.low, scale.high) else {
            return lit(NOT_FINITE, COLOUR_LIGHT);
        };
        let level = ((value - scale.low) / scale.interval).round();
        let is_line = level > 0.0 && (value - scale.low - level * scale.interval).abs() < width;
        if is_line { LINE } else { lit(colour, COLOUR_LIGHT) }
    }

    /// Half the width of lines as a difference of values: that along the gradient on the canvas.
    fn line_width(&self, area: f64, scale: &Scale) -> f64 {
        let Some([u, v, w]) = self.values.filter(|_| scale.interval.is_finite()) else {
            return 0.0;
        };
        let [a, b, c] = self.corners;
        let slope =
            |axis: usize| ((v - u) * (c[axis] - a[axis]) - (w - u) * (b[axis] - a[axis])) / area;
        // Where lines would run into one another they are left out.
        let width = HALF_WIDTH * slope(0).hypot(slope(1));
        if width < 0.25 * scale.interval { width } else { 0.0 }
    }
}
