//! Triangle meshes.
//!
//! The rooms stand in the order of the data: `options` are checked by `settings`; a mesh (`handle`, of a
//! `surface` with a `report`) and a `medium` are `prepared` for a `solver`, which gives distances from
//! `points`, and `paths`, also as `places` on faces. `curvature` stands by itself.

mod curvature;
mod failure;
mod handle;
mod medium;
mod options;
mod paths;
mod places;
mod points;
mod prepared;
mod report;
mod settings;
mod solver;
mod surface;

pub use curvature::*;
pub use handle::*;
pub use options::*;
pub use paths::*;
pub use places::*;
pub use points::*;
pub use report::*;
pub use solver::*;
