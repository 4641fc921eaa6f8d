//! Circles and spheres around a key point, and the peaks of heat on them.

use std::f64::consts::{LN_2, PI};

/// The unit circle (`D = 2`) or sphere (`D = 3`) in samples, and which of them are neighbours.
#[derive(Clone, Debug)]
pub(super) struct Circle<const D: usize> {
    pub(super) directions: Vec<[f64; D]>,
    neighbours: Vec<Vec<usize>>,
}

/// A direction in which heat has come further than around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Peak<const D: usize> {
    pub(super) direction: [f64; D],
    /// The largest value.
    pub(super) value: f64,
}

/// Two peaks are one unless `ln u` falls by this much between them: heat is half as warm there.
const PROMINENCE: f64 = LN_2;

impl<const D: usize> Circle<D> {
    /// Samples at most one cell apart at a `radius` in cells: two a cell on a circle, one a squared
    /// cell on a sphere (the lattice of Fibonacci's numbers, where each has 6 to 12 neighbours).
    pub(super) fn new(radius: f64) -> Self {
        if D == 2 { Self::ring(radius) } else { Self::sphere(radius) }
    }

    fn ring(radius: f64) -> Self {
        let count = (4.0 * PI * radius).ceil().max(16.0) as usize;
        let direction = |i: usize| {
            let angle = 2.0 * PI * i as f64 / count as f64;
            std::array::from_fn(|axis| if axis == 0 { angle.cos() } else { angle.sin() })
        };
        Self {
            directions: (0..count).map(direction).collect(),
            neighbours: (0..count)
                .map(|i| vec![(i + count - 1) % count, (i + 1) % count])
                .collect(),
        }
    }

    fn sphere(radius: f64) -> Self {
        let count = (4.0 * PI * radius * radius).ceil().max(64.0) as usize;
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let direction = |i: usize| {
            let z = 1.0 - (2 * i + 1) as f64 / count as f64;
            let (sin, cos) = (golden * i as f64).sin_cos();
            let ring = (1.0 - z * z).sqrt();
            std::array::from_fn(|axis| [ring * cos, ring * sin, z][axis])
        };
        let directions: Vec<[f64; D]> = (0..count).map(direction).collect();
        let chord = 1.8 * (4.0 * PI / count as f64).sqrt();
        // The samples lie in the order of z.
        let within = (0.5 * chord * count as f64).ceil() as usize;
        let neighbours = |i: usize| {
            let range = i.saturating_sub(within)..(i + within + 1).min(count);
            let near =
                |&j: &usize| j != i && distance_sq(directions[i], directions[j]) < chord * chord;
            range.filter(near).collect()
        };
        let neighbours = (0..count).map(neighbours).collect();
        Self { directions, neighbours }
    }

    /// The peaks of `values`, one for each sample, minus infinity where there is none; the warmest
    /// first. Each is centred in the part around it that is at least half as warm.
    pub(super) fn peaks(&self, values: &[f64]) -> Vec<Peak<D>> {
        let summits = self.summits(values);
        summits.into_iter().map(|(top, floor)| self.centred(values, top, floor)).collect()
    }

    /// The samples that stand out, and the lowest value that belongs to each: samples are added from
    /// the warmest to the coldest, and where two summits meet, the lower one ends.
    fn summits(&self, values: &[f64]) -> Vec<(usize, f64)> {
        let mut order: Vec<usize> =
            (0..values.len()).filter(|&i| values[i] > f64::NEG_INFINITY).collect();
        order.sort_by(|&a, &b| values[b].total_cmp(&values[a]).then(a.cmp(&b)));
        let mut summit: Vec<Option<usize>> = vec![None; values.len()];
        let mut found: Vec<(usize, f64)> = Vec::new();
        for &sample in &order {
            let mut tops: Vec<usize> =
                (self.neighbours[sample].iter()).filter_map(|&next| root(&summit, next)).collect();
            tops.sort_by(|&a, &b| values[b].total_cmp(&values[a]).then(a.cmp(&b)));
            tops.dedup();
            summit[sample] = Some(tops.first().copied().unwrap_or(sample));
            for &lower in tops.iter().skip(1) {
                if values[lower] - values[sample] >= PROMINENCE {
                    found.push((lower, values[sample]));
                }
                summit[lower] = summit[sample];
            }
        }
        let last = order.into_iter().filter(|&i| summit[i] == Some(i));
        found.extend(last.map(|top| (top, f64::NEG_INFINITY)));
        found.sort_by(|a, b| values[b.0].total_cmp(&values[a.0]).then(a.0.cmp(&b.0)));
        found
    }

    /// The mean direction, weighted by u, of the samples around a summit.
    fn centred(&self, values: &[f64], top: usize, saddle: f64) -> Peak<D> {
        let floor = saddle.max(values[top] - LN_2);
        let mut seen = vec![false; values.len()];
        let (mut stack, mut sum) = (vec![top], [0.0; D]);
        seen[top] = true;
        while let Some(sample) = stack.pop() {
            let weight = (values[sample] - values[top]).exp();
            (0..D).for_each(|axis| sum[axis] += weight * self.directions[sample][axis]);
            for &next in &self.neighbours[sample] {
                if values[next] > floor && !std::mem::replace(&mut seen[next], true) {
                    stack.push(next);
                }
            }
        }
        let length = distance_sq(sum, [0.0; D]).sqrt();
        // Where all directions are alike, their mean is none.
        let direction =
            if length > 1e-6 { sum.map(|part| part / length) } else { self.directions[top] };
        Peak { direction, value: values[top] }
    }
}

/// The summit that a sample belongs to.
fn root(summit: &[Option<usize>], sample: usize) -> Option<usize> {
    let mut here = summit[sample]?;
    while let Some(next) = summit[here].filter(|&next| next != here) {
        here = next;
    }
    Some(here)
}

fn distance_sq<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).map(|axis| (a[axis] - b[axis]).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `ln u` of rays at some directions, falling off with the squared angle.
    fn rays<const D: usize>(circle: &Circle<D>, rays: &[([f64; D], f64)]) -> Vec<f64> {
        let value = |&direction: &[f64; D]| {
            let from = |&(ray, top): &([f64; D], f64)| top - 40.0 * distance_sq(direction, ray);
            rays.iter().map(from).fold(f64::NEG_INFINITY, f64::max)
        };
        circle.directions.iter().map(value).collect()
    }

    #[test]
    fn peaks_lie_between_the_samples() {
        let circle = Circle::<2>::new(10.0);
        let [a, b] = [0.3_f64, 2.0].map(|angle| [angle.cos(), angle.sin()]);
        let peaks = circle.peaks(&rays(&circle, &[(a, -1.0), (b, -2.0)]));
        assert_eq!(peaks.len(), 2);
        assert!(distance_sq(peaks[0].direction, a).sqrt() < 5e-3, "{peaks:?}");
        assert!(distance_sq(peaks[1].direction, b).sqrt() < 5e-3, "{peaks:?}");
    }

    #[test]
    fn a_plateau_has_one_peak_in_its_middle() {
        let circle = Circle::<2>::new(30.0);
        let count = circle.directions.len();
        let plateau = |i: usize| if (20..=31).contains(&i) { (i % 3) as f64 * 0.1 } else { -9.0 };
        let values: Vec<f64> = (0..count).map(plateau).collect();
        let peaks = circle.peaks(&values);
        assert_eq!(peaks.len(), 1);
        let angle = peaks[0].direction[1].atan2(peaks[0].direction[0]);
        assert!((angle * count as f64 / (2.0 * PI) - 25.5).abs() < 0.3, "{angle}");
    }

    #[test]
    fn a_sphere_has_peaks_at_its_rays() {
        let circle = Circle::<3>::new(8.0);
        let z = [0.0, 0.0, 1.0];
        let slanted = [0.6, -0.64, -0.48];
        let peaks = circle.peaks(&rays(&circle, &[(z, -3.0), (slanted, 0.0)]));
        assert_eq!(peaks.len(), 2);
        assert!(distance_sq(peaks[0].direction, slanted).sqrt() < 0.03, "{peaks:?}");
        assert!(distance_sq(peaks[1].direction, z).sqrt() < 0.03, "{peaks:?}");
        assert!(circle.neighbours.iter().all(|near| (4..=14).contains(&near.len())));
    }

    #[test]
    fn cold_circles_have_no_peaks() {
        let circle = Circle::<2>::new(5.0);
        assert_eq!(circle.peaks(&vec![f64::NEG_INFINITY; circle.directions.len()]), []);
    }
}
