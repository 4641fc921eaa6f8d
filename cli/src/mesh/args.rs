//! The command line of `heatpath mesh`, described.

use crate::args::OutputArgs;
use clap::{Arg, ArgGroup, Subcommand, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Subcommand)]
pub(crate) enum MeshCommand {
    /// Write the distances of all vertices from the sources.
    #[command(mut_arg("overlay", as_picture))]
    Distance(MeshDistanceArgs),
    /// Trace paths across faces from end points to the sources.
    #[command(mut_arg("overlay", as_picture))]
    Path(MeshPathArgs),
    /// Write the principal curvatures of all vertices.
    #[command(mut_arg("overlay", as_picture))]
    Curvature(MeshCurvatureArgs),
}

fn as_picture(overlay: Arg) -> Arg {
    overlay.help("A picture of the mesh with the result on it (.png)")
}

#[derive(Debug, clap::Args)]
#[command(group = result_group(), group = source_group())]
pub(crate) struct MeshDistanceArgs {
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
    #[command(flatten)]
    pub(crate) sources: MeshSourceArgs,
    #[command(flatten)]
    pub(crate) medium: MeshMediumArgs,
    #[command(flatten)]
    pub(crate) method: MeshMethodArgs,
    /// Where the distances go: .ply, .vtp or .vtk (the mesh with the arrays distance and source, the
    /// number of the nearest one), .npy or .csv (a row for each vertex of the file). Not reached is
    /// infinite, NaN in VTK's formats.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: MeshOutputArgs,
}

#[derive(Debug, clap::Args)]
#[command(group = result_group(), group = source_group(), group = ArgGroup::new("any_end").args(["end", "ends"]).required(true).multiple(true))]
pub(crate) struct MeshPathArgs {
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
    #[command(flatten)]
    pub(crate) sources: MeshSourceArgs,
    /// Trace a path from this point (repeatable).
    #[arg(long, value_name = "V|X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    pub(crate) end: Vec<Place>,
    /// Trace paths from the points x,y,z in this CSV or JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) ends: Option<PathBuf>,
    /// Lead each path through this point first (repeatable, in this order).
    #[arg(long, value_name = "V|X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    pub(crate) through: Vec<Place>,
    /// Make paths locally shortest on the surface, whatever the medium that led them.
    #[arg(long)]
    pub(crate) shorten: bool,
    #[command(flatten)]
    pub(crate) medium: MeshMediumArgs,
    #[command(flatten)]
    pub(crate) method: MeshMethodArgs,
    /// Where the paths go: .json, .csv, .swc or .vtp.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: MeshOutputArgs,
}

#[derive(Debug, clap::Args)]
#[command(group = result_group())]
pub(crate) struct MeshCurvatureArgs {
    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
    #[command(flatten)]
    pub(crate) curvature: CurvatureArgs,
    /// How many threads work [default: one per processor].
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        hide_default_value = true,
        help_heading = "Curvature"
    )]
    pub(crate) threads: usize,
    /// Where the curvatures go: .ply, .vtp or .vtk (the mesh with the arrays minimum, maximum, mean
    /// and gaussian), .npy or .csv (a row for each vertex of the file). The picture shows the mean.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: MeshOutputArgs,
}

/// A command must leave something behind.
fn result_group() -> ArgGroup {
    ArgGroup::new("result").args(["output", "overlay", "json"]).required(true).multiple(true)
}

fn source_group() -> ArgGroup {
    ArgGroup::new("any_source").args(["source", "sources", "curve"]).required(true).multiple(true)
}

#[derive(Debug, clap::Args)]
pub(crate) struct MeshArgs {
    /// The mesh: PLY, OBJ, STL, OFF, VTK (legacy), VTP, GLB or glTF, or a surface of FreeSurfer.
    #[expect(clippy::doc_markdown, reason = "the help would show backticks")]
    pub(crate) input: PathBuf,
    /// Join vertices at most this far apart; 0 joins those in one place [default: STL and glTF are
    /// joined up to rounding, others not].
    #[arg(long, value_name = "D", allow_negative_numbers = true, help_heading = "Mesh")]
    pub(crate) weld: Option<f64>,
    /// Join no vertices.
    #[arg(long, conflicts_with = "weld", help_heading = "Mesh")]
    pub(crate) no_weld: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MeshSourceArgs {
    /// Distances count from this vertex (counted from 0), or from the point of the surface nearest to
    /// x,y,z (repeatable).
    #[arg(long, value_name = "V|X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    pub(crate) source: Vec<Place>,
    /// Distances count from the points x,y,z in this CSV or JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) sources: Option<PathBuf>,
    /// Distances count from a curve: the straight lines between the points x,y,z in this CSV or JSON
    /// file, laid onto the surface (repeatable).
    #[arg(long, value_name = "FILE")]
    pub(crate) curve: Vec<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CurvatureArgs {
    /// How curvature is estimated [default: normal-cycles].
    #[arg(long, help_heading = "Curvature")]
    pub(crate) estimator: Option<CurvatureArg>,
    /// The radius over which curvature is averaged, in units of the mesh [default: 4 mean edges; least
    /// squares: the faces at each vertex].
    #[arg(long, value_name = "R", allow_negative_numbers = true, help_heading = "Curvature")]
    pub(crate) radius: Option<f64>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MeshMediumArgs {
    /// Where ways are short.
    #[arg(long, default_value = "uniform", help_heading = "Medium")]
    pub(crate) medium: MeshMediumArg,
    /// Which bends of the surface are fast, in the curvature and crease media [default: both].
    #[arg(long, help_heading = "Medium")]
    pub(crate) bend: Option<BendArg>,
    /// The values of the vertices for the media scalars and speed: an array of the mesh file.
    #[arg(
        long,
        value_name = "NAME",
        required_if_eq_any([("medium", "scalars"), ("medium", "speed")]),
        help_heading = "Medium"
    )]
    pub(crate) scalars: Option<String>,
    /// The constant epsilon: the squared speed where the surface is flat, or values are not alike
    /// [default: 0.01; scalars: 1e-3].
    #[arg(long, value_name = "E", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) floor: Option<f64>,
    /// The power of the curvature [default: 1], or n of eq. (6) for scalars [default: 3].
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) power: Option<f64>,
    #[command(flatten)]
    pub(crate) curvature: CurvatureArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MeshMethodArgs {
    /// How distances are found.
    #[arg(long, default_value = "auto", help_heading = "Distance")]
    pub(crate) method: MeshMethodArg,
    /// Distances end here: all beyond is not reached [default: no end].
    #[arg(long, value_name = "D", allow_negative_numbers = true, help_heading = "Distance")]
    pub(crate) farthest: Option<f64>,
    /// How long the heat of the heat method flows, in squared mean edges [default: 4 on smooth meshes, down
    /// to 0.5 where faces meet at sharp angles].
    #[arg(long, value_name = "T", allow_negative_numbers = true, help_heading = "Distance")]
    pub(crate) time: Option<f64>,
    /// The most memory that each factorisation of the heat method may take, in GiB [default: 4].
    #[arg(long, value_name = "GIB", allow_negative_numbers = true, help_heading = "Distance")]
    pub(crate) memory: Option<f64>,
    /// The number of steps of the paper's heat [default: as the number of edges on the way to the
    /// furthest vertex demands].
    #[arg(long, value_name = "N", help_heading = "Distance")]
    pub(crate) iterations: Option<usize>,
    /// The time step of the paper's heat [default: 0.2, or less where that is unstable].
    #[arg(long, value_name = "TAU", allow_negative_numbers = true, help_heading = "Distance")]
    pub(crate) step: Option<f64>,
    /// How many threads work [default: one per processor].
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        hide_default_value = true,
        help_heading = "Distance"
    )]
    pub(crate) threads: usize,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MeshOutputArgs {
    #[command(flatten)]
    pub(crate) common: OutputArgs,
    /// From where the picture looks, in degrees: around the upright axis, and above the plane of the
    /// other two [default: the side that shows most].
    #[arg(long, value_name = "AZIMUTH,ELEVATION", value_parser = angles, allow_hyphen_values = true, requires = "overlay", help_heading = "Output")]
    pub(crate) view: Option<[f64; 2]>,
    /// The axis that points upwards in the picture [default: y].
    #[arg(long, requires = "overlay", help_heading = "Output")]
    pub(crate) up: Option<UpArg>,
    /// Draw lines of equal value that part the range into so many intervals.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        hide_default_value = true,
        requires = "overlay",
        help_heading = "Output"
    )]
    pub(crate) isolines: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum MeshMediumArg {
    /// Lengths on the surface.
    Uniform,
    /// Fast where the surface bends, in all directions: eq. (16) with the curvature as P.
    Curvature,
    /// Fast along ridges and valleys, but not across them.
    Crease,
    /// Fast where values of the mesh file are like the sources', eq. (6).
    Scalars,
    /// Values of the mesh file are the squared speed P of eq. (16): lengths are ds / sqrt(P).
    Speed,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum BendArg {
    Both,
    Convex,
    Concave,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum CurvatureArg {
    /// The angles between faces, summed over a ball (Cohen-Steiner & Morvan).
    NormalCycles,
    /// The change of normals on faces (Rusinkiewicz).
    LeastSquares,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum MeshMethodArg {
    /// Exact in the uniform and crease media for up to 20,000 faces, else fast marching.
    Auto,
    /// The heat method (Crane et al.), smooth.
    Heat,
    /// The eikonal equation by fast marching with round fronts.
    Eikonal,
    /// Windows of straight lines: exact to rounding, in the uniform and crease media.
    Exact,
    /// Explicit heat as the paper has it, eqs. (15), (16) and (3): right on even meshes alone.
    Paper,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum UpArg {
    Y,
    Z,
}

/// A point of a mesh as a user gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    Vertex(u32),
    Space([f64; 3]),
}

fn place(text: &str) -> Result<Place, String> {
    let space = || finite(text)?.try_into().ok().map(Place::Space);
    let vertex = text.trim().parse().map(Place::Vertex).ok();
    vertex
        .or_else(space)
        .ok_or_else(|| "expected the number of a vertex, or three numbers x,y,z".to_owned())
}

fn angles(text: &str) -> Result<[f64; 2], String> {
    let pair = finite(text).and_then(|numbers| numbers.try_into().ok());
    pair.ok_or_else(|| "expected two numbers with a comma between them".to_owned())
}

fn finite(text: &str) -> Option<Vec<f64>> {
    crate::args::numbers(text).filter(|numbers| numbers.iter().all(|number| number.is_finite()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_vertices_or_places() {
        assert_eq!(place("17"), Ok(Place::Vertex(17)));
        assert_eq!(place("1,-2.5, 3"), Ok(Place::Space([1.0, -2.5, 3.0])));
        for bad in ["", "-1", "1.5", "1,2", "1,2,3,4", "a", "1,2,nan", "inf,0,0"] {
            assert!(place(bad).is_err(), "{bad}");
        }
    }
}
