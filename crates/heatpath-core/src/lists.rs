//! Many short lists in one piece of memory.

use std::ops::Range;

/// A list of numbers for each of `0..len()`, such as the faces at each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Lists {
    /// Where each list starts, and where the last one ends.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// The lists of `count` owners, from pairs of an owner and an item; a list keeps the order of
    /// the pairs.
    pub(crate) fn new<I: Iterator<Item = (u32, u32)>>(count: usize, pairs: impl Fn() -> I) -> Self {
        let mut starts = vec![0_u32; count + 1];
        pairs().for_each(|(owner, _)| starts[owner as usize + 1] += 1);
        (0..count).for_each(|owner| starts[owner + 1] += starts[owner]);
        let (mut next, mut items) = (starts.clone(), vec![0; starts[count] as usize]);
        for (owner, item) in pairs() {
            let place = &mut next[owner as usize];
            items[*place as usize] = item;
            *place += 1;
        }
        Self { starts, items }
    }

    /// The number of lists.
    #[must_use]
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there is no list.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The list with this number.
    #[inline]
    #[must_use]
    pub fn of(&self, number: usize) -> &[u32] {
        &self.items[self.range(number)]
    }

    /// Where the list with this number lies among all items.
    #[inline]
    pub(crate) fn range(&self, number: usize) -> Range<usize> {
        self.starts[number] as usize..self.starts[number + 1] as usize
    }
}
