//! What the commands on meshes write and say.

use super::args::{MeshOutputArgs, UpArg};
use super::input::Input;
use crate::failure::Failure;
use crate::output;
use heatpath_core::mesh::clean::CleanReport;
use heatpath_core::mesh::{Source, Sources};
use heatpath_io::mesh::{
    MeshPicture, PointArray, Up, View, write_mesh, write_mesh_picture, write_mesh_values,
};
use serde::Serialize;
use std::path::Path;

/// The endings of files with values of vertices.
pub(super) const VALUE_ENDINGS: [&str; 5] = ["ply", "vtp", "vtk", "npy", "csv"];

/// Writes arrays of vertices: on the mesh, or as a table of the file's vertices.
pub(super) fn write_arrays(
    output: &Path,
    args: &MeshOutputArgs,
    input: &Input,
    arrays: &[PointArray<'_>],
) -> Result<(), Failure> {
    let (format, force) = (args.common.format.as_deref(), args.common.force);
    if !["npy", "csv"].iter().any(|table| is_written_as(table, output, args)) {
        return Ok(write_mesh(output, format, force, &input.mesh, arrays)?);
    }
    let columns: Vec<Vec<f64>> = arrays.iter().map(|(_, array)| input.for_file(array)).collect();
    let arrays: Vec<PointArray<'_>> =
        arrays.iter().zip(&columns).map(|((name, _), column)| (*name, &column[..])).collect();
    Ok(write_mesh_values(output, format, force, input.file_points(), &arrays)?)
}

/// Whether the output is to have this format.
pub(super) fn is_written_as(kind: &str, output: &Path, args: &MeshOutputArgs) -> bool {
    let ending = output.extension().and_then(|ending| ending.to_str());
    let format = args.common.format.as_deref().or(ending);
    format.is_some_and(|format| format.eq_ignore_ascii_case(kind))
}

/// The picture that the options ask for, to be filled in.
pub(super) fn picture(args: &MeshOutputArgs) -> MeshPicture<'static> {
    let up = match args.up {
        Some(UpArg::Z) => Up::Z,
        Some(UpArg::Y) | None => Up::Y,
    };
    let view = match args.view {
        Some([azimuth, elevation]) => View::Angles { up, azimuth, elevation },
        None => View::Automatic { up },
    };
    MeshPicture { view, isolines: args.isolines, ..MeshPicture::default() }
}

/// Where the picture has crosses: at the sources, but not at those of the last labels, of `curves`, which
/// would cover it.
pub(super) fn crosses(input: &Input, sources: &Sources, curves: usize) -> Vec<[f64; 3]> {
    let labels = sources.list().last().map_or(0, |last| last.label as usize + 1);
    let is_point = |source: &&Source| (source.label as usize) + curves < labels;
    let points = sources.list().iter().filter(is_point);
    points.map(|source| input.mesh.position(&source.point)).collect()
}

/// Writes the picture, if there is to be one.
pub(super) fn write_picture(
    args: &MeshOutputArgs,
    input: &Input,
    picture: &MeshPicture<'_>,
    title: &str,
) -> Result<(), Failure> {
    let Some(file) = &args.common.overlay else { return Ok(()) };
    let title = picture.values.map(|_| title);
    Ok(write_mesh_picture(file, args.common.force, &input.mesh, picture, title)?)
}

/// Says what was changed in the mesh of the file, and what may be wrong with it.
pub(super) fn tell_report(args: &MeshOutputArgs, input: &Input) {
    let CleanReport { repeated, duplicates, welded, shared_positions, unreferenced, .. } =
        input.report;
    let facts = [
        (repeated + duplicates, "faces left out, with fewer than three vertices or there twice"),
        (unreferenced, "vertices without faces (nothing reaches them)"),
        (welded, "vertices joined with others (tables keep the numbers of the file)"),
        (
            shared_positions,
            "vertices where another one lies (the mesh may be torn there; `--weld 0` joins them)",
        ),
    ];
    for (count, fact) in facts.into_iter().filter(|&(count, _)| count > 0) {
        output::tell(&args.common, &format!("{fact}: {count}"));
    }
}

/// What a mesh is like, for programs.
#[derive(Serialize)]
pub(crate) struct MeshFacts {
    vertices: usize,
    faces: usize,
    components: usize,
    border_edges: usize,
    non_manifold_edges: usize,
    inconsistent_edges: usize,
    flat_faces: usize,
    unreferenced_vertices: usize,
    shared_positions: usize,
    welded_vertices: usize,
    dropped_faces: usize,
    cut_polygons: usize,
    euler_characteristic: i64,
}

impl MeshFacts {
    pub(crate) fn new(vertices: usize, faces: usize, report: &CleanReport) -> Self {
        Self {
            vertices,
            faces,
            components: report.components,
            border_edges: report.border_edges,
            non_manifold_edges: report.non_manifold_edges,
            inconsistent_edges: report.inconsistent_edges,
            flat_faces: report.flat,
            unreferenced_vertices: report.unreferenced,
            shared_positions: report.shared_positions,
            welded_vertices: report.welded,
            dropped_faces: report.repeated + report.duplicates,
            cut_polygons: report.polygons,
            euler_characteristic: report.euler_characteristic,
        }
    }
}

impl Input {
    pub(super) fn facts(&self) -> MeshFacts {
        MeshFacts::new(self.mesh.points().len(), self.mesh.faces().len(), &self.report)
    }
}
