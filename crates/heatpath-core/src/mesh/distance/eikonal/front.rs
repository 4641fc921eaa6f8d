//! A front that crosses a triangle.

use crate::mesh::triangle::third_corner;

/// When and how a front arrives at a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival {
    /// The distance of the vertex.
    pub(super) time: f64,
    /// How far away the centre of the front's circle is, in lengths: infinite for a straight front,
    /// negative for a hollow one, which closes in.
    pub(super) radius: f64,
    /// The slowness of the face that the front came through.
    pub(super) slowness: f64,
    /// The number of the source that it comes from.
    pub(super) source: u32,
    /// When the front began: the time at the source, or where it began anew.
    pub(super) began: f64,
    /// The vertex around which the front began anew, if it did.
    pub(super) centre: Option<u32>,
}

/// Times that differ by less than this part are the same.
const SAME: f64 = 1e-12;

impl Arrival {
    pub(super) const NONE: Self = Self {
        time: f64::INFINITY,
        radius: f64::INFINITY,
        slowness: 1.0,
        source: u32::MAX,
        began: 0.0,
        centre: None,
    };

    /// Whether this is earlier than another arrival.
    pub(super) fn is_before(&self, other: &Self) -> bool {
        other.time == f64::INFINITY || self.time < other.time - SAME * other.time.abs()
    }

    /// The arrival further along an edge.
    pub(super) fn along(&self, length: f64, slowness: f64) -> Self {
        let time = self.time + slowness * length;
        Self { time, radius: self.radius + length, slowness, ..*self }
    }

    /// The same arrival as the beginning of a front around its `vertex`.
    pub(super) fn anew(&self, vertex: u32) -> Self {
        Self { radius: 0.0, began: self.time, centre: Some(vertex), ..*self }
    }
}

/// Fronts are taken for straight from so many edges on.
const STRAIGHT: f64 = 1e6;

/// Fronts that took at least this part of the time from their centre came straight from there.
const DIRECT: f64 = 0.99;

/// A triangle with a front at two of its corners, on its way to the third.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// The other two corners lie at `[0, 0]` and `[base, 0]`.
    base: f64,
    apex: [f64; 2],
    slowness: f64,
    /// The Gaussian curvature of the surface.
    curvature: f64,
}

/// The front in the triangle's plane.
#[derive(Clone, Copy, Debug)]
enum Front {
    /// A circle around `[along, -below]`; it is hollow if `below` is negative.
    Round { along: f64, below: f64 },
    /// A straight line that moves in this direction.
    Straight([f64; 2]),
}

/// How a front gets from the base to the apex.
#[derive(Clone, Copy, Debug)]
struct Pass {
    /// How much later than at the first end of the base, in lengths.
    delay: f64,
    /// The radius at the apex, if the surface is flat.
    radius: f64,
    /// The length from the base.
    way: f64,
    /// Whether it crosses the base nearer to its second end.
    is_second_nearer: bool,
}

impl Triangle {
    /// Side i is opposite corner i; the third corner is the one to be reached.
    pub(super) fn new(sides: [f64; 3], slowness: f64, curvature: f64) -> Self {
        Self { base: sides[2], apex: third_corner(sides), slowness, curvature }
    }

    /// The arrival at the third corner of the front that arrived at the other two, if its way leads
    /// through the triangle.
    pub(super) fn cross(&self, from: [&Arrival; 2]) -> Option<Arrival> {
        let slope = (from[1].time - from[0].time) / self.base;
        let sine = slope / self.slowness;
        let cosine_sq = 1.0 - sine * sine;
        if cosine_sq.is_nan() || cosine_sq <= 0.0 {
            return None;
        }
        let radius = self.radius(from, slope, cosine_sq);
        let straight = Front::Straight([sine, cosine_sq.sqrt()]);
        let time = |pass: &Pass| from[0].time + self.slowness * pass.delay;
        // === Whatever the circle, nothing arrives before it was at the base, unless straight from the
        // beginning
        let earliest = from[0].time.min(from[1].time);
        let is_possible = |pass: &Pass| {
            let since = time(pass) - from[0].began.max(from[1].began);
            time(pass) >= earliest || since >= DIRECT * self.slowness * pass.radius.abs()
        };
        let round = self.circle(radius, sine).and_then(|circle| self.pass(circle, radius, sine));
        let round = round.filter(is_possible);
        let pass = round.or_else(|| self.pass(straight, radius, sine))?;
        let bend = 1.0 / pass.radius - self.curvature * pass.way;
        let nearer = from[usize::from(pass.is_second_nearer)];
        Some(Arrival {
            time: time(&pass).max(nearer.began),
            radius: if bend.is_nan() { f64::INFINITY } else { 1.0 / bend },
            slowness: self.slowness,
            ..*nearer
        })
    }

    /// The way of a front to the apex, if it crosses the base.
    fn pass(&self, front: Front, radius: f64, sine: f64) -> Option<Pass> {
        let [x, y] = self.apex;
        let (crossing, delay, radius) = match front {
            Front::Round { along, below } => {
                let far = (x - along).hypot(y + below).copysign(radius);
                let first = radius - 0.5 * sine * self.base;
                (along + (x - along) * below / (below + y), far - first, far)
            }
            Front::Straight([sine, cosine]) => {
                (x - y * sine / cosine, x * sine + y * cosine, radius + y / cosine)
            }
        };
        let margin = 1e-9 * self.base;
        let is_inside = crossing >= -margin && crossing <= self.base + margin;
        let way = (x - crossing).hypot(y);
        let is_second_nearer = crossing > 0.5 * self.base;
        is_inside.then_some(Pass { delay, radius, way, is_second_nearer })
    }

    /// The radius of the front in this triangle, in the middle of the base.
    ///
    /// Along an edge between faces of different slowness times and their second derivative are the
    /// same on both sides: `slowness cos^2 / radius`, of the angle of incidence (the lens equation).
    fn radius(&self, from: [&Arrival; 2], slope: f64, cosine_sq: f64) -> f64 {
        if from[0].source != from[1].source {
            return f64::INFINITY;
        }
        let refracted = from.map(|arrival| {
            if arrival.slowness == self.slowness {
                return arrival.radius;
            }
            let before = 1.0 - (slope / arrival.slowness).powi(2);
            let bend = arrival.slowness * before.max(0.0) / arrival.radius;
            self.slowness * cosine_sq / bend
        });
        // === Both in the middle, where they are the same unless the surface or the medium varies
        let half = 0.5 * slope / self.slowness * self.base;
        let radius = 2.0 / (1.0 / (refracted[0] + half) + 1.0 / (refracted[1] - half));
        if radius.is_nan() { f64::INFINITY } else { radius }
    }

    /// The circle that is as far from both ends of the base as the times there say, if there is one.
    fn circle(&self, radius: f64, sine: f64) -> Option<Front> {
        let along = 0.5 * self.base - sine * radius;
        let first = radius - 0.5 * sine * self.base;
        let below_sq = (first - along) * (first + along);
        let below = below_sq.max(0.0).sqrt().copysign(radius);
        // A hollow front must not close inside the triangle.
        let is_apart = below > 0.0 || below < -2.0 * self.apex[1];
        let is_round = below_sq > 0.0 && is_apart && radius.abs() < STRAIGHT * self.base;
        is_round.then_some(Front::Round { along, below })
    }
}
