//! The C interface of heatpath: geodesic distances and paths on images and meshes by heat
//! diffusion.
//!
//! C and C++ programs include `include/heatpath.h`, which is generated from this crate, and link
//! `libheatpath`. The names here are those of the header. Rust programs use `heatpath-core`.
//!
//! | module | what |
//! | --- | --- |
//! | `version` | which library this is |
//! | `status` | what functions return, and the message that goes with it |
//! | `buffer` | how callers describe their pixels; `view` checks that, `pixels` reads and writes them |
//! | `array` | the same of lists; `items`, `numbers` |
//! | `options` | medium, heat, estimator, threads and progress; `settings` and `recipe` check them, `run` reports |
//! | `scene` | image, walls and recipe make a medium; `medium` shows it |
//! | `distance`, `paths`, `solver` | the computations; `problem`, `prepared` and `heat` are what they share |
//! | `nearest`, `matrix`, `bridge` | what else a solver tells about many points |
//! | `extraction` | votes, key points and skeletons, as graphs |
//! | `evaluation` | recall and precision of curves |
//! | `mesh` | distances, paths and curvature on triangle meshes |
//! | `api` | all functions in one table |
//! | `structs`, `handles` | structs that begin with their size and grow at the end, and opaque ones |
//!
//! Whatever a caller passes, a function answers with a status and never unwinds, prints, touches
//! signal handlers, or leaves anything running.

#![allow(unsafe_code, reason = "C callers pass raw pointers")]
#![allow(non_camel_case_types, reason = "the names are those of the C header")]
#![allow(clippy::doc_markdown, reason = "the comments become those of the C header")]
#![warn(clippy::undocumented_unsafe_blocks)]

mod api;
mod array;
mod bridge;
mod buffer;
mod distance;
mod evaluation;
mod extraction;
mod failure;
mod handles;
mod heat;
mod items;
mod matrix;
mod medium;
mod mesh;
mod nearest;
mod numbers;
mod options;
mod paths;
mod pixels;
mod prepared;
mod problem;
mod recipe;
mod run;
mod scales;
mod scene;
mod settings;
mod solver;
mod status;
mod structs;
mod version;
mod view;

pub use api::*;
pub use array::*;
pub use bridge::*;
pub use buffer::*;
pub use distance::*;
pub use evaluation::*;
pub use extraction::*;
pub use matrix::*;
pub use medium::*;
pub use mesh::*;
pub use nearest::*;
pub use options::*;
pub use paths::*;
pub use scales::*;
pub use solver::*;
pub use status::*;
pub use version::*;
