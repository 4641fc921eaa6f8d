//! The modules.

mod distance;
mod mesh_distance;
mod path;
mod shared;
mod vessel_tree;

pub use distance::DISTANCE;
pub use mesh_distance::MESH_DISTANCE;
pub use path::PATH;
pub use vessel_tree::VESSEL_TREE;

use crate::Module;

/// All of them.
pub const ALL: [&Module; 4] = [&DISTANCE, &PATH, &VESSEL_TREE, &MESH_DISTANCE];
