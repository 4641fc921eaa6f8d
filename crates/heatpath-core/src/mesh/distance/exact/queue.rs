//! What is still to be done, roughly in the order of distance.

use std::collections::BTreeMap;

/// A step of the propagation.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// Paths that bend at this vertex.
    Vertex(u32),
    /// What this window sees.
    Window(u32),
}

/// A queue of slots of equal width: within a slot the order is that of a pile.
///
/// The propagation corrects itself, so a strict order would save hardly any windows, and costs more
/// than it saves (Xu, Wang, Liu, Liu and He, Fast Wavefront Propagation, 2015).
#[derive(Debug)]
pub(super) struct Queue {
    width: f64,
    /// The number of the slot in work, and its steps.
    number: u64,
    slot: Vec<Step>,
    later: BTreeMap<u64, Vec<Step>>,
}

impl Queue {
    pub(super) fn new(width: f64) -> Self {
        Self { width, number: 0, slot: Vec::new(), later: BTreeMap::new() }
    }

    /// Adds a step to be done at `distance`, which is not negative.
    pub(super) fn push(&mut self, distance: f64, step: Step) {
        let number = (distance / self.width) as u64;
        if number <= self.number {
            self.slot.push(step);
        } else {
            self.later.entry(number).or_default().push(step);
        }
    }

    pub(super) fn pop(&mut self) -> Option<Step> {
        while self.slot.is_empty() {
            (self.number, self.slot) = self.later.pop_first()?;
        }
        self.slot.pop()
    }
}
