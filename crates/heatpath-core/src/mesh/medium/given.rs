//! Fields as they are given.

use super::{Medium, MediumError};
use crate::mesh::TriMesh;
use std::sync::Arc;

impl Medium {
    /// A medium with the squared speed `P` at each vertex, as in eq. (16): lengths are
    /// `ds / sqrt(P)`.
    ///
    /// The slowness of a face is the mean of its corners': the smallest would widen ridges of one
    /// edge, and paths leave them.
    ///
    /// # Errors
    /// There is not one value a vertex, or one is not from 1e-100 to 1e100.
    pub fn given(mesh: impl Into<Arc<TriMesh>>, speed_sq: &[f64]) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        check_values("squared speed", ["vertex", "vertices"], speed_sq, mesh.points().len())?;
        let slow = |vertex: u32| 1.0 / speed_sq[vertex as usize].sqrt();
        let slowness =
            mesh.faces().iter().map(|f| f.iter().map(|&v| slow(v)).sum::<f64>() / 3.0).collect();
        let lengths = mesh.edge_lengths();
        let medium = Self::from_parts(mesh, lengths, slowness)?;
        Ok(Self { speed_sq: Some(speed_sq.to_vec()), ..medium })
    }

    /// A medium with the slowness `F` of each face: lengths are `F ds`.
    ///
    /// # Errors
    /// There is not one value a face, or one is not from 1e-100 to 1e100.
    pub fn given_slowness(
        mesh: impl Into<Arc<TriMesh>>,
        slowness: &[f64],
    ) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        check_values("slowness", ["face", "faces"], slowness, mesh.faces().len())?;
        let lengths = mesh.edge_lengths();
        Self::from_parts(mesh, lengths, slowness.to_vec())
    }
}

/// Checks that there is one value a place.
pub(super) fn check_count(
    places: &'static str,
    given: usize,
    expected: usize,
) -> Result<(), MediumError> {
    let error = MediumError::Length { places, expected, given };
    if given == expected { Ok(()) } else { Err(error) }
}

/// Whether a squared speed, a slowness or a factor of a metric can be computed with.
pub(super) fn is_sensible(value: f64) -> bool {
    (1e-100..=1e100).contains(&value)
}

fn check_values(
    what: &'static str,
    [place, places]: [&'static str; 2],
    values: &[f64],
    expected: usize,
) -> Result<(), MediumError> {
    check_count(places, values.len(), expected)?;
    match values.iter().position(|&value| !is_sensible(value)) {
        Some(number) => Err(MediumError::Value { what, value: values[number], place, number }),
        None => Ok(()),
    }
}
