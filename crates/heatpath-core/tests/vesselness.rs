//! Directions and tubes against closed forms, and what must not change them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::exec::{Cancelled, SimdLevel};
use heatpath_core::grid::filter::{
    FilterError, Measure, Polarity, Tubes, Vesselness, gaussian_gradient, hessian,
    structure_tensor, vesselness,
};
use heatpath_core::grid::medium::{
    self, Directions, MediumError, TensorOptions, VesselnessOptions,
};
use heatpath_core::grid::{Grid, Matrix, Shape, TensorField, eigen};
use proptest::prelude::*;
use std::f64::consts::{E, PI, TAU};
use std::ops::ControlFlow;

const MEASURES: [Measure; 3] = [Measure::FRANGI, Measure::Sato, Measure::OrientedFlux];

fn exec() -> Exec<'static> {
    Exec::single_threaded()
}

/// 1 inside and 0 outside, with an edge that is smooth over three cells so that it can be sampled.
fn inside(radius: f64, distance: f64) -> f64 {
    let t = ((radius - distance) / 3.0 + 0.5).clamp(0.0, 1.0);
    t - (TAU * t).sin() / TAU
}

/// By how much that edge widens a Gaussian: the variance of its derivative, a raised cosine.
fn edge_variance() -> f64 {
    9.0 * (1.0 / 12.0 - 0.5 / (PI * PI))
}

/// A tube of contrast 1 along the unit vector `along` through the middle; `radius` and `spacing` in
/// physical units.
fn tube<const D: usize>(
    size: [usize; D],
    spacing: [f64; D],
    along: [f64; D],
    radius: f64,
) -> Grid<f64, D> {
    Grid::from_fn(Shape::with_spacing(size, spacing).unwrap(), |index| {
        let from_middle: [f64; D] = std::array::from_fn(|axis| {
            (index[axis] as f64 - (size[axis] / 2) as f64) * spacing[axis]
        });
        let shadow: f64 = (0..D).map(|axis| from_middle[axis] * along[axis]).sum();
        let length_sq: f64 = from_middle.iter().map(|x| x * x).sum();
        inside(radius, (length_sq - shadow * shadow).max(0.0).sqrt())
    })
}

fn middle<const D: usize>(found: &Vesselness<D>) -> [usize; D] {
    found.response.shape().size().map(|side| side / 2)
}

fn tubes(measure: Measure, scales: &[f64]) -> Tubes {
    Tubes { measure, scales: scales.to_vec(), contrast: Some(1.0), ..Default::default() }
}

// === Derivatives

#[test]
fn derivatives_of_polynomials_are_exact() {
    let shape = Shape::with_spacing([30, 28, 26], [1.0, 2.0, 0.5]).unwrap();
    let position = |index: [usize; 3]| -> [f64; 3] {
        std::array::from_fn(|axis| (index[axis] as f64 - 13.0) * shape.spacing()[axis])
    };
    let image = Grid::from_fn(shape, |index| {
        let [x, y, z] = position(index);
        x * x * y - 0.5 * y * y + 2.0 * x * z + z * z * z + 3.0 * y + 1.0
    });
    // Derivatives are per cell unit, here half of a physical one.
    for sigma in [0.0, 0.4, 1.0, 1.4] {
        let found = hessian(&image, sigma, &exec()).unwrap();
        for index in [[13, 13, 13], [12, 14, 12], [15, 12, 14]] {
            let [x, y, z] = position(index);
            let expected = [[2.0 * y, 2.0 * x, 2.0], [2.0 * x, -1.0, 0.0], [2.0, 0.0, 6.0 * z]];
            let found = found.at(shape.position(index));
            for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                assert!((4.0 * found - expected).abs() < 1e-9, "{sigma}: {found} {expected}");
            }
        }
    }
    let parabola = Grid::from_fn(shape, |index| {
        let [x, y, z] = position(index);
        x * x - 2.0 * x * y + 4.0 * z - y
    });
    let gradient = gaussian_gradient(&parabola, 1.4, &exec()).unwrap()[[15, 12, 14]];
    let [x, y, _] = position([15, 12, 14]);
    for (found, expected) in gradient.into_iter().zip([2.0 * x - 2.0 * y, -2.0 * x - 1.0, 4.0]) {
        assert!((2.0 * found - expected).abs() < 1e-10, "{found} {expected}");
    }
}

#[test]
fn a_blurred_spot_has_the_hessian_of_the_wider_spot() {
    let (width, sigma, size) = (3.0_f64, 4.0_f64, 81);
    for spacing in [[1.0, 1.0], [2.0, 1.0]] {
        let shape = Shape::with_spacing([size, size], spacing).unwrap();
        let position = |index: [usize; 2]| -> [f64; 2] {
            std::array::from_fn(|axis| (index[axis] as f64 - 40.0) * spacing[axis])
        };
        let spot = |[x, y]: [f64; 2], variance: f64| {
            (-0.5 * (x * x + y * y) / variance).exp() * width * width / variance
        };
        let image = Grid::from_fn(shape, |index| spot(position(index), width * width));
        let found = hessian(&image, sigma, &exec()).unwrap();
        let variance = width * width + sigma * sigma;
        for cell in 0..shape.cells() {
            let [x, y] = position(shape.index(cell));
            let value = spot([x, y], variance) / variance;
            let matrix = found.at(cell);
            let expected = [
                value * (x * x / variance - 1.0),
                value * x * y / variance,
                value * (y * y / variance - 1.0),
            ];
            for (found, expected) in
                [matrix[0][0], matrix[0][1], matrix[1][1]].into_iter().zip(expected)
            {
                // What is left of the Gaussian where it is cut.
                assert!((found - expected).abs() < 2e-3 / variance, "{found} is not {expected}");
            }
        }
    }
}

#[test]
fn the_structure_tensor_of_a_ramp_and_of_a_line() {
    let shape = Shape::with_spacing([40, 40], [1.0, 2.0]).unwrap();
    let ramp = Grid::from_fn(shape, |[x, y]| 0.1 * x as f64 + 0.6 * y as f64);
    let found = structure_tensor(&ramp, 1.0, 1.0, &exec()).unwrap().at(shape.position([20, 20]));
    let expected = [[0.01, 0.03], [0.03, 0.09]];
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() < 1e-12);
    }
    // On the middle of a line the gradient is zero, but its sides agree on the direction.
    let line = tube([60, 60], [1.0; 2], [0.6, 0.8], 2.0);
    let middle = line.shape().position([30, 30]);
    let (_, vectors) = eigen(&structure_tensor(&line, 1.0, 3.0, &exec()).unwrap().at(middle));
    assert!(vectors[0][0] * 0.6 + vectors[0][1] * 0.8 > 0.9999, "{vectors:?}");
}

// === Closed forms of tubes

/// The response in the middle and its scale.
fn best<const D: usize>(image: &Grid<f64, D>, tubes: &Tubes) -> (f64, f64) {
    let found = vesselness(image, tubes, &exec()).unwrap();
    (found.response[middle(&found)], found.scale[middle(&found)])
}

/// Scales around `expected` that are 5 % apart.
fn scales_around(expected: f64) -> Vec<f64> {
    (-6..=6).map(|i| expected * 1.05_f64.powi(i)).collect()
}

#[test]
fn a_ribbon_is_strongest_at_its_half_width() {
    // sigma^2 |f''| = 2 r G_sigma(r), largest at sigma = r. The edge is part of the blur.
    for radius in [3.0_f64, 8.0] {
        let edge = 1.0 - edge_variance() / radius.powi(2);
        let (largest, at) = (2.0 / (TAU * E).sqrt() * edge, radius * edge.sqrt());
        let ribbon = tube([121, 9], [1.0; 2], [0.0, 1.0], radius);
        let (response, scale) = best(&ribbon, &tubes(Measure::Sato, &scales_around(at)));
        assert!((response / largest - 1.0).abs() < 0.01, "{radius}: {response} {largest}");
        assert!((scale / at - 1.0).abs() < 0.06, "{radius}: {scale}");
        let (response, scale) = best(&ribbon, &tubes(Measure::FRANGI, &scales_around(at)));
        let expected = 1.0 - (-0.5 * largest * largest).exp();
        assert!((response / expected - 1.0).abs() < 0.02, "{radius}: {response}");
        assert!((scale / at - 1.0).abs() < 0.06, "{radius}: {scale}");
    }
}

#[test]
fn a_cylinder_is_strongest_at_its_radius_over_root_2() {
    // Each eigenvalue times sigma^2 is r^2 / (2 sigma^2) exp(-r^2 / (2 sigma^2)).
    for radius in [3.0_f64, 5.0] {
        let edge = 1.0 - 2.0 * edge_variance() / radius.powi(2);
        let (largest, at) = (edge / E, radius * (0.5 * edge).sqrt());
        let cylinder = tube([45, 45, 4], [1.0; 3], [0.0, 0.0, 1.0], radius);
        let (response, scale) = best(&cylinder, &tubes(Measure::Sato, &scales_around(at)));
        assert!((response / largest - 1.0).abs() < 0.02, "{radius}: {response} {largest}");
        assert!((scale / at - 1.0).abs() < 0.06, "{radius}: {scale}");
        let (response, scale) = best(&cylinder, &tubes(Measure::FRANGI, &scales_around(at)));
        let strong = (1.0 - (-2.0_f64).exp()) * (1.0 - (-largest * largest).exp());
        assert!((response / strong - 1.0).abs() < 0.03, "{radius}: {response} {strong}");
        assert!((scale / at - 1.0).abs() < 0.06, "{radius}: {scale}");
    }
}

/// The mean flux of the gradient of a ribbon, smoothed by one cell and its edge, into a circle in its
/// middle.
fn ribbon_flux(half_width: f64, radius: f64) -> f64 {
    let variance = 1.0 + edge_variance();
    let gaussian = |x: f64| (-0.5 * x * x / variance).exp() / (TAU * variance).sqrt();
    let steps = 2000;
    let flux = |i: usize| {
        let cos = (TAU * i as f64 / steps as f64).cos();
        cos * (gaussian(radius * cos - half_width) - gaussian(radius * cos + half_width))
    };
    (0..steps).map(flux).sum::<f64>() / steps as f64
}

#[test]
fn flux_is_strongest_where_the_circle_touches_both_sides() {
    for half_width in [4.0, 8.0] {
        let ribbon = tube([121, 9], [1.0; 2], [0.0, 1.0], half_width);
        let scales = scales_around(1.05 * half_width);
        for &scale in &scales {
            let (response, _) = best(&ribbon, &tubes(Measure::OrientedFlux, &[scale]));
            let expected = ribbon_flux(half_width, scale);
            assert!((response / expected - 1.0).abs() < 0.012, "{scale}: {response} {expected}");
        }
        let (_, scale) = best(&ribbon, &tubes(Measure::OrientedFlux, &scales));
        assert!(scale >= half_width && scale < half_width + 1.0, "{half_width}: {scale}");
    }
    let cylinder = tube([45, 45, 4], [1.0; 3], [0.0, 0.0, 1.0], 5.0);
    let (_, scale) = best(&cylinder, &tubes(Measure::OrientedFlux, &scales_around(5.2)));
    assert!((5.0..6.0).contains(&scale), "{scale}");
}

/// The Bessel function J1.
fn bessel_1(x: f64) -> f64 {
    let steps = 200;
    let at = |i: usize| (i as f64 + 0.5) * PI / steps as f64;
    (0..steps).map(|i| (at(i) - x * at(i).sin()).cos()).sum::<f64>() / steps as f64
}

#[test]
fn flux_of_waves() {
    // On a crest of cos(k x) the flux matrix is -k J1(k r) in a picture and
    // -(sin(k r) - k r cos(k r)) / (k r^2) in a volume, times the Gaussian exp(-k^2 / 2).
    let k = TAU / 16.0;
    let wave = |i: usize| (k * (i as f64 - 24.0)).cos();
    let plane = Grid::from_fn(Shape::new([48, 6]).unwrap(), |[x, _]| wave(x));
    let space = Grid::from_fn(Shape::new([48, 6, 48]).unwrap(), |[x, _, z]| wave(x) + wave(z));
    for radius in [1.5, 3.0, 4.7] {
        let kr = k * radius;
        let smoothed = (-0.5 * k * k).exp();
        let tubes = tubes(Measure::OrientedFlux, &[radius]);
        let found = vesselness(&plane, &tubes, &exec()).unwrap().response[[24, 3]];
        let expected = k * bessel_1(kr) * smoothed;
        assert!((found / expected - 1.0).abs() < 2e-3, "plane, {radius}: {found} {expected}");
        let found = vesselness(&space, &tubes, &exec()).unwrap().response[[24, 3, 24]];
        let expected = (kr.sin() - kr * kr.cos()) / (kr * radius) * smoothed;
        assert!((found / expected - 1.0).abs() < 2e-3, "space, {radius}: {found} {expected}");
    }
}

// === What must not change the response

#[test]
fn thick_and_thin_tubes_respond_alike() {
    let shape = Shape::new([160, 12]).unwrap();
    let image = Grid::from_fn(shape, |[x, _]| {
        inside(4.0, (x as f64 - 40.0).abs()) + inside(8.0, (x as f64 - 110.0).abs())
    });
    for measure in [Measure::FRANGI, Measure::Sato] {
        let tubes = Tubes { contrast: None, ..tubes(measure, &[2.0, 3.0, 4.0, 6.0, 8.0]) };
        let found = vesselness(&image, &tubes, &exec()).unwrap();
        let (thin, thick) = (found.response[[40, 6]], found.response[[110, 6]]);
        assert!((thin / thick - 1.0).abs() < 0.02, "{measure:?}: {thin} {thick}");
        assert_eq!((found.scale[[40, 6]], found.scale[[110, 6]]), (4.0, 8.0));
    }
}

#[test]
fn every_direction_responds_alike() {
    let mut of_direction = MEASURES.map(|_| Vec::new());
    for degrees in [0.0_f64, 10.0, 22.5, 45.0, 71.0, 90.0] {
        let along = [degrees.to_radians().cos(), degrees.to_radians().sin()];
        let ribbon = tube([71, 71], [1.0; 2], along, 3.5);
        for (measure, responses) in MEASURES.into_iter().zip(&mut of_direction) {
            let found = vesselness(&ribbon, &tubes(measure, &[3.5]), &exec()).unwrap();
            let direction = found.direction[[35, 35]];
            let cos = direction[0] * along[0] + direction[1] * along[1];
            assert!(cos.abs() > 0.999_99, "{measure:?} at {degrees} degrees: {direction:?}");
            responses.push(found.response[[35, 35]]);
        }
    }
    for (measure, responses) in MEASURES.into_iter().zip(of_direction) {
        let all = responses.iter().map(|response| (response / responses[0] - 1.0).abs());
        assert!(all.fold(0.0, f64::max) < 4e-3, "{measure:?}: {responses:?}");
    }
}

#[test]
fn every_direction_and_spacing_in_space_responds_alike() {
    for measure in MEASURES {
        let mut responses = Vec::new();
        for (size, spacing) in [([33, 33, 33], [1.0; 3]), ([33, 33, 23], [1.0, 1.0, 1.5])] {
            for along in [[0.0, 0.0, 1.0], [0.0, 0.8, 0.6], [0.48, 0.6, 0.64]] {
                let cylinder = tube(size, spacing, along, 4.0);
                let found = vesselness(&cylinder, &tubes(measure, &[3.0]), &exec()).unwrap();
                let direction = found.direction[middle(&found)];
                let cos: f64 = (0..3).map(|axis| direction[axis] * along[axis]).sum();
                assert!(cos > 0.9999, "{measure:?} {spacing:?} {along:?}: {direction:?}");
                responses.push(found.response[middle(&found)]);
            }
        }
        let all = responses.iter().map(|response| (response / responses[0] - 1.0).abs());
        assert!(all.fold(0.0, f64::max) < 0.025, "{measure:?}: {responses:?}");
    }
}

/// A picture with structure of many widths and both polarities.
fn picture(shape: Shape<2>) -> Grid<f64, 2> {
    Grid::from_fn(shape, |[x, y]| {
        let (x, y) = (x as f64, y as f64);
        0.5 + 0.2 * (0.31 * x + 0.13 * y).sin() + 0.2 * (0.15 * x - 0.47 * y + 1.0).cos()
    })
}

/// The largest difference of two fields.
fn difference<const D: usize>(a: &Grid<f64, D>, b: &Grid<f64, D>) -> f64 {
    a.values().iter().zip(b.values()).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

#[test]
fn contrast_unit_and_polarity_do_not_matter() {
    let image = picture(Shape::new([50, 40]).unwrap());
    for measure in MEASURES {
        let bright = Tubes { contrast: None, ..tubes(measure, &[1.0, 2.0, 4.0]) };
        let dark = Tubes { polarity: Polarity::Dark, ..bright.clone() };
        let both = Tubes { polarity: Polarity::Both, ..bright.clone() };
        let found = vesselness(&image, &bright, &exec()).unwrap();
        assert!(found.response.values().iter().any(|&v| v > 0.3));

        let paler = image.map(|value| 0.05 * value + 0.7);
        let paler = vesselness(&paler, &bright, &exec()).unwrap();
        assert!(difference(&found.response, &paler.response) < 1e-9, "{measure:?}");

        let micrometres = Shape::with_spacing([50, 40], [1e-6; 2]).unwrap();
        let small = Grid::from_values(micrometres, image.values().to_vec()).unwrap();
        let small = vesselness(&small, &bright, &exec()).unwrap();
        assert!(difference(&found.response, &small.response) < 1e-12, "{measure:?}");

        let negative = vesselness(&image.map(|value| -value), &dark, &exec()).unwrap();
        assert_eq!(found, negative, "{measure:?}");
        let dark = vesselness(&image, &dark, &exec()).unwrap();
        let both = vesselness(&image, &both, &exec()).unwrap();
        let ratio = |one: &Vesselness<2>| {
            let pairs = one.response.values().iter().zip(both.response.values());
            pairs.map(|(one, both)| one / both).filter(|x| x.is_finite()).fold(0.0, f64::max)
        };
        // Each is over its own largest strength.
        assert!(ratio(&found) >= 1.0 - 1e-12 && ratio(&dark) >= 1.0 - 1e-12);
    }
}

#[test]
fn nothing_is_found_where_nothing_is() {
    for value in [0.0, 0.7, -1e6] {
        let plane = Grid::from_fn(Shape::new([30, 20]).unwrap(), |_| value);
        let space = Grid::from_fn(Shape::new([12, 9, 8]).unwrap(), |_| value);
        for measure in MEASURES {
            for contrast in [None, Some(1e-30)] {
                let tubes = Tubes { contrast, ..tubes(measure, &[1.0, 2.0]) };
                let found = vesselness(&plane, &tubes, &exec()).unwrap();
                assert!(found.response.values().iter().all(|&v| v == 0.0), "{measure:?} {value}");
                assert!(found.scale.values().iter().all(|&v| v == 0.0));
                let found = vesselness(&space, &tubes, &exec()).unwrap();
                assert!(found.response.values().iter().all(|&v| v == 0.0), "{measure:?} {value}");
            }
        }
    }
}

#[test]
fn one_slice_is_a_picture_without_end() {
    let plane = picture(Shape::new([40, 30]).unwrap());
    let slice =
        Grid::from_values(Shape::new([40, 30, 1]).unwrap(), plane.values().to_vec()).unwrap();
    let (flat, deep) =
        (hessian(&plane, 1.5, &exec()).unwrap(), hessian(&slice, 1.5, &exec()).unwrap());
    for cell in 0..plane.shape().cells() {
        let (flat, deep) = (flat.at(cell), deep.at(cell));
        assert!((0..2).all(|i| (0..2).all(|j| (flat[i][j] - deep[i][j]).abs() < 1e-14)));
        assert!((0..3).all(|i| deep[i][2].abs() < 1e-14));
    }
    let cell = Grid::from_values(Shape::new([1, 1]).unwrap(), vec![0.4]).unwrap();
    for measure in MEASURES {
        let found = vesselness(&cell, &tubes(measure, &[1.0]), &exec()).unwrap();
        assert_eq!(found.response[[0, 0]], 0.0);
    }
}

#[test]
fn threads_and_vectors_change_nothing() {
    let image = picture(Shape::with_spacing([67, 45], [1.0, 1.3]).unwrap());
    let space = Grid::from_fn(Shape::new([19, 17, 21]).unwrap(), |[x, y, z]| {
        (0.7 * x as f64).sin() + (0.5 * y as f64 + 0.3 * z as f64).cos()
    });
    let all = |exec: &Exec| {
        let found = MEASURES.map(|measure| {
            let tubes = Tubes { contrast: None, ..tubes(measure, &[1.0, 2.5]) };
            (vesselness(&image, &tubes, exec).unwrap(), vesselness(&space, &tubes, exec).unwrap())
        });
        let tensors = (
            hessian(&space, 1.2, exec).unwrap(),
            structure_tensor(&image, 1.0, 2.0, exec).unwrap(),
        );
        (found, tensors)
    };
    let expected = all(&exec());
    for exec in [Exec::new(3).unwrap(), exec().with_simd(SimdLevel::Baseline)] {
        assert_eq!(all(&exec), expected);
    }
}

#[test]
fn a_search_can_be_cancelled() {
    let image = picture(Shape::new([60, 60]).unwrap());
    for after in [0.0, 0.2, 0.6] {
        let watch =
            |part| if part >= after { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let exec = exec().with_watch(watch);
        for measure in MEASURES {
            let tubes = Tubes { contrast: None, ..tubes(measure, &[1.0, 2.0]) };
            let found = vesselness(&image, &tubes, &exec);
            assert_eq!(found, Err(FilterError::Cancelled(Cancelled)));
        }
        let medium = medium::tensor(&image, TensorOptions::default(), &exec);
        assert!(after > 0.0 || matches!(medium, Err(MediumError::Cancelled(_))));
    }
}

#[test]
fn parameters_out_of_range_are_named() {
    let image = picture(Shape::new([20, 10]).unwrap());
    let refused = |tubes: Tubes| vesselness(&image, &tubes, &exec()).unwrap_err().to_string();
    let with_scales = |scales: &[f64]| refused(tubes(Measure::Sato, scales));
    let range = "it must be positive and at most 100 cells";
    for (scale, written) in [(0.0, "0"), (-2.0, "-2"), (100.5, "100.5"), (f64::NAN, "NaN")] {
        assert_eq!(with_scales(&[1.0, scale]), format!("scale is {written}; {range}"));
    }
    assert_eq!(with_scales(&[]), "number of scales is 0; it must be at least 1");
    let contrast = Some(0.0);
    let tubes_of_no_contrast = Tubes { contrast, ..Default::default() };
    assert_eq!(refused(tubes_of_no_contrast), "contrast is 0; it must be a positive finite number");
    let measure = Measure::Frangi { alpha: 0.5, beta: f64::INFINITY };
    assert!(refused(Tubes { measure, ..Default::default() }).starts_with("beta is inf"));
    let hole = image.map(|&value| if value > 0.8 { f64::NAN } else { value });
    assert!(matches!(hessian(&hole, 1.0, &exec()), Err(FilterError::NotFinite(_))));
    assert!(matches!(hessian(&image, -1.0, &exec()), Err(FilterError::Sigma(_))));
    assert!(matches!(structure_tensor(&image, 1.0, -1.0, &exec()), Err(FilterError::Sigma(_))));
}

// === Media

/// The diffusion tensors of a medium.
fn field<const D: usize>(medium: &medium::Medium<D>) -> &TensorField<D> {
    medium.diffusion().tensor().unwrap()
}

#[test]
fn a_gaussian_image_turns_heat_around_its_middle() {
    // Figure 5: e1 is radial.
    let image = Grid::from_fn(Shape::new([61, 61]).unwrap(), |[x, y]| {
        (-((x as f64 - 30.0).powi(2) + (y as f64 - 30.0).powi(2)) / 400.0).exp()
    });
    let directions = Directions::Gradient { sigma: 1.0 };
    let options = TensorOptions { directions, anisotropy: 0.8, ..Default::default() };
    let medium = medium::tensor(&image, options, &exec()).unwrap();
    for index in [[45, 30], [40, 40], [20, 33]] {
        let (values, vectors) = eigen(&field(&medium).at(image.shape().position(index)));
        assert!((values[0] - 1.0 / 9.0).abs() < 1e-12 && (values[1] - 1.0).abs() < 1e-12);
        let radial = [index[0] as f64 - 30.0, index[1] as f64 - 30.0];
        let cos =
            (vectors[0][0] * radial[0] + vectors[0][1] * radial[1]) / radial[0].hypot(radial[1]);
        assert!(cos.abs() > 0.9999, "{index:?}: {vectors:?}");
    }
    let top = field(&medium).at(image.shape().position([30, 30]));
    assert_eq!(top, [[1.0, 0.0], [0.0, 1.0]], "no direction there");
}

#[test]
fn heat_runs_along_tubes() {
    let along = [0.48, 0.6, 0.64];
    let cylinder = tube([33, 33, 33], [1.0; 3], along, 3.0);
    let middle = cylinder.shape().position([16; 3]);
    for directions in [
        Directions::Hessian { sigma: 2.0, polarity: Polarity::Bright },
        Directions::Structure { sigma: 1.0, rho: 3.0 },
    ] {
        let options = TensorOptions { directions, ..Default::default() };
        let medium = medium::tensor(&cylinder, options, &exec()).unwrap();
        let (values, vectors) = eigen(&field(&medium).at(middle));
        let across = 0.1 / 1.9;
        for (value, expected) in values.into_iter().zip([across, across, 1.0]) {
            assert!((value - expected).abs() < 1e-12, "{values:?}");
        }
        let cos: f64 = (0..3).map(|axis| vectors[2][axis] * along[axis]).sum();
        assert!(cos > 0.999, "{directions:?}: {vectors:?}");
    }
    let directions = Directions::Hessian { sigma: 2.0, polarity: Polarity::Dark };
    let options = TensorOptions { directions, ..Default::default() };
    let medium = medium::tensor(&cylinder, options, &exec()).unwrap();
    assert_eq!(field(&medium).at(middle), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
}

#[test]
fn directions_fade_if_asked() {
    let ribbon = tube([60, 41], [1.0; 2], [1.0, 0.0], 3.0);
    let weak_noise = |[x, y]: [usize; 2]| 1e-3 * f64::from((x * 7 + y * 13) as u32 % 11);
    let image = Grid::from_fn(*ribbon.shape(), |index| ribbon[index] + weak_noise(index));
    let anisotropy_at = |fading, index| {
        let options = TensorOptions { fading, ..Default::default() };
        let medium = medium::tensor(&image, options, &exec()).unwrap();
        let (values, _) = eigen(&field(&medium).at(image.shape().position(index)));
        (values[1] - values[0]) / (values[1] + values[0])
    };
    let (line, flat) = ([30, 20], [30, 2]);
    assert!((anisotropy_at(false, line) - 0.9).abs() < 1e-12);
    assert!((anisotropy_at(false, flat) - 0.9).abs() < 1e-12);
    assert!(anisotropy_at(true, line) > 0.7);
    assert!(anisotropy_at(true, flat) < 0.01);
}

#[test]
fn constants_give_isotropic_media() {
    let image = Grid::from_fn(Shape::new([20, 15]).unwrap(), |_| 0.3);
    for directions in [
        Directions::Gradient { sigma: 1.0 },
        Directions::default(),
        Directions::Structure { sigma: 1.0, rho: 2.0 },
    ] {
        for fading in [false, true] {
            let options = TensorOptions { directions, fading, ..Default::default() };
            let medium = medium::tensor(&image, options, &exec()).unwrap();
            let isotropic = |cell| field(&medium).at(cell) == [[1.0, 0.0], [0.0, 1.0]];
            assert!((0..image.shape().cells()).all(isotropic));
        }
    }
    let options = VesselnessOptions::default();
    let medium = medium::vesselness(&image, &options, &exec()).unwrap();
    assert!((0..image.shape().cells()).all(|cell| medium.speed_sq(cell) == options.floor));
}

/// Checks that a medium is positive definite, with the given smallest eigenvalue.
fn check_definite<const D: usize>(medium: &medium::Medium<D>, smallest: f64) -> Result<(), String> {
    medium::given_tensor(field(medium).clone()).map_err(|error| error.to_string())?;
    let values = |matrix: &Matrix<D>| eigen(matrix).0;
    for cell in 0..medium.shape().cells() {
        let values = values(&field(medium).at(cell));
        if values[0] < smallest * (1.0 - 1e-9) || values[D - 1] > 1.0 + 1e-12 {
            return Err(format!("{values:?}"));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn media_of_noise_are_positive_definite(
        noise in proptest::collection::vec(0.0..1.0, 6 * 7 * 5),
        anisotropy in prop::sample::select(vec![0.0, 0.5, 0.99, medium::MOST_ANISOTROPY]),
    ) {
        let space = Grid::from_values(Shape::new([6, 7, 5]).unwrap(), noise.clone()).unwrap();
        let plane = Grid::from_values(Shape::new([14, 15]).unwrap(), noise).unwrap();
        let across = (1.0 - anisotropy) / (1.0 + anisotropy);
        for directions in [
            Directions::Gradient { sigma: 0.0 },
            Directions::Hessian { sigma: 1.0, polarity: Polarity::Bright },
            Directions::Structure { sigma: 0.5, rho: 1.0 },
        ] {
            let options = TensorOptions { directions, anisotropy, fading: anisotropy == 0.99 };
            let medium = medium::tensor(&space, options, &exec()).unwrap();
            prop_assert_eq!(check_definite(&medium, across), Ok(()));
            let medium = medium::tensor(&plane, options, &exec()).unwrap();
            prop_assert_eq!(check_definite(&medium, across), Ok(()));
        }
        for measure in MEASURES {
            let tubes = Tubes { contrast: None, ..tubes(measure, &[1.0, 2.0]) };
            let found = vesselness(&space, &tubes, &exec()).unwrap();
            prop_assert!(found.response.values().iter().all(|v| (0.0..=1.0).contains(v)));
            let options = VesselnessOptions { tubes, anisotropy, ..Default::default() };
            if anisotropy > 0.0 {
                let medium = medium::vesselness(&plane, &options, &exec()).unwrap();
                prop_assert_eq!(check_definite(&medium, across), Ok(()));
            }
        }
    }
}
