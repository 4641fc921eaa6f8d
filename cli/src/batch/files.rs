//! Files as they were when a row ran.

use serde::{Deserialize, Serialize};
use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf, absolute};
use std::time::{Duration, UNIX_EPOCH};

/// A file and what tells whether it has changed.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct Stamp {
    /// As the manifest names it.
    pub(super) path: PathBuf,
    /// None if there is no such file. Of a folder: of the files in it.
    pub(super) bytes: Option<u64>,
    /// The last change, in nanoseconds since 1970.
    modified: Option<u64>,
}

impl Stamp {
    /// The file as it is now; `folder` is where its path counts from.
    pub(super) fn now(folder: &Path, path: &Path) -> Self {
        let (bytes, modified) = measure(&folder.join(path)).ok().unzip();
        Self { path: path.to_owned(), bytes, modified: modified.map(|age| age.as_nanos() as u64) }
    }

    /// Whether the file is there and has the size that it had. Its age does not count: copies of
    /// results are as good.
    pub(super) fn is_complete(&self, folder: &Path) -> bool {
        self.bytes.is_some() && Self::now(folder, &self.path).bytes == self.bytes
    }
}

/// Bytes and last change.
fn measure(path: &Path) -> io::Result<(u64, Duration)> {
    let one = |about: &Metadata| {
        let modified = about.modified()?.duration_since(UNIX_EPOCH).unwrap_or_default();
        Ok((about.len(), modified))
    };
    let about = fs::metadata(path)?;
    if !about.is_dir() {
        return one(&about);
    }
    let (mut bytes, mut modified) = (0, Duration::ZERO);
    for entry in fs::read_dir(path)? {
        let (more, when) = one(&entry?.metadata()?)?;
        (bytes, modified) = (bytes + more, modified.max(when));
    }
    Ok((bytes, modified))
}

/// One name for each file: without links, as far as its folder exists.
pub(super) fn unique(path: &Path) -> PathBuf {
    let folder = match path.parent() {
        Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
        Some(parent) => parent,
        None => return path.to_owned(),
    };
    let folder = folder.canonicalize().or_else(|_| absolute(folder));
    match (folder, path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}
