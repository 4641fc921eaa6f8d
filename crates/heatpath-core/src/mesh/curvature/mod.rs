//! How the surface bends: principal curvatures and their directions at each vertex.
//!
//! A curvature is positive where the surface is convex, seen from outside, and negative where it is
//! concave; outside is where the corners of faces run counter-clockwise. Flipping all faces changes
//! all signs. The direction of a principal curvature is the one in which the surface bends so much,
//! as of the shape operator: of a cylinder the larger one runs around the axis. A crease runs along
//! the other one ([`Principal::crease`]).

mod ball;
mod clip;
mod cycles;
mod frame;
mod least_squares;

use super::TriMesh;
use crate::Exec;
use crate::error::{ParameterError, check, check_positive};
use crate::exec::Cancelled;
use crate::grid::eigen;
use ball::Ball;
use cycles::Cycles;
use frame::{Frame, vertex_normals};
use least_squares::LeastSquares;
use std::sync::Mutex;
use thiserror::Error;

/// The default radius of normal cycles, in mean edge lengths.
///
/// The mean error of the stronger curvature in percent, for several radii in mean edge lengths, on clean
/// vertices and with noise of 5 % of an edge (standard deviation along each axis); normal cycles
/// first, then least squares:
///
/// | radius | sphere, 5120 faces | with noise | torus, 16384 faces | with noise |
/// |---|---|---|---|---|
/// | faces at the vertex | - / 0.00 | - / 31.6 | - / 0.04 | - / 57.4 |
/// | 2 | 0.67 / 0.00 | 15.8 / 10.8 | 0.50 / 0.18 | 17.4 / 13.1 |
/// | 4 | 0.27 / 0.00 | 2.77 / 2.17 | 0.51 / 0.67 | 2.21 / 1.83 |
/// | 6 | 0.11 / 0.00 | 0.82 / 0.68 | 1.58 / 1.49 | 2.76 / 2.23 |
///
/// Narrower ridges than the ball are smeared over it: for those, 1.5 to 2 are better, and for sharp edges
/// without noise 0.6, which lets only their own vertices be bent.
pub const USUAL_RADIUS: f64 = 4.0;

/// How curvature is estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CurvatureMethod {
    /// Signed angles between faces, added up over a ball (Cohen-Steiner and Morvan, Restricted Delaunay
    /// triangulations and normal cycle, 2003): sharp edges are no exception to it, noise averages
    /// out, and the curvature on a straight sharp edge is its angle times `8 / (3 pi radius)`.
    #[default]
    NormalCycles,
    /// The changes of the vertices' normals along the sides of each face, by least squares
    /// (Rusinkiewicz, Estimating curvatures and their derivatives on triangle meshes, 2004): the
    /// most accurate on smooth surfaces without noise, but up to a half too small at borders.
    LeastSquares,
}

/// The parameters of [`Curvature::new`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurvatureOptions {
    /// The estimator; default [`CurvatureMethod::NormalCycles`].
    pub method: CurvatureMethod,
    /// The radius of the ball over which curvature is averaged with the weight
    /// `1 - (distance / radius)^2`, in units of the mesh: positive, at least a millionth of the longest
    /// edge.
    ///
    /// The ball grows over the surface from its vertex, and the other side of a thin sheet is not in
    /// it. Default: [`USUAL_RADIUS`] mean edge lengths for normal cycles; for least squares the faces
    /// at the vertex alone.
    pub radius: Option<f64>,
}

/// Why there is no curvature.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CurvatureError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The principal curvatures at a vertex, in 1 / unit of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Principal {
    /// The smaller and the larger one, signed: positive where the surface is convex.
    pub values: [f64; 2],
    /// The unit tangents in which the surface bends so, orthogonal to each other. Zero vectors where
    /// there is no tangent plane: at vertices without faces, or whose faces have no area.
    pub directions: [[f64; 3]; 2],
}

impl Principal {
    /// The mean curvature.
    #[must_use]
    pub fn mean(&self) -> f64 {
        f64::midpoint(self.values[0], self.values[1])
    }

    /// The Gaussian curvature, which does not know the sides of a surface.
    #[must_use]
    pub fn gaussian(&self) -> f64 {
        self.values[0] * self.values[1]
    }

    /// The curvature of larger size, with its sign.
    #[must_use]
    pub fn strongest(&self) -> f64 {
        self.values[self.strongest_place()]
    }

    /// The direction of a crease here: across it the surface bends most, and along it least.
    #[must_use]
    pub fn crease(&self) -> [f64; 3] {
        self.directions[1 - self.strongest_place()]
    }

    fn strongest_place(&self) -> usize {
        usize::from(self.values[1].abs() >= self.values[0].abs())
    }
}

/// The curvature at each vertex of a mesh.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::mesh::{Curvature, CurvatureOptions, shapes};
///
/// let sphere = shapes::icosphere(3);
/// let exec = Exec::single_threaded();
/// let curvature = Curvature::new(&sphere, CurvatureOptions::default(), &exec)?;
/// assert!(curvature.vertices().iter().all(|vertex| (vertex.mean() - 1.0).abs() < 0.01));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curvature {
    vertices: Vec<Principal>,
    radius: Option<f64>,
}

/// So many vertices at a time are one piece of work.
const PIECE: usize = 64;
/// The progress is told so many times.
const REPORTS: usize = 50;

impl Curvature {
    /// The curvature of `mesh`, whose faces must agree about what is outside.
    ///
    /// An edge has no angle where it does not part two faces that agree: at a border, where more than
    /// two faces meet, and where orientations clash. A vertex has no curvature, 0, where the
    /// mesh has no tangent plane.
    ///
    /// # Errors
    /// The radius is out of range, or the caller cancelled.
    pub fn new(
        mesh: &TriMesh,
        options: CurvatureOptions,
        exec: &Exec,
    ) -> Result<Self, CurvatureError> {
        let radius = match options.radius {
            Some(radius) => Some(checked(mesh, radius)?),
            None => usual_radius(mesh, options.method),
        };
        if radius == Some(0.0) {
            // All vertices lie in one point.
            return Ok(Self { vertices: vec![Principal::default(); mesh.points().len()], radius });
        }
        let normals = vertex_normals(mesh);
        let vertices = match options.method {
            CurvatureMethod::NormalCycles => {
                let cycles = Cycles::new(mesh);
                each_vertex(mesh, &normals, radius, exec, |ball, frame| cycles.form(ball, frame))
            }
            CurvatureMethod::LeastSquares => {
                let least_squares = LeastSquares::new(mesh, &normals);
                each_vertex(mesh, &normals, radius, exec, |b, frame| least_squares.form(b, frame))
            }
        }?;
        exec.report(1.0)?;
        Ok(Self { vertices, radius })
    }

    /// The curvatures at each vertex.
    #[must_use]
    pub fn vertices(&self) -> &[Principal] {
        &self.vertices
    }

    /// The radius of the balls over which it is averaged; none if only the faces at each vertex
    /// counted.
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        self.radius
    }
}

/// A radius that can be computed with: squares of edges in its unit must not overflow.
fn checked(mesh: &TriMesh, radius: f64) -> Result<f64, ParameterError> {
    check_positive("curvature radius", radius)?;
    let longest = mesh.edge_lengths().into_iter().fold(0.0, f64::max);
    let range = "at least a millionth of the longest edge";
    check("curvature radius", radius, radius >= 1e-6 * longest, range)?;
    Ok(radius)
}

fn usual_radius(mesh: &TriMesh, method: CurvatureMethod) -> Option<f64> {
    let lengths = mesh.edge_lengths();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    (method == CurvatureMethod::NormalCycles).then_some(USUAL_RADIUS * mean)
}

/// The curvatures of the second fundamental forms that `form` finds.
fn each_vertex(
    mesh: &TriMesh,
    normals: &[[f64; 3]],
    radius: Option<f64>,
    exec: &Exec,
    form: impl Fn(&Ball<'_>, &Frame) -> Form + Sync + Send,
) -> Result<Vec<Principal>, Cancelled> {
    let mut vertices = vec![Principal::default(); normals.len()];
    let balls: Vec<_> = (0..exec.threads()).map(|_| Mutex::new(Ball::new(mesh, radius))).collect();
    let mut pieces: Vec<_> = vertices.chunks_mut(PIECE).enumerate().collect();
    let (count, at_once) = (pieces.len(), pieces.len().div_ceil(REPORTS));
    for (round, pieces) in pieces.chunks_mut(at_once).enumerate() {
        exec.report((round * at_once) as f64 / count as f64)?;
        exec.for_each_with(pieces, &balls, |ball, (piece, results)| {
            for (place, result) in results.iter_mut().enumerate() {
                let vertex = *piece * PIECE + place;
                let Some(frame) = Frame::new(normals[vertex]) else { continue };
                ball.grow(vertex);
                *result = principal(form(ball, &frame), &frame);
            }
        });
    }
    Ok(vertices)
}

/// The second fundamental form in a frame: a symmetric matrix.
type Form = [[f64; 2]; 2];

fn principal(form: Form, frame: &Frame) -> Principal {
    let (values, vectors) = eigen(&form);
    Principal { values, directions: vectors.map(|vector| frame.vector(vector)) }
}
