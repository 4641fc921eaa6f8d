//! The cells at the front, nearest first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A distance and the place of the cell that it belongs to.
///
/// The nearest entry is the greatest; of equally near ones that with the smallest place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) distance: f64,
    pub(super) place: u32,
}

impl Ord for Entry {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance.total_cmp(&self.distance).then_with(|| other.place.cmp(&self.place))
    }
}

impl PartialOrd for Entry {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
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
/// The future is divided into slots of equal width. Only the entries of the current slot are a heap,
/// of some dozens, where all of them would be one of thousands; those of later slots are piles. A
/// cell that comes nearer is pushed once more: its older entries are for the caller to pass over.
#[derive(Debug)]
pub(super) struct Queue {
    slots_per_unit: f64,
    /// The entries of the current slot and those before it.
    current: BinaryHeap<Entry>,
    /// The entries of the slots after the current one, and before the horizon.
    slots: std::vec::IntoIter<Vec<Entry>>,
    /// The number of the first of `slots`.
    next: u64,
    /// The entries beyond the horizon.
    beyond: Vec<Entry>,
}

/// The number of slots from one horizon to the next.
const SLOTS: u64 = 4096;

/// The number of the last slot there is.
const LAST: u64 = 1 << 62;

impl Queue {
    /// `width` is that of a slot: if there are some dozens of cells in each the queue is fastest,
    /// otherwise it is still right.
    pub(super) fn new(width: f64) -> Self {
        let (current, beyond) = (BinaryHeap::new(), Vec::new());
        let slots = Vec::new().into_iter();
        Self { slots_per_unit: 1.0 / width, current, slots, next: 0, beyond }
    }

    #[inline]
    pub(super) fn push(&mut self, entry: Entry) {
        let slot = self.slot(entry);
        if slot < self.next {
            self.current.push(entry);
        } else if let Some(pile) = self.slots.as_mut_slice().get_mut((slot - self.next) as usize) {
            pile.push(entry);
        } else {
            self.beyond.push(entry);
        }
    }

    /// The nearest entry. `is_valid` is asked at times, but not always, for entries that need not be
    /// kept.
    #[inline]
    pub(super) fn pop(&mut self, is_valid: impl Fn(&Entry) -> bool) -> Option<Entry> {
        while self.current.is_empty() {
            self.advance(&is_valid)?;
        }
        self.current.pop()
    }

    #[inline]
    fn slot(&self, entry: Entry) -> u64 {
        ((entry.distance * self.slots_per_unit) as u64).min(LAST)
    }

    /// Makes the next slot the current one; `None` at the end of all.
    fn advance(&mut self, is_valid: impl Fn(&Entry) -> bool) -> Option<()> {
        if let Some(mut pile) = self.slots.next() {
            self.next += 1;
            pile.retain(is_valid);
            self.current = pile.into();
            return Some(());
        }
        self.next = self.beyond.iter().map(|&entry| self.slot(entry)).min()?;
        self.slots = vec![Vec::new(); SLOTS as usize].into_iter();
        for entry in std::mem::take(&mut self.beyond) {
            self.push(entry);
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_come_out_in_order() {
        for width in [1e-300, 1e-3, 0.5, 1e3] {
            let mut queue = Queue::new(width);
            let mut last = (0.0, 0);
            queue.push(Entry { distance: 0.0, place: 0 });
            for number in 1..5000_u32 {
                let Entry { distance, place } = queue.pop(|_| true).unwrap();
                assert!(last <= (distance, place), "{last:?} and then {distance} at {place}");
                last = (distance, place);
                for more in 1..3 {
                    let step = f64::from(number * more * 7919 % 499).powi(2);
                    queue.push(Entry { distance: distance + step, place: number });
                }
            }
        }
    }

    #[test]
    fn an_empty_queue_says_so() {
        let mut queue = Queue::new(1.0);
        assert!(queue.pop(|_| true).is_none());
        queue.push(Entry { distance: f64::MAX, place: 3 });
        assert_eq!(queue.pop(|_| true).map(|entry| entry.place), Some(3));
        assert!(queue.pop(|_| true).is_none());
    }
}
