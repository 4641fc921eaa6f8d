//! Where a grid lies in the world.

use serde::Serialize;

/// Axes may miss a right angle by this much (as a cosine, about 0.06 degrees): what single floats
/// and printed decimals do to a rotation.
const TOLERANCE: f64 = 1e-3;

/// A vector in the world.
pub(crate) type Vector = [f64; 3];

/// Where the first cell of a grid lies in the world, and where its axes point.
///
/// World coordinates are LPS as in DICOM and ITK: x grows to the patient's left, y to the back, z to
/// the head. Their unit is that of the spacing, in medical files millimetres. Pictures lie in the
/// same three-dimensional world, usually at z = 0.
///
/// ```
/// use heatpath_io::Placement;
///
/// let turned = Placement {
///     origin: [10.0, 20.0, 30.0],
///     direction: [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
/// };
/// let world = turned.to_world([4.0, 0.0, 1.0], [0.5, 0.5, 2.0]);
/// assert_eq!(world, [10.0, 22.0, 32.0]);
/// assert_eq!(turned.to_pixels(world, [0.5, 0.5, 2.0]), Some([4.0, 0.0, 1.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Placement {
    /// The centre of the first cell. Default: 0, 0, 0.
    pub origin: Vector,
    /// For each axis of the grid the unit vector along which its index grows: the columns of ITK's
    /// direction matrix. They are perpendicular. Of a picture the third one is the normal. Default:
    /// the axes of the world.
    pub direction: [Vector; 3],
}

impl Default for Placement {
    fn default() -> Self {
        Self { origin: [0.0; 3], direction: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] }
    }
}

impl Placement {
    /// The world coordinates of a point in pixel coordinates.
    #[must_use]
    pub fn to_world<const D: usize>(&self, point: [f64; D], spacing: [f64; D]) -> Vector {
        std::array::from_fn(|row| {
            let along = |axis: usize| self.direction[axis][row] * (point[axis] * spacing[axis]);
            (0..D).map(along).fold(self.origin[row], |sum, part| sum + part)
        })
    }

    /// The pixel coordinates of a point in the world; of a picture the z of its origin is added to
    /// x and y. None if that is a point outside of the picture's plane.
    #[must_use]
    pub fn to_pixels<const D: usize>(
        &self,
        world: [f64; D],
        spacing: [f64; D],
    ) -> Option<[f64; D]> {
        let from_origin: Vector =
            std::array::from_fn(|row| if row < D { world[row] - self.origin[row] } else { 0.0 });
        let [a, b, c] = self.direction;
        let volume = dot(a, cross(b, c));
        let along = [cross(b, c), cross(c, a), cross(a, b)].map(|n| dot(n, from_origin) / volume);
        let is_beside = along[D..].iter().any(|z| z.abs() > TOLERANCE * length(from_origin));
        (!is_beside).then(|| std::array::from_fn(|axis| along[axis] / spacing[axis]))
    }

    /// Whether a picture lies in the plane z = 0, so that two coordinates place it.
    pub(crate) fn is_flat(&self) -> bool {
        let [x, y, normal] = self.direction;
        [x[2], y[2], self.origin[2], normal[0], normal[1]] == [0.0; 5]
    }
}

/// From pixel coordinates to the world.
#[derive(Clone, Copy)]
pub(crate) struct World<const D: usize> {
    spacing: [f64; D],
    placement: Placement,
}

impl<const D: usize> World<D> {
    /// Without a placement the first cell is at 0.
    pub(crate) fn new(spacing: [f64; D], placement: Option<Placement>) -> Self {
        Self { spacing, placement: placement.unwrap_or_default() }
    }

    pub(crate) fn point(&self, point: [f64; D]) -> Vector {
        self.placement.to_world(point, self.spacing)
    }
}

/// What a file says about the place of its grid. Of a picture the third numbers are as if it were a
/// slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Geometry {
    pub(crate) spacing: Vector,
    pub(crate) placement: Placement,
}

impl Geometry {
    /// From one vector for each of two or three axes, from cell to cell.
    pub(crate) fn from_axes(axes: &[Vector], origin: Vector) -> Result<Self, String> {
        let mut spacing = [1.0; 3];
        let mut direction = [[0.0; 3]; 3];
        for (axis, vector) in axes.iter().enumerate() {
            spacing[axis] = length(*vector);
            direction[axis] = vector.map(|part| part / spacing[axis]);
        }
        if axes.len() == 2 {
            direction[2] = cross(direction[0], direction[1]);
        }
        Self::new(spacing, origin, direction)
    }

    /// Refuses what is not finite and axes that are not perpendicular.
    pub(crate) fn new(
        spacing: Vector,
        origin: Vector,
        direction: [Vector; 3],
    ) -> Result<Self, String> {
        if let Some(bad) = spacing.iter().find(|&&h| !(h.is_finite() && h > 0.0)) {
            return Err(format!("the spacing {bad} is not a positive length"));
        }
        if let Some(bad) = origin.iter().find(|x| !x.is_finite()) {
            return Err(format!("the origin has the coordinate {bad}"));
        }
        for (axis, &vector) in direction.iter().enumerate() {
            let miss = (length(vector) - 1.0).abs();
            if miss.is_nan() || miss > TOLERANCE {
                return Err(format!("the direction of axis {axis} is {vector:?}, no unit vector"));
            }
        }
        for (one, other) in [(0, 1), (0, 2), (1, 2)] {
            let cosine = dot(direction[one], direction[other]);
            if cosine.abs() > TOLERANCE {
                let angle = cosine.clamp(-1.0, 1.0).acos().to_degrees();
                return Err(format!(
                    "axes {one} and {other} meet at {angle:.2} degrees; only right angles are \
                     accepted: resample the file"
                ));
            }
        }
        Ok(Self { spacing, placement: Placement { origin, direction } })
    }
}

/// From RAS to LPS, and back: x and y change their sign.
pub(crate) fn ras_to_lps(vector: Vector) -> Vector {
    mirrored(vector, [-1.0, -1.0, 1.0])
}

/// With a sign for each coordinate; a 0 is never negative.
pub(crate) fn mirrored(vector: Vector, signs: Vector) -> Vector {
    std::array::from_fn(|row| signs[row] * vector[row] + 0.0)
}

fn length(vector: Vector) -> f64 {
    dot(vector, vector).sqrt()
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// How far two grids of one `size` lie apart, each with its spacing and placement: the largest distance
/// between corners of the same index, in units of the world.
#[must_use]
pub fn gap_between<const D: usize>(
    size: [usize; D],
    one: ([f64; D], Placement),
    other: ([f64; D], Placement),
) -> f64 {
    let gap = |corner: usize| {
        let last = |axis: usize| size[axis].saturating_sub(1) as f64;
        let point = std::array::from_fn(|axis| (corner >> axis & 1) as f64 * last(axis));
        let [here, there] = [one, other].map(|(spacing, place)| place.to_world(point, spacing));
        length(std::array::from_fn(|axis| here[axis] - there[axis]))
    };
    (0..1 << D).map(gap).fold(0.0, f64::max)
}
