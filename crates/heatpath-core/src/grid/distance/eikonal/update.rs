//! The distance of one cell from those of its neighbours.

/// One directional derivative of the distance T in a cell, as a function of T: `slope T - rest`.
///
/// The eikonal equation in the cell is `sum of weight (slope T - rest)^2 = 1` over the directions
/// from which T comes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Difference {
    pub(super) weight: f64,
    pub(super) slope: f64,
    pub(super) rest: f64,
    /// The distance of the nearer neighbour in this direction, below which T cannot be; infinite if
    /// there is none.
    pub(super) near: f64,
}

/// The differences of a cell, nearest neighbour first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Differences<const N: usize> {
    items: [Difference; N],
    len: usize,
}

impl<const N: usize> Differences<N> {
    #[inline]
    pub(super) fn new() -> Self {
        Self { items: [Difference::default(); N], len: 0 }
    }

    #[inline]
    pub(super) fn insert(&mut self, difference: Difference) {
        let mut place = self.len;
        while place > 0 && self.items[place - 1].near > difference.near {
            self.items[place] = self.items[place - 1];
            place -= 1;
        }
        self.items[place] = difference;
        self.len += 1;
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// The larger root T of the equation over as many of the nearest neighbours as are nearer than
    /// it; `None` if there is none.
    #[inline]
    pub(super) fn solve(&self) -> Option<f64> {
        // Counted from the nearest neighbour: the squares of large distances would cancel.
        let origin = self.items[0].near;
        let (mut a, mut b, mut c) = (0.0, 0.0, -1.0);
        let mut last = origin;
        for difference in &self.items[..self.len] {
            let Difference { weight, slope, rest, near } = *difference;
            let t = near - origin;
            // At the root the squares add up to 1: if they do so before, it is nearer.
            if (a * t - 2.0 * b) * t + c >= 0.0 {
                break;
            }
            let rest = rest - slope * origin;
            a += weight * slope * slope;
            b += weight * slope * rest;
            c += weight * rest * rest;
            last = near;
        }
        let distance = origin + (b + (b * b - a * c).sqrt()) / a;
        // Not so if there is no root.
        (distance >= last && distance < f64::INFINITY).then_some(distance)
    }
}
