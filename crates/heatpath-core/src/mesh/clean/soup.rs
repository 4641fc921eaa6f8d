//! Points and polygons as they come.

/// Points and polygons, not checked yet: [`clean`](super::clean) makes a mesh of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soup {
    points: Vec<[f64; 3]>,
    /// The corners of all polygons, one after the other.
    corners: Vec<u32>,
    /// Where each polygon ends.
    ends: Vec<usize>,
}

impl Soup {
    /// Points without polygons.
    #[must_use]
    pub fn new(points: Vec<[f64; 3]>) -> Self {
        Self { points, ..Self::default() }
    }

    /// Adds a point; the first one has the number 0.
    pub fn push_point(&mut self, point: [f64; 3]) {
        self.points.push(point);
    }

    /// Adds a polygon, by the numbers of its points in the order around it.
    pub fn push(&mut self, corners: impl IntoIterator<Item = u32>) {
        self.corners.extend(corners);
        self.ends.push(self.corners.len());
    }

    /// The points.
    #[must_use]
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The corners of each polygon.
    pub fn polygons(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        let start = |polygon: usize| if polygon == 0 { 0 } else { self.ends[polygon - 1] };
        (0..self.ends.len()).map(move |polygon| &self.corners[start(polygon)..self.ends[polygon]])
    }
}
