//! From what a file holds to a mesh.

mod polygon;
mod report;
mod soup;
mod weld;

pub use report::CleanReport;
pub use soup::Soup;

use super::tri_mesh::check_points;
use super::{MeshError, TriMesh};
use crate::error::{ParameterError, check};
use polygon::triangulate;
use std::collections::HashSet;
use thiserror::Error;

/// Polygons with more corners are refused: cutting them takes the square of their number.
const MOST_CORNERS: usize = 1 << 14;

/// Distances below this one join nothing that 0 does not.
const LEAST_WELD: f64 = 1e-100;

/// How [`clean`] treats vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CleanOptions {
    /// Joins vertices at most this far apart, in the units of the points: 0 for equal positions
    /// only, else from 1e-100. A vertex joins the first one kept so near to it. Default: none, and the numbers of vertices stay those
    /// of the file.
    pub weld: Option<f64>,
}

/// A mesh, what was found on the way to it, and which vertex became which.
#[derive(Clone, Debug, PartialEq)]
pub struct Cleaned {
    /// The mesh.
    pub mesh: TriMesh,
    /// What was dropped, and what the mesh is like.
    pub report: CleanReport,
    /// For each point of the soup, its vertex in the mesh: its own number unless points were welded.
    pub vertices: Vec<u32>,
}

/// Why there is no mesh.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CleanError {
    /// What is left is no mesh; faces and vertices are numbered as in the soup.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A polygon is too large to be cut into triangles.
    #[error("face {face} has {corners} corners; at most {MOST_CORNERS} are accepted")]
    Corners {
        /// The first such polygon.
        face: usize,
        /// How many corners it has.
        corners: usize,
    },
    /// The distance of welding is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

/// Makes a mesh from polygons.
///
/// Polygons are cut into triangles, ear by ear, those with the shortest cuts first. Dropped are faces
/// with fewer than three different vertices, and all but the first of faces with the same three
/// vertices. Kept, and counted in the report, are flat faces, edges with many faces and vertices
/// without faces.
///
/// # Errors
/// A coordinate is not finite, a polygon uses a vertex that does not exist or has more than 16384
/// corners, no face is left, or the distance of welding is negative or not finite.
pub fn clean(soup: &Soup, options: CleanOptions) -> Result<Cleaned, CleanError> {
    check_soup(soup)?;
    let mut report = CleanReport::default();
    let (points, vertices) = welded(soup.points(), options, &mut report)?;
    let faces = triangles(soup, &points, &vertices, &mut report);
    let mesh = TriMesh::new(points, faces)?;
    report.describe(&mesh);
    Ok(Cleaned { mesh, report, vertices })
}

fn check_soup(soup: &Soup) -> Result<(), CleanError> {
    let points = soup.points();
    check_points(points)?;
    for (face, corners) in soup.polygons().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= points.len()) {
            let (vertex, points) = (vertex.into(), points.len());
            return Err(MeshError::Vertex { face, vertex, points }.into());
        }
        if corners.len() > MOST_CORNERS {
            return Err(CleanError::Corners { face, corners: corners.len() });
        }
    }
    Ok(())
}

/// The points that stay, and which of them each point became.
fn welded(
    points: &[[f64; 3]],
    options: CleanOptions,
    report: &mut CleanReport,
) -> Result<(Vec<[f64; 3]>, Vec<u32>), ParameterError> {
    let firsts = match options.weld {
        None | Some(0.0) => weld::equal(points),
        Some(distance) => {
            let valid = (LEAST_WELD..f64::INFINITY).contains(&distance);
            check("weld distance", distance, valid, "0, or from 1e-100 and finite")?;
            weld::near(points, distance)
        }
    };
    let joined = (0..).zip(&firsts).filter(|&(own, &first)| own != first).count();
    if options.weld.is_none() {
        report.shared_positions = joined;
        return Ok((points.to_vec(), (0..points.len() as u32).collect()));
    }
    report.welded = joined;
    let (mut kept, mut vertices) = (Vec::with_capacity(points.len() - joined), Vec::new());
    for (own, &first) in firsts.iter().enumerate() {
        if own == first as usize {
            vertices.push(kept.len() as u32);
            kept.push(points[own]);
        } else {
            vertices.push(vertices[first as usize]);
        }
    }
    Ok((kept, vertices))
}

/// The faces that stay.
fn triangles(
    soup: &Soup,
    points: &[[f64; 3]],
    vertices: &[u32],
    report: &mut CleanReport,
) -> Vec<[u32; 3]> {
    let (mut cut, mut faces) = (Vec::new(), Vec::with_capacity(soup.polygons().len()));
    let mut known = HashSet::with_capacity(faces.capacity());
    for corners in soup.polygons() {
        let mut ring: Vec<u32> = corners.iter().map(|&vertex| vertices[vertex as usize]).collect();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        report.repeated += usize::from(ring.len() < 3);
        report.polygons += usize::from(ring.len() > 3);
        triangulate(points, ring, &mut cut);
        for face in cut.drain(..) {
            let mut sorted = face;
            sorted.sort_unstable();
            if sorted[0] == sorted[1] || sorted[1] == sorted[2] {
                report.repeated += 1;
            } else if known.insert(sorted) {
                faces.push(face);
            } else {
                report.duplicates += 1;
            }
        }
    }
    faces
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    fn soup(points: &[[f64; 3]], polygons: &[&[u32]]) -> Soup {
        let mut soup = Soup::new(points.to_vec());
        polygons.iter().for_each(|polygon| soup.push(polygon.iter().copied()));
        soup
    }

    fn cleaned(points: &[[f64; 3]], polygons: &[&[u32]], weld: Option<f64>) -> Cleaned {
        clean(&soup(points, polygons), CleanOptions { weld }).unwrap()
    }

    #[test]
    fn what_is_no_face_is_dropped_and_counted() {
        let polygons: [&[u32]; 7] =
            [&[0, 1, 2], &[2, 1, 0], &[0, 0, 1], &[], &[0, 3], &[0, 2, 2, 3], &[0, 1, 0, 3]];
        let cleaned = cleaned(&SQUARE, &polygons, None);
        assert_eq!(cleaned.mesh.faces(), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!((cleaned.report.repeated, cleaned.report.duplicates), (5, 1));
        assert_eq!(cleaned.vertices, [0, 1, 2, 3]);
    }

    #[test]
    fn equal_positions_are_welded_on_demand() {
        let mut points = SQUARE.to_vec();
        points.extend([[0.0, -0.0, 0.0], [1.0, 1.0, 0.01], [5.0; 3]]);
        let faces: [&[u32]; 2] = [&[0, 1, 2], &[4, 5, 3]];
        let apart = cleaned(&points, &faces, None);
        assert_eq!((apart.mesh.points().len(), apart.report.shared_positions), (7, 1));
        let equal = cleaned(&points, &faces, Some(0.0));
        assert_eq!(equal.vertices, [0, 1, 2, 3, 0, 4, 5]);
        assert_eq!(equal.mesh.faces(), [[0, 1, 2], [0, 4, 3]]);
        assert_eq!((equal.report.welded, equal.report.unreferenced), (1, 1));
        let near = cleaned(&points, &faces, Some(0.02));
        assert_eq!(near.vertices, [0, 1, 2, 3, 0, 2, 4]);
        assert_eq!(near.report.components, 1);
        for distance in [-1.0, f64::NAN, f64::INFINITY, 1e-200] {
            let options = CleanOptions { weld: Some(distance) };
            let error = clean(&soup(&points, &faces), options).unwrap_err();
            assert!(matches!(error, CleanError::Parameter(_)), "{error}");
        }
    }

    #[test]
    fn what_cannot_be_a_mesh_is_named() {
        let text = |points: &[[f64; 3]], polygons: &[&[u32]]| {
            clean(&soup(points, polygons), CleanOptions::default()).unwrap_err().to_string()
        };
        assert_eq!(text(&SQUARE, &[&[0, 1, 1]]), "the mesh has no faces");
        assert_eq!(
            text(&SQUARE, &[&[0, 1, 2], &[0, 1, 2, 4]]),
            "face 1 uses vertex 4, but there are 4 (counted from 0)"
        );
        let ring: Vec<u32> = (0..20_000).map(|i| i % 4).collect();
        let large = "face 0 has 20000 corners; at most 16384 are accepted";
        assert_eq!(text(&SQUARE, &[&ring]), large);
        let lost = [SQUARE[0], SQUARE[1], [0.0, f64::INFINITY, 0.0]];
        assert!(text(&lost, &[&[0, 1, 2]]).starts_with("vertex 2 lies at [0.0, inf, 0.0]"));
    }
}
