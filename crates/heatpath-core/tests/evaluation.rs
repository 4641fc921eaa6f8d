//! Recall and precision of curves against what geometry says.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::evaluation::{CurveSet, Evaluation, EvaluationError, evaluate};
use heatpath_core::grid::{Grid, Mask, Shape};
use proptest::prelude::*;
use std::f64::consts::TAU;

const TOLERANCES: [f64; 5] = [0.0, 0.5, 1.0, 2.0, 3.5];

fn set<const D: usize>(polylines: &[Vec<[f64; D]>]) -> CurveSet<D> {
    CurveSet::of_polylines(polylines, [1.0; D]).unwrap()
}

fn compared<const D: usize>(extracted: &CurveSet<D>, truth: &CurveSet<D>) -> Evaluation {
    evaluate(extracted, truth, &TOLERANCES, None).unwrap()
}

fn circle(radius: f64) -> Vec<[f64; 2]> {
    let at = |i: usize| TAU * i as f64 / 720.0;
    (0..=720).map(|i| [radius * at(i).cos(), radius * at(i).sin()]).collect()
}

#[test]
fn lines_that_cross_agree_near_the_crossing() {
    // At the angle a, the stretch within t of the other line is 2 t / sin a.
    let angle: f64 = 0.4;
    let direction = [angle.cos(), angle.sin()];
    let (flat, steep) = (
        set(&[vec![[-20.0, 0.0], [20.0, 0.0]]]),
        set(&[vec![direction.map(|x| -20.0 * x), direction.map(|x| 20.0 * x)]]),
    );
    for score in compared(&flat, &steep).scores {
        let exact = 2.0 * score.tolerance / angle.sin() / 40.0;
        assert!((score.recall - exact).abs() < 2.0 * 0.25 / 40.0, "{score:?}: {exact}");
        assert!((score.precision - exact).abs() < 2.0 * 0.25 / 40.0, "{score:?}: {exact}");
        assert!((score.truth_length - 40.0).abs() < 1e-12);
    }
}

#[test]
fn circles_in_one_another() {
    let evaluation = compared(&set(&[circle(11.0)]), &set(&[circle(10.0)]));
    assert_eq!(evaluation.scores[1].recall, 0.0);
    assert_eq!(evaluation.scores[3].precision, 1.0);
    assert!((evaluation.scores[0].truth_length - TAU * 10.0).abs() < 1e-2);
    assert!((evaluation.scores[0].extracted_length - TAU * 11.0).abs() < 1e-2);
    assert!((evaluation.truth_to_extracted.mean - 1.0).abs() < 1e-3);
    assert!((evaluation.extracted_to_truth.largest - 1.0).abs() < 1e-3);
}

#[test]
fn distances_are_physical_in_volumes_too() {
    let spacing = [0.5, 1.0, 3.0];
    let line = |z: f64| vec![vec![[0.0, 4.0, z], [40.0, 4.0, z]]];
    let truth = CurveSet::of_polylines(&line(2.0), spacing).unwrap();
    let found = CurveSet::of_polylines(&line(3.0), spacing).unwrap();
    let evaluation = evaluate(&found, &truth, &[2.9, 3.0], None).unwrap();
    let [below, at] = [evaluation.scores[0], evaluation.scores[1]];
    assert_eq!((below.recall, below.precision, below.f1), (0.0, 0.0, 0.0));
    assert_eq!((at.recall, at.precision, at.f1), (1.0, 1.0, 1.0));
    assert_eq!(at.truth_length, 20.0);
    assert_eq!(evaluation.truth_to_extracted.mean, 3.0);
}

#[test]
fn a_shared_trunk_counts_once() {
    let paths: Vec<Vec<[f64; 2]>> = (0..5)
        .map(|i| vec![[30.0, 4.0 * f64::from(i)], [20.0, 0.1 * f64::from(i)], [0.0, 0.0]])
        .collect();
    let truth = set(&[vec![[0.0, 0.0], [20.0, 0.0]]]);
    let merged = compared(&set(&paths), &truth).scores[2].extracted_length;
    let arms: f64 = (0..5).map(|i| 10_f64.hypot(3.9 * f64::from(i))).sum();
    assert!(merged < 20.0 + arms && merged > 20.0 + arms - 8.0, "{merged}: {arms}");
    let all = compared(&set(&paths).with_merge(0.0), &truth).scores[2].extracted_length;
    assert!((all - 100.0 - arms).abs() < 0.1, "{all}: {arms}");
    // The same curve twice, sampled elsewhere, is one curve; one beside it is another.
    let twice = set(&[vec![[0.0, 0.0], [20.0, 0.0]], vec![[20.0, 0.0], [9.9, 0.0], [0.0, 0.0]]]);
    assert!((compared(&twice, &truth).scores[0].extracted_length - 20.0).abs() < 1e-12);
    let beside = set(&[vec![[0.0, 0.0], [20.0, 0.0]], vec![[0.0, 0.8], [20.0, 0.8]]]);
    assert!((compared(&beside, &truth).scores[0].extracted_length - 40.0).abs() < 1e-12);
}

#[test]
fn outside_the_field_of_view_nothing_counts() {
    let shape = Shape::new([40, 10]).unwrap();
    let view = Mask::new(Grid::from_fn(shape, |[x, _]| x >= 20));
    let truth = set(&[vec![[0.0, 5.0], [39.0, 5.0]]]);
    let found = set(&[vec![[0.0, 1.0], [19.4, 5.0], [50.0, 5.0]]]);
    let evaluation = evaluate(&found, &truth, &[1.0], Some(&view)).unwrap();
    let score = evaluation.scores[0];
    assert_eq!((score.recall, score.precision), (1.0, 1.0));
    assert!((score.truth_length - 19.5).abs() < 0.25, "{score:?}");
    assert!((score.extracted_length - 20.0).abs() < 0.25, "{score:?}");
}

#[test]
fn empty_sets_miss_nothing_and_claim_nothing() {
    let (empty, line) = (set::<2>(&[]), set(&[vec![[0.0, 0.0], [9.0, 0.0]]]));
    for (extracted, truth, [recall, precision, f1]) in [
        (&empty, &line, [0.0, 1.0, 0.0]),
        (&line, &empty, [1.0, 0.0, 0.0]),
        (&empty, &empty, [1.0; 3]),
    ] {
        let evaluation = compared(extracted, truth);
        for score in &evaluation.scores {
            assert_eq!([score.recall, score.precision, score.f1], [recall, precision, f1]);
        }
    }
    assert_eq!(compared(&empty, &line).truth_to_extracted.mean, f64::INFINITY);
    assert_eq!(compared(&empty, &line).extracted_to_truth.largest, 0.0);
    // A point has no length, but the middle of a line can be near it.
    let point = set(&[vec![[4.0, 0.0]]]);
    let score = compared(&point, &line).scores[2];
    assert_eq!(score.extracted_length, 0.0);
    assert!((score.recall - 2.0 / 9.0).abs() < 0.03, "{score:?}");
}

#[test]
fn masks_are_curves() {
    let shape = Shape::new([30, 30]).unwrap();
    let diagonal = CurveSet::of_mask(&Grid::from_fn(shape, |[x, y]| x == y));
    let line = set(&[vec![[0.0, 0.0], [29.0, 29.0]]]);
    let evaluation = compared(&line, &diagonal);
    assert_eq!((evaluation.scores[0].recall, evaluation.scores[0].precision), (1.0, 1.0));
    assert!((evaluation.scores[0].truth_length - 29.0 * 2_f64.sqrt()).abs() < 1e-9);
    let none = CurveSet::of_mask(&Grid::from_fn(shape, |_| false));
    assert_eq!(compared(&line, &none).scores[0].truth_length, 0.0);
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let line = set(&[vec![[0.0, 0.0], [9.0, 0.0]]]);
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let error = evaluate(&line, &line, &[1.0, bad], None).unwrap_err();
        assert!(matches!(error, EvaluationError::Tolerance { .. }), "{error}");
    }
    for bad in [f64::NAN, f64::INFINITY, 1e10] {
        let polyline = [vec![[0.0, 0.0]], vec![[1.0, 1.0], [0.0, bad]]];
        let error = CurveSet::of_polylines(&polyline, [1.0; 2]).unwrap_err();
        assert_eq!(error, EvaluationError::Point { curve: 1, point: 1 });
    }
    let long = CurveSet::of_polylines(&[[[0.0, 0.0], [9e6, 0.0]]], [1.0; 2]).unwrap_err();
    assert!(matches!(long, EvaluationError::TooLong { .. }), "{long}");
    let spacing = CurveSet::of_polylines(&[[[0.0, 0.0]]], [1.0, 0.0]).unwrap_err();
    assert!(matches!(spacing, EvaluationError::Shape(_)), "{spacing}");
    let other = CurveSet::of_polylines(&[[[0.0, 0.0]]], [1.0, 2.0]).unwrap();
    let error = evaluate(&other, &line, &[1.0], None).unwrap_err();
    assert!(matches!(error, EvaluationError::Spacings { .. }), "{error}");
    let mask = |side| Grid::from_fn(Shape::new([side, 9]).unwrap(), |_| false);
    let [small, large] = [8, 9].map(|side| CurveSet::of_mask(&mask(side)));
    let view = Mask::new(mask(8));
    for (extracted, truth) in [(&small, &large), (&large, &line), (&line, &large)] {
        let error = evaluate(extracted, truth, &[1.0], Some(&view)).unwrap_err();
        assert!(matches!(error, EvaluationError::Sizes { .. }), "{error}");
    }
}

fn polylines() -> impl Strategy<Value = Vec<Vec<[f64; 2]>>> {
    let point = prop::array::uniform2(0.0..12.0);
    prop::collection::vec(prop::collection::vec(point, 0..5), 0..5)
}

proptest! {
    #[test]
    fn roles_can_be_exchanged_and_wider_tolerances_agree_more(a in polylines(), b in polylines()) {
        let [a, b] = [set(&a), set(&b)];
        let (forward, backward) = (compared(&a, &b), compared(&b, &a));
        prop_assert_eq!(forward.truth_to_extracted, backward.extracted_to_truth);
        for (one, other) in forward.scores.iter().zip(&backward.scores) {
            prop_assert_eq!((one.recall, one.precision), (other.precision, other.recall));
            prop_assert_eq!(one.truth_length, other.extracted_length);
            prop_assert!((0.0..=1.0 + 1e-12).contains(&one.recall) && one.f1 <= 1.0 + 1e-12);
        }
        for pair in forward.scores.windows(2) {
            prop_assert!(pair[0].recall <= pair[1].recall && pair[0].precision <= pair[1].precision);
        }
    }

    #[test]
    fn every_set_agrees_with_itself(a in polylines()) {
        for score in compared(&set(&a), &set(&a)).scores {
            prop_assert!((score.recall - 1.0).abs() < 1e-12, "{:?}", score);
        }
    }
}
