//! What tests share.
#![allow(dead_code, reason = "each test program uses a part")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

pub(crate) mod curves;

use heatpath_core::Exec;
use heatpath_core::grid::distance::{Eikonal, EikonalOptions, normalized};
use heatpath_core::grid::heat::{Heat, Implicit, ImplicitOptions};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::path::{Descent, Path, PathOptions};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};

pub(crate) fn options(time: f64, steps: usize) -> ImplicitOptions {
    ImplicitOptions { time, steps, ..ImplicitOptions::default() }
}

pub(crate) fn flow<const D: usize>(
    medium: &Medium<D>,
    source: [f64; D],
    options: ImplicitOptions,
) -> Heat<D> {
    let exec = Exec::single_threaded();
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    Implicit::new(medium, options, &exec).unwrap().flow(&sources, &exec).unwrap()
}

pub(crate) fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(2685821657736338717) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

pub(crate) fn euclidean<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// A medium without symmetry, with walls if `density` is above 0; the source's cell is open.
pub(crate) fn rough<const D: usize>(
    shape: Shape<D>,
    contrast: f64,
    form: Form,
    density: f64,
    seed: u64,
) -> (Medium<D>, [f64; D]) {
    let mut random = random(seed);
    let field = Grid::from_fn(shape, |_| 10_f64.powf(-contrast * random()));
    let source = shape.cell_at(shape.size().map(|side| side as f64 * random() - 0.5));
    let mask = Mask::new(Grid::from_fn(shape, |index| index == source || random() > density));
    let medium = medium::given(field, form).unwrap().with_walls(mask).unwrap();
    (medium, source.map(|i| i as f64))
}

pub(crate) fn paths(
    medium: &Medium<2>,
    sources: &[[f64; 2]],
    ends: &[[f64; 2]],
    options: ImplicitOptions,
) -> Vec<Path<2>> {
    let exec = Exec::single_threaded();
    let sources = Sources::new(sources, medium.mask()).unwrap();
    let heat = Implicit::new(medium, options, &exec).unwrap().flow(&sources, &exec).unwrap();
    let (descent, distances) = (Descent::new(&heat, medium).unwrap(), normalized(&heat));
    ends.iter().map(|&end| descent.path(end, &distances, PathOptions::default()).unwrap()).collect()
}

/// The exact distances.
pub(crate) fn march<const D: usize>(
    medium: &Medium<D>,
    points: &[[f64; D]],
    options: &EikonalOptions<D>,
) -> Grid<f64, D> {
    let exec = Exec::single_threaded();
    let sources = Sources::new(points, medium.mask()).unwrap();
    let eikonal = Eikonal::new(medium, &exec).unwrap();
    eikonal.distance(&sources, options, &exec).unwrap().into_field()
}
