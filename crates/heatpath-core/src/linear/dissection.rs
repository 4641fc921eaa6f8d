//! The order in which unknowns are eliminated, found from where they lie.

use crate::lists::Lists;
use std::collections::VecDeque;

/// Parts of at most so many unknowns are not divided further.
const SMALLEST_PART: usize = 32;

/// Nested dissection (George 1973) of unknowns that lie at `points` and are coupled in pairs.
///
/// A few unknowns whose removal parts the others in two halves are put last, the halves before
/// them, each in the same way. The halves lie on two sides of a plane across the longest side of
/// their box, or are nearer to and further from one end by the number of couplings: whatever takes
/// fewer unknowns out. Of the pairs that the halves share the fewest unknowns that touch all of them
/// are taken (König 1931). On a surface the factor then has of the order of n log n entries.
///
/// Returns the unknowns in the order of elimination.
#[must_use]
pub fn nested_dissection(points: &[[f64; 3]], couplings: &[[usize; 2]]) -> Vec<usize> {
    let mut dissection = Dissection {
        points,
        neighbours: Lists::new(points.len(), || {
            couplings.iter().flat_map(|&[a, b]| [(a as u32, b as u32), (b as u32, a as u32)])
        }),
        part: vec![ALL; points.len()],
        mark: vec![0; points.len()],
        parts: ALL,
        marks: 0,
        order: Vec::with_capacity(points.len()),
    };
    let mut all: Vec<u32> = (0..points.len() as u32).collect();
    dissection.put(&mut all);
    dissection.order.reverse();
    dissection.order
}

/// The part that all unknowns belong to in the beginning.
const ALL: u32 = 1;

/// The part of unknowns that are in order already.
const PLACED: u32 = 0;

struct Dissection<'a> {
    points: &'a [[f64; 3]],
    neighbours: Lists,
    /// The part that each unknown belongs to.
    part: Vec<u32>,
    /// What was last found out about each unknown: see where it is used.
    mark: Vec<u32>,
    parts: u32,
    marks: u32,
    /// The last unknown first.
    order: Vec<usize>,
}

impl Dissection<'_> {
    /// Puts the unknowns of a part in order, the last ones first.
    fn put(&mut self, part: &mut [u32]) {
        if part.len() <= SMALLEST_PART {
            part.iter().for_each(|&unknown| self.order.push(unknown as usize));
            return;
        }
        let name = self.part[part[0] as usize];
        let half = self.halve(part);
        let (near, far) = part.split_at_mut(half);
        let separator = self.separator(near, far, name);
        for &unknown in &separator {
            self.part[unknown as usize] = PLACED;
            self.order.push(unknown as usize);
        }
        for side in [near, far] {
            self.parts += 1;
            let kept = self.keep(side);
            side[..kept].iter().for_each(|&unknown| self.part[unknown as usize] = self.parts);
            if kept > 0 {
                self.put(&mut side[..kept]);
            }
        }
    }

    /// Moves the unknowns that are not placed to the front; how many they are.
    fn keep(&self, side: &mut [u32]) -> usize {
        let mut kept = 0;
        for i in 0..side.len() {
            if self.part[side[i] as usize] != PLACED {
                side.swap(kept, i);
                kept += 1;
            }
        }
        kept
    }

    /// Sorts the part into two halves, in the better of two ways; how many are in the first one.
    fn halve(&mut self, part: &mut [u32]) -> usize {
        let name = self.part[part[0] as usize];
        let half = part.len() / 2;
        let by_steps = self.by_steps(part[0], name);
        let by_place = self.by_place(part);
        part.copy_from_slice(&by_place);
        // Unknowns that are not connected with the first one make no second half.
        if by_steps.len() == part.len()
            && self.cut(&by_steps[..half], name) < self.cut(&by_place[..half], name)
        {
            part.copy_from_slice(&by_steps);
        }
        half
    }

    /// The part sorted at the middle of the longest side of its box.
    fn by_place(&self, part: &[u32]) -> Vec<u32> {
        let place = |unknown: u32, axis: usize| self.points[unknown as usize][axis];
        let side = |axis: usize| {
            let places = part.iter().map(|&unknown| place(unknown, axis));
            let [low, high] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            });
            high - low
        };
        let sides = [side(0), side(1), side(2)];
        let axis = (0..3).max_by(|&a, &b| sides[a].total_cmp(&sides[b])).unwrap_or(0);
        let mut sorted = part.to_vec();
        sorted.select_nth_unstable_by(part.len() / 2, |&a, &b| {
            place(a, axis).total_cmp(&place(b, axis)).then(a.cmp(&b))
        });
        sorted
    }

    /// The unknowns connected with `any`, by the number of couplings from one of those that are
    /// furthest from it.
    fn by_steps(&mut self, any: u32, name: u32) -> Vec<u32> {
        let reached = self.reached(any, name);
        self.reached(*reached.last().unwrap_or(&any), name)
    }

    fn reached(&mut self, from: u32, name: u32) -> Vec<u32> {
        self.marks += 1;
        self.mark[from as usize] = self.marks;
        let (mut reached, mut next) = (vec![from], 0);
        while next < reached.len() {
            for &neighbour in self.neighbours.of(reached[next] as usize) {
                let place = neighbour as usize;
                if self.part[place] == name && self.mark[place] != self.marks {
                    self.mark[place] = self.marks;
                    reached.push(neighbour);
                }
            }
            next += 1;
        }
        reached
    }

    /// How many of `near` touch the rest of their part.
    fn cut(&mut self, near: &[u32], name: u32) -> usize {
        self.marks += 1;
        near.iter().for_each(|&unknown| self.mark[unknown as usize] = self.marks);
        let touches = |&&unknown: &&u32| {
            let others = self.neighbours.of(unknown as usize).iter();
            let mut others = others.map(|&other| other as usize);
            others.any(|other| self.part[other] == name && self.mark[other] != self.marks)
        };
        near.iter().filter(touches).count()
    }

    /// The fewest unknowns that touch all couplings between the two halves.
    fn separator(&mut self, near: &[u32], far: &[u32], name: u32) -> Vec<u32> {
        self.marks += 1;
        far.iter().for_each(|&unknown| self.mark[unknown as usize] = self.marks);
        let mut pairs = Pairs::default();
        let across = |&other: &u32| {
            self.part[other as usize] == name && self.mark[other as usize] == self.marks
        };
        for &unknown in near {
            let others: Vec<u32> =
                self.neighbours.of(unknown as usize).iter().copied().filter(across).collect();
            if !others.is_empty() {
                pairs.near.push(unknown);
                pairs.others.push(others);
            }
        }
        pairs.cover()
    }
}

/// Unknowns of one half with those of the other half that they are coupled with.
#[derive(Default)]
struct Pairs {
    near: Vec<u32>,
    others: Vec<Vec<u32>>,
}

impl Pairs {
    /// The fewest unknowns that touch all pairs: as many as the most pairs without an unknown in
    /// common, by König's theorem.
    fn cover(mut self) -> Vec<u32> {
        let far = self.number_far();
        let mut partner = vec![None; far.len()];
        let mut is_paired = vec![false; self.near.len()];
        // === Most pairs: first what is free, then by exchange
        for (near, others) in self.others.iter().enumerate() {
            if let Some(&free) = others.iter().find(|&&other| partner[other as usize].is_none()) {
                partner[free as usize] = Some(near);
                is_paired[near] = true;
            }
        }
        let mut seen = vec![usize::MAX; far.len()];
        for (near, is_paired) in is_paired.iter_mut().enumerate() {
            *is_paired = *is_paired || self.pair(near, &mut partner, &mut seen);
        }
        // === What can be reached from the unpaired by turns
        let (mut is_reached, mut is_reached_far) =
            (vec![false; self.near.len()], vec![false; far.len()]);
        let mut queue: VecDeque<usize> =
            (0..self.near.len()).filter(|&near| !is_paired[near]).collect();
        queue.iter().for_each(|&near| is_reached[near] = true);
        while let Some(near) = queue.pop_front() {
            for &other in &self.others[near] {
                is_reached_far[other as usize] = true;
                if let Some(next) = partner[other as usize]
                    && !is_reached[next]
                {
                    is_reached[next] = true;
                    queue.push_back(next);
                }
            }
        }
        let near = self.near.iter().zip(&is_reached).filter(|(_, reached)| !**reached);
        let far = far.iter().zip(&is_reached_far).filter(|(_, reached)| **reached);
        near.chain(far).map(|(&unknown, _)| unknown).collect()
    }

    /// Numbers the unknowns of the far half from 0; the unknowns of the numbers.
    fn number_far(&mut self) -> Vec<u32> {
        let mut far: Vec<u32> = self.others.iter().flatten().copied().collect();
        far.sort_unstable();
        far.dedup();
        for other in self.others.iter_mut().flatten() {
            *other = far.partition_point(|&unknown| unknown < *other) as u32;
        }
        far
    }

    /// Finds a partner for `near`, exchanging those of others if need be.
    fn pair(&self, near: usize, partner: &mut [Option<usize>], seen: &mut [usize]) -> bool {
        // The way of exchanges: an unknown, and the next of its others to try.
        let mut way = vec![(near, 0)];
        while let Some((here, next)) = way.last_mut() {
            let Some(&other) = self.others[*here].get(*next) else {
                way.pop();
                continue;
            };
            *next += 1;
            let other = other as usize;
            if std::mem::replace(&mut seen[other], near) == near {
                continue;
            }
            match partner[other] {
                Some(rival) => way.push((rival, 0)),
                None => {
                    for &(near, next) in &way {
                        partner[self.others[near][next - 1] as usize] = Some(near);
                    }
                    return true;
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(side: usize) -> (Vec<[f64; 3]>, Vec<[usize; 2]>) {
        let number = |x: usize, y: usize| y * side + x;
        let places = || (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
        let points = places().map(|(x, y)| [x as f64, y as f64, 0.0]).collect();
        let right =
            places().filter(|&(x, _)| x + 1 < side).map(|(x, y)| [number(x, y), number(x + 1, y)]);
        let down =
            places().filter(|&(_, y)| y + 1 < side).map(|(x, y)| [number(x, y), number(x, y + 1)]);
        (points, right.chain(down).collect())
    }

    #[test]
    fn every_unknown_is_there_once() {
        let (points, mut couplings) = sheet(30);
        // Parts that do not hang together, a pair twice, and all in one place.
        couplings.retain(|&[a, b]| a % 30 != 14 && b % 30 != 14 && a > 60);
        couplings.push(couplings[7]);
        for points in [points.clone(), vec![[1.0; 3]; 900]] {
            let mut order = nested_dissection(&points, &couplings);
            order.sort_unstable();
            assert!(order.into_iter().eq(0..900));
        }
        assert_eq!(nested_dissection(&[], &[]), [0_usize; 0]);
    }

    #[test]
    fn the_last_unknowns_part_the_others() {
        let (points, couplings) = sheet(40);
        let order = nested_dissection(&points, &couplings);
        let mut is_gone = vec![false; 1600];
        order[1560..].iter().for_each(|&unknown| is_gone[unknown] = true);
        let mut component: Vec<usize> = (0..1600).collect();
        for _ in 0..1600 {
            for &[a, b] in couplings.iter().filter(|pair| pair.iter().all(|&end| !is_gone[end])) {
                let low = component[a].min(component[b]);
                (component[a], component[b]) = (low, low);
            }
        }
        let mut sizes = std::collections::BTreeMap::new();
        let left = (0..1600).filter(|&unknown| !is_gone[unknown]);
        left.for_each(|unknown| *sizes.entry(component[unknown]).or_insert(0) += 1);
        assert_eq!(sizes.into_values().collect::<Vec<_>>(), [760, 800]);
    }

    #[test]
    fn the_cover_is_the_smallest() {
        // Three of the near ones share one of the far ones: that one is enough.
        let pairs =
            Pairs { near: vec![0, 1, 2, 3], others: vec![vec![9], vec![9], vec![9], vec![7, 8]] };
        assert_eq!(pairs.cover(), [3, 9]);
    }
}
