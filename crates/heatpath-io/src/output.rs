//! Files that appear complete or not at all.
//!
//! An output is written to a temporary file in the folder of its destination and renamed when it is
//! complete: an interruption, a full disk or an error leaves nothing behind, and readers never see
//! half a file.

use crate::WriteError;
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The endings of formats for eyes.
const PICTURES: [&str; 2] = ["png", "svg"];

/// Checks, before a long computation, that an output can be written afterwards.
///
/// `kinds` are the accepted endings without a dot, for example `["npy", "tif"]`; `format` is one of
/// them, or `None` for the ending of `path`. Capitals do not matter. With `overwrite` an existing
/// file is accepted.
///
/// # Errors
/// The format is none of `kinds`, the folder is missing or refuses new files, or the file exists.
pub fn check_output(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    kinds: &[&str],
) -> Result<(), WriteError> {
    let path = path.as_ref();
    known_format(path, format, kinds)?;
    match destination(path, overwrite)? {
        Destination::Device => Ok(()),
        Destination::File { path: target, .. } => tempfile::tempfile_in(folder(&target))
            .map(drop)
            .map_err(|source| io_error(path, source)),
    }
}

/// Checks that a format can hold what has `dimension` axes: pictures (PNG, SVG) hold two.
///
/// `format` is its ending without a dot, or `None` for the ending of `path`.
///
/// # Errors
/// It cannot.
pub fn check_dimension(
    path: impl AsRef<Path>,
    format: Option<&str>,
    dimension: usize,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    let name = format.unwrap_or_else(|| ending(path));
    if dimension == 2 || !PICTURES.iter().any(|picture| picture.eq_ignore_ascii_case(name)) {
        return Ok(());
    }
    Err(WriteError::Volume { path: path.to_owned() })
}

/// Writes a file with `write` so that it appears complete or not at all.
///
/// Without `overwrite` an existing file stays as it is, even if it appears during the writing. With
/// it the file keeps its permissions, and a link keeps its place: the file that it leads to is
/// replaced. A device is written to directly.
///
/// # Errors
/// The folder is missing, the file exists, or the operating system or `write` fails.
pub fn write_atomically(
    path: impl AsRef<Path>,
    overwrite: bool,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    match destination(path, overwrite)? {
        Destination::Device => write_device(path, write),
        Destination::File { path: target, existing } => {
            write_file(&target, overwrite, existing.as_ref(), write)
        }
    }
    .map_err(|source| match source.kind() {
        ErrorKind::AlreadyExists => WriteError::Exists { path: path.to_owned() },
        _ => io_error(path, source),
    })
}

/// The one of `kinds` that is named by `format` or else by the ending of `path`.
pub(crate) fn known_format<'a>(
    path: &Path,
    format: Option<&str>,
    kinds: &[&'a str],
) -> Result<&'a str, WriteError> {
    let name = format.unwrap_or_else(|| ending(path));
    kinds.iter().copied().find(|kind| kind.eq_ignore_ascii_case(name)).ok_or_else(|| {
        let accepted: Vec<_> = kinds.iter().map(|kind| format!(".{kind}")).collect();
        WriteError::Ending { path: path.to_owned(), accepted: accepted.join(", ") }
    })
}

fn ending(path: &Path) -> &str {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default()
}

/// What the name of an output stands for.
enum Destination {
    /// A file, with links resolved, and what is there now.
    File { path: PathBuf, existing: Option<Metadata> },
    /// A device or a pipe: renaming a file over it would destroy it.
    Device,
}

fn destination(path: &Path, overwrite: bool) -> Result<Destination, WriteError> {
    if let Ok(existing) = fs::metadata(path) {
        return match existing {
            folder if folder.is_dir() => Err(WriteError::IsFolder { path: path.to_owned() }),
            file if !file.is_file() => Ok(Destination::Device),
            _ if !overwrite => Err(WriteError::Exists { path: path.to_owned() }),
            file => {
                let target = path.canonicalize().map_err(|source| io_error(path, source))?;
                Ok(Destination::File { path: target, existing: Some(file) })
            }
        };
    }
    // A link that leads nowhere.
    if !overwrite && path.is_symlink() {
        return Err(WriteError::Exists { path: path.to_owned() });
    }
    match folder(path) {
        folder if folder.is_dir() => {
            Ok(Destination::File { path: path.to_owned(), existing: None })
        }
        folder => {
            Err(WriteError::FolderMissing { path: path.to_owned(), folder: folder.to_owned() })
        }
    }
}

/// The folder in which `path` lies.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

fn write_file(
    path: &Path,
    overwrite: bool,
    existing: Option<&Metadata>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = temporary(folder(path))?;
    let mut buffer = BufWriter::new(file.as_file_mut());
    write(&mut buffer)?;
    buffer.flush()?;
    drop(buffer);
    if let Some(existing) = existing {
        file.as_file().set_permissions(existing.permissions())?;
    }
    file.as_file().sync_all()?;
    if overwrite { file.persist(path) } else { file.persist_noclobber(path) }?;
    Ok(())
}

/// A temporary file with the permissions that a new file gets: all that the umask leaves.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".heatpath-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

fn write_device(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut device = BufWriter::new(File::options().write(true).open(path)?);
    write(&mut device)?;
    device.flush()
}

fn io_error(path: &Path, source: io::Error) -> WriteError {
    WriteError::Io { path: path.to_owned(), source }
}
