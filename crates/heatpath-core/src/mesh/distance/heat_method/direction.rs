//! From heat to the differences of distance that its direction asks for.

use crate::linear::Wide;
use crate::mesh::Triangulation;
use crate::mesh::triangle::third_corner;

/// What distances should be in the corners of each face, up to a constant: linear, falling against
/// the heat, with the slowness as slope. Zero where no heat has come.
pub(super) fn targets(triangulation: &Triangulation, heat: &[Wide]) -> Vec<[f64; 3]> {
    let target = |(face, corners): (usize, &[u32; 3])| {
        let heat = common(corners.map(|vertex| heat[vertex as usize]));
        let slope = gradient_length(triangulation.sides(face), heat);
        if slope > 0.0 {
            heat.map(|heat| -triangulation.slowness()[face] * heat / slope)
        } else {
            [0.0; 3]
        }
    };
    triangulation.faces().iter().enumerate().map(target).collect()
}

/// Three numbers divided by the power of two that is below the largest of them.
fn common(numbers: [Wide; 3]) -> [f64; 3] {
    let largest = numbers.iter().filter(|x| !x.is_zero()).map(|x| x.parts().1).max();
    numbers.map(|x| x.shifted(-largest.unwrap_or(0)).to_f64())
}

/// The length of the gradient of the linear function with these values in the corners.
fn gradient_length(sides: [f64; 3], values: [f64; 3]) -> f64 {
    let [x, y] = third_corner(sides).map(|place| place / sides[2]);
    let along = values[1] - values[0];
    let across = (values[2] - values[0] - along * x) / y;
    (along * along + across * across).sqrt() / sides[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_plane() {
        // The corners (0, 0), (3, 0), (0, 4) of 2 x + y.
        assert!((gradient_length([5.0, 4.0, 3.0], [0.0, 6.0, 4.0]) - 5.0_f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn heat_of_any_size_has_a_direction() {
        let tiny = Wide::new(1.5, -5000);
        assert_eq!(common([tiny, Wide::ZERO, tiny.shifted(-2)]), [1.5, 0.0, 0.375]);
        assert_eq!(common([Wide::ZERO; 3]), [0.0; 3]);
    }
}
