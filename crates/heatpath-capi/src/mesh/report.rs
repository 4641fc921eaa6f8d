//! What a mesh is like.

use crate::structs::Versioned;
use heatpath_core::mesh::clean::CleanReport;
use std::mem::size_of;

/// What hp_mesh_create() found. Set struct_size, then call hp_mesh_describe().
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_mesh_report {
    /// sizeof(hp_mesh_report).
    pub struct_size: u32,
    /// 0.
    pub reserved: u32,
    /// The vertices of the caller; results have one number for each of them.
    pub vertices: u64,
    /// The faces of the mesh, all of them triangles, see hp_mesh_faces().
    pub faces: u64,
    /// Vertices that were joined with an earlier one.
    pub welded: u64,
    /// Vertices at the position of an earlier one that were not joined: the mesh may be torn there,
    /// see hp_mesh_options.weld.
    pub shared_positions: u64,
    /// Polygons of more than three corners that were cut into triangles.
    pub polygons: u64,
    /// Dropped faces with fewer than three different vertices.
    pub repeated: u64,
    /// Dropped faces with the same three vertices as an earlier one.
    pub duplicates: u64,
    /// Faces without area; they were kept.
    pub flat: u64,
    /// Vertices that no face uses: they are at no distance from anywhere.
    pub unreferenced: u64,
    /// Edges with more than two faces.
    pub non_manifold_edges: u64,
    /// Edges with one face.
    pub border_edges: u64,
    /// Edges whose faces do not agree about what is outside.
    pub inconsistent_edges: u64,
    /// Components; between them there is no distance.
    pub components: u64,
    /// Vertices that faces use - edges + faces: 2 for a closed surface without handles.
    pub euler_characteristic: i64,
}

// SAFETY: integers, 8-byte numbers at the end.
unsafe impl Versioned for hp_mesh_report {
    const NAME: &'static str = "hp_mesh_report";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        Self::new(0, 0, &CleanReport::default())
    }
}

impl hp_mesh_report {
    pub(crate) fn new(vertices: usize, faces: usize, report: &CleanReport) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved: 0,
            vertices: vertices as u64,
            faces: faces as u64,
            welded: report.welded as u64,
            shared_positions: report.shared_positions as u64,
            polygons: report.polygons as u64,
            repeated: report.repeated as u64,
            duplicates: report.duplicates as u64,
            flat: report.flat as u64,
            unreferenced: report.unreferenced as u64,
            non_manifold_edges: report.non_manifold_edges as u64,
            border_edges: report.border_edges as u64,
            inconsistent_edges: report.inconsistent_edges as u64,
            components: report.components as u64,
            euler_characteristic: report.euler_characteristic,
        }
    }
}
