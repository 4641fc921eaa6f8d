//! Triangles known by the lengths of their sides.
//!
//! Side i is opposite corner i, as everywhere in this wing.

/// The area (Heron's formula in Kahan's order, which is exact to a few bits for needles too); zero for
/// sides that make no triangle.
pub(crate) fn area(sides: [f64; 3]) -> f64 {
    let mut s = sides;
    s.sort_unstable_by(|a, b| b.total_cmp(a));
    let [a, b, c] = s;
    let product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    0.25 * product.max(0.0).sqrt()
}

/// The cotangents of the three angles.
pub(crate) fn cotangents(sides: [f64; 3]) -> [f64; 3] {
    let square = sides.map(|side| side * side);
    let area_4 = 4.0 * area(sides);
    std::array::from_fn(|i| (square[(i + 1) % 3] + square[(i + 2) % 3] - square[i]) / area_4)
}

/// Where the third corner lies if the first is at the origin and the second at `(sides[2], 0)`; its
/// second coordinate is not negative.
///
/// The height is that of the area: from `b` and the first coordinate, of a needle half its digits
/// would be lost.
pub(crate) fn third_corner(sides: [f64; 3]) -> [f64; 2] {
    let [a, b, c] = sides;
    [(b * b + (c - a) * (c + a)) / (2.0 * c), 2.0 * area(sides) / c]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_triangle() {
        let sides = [5.0, 4.0, 3.0];
        assert_eq!(area(sides), 6.0);
        assert_eq!(third_corner(sides), [0.0, 4.0]);
        assert_eq!(cotangents(sides), [0.0, 0.75, 4.0 / 3.0]);
        assert_eq!(area([3.0, 1.0, 1.0]), 0.0);
    }

    #[test]
    fn the_height_of_a_needle() {
        let width = 2_f64.powi(-20);
        let sides = [width, (1.0 + width * width).sqrt(), 1.0];
        let [x, y] = third_corner(sides);
        assert!((x - 1.0).abs() < 1e-15 && (y / width - 1.0).abs() < 1e-10, "{x} {y}");
    }
}
