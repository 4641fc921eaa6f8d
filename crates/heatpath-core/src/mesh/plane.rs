//! Faces laid out in the plane.

use crate::mesh::triangle::third_corner;

/// A point or vector of the plane.
pub(crate) type Vector2 = [f64; 2];

pub(crate) fn minus(a: Vector2, b: Vector2) -> Vector2 {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn plus(a: Vector2, b: Vector2) -> Vector2 {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn times(a: Vector2, factor: f64) -> Vector2 {
    [a[0] * factor, a[1] * factor]
}

/// Positive if `b` lies to the left of `a`.
pub(crate) fn cross(a: Vector2, b: Vector2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn length(a: Vector2) -> f64 {
    a[0].hypot(a[1])
}

/// The corners of the face with these sides, counter-clockwise.
pub(crate) fn corners(sides: [f64; 3]) -> [Vector2; 3] {
    [[0.0, 0.0], [sides[2], 0.0], third_corner(sides)]
}

/// The point with these weights.
pub(crate) fn weighted(corners: [Vector2; 3], weights: [f64; 3]) -> Vector2 {
    let parts: [Vector2; 3] = std::array::from_fn(|i| times(corners[i], weights[i]));
    plus(parts[0], plus(parts[1], parts[2]))
}

/// How much each weight grows per length along `direction`.
pub(crate) fn weight_rates(corners: [Vector2; 3], direction: Vector2) -> [f64; 3] {
    let area_2 = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    std::array::from_fn(|i| {
        cross(minus(corners[(i + 2) % 3], corners[(i + 1) % 3]), direction) / area_2
    })
}

/// The gradient of the linear function with these values at the corners.
pub(crate) fn gradient(corners: [Vector2; 3], values: [f64; 3]) -> Vector2 {
    let slope = |direction: Vector2| {
        let rates = weight_rates(corners, direction);
        // Differences to one corner, so that a constant has no slope at all.
        rates[1] * (values[1] - values[0]) + rates[2] * (values[2] - values[0])
    };
    [slope([1.0, 0.0]), slope([0.0, 1.0])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_of_a_linear_function() {
        let corners = corners([5.0, 4.0, 3.0]);
        let values = corners.map(|[x, y]| 7.0 + 2.0 * x - 0.5 * y);
        let [x, y] = gradient(corners, values);
        assert!((x - 2.0).abs() < 1e-15 && (y + 0.5).abs() < 1e-15);
        assert_eq!(gradient(corners, [0.3; 3]), [0.0, 0.0]);
        assert_eq!(weighted(corners, [0.0, 0.5, 0.5]), [1.5, 2.0]);
    }
}
