//! Pictures of curves that are known, and how well a result follows them.

use super::random;
use heatpath_core::grid::keypoints::KeyPoints;
use heatpath_core::grid::{Grid, Shape};
use std::f64::consts::PI;

/// A curve in physical units, in samples a quarter of a unit apart, and half the width drawn.
pub(crate) struct Curve<const D: usize> {
    pub(crate) samples: Vec<[f64; D]>,
    pub(crate) half_width: f64,
}

pub(crate) fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// The curve `at(s)` for s from 0 to 1.
pub(crate) fn curve<const D: usize>(half_width: f64, at: impl Fn(f64) -> [f64; D]) -> Curve<D> {
    let fine: Vec<[f64; D]> = (0..=20_000).map(|i| at(f64::from(i) / 20_000.0)).collect();
    let mut samples = vec![fine[0]];
    for point in fine {
        if distance(point, samples[samples.len() - 1]) >= 0.25 {
            samples.push(point);
        }
    }
    Curve { samples, half_width }
}

pub(crate) fn segment<const D: usize>(half_width: f64, a: [f64; D], b: [f64; D]) -> Curve<D> {
    curve(half_width, |s| std::array::from_fn(|axis| a[axis] + s * (b[axis] - a[axis])))
}

/// A tree of bent branches that fork, from `start` upwards.
pub(crate) fn tree(
    start: [f64; 2],
    angle: f64,
    length: f64,
    half_width: f64,
    forks: u32,
) -> Vec<Curve<2>> {
    let bend = if forks.is_multiple_of(2) { 0.25 } else { -0.25 };
    let at = |s: f64| {
        let along = |part: f64| angle + bend * part;
        let [mut x, mut y] = start;
        for i in 0..100 {
            let part = s * (f64::from(i) + 0.5) / 100.0;
            x += s * length / 100.0 * along(part).cos();
            y -= s * length / 100.0 * along(part).sin();
        }
        [x, y]
    };
    let mut curves = vec![curve(half_width, at)];
    if forks > 0 {
        for turn in [-0.55, 0.5] {
            let (shorter, thinner) = (0.75 * length, (0.8 * half_width).max(1.2));
            curves.extend(tree(at(1.0), angle + bend + turn, shorter, thinner, forks - 1));
        }
    }
    curves
}

/// A tree in a picture of `side` cells, from the middle of its lower border upwards: branches that
/// are bent, fork, grow thinner and send off thin ones sideways, each as the random numbers say. A
/// branch begins where its parent ends, or on its centreline.
pub(crate) fn random_tree(
    side: f64,
    half_width: f64,
    random: &mut impl FnMut() -> f64,
) -> Vec<Curve<2>> {
    let mut curves = Vec::new();
    let forks = if side < 500.0 { 3 } else { 4 };
    let mut growing = vec![([0.5 * side, 0.96 * side], 0.5 * PI, 0.26 * side, half_width, forks)];
    while let Some((start, angle, length, half_width, forks)) = growing.pop() {
        let bend = 0.6 * (random() - 0.5);
        let at = |s: f64| {
            let (from, to, radius) = (angle, angle + s * bend, length / bend);
            [
                start[0] + radius * (to.sin() - from.sin()),
                start[1] + radius * (to.cos() - from.cos()),
            ]
        };
        curves.push(curve(half_width, at));
        if forks == 0 {
            continue;
        }
        for side in [-1.0, 1.0] {
            let angle = angle + bend + side * (0.35 + 0.35 * random());
            let length = length * (0.7 + 0.15 * random());
            let half_width = (half_width * (0.7 + 0.2 * random())).max(1.2);
            growing.push((at(1.0), angle, length, half_width, forks - 1));
        }
        if random() < 0.4 {
            let (part, side) = (0.3 + 0.4 * random(), if random() < 0.5 { -1.0 } else { 1.0 });
            let angle = angle + part * bend + side * (0.5 + 0.6 * random());
            let half_width = (half_width * (0.4 + 0.3 * random())).max(1.2);
            growing.push((at(part), angle, 0.6 * length, half_width, 0));
        }
    }
    curves
}

/// Bright curves (0.8) on a dark ground (0.2) with soft edges and Gaussian noise.
pub(crate) fn draw<const D: usize>(
    shape: Shape<D>,
    curves: &[Curve<D>],
    noise: f64,
) -> Grid<f64, D> {
    let mut image = Grid::from_fn(shape, |_| 0.0_f64);
    for curve in curves {
        let reach = curve.half_width + 2.0;
        for &sample in curve.samples.iter().step_by(2) {
            let centre: [f64; D] = std::array::from_fn(|axis| sample[axis] / shape.spacing()[axis]);
            let cells: [i64; D] =
                std::array::from_fn(|axis| (reach / shape.spacing()[axis]).ceil() as i64);
            let sides = cells.map(|n| 2 * n + 1);
            for number in 0..sides.iter().product::<i64>() {
                let mut rest = number;
                let index: [f64; D] = std::array::from_fn(|axis| {
                    let offset = rest % sides[axis] - cells[axis];
                    rest /= sides[axis];
                    centre[axis].round() + offset as f64
                });
                if shape.contains(index) {
                    let there = distance(
                        sample,
                        std::array::from_fn(|axis| index[axis] * shape.spacing()[axis]),
                    );
                    let value = (0.5 + (curve.half_width - there)).clamp(0.0, 1.0);
                    let cell = &mut image[index.map(|i| i as usize)];
                    *cell = cell.max(value);
                }
            }
        }
    }
    let mut random = random(7);
    image.map(|value| {
        let gauss = (-2.0 * random().max(1e-300).ln()).sqrt() * (2.0 * PI * random()).cos();
        (0.2 + 0.6 * value + noise * gauss).clamp(0.0, 1.0)
    })
}

/// How well the links follow the curves, as far as these lie in the picture.
#[derive(Debug)]
pub(crate) struct Score<const D: usize> {
    /// The part of the curves within 2 units of a link.
    pub(crate) recall: f64,
    /// The longest stretch that is not.
    pub(crate) gap: f64,
    /// Where it ends.
    pub(crate) at: [f64; D],
    /// The part of the links within 2 units of a curve.
    pub(crate) precision: f64,
    /// The mean distance of the links from the curves.
    pub(crate) mean: f64,
}

pub(crate) fn score<const D: usize>(found: &KeyPoints<D>, curves: &[Curve<D>]) -> Score<D> {
    let spacing = found.travelling.shape().spacing();
    let physical = |p: &[f64; D]| std::array::from_fn(|axis| p[axis] * spacing[axis]);
    let links: Vec<[f64; D]> =
        found.links.iter().flat_map(|link| link.path.points.iter().map(physical)).collect();
    let shape = found.travelling.shape();
    let is_inside = |sample: &[f64; D]| {
        shape.contains(std::array::from_fn(|axis| sample[axis] / spacing[axis]))
    };
    let inside = |curve: &Curve<D>| curve.samples.iter().copied().filter(is_inside).collect();
    let pieces: Vec<Vec<[f64; D]>> = curves.iter().map(inside).collect();
    let truth = pieces.concat();
    let nearest = |point: [f64; D], others: &[[f64; D]]| {
        others.iter().map(|&other| distance(point, other)).fold(f64::INFINITY, f64::min)
    };
    let off: Vec<f64> = links.iter().map(|&point| nearest(point, &truth)).collect();
    let (mut gap, mut hits, mut at) = (0, 0, [0.0; D]);
    for piece in &pieces {
        let mut run = 0;
        for &sample in piece {
            let hit = nearest(sample, &links) <= 2.0;
            hits += usize::from(hit);
            run = if hit { 0 } else { run + 1 };
            if run > gap {
                (gap, at) = (run, sample);
            }
        }
    }
    Score {
        recall: hits as f64 / truth.len() as f64,
        gap: 0.25 * f64::from(gap),
        at,
        precision: off.iter().filter(|&&off| off <= 2.0).count() as f64 / off.len() as f64,
        mean: off.iter().sum::<f64>() / off.len() as f64,
    }
}
