//! Which points are the same.

use crate::mesh::vector::distance as between;
use std::collections::HashMap;

/// For each point the first one at the same position; -0 is 0.
pub(super) fn equal(points: &[[f64; 3]]) -> Vec<u32> {
    let mut known = HashMap::new();
    let position = |point: &[f64; 3]| point.map(|x| (x + 0.0).to_bits());
    let first = |(own, point)| *known.entry(position(point)).or_insert(own);
    (0..).zip(points).map(first).collect()
}

/// For each point the first kept one at most `distance` from it: itself if there is none, and then
/// it is kept.
pub(super) fn near(points: &[[f64; 3]], distance: f64) -> Vec<u32> {
    // Cells twice as wide as the distance: what is near lies in one of two cells an axis.
    let cell = |x: f64| ((x / (2.0 * distance)).floor() + 0.0).to_bits();
    let mut kept: HashMap<[u64; 3], Vec<u32>> = HashMap::new();
    // Most points that are near are equal, and those are found faster.
    let mut firsts = equal(points);
    for (own, &point) in (0..).zip(points) {
        let same = firsts[own as usize];
        if same < own {
            firsts[own as usize] = firsts[same as usize];
            continue;
        }
        let ends = point.map(|x| [cell(x - distance), cell(x + distance)]);
        // Mostly both ends lie in the same cell: then only one of them counts.
        let is_needed =
            |side: &usize| (0..3).all(|i| side >> i & 1 == 0 || ends[i][0] != ends[i][1]);
        let around = |side: usize| -> [u64; 3] { std::array::from_fn(|i| ends[i][side >> i & 1]) };
        let cells = (0..8).filter(is_needed).filter_map(|side| kept.get(&around(side)));
        let candidates = cells.flatten().copied();
        let is_near = |&other: &u32| between(points[other as usize], point) <= distance;
        let first = candidates.filter(is_near).min().unwrap_or(own);
        if first == own {
            kept.entry(point.map(cell)).or_default().push(own);
        }
        firsts[own as usize] = first;
    }
    firsts
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every point against every kept one.
    fn slow(points: &[[f64; 3]], distance: f64) -> Vec<u32> {
        let mut firsts: Vec<u32> = Vec::new();
        for (own, &point) in points.iter().enumerate() {
            let is_near = |&other: &usize| {
                firsts[other] as usize == other && between(points[other], point) <= distance
            };
            let first = (0..own).find(is_near).unwrap_or(own) as u32;
            firsts.push(first);
        }
        firsts
    }

    proptest! {
        #[test]
        fn cells_find_what_all_pairs_find(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 0..100),
            distance in 0.01..0.5,
        ) {
            // Each point twice.
            let points = [&points[..], &points[..]].concat();
            prop_assert_eq!(near(&points, distance), slow(&points, distance));
        }
    }

    #[test]
    fn far_points_do_not_share_a_cell() {
        let points = [[1e100, 0.0, 0.0], [-1e100, 0.0, 0.0], [1e100, 0.0, 0.0]];
        assert_eq!(near(&points, 1e-100), [0, 1, 0]);
        assert_eq!(equal(&points), [0, 1, 0]);
    }
}
