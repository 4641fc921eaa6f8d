//! Edges with more than two faces: which windows have come through them.

use super::window::{Window, is_longer};
use std::collections::HashMap;

/// Windows whose images and offsets differ by less than this part of their distance are the same.
const SAME: f64 = 1e-11;

/// What is left of a window reaches so far, as a part of the interval, into where it is beaten.
const RIM: f64 = 1e-9;

/// An interval that holds no point.
const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// The windows that have entered faces across edges with more than two faces.
///
/// Sheets that lie upon each other between two such edges pass on the same paths, or nearly the same, once
/// each, and twice as many after the next two edges: a mesh of two such layers would take exponential
/// time. So here, and only here, windows are cut as by Mitchell, Mount and Papadimitriou (1987):
/// what other windows have reached on a shorter way beyond doubt is left out.
#[derive(Debug, Default)]
pub(super) struct Crowd {
    seen: HashMap<u32, Vec<Window>>,
    /// How many comparisons there were.
    pub(super) comparisons: usize,
}

impl Crowd {
    /// The interval that holds all of a window that nothing better has come through, if there is any.
    pub(super) fn admit(&mut self, window: &Window) -> Option<[f64; 2]> {
        let seen = self.seen.entry(window.side).or_default();
        self.comparisons += seen.len();
        let mut span = window.span;
        // What one leaves open another may close.
        for _ in 0..2 {
            for other in seen.iter() {
                for [start, end] in beaten(window, other) {
                    if start <= span[0] {
                        span[0] = span[0].max(end);
                    }
                    if end >= span[1] {
                        span[1] = span[1].min(start);
                    }
                }
            }
        }
        if span[0] >= span[1] {
            return None;
        }
        seen.push(Window { span, ..*window });
        Some(span)
    }
}

/// The parts of the side that another window reaches on a shorter way than a window.
fn beaten(window: &Window, other: &Window) -> [[f64; 2]; 3] {
    let (start, end) = (window.span[0].max(other.span[0]), window.span[1].min(other.span[1]));
    let same = is_same(window, other);
    let is_beaten = |at: f64| same || is_longer(window.to(at), other.to(at));
    let rim = RIM * (end - start).max(0.0);
    let inside = |tie: f64| if tie.is_nan() { start } else { tie.clamp(start, end.max(start)) };
    let [first, second] = ties(window, other).map(inside);
    [[start, first], [first, second], [second, end]].map(|[from, to]| {
        if from < to && is_beaten(f64::midpoint(from, to)) {
            // What squaring adds are no ties.
            let from = if is_beaten(from) { from } else { from + rim };
            let to = if is_beaten(to) { to } else { to - rim };
            [from, to]
        } else {
            NOTHING
        }
    })
}

fn is_same(a: &Window, b: &Window) -> bool {
    let scale = SAME * (1.0 + a.to(a.span[0]));
    let near = |x: f64, y: f64| (x - y).abs() <= scale;
    near(a.offset, b.offset) && near(a.image[0], b.image[0]) && near(a.image[1], b.image[1])
}

/// Where on the side two windows may be equally far, the smaller first; NaN where they never are.
fn ties(a: &Window, b: &Window) -> [f64; 2] {
    let norm_sq = |w: &Window| w.image[0].powi(2) + w.image[1].powi(2);
    let c = a.offset - b.offset;
    // `|t - b| = |t - a| + c` squared twice.
    let m = 2.0 * (a.image[0] - b.image[0]);
    let k = norm_sq(b) - norm_sq(a) - c * c;
    let (p, q) = (m * m - 4.0 * c * c, m * k + 4.0 * c * c * a.image[0]);
    let r = k * k - 4.0 * c * c * norm_sq(a);
    let root = (q * q - p * r).max(0.0).sqrt();
    // Two quotients of which neither cancels.
    let sum = -(q + root.copysign(q));
    let [first, second] = [sum / p, r / sum];
    if first <= second { [first, second] } else { [second, first] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(image: [f64; 2], span: [f64; 2], offset: f64) -> Window {
        Window { image, span, offset, side: 0, from: 3, parent: 0, root: 0 }
    }

    #[test]
    fn where_two_windows_are_equally_far() {
        // 3 + 4 = 2 + 5 at the foot of the first, five from the second.
        let (a, b) = (window([0.0, 4.0], [0.0, 9.0], 3.0), window([3.0, 4.0], [0.0, 9.0], 2.0));
        let found = ties(&a, &b).map(|t| (a.to(t) - b.to(t)).abs());
        assert!(found[0].min(found[1]) < 1e-14, "{found:?}");
        // Equal offsets: the middle, wherever the other root is.
        let b = Window { offset: 3.0, ..b };
        assert!(ties(&a, &b).iter().any(|t| (t - 1.5).abs() < 1e-15));
    }

    #[test]
    fn only_what_nothing_better_has_come_through_is_admitted() {
        let mut crowd = Crowd::default();
        let first = window([0.0, 1.0], [0.0, 4.0], 0.0);
        assert_eq!(crowd.admit(&first), Some([0.0, 4.0]));
        assert_eq!(crowd.admit(&first), None);
        assert_eq!(crowd.admit(&Window { span: [3.0, 5.0], ..first }), Some([4.0, 5.0]));
        // From (6, -1) all beyond 3 is nearer.
        let [start, end] = crowd.admit(&window([6.0, 1.0], [1.0, 5.0], 0.0)).unwrap();
        assert!((start - 3.0).abs() < 1e-8 && start <= 3.0 && end == 5.0, "{start} {end}");
        assert_eq!(crowd.admit(&window([0.5, 1.0], [0.0, 2.0], 1.1)), None);
        assert_eq!(crowd.admit(&Window { side: 1, ..first }), Some([0.0, 4.0]));
    }
}
