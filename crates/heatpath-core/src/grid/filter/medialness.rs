//! How far each pixel is in the middle between two edges.

use super::elongated::weighted_sum;
use super::separable::for_each_slab;
use super::structure::gradient;
use super::{FilterError, LARGEST_SCALE, QUIET};
use crate::error::check;
use crate::exec::{Cancelled, Exec};
use crate::grid::{Grid, Shape};
use std::f64::consts::PI;
use std::ops::Range;

/// How many directions are tried, over half a turn.
const DIRECTIONS: usize = 12;

/// The Gaussian that edges are found with: its deviation over the radius, and the least in cell units.
const BLUR: f64 = 0.3;
const LEAST_BLUR: f64 = 1.2;

/// Edges are averaged along the tube by a Gaussian: its deviation over the radius, and the largest
/// in cell units.
const LENGTH: f64 = 2.0;
const LARGEST_LENGTH: f64 = 8.0;

/// Where edges are sampled for that, in its deviations.
const SAMPLES: [f64; 5] = [-1.5, -0.75, 0.0, 0.75, 1.5];

/// How much each pixel looks like the middle of a bright tube that has an edge on both sides, at one
/// of the `radii`; from 0 to 1, the largest response of the picture.
///
/// For a direction n and a radius r it is `min(g(x - r n), -g(x + r n))`, where g is the
/// derivative along n of the picture smoothed by `sigma = max(1.2, 0.3 r)`, times `sqrt(2 pi) sigma`, so that
/// a step of 1 counts 1, averaged along the edge by a Gaussian of deviation `min(2 r, 8)`: Koller et al.
/// (1995), "Multiscale detection of curvilinear structures". The largest of all radii and 12 directions
/// counts. Radii and sigma are in cell units. Dark tubes are the bright ones of the negative.
///
/// Second derivatives look at the grey values within a tube: one with a bright or dark stripe along it,
/// such as the reflex of light on a wide vessel, is two tubes to them at small scales. Here it is one. In exchange
/// this sees more in noise; the geometric mean of both keeps the middle and the quiet (the figures
/// for paths are in `docs/extraction.md`).
///
/// # Errors
/// A value that is not finite, a radius that is not positive or above [`LARGEST_SCALE`], or the caller cancelled.
pub fn medialness(
    image: &Grid<f64, 2>,
    radii: &[f64],
    exec: &Exec,
) -> Result<Grid<f64, 2>, FilterError> {
    image.check_finite()?;
    for &radius in radii {
        let is_right = radius > 0.0 && radius <= LARGEST_SCALE;
        check("radius", radius, is_right, "positive and at most 100 cells")?;
    }
    let mut response = image.map(|_| 0.0);
    for (i, &radius) in radii.iter().enumerate() {
        let share = |part: f64| (i as f64 + part) / radii.len() as f64;
        add_radius(&mut response, image, radius, share(0.0)..share(1.0), exec)?;
    }
    exec.report(1.0)?;
    let largest = response.values().iter().copied().fold(0.0, f64::max);
    let quiet = QUIET * image.largest_size();
    Ok(response.map(|&value| if value > quiet { value / largest } else { 0.0 }))
}

/// Raises each value of `response` to what this radius has there.
fn add_radius(
    response: &mut Grid<f64, 2>,
    image: &Grid<f64, 2>,
    radius: f64,
    share: Range<f64>,
    exec: &Exec,
) -> Result<(), Cancelled> {
    let sigma = (BLUR * radius).max(LEAST_BLUR);
    let part = (share.end - share.start) / (1 + DIRECTIONS) as f64;
    let until = |parts: usize| share.start + parts as f64 * part;
    let gradient = gradient(image, sigma, share.start..until(1), exec)?;
    let width = image.shape().size()[0];
    for direction in 0..DIRECTIONS {
        let (sin, cos) = (PI * direction as f64 / DIRECTIONS as f64).sin_cos();
        let sides = [-1.0, 1.0].map(|side| samples(image.shape(), radius, [cos, sin], side));
        let edges =
            Edges::new(&gradient, [cos, sin].map(|n| n * (2.0 * PI).sqrt() * sigma), &sides);
        let rows = response.values_mut().chunks_mut(width);
        let scratch = || (vec![0.0; width], vec![0.0; width], Vec::new());
        let share = until(1 + direction)..until(2 + direction);
        for_each_slab(exec, share, rows, scratch, |(left, right, taps), y, row| {
            for (samples, sum) in sides.iter().zip([&mut *left, &mut *right]) {
                edges.place(samples, y, taps);
                exec.simd().run(
                    #[inline(always)]
                    || weighted_sum(taps, &edges.values, sum),
                );
            }
            for ((value, left), right) in row.iter_mut().zip(left).zip(right) {
                *value = value.max(left.min(*right));
            }
        })?;
    }
    Ok(())
}

/// The weights and shifts, in cells, of an edge on one side.
fn samples(
    shape: &Shape<2>,
    radius: f64,
    normal: [f64; 2],
    side: f64,
) -> [(f64, [isize; 2]); SAMPLES.len()] {
    let deviation = (LENGTH * radius).min(LARGEST_LENGTH);
    let weight = |at: f64| (-0.5 * at * at).exp();
    let total: f64 = SAMPLES.iter().map(|&at| weight(at)).sum();
    let along = [-normal[1], normal[0]];
    SAMPLES.map(|at| {
        let offset = std::array::from_fn(|axis| {
            let unit = shape.spacing()[axis] / shape.smallest_spacing();
            let offset = side * radius * normal[axis] + at * deviation * along[axis];
            (offset / unit).round() as isize
        });
        (-side * weight(at) / total, offset)
    })
}

/// The derivative along one direction, with rows continued to both sides by their last values.
struct Edges {
    values: Vec<f64>,
    height: usize,
    stride: usize,
    margin: usize,
}

impl Edges {
    fn new(
        gradient: &Grid<[f64; 2], 2>,
        normal: [f64; 2],
        sides: &[[(f64, [isize; 2]); SAMPLES.len()]],
    ) -> Self {
        let [width, height] = gradient.shape().size();
        let shifts = sides.iter().flatten().map(|(_, offset)| offset[0].unsigned_abs());
        let margin = shifts.max().unwrap_or(0);
        let mut values = Vec::with_capacity(height * (width + 2 * margin));
        for row in gradient.values().chunks(width) {
            let along = |g: &[f64; 2]| g[0] * normal[0] + g[1] * normal[1];
            values.extend((0..margin).map(|_| along(&row[0])));
            values.extend(row.iter().map(along));
            values.extend((0..margin).map(|_| along(&row[width - 1])));
        }
        Self { values, height, stride: width + 2 * margin, margin }
    }

    /// Where the samples of row `y` begin, with their weights.
    fn place(&self, samples: &[(f64, [isize; 2])], y: usize, taps: &mut Vec<(f64, usize)>) {
        taps.clear();
        taps.extend(samples.iter().map(|&(weight, [dx, dy])| {
            let row = y.saturating_add_signed(dy).min(self.height - 1);
            (weight, row * self.stride + self.margin.saturating_add_signed(dx))
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::filter::{Tubes, vesselness};

    /// A ribbon with a middle at `y = 30 + x / 4`, a half width of 7 and a dark stripe along it.
    fn ribbon() -> Grid<f64, 2> {
        Grid::from_fn(Shape::new([90, 80]).unwrap(), |[x, y]| {
            let across = (y as f64 - 30.0 - 0.25 * x as f64) / 17.0_f64.sqrt() * 4.0;
            let ribbon = 1.0 / (1.0 + (across.abs() - 7.0).exp());
            ribbon - 0.6 * (-0.5 * (across / 2.0).powi(2)).exp()
        })
    }

    /// Where a column has its largest value.
    fn strongest(grid: &Grid<f64, 2>, x: usize) -> f64 {
        let height = grid.shape().size()[1];
        let most = (0..height).max_by(|&a, &b| grid[[x, a]].total_cmp(&grid[[x, b]]));
        most.unwrap() as f64
    }

    #[test]
    fn a_stripe_does_not_move_the_middle() {
        let (ribbon, exec) = (ribbon(), Exec::single_threaded());
        let medial = medialness(&ribbon, &[1.5, 2.5, 3.5, 5.0, 7.0], &exec).unwrap();
        let tubes = Tubes { scales: vec![1.5, 3.0, 5.0], elongation: 2.0, ..Tubes::default() };
        let sato = vesselness(&ribbon, &tubes, &exec).unwrap().response;
        for x in 25..65 {
            let middle = 30.0 + 0.25 * x as f64;
            assert!((strongest(&medial, x) - middle).abs() < 1.0, "column {x}");
            assert!((strongest(&sato, x) - middle).abs() > 2.0, "column {x}: what is to be mended");
        }
        assert_eq!(medial.values().iter().copied().fold(0.0, f64::max), 1.0);
        let parallel = medialness(&ribbon, &[1.5, 2.5, 3.5, 5.0, 7.0], &Exec::new(3).unwrap());
        assert_eq!(parallel.unwrap(), medial);
    }

    #[test]
    fn one_edge_is_no_tube() {
        let step = Grid::from_fn(Shape::new([40, 30]).unwrap(), |[x, _]| f64::from(x < 20));
        let found = medialness(&step, &[3.0], &Exec::single_threaded()).unwrap();
        assert!(found.values().iter().all(|&value| value == 0.0));
    }

    #[test]
    fn radii_that_make_no_sense_are_refused() {
        let flat = Grid::from_fn(Shape::new([4, 3]).unwrap(), |_| 0.0);
        for radius in [0.0, -1.0, f64::NAN, 101.0] {
            let error = medialness(&flat, &[radius], &Exec::single_threaded()).unwrap_err();
            assert!(matches!(error, FilterError::Parameter(error) if error.name == "radius"));
        }
    }
}
