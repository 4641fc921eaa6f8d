//! The cells that a path crosses.

use crate::grid::Shape;

/// The position of each cell that a polyline enters, in its order.
///
/// Two cells in a row share a face, or the corner or edge that the polyline goes through.
pub(super) fn crossed<const D: usize>(shape: &Shape<D>, points: &[[f64; D]]) -> Vec<usize> {
    let mut cells: Vec<usize> =
        points.first().map(|&point| shape.position(shape.cell_at(point))).into_iter().collect();
    points.windows(2).for_each(|pair| cross(shape, pair[0], pair[1], &mut cells));
    cells
}

/// Adds the cells that a segment enters after the one it begins in.
fn cross<const D: usize>(shape: &Shape<D>, from: [f64; D], to: [f64; D], cells: &mut Vec<usize>) {
    let (mut here, last) = (shape.cell_at(from), shape.cell_at(to));
    while here != last {
        // Where the segment leaves the cell along each axis, as a part of its length.
        let leaves: [f64; D] = std::array::from_fn(|axis| {
            let border = here[axis] as f64 + if last[axis] > here[axis] { 0.5 } else { -0.5 };
            let is_there = last[axis] == here[axis];
            if is_there { f64::INFINITY } else { (border - from[axis]) / (to[axis] - from[axis]) }
        });
        let first = leaves.into_iter().fold(f64::INFINITY, f64::min);
        for axis in (0..D).filter(|&axis| leaves[axis] == first) {
            here[axis] = if last[axis] > here[axis] { here[axis] + 1 } else { here[axis] - 1 };
        }
        cells.push(shape.position(here));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_cell_on_the_way_is_crossed() {
        let shape = Shape::new([5, 4]).unwrap();
        let there_and_back = [[0.0, 0.0], [3.0, 1.0], [0.0, 0.0]];
        assert_eq!(crossed(&shape, &there_and_back), [0, 1, 7, 8, 7, 1, 0]);
        assert_eq!(crossed(&shape, &[[0.0, 0.0], [2.0, 2.0]]), [0, 6, 12], "through corners");
        assert_eq!(crossed(&shape, &[[4.4, 3.4]]), [19]);
        assert_eq!(crossed::<2>(&shape, &[]), [0; 0]);
    }

    proptest! {
        #[test]
        fn nothing_on_a_segment_is_missed(ends in prop::array::uniform6(-0.5..8.5)) {
            let shape = Shape::new([9, 9, 9]).unwrap();
            let [a, b] = [[ends[0], ends[1], ends[2]], [ends[3], ends[4], ends[5]]];
            let cells = crossed(&shape, &[a, b]);
            let steps: usize =
                (0..3).map(|axis| shape.cell_at(a)[axis].abs_diff(shape.cell_at(b)[axis])).sum();
            prop_assert!(cells.len() <= steps + 1);
            for i in 0..=1000 {
                let s = f64::from(i) / 1000.0;
                let point = std::array::from_fn(|axis| a[axis] + s * (b[axis] - a[axis]));
                let is_inside =
                    point.iter().all(|x: &f64| ((x + 0.5) - (x + 0.5).round()).abs() > 1e-9);
                let cell = shape.position(shape.cell_at(point));
                prop_assert!(!is_inside || cells.contains(&cell));
            }
        }
    }
}
