//! What can go wrong when files are read or written.

use crate::Format;
use crate::mesh::MeshFormat;
use heatpath_core::grid::ShapeError;
use heatpath_core::mesh::clean::CleanError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// A size in words: `5 x 4 pixels`, `5 x 4 x 3 voxels`.
pub(crate) fn pixels<T: ToString>(size: &[T]) -> String {
    let sides: Vec<String> = size.iter().map(T::to_string).collect();
    format!("{} {}", sides.join(" x "), if size.len() > 2 { "voxels" } else { "pixels" })
}

/// An index in words: `x = 5, y = 4`.
fn coordinates(index: &[usize]) -> String {
    let named: Vec<String> =
        ["x", "y", "z"].iter().zip(index).map(|(axis, i)| format!("{axis} = {i}")).collect();
    named.join(", ")
}

fn gibibytes(bytes: u64) -> f64 {
    bytes as f64 / (1_u64 << 30) as f64
}

fn components(count: u64) -> &'static str {
    if count == 1 { "value a cell" } else { "values a cell, or frames" }
}

/// What a file of that many axes would be.
fn needed(dimension: usize) -> &'static str {
    if dimension == 3 {
        "a volume is needed: a medical format, a TIFF of several grey pages or an NPY array (slices, \
         rows, columns)"
    } else {
        "a picture is needed"
    }
}

/// The shape of a field of tensors on that many axes.
fn tensors(dimension: usize) -> &'static str {
    if dimension == 3 {
        "(slices, rows, columns, 6), which are xx, xy, xz, yy, yz, zz"
    } else {
        "(rows, columns, 3), which are xx, xy, yy"
    }
}

/// Why a file could not be read. Every message is one line and names the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The operating system did not hand out the file's bytes.
    #[error("{}: cannot be read: {source}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The file has no bytes.
    #[error("{}: the file is empty", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The first bytes belong to no known format.
    #[error(
        "{}: the content is not a known picture; PNG, JPEG, TIFF, PNM (PBM, PGM, PPM), NPY, NIfTI, \
         NRRD, MetaImage and DICOM are accepted",
        path.display()
    )]
    Unrecognised {
        /// The file.
        path: PathBuf,
    },
    /// The content is damaged, truncated or uses an unsupported feature of its format.
    #[error("{}: not readable as {format}: {reason}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// The format that the first bytes announce.
        format: Format,
        /// What was wrong.
        reason: String,
    },
    /// Neither the content nor the ending belongs to a known format of meshes.
    #[error(
        "{}: the content is not a known mesh; PLY, OBJ, STL, OFF, VTK, VTP, glTF and FreeSurfer \
         surfaces are accepted",
        path.display()
    )]
    UnrecognisedMesh {
        /// The file.
        path: PathBuf,
    },
    /// A mesh file is damaged, truncated or uses an unsupported feature of its format.
    #[error("{}: not readable as {format}: {reason}", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// The format that its content or its ending announces.
        format: MeshFormat,
        /// What was wrong.
        reason: String,
    },
    /// What a mesh file holds makes no mesh.
    #[error("{}: {source}", path.display())]
    Clean {
        /// The file.
        path: PathBuf,
        /// What was wrong.
        source: CleanError,
    },
    /// The header claims more pixels than are accepted.
    #[error(
        "{}: {} are too large; at most {most} are accepted",
        path.display(), pixels(size)
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Columns, rows and, of a volume, slices.
        size: Vec<u64>,
        /// The largest accepted number of pixels.
        most: u64,
    },
    /// The header claims more pixels than a file of this length can hold.
    #[error(
        "{}: {} are too large for a file of {bytes} bytes: it is truncated or its header is wrong",
        path.display(), pixels(size)
    )]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Columns, rows and, of a volume, slices.
        size: Vec<u64>,
        /// The length of the file.
        bytes: u64,
    },
    /// The file, or what it holds as 64-bit floats, needs more memory than is free.
    #[error(
        "{}: needs {:.1} GiB of memory, but {:.1} GiB are free",
        path.display(), gibibytes(*needed), gibibytes(*available)
    )]
    Memory {
        /// The file.
        path: PathBuf,
        /// The bytes that it needs.
        needed: u64,
        /// The bytes that are free.
        available: u64,
    },
    /// A cell has several values, or there are several frames, and it was not said which one counts;
    /// or there is no such.
    #[error(
        "{}: has {count} {}; choose one component, from 0 to {}",
        path.display(), components(*count), count.saturating_sub(1)
    )]
    Component {
        /// The file.
        path: PathBuf,
        /// How many values or frames there are.
        count: u64,
    },
    /// The array is neither a picture nor a volume.
    #[error(
        "{}: an array of shape {shape:?}; (rows, columns), (rows, columns, 3 or 4) in colour, \
         (slices, rows, columns) and (slices, rows, columns, 6) of tensors, at least one of each, are \
         accepted",
        path.display()
    )]
    Shape {
        /// The file.
        path: PathBuf,
        /// The array's shape, as its file gives it.
        shape: Vec<u64>,
    },
    /// The array has more than one axis.
    #[error("{}: an array of shape {shape:?}; (values,) is needed", path.display())]
    Vector {
        /// The file.
        path: PathBuf,
        /// The array's shape, as its file gives it.
        shape: Vec<u64>,
    },
    /// The samples have a type that is not read.
    #[error(
        "{}: samples of type {found}; booleans, integers of 8 to 64 bits and floats of 32 or 64 \
         bits are accepted",
        path.display()
    )]
    Type {
        /// The file.
        path: PathBuf,
        /// What the file says about its samples.
        found: String,
    },
    /// A field must have one value a pixel, but the file is in colour.
    #[error("{}: a colour picture with {channels} channels; one channel is needed", path.display())]
    Colour {
        /// The file.
        path: PathBuf,
        /// The channels of the file.
        channels: usize,
    },
    /// One value a pixel is needed, but the file has a tensor for each.
    #[error("{}: a field of tensors; one value a voxel is needed", path.display())]
    Tensors {
        /// The file.
        path: PathBuf,
    },
    /// A tensor for each pixel is needed, but the file has none.
    #[error(
        "{}: no field of tensors; that is an NPY array of shape {}",
        path.display(), tensors(*dimension)
    )]
    NoTensors {
        /// The file.
        path: PathBuf,
        /// The number of axes that is needed.
        dimension: usize,
    },
    /// The file is a volume where a picture is needed, or the other way round.
    #[error("{}: has {}; {}", path.display(), pixels(size), needed(*dimension))]
    Dimension {
        /// The file.
        path: PathBuf,
        /// The size of what is in it.
        size: Vec<usize>,
        /// The number of axes that is needed.
        dimension: usize,
    },
    /// The size or spacing does not make a grid.
    #[error("{}: {source}", path.display())]
    Grid {
        /// The file.
        path: PathBuf,
        /// What the grid said.
        source: ShapeError,
    },
    /// The asked range of values is empty or not finite.
    #[error("the range {low}..{high} is not usable: two finite numbers, the lower one first")]
    Range {
        /// The value meant to become 0.
        low: f64,
        /// The value meant to become 1.
        high: f64,
    },
    /// A pixel is infinite or not a number.
    #[error(
        "{}: the pixel at {} is {value}; all must be finite", path.display(), coordinates(index)
    )]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// The pixel's column, row and, in a volume, slice.
        index: Vec<usize>,
        /// The pixel's value.
        value: f64,
    },
    /// A list of points has an entry that is not a point.
    #[error("{}: {place}: {reason}", path.display())]
    Points {
        /// The file.
        path: PathBuf,
        /// The line or entry, for example `line 3`.
        place: String,
        /// What was wrong.
        reason: String,
    },
}

impl ReadError {
    /// Whether the file could not be opened or read at all; else its content is at fault.
    #[must_use]
    pub fn is_access(&self) -> bool {
        matches!(self, Self::Open { .. })
    }
}

/// Why a file could not be written. Every message is one line and names the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The folder of the output does not exist.
    #[error("{}: the folder {} does not exist", path.display(), folder.display())]
    FolderMissing {
        /// The output.
        path: PathBuf,
        /// The folder it was to be written to.
        folder: PathBuf,
    },
    /// The output is the name of a folder.
    #[error("{}: is a folder, not a file", path.display())]
    IsFolder {
        /// The output.
        path: PathBuf,
    },
    /// There is such a file, and overwriting was not asked for.
    #[error("{}: already exists", path.display())]
    Exists {
        /// The output.
        path: PathBuf,
    },
    /// The ending of the name, or the name of the format, stands for no format that fits.
    #[error("{}: unknown ending or format; accepted are {accepted}", path.display())]
    Ending {
        /// The output.
        path: PathBuf,
        /// The accepted endings, ready to print.
        accepted: String,
    },
    /// The format holds pictures, but a volume was to be written.
    #[error(
        "{}: a volume cannot be drawn as a picture; write .npy or .tif or a medical format for \
         fields, .json or .csv for paths",
        path.display()
    )]
    Volume {
        /// The output.
        path: PathBuf,
    },
    /// A layer of an overlay does not have the size of the picture below it.
    #[error(
        "{}: a field of {} does not fit onto {}", path.display(), pixels(field), pixels(picture)
    )]
    Mismatch {
        /// The output.
        path: PathBuf,
        /// Columns, rows and, of a volume, slices of the picture.
        picture: Vec<usize>,
        /// Those of the field.
        field: Vec<usize>,
    },
    /// The format holds a mesh, but no values of its vertices.
    #[error("{}: the format holds no values of vertices; .ply, .vtp and .vtk do", path.display())]
    NoValues {
        /// The output.
        path: PathBuf,
    },
    /// There are more or fewer values than vertices.
    #[error("{}: {given} values of {name:?} were given for {expected} vertices", path.display())]
    Values {
        /// The output.
        path: PathBuf,
        /// The array.
        name: String,
        /// How many values it has.
        given: usize,
        /// How many there should be.
        expected: usize,
    },
    /// The operating system or the encoder refused.
    #[error("{}: cannot be written: {source}", path.display())]
    Io {
        /// The output.
        path: PathBuf,
        /// What was said.
        source: io::Error,
    },
}
