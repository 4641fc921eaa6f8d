//! Images (2-D) and volumes (3-D).
//!
//! The rooms stand in the order in which data passes through them: a [`Grid`] of grey values
//! becomes a [`medium`], the medium carries [`heat`], the heat is read as a [`distance`], a
//! [`path`] descends to a source, and by [`voting`] or [`keypoints`] paths find a structure, of which a
//! [`skeleton`] makes a graph.

pub mod bridge;
pub mod distance;
mod eigen;
mod extraction;
mod field;
pub mod filter;
pub mod heat;
pub mod keypoints;
pub mod labels;
mod mask;
pub mod medium;
pub mod path;
mod raster;
mod sample;
mod scales;
mod seeds;
mod shape;
pub mod skeleton;
mod source;
mod stencil;
mod structure;
mod tensor;
pub mod voting;

pub use eigen::eigen;
pub use extraction::{Structure, StructureError};
pub use field::{Grid, LengthError, NotFinite, fraction};
pub use mask::Mask;
pub use scales::tube_scales;
pub use seeds::seeds;
pub use shape::{Shape, ShapeError};
pub use source::{PointError, Sources, check_points};
pub use structure::{half_width, structure, structure_level};
pub use tensor::{Matrix, TensorField};
