//! Files that appear complete or not at all.
//!
//! An output is written to a temporary file in the folder of its destination and renamed when it is
//! complete: an interruption, a full disk or an error leaves nothing behind, and readers never see
//! half a file. Only a process that is killed leaves its temporary file, whose name says of which
//! output: [`remove_leftovers`].

use crate::WriteError;
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// What the names of temporary files have between that of the output and their own.
const MARK: &str = ".heatpath-";

/// The ending of temporary files.
const PART: &str = ".part";

/// How many bytes of an output's name go into that of its temporary file: names have 255 at most.
const NAME: usize = 180;

/// The endings of formats for eyes.
const PICTURES: [&str; 2] = ["png", "svg"];

/// The endings of headers whose data go to a file of their own, as `Volume::write` does it.
const DETACHED: [&str; 2] = ["mhd", "nhdr"];

/// The one ending with a dot inside.
const GZIPPED: &str = ".nii.gz";

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
    if DETACHED.contains(&known_format(path, format, kinds)?) {
        check_free(&companion(path), overwrite)?;
    }
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

/// Removes the temporary files that processes left which were killed while they wrote `path`.
///
/// No process may be writing it now. A missing folder is no error.
///
/// # Errors
/// The operating system refuses.
pub fn remove_leftovers(path: impl AsRef<Path>) -> Result<(), WriteError> {
    let path = path.as_ref();
    let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let prefix = temporary_prefix(&target);
    let is_leftover = |name: &str| name.starts_with(&prefix) && name.ends_with(PART);
    let entries = fs::read_dir(folder(&target)).into_iter().flatten().flatten();
    let leftovers = entries.filter(|entry| entry.file_name().to_str().is_some_and(is_leftover));
    leftovers
        .map(|entry| entry.path())
        .try_for_each(|file| fs::remove_file(&file).map_err(|source| io_error(&file, source)))
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

/// The ending of a name without its dot, with `nii.gz` taken for one; empty if there is none.
#[must_use]
pub fn ending(path: &Path) -> &str {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    match name.len().checked_sub(GZIPPED.len()).and_then(|start| name.get(start..)) {
        Some(end) if end.eq_ignore_ascii_case(GZIPPED) => &end[1..],
        _ => path.extension().and_then(|ending| ending.to_str()).unwrap_or_default(),
    }
}

/// The second file of an output whose numbers do not go into its header (`.mhd`, `.nhdr`): `a.mhd.raw`.
///
/// The whole name counts, so that no two headers share it, and no header names itself.
#[must_use]
pub fn data_file(path: &Path, format: Option<&str>) -> Option<PathBuf> {
    let kind = format.unwrap_or_else(|| ending(path));
    DETACHED.iter().any(|detached| detached.eq_ignore_ascii_case(kind)).then(|| companion(path))
}

/// The file for the data of a header.
pub(crate) fn companion(header: &Path) -> PathBuf {
    let mut name = header.as_os_str().to_owned();
    name.push(".raw");
    PathBuf::from(name)
}

/// Refuses a file that exists, unless it may be overwritten.
pub(crate) fn check_free(path: &Path, overwrite: bool) -> Result<(), WriteError> {
    destination(path, overwrite).map(drop)
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
    let mut file = temporary(path)?;
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

/// A temporary file beside `path` with the permissions that a new file gets: all that the umask leaves.
fn temporary(path: &Path) -> io::Result<NamedTempFile> {
    let prefix = temporary_prefix(path);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(PART);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder(path))
}

/// How the names of temporary files for `path` begin.
fn temporary_prefix(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let length = name.char_indices().map(|(start, c)| start + c.len_utf8());
    let kept = length.take_while(|&end| end <= NAME).last().unwrap_or(0);
    format!(".{}{MARK}", &name[..kept])
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
