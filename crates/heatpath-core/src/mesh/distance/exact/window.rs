//! One window: the part of an edge that a source sees through a strip of faces.

use super::sides::Side;

/// Windows that the source sees under a smaller angle are dropped.
///
/// Rays that bound a window pass through vertices. Where paths can bend at such a vertex, it is a source
/// of its own and sees everything behind it; where they cannot, the rays on its one side and on its
/// other side overlap by the angle that the vertex misses, at least 1e-8. So nothing is lost with
/// a window that is thinner than that by far.
const THINNEST: f64 = 1e-12;

/// How much longer a path must be than another one to be given up, as a part of its length: more than
/// what rounding adds up to over thousands of edges. What is given up without need would be lost;
/// what is kept without need costs only time.
const MARGIN: f64 = 1e-12;

/// Whether a path is longer than another one beyond all doubt.
#[inline]
pub(super) fn is_longer(path: f64, other: f64) -> bool {
    path > other * (1.0 + MARGIN)
}

/// No window, no face.
pub(super) const NONE: u32 = u32::MAX;

/// Paths from one source, or from a vertex at which they bent, that enter a face through an interval of
/// one side.
///
/// In the plane of the side ([`Side`]) they are straight and come from `(image[0], -image[1])`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Where the root lies: along the side, and below it.
    pub(super) image: [f64; 2],
    /// The interval along the side.
    pub(super) span: [f64; 2],
    /// The distance at the root.
    pub(super) offset: f64,
    /// The side through which the paths enter a face.
    pub(super) side: u32,
    /// The same edge as a side of the face that they leave.
    pub(super) from: u32,
    /// The window before this one; none behind a root.
    pub(super) parent: u32,
    /// A vertex, or beyond the vertices a source inside a face or edge.
    pub(super) root: u32,
}

impl Window {
    /// The length of the path to a point of the side.
    #[inline]
    pub(super) fn to(&self, at: f64) -> f64 {
        self.offset + hypotenuse(self.image[0] - at, self.image[1])
    }

    /// The length of the shortest path.
    pub(super) fn nearest(&self) -> f64 {
        self.to(self.image[0].clamp(self.span[0], self.span[1]))
    }

    /// Where the line to a point above the side crosses it.
    #[inline]
    pub(super) fn crossing(&self, point: [f64; 2]) -> f64 {
        crossing(self.image, point)
    }

    /// Twice the area between the ray through a point of the side and another point of the plane:
    /// positive if that one lies towards the first end.
    #[inline]
    pub(super) fn turn(&self, at: f64, point: [f64; 2]) -> f64 {
        let [x, y] = self.image;
        (at - x) * (point[1] + y) - y * (point[0] - x)
    }

    /// The root sees the window under an angle of next to nothing, or nothing is left of it.
    pub(super) fn is_thin(&self) -> bool {
        let [x, y] = self.image;
        let [a, b] = self.span.map(|end| end - x);
        let (cross, dot) = ((b - a) * y, a * b + y * y);
        cross.is_nan() || cross <= THINNEST * dot
    }

    /// The same paths where they leave the face between the `end` of the side and the apex.
    ///
    /// Returned are image and span in the plane of that side, of the length `length`; `starts_here` says
    /// whether it begins at `end`. The span must not leave the apex on its other side.
    pub(super) fn beyond(
        &self,
        side: &Side,
        end: usize,
        length: f64,
        starts_here: bool,
    ) -> ([f64; 2], [f64; 2]) {
        // === Seen from `end`, with the first axis towards the other end
        let mirrored = |x: f64| if end == 0 { x } else { side.length - x };
        let (x, y) = (mirrored(self.image[0]), self.image[1]);
        let [near, far] = [self.span[end], self.span[1 - end]].map(mirrored);
        // === Along the side from `end` to the apex, and off it
        let direction = [mirrored(side.apex[0]) / length, side.apex[1] / length];
        let image = [x * direction[0] - y * direction[1], y * direction[0] + x * direction[1]];
        let leaves = |at: f64| {
            let slope = direction[0] * y - direction[1] * (at - x);
            let along = at * y / slope;
            if slope > 0.0 && along < length { along.max(0.0) } else { length }
        };
        let span = [leaves(near), leaves(far)];
        if starts_here {
            (image, span)
        } else {
            ([length - image[0], image[1]], [length - span[1], length - span[0]])
        }
    }
}

/// Where the line from an image to a point above the side crosses the side.
#[inline]
pub(super) fn crossing(image: [f64; 2], point: [f64; 2]) -> f64 {
    image[0] + (point[0] - image[0]) * (image[1] / (image[1] + point[1]))
}

/// The length of a vector; not `hypot`, which is slower, as lengths are near 1 here.
#[inline]
pub(super) fn hypotenuse(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The window that reached the apex of a side first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Winner {
    pub(super) image: [f64; 2],
    /// Its path to the apex.
    pub(super) length: f64,
    pub(super) from: u32,
}

impl Winner {
    pub(super) const NONE: Self = Self { image: [0.0; 2], length: f64::INFINITY, from: NONE };

    /// Whether a window that comes later to the apex has nothing to find between the apex and the `end`
    /// of the side, because all its paths there cross the winner's path to the apex.
    ///
    /// One angle, one split (Chen and Han 1990, lemma 3.4; Xin and Wang 2009 by the order of the
    /// crossings). Their roots are vertices; ours may also lie inside faces and have offsets, so
    /// the winner's root must not lie between the later one's outermost ray and its ray to the
    /// apex. From different faces two paths that cross below the side do not meet.
    pub(super) fn hides(&self, later: &Window, side: &Side, end: usize) -> bool {
        let mirrored = |x: f64| if end == 0 { x } else { side.length - x };
        let cross = |image: [f64; 2]| mirrored(crossing(image, side.apex));
        let (first, second) = (cross(self.image), cross(later.image));
        let outermost = mirrored(later.span[end]);
        let [x, y] = [mirrored(later.image[0]), later.image[1]];
        let outside = (outermost - x) * (y - self.image[1]) >= y * (mirrored(self.image[0]) - x);
        second > first && outside && (self.from == later.from || outermost >= first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The side from (0, 0) to (4, 0) with the apex at (1, 2).
    fn side() -> Side {
        Side { length: 4.0, apex: [1.0, 2.0], vertex: 2, ends: [0, 1], next: [1, 2], edge: 0 }
    }

    fn window(span: [f64; 2]) -> Window {
        Window { image: [1.0, 2.0], span, offset: 3.0, side: 0, from: 3, parent: 0, root: 0 }
    }

    #[test]
    fn rays_go_on_through_both_other_sides() {
        let (side, window) = (side(), window([0.5, 2.0]));
        assert_eq!(window.crossing(side.apex), 1.0);
        assert_eq!(window.to(1.0), 5.0);
        // The ray through (0.5, 0) meets y = 2 x at (1/3, 2/3).
        let length = 5.0_f64.sqrt();
        let (image, span) = window.beyond(&side, 0, length, true);
        assert!((span[0] - length / 3.0).abs() < 1e-15 && span[1] == length);
        assert!((image[0].hypot(image[1]) - 5.0_f64.sqrt()).abs() < 1e-15);
        assert!((image[1] - 4.0 / length).abs() < 1e-15);
        // The ray through (2, 0) meets the line from (4, 0) to (1, 2) at (2.5, 1), half way; from there.
        let length = 13.0_f64.sqrt();
        let (_, span) = window.beyond(&side, 1, length, true);
        assert!((span[0] - 0.5 * length).abs() < 1e-15 && span[1] == length, "{span:?}");
        let (_, turned) = window.beyond(&side, 1, length, false);
        assert!(turned[0] == 0.0 && (turned[1] - 0.5 * length).abs() < 1e-15);
    }

    #[test]
    fn thin_windows() {
        assert!(!window([0.5, 2.0]).is_thin());
        assert!(window([0.5, 0.5 + 1e-13]).is_thin());
        assert!(window([2.0, 1.0]).is_thin());
        // Seen from next to it under half a turn.
        assert!(!Window { image: [1.0, 1e-20], ..window([0.5, 2.0]) }.is_thin());
    }

    #[test]
    fn a_winner_hides_the_side_that_its_path_bars() {
        let first = Winner { image: [0.0, 2.0], length: 1.0, from: 3 };
        let later = Window { image: [2.5, 2.0], ..window([1.0, 3.0]) };
        assert!(first.hides(&later, &side(), 0));
        assert!(!first.hides(&later, &side(), 1));
        // A root within the window, as of a source inside a face, hides nothing.
        let inside = Winner { image: [1.0, 0.1], ..first };
        let wide = Window { image: [1.5, 4.0], ..window([0.1, 3.0]) };
        assert!(!inside.hides(&wide, &side(), 0));
    }
}
