//! The exact weighted distance: the eikonal equation.

mod march;
mod queue;
mod stencil;
mod update;

use self::march::{Front, Limits, Seed};
use self::stencil::{Axes, Stencil};
use super::DistanceMap;
use crate::exec::{Cancelled, Exec};
use crate::grid::medium::Medium;
use crate::grid::sample::corners;
use crate::grid::source::shares;
use crate::grid::tensor::{apply, inverse};
use crate::grid::{Grid, Matrix, Sources};

/// test
pub fn test_distance<const D: usize>(
    medium: &Medium<D>,
    sources: &Sources<D>,
    second_order: bool,
    exec: &Exec,
) -> Result<DistanceMap<D>, Cancelled> {
    let axes = Axes::new(medium);
    let seeds: Vec<Seed<D>> =
        sources.points().iter().map(|&point| seed(medium, &axes, point, 0.0)).collect();
    let cells = medium.shape().cells();
    let mut typical: Vec<f64> = (0..cells).step_by((cells / 1000).max(1)).map(|cell| 1.0 / medium.speed_sq(cell).sqrt()).collect();
    typical.sort_by(f64::total_cmp);
    let width = typical[typical.len() / 2] * medium.shape().smallest_spacing() / std::env::var("W").map_or(32.0, |w| w.parse().unwrap());
    let mut front = Front::new(&axes, &seeds, second_order, width);
    front.march(Limits { farthest: f64::INFINITY, targets: &[], second_order }, exec)?;
    let field = Grid::from_fn(*medium.shape(), |index| front.distance(axes.place(index)));
    Ok(DistanceMap { field })
}

fn metric<const D: usize>(medium: &Medium<D>, cell: usize) -> Matrix<D> {
    let (inverse, h) = (inverse(&medium.speed_sq_tensor(cell)), medium.shape().spacing());
    std::array::from_fn(|i| std::array::from_fn(|j| inverse[i][j] * h[i] * h[j]))
}

fn seed<const D: usize>(
    medium: &Medium<D>,
    stencil: &impl Stencil<D, D>,
    point: [f64; D],
    initial: f64,
) -> Seed<D> {
    let shape = medium.shape();
    let shares = shares(medium.mask(), point);
    let mut here = [[0.0; D]; D];
    for &(cell, weight) in &shares {
        let metric = metric(medium, cell);
        for i in 0..D {
            (0..D).for_each(|j| here[i][j] += weight * metric[i][j]);
        }
    }
    let length = |metric: &Matrix<D>, d: [f64; D]| {
        let covector = apply(metric, d);
        (0..D).map(|axis| d[axis] * covector[axis]).sum::<f64>().sqrt()
    };
    let cells = shares
        .iter()
        .map(|&(cell, _)| {
            let centre = shape.centre(cell);
            let d = std::array::from_fn(|axis| centre[axis] - point[axis]);
            let mean = 0.5 * (length(&here, d) + length(&metric(medium, cell), d));
            (stencil.place(shape.index(cell)), initial + mean)
        })
        .collect();
    Seed { point, metric: here, initial, cells }
}
