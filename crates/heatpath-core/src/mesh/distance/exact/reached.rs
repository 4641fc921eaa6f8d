//! What is known of a vertex.

use super::sides::Arrival;
use super::window::NONE;

/// What the shortest path to a vertex comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Origin {
    /// Nothing has arrived.
    Nowhere,
    /// This source, inside a face of the vertex or the vertex itself.
    Source(u32),
    /// This neighbour, along an edge.
    Vertex(u32),
    /// This window, which enters a face through the side opposite the vertex.
    Window(u32),
}

/// A vertex as far as it is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    pub(super) distance: f64,
    pub(super) origin: Origin,
    /// The source at the end of the path.
    pub(super) source: u32,
    /// None at a source.
    pub(super) arrival: Option<Arrival>,
}

impl Reached {
    pub(super) const NOT: Self =
        Self { distance: f64::INFINITY, origin: Origin::Nowhere, source: NONE, arrival: None };
}
