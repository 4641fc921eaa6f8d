//! Triangle meshes.
//!
//! The rooms stand in the order in which data passes through them: what a file holds is made a
//! [`TriMesh`] ([`clean`]), the mesh with its [`curvature`] a [`Medium`]; from [`Sources`] on the surface
//! follow [`heat`] and [`distance`], and a [`path`] descends to a source. [`Geodesics`] is all of that
//! behind one door.

mod adjacency;
pub mod clean;
pub mod curvature;
pub mod distance;
mod geodesics;
pub mod heat;
mod medium;
pub mod path;
pub(crate) mod plane;
mod point;
pub mod shapes;
mod source;
mod spot;
mod tri_mesh;
pub(crate) mod triangle;
mod triangulation;
pub(crate) mod vector;

pub use crate::lists::Lists;
pub use adjacency::Adjacency;
pub use curvature::{Curvature, CurvatureError, CurvatureMethod, CurvatureOptions, Principal};
pub use geodesics::{Geodesics, GeodesicsError, GeodesicsOptions, Method};
pub use medium::{Bend, CurvatureMediumOptions, Directed, Medium, MediumError, ScalarsOptions};
pub use point::{Locator, PointError, SurfacePoint};
pub use source::{Source, Sources};
pub use tri_mesh::{MeshError, TriMesh};
pub use triangulation::Triangulation;
