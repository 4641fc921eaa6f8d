//! Local contrast against direct sums, and what must not change it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::exec::{Cancelled, SimdLevel};
use heatpath_core::grid::filter::{FilterError, normalize_contrast};
use heatpath_core::grid::{Grid, Mask, Shape};
use std::ops::ControlFlow;

fn exec() -> Exec<'static> {
    Exec::single_threaded()
}

/// Waves on a slope, stronger to the right.
fn waves<const D: usize>(size: [usize; D], spacing: [f64; D]) -> Grid<f64, D> {
    Grid::from_fn(Shape::with_spacing(size, spacing).unwrap(), |index| {
        let phase: f64 = index.iter().zip([0.9, 0.55, 1.3]).map(|(&i, k)| i as f64 * k).sum();
        0.02 * index[0] as f64 * (1.0 + phase.sin()) - 0.1 * index[1] as f64
    })
}

/// All but a corner and a few cells in between.
fn field_of_view<const D: usize>(image: &Grid<f64, D>) -> Mask<D> {
    Mask::new(Grid::from_fn(*image.shape(), |index| {
        let sum: usize = index.iter().sum();
        sum > 6 && (3 * index[0] + index[1]) % 11 != 0
    }))
}

/// The average of the open `values` around `centre`, term by term, in an image that is mirrored.
fn average<const D: usize>(
    values: &Grid<f64, D>,
    mask: &Mask<D>,
    centre: [usize; D],
    sigma: f64,
) -> f64 {
    let shape = values.shape();
    let reach = shape.spacing().map(|h| (4.0 * sigma * shape.smallest_spacing() / h).ceil());
    let side = |axis: usize| 2 * reach[axis] as usize + 1;
    let (mut sum, mut weights) = (0.0, 0.0);
    for window in 0..(0..D).map(side).product() {
        let (mut rest, mut cell, mut distance_sq) = (window, centre, 0.0);
        for axis in 0..D {
            let offset = (rest % side(axis)) as f64 - reach[axis];
            rest /= side(axis);
            let size = shape.size()[axis] as i64;
            let folded = (centre[axis] as i64 + offset as i64).rem_euclid(2 * size);
            cell[axis] = folded.min(2 * size - 1 - folded) as usize;
            distance_sq += (offset * shape.spacing()[axis] / shape.smallest_spacing()).powi(2);
        }
        if mask.is_open(shape.position(cell)) {
            let weight = (-0.5 * distance_sq / sigma.powi(2)).exp();
            sum += weight * values[cell];
            weights += weight;
        }
    }
    sum / weights
}

fn check_direct_sums<const D: usize>(image: &Grid<f64, D>, mask: &Mask<D>, sigma: f64) {
    let shape = *image.shape();
    let open = |cell: &usize| mask.is_open(*cell);
    let above = Grid::from_fn(shape, |index| image[index] - average(image, mask, index, sigma));
    let squares = above.map(|value| value * value);
    let values: Vec<f64> =
        (0..shape.cells()).filter(open).map(|cell| image.values()[cell]).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let spread =
        values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64;
    let found = normalize_contrast(image, sigma, mask, &exec()).unwrap();
    let mut at_floor = 0;
    for cell in 0..shape.cells() {
        let index = shape.index(cell);
        let local = average(&squares, mask, index, sigma).sqrt();
        let floor = 0.1 * spread.sqrt();
        at_floor += usize::from(local < floor);
        let expected = if open(&cell) { above[index] / local.max(floor) } else { 0.0 };
        assert!((found[index] - expected).abs() < 1e-11, "{index:?}: {} {expected}", found[index]);
    }
    assert!(at_floor > 0 && at_floor < shape.cells() / 2, "{at_floor} cells at the floor");
}

#[test]
fn direct_sums_say_the_same() {
    let plane = waves([37, 21], [1.0, 1.5]);
    check_direct_sums(&plane, &field_of_view(&plane), 2.0);
    check_direct_sums(&plane, &Mask::all_open(*plane.shape()), 1.2);
    let space = waves([13, 7, 5], [1.0, 2.0, 1.0]);
    check_direct_sums(&space, &field_of_view(&space), 1.1);
}

#[test]
fn light_and_contrast_do_not_matter() {
    let image = waves([60, 50], [1.0; 2]);
    let mask = field_of_view(&image);
    let found = normalize_contrast(&image, 4.0, &mask, &exec()).unwrap();
    for (factor, offset) in [(0.01, 3.0), (250.0, -1e3), (1e200, 0.0), (-1.0, 0.5)] {
        let other = image.map(|value| factor * value + offset);
        let other = normalize_contrast(&other, 4.0, &mask, &exec()).unwrap();
        for (found, other) in found.values().iter().zip(other.values()) {
            assert!((found - other * factor.signum()).abs() < 1e-10, "{factor}: {found} {other}");
        }
    }
    // The unit of length does not matter either.
    let micrometres = waves([60, 50], [1e-6; 2]);
    let small = normalize_contrast(&micrometres, 4.0, &mask, &exec()).unwrap();
    assert_eq!(small.values(), found.values());
}

#[test]
fn the_deviation_becomes_one() {
    // Waves whose strength grows a hundredfold, none of them below the floor.
    let image = Grid::from_fn(Shape::new([300, 40]).unwrap(), |[x, y]| {
        (0.015 * x as f64).exp() * (0.8 * x as f64 + 0.6 * y as f64).sin()
    });
    let mask = Mask::all_open(*image.shape());
    let found = normalize_contrast(&image, 10.0, &mask, &exec()).unwrap();
    for middle in [150, 200, 250] {
        let window = found.values().iter().enumerate();
        let window = window.filter(|(cell, _)| (middle - 20..middle + 20).contains(&(cell % 300)));
        let mean_square = window.map(|(_, value)| value * value).sum::<f64>() / 1600.0;
        assert!((mean_square - 1.0).abs() < 0.1, "{middle}: {mean_square}");
    }
}

#[test]
fn nothing_becomes_nothing() {
    for value in [0.0, 0.3, -1e6, 1e300] {
        let image = Grid::from_fn(Shape::new([20, 15]).unwrap(), |_| value);
        let mut mask = Mask::all_open(*image.shape());
        for _ in 0..2 {
            let found = normalize_contrast(&image, 3.0, &mask, &exec()).unwrap();
            assert!(found.values().iter().all(|&found| found == 0.0), "{value}");
            mask = field_of_view(&image);
        }
    }
    // Nothing is open.
    let image = waves([12, 10], [1.0; 2]);
    let walls = Mask::new(image.map(|_| false));
    let found = normalize_contrast(&image, 2.0, &walls, &exec()).unwrap();
    assert!(found.values().iter().all(|&found| found == 0.0));
}

#[test]
fn walls_are_not_seen() {
    let image = waves([40, 30], [1.0; 2]);
    let mask = field_of_view(&image);
    let found = normalize_contrast(&image, 3.0, &mask, &exec()).unwrap();
    for paint in [0.0, 1e9, -1e300] {
        let mut painted = image.clone();
        for (cell, value) in painted.values_mut().iter_mut().enumerate() {
            if !mask.is_open(cell) {
                *value = paint;
            }
        }
        assert_eq!(normalize_contrast(&painted, 3.0, &mask, &exec()).unwrap(), found);
    }
}

#[test]
fn threads_and_vectors_change_nothing() {
    let (plane, space) = (waves([67, 45], [1.0, 1.3]), waves([19, 17, 21], [1.0; 3]));
    let both = |exec: &Exec| {
        (
            normalize_contrast(&plane, 3.0, &field_of_view(&plane), exec).unwrap(),
            normalize_contrast(&space, 2.0, &field_of_view(&space), exec).unwrap(),
        )
    };
    let expected = both(&exec());
    for exec in [Exec::new(3).unwrap(), exec().with_simd(SimdLevel::Baseline)] {
        assert_eq!(both(&exec), expected);
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let image = waves([20, 15], [1.0; 2]);
    let mask = Mask::all_open(*image.shape());
    for sigma in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = normalize_contrast(&image, sigma, &mask, &exec()).unwrap_err().to_string();
        assert!(refused.starts_with("sigma is ") && refused.contains("positive"), "{refused}");
    }
    let other = Mask::all_open(Shape::new([15, 20]).unwrap());
    let refused = normalize_contrast(&image, 2.0, &other, &exec()).unwrap_err().to_string();
    assert_eq!(refused, "the mask has [15, 20] cells but the image has [20, 15]");
    let hole = image.map(|&value| if value > 0.5 { f64::NAN } else { value });
    let refused = normalize_contrast(&hole, 2.0, &mask, &exec());
    assert!(matches!(refused, Err(FilterError::NotFinite(_))));
    for after in [0.0, 0.4, 0.8] {
        let watch =
            |part| if part >= after { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let cancelled = normalize_contrast(&image, 2.0, &mask, &exec().with_watch(watch));
        assert_eq!(cancelled, Err(FilterError::Cancelled(Cancelled)));
    }
}
