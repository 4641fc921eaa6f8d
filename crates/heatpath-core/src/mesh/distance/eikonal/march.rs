//! Fast marching: vertices in the order of their distance, each by way of those before it.

use super::front::Arrival;
use super::surface::Surface;
use crate::exec::{Cancelled, Exec};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How often a watch is asked, in vertices.
const REPORT_EVERY: usize = 1 << 14;

/// A vertex is done again at most so often. Where corners are obtuse a front may arrive at a vertex by
/// way of one that is done later.
const MOST_VISITS: u8 = 16;

/// A vertex in the queue: the nearest comes first, and of equally near ones that with the smallest
/// number.
#[derive(PartialEq)]
struct Entry {
    time: f64,
    vertex: u32,
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.time.total_cmp(&self.time).then_with(|| other.vertex.cmp(&self.vertex))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The arrivals at all vertices up to the distance `farthest`, from those at a few of them.
pub(super) fn march(
    surface: &Surface,
    seeds: &[(u32, Arrival)],
    farthest: f64,
    exec: &Exec,
) -> Result<Vec<Arrival>, Cancelled> {
    let mut arrivals = vec![Arrival::NONE; surface.vertices()];
    let mut visits = vec![0_u8; arrivals.len()];
    let mut is_known = vec![false; arrivals.len()];
    let mut queue = BinaryHeap::new();
    for &(vertex, arrival) in seeds {
        if arrival.is_before(&arrivals[vertex as usize]) {
            arrivals[vertex as usize] = arrival;
            queue.push(Entry { time: arrival.time, vertex });
        }
    }
    // Vertices beyond may still bring those before them nearer.
    let last = farthest + surface.longest();
    let (mut done, mut offers) = (0_usize, Vec::new());
    while let Some(Entry { time, vertex }) = queue.pop() {
        let place = vertex as usize;
        if is_known[place] || time != arrivals[place].time {
            continue;
        }
        if time > last {
            break;
        }
        is_known[place] = true;
        visits[place] += 1;
        surface.spread(
            vertex,
            &arrivals,
            |other| is_known[other as usize],
            |target, arrival| {
                offers.push((target, arrival));
            },
        );
        for (target, arrival) in offers.drain(..) {
            let old = &mut arrivals[target as usize];
            if arrival.is_before(old) && visits[target as usize] < MOST_VISITS {
                *old = arrival;
                is_known[target as usize] = false;
                queue.push(Entry { time: arrival.time, vertex: target });
            }
        }
        done += 1;
        if done.is_multiple_of(REPORT_EVERY) {
            exec.report((done as f64 / arrivals.len() as f64).min(1.0))?;
        }
    }
    for arrival in arrivals.iter_mut().filter(|arrival| arrival.time > farthest) {
        *arrival = Arrival::NONE;
    }
    Ok(arrivals)
}
