//! How thick a mask is: exact Euclidean distances to its edge.

use crate::grid::Grid;

/// No cell.
const NONE: usize = usize::MAX;

/// The distance of each true cell's centre from the edge of the mask, in physical units; 0 in the
/// false cells.
///
/// The distance from the nearest false cell's centre is exact, by one lower envelope of parabolas a
/// row and axis (Felzenszwalb & Huttenlocher 2012). The edge lies half-way between that cell and the
/// row of true cells before it: half a cell outside the last true centre across straight edges along
/// the axes, less across oblique ones, whose rows are closer. On the centreline this is the radius; a
/// tube of an even number of cells has its middle between two, each half a cell nearer to one
/// side. The border of the grid is no edge: where no cell is false, the radius is infinite.
#[must_use]
pub fn radii<const D: usize>(mask: &Grid<bool, D>) -> Grid<f64, D> {
    let shape = mask.shape();
    let nearest = nearest_outside(mask);
    let radii = nearest.iter().enumerate().map(|(cell, &outside)| match outside {
        NONE => f64::INFINITY,
        _ if outside == cell => 0.0,
        _ => {
            let (here, there) = (shape.centre(cell), shape.centre(outside));
            let apart =
                std::array::from_fn(|axis| (there[axis] - here[axis]) * shape.spacing()[axis]);
            let distance = shape.physical_distance(here, there);
            distance - 0.5 * row_gap(apart.map(|x| x / distance), shape.spacing())
        }
    });
    Grid::from_parts(*shape, radii.collect())
}

/// The squared physical distance of each cell from the nearest false one, centre to centre.
pub(super) fn depths_sq<const D: usize>(mask: &Grid<bool, D>) -> Vec<f64> {
    let shape = mask.shape();
    let nearest = nearest_outside(mask);
    let depth = |(cell, &outside): (usize, &usize)| match outside {
        NONE => f64::INFINITY,
        _ => shape.physical_distance(shape.centre(cell), shape.centre(outside)).powi(2),
    };
    nearest.iter().enumerate().map(depth).collect()
}

/// The distance, along the unit vector `normal`, of the two closest rows of cells: the least step
/// towards a neighbour that goes forward.
fn row_gap<const D: usize>(normal: [f64; D], spacing: [f64; D]) -> f64 {
    let steps = (0..3_usize.pow(D as u32)).map(|i| -> f64 {
        let step = |axis: usize| (i / 3_usize.pow(axis as u32) % 3) as f64 - 1.0;
        (0..D).map(|axis| step(axis) * spacing[axis] * normal[axis]).sum()
    });
    let least = 1e-9 * spacing.into_iter().fold(f64::INFINITY, f64::min);
    steps.filter(|&step| step > least).fold(f64::INFINITY, f64::min)
}

/// The nearest false cell of each cell; [`NONE`] if there is none.
fn nearest_outside<const D: usize>(mask: &Grid<bool, D>) -> Vec<usize> {
    let shape = mask.shape();
    let mut nearest: Vec<usize> = mask
        .values()
        .iter()
        .enumerate()
        .map(|(cell, &set)| if set { NONE } else { cell })
        .collect();
    let mut costs: Vec<f64> =
        mask.values().iter().map(|&set| if set { f64::INFINITY } else { 0.0 }).collect();
    for axis in 0..D {
        let (side, stride, h) = (shape.size()[axis], shape.stride(axis), shape.spacing()[axis]);
        for first in (0..shape.cells()).filter(|&cell| shape.index(cell)[axis] == 0) {
            let row: Vec<(f64, usize)> = (0..side)
                .map(|i| (costs[first + i * stride], nearest[first + i * stride]))
                .collect();
            for (i, site) in lowest_parabolas(&row, h).into_iter().enumerate() {
                let apart = (i as f64 - site as f64) * h;
                costs[first + i * stride] = row[site].0 + apart * apart;
                nearest[first + i * stride] = row[site].1;
            }
        }
    }
    nearest
}

/// For each place of a row, the site whose parabola `cost + (h (place - site))^2` is the lowest.
fn lowest_parabolas(row: &[(f64, usize)], h: f64) -> Vec<usize> {
    // === The sites of the envelope, each with the place from which on it is the lowest
    let mut envelope: Vec<(usize, f64)> = Vec::new();
    for site in (0..row.len()).filter(|&site| row[site].0.is_finite()) {
        let mut start = f64::NEG_INFINITY;
        while let Some(&(last, last_start)) = envelope.last() {
            let rise = (row[site].0 - row[last].0) / (h * h);
            let (a, b) = (last as f64, site as f64);
            start = 0.5 * (rise / (b - a) + a + b);
            if start > last_start {
                break;
            }
            envelope.pop();
            start = f64::NEG_INFINITY;
        }
        envelope.push((site, start));
    }
    // === Read off
    let mut part = 0;
    (0..row.len())
        .map(|place| {
            while envelope.get(part + 1).is_some_and(|&(_, start)| start <= place as f64) {
                part += 1;
            }
            envelope.get(part).map_or(place, |&(site, _)| site)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Shape;

    #[test]
    fn depths_are_those_of_a_search_of_all_cells() {
        let shape = Shape::with_spacing([9, 7, 5], [1.0, 0.5, 2.5]).unwrap();
        let mask = Grid::from_fn(shape, |[x, y, z]| (7 * x + 5 * y + 11 * z) % 23 > 1);
        let depths = depths_sq(&mask);
        let outside: Vec<usize> = (0..shape.cells()).filter(|&c| !mask.values()[c]).collect();
        for (cell, depth) in depths.into_iter().enumerate() {
            let distance =
                |&other: &usize| shape.physical_distance(shape.centre(cell), shape.centre(other));
            let least = outside.iter().map(distance).fold(f64::INFINITY, f64::min);
            assert!((depth.sqrt() - least).abs() < 1e-12);
        }
        let full = Grid::from_fn(shape, |_| true);
        assert!(depths_sq(&full).into_iter().all(|depth| depth == f64::INFINITY));
    }

    #[test]
    fn rows_are_closer_across_oblique_edges() {
        assert_eq!(row_gap([1.0, 0.0], [2.0, 3.0]), 2.0);
        let half = 0.5_f64.sqrt();
        assert!((row_gap([half, half], [1.0, 1.0]) - half).abs() < 1e-15);
    }
}
