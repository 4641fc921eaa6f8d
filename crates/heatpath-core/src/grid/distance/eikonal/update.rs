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

    /// The T at which the squares of the derivatives add up to 1, over those neighbours that are nearer
    /// than T and from which it grows; `None` if the nearest alone are more than enough.
    #[inline]
    pub(super) fn solve(mut self) -> Option<f64> {
        if self.len == 0 {
            return None;
        }
        let is_enough = |&count: &usize| self.excess(count, self.items[count].near) >= 0.0;
        let mut count = (1..self.len).find(is_enough).unwrap_or(self.len);
        let last = self.items[count - 1].near;
        if self.excess(count, last) >= 0.0 {
            // Too little without the last neighbour, and too much as soon as it counts.
            return (last > self.items[0].near).then_some(last);
        }
        loop {
            let distance = larger_root(&self.items[..count], self.items[0].near);
            let shrinks = |d: &Difference| d.slope * distance.unwrap_or(last) < d.rest;
            let Some(place) = self.items[..count].iter().position(shrinks) else {
                return distance;
            };
            self.items.copy_within(place + 1..count, place);
            count -= 1;
        }
    }

    /// By how much the squares of the first derivatives exceed 1 at a distance.
    #[inline]
    fn excess(&self, count: usize, distance: f64) -> f64 {
        let squares = self.items[..count].iter().map(|d| {
            let derivative = (d.slope * distance - d.rest).max(0.0);
            d.weight * derivative * derivative
        });
        squares.sum::<f64>() - 1.0
    }
}

/// The larger root of the equation over some neighbours, of which the nearest is at the distance
/// `origin`; `None` if there is none beyond that.
#[inline]
pub(super) fn larger_root(differences: &[Difference], origin: f64) -> Option<f64> {
    // Counted from the nearest neighbour: the squares of large distances would cancel.
    let (mut a, mut b, mut c) = (0.0, 0.0, -1.0);
    for &Difference { weight, slope, rest, .. } in differences {
        let rest = rest - slope * origin;
        a += weight * slope * slope;
        b += weight * slope * rest;
        c += weight * rest * rest;
    }
    let distance = origin + (b + (b * b - a * c).sqrt()) / a;
    (distance >= origin && distance < f64::INFINITY).then_some(distance)
}
