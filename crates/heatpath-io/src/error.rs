//! What can go wrong when files are read or written.

use crate::Format;
use heatpath_core::grid::ShapeError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

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
        "{}: the content is not a known picture; PNG, JPEG, TIFF, PNM (PBM, PGM, PPM) and NPY are \
         accepted",
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
    /// The header claims more pixels than are accepted.
    #[error(
        "{}: {} x {} pixels are too large; at most {most} pixels are accepted",
        path.display(), size[0], size[1]
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Columns and rows.
        size: [u64; 2],
        /// The largest accepted number of pixels.
        most: u64,
    },
    /// The header claims more pixels than a file of this length can hold.
    #[error(
        "{}: {} x {} pixels are too large for a file of {bytes} bytes: it is truncated or its \
         header is wrong",
        path.display(), size[0], size[1]
    )]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Columns and rows.
        size: [u64; 2],
        /// The length of the file.
        bytes: u64,
    },
    /// The array is not a picture.
    #[error(
        "{}: an array of shape {shape:?}; (rows, columns) and (rows, columns, 3 or 4) with at \
         least one row and column are accepted",
        path.display()
    )]
    Shape {
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
    #[error("{}: the pixel at x = {x}, y = {y} is {value}; all must be finite", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// The pixel's column.
        x: usize,
        /// The pixel's row.
        y: usize,
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
    /// A layer of an overlay does not have the size of the picture below it.
    #[error(
        "{}: a field of {} x {} cells does not fit onto a picture of {} x {} pixels",
        path.display(), field[0], field[1], picture[0], picture[1]
    )]
    Mismatch {
        /// The output.
        path: PathBuf,
        /// The columns and rows of the picture.
        picture: [usize; 2],
        /// The columns and rows of the field.
        field: [usize; 2],
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
