//! A mesh and how its caller counts vertices.

use super::report::hp_mesh_report;
use crate::array::hp_array;
use crate::items::Items;
use crate::numbers::integers;
use crate::status::{Failure, HP_INVALID_BUFFER, HP_INVALID_MESH, HP_INVALID_POINT};
use heatpath_core::mesh::clean::{CleanOptions, CleanReport, Cleaned, Soup, clean};
use heatpath_core::mesh::{MeshError, PointError, SurfacePoint, TriMesh};
use std::sync::Arc;

/// A mesh whose vertices the caller counts in another way if some were welded.
pub(crate) struct Surface {
    mesh: Arc<TriMesh>,
    /// The vertex of the mesh that each one of the caller became.
    vertices: Vec<u32>,
    /// The first vertex of the caller that became each one of the mesh.
    firsts: Vec<u32>,
    report: CleanReport,
}

/// More of anything have no numbers.
const MOST: usize = u32::MAX as usize / 3;

impl Surface {
    /// Reads and cleans a mesh; `starts` may be NULL.
    ///
    /// # Safety
    /// The pointers are NULL, misaligned, or point to descriptions of readable items.
    pub(crate) unsafe fn read(
        points: *const hp_array,
        faces: *const hp_array,
        starts: *const hp_array,
        options: CleanOptions,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller's promise, for each of the pointers.
        unsafe {
            let points = Items::<3>::read(points, "points")?;
            check_count(points.count(), 0)?;
            let mut soup = Soup::new(points.values()?);
            match integers(starts, "starts")? {
                None => push_triangles(&mut soup, &Items::read(faces, "faces")?)?,
                Some(starts) => push_polygons(&mut soup, &Items::read(faces, "faces")?, &starts)?,
            }
            Ok(Self::new(clean(&soup, options)?))
        }
    }

    fn new(cleaned: Cleaned) -> Self {
        let Cleaned { mesh, report, vertices } = cleaned;
        let mut firsts = vec![0; mesh.points().len()];
        for (vertex, &own) in vertices.iter().enumerate().rev() {
            firsts[own as usize] = vertex as u32;
        }
        Self { mesh: Arc::new(mesh), vertices, firsts, report }
    }

    pub(crate) fn mesh(&self) -> &Arc<TriMesh> {
        &self.mesh
    }

    pub(crate) fn report(&self) -> hp_mesh_report {
        hp_mesh_report::new(self.vertices.len(), self.mesh.faces().len(), &self.report)
    }

    /// The number of the caller's vertices.
    pub(crate) fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// What belongs to the vertices of the mesh, in the order of the caller's.
    pub(crate) fn in_order<'a, T>(
        &'a self,
        of_own: impl Fn(usize) -> T + 'a,
    ) -> impl Iterator<Item = T> + 'a {
        self.vertices.iter().map(move |&own| of_own(own as usize))
    }

    /// One of the caller's values for each vertex of the mesh.
    pub(crate) fn own_values(&self, values: &[f64]) -> Result<Vec<f64>, Failure> {
        if values.len() != self.vertices.len() {
            let (given, count) = (values.len(), self.vertices.len());
            let message = format!("{given} values were given for {count} vertices");
            return Err(Failure::new(HP_INVALID_BUFFER, message).of("values"));
        }
        Ok(self.firsts.iter().map(|&vertex| values[vertex as usize]).collect())
    }

    /// The corners of each face, by the caller's vertices.
    pub(crate) fn faces(&self) -> impl Iterator<Item = [i32; 3]> + '_ {
        let faces = self.mesh.faces().iter();
        faces.map(|face| face.map(|own| self.firsts[own as usize] as i32))
    }

    /// Whether a face uses one of the caller's vertices.
    pub(crate) fn is_used(&self, vertex: usize) -> bool {
        !self.mesh.adjacency().vertex_faces().of(self.vertices[vertex] as usize).is_empty()
    }

    /// One of the caller's vertices as a point of the surface.
    pub(crate) fn at_vertex(
        &self,
        role: &'static str,
        number: usize,
        vertex: i128,
    ) -> Result<SurfacePoint, Failure> {
        let found = usize::try_from(vertex).ok().filter(|&vertex| vertex < self.vertices.len());
        let Some(found) = found else {
            let count = self.vertices.len();
            let message =
                format!("{role} {number} is vertex {vertex}, but there are {count} (from 0)");
            return Err(Failure::new(HP_INVALID_POINT, message));
        };
        let point = self.mesh.at_vertex(role, number, self.vertices[found]);
        // The error would name the vertex of the mesh.
        Ok(point.map_err(|_| PointError::Unused { role, number, vertex: found as u32 })?)
    }
}

fn check_count(points: usize, faces: usize) -> Result<(), Failure> {
    let fits = points.max(faces) <= MOST;
    if fits { Ok(()) } else { Err(MeshError::TooLarge { points, faces }.into()) }
}

/// # Safety
/// The items can be read.
unsafe fn push_triangles(soup: &mut Soup, faces: &Items<3>) -> Result<(), Failure> {
    check_count(soup.points().len(), faces.count())?;
    // SAFETY: the caller's promise.
    for (face, corners) in unsafe { faces.integers()? }.into_iter().enumerate() {
        push(soup, face, &corners)?;
    }
    Ok(())
}

/// # Safety
/// The items can be read.
unsafe fn push_polygons(soup: &mut Soup, faces: &Items<1>, starts: &[i128]) -> Result<(), Failure> {
    check_count(soup.points().len(), starts.len())?;
    check_count(soup.points().len(), faces.count() / 3)?;
    // SAFETY: the caller's promise.
    let corners: Vec<i128> = unsafe { faces.integers()? }.into_iter().flatten().collect();
    for (face, range) in ranges(starts, corners.len()).enumerate() {
        let Some(range) = range else {
            let (from, to, count) = (starts[face], starts[face + 1], corners.len());
            let message =
                format!("polygon {face} goes from {from} to {to}, but there are {count} corners");
            return Err(Failure::new(HP_INVALID_MESH, message).of("starts"));
        };
        push(soup, face, &corners[range])?;
    }
    Ok(())
}

/// The ranges between neighbours of `starts`, if they go forward and not beyond the `end`.
pub(crate) fn ranges(
    starts: &[i128],
    end: usize,
) -> impl Iterator<Item = Option<std::ops::Range<usize>>> + '_ {
    starts.windows(2).map(move |pair| {
        let [from, to] = [pair[0], pair[1]].map(|place| usize::try_from(place).ok());
        let range = from?..to?;
        (range.start <= range.end && range.end <= end).then_some(range)
    })
}

fn push(soup: &mut Soup, face: usize, corners: &[i128]) -> Result<(), Failure> {
    let count = soup.points().len();
    let inside = 0..count as i128;
    if let Some(vertex) = corners.iter().find(|vertex| !inside.contains(vertex)) {
        let message = format!("face {face} uses vertex {vertex}, but there are {count} (from 0)");
        return Err(Failure::new(HP_INVALID_MESH, message).of("faces"));
    }
    soup.push(corners.iter().map(|&vertex| vertex as u32));
    Ok(())
}
