//! The propagation of windows.

use super::ExactError;
use super::crowd::Crowd;
use super::place::Place;
use super::queue::{Queue, Step};
use super::reached::{Origin, Reached};
use super::sides::Sides;
use super::window::{NONE, Window, Winner, hypotenuse, is_longer};
use crate::exec::Exec;

/// The slots of the queue are so wide, in mean edges.
const SLOT: f64 = 0.25;

/// More steps than these, and so many for each side of a face, are given up: on flat grids of a million
/// faces it is 300 a side.
const MOST_STEPS: usize = 1_000_000;
const STEPS_PER_SIDE: usize = 1000;

/// So many comparisons of windows take as long as a step.
const COMPARISONS: usize = 8;

/// The caller is asked whether to go on after so many steps.
const STEPS: usize = 1 << 14;

/// Windows on their way.
pub(super) struct Propagation<'a> {
    pub(super) sides: &'a Sides,
    can_bend: &'a [bool],
    farthest: f64,
    /// Whether windows that are done stay.
    keeps: bool,
    pub(super) vertices: Vec<Reached>,
    pub(super) windows: Vec<Window>,
    /// Windows that are no longer in use.
    free: Vec<u32>,
    winners: Vec<Winner>,
    crowd: Crowd,
    queue: Queue,
    /// The distances at which paths bent at the vertices.
    bent: Vec<f64>,
    reached: usize,
}

impl<'a> Propagation<'a> {
    pub(super) fn new(sides: &'a Sides, can_bend: &'a [bool], farthest: f64, keeps: bool) -> Self {
        Self {
            sides,
            can_bend,
            farthest,
            keeps,
            vertices: vec![Reached::NOT; can_bend.len()],
            windows: Vec::new(),
            free: Vec::new(),
            winners: vec![Winner::NONE; sides.len()],
            crowd: Crowd::default(),
            queue: Queue::new(SLOT),
            bent: vec![f64::INFINITY; can_bend.len()],
            reached: 0,
        }
    }

    /// Starts at a source with this number, which lies in these places and has this offset.
    pub(super) fn start(&mut self, source: u32, places: &[Place], offset: f64) {
        if let [place] = places
            && let Some(vertex) = place.vertex(self.sides)
        {
            let origin = Origin::Source(source);
            return self.reach(vertex, Reached { distance: offset, origin, source, arrival: None });
        }
        for place in places {
            for side in place.sides() {
                let (at, [x, y]) = (self.sides.get(side), place.seen_from(self.sides, side));
                let [to_x, to_y] = [at.apex[0] - x, at.apex[1] - y];
                let reached = Reached {
                    distance: offset + hypotenuse(to_x, to_y),
                    origin: Origin::Source(source),
                    source,
                    arrival: Some(self.sides.arrival(side, [x, y])),
                };
                self.reach(at.vertex, reached);
                if place.is_off(side) {
                    let root = self.vertices.len() as u32 + source;
                    self.send(side, [x, y], offset, root);
                }
            }
        }
    }

    /// Goes on until there is nothing left to do.
    pub(super) fn run(&mut self, exec: &Exec<'_>) -> Result<(), ExactError> {
        let mut steps = 0_usize;
        let most = MOST_STEPS.saturating_add(self.sides.len().saturating_mul(STEPS_PER_SIDE));
        while let Some(step) = self.queue.pop() {
            if steps + self.crowd.comparisons / COMPARISONS > most {
                return Err(ExactError::Windows { windows: steps });
            }
            if steps.is_multiple_of(STEPS) {
                exec.report(self.reached as f64 / self.vertices.len() as f64)?;
            }
            steps += 1;
            match step {
                Step::Vertex(vertex) => self.bend(vertex),
                Step::Window(number) => self.advance(number),
            }
        }
        Ok(exec.report(1.0)?)
    }

    /// A path has come to a vertex.
    fn reach(&mut self, vertex: u32, reached: Reached) {
        let known = &mut self.vertices[vertex as usize];
        if reached.distance >= known.distance || reached.distance > self.farthest {
            return;
        }
        let is_news = is_longer(known.distance, reached.distance);
        self.reached += usize::from(known.origin == Origin::Nowhere);
        *known = reached;
        if is_news {
            self.queue.push(reached.distance, Step::Vertex(vertex));
        }
    }

    /// Paths go on from a vertex: along its edges, and into the faces behind it if they bend or begin
    /// there.
    ///
    /// Along edges they need not, but windows across needles may be lost to rounding; edges are not.
    fn bend(&mut self, vertex: u32) {
        let sides = self.sides;
        let Reached { distance, source, arrival, .. } = self.vertices[vertex as usize];
        let bent = &mut self.bent[vertex as usize];
        if !is_longer(*bent, distance) {
            return;
        }
        *bent = distance;
        for &side in sides.opposite(vertex) {
            let at = sides.get(side);
            for end in 0..2 {
                let reached = Reached {
                    distance: distance + sides.get(at.next[end]).length,
                    origin: Origin::Vertex(vertex),
                    source,
                    arrival: Some(sides.arrival_along(at.next[1 - end], vertex)),
                };
                self.reach(at.ends[end], reached);
            }
        }
        if self.can_bend[vertex as usize] || arrival.is_none() {
            for side in sides.behind(vertex, arrival) {
                self.send(side, sides.get(side).apex, distance, vertex);
            }
        }
    }

    /// Sends paths from a root in the plane of a side, on the near side of it, through all of it.
    fn send(&mut self, from: u32, image: [f64; 2], offset: f64, root: u32) {
        let span = [0.0, self.sides.get(from).length];
        self.pass(Window { image, span, offset, side: NONE, from, parent: NONE, root });
    }

    /// Lets a window into all other faces at its edge.
    fn pass(&mut self, window: Window) {
        if window.is_thin() || window.nearest() > self.farthest {
            return;
        }
        let sides = self.sides;
        for side in sides.across(window.from) {
            let mut window = Window { side, ..window };
            if self.is_beaten(&window) {
                continue;
            }
            if sides.is_crowded(side) {
                let Some(span) = self.crowd.admit(&window) else { continue };
                window.span = span;
            }
            let number = self.store(window);
            self.queue.push(window.nearest(), Step::Window(number));
        }
    }

    fn store(&mut self, window: Window) -> u32 {
        if let Some(number) = self.free.pop() {
            self.windows[number as usize] = window;
            return number;
        }
        self.windows.push(window);
        self.windows.len() as u32 - 1
    }

    fn drop(&mut self, number: u32) {
        self.windows[number as usize].side = NONE;
        self.free.push(number);
    }

    /// Looks from a window through its face: at the apex, and on through the two other sides.
    fn advance(&mut self, number: u32) {
        let window = self.windows[number as usize];
        if self.is_beaten(&window) {
            return self.drop(number);
        }
        let [start, end] = window.span;
        let crossing = window.crossing(self.sides.get(window.side).apex);
        let goes_on = if crossing < start {
            [false, self.passes_apex(&window, end)]
        } else if crossing > end {
            [self.passes_apex(&window, start), false]
        } else {
            self.see(number, window)
        };
        for end in (0..2).filter(|&end| goes_on[end]) {
            self.go_on(number, &window, end);
        }
        if !self.keeps {
            self.drop(number);
        }
    }

    /// A window sees the apex: past which ends of the side it has to go on.
    fn see(&mut self, number: u32, window: Window) -> [bool; 2] {
        let side = self.sides.get(window.side);
        let [x, y] = [side.apex[0] - window.image[0], side.apex[1] + window.image[1]];
        let distance = window.offset + hypotenuse(x, y);
        if distance < self.vertices[side.vertex as usize].distance {
            let known = self.vertices.get(window.root as usize).map(|root| root.source);
            let reached = Reached {
                distance,
                origin: Origin::Window(number),
                source: known.unwrap_or_else(|| window.root - self.vertices.len() as u32),
                arrival: Some(self.sides.arrival(window.side, [window.image[0], -window.image[1]])),
            };
            self.reach(side.vertex, reached);
        }
        let winner = &mut self.winners[window.side as usize];
        if distance < winner.length {
            *winner = Winner { image: window.image, length: distance, from: window.from };
            return [true; 2];
        }
        if !is_longer(distance, winner.length) {
            return [true; 2];
        }
        [0, 1].map(|end| !winner.hides(&window, side, end))
    }

    /// Goes on through the side between an end and the apex.
    fn go_on(&mut self, number: u32, window: &Window, end: usize) {
        let side = self.sides.get(window.side);
        let next = self.sides.get(side.next[end]);
        let starts_here = next.ends[0] == side.ends[end];
        let (image, span) = window.beyond(side, end, next.length, starts_here);
        self.pass(Window { image, span, from: side.next[end], parent: number, ..*window });
    }
}
