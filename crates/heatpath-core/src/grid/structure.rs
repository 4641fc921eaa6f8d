//! The structure that a medium shows: the cells in which it is fast, and how fast that is.

use super::Grid;
use super::medium::Medium;
use super::skeleton::{radii, thin};

/// The cells that are open and fast: `k D >= least_speed_sq`
/// ([`structure_level`] chooses that).
#[must_use]
pub fn structure<const D: usize>(medium: &Medium<D>, least_speed_sq: f64) -> Grid<bool, D> {
    let shape = *medium.shape();
    Grid::from_fn(shape, |index| {
        let cell = shape.position(index);
        medium.mask().is_open(cell) && medium.speed_sq(cell) >= least_speed_sq
    })
}

/// Half the width of a structure, in physical units: the median of the [`radii`] on its centreline.
/// `None` if it is empty, or everywhere.
///
/// ```
/// use heatpath_core::grid::{Grid, Shape, half_width};
///
/// let bars = Grid::from_fn(Shape::new([60, 40])?, |[_, y]| (5..10).contains(&y) || y == 30);
/// assert_eq!(half_width(&bars), Some(2.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn half_width<const D: usize>(structure: &Grid<bool, D>) -> Option<f64> {
    let (centreline, radii) = (thin(structure), radii(structure));
    let on_it = centreline.values().iter().zip(radii.values()).filter(|(inside, _)| **inside);
    let mut widths: Vec<f64> = on_it.map(|(_, &radius)| radius).collect();
    widths.sort_by(f64::total_cmp);
    widths.get(widths.len() / 2).copied().filter(|width| width.is_finite())
}

/// How far above Otsu's threshold the structure begins.
const ABOVE_OTSU: f64 = 1.2;

/// The squared speed from which on a cell belongs to the structure, from the medium alone: for
/// [`seeds`](super::seeds()) and [`Growth`](super::voting::Growth). `None` if the speed is the same everywhere.
///
/// It is Otsu's threshold of the speed `sqrt(k D)` of the open cells ("A threshold selection method
/// from gray-level histograms", 1979), which divides them into a slow and a fast class with means as
/// far apart as possible, times 1.2 and squared. It is never further above the threshold than half of
/// the way to the mean of the fast class. With the medium's unit of speed the level changes as the
/// squared speeds do.
///
/// The factor was chosen by measurement: on retinas (14 pictures of CHASE, 8 of STARE), where the
/// speed is a vesselness in units of the local deviation, Otsu's thresholds are 0.33 to 0.44, and the
/// best one for all pictures is 0.42.
///
/// ```
/// use heatpath_core::grid::medium::{Form, given};
/// use heatpath_core::grid::{Grid, Shape, structure_level};
///
/// let speed = |[x, _]: [usize; 2]| if x == 7 { 1.0 } else { 0.1_f64 };
/// let medium = given(Grid::from_fn(Shape::new([20, 10])?, |i| speed(i).powi(2)), Form::Pointwise)?;
/// let level = structure_level(&medium).unwrap();
/// assert!((level - (1.2 * 0.55_f64).powi(2)).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn structure_level<const D: usize>(medium: &Medium<D>) -> Option<f64> {
    let open = (0..medium.shape().cells()).filter(|&cell| medium.mask().is_open(cell));
    let speeds = open.map(|cell| medium.speed_sq(cell).sqrt());
    let (lowest, highest) =
        (speeds.clone()).fold((f64::INFINITY, 0.0_f64), |(low, high), s| (low.min(s), high.max(s)));
    if lowest >= highest {
        return None;
    }
    let per_bin = (highest - lowest) / BINS as f64;
    let mut histogram = [Class::default(); BINS];
    for speed in speeds {
        let bin = ((speed - lowest) / per_bin) as usize;
        histogram[bin.min(BINS - 1)].add(Class { count: 1.0, sum: speed });
    }
    let (bins, fast) = otsu(&histogram);
    let threshold = lowest + bins * per_bin;
    let level = (ABOVE_OTSU * threshold).min(0.5 * (threshold + fast.mean()));
    Some(level * level)
}

/// The bins from the lowest speed to the highest.
const BINS: usize = 1024;

/// Some cells.
#[derive(Clone, Copy, Default)]
struct Class {
    count: f64,
    /// The sum of their speeds.
    sum: f64,
}

impl Class {
    fn add(&mut self, other: Self) {
        self.count += other.count;
        self.sum += other.sum;
    }

    fn mean(&self) -> f64 {
        self.sum / self.count
    }
}

/// The number of bins below Otsu's threshold, in the middle if several are as good, and the class
/// above it. The first bin and the last are not empty.
fn otsu(histogram: &[Class]) -> (f64, Class) {
    let mut fast = Class::default();
    histogram.iter().for_each(|&bin| fast.add(bin));
    let mut slow = Class::default();
    let (mut first, mut last, mut best) = (0, 0, (0.0, fast));
    for (number, &bin) in histogram[..histogram.len() - 1].iter().enumerate() {
        slow.add(bin);
        fast.add(Class { count: -bin.count, sum: -bin.sum });
        let between = slow.count * fast.count * (fast.mean() - slow.mean()).powi(2);
        if between > best.0 {
            (first, last, best) = (number + 1, number + 1, (between, fast));
        } else if between == best.0 {
            last = number + 1;
        }
    }
    (0.5 * (first + last) as f64, best.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::medium::{Form, given};
    use crate::grid::{Mask, Shape};

    /// A medium in a row, of these speeds.
    fn of_speeds(speeds: &[f64]) -> Medium<2> {
        let shape = Shape::new([speeds.len(), 1]).unwrap();
        given(Grid::from_fn(shape, |[x, _]| speeds[x] * speeds[x]), Form::Pointwise).unwrap()
    }

    /// Speeds with a normal distribution (Box & Muller 1958), 6400 of them.
    fn normal(mean: f64, deviation: f64) -> Vec<f64> {
        let part = |i: u32| (f64::from(i) + 0.5) / 80.0;
        let radius = |i: u32| deviation * (-2.0 * part(i).ln()).sqrt();
        let along = |i: u32| (std::f64::consts::TAU * part(i)).cos();
        (0..6400).map(|i| mean + radius(i / 80) * along(i % 80)).collect()
    }

    #[test]
    fn the_structure_begins_above_the_middle_between_two_speeds() {
        let level = |slow: f64, fast: f64, count| {
            let mut speeds = vec![slow; 40];
            speeds[..count].fill(fast);
            structure_level(&of_speeds(&speeds)).unwrap().sqrt()
        };
        for count in [1, 20, 39] {
            assert!((level(0.2, 1.0, count) - 0.72).abs() < 1e-12, "1.2 times 0.6");
            assert!((level(0.8, 1.0, count) - 0.95).abs() < 1e-12, "half of the way to 1");
            assert!((level(1.0 - 1e-12, 1.0, count)) < 1.0);
        }
        let speeds = [normal(0.35, 0.1), normal(0.85, 0.1)].concat();
        let level = structure_level(&of_speeds(&speeds)).unwrap().sqrt();
        assert!((level - 1.2 * 0.6).abs() < 2e-3, "{level}: half way between the means");
    }

    #[test]
    fn one_speed_has_no_structure() {
        assert_eq!(structure_level(&of_speeds(&[0.7; 9])), None);
        let medium = of_speeds(&[0.1, 0.1, 1.0, 0.1]);
        let walls = Mask::new(Grid::from_fn(*medium.shape(), |[x, _]| x != 2));
        assert_eq!(
            structure_level(&medium.with_walls(walls).unwrap()),
            None,
            "a wall has no speed"
        );
    }

    #[test]
    fn the_level_has_the_unit_of_the_medium() {
        let speeds: Vec<f64> = [normal(0.3, 0.08), normal(0.9, 0.1)].concat();
        let level = |unit: f64| {
            let speeds: Vec<f64> = speeds.iter().map(|speed| unit * speed).collect();
            structure_level(&of_speeds(&speeds)).unwrap()
        };
        assert_eq!(level(8.0), 64.0 * level(1.0));
        assert!((level(1e-3) / level(1.0) - 1e-6).abs() < 1e-8);
    }
}
