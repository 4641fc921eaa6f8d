//! Where distances count from.

use super::{PointError, SurfacePoint, TriMesh};

/// A point from which distances count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
    /// Where it lies.
    pub point: SurfacePoint,
    /// The distance at the source itself; 0 unless told otherwise. A source that lies further from
    /// another one than its offset says is not heard of.
    pub offset: f64,
    /// What the map's labels call it. Points of one curve share a label.
    pub label: u32,
}

/// Points of the surface from which distances count.
#[derive(Clone, Debug, PartialEq)]
pub struct Sources {
    list: Vec<Source>,
}

impl Sources {
    /// Sources at `points`, with their numbers as labels and no offsets.
    ///
    /// # Errors
    /// There are none, or one is not on the mesh.
    pub fn new(mesh: &TriMesh, points: &[SurfacePoint]) -> Result<Self, PointError> {
        let source = |(label, &point)| Source { point, offset: 0.0, label: label as u32 };
        Self::with_offsets(mesh, points.iter().enumerate().map(source).collect())
    }

    /// Sources with offsets and labels.
    ///
    /// # Errors
    /// There are none, one is not on the mesh, or an offset is not finite.
    pub fn with_offsets(mesh: &TriMesh, list: Vec<Source>) -> Result<Self, PointError> {
        mesh.check_points("source", list.iter().map(|source| source.point))?;
        if let Some(number) = list.iter().position(|source| !source.offset.is_finite()) {
            let value = list[number].offset;
            return Err(PointError::NotFinite { role: "source", number, value });
        }
        Ok(Self { list })
    }

    /// Sources at `vertices`, with their numbers in this list as labels.
    ///
    /// # Errors
    /// There are none, or one does not exist or has no faces.
    pub fn at_vertices(mesh: &TriMesh, vertices: &[u32]) -> Result<Self, PointError> {
        let at = |(number, &vertex)| mesh.at_vertex("source", number, vertex);
        Self::new(mesh, &vertices.iter().enumerate().map(at).collect::<Result<Vec<_>, _>>()?)
    }

    /// The sources.
    #[must_use]
    pub fn list(&self) -> &[Source] {
        &self.list
    }
}
