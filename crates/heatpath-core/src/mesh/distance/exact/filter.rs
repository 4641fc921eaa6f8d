//! Which windows are given up.

use super::propagation::Propagation;
use super::window::{NONE, Window, hypotenuse, is_longer};

impl Propagation<'_> {
    /// Whether paths through one of the vertices of the edge, or of the face behind it, are shorter than
    /// all paths of a window (Xin and Wang 2009, theorem 3.2).
    ///
    /// A vertex whose way to the far end of the window crosses all its rays, and is the shorter way
    /// there, is the shorter way to everything behind.
    pub(super) fn is_beaten(&self, window: &Window) -> bool {
        let from = self.sides.get(window.from);
        let [start, end] = window.span;
        let (to_start, to_end) = (window.to(start), window.to(end));
        let via = |vertex: u32, way: f64| self.vertices[vertex as usize].distance + way;
        // === Along the edge
        if is_longer(to_end, via(from.ends[0], end))
            || is_longer(to_start, via(from.ends[1], from.length - start))
        {
            return true;
        }
        // === From a root that has come nearer
        let root = self.vertices.get(window.root as usize);
        if root.is_some_and(|root| is_longer(window.offset, root.distance)) {
            return true;
        }
        // === Across the face behind, which the rays of a root inside do not cross
        let [x, y] = from.apex;
        let across = |at: f64| via(from.vertex, hypotenuse(x - at, y));
        window.parent != NONE
            && ((window.turn(start, [x, -y]) > 0.0 && is_longer(to_end, across(end)))
                || (window.turn(end, [x, -y]) < 0.0 && is_longer(to_start, across(start))))
    }

    /// Whether a window whose rays all pass the apex on one side has anything to find behind the line from
    /// there to its far end; all its rays cross it.
    pub(super) fn passes_apex(&self, window: &Window, far: f64) -> bool {
        let side = self.sides.get(window.side);
        let way = hypotenuse(side.apex[0] - far, side.apex[1]);
        !is_longer(window.to(far), self.vertices[side.vertex as usize].distance + way)
    }
}
