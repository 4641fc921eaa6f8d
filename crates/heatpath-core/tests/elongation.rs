//! Elongated tubes against closed forms and direct sums, and what must not change them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::exec::{Cancelled, SimdLevel};
use heatpath_core::grid::filter::{FilterError, Measure, Polarity, Tubes, Vesselness, vesselness};
use heatpath_core::grid::{Grid, Shape};
use std::f64::consts::TAU;
use std::ops::ControlFlow;

const MEASURES: [Measure; 3] = [Measure::FRANGI, Measure::Sato, Measure::OrientedFlux];

fn exec() -> Exec<'static> {
    Exec::single_threaded()
}

fn tubes(measure: Measure, scale: f64, elongation: f64) -> Tubes {
    let scales = vec![scale];
    Tubes { measure, scales, elongation, contrast: Some(1.0), ..Default::default() }
}

fn find<const D: usize>(image: &Grid<f64, D>, tubes: &Tubes) -> Vesselness<D> {
    vesselness(image, tubes, &exec()).unwrap()
}

/// A line along `along` through the middle whose profile is a Gaussian of standard deviation `width`.
fn line<const D: usize>(
    size: [usize; D],
    spacing: [f64; D],
    along: [f64; D],
    width: f64,
) -> Grid<f64, D> {
    let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
    Grid::from_fn(Shape::with_spacing(size, spacing).unwrap(), |index| {
        let offset: [f64; D] = std::array::from_fn(|axis| {
            (index[axis] as f64 - (size[axis] / 2) as f64) * spacing[axis]
        });
        let shadow: f64 = (0..D).map(|axis| offset[axis] * along[axis] / length).sum();
        let distance_sq = offset.iter().map(|x| x * x).sum::<f64>() - shadow * shadow;
        (-0.5 * distance_sq / (width * width)).exp()
    })
}

fn in_the_middle<const D: usize>(image: &Grid<f64, D>, tubes: &Tubes) -> f64 {
    find(image, tubes).response[image.shape().size().map(|side| side / 2)]
}

/// White noise.
fn noise<const D: usize>(shape: Shape<D>) -> Grid<f64, D> {
    let mut state = 7_u64;
    Grid::from_fn(shape, |_| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    })
}

#[test]
fn a_long_line_responds_as_before() {
    for measure in MEASURES {
        let along_an_axis = line([161, 61], [1.0; 2], [1.0, 0.0], 3.0);
        let plain = in_the_middle(&along_an_axis, &tubes(measure, 3.0, 1.0));
        for elongation in [1.2, 2.0, 3.0, 5.0] {
            let long = in_the_middle(&along_an_axis, &tubes(measure, 3.0, elongation));
            assert!((long / plain - 1.0).abs() < 1e-9, "{measure:?} {elongation}: {long} {plain}");
        }
        for along in [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]] {
            let size = along.map(|x| if x > 0.0 { 80 } else { 30 });
            let image = line(size, [1.0; 3], along, 1.5);
            let plain = in_the_middle(&image, &tubes(measure, 2.0, 1.0));
            let long = in_the_middle(&image, &tubes(measure, 2.0, 3.0));
            assert!((long / plain - 1.0).abs() < 1e-9, "{measure:?} {along:?}: {long} {plain}");
        }
    }
}

/// Sato's response to a line of width `width` that is `angle` off the direction of the nearest
/// Gaussian: that widens the line as seen along the Gaussian, whose second derivative is projected.
fn off_by(angle: f64, width: f64, scale: f64, elongation: f64) -> f64 {
    let stretch = (elongation * elongation - 1.0) * angle.sin().powi(2);
    let variance = width * width + scale * scale * (1.0 + stretch);
    let curvature = scale * scale * width / variance.powf(1.5);
    let (across, along) = (curvature * angle.cos().powi(2), curvature * angle.sin().powi(2));
    across * (-0.5 * (along / (0.5 * across)).powi(2)).exp()
}

#[test]
fn all_angles_respond_nearly_alike() {
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for step in 0..48 {
        let degrees = 3.75 * f64::from(step);
        let (sin, cos) = degrees.to_radians().sin_cos();
        let image = line([141, 141], [1.0, 1.0], [cos, sin], 3.0);
        let off = (degrees / 15.0 - (degrees / 15.0).round()) * 15.0;
        let found = find(&image, &tubes(Measure::Sato, 3.0, 3.0));
        let response = found.response[[70, 70]];
        let expected = off_by(off.to_radians(), 3.0, 3.0, 3.0);
        // The line is cut, and its samples are at whole cells.
        assert!((response / expected - 1.0).abs() < 0.04, "{degrees}: {response} {expected}");
        let [x, y] = found.direction[[70, 70]];
        assert!((x * cos + y * sin).abs() > 7.6_f64.to_radians().cos(), "{degrees}: {x} {y}");
        (least, most) = (least.min(response), most.max(response));
    }
    assert!(least / most > 0.88, "{least} {most}");
}

#[test]
fn the_49_directions_of_a_volume() {
    let response = |image: &Grid<f64, 3>, elongation| {
        in_the_middle(image, &tubes(Measure::Sato, 2.0, elongation))
    };
    let part = |along: [f64; 3]| {
        let image = line([61; 3], [1.0; 3], along, 2.0);
        response(&image, 3.0) / response(&image, 1.0)
    };
    for along in [[2.0, 1.0, 1.0], [0.0, 1.0, -2.0], [2.0, -1.0, 2.0], [1.0, 1.0, 1.0]] {
        assert!((part(along) - 1.0).abs() < 0.07, "{along:?}: {}", part(along));
    }
    // As far from all directions as can be, 17.7 degrees: the Gaussian widens the line on one side.
    let off = 17.65_f64.to_radians();
    let stretch = 1.0 / (1.0 + 4.0 * off.sin().powi(2));
    let expected = stretch.powf(1.5) * off.cos().powi(2);
    let found = part([0.2134, 0.2361, 1.0]);
    assert!((found / expected - 1.0).abs() < 0.1, "{found} {expected}");
}

#[test]
fn noise_is_suppressed() {
    let image = noise(Shape::new([200, 200]).unwrap());
    let strong = |elongation| {
        let mut responses =
            find(&image, &tubes(Measure::Sato, 2.0, elongation)).response.into_values();
        responses.sort_by(f64::total_cmp);
        responses[responses.len() * 99 / 100]
    };
    let plain = strong(1.0);
    // One direction leaves 1 / sqrt(elongation) of the noise; the largest of twelve is more.
    for elongation in [2.0, 3.0, 5.0] {
        let part = strong(elongation) / plain;
        let one = 1.0 / elongation.sqrt();
        assert!(part > one && part < 1.25 * one, "{elongation}: {part}");
    }
}

/// Sato's response in one cell by the sum over all cells of the elongated Gaussian's derivatives.
fn direct(image: &Grid<f64, 2>, [x, y]: [usize; 2], scale: f64, elongation: f64) -> f64 {
    let long_sq = (scale * elongation).powi(2);
    let response = |step: i32| {
        let (sin, cos) = (f64::from(step) * TAU / 24.0).sin_cos();
        let (mut across, mut along) = (0.0, 0.0);
        for cell in 0..image.shape().cells() {
            let [i, j] = image.shape().index(cell);
            let (dx, dy) = (i as f64 - x as f64, j as f64 - y as f64);
            let (u, v) = (dx * cos + dy * sin, dy * cos - dx * sin);
            let exponent = -0.5 * (u * u / long_sq + v * v / (scale * scale));
            let weight = image.values()[cell] * exponent.exp() / (TAU * scale * scale * elongation);
            across += weight * (v * v / (scale * scale) - 1.0);
            along += weight * (u * u / long_sq - 1.0) * scale * scale / long_sq;
        }
        let tolerance = if along > 0.0 { 2.0 } else { 0.5 };
        if across < 0.0 {
            -across * (-0.5 * (along / (tolerance * across)).powi(2)).exp()
        } else {
            0.0
        }
    };
    (0..12).map(response).fold(0.0, f64::max)
}

#[test]
fn direct_sums_say_the_same() {
    let image = noise(Shape::new([90, 90]).unwrap());
    for (scale, elongation, tolerance) in [(2.0, 3.0, 0.05), (4.0, 2.0, 0.03)] {
        let found = find(&image, &tubes(Measure::Sato, scale, elongation)).response;
        let largest = found.values().iter().copied().fold(0.0, f64::max);
        for cell in [[45, 45], [41, 47], [50, 38], [43, 52], [37, 37], [48, 44]] {
            let expected = direct(&image, cell, scale, elongation);
            let error = (found[cell] - expected).abs() / largest;
            assert!(error < tolerance, "{cell:?}: {} {expected}", found[cell]);
        }
    }
}

/// The image with its mirror images, twice as large along each axis.
fn doubled<const D: usize>(image: &Grid<f64, D>) -> Grid<f64, D> {
    let size = image.shape().size();
    let shape = Shape::with_spacing(size.map(|side| 2 * side), image.shape().spacing()).unwrap();
    Grid::from_fn(shape, |index| {
        image[std::array::from_fn(|axis| index[axis].min(2 * size[axis] - 1 - index[axis]))]
    })
}

fn check_mirrors<const D: usize>(image: &Grid<f64, D>) {
    for measure in MEASURES {
        let tubes = tubes(measure, 1.5, 3.0);
        let (found, wide) = (find(image, &tubes), find(&doubled(image), &tubes));
        for (cell, &response) in found.response.values().iter().enumerate() {
            let index = image.shape().index(cell);
            let error = (wide.response[index] - response).abs();
            assert!(error < 1e-12, "{measure:?} {index:?}: {response} {}", wide.response[index]);
        }
    }
}

#[test]
fn borders_are_mirrors() {
    check_mirrors(&noise(Shape::with_spacing([24, 19], [1.0, 1.5]).unwrap()));
    check_mirrors(&noise(Shape::with_spacing([9, 8, 7], [1.0, 1.5, 1.0]).unwrap()));
}

#[test]
fn turns_and_flips_change_nothing() {
    let image = noise(Shape::new([40, 40]).unwrap());
    let views: [fn([usize; 2]) -> [usize; 2]; 3] =
        [|[x, y]| [39 - y, x], |[x, y]| [39 - x, y], |[x, y]| [y, x]];
    // The flux measures its ball exactly along x, but line by line along y.
    for measure in [Measure::FRANGI, Measure::Sato] {
        let tubes = tubes(measure, 2.0, 3.0);
        let found = find(&image, &tubes).response;
        for view in views {
            let other = find(&Grid::from_fn(*image.shape(), |index| image[view(index)]), &tubes);
            for cell in 0..1600 {
                let index = image.shape().index(cell);
                let error = (other.response[index] - found[view(index)]).abs();
                assert!(error < 1e-12, "{measure:?} {index:?}: {error}");
            }
        }
    }
}

#[test]
fn contrast_and_polarity_do_not_matter() {
    let image = noise(Shape::new([40, 30]).unwrap());
    for measure in MEASURES {
        let bright = Tubes { contrast: None, ..tubes(measure, 2.0, 2.5) };
        let dark = Tubes { polarity: Polarity::Dark, ..bright.clone() };
        let found = find(&image, &bright);
        assert_eq!(find(&image.map(|value| -value), &dark), found);
        let paler = find(&image.map(|value| 0.05 * value + 0.7), &bright);
        let pairs = paler.response.values().iter().zip(found.response.values());
        assert!(pairs.into_iter().all(|(paler, found)| (paler - found).abs() < 1e-9));
        let flat = find(&image.map(|_| 0.7), &bright);
        assert!(flat.response.values().iter().all(|&response| response == 0.0));
    }
}

#[test]
fn threads_and_vectors_change_nothing() {
    let plane = noise(Shape::with_spacing([67, 45], [1.0, 1.3]).unwrap());
    let space = noise(Shape::new([19, 12, 14]).unwrap());
    let all = |exec: &Exec| {
        MEASURES.map(|measure| {
            let tubes = Tubes { scales: vec![1.0, 2.5], ..tubes(measure, 2.0, 3.0) };
            (vesselness(&plane, &tubes, exec).unwrap(), vesselness(&space, &tubes, exec).unwrap())
        })
    };
    let expected = all(&exec());
    for exec in [Exec::new(3).unwrap(), exec().with_simd(SimdLevel::Baseline)] {
        assert_eq!(all(&exec), expected);
    }
}

#[test]
fn elongations_out_of_range_are_named() {
    let image = noise(Shape::new([20, 10]).unwrap());
    for (elongation, written) in [(0.9, "0.9"), (10.5, "10.5"), (f64::NAN, "NaN")] {
        let refused = vesselness(&image, &tubes(Measure::Sato, 2.0, elongation), &exec());
        let expected = format!("elongation is {written}; it must be from 1 to 10");
        assert_eq!(refused.unwrap_err().to_string(), expected);
    }
    for after in [0.2, 0.6] {
        let watch =
            |part| if part >= after { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let exec = exec().with_watch(watch);
        let cancelled = vesselness(&image, &tubes(Measure::Sato, 2.0, 3.0), &exec);
        assert_eq!(cancelled, Err(FilterError::Cancelled(Cancelled)));
    }
    let cell = noise(Shape::new([1, 1]).unwrap());
    assert_eq!(find(&cell, &tubes(Measure::Sato, 100.0, 10.0)).response[[0, 0]], 0.0);
}
