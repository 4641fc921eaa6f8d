//! The cells at the front, nearest first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A distance and the place of the cell that it belongs to.
///
/// The nearest entry is the greatest; of equally near ones that with the smallest place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// Not negative, nor -0.
    pub(super) distance: f64,
    pub(super) place: u32,
}

impl Entry {
    /// In the order of the entries, farthest last: compared without a jump.
    #[inline]
    fn key(&self) -> u128 {
        u128::from(self.distance.to_bits()) << 32 | u128::from(self.place)
    }
}

impl Ord for Entry {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        other.key().cmp(&self.key())
    }
}

impl PartialOrd for Entry {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }

    #[inline]
    fn lt(&self, other: &Self) -> bool {
        other.key() < self.key()
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Entry {}

/// A priority queue for distances that only grow: what is pushed is never nearer than what was popped
/// last.
///
/// The future is divided into slots of equal width. The cells of later slots are piles of places, in
/// no order; those of the current slot, some dozens, are sorted when it opens. What comes into
/// the current slot after that, little, is a heap. A cell that comes nearer is pushed once more, and
/// popped as often: whoever pops passes over entries of cells that are known or nearer.
#[derive(Debug)]
pub(super) struct Queue {
    slots_per_unit: f64,
    /// The entries of the current slot and those before it, nearest last.
    current: Vec<Entry>,
    /// Those that were pushed since it opened.
    late: BinaryHeap<Entry>,
    /// The places in the slots after the current one, and before the horizon.
    slots: std::vec::IntoIter<Vec<u32>>,
    /// The number of the first of `slots`.
    next: u64,
    /// The places beyond the horizon.
    beyond: Vec<u32>,
    /// The memory of piles that are gone.
    spare: Vec<Vec<u32>>,
}

/// The number of slots from one horizon to the next.
const SLOTS: u64 = 4096;

/// How many entries are announced before they are popped.
const AHEAD: usize = 8;

/// The number of the last slot there is.
const LAST: u64 = 1 << 62;

impl Queue {
    /// `width` is that of a slot: if there are some dozens of cells in each the queue is fastest,
    /// otherwise it is still right.
    pub(super) fn new(width: f64) -> Self {
        Self {
            slots_per_unit: 1.0 / width,
            current: Vec::new(),
            late: BinaryHeap::new(),
            slots: Vec::new().into_iter(),
            next: 0,
            beyond: Vec::new(),
            spare: Vec::new(),
        }
    }

    #[inline]
    pub(super) fn push(&mut self, entry: Entry) {
        let slot = self.slot(entry.distance);
        if slot < self.next {
            self.late.push(entry);
        } else if let Some(pile) = self.slots.as_mut_slice().get_mut((slot - self.next) as usize) {
            if pile.capacity() == 0 {
                *pile = self.spare.pop().unwrap_or_default();
            }
            pile.push(entry.place);
        } else {
            self.beyond.push(entry.place);
        }
    }

    /// The nearest entry. `distance` is asked, when a slot opens, for what the cell at a place has been
    /// pushed with last; `None` if it need not be popped any more. `announce` is told most places a few
    /// entries before they are popped.
    #[inline]
    pub(super) fn pop(
        &mut self,
        distance: impl Fn(u32) -> Option<f64>,
        announce: impl Fn(u32),
    ) -> Option<Entry> {
        loop {
            match (self.current.last(), self.late.peek()) {
                (Some(sorted), Some(late)) if late > sorted => return self.late.pop(),
                (Some(_), _) => {
                    let entry = self.current.pop();
                    if let Some(coming) = self.current.iter().nth_back(AHEAD - 1) {
                        announce(coming.place);
                    }
                    return entry;
                }
                (None, Some(_)) => return self.late.pop(),
                (None, None) => {
                    self.advance(&distance)?;
                    self.current.iter().rev().take(AHEAD).for_each(|first| announce(first.place));
                }
            }
        }
    }

    #[inline]
    fn slot(&self, distance: f64) -> u64 {
        ((distance * self.slots_per_unit) as u64).min(LAST)
    }

    /// Makes the next slot the current one; `None` at the end of all.
    fn advance(&mut self, distance: impl Fn(u32) -> Option<f64>) -> Option<()> {
        let entry = |place| Some(Entry { distance: distance(place)?, place });
        if let Some(mut pile) = self.slots.next() {
            self.next += 1;
            self.current.extend(pile.drain(..).filter_map(entry));
            self.current.sort_unstable();
            if pile.capacity() > 0 {
                self.spare.push(pile);
            }
            return Some(());
        }
        let beyond: Vec<Entry> =
            std::mem::take(&mut self.beyond).into_iter().filter_map(entry).collect();
        self.next = beyond.iter().map(|entry| self.slot(entry.distance)).min()?;
        self.slots = vec![Vec::new(); SLOTS as usize].into_iter();
        beyond.into_iter().for_each(|entry| self.push(entry));
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    #[test]
    fn entries_come_out_in_order() {
        for width in [1e-300, 1e-3, 0.5, 1e3] {
            let mut queue = Queue::new(width);
            let (mut distances, mut last) = (vec![0.0], (0.0, 0));
            queue.push(Entry { distance: 0.0, place: 0 });
            for number in 1..5000_u32 {
                let known = |place| Some(distances[place as usize]);
                let Entry { distance, place } = queue.pop(known, |_| ()).unwrap();
                assert!(last <= (distance, place), "{last:?} and then {distance} at {place}");
                last = (distance, place);
                for more in 1..3 {
                    let step = f64::from(number * more * 7919 % 499).powi(2);
                    let place = distances.len() as u32;
                    distances.push(distance + step);
                    queue.push(Entry { distance: distance + step, place });
                }
            }
        }
    }

    #[test]
    fn a_cell_that_comes_nearer_comes_out_then() {
        let mut queue = Queue::new(0.5);
        let mut distances = [9.0, 3.0];
        queue.push(Entry { distance: 9.0, place: 0 });
        queue.push(Entry { distance: 3.0, place: 1 });
        distances[0] = 2.0;
        queue.push(Entry { distance: 2.0, place: 0 });
        let popped: Vec<(f64, u32)> =
            std::iter::from_fn(|| queue.pop(|place| Some(distances[place as usize]), |_| ()))
                .map(|entry| (entry.distance, entry.place))
                .collect();
        assert_eq!(popped, [(2.0, 0), (2.0, 0), (3.0, 1)]);
    }

    #[test]
    fn places_are_announced_before_they_are_popped() {
        let mut queue = Queue::new(1.0);
        let distances: Vec<f64> = (0..30).map(|number| 3.0 + f64::from(number) / 31.0).collect();
        for (place, &distance) in (0..).zip(&distances) {
            queue.push(Entry { distance, place });
        }
        let announced = RefCell::new(Vec::new());
        for popped in 0..30 {
            let distance = |place| Some(distances[place as usize]);
            let entry = queue.pop(distance, |place| announced.borrow_mut().push(place)).unwrap();
            assert_eq!(entry.place, popped);
            let told = (popped + 1 + AHEAD as u32).min(30);
            assert_eq!(*announced.borrow(), (0..told).collect::<Vec<_>>());
        }
    }

    #[test]
    fn an_empty_queue_says_so() {
        let mut queue = Queue::new(1.0);
        assert!(queue.pop(|_| Some(0.0), |_| ()).is_none());
        queue.push(Entry { distance: f64::MAX, place: 3 });
        assert_eq!(queue.pop(|_| Some(f64::MAX), |_| ()).map(|entry| entry.place), Some(3));
        assert!(queue.pop(|_| Some(0.0), |_| ()).is_none());
        let mut queue = Queue::new(1.0);
        queue.push(Entry { distance: 5.0, place: 2 });
        assert!(queue.pop(|_| None, |_| ()).is_none(), "a cell that need not be popped");
    }
}
