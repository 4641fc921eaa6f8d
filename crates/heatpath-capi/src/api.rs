//! All functions in one table, for hosts that load the library at run time.

use crate::version::HP_ABI_VERSION;

/// All functions of this header, for programs that load the library at run time: one call of dlsym()
/// for hp_get_api() is enough. Later versions add functions at the end.
pub struct hp_api {
    _in_the_header: (),
}

/// What the header calls `hp_api`.
#[repr(C)]
struct Table {
    struct_size: u32,
    abi: u32,
    functions: [Function; COUNT],
}

/// The address of a function of any kind.
#[repr(transparent)]
#[derive(Clone, Copy)]
struct Function(*const ());

// SAFETY: functions can be called from any thread.
unsafe impl Sync for Function {}

macro_rules! table {
    ($($name:ident)*) => {
        /// The names, in the order of the table, which never changes: new ones come last.
        #[doc(hidden)]
        pub const API: [&str; COUNT] = [$(stringify!($name)),*];

        const COUNT: usize = [$(stringify!($name)),*].len();

        static TABLE: Table = Table {
            struct_size: size_of::<Table>() as u32,
            abi: HP_ABI_VERSION,
            functions: [$(Function(crate::$name as *const ())),*],
        };
    };
}

table! {
    hp_abi_version hp_version_string hp_last_error_message hp_status_name
    hp_buffer_init hp_options_init hp_distance hp_medium
    hp_paths_create hp_paths_free hp_paths_count hp_paths_info hp_paths_points
    hp_solver_create hp_solver_distances hp_solver_paths_create hp_solver_free
    hp_vote_options_init hp_key_point_options_init
    hp_votes_create hp_key_points_create hp_skeleton_create
    hp_graph_describe hp_graph_node_at hp_graph_branch_at hp_graph_branch_points hp_graph_sources
    hp_graph_free
    hp_curves_init hp_evaluate
    hp_array_init hp_mesh_options_init hp_surface_points_init
    hp_mesh_create hp_mesh_free hp_mesh_describe hp_mesh_faces
    hp_mesh_solver_create hp_mesh_solver_free hp_mesh_solver_method
    hp_mesh_solver_distances hp_mesh_solver_matrix
    hp_mesh_paths_create hp_mesh_paths_through hp_mesh_isolines_create hp_mesh_curvature
    hp_solver_nearest hp_solver_matrix hp_solver_bridge
    hp_mesh_locate hp_paths_places hp_mesh_loop_create
    hp_tube_scales
}

/// The table of all functions, or NULL if the library has another ABI than the caller.
///
/// abi_version: HP_ABI_VERSION of the header that the caller was compiled with.
///
/// The table belongs to the library and lives as long as it is loaded. A library that is older than
/// the header may have a shorter table: what lies beyond hp_api.struct_size is not there.
#[unsafe(no_mangle)]
pub extern "C" fn hp_get_api(abi_version: u32) -> *const hp_api {
    if abi_version == HP_ABI_VERSION { (&raw const TABLE).cast() } else { std::ptr::null() }
}
