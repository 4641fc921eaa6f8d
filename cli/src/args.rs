//! The command line, described.

use crate::batch::args::BatchArgs;
use crate::mesh::args::MeshCommand;
use clap::{ArgGroup, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Geodesic distances and minimal paths on images and triangle meshes, by letting heat flow through
/// them.
///
/// Images are pictures (PNG, JPEG, TIFF, PNM, NPY) or volumes: NIfTI, NRRD, MetaImage, DICOM, TIFF with
/// several grey pages of one size, or NPY with three axes (slices, rows, columns).
///
/// Points are pixel coordinates `x,y` or, in volumes, `x,y,z`: x to the right, y down, z from slice
/// to slice, the centre of the first pixel at 0,0; fractions are allowed.
#[derive(Debug, Parser)]
#[command(name = "heatpath", version, after_help = EXIT_CODES)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str = "\
Exit codes: 0 done, 2 wrong usage, 3 bad input, 4 a file cannot be read or written, 5 no answer \
(a path did not reach a source), 130 interrupted.";

const BATCH_CODES: &str = "\
Exit codes: 0 all rows are done, 10 + N: N rows failed (110: 100 or more); 2, 3 and 4 as in all \
commands, before any row ran; 130 interrupted.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Write the map of distances from the sources.
    Distance(DistanceArgs),
    /// Trace minimal paths from end points to the sources.
    Path(PathArgs),
    /// Find curves by the votes of many minimal paths.
    Vote(VoteArgs),
    /// Find curves from key point to key point.
    Keypoints(KeyPointsArgs),
    /// Write the medium alone (k D, the squared speed) to look at what the heat will see.
    Medium(MediumCommandArgs),
    /// Distances, paths and curvatures on triangle meshes.
    #[command(subcommand)]
    Mesh(MeshCommand),
    /// Say how well extracted curves agree with a truth: recall and precision by length.
    Evaluate(EvaluateArgs),
    /// Run other commands on many inputs: resumable, with a log, a summary and a report.
    #[command(after_help = BATCH_CODES)]
    Batch(BatchArgs),
    /// Say what is in a file: size, type, range.
    Info(InfoArgs),
    /// Print a completion script for a shell.
    Completions(CompletionsArgs),
}

#[derive(Debug, clap::Args)]
#[command(group = result_group())]
pub(crate) struct DistanceArgs {
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) sources: SourceArgs,
    #[command(flatten)]
    pub(crate) medium: MediumArgs,
    #[command(flatten)]
    pub(crate) method: MethodArgs,
    /// Where the distances go: .npy, .nii, .nii.gz, .nrrd, .nhdr, .mha, .mhd (64-bit floats; all but
    /// .npy with the input's place in the world), .tif (32-bit floats, a page a slice), or, not for
    /// volumes, .png (a colour-mapped picture). Not reached is infinite.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: OutputArgs,
}

#[derive(Debug, clap::Args)]
#[command(group = result_group(), group = ArgGroup::new("any_end").args(["end", "ends"]).required(true).multiple(true))]
pub(crate) struct PathArgs {
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) sources: SourceArgs,
    /// Trace a path from this point (repeatable).
    #[arg(long, value_name = "X,Y[,Z]", value_parser = point, allow_hyphen_values = true)]
    pub(crate) end: Vec<Numbers>,
    /// Trace paths from the points in this CSV or JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) ends: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) medium: MediumArgs,
    #[command(flatten)]
    pub(crate) method: MethodArgs,
    /// Where the paths go: .json, .csv, .swc, .vtp or, not for volumes, .svg.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: OutputArgs,
}

#[derive(Debug, clap::Args)]
#[command(group = extraction_group("density"))]
pub(crate) struct VoteArgs {
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) sources: OptionalSourceArgs,
    #[command(flatten)]
    pub(crate) medium: MediumArgs,
    #[command(flatten)]
    pub(crate) structure: StructureArgs,
    /// Where paths begin.
    #[arg(long, default_value = "accumulated", help_heading = "Votes")]
    pub(crate) method: VotingMethodArg,
    /// The paper's rules alone: paths begin at the front of the heat, and what is kept may leave the
    /// structure.
    #[arg(long, help_heading = "Votes")]
    pub(crate) no_growth: bool,
    /// The longest way outside of the structure that a curve may bridge, in pixels [default: 6].
    #[arg(
        long,
        value_name = "GAP",
        allow_negative_numbers = true,
        conflicts_with = "no_growth",
        help_heading = "Votes"
    )]
    pub(crate) gap: Option<f64>,
    /// A pixel is kept if more paths than this cross it, one from each pixel of the structure beyond
    /// [default: 10].
    #[arg(long, value_name = "N", conflicts_with = "no_growth", help_heading = "Votes")]
    pub(crate) least_votes: Option<u32>,
    /// With --no-growth and fast marching: a pixel is kept if this part of the largest number of paths
    /// crosses it [default: 1/30; multiple, accumulated: 1/7].
    #[arg(long, value_name = "T", allow_negative_numbers = true, help_heading = "Votes")]
    pub(crate) threshold: Option<f64>,
    /// How far below the highest temperature heat covers a pixel, in natural logarithms [default: 36;
    /// front, multiple: 240].
    #[arg(long, value_name = "LN", allow_negative_numbers = true, help_heading = "Votes")]
    pub(crate) level: Option<f64>,
    /// Votes end when more than this part of the kept pixels was kept before [default: 0.99; with
    /// --no-growth 0.95].
    #[arg(long, value_name = "S", allow_negative_numbers = true, help_heading = "Votes")]
    pub(crate) settled: Option<f64>,
    /// The steps of heat before each vote [default: twice the longest side for the front, 100 for
    /// multiple and with --no-growth, else 200].
    #[arg(long, value_name = "N", help_heading = "Votes")]
    pub(crate) iterations: Option<usize>,
    /// Branches that end in the open are cut if they are shorter than this, in physical units, or than
    /// 1.5 times the radius of the branch that they leave [default: 0].
    #[arg(
        long,
        value_name = "L",
        default_value_t = 0.0,
        hide_default_value = true,
        allow_negative_numbers = true,
        help_heading = "Votes"
    )]
    pub(crate) prune: f64,
    /// Where the curves go: a graph of branches with radii (.json, .csv, .swc, .vtp), the curves alone
    /// (.svg), or the pixels that were kept, 255 and 0 (.png, .npy, .tif, .nii, .nii.gz, .nrrd, .nhdr,
    /// .mha, .mhd). PNG and SVG are not for volumes.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    /// Where the geodesic density goes, the number of votes (eq. 23): .npy, .tif, a medical format or,
    /// not for volumes, .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) density: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: OutputArgs,
}

#[derive(Debug, clap::Args)]
#[command(group = extraction_group("travelling"))]
pub(crate) struct KeyPointsArgs {
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) sources: OptionalSourceArgs,
    #[command(flatten)]
    pub(crate) medium: MediumArgs,
    #[command(flatten)]
    pub(crate) structure: StructureArgs,
    /// How key points are found.
    #[arg(long, default_value = "heat", help_heading = "Key points")]
    pub(crate) method: KeyPointMethodArg,
    /// How far key points are apart, in pixels: the radius of circles (spheres) of heat, or the length of
    /// paths [default: 4 times the half width of the structure, from 10 to 30].
    #[arg(long, value_name = "R", allow_negative_numbers = true, help_heading = "Key points")]
    pub(crate) radius: Option<f64>,
    /// The steps of heat for each key point; as many as it takes to cross the circle, if that is more
    /// [default: 50].
    #[arg(long, value_name = "N", help_heading = "Key points")]
    pub(crate) iterations: Option<usize>,
    /// Where the curves and key points go: .json, .csv, .swc, .vtp or, not for volumes, .svg.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    /// Where the travelling map goes, the distances from the key points: .npy, .tif, a medical format
    /// or, not for volumes, .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) travelling: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: OutputArgs,
}

/// Where the structure is, and where extraction begins.
#[derive(Debug, clap::Args)]
pub(crate) struct StructureArgs {
    /// From this k D on a pixel belongs to the structure [default: by Otsu's method, from the picture].
    #[arg(long, value_name = "KD", allow_negative_numbers = true, help_heading = "Structure")]
    pub(crate) structure: Option<f64>,
    /// Without a --source, one is put into each piece of the structure that is this long, in pixels
    /// [default: a sixteenth of the longest side].
    #[arg(long, value_name = "L", allow_negative_numbers = true, help_heading = "Structure")]
    pub(crate) extent: Option<f64>,
    /// How many threads work [default: one per processor].
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        hide_default_value = true,
        help_heading = "Structure"
    )]
    pub(crate) threads: usize,
}

#[derive(Debug, clap::Args)]
#[command(group = result_group())]
pub(crate) struct MediumCommandArgs {
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) sources: OptionalSourceArgs,
    #[command(flatten)]
    pub(crate) medium: MediumArgs,
    /// Where the medium goes: .npy, .tif, .nii, .nii.gz, .nrrd, .nhdr, .mha, .mhd or, not for volumes,
    /// .png.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) out: OutputArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct EvaluateArgs {
    /// The extracted curves: JSON, CSV (with a header line that names x, y and, in volumes, z) or SWC;
    /// or a mask, of which the centreline is taken.
    #[arg(long, value_name = "FILE")]
    pub(crate) extracted: PathBuf,
    /// The true curves or mask.
    #[arg(long, value_name = "FILE")]
    pub(crate) truth: PathBuf,
    /// Curves agree within this distance, in physical units (repeatable).
    #[arg(long, value_name = "T", required = true, allow_negative_numbers = true)]
    pub(crate) tolerance: Vec<f64>,
    /// The field of view: a picture or volume outside of whose pixels that are not zero nothing
    /// counts.
    #[arg(long, value_name = "FILE")]
    pub(crate) mask: Option<PathBuf>,
    /// The physical size of a pixel: width, height and, in volumes, the distance of slices
    /// [default: as the file says, else 1 each].
    #[arg(long, value_name = "SX,SY[,SZ]", value_parser = point, allow_hyphen_values = true)]
    pub(crate) spacing: Option<Numbers>,
    /// Write the scores: .json or .csv.
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,
    /// The format of --output [default: as the file's ending].
    #[arg(long, value_name = "ENDING", help_heading = "Output")]
    pub(crate) format: Option<String>,
    /// Print one JSON object on standard output; of several tolerances a list of objects.
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
    /// Print nothing but errors and what --json asks for.
    #[arg(long, help_heading = "Output")]
    pub(crate) quiet: bool,
    /// Overwrite existing files.
    #[arg(long, help_heading = "Output")]
    pub(crate) force: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct InfoArgs {
    /// The file: PNG, JPEG, TIFF, PNM, NPY, NIfTI, NRRD, MetaImage, DICOM or a folder of it. Or a mesh.
    pub(crate) input: PathBuf,
    /// Of a file with several values a voxel, or with several volumes, the one to look at, from 0.
    #[arg(long, value_name = "N")]
    pub(crate) component: Option<usize>,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CompletionsArgs {
    /// The shell.
    pub(crate) shell: clap_complete::Shell,
}

/// A command must leave something behind.
fn result_group() -> ArgGroup {
    ArgGroup::new("result").args(["output", "overlay", "json"]).required(true).multiple(true)
}

/// As [`result_group`], with one more file.
fn extraction_group(file: &'static str) -> ArgGroup {
    result_group().arg(file)
}

#[derive(Debug, clap::Args)]
pub(crate) struct PictureArgs {
    /// The picture or volume: PNG, JPEG, TIFF, PNM, NPY, NIfTI, NRRD, MetaImage, DICOM, or a folder
    /// with a series of DICOM.
    pub(crate) input: PathBuf,
    /// Of a file with several values a voxel, or with several volumes, the one that counts, from 0.
    #[arg(long, value_name = "N", help_heading = "Picture")]
    pub(crate) component: Option<usize>,
    /// Which channel of a colour picture counts.
    #[arg(long, default_value = "luma", help_heading = "Picture")]
    pub(crate) channel: ChannelArg,
    /// The raw values that become 0 and 1 [default: the type's full range for 8 and 16 bit, else
    /// the picture's own].
    #[arg(long, value_name = "LO,HI", value_parser = pair, allow_hyphen_values = true, help_heading = "Picture")]
    pub(crate) range: Option<[f64; 2]>,
    /// The physical size of a pixel: width, height and, in volumes, the distance of slices
    /// [default: as the file says, else 1 each].
    #[arg(
        long,
        value_name = "SX,SY[,SZ]",
        value_parser = point,
        allow_hyphen_values = true,
        help_heading = "Picture"
    )]
    pub(crate) spacing: Option<Numbers>,
    /// Read points in world coordinates, and --smooth, --scale, --normalize and --margin in physical
    /// units, instead of pixels. The world is LPS, as in DICOM and ITK: x to the patient's left, y to
    /// the back, z to the head. Of files that name no place it begins at the first pixel.
    #[arg(long, help_heading = "Picture")]
    pub(crate) physical: bool,
    /// A picture or volume of the same size whose zeros are walls.
    #[arg(long, value_name = "FILE", help_heading = "Picture")]
    pub(crate) mask: Option<PathBuf>,
    /// Make the walls of --mask thicker by this many pixels: the rim of a field of view, which is darker,
    /// looks like a line.
    #[arg(
        long,
        value_name = "M",
        default_value_t = 0.0,
        hide_default_value = true,
        allow_negative_numbers = true,
        requires = "mask",
        help_heading = "Picture"
    )]
    pub(crate) margin: f64,
    /// Make the contrast the same everywhere inside --mask: the mean grey value around each pixel
    /// becomes 0.5, and the deviation there 0.125; both are averaged by a Gaussian of this standard deviation,
    /// in pixels. 15 did well at the retina.
    #[arg(long, value_name = "SIGMA", allow_negative_numbers = true, help_heading = "Picture")]
    pub(crate) normalize: Option<f64>,
}

#[derive(Debug, clap::Args)]
#[command(group = ArgGroup::new("any_source").args(["source", "sources"]).required(true).multiple(true))]
pub(crate) struct SourceArgs {
    #[command(flatten)]
    pub(crate) points: OptionalSourceArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct OptionalSourceArgs {
    /// Distances count from this point (repeatable).
    #[arg(long, value_name = "X,Y[,Z]", value_parser = point, allow_hyphen_values = true)]
    pub(crate) source: Vec<Numbers>,
    /// Distances count from the points in this CSV or JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) sources: Option<PathBuf>,
}

#[derive(Clone, Debug, clap::Args)]
pub(crate) struct MediumArgs {
    /// What the heat sees: equations (1), (6), (8), (10) to (12) of Yang & Cohen, tubes, or a
    /// given field.
    #[arg(long, default_value = "conductivity", help_heading = "Medium")]
    pub(crate) medium: MediumArg,
    /// The positive field of `--medium file`: lengths are ds / sqrt(field). An NPY array with one more
    /// axis, of 3 numbers (xx, xy, yy) or in volumes 6 (xx, xy, xz, yy, yz, zz), is the diffusion
    /// tensor D: lengths are sqrt(dx' D^-1 dx).
    #[arg(long, value_name = "FILE", required_if_eq("medium", "file"), help_heading = "Medium")]
    pub(crate) medium_file: Option<PathBuf>,
    /// The power n of eq. (6) [default: 3], or of the vesselness [default: 2].
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) power: Option<f64>,
    /// The constant epsilon of eqs. (6) and (11) [default: 1e-3], or of the vesselness [default:
    /// 1e-4].
    #[arg(long, value_name = "E", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) floor: Option<f64>,
    /// The grey value (0 to 1) that eq. (6) compares with [default: that of the sources].
    #[arg(long, value_name = "F", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) reference: Option<f64>,
    /// The contrast K of eq. (8), in grey values per pixel [default: 0.03], or the contrast of a tube
    /// whose vesselness is 1, in grey values [default: the picture's largest; with --normalize 0.125].
    #[arg(long, value_name = "K", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) contrast: Option<f64>,
    /// The form of eq. (8).
    #[arg(long, default_value = "exponential", help_heading = "Medium")]
    pub(crate) edge_stop: EdgeStopArg,
    /// With (divergence) or without (pointwise) the gradient term of eq. (9) [default: divergence;
    /// pointwise for `--medium file`].
    #[arg(long, help_heading = "Medium")]
    pub(crate) form: Option<FormArg>,
    /// Standard deviation of the Gaussian before derivatives, in pixels.
    #[arg(
        long,
        value_name = "SIGMA",
        default_value_t = 0.0,
        allow_negative_numbers = true,
        help_heading = "Medium"
    )]
    pub(crate) smooth: f64,
    /// Where the directions of the tensor of eq. (13) come from.
    #[arg(long, default_value = "hessian", help_heading = "Medium")]
    pub(crate) tensor: DirectionsArg,
    /// The anisotropy A of eq. (14), 0 to 0.9998 [default: 0.9; vesselness: 0].
    #[arg(long, value_name = "A", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) anisotropy: Option<f64>,
    /// Half widths of the tubes that Hessian and vesselness look for: standard deviations of the
    /// Gaussian before derivatives, in pixels, several for the vesselness, or `auto`: those that most
    /// of the picture's tubes have, which `heatpath medium` prints [default: 2; vesselness: 2,3,4.5].
    #[arg(
        long,
        value_name = "SIGMA",
        value_parser = auto,
        value_delimiter = ',',
        allow_negative_numbers = true,
        help_heading = "Medium"
    )]
    pub(crate) scale: Vec<AutoArg>,
    /// How much longer than wide the Gaussian of the vesselness is, in many directions of which the
    /// best counts, 1 to 10: above 1 there is less noise between tubes [default: 1].
    #[arg(long, value_name = "E", allow_negative_numbers = true, help_heading = "Medium")]
    pub(crate) elongation: Option<f64>,
    /// Which tubes Hessian and vesselness look for [default: both; vesselness: bright].
    #[arg(long, help_heading = "Medium")]
    pub(crate) polarity: Option<PolarityArg>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MethodArgs {
    /// How distances are found: read from heat, or exactly.
    #[arg(long, default_value = "normalized", help_heading = "Distance")]
    pub(crate) estimator: EstimatorArg,
    /// Exact distances end here, in physical units: all beyond is not reached [default: no end].
    #[arg(long, value_name = "D", allow_negative_numbers = true, help_heading = "Distance")]
    pub(crate) farthest: Option<f64>,
    /// How many threads work [default: one per processor].
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        hide_default_value = true,
        help_heading = "Distance"
    )]
    pub(crate) threads: usize,
    #[command(flatten)]
    pub(crate) heat: HeatArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct HeatArgs {
    /// How heat flows, in many small steps or in one long step [default: explicit].
    #[arg(long, help_heading = "Heat")]
    pub(crate) solver: Option<SolverArg>,
    /// How many time steps [default: explicit heat, which moves one pixel a step, takes twice the
    /// longest side in pictures and three times in volumes; implicit heat takes 1].
    #[arg(long, value_name = "N", help_heading = "Heat")]
    pub(crate) iterations: Option<usize>,
    /// How long heat flows, in pixels squared [default: --iterations times --step; implicit heat:
    /// 16].
    #[arg(long, value_name = "T", allow_negative_numbers = true, help_heading = "Heat")]
    pub(crate) time: Option<f64>,
    /// The time step in pixels squared, or `auto` for a safe part of the largest stable one; not
    /// for implicit heat [default: 0.2 in pictures, 2/15 in volumes].
    #[arg(
        long,
        value_name = "TAU",
        value_parser = auto,
        allow_negative_numbers = true,
        help_heading = "Heat"
    )]
    pub(crate) step: Option<AutoArg>,
    /// The most memory that implicit heat and the heat method may take, in GiB [default: 4].
    #[arg(long, value_name = "GIB", allow_negative_numbers = true, help_heading = "Heat")]
    pub(crate) memory: Option<f64>,
    /// The mean that makes the coefficient of a face from those of its two pixels [default:
    /// harmonic].
    #[arg(long, help_heading = "Heat")]
    pub(crate) face_mean: Option<FaceMeanArg>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct OutputArgs {
    /// A picture of the result on the input (.png); of volumes three slices and three projections.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) overlay: Option<PathBuf>,
    /// The format of --output [default: as the file's ending].
    #[arg(long, value_name = "ENDING", help_heading = "Output")]
    pub(crate) format: Option<String>,
    /// Print one JSON object on standard output.
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
    /// No progress and no messages but errors.
    #[arg(long, help_heading = "Output")]
    pub(crate) quiet: bool,
    /// Overwrite existing files.
    #[arg(long, help_heading = "Output")]
    pub(crate) force: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ChannelArg {
    Red,
    Green,
    Blue,
    Luma,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum MediumArg {
    /// The same everywhere, eq. (1).
    Uniform,
    /// Grey values like the source's, eq. (6).
    Conductivity,
    /// Regions without edges, eq. (8).
    PeronaMalik,
    /// Grey values and regions, eq. (10).
    Combined,
    /// Edges and thin lines, eq. (11).
    Edges,
    /// Along the directions of the image, eqs. (12) to (14).
    Tensor,
    /// Tubes: bright or dark lines and vessels.
    Vesselness,
    /// The field in --medium-file.
    File,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum VotingMethodArg {
    /// At the front of heat that has flowed for long (section 4.1.1).
    Front,
    /// At the front of heat again and again, while it flows on (4.1.2).
    Multiple,
    /// At the front of heat from all that has been found (4.1.3).
    Accumulated,
    /// At 500 random pixels; by fast marching (Rouchdy & Cohen).
    Random,
    /// At the picture's border; by fast marching.
    Border,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum KeyPointMethodArg {
    /// At the peaks of heat on circles (Algorithm 2).
    Heat,
    /// Where minimal paths are long enough, by fast marching (Benmansour & Cohen).
    Length,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum DirectionsArg {
    /// Along the tubes that second derivatives show.
    Hessian,
    /// Along the lines that the structure tensor shows, averaged over twice --scale.
    Structure,
    /// Along the curves of equal grey value.
    Gradient,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum PolarityArg {
    Bright,
    Dark,
    Both,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum EdgeStopArg {
    /// exp(-(g/K)^2)
    Exponential,
    /// 1 / (1 + (g/K)^2)
    Rational,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum FormArg {
    Divergence,
    Pointwise,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SolverArg {
    /// In many small steps; any size of picture or volume.
    Explicit,
    /// In one step, or a few, by solving a system: right far from the source too, but memory limits
    /// the size.
    Implicit,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum FaceMeanArg {
    Arithmetic,
    Harmonic,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum EstimatorArg {
    /// sqrt(-4 t log u) as eq. (3) prints it, and -sqrt(t) log u of implicit heat: for
    /// comparisons, too long by a known amount.
    Varadhan,
    /// sqrt(-4 t log(u / u(source))), and the like of implicit heat: for lengths.
    Normalized,
    /// The distances that grow in the direction from which heat comes: a short implicit step, then a
    /// Poisson equation. Of the options of heat it takes --memory, and --time in multiples of a
    /// pixel squared over the mean of k D [default: 1].
    HeatMethod,
    /// The exact weighted distance, without heat: the eikonal equation by fast marching.
    Eikonal,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum AutoArg {
    Auto,
    Fixed(f64),
}

impl AutoArg {
    pub(crate) fn number(&self) -> Option<f64> {
        match *self {
            Self::Auto => None,
            Self::Fixed(number) => Some(number),
        }
    }
}

fn auto(text: &str) -> Result<AutoArg, String> {
    match text {
        "auto" => Ok(AutoArg::Auto),
        _ => text.parse().map(AutoArg::Fixed).map_err(|_| "expected a number or `auto`".to_owned()),
    }
}

pub(crate) fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|part| part.trim().parse().ok()).collect()
}

pub(crate) fn pair(text: &str) -> Result<[f64; 2], String> {
    let pair = numbers(text).and_then(|numbers| numbers.try_into().ok());
    pair.ok_or_else(|| "expected two numbers with a comma between them".to_owned())
}

/// The numbers of a point or spacing, one an axis. The input decides how many are right.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Numbers(pub(crate) Vec<f64>);

fn point(text: &str) -> Result<Numbers, String> {
    match numbers(text) {
        Some(numbers) if matches!(numbers.len(), 2 | 3) => Ok(Numbers(numbers)),
        _ => Err("expected two numbers x,y or, in volumes, three x,y,z".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_description_is_consistent() {
        Args::command().debug_assert();
    }

    #[test]
    fn points_are_two_or_three_numbers() {
        assert_eq!(point("1.5,-2"), Ok(Numbers(vec![1.5, -2.0])));
        assert_eq!(point(" 1 , 2 ,3"), Ok(Numbers(vec![1.0, 2.0, 3.0])));
        for bad in ["", "1", "1,2,3,4", "a,b", "1;2", "1,"] {
            assert!(point(bad).is_err(), "{bad}");
        }
    }
}
