//! Geodesic distances and curves on images, volumes and triangle meshes by letting heat flow through them.
#![doc = include_str!("tour.md")]

mod error;
pub mod evaluation;
pub mod exec;
pub mod grid;
pub mod linear;
mod lists;
pub mod mesh;
mod simd;

pub use error::ParameterError;
pub use exec::Exec;

/// The examples of the README are tests too.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
