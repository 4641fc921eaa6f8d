//! Triangle meshes.
//!
//! The rooms stand in the order of the data: an `array` describes lists of the caller, `items`
//! checks and `numbers` reads and writes them; `options` are checked by `settings`; a mesh (`handle`, of a `surface` with
//! a `report`) and a `medium` are `prepared` for a `solver`, which gives distances from `points`, and
//! `paths`. `curvature` stands by itself.

mod array;
mod curvature;
mod failure;
mod handle;
mod items;
mod medium;
mod numbers;
mod options;
mod paths;
mod points;
mod prepared;
mod report;
mod settings;
mod solver;
mod surface;

pub use array::*;
pub use curvature::*;
pub use handle::*;
pub use options::*;
pub use paths::*;
pub use points::*;
pub use report::*;
pub use solver::*;
