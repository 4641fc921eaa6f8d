//! Skeletons of masks.

use super::graph::{HP_STOP_COMPLETE, hp_graph};
use crate::buffer::hp_buffer;
use crate::handles::hand_out;
use crate::pixels;
use crate::status::{Failure, guard, hp_status};
use crate::view::{self, View};
use heatpath_core::grid::skeleton::{Graph, PruneOptions};

/// Makes a graph of the centreline of a mask, with the distances to its edge as radii.
///
/// mask: the pixels that are not 0; any type.
///
/// prune: branches with a free end that are shorter than this, in physical units, or than 1.5 radii of the
/// junction are taken off.
///
/// graph: receives the graph, to be freed with hp_graph_free(), or NULL if anything but HP_OK is
/// returned.
///
/// # Safety
/// The struct is as large as its `struct_size` says, and the buffer is as large as its description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_skeleton_create(
    mask: *const hp_buffer,
    prune: f64,
    graph: *mut *mut hp_graph,
) -> hp_status {
    // SAFETY: the caller's promise.
    let make = || unsafe {
        match view::dimension(mask)? {
            2 => skeleton::<2>(mask, prune),
            _ => skeleton::<3>(mask, prune),
        }
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(graph, "graph", make) })
}

/// # Safety
/// As [`hp_skeleton_create`].
unsafe fn skeleton<const D: usize>(
    mask: *const hp_buffer,
    prune: f64,
) -> Result<hp_graph, Failure> {
    if !(prune.is_finite() && prune >= 0.0) {
        let message = format!("prune is {prune}; it must be finite and 0 or more");
        return Err(Failure::argument(message));
    }
    // SAFETY: the caller's promise.
    let cells = unsafe { pixels::read(&View::<D>::read(mask, "mask")?)? };
    cells.check_finite().map_err(|error| Failure::from(error).of("mask"))?;
    let graph = Graph::of_mask(&cells.map(|&value| value != 0.0));
    let graph = graph.pruned(PruneOptions { length: prune, ..PruneOptions::default() });
    Ok(hp_graph::of_skeleton(&graph, &[], HP_STOP_COMPLETE, 0))
}
