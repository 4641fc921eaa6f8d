//! From where a mesh is seen.

use heatpath_core::mesh::TriMesh;

/// A point or vector in space.
pub(super) type Vector = [f64; 3];

/// The part of the picture that stays empty on each side.
const MARGIN: f64 = 0.04;

/// Which axis points upwards in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// The second one, as in most models made for graphics.
    #[default]
    Y,
    /// The third one, as in most scans and constructed parts.
    Z,
}

/// From where a mesh is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// The one of a few views, from a little above or well above, that shows most of the surface.
    Automatic {
        /// The axis that points upwards.
        up: Up,
    },
    /// From a given direction.
    Angles {
        /// The axis that points upwards.
        up: Up,
        /// Degrees around that axis, counter-clockwise from above; at 0 the x axis points to the
        /// right.
        azimuth: f64,
        /// Degrees above the plane of the other two axes, from -90 to 90; beyond is cut off.
        elevation: f64,
    },
}

impl Default for View {
    fn default() -> Self {
        Self::Automatic { up: Up::Y }
    }
}

/// A parallel projection: three axes, and where the middle of the mesh comes to lie.
pub(super) struct Camera {
    right: Vector,
    above: Vector,
    /// Towards the eye.
    pub(super) toward: Vector,
    centre: Vector,
    middle: [f64; 2],
    /// Samples a unit of length.
    pub(super) scale: f64,
}

impl Camera {
    /// The whole mesh on a canvas of `size` samples.
    pub(super) fn new(mesh: &TriMesh, view: View, size: [usize; 2]) -> Self {
        let [right, above, toward] = match view {
            View::Angles { up, azimuth, elevation } => axes(up, azimuth, elevation),
            View::Automatic { up } => best_axes(mesh, up),
        };
        let [low, high] = mesh.bounds();
        let centre = std::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
        let mut camera = Self { right, above, toward, centre, middle: [0.0; 2], scale: 1.0 };
        // === The bounds on the canvas
        let corners =
            mesh.faces().iter().flatten().map(|&v| camera.place(mesh.points()[v as usize]));
        let bounds =
            corners.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
                [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
            });
        let extent = [0, 1].map(|axis| bounds[1][axis] - bounds[0][axis]);
        let room = size.map(|side| side as f64 * (1.0 - 2.0 * MARGIN));
        let scale = (room[0] / extent[0]).min(room[1] / extent[1]);
        camera.scale = if scale.is_finite() { scale } else { 1.0 };
        camera.middle = [0, 1].map(|axis| {
            0.5 * size[axis] as f64 - 0.5 * (bounds[0][axis] + bounds[1][axis]) * camera.scale
        });
        camera
    }

    /// Column, row and height towards the eye, all in samples.
    pub(super) fn place(&self, point: Vector) -> Vector {
        let from_centre = std::array::from_fn(|axis| point[axis] - self.centre[axis]);
        [
            self.middle[0] + self.scale * dot(self.right, from_centre),
            self.middle[1] - self.scale * dot(self.above, from_centre),
            self.scale * dot(self.toward, from_centre),
        ]
    }
}

/// To the right, upwards and towards the eye.
fn axes(up: Up, azimuth: f64, elevation: f64) -> [Vector; 3] {
    let (sin, cos) = azimuth.to_radians().sin_cos();
    let (rise, level) = elevation.clamp(-90.0, 90.0).to_radians().sin_cos();
    // With y upwards; z upwards is the same with x, z, -y in place of x, y, z.
    let axes =
        [[cos, 0.0, -sin], [-rise * sin, level, -rise * cos], [level * sin, rise, level * cos]];
    match up {
        Up::Y => axes,
        Up::Z => axes.map(|[x, y, z]| [x, -z, y]),
    }
}

/// Among six sides, each from a little above and from well above, the axes that show most of the
/// surface; looking down must show a quarter more.
fn best_axes(mesh: &TriMesh, up: Up) -> [Vector; 3] {
    let areas: Vec<Vector> =
        (0..mesh.faces().len()).map(|face| normal(mesh.corners(face))).collect();
    let shown =
        |axes: &[Vector; 3]| areas.iter().map(|&area| dot(area, axes[2]).abs()).sum::<f64>();
    let mut best = (f64::NEG_INFINITY, axes(up, 30.0, 20.0));
    for (elevation, weight) in [(20.0, 1.0), (60.0, 0.8)] {
        for azimuth in [30.0, -30.0, 90.0, -90.0, 150.0, -150.0] {
            let axes = axes(up, azimuth, elevation);
            let area = weight * shown(&axes);
            // The views from opposite sides differ by rounding.
            if area > best.0 * (1.0 + 1e-9) {
                best = (area, axes);
            }
        }
    }
    best.1
}

/// Twice the area of a triangle, at right angles to it.
pub(super) fn normal([a, b, c]: [Vector; 3]) -> Vector {
    let [u, v]: [Vector; 2] = [b, c].map(|p| std::array::from_fn(|axis| p[axis] - a[axis]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector with length 1; zero stays zero.
pub(super) fn unit(a: Vector) -> Vector {
    let largest = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if largest == 0.0 {
        return a;
    }
    let a = a.map(|x| x / largest);
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use heatpath_core::mesh::shapes::sheet;

    fn assert_near(a: Vector, b: Vector) {
        assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-12), "{a:?} {b:?}");
    }

    #[test]
    fn axes_are_where_they_should_be() {
        let [right, above, toward] = axes(Up::Y, 0.0, 0.0);
        assert_near(right, [1.0, 0.0, 0.0]);
        assert_near(above, [0.0, 1.0, 0.0]);
        assert_near(toward, [0.0, 0.0, 1.0]);
        let [right, above, toward] = axes(Up::Z, 0.0, 90.0);
        assert_near(right, [1.0, 0.0, 0.0]);
        assert_near(above, [0.0, 1.0, 0.0]);
        assert_near(toward, [0.0, 0.0, 1.0]);
        let [right, above, toward] = axes(Up::Z, 70.0, 35.0);
        let [a, b] = [right, above];
        assert_near(toward, normal([[0.0; 3], a, b]));
        assert!(above[2] > 0.0 && toward[0] > 0.0);
    }

    #[test]
    fn the_mesh_fills_the_canvas() {
        let sheet = sheet(4, 2, |x, y| [1e6 + x as f64, y as f64, 5.0]);
        let view = View::Angles { up: Up::Y, azimuth: 0.0, elevation: 0.0 };
        let camera = Camera::new(&sheet, view, [200, 200]);
        assert_near(camera.place([1e6, 0.0, 5.0]), [8.0, 146.0, 0.0]);
        assert_near(camera.place([1e6 + 4.0, 2.0, 5.0]), [192.0, 54.0, 0.0]);
    }
}
