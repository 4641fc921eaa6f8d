//! Speed along ridges and valleys.

use super::given::{check_count, is_sensible};
use super::{Directed, Medium, MediumError};
use crate::error::{check, check_positive};
use crate::grid::eigen;
use crate::mesh::vector::distance;
use crate::mesh::{Curvature, Principal, TriMesh};
use std::sync::Arc;

/// Which bends of the surface count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bend {
    /// Ridges and valleys.
    #[default]
    Both,
    /// Ridges: where the surface is convex.
    Convex,
    /// Valleys: where it is concave.
    Concave,
}

impl Bend {
    /// How strongly the surface bends so.
    fn strength(self, curvature: &Principal) -> f64 {
        let [low, high] = curvature.values;
        match self {
            Self::Both => curvature.strongest().abs(),
            Self::Convex => high.max(0.0),
            Self::Concave => (-low).max(0.0),
        }
    }

    /// The direction in which a ridge or valley runs.
    fn along(self, curvature: &Principal) -> [f64; 3] {
        match self {
            Self::Both => curvature.crease(),
            Self::Convex => curvature.directions[0],
            Self::Concave => curvature.directions[1],
        }
    }
}

/// The parameters of [`Medium::curvature`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureMediumOptions {
    /// Which bends count; default [`Bend::Both`].
    pub bend: Bend,
    /// The squared speed epsilon where the surface is flat; above 0, at most 1. A way over flat
    /// faces costs `1 / sqrt(epsilon)` times one along a ridge. Default 0.01.
    pub floor: f64,
    /// The power q: above 1 only the strongest bends are fast, below 1 weak ones too. Positive;
    /// default 1.
    pub power: f64,
    /// The part of the vertices that bend less than what counts as fully bent; above 0, at most 1.
    /// Default 0.99: corners and faults of the mesh are the rest.
    pub quantile: f64,
}

impl Default for CurvatureMediumOptions {
    fn default() -> Self {
        Self { bend: Bend::Both, floor: 0.01, power: 1.0, quantile: 0.99 }
    }
}

impl Medium {
    /// The squared speed `P = epsilon + (1 - epsilon) min(kappa / kappa_99, 1)^q` of eq. (16) with the
    /// curvature kappa: lengths are `ds / sqrt(P)`, and paths follow ridges and valleys.
    ///
    /// kappa is the curvature of larger size; of convex bends only, the larger one where it is
    /// positive, and of concave ones minus the smaller one where it is negative. `kappa_99` is its
    /// [`quantile`](CurvatureMediumOptions::quantile). What bends less than a thousand millionth of
    /// the strongest bend, or of a sphere as large as the mesh, is flat.
    ///
    /// How well paths keep to sharp edges depends on the radius of the curvature: on the block of Fig. 11
    /// 99 % of the length of paths between points on edges is on edges with a radius of 0.6 mean edges,
    /// 83 % with 1, 53 % with 2 and 38 % with 4, where vertices beside the edge are as fast.
    ///
    /// # Errors
    /// The curvature is that of another mesh, or a parameter is out of range.
    pub fn curvature(
        mesh: impl Into<Arc<TriMesh>>,
        curvature: &Curvature,
        options: CurvatureMediumOptions,
    ) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        let speed_sq = speeds_sq(&mesh, curvature, options)?;
        Self::given(mesh, &speed_sq)
    }

    /// Speed along ridges and valleys, but not across them: `1 / sqrt(P)` is the slowness along the
    /// crease, with the P of [`curvature`](Self::curvature), and `1 / sqrt(epsilon)` across.
    ///
    /// # Errors
    /// The curvature is that of another mesh, or a parameter is out of range.
    pub fn crease(
        mesh: impl Into<Arc<TriMesh>>,
        curvature: &Curvature,
        options: CurvatureMediumOptions,
    ) -> Result<Self, MediumError> {
        let mesh = mesh.into();
        let speed_sq = speeds_sq(&mesh, curvature, options)?;
        let slow = 1.0 / options.floor.sqrt();
        let directed = mesh.faces().iter().map(|corners| {
            let slowness = corners.map(|vertex| 1.0 / speed_sq[vertex as usize].sqrt());
            let corners = corners.map(|vertex| &curvature.vertices()[vertex as usize]);
            let along = slowness.iter().sum::<f64>() / 3.0;
            Directed { direction: mean_direction(options.bend, corners), along, across: slow }
        });
        let directed: Vec<_> = directed.collect();
        Self::directed(mesh, &directed)
    }
}

/// What bends less than this part of the strongest is flat.
const FLAT: f64 = 1e-9;

/// The squared speed at each vertex.
fn speeds_sq(
    mesh: &TriMesh,
    curvature: &Curvature,
    options: CurvatureMediumOptions,
) -> Result<Vec<f64>, MediumError> {
    let CurvatureMediumOptions { bend, floor, power, quantile } = options;
    check_count("vertices", curvature.vertices().len(), mesh.points().len())?;
    let is_part = |x: f64| x > 0.0 && x <= 1.0;
    check("floor", floor, is_part(floor) && is_sensible(floor), "above 0 (1e-100), at most 1")?;
    check_positive("power", power)?;
    check("quantile", quantile, is_part(quantile), "above 0, at most 1")?;
    let strengths: Vec<f64> = curvature.vertices().iter().map(|v| bend.strength(v)).collect();
    let mut sorted = strengths.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let last = sorted.len() - 1;
    let full = sorted[(quantile * last as f64).round() as usize];
    let [low, high] = mesh.bounds();
    let flat = FLAT * sorted[last].max(1.0 / distance(low, high));
    let part = |strength: f64| if strength > flat { (strength / full).min(1.0) } else { 0.0 };
    Ok(strengths.iter().map(|&s| floor + (1.0 - floor) * part(s).powf(power)).collect())
}

/// The mean of the directions of creases at the corners of a face, which have no sign.
fn mean_direction(bend: Bend, corners: [&Principal; 3]) -> [f64; 3] {
    let mut sum = [[0.0; 3]; 3];
    for corner in corners {
        let (strength, along) = (bend.strength(corner), bend.along(corner));
        for (row, a) in sum.iter_mut().zip(along) {
            row.iter_mut().zip(along).for_each(|(entry, b)| *entry += strength * a * b);
        }
    }
    eigen(&sum).1[2]
}
