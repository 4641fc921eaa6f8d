//! Whether files lie in the same place.

use crate::failure::Failure;
use heatpath_io::{ImageFile, Placement, gap_between};
use std::path::Path;

/// Where a file says that its grid lies.
pub(crate) struct Place<'a, const D: usize> {
    pub(crate) file: &'a Path,
    pub(crate) spacing: [f64; D],
    pub(crate) placement: Placement,
}

impl<'a, const D: usize> Place<'a, D> {
    /// None if the file does not say.
    pub(crate) fn of(path: &'a Path, file: &ImageFile) -> Option<Self> {
        let (spacing, placement) = (file.spacing()?, file.placement()?);
        Some(Self { file: path, spacing, placement })
    }

    /// Refuses another file of the same `size` that says that it lies elsewhere.
    pub(crate) fn check(&self, other: &Self, size: [usize; D]) -> Result<(), Failure> {
        let place = |place: &Self| (place.spacing, place.placement);
        let gap = gap_between(size, place(self), place(other));
        if gap <= self.spacing.into_iter().fold(f64::INFINITY, f64::min) {
            return Ok(());
        }
        Err(Failure::bad_input(format!(
            "{}: lies elsewhere: one of its corners is {gap:.3} away from that of {}; --spacing \
             makes this file's place count for nothing",
            other.file.display(),
            self.file.display()
        )))
    }
}
