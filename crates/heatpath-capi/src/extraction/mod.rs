//! Curves found without ends given: votes, key points, skeletons, all as a graph.
//!
//! `options` are those of votes and key points; `start` finds the structure that both begin with;
//! `graph` is what callers get.

mod graph;
mod key_points;
mod options;
mod skeleton;
mod start;
mod votes;

pub use graph::*;
pub use key_points::*;
pub use options::*;
pub use skeleton::*;
pub use votes::*;
