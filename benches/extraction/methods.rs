//! The media that are compared, and the rows of the table.

use crate::Failure;
use crate::data::Picture;
use crate::readouts::Readout;
use heatpath_core::Exec;
use heatpath_core::grid::filter::{Polarity, Tubes, medialness};
use heatpath_core::grid::medium::{
    ConductivityOptions, Directions, EdgesOptions, Form, Medium, PeronaMalikOptions, TensorOptions,
    VesselnessOptions, combined, conductivity, edges, given, given_tensor, perona_malik, tensor,
    uniform, vesselness,
};
use heatpath_core::grid::{Grid, TensorField};

/// A medium of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Uniform,
    Conductivity,
    PeronaMalik,
    Combined,
    Edges,
    Tensor,
    /// With a power, an anisotropy and its power.
    Vesselness {
        power: f64,
        anisotropy: f64,
        anisotropy_power: f64,
    },
    /// Isotropic vesselness of power 1 times medialness: each is the square of a speed.
    Middle,
}

/// The radii of medialness.
const RADII: [f64; 5] = [1.5, 2.5, 3.5, 5.0, 7.0];

/// Isotropic vesselness: with [`Readout::Eikonal`] it is the baseline.
pub(crate) const ISOTROPIC: Kind = vessels(2.0, 0.0, 1.0);

/// The best of the tensors.
pub(crate) const ALONG: Kind = vessels(2.0, 0.95, 0.3);

const fn vessels(power: f64, anisotropy: f64, anisotropy_power: f64) -> Kind {
    Kind::Vesselness { power, anisotropy, anisotropy_power }
}

/// All rows of the table.
pub(crate) fn all() -> Vec<(Kind, Readout)> {
    use Readout::{
        Bridge, BridgeOfVessels, Eikonal, Explicit, ExplicitDistance, HeatMethod, Implicit,
    };
    let of_paper = [
        Kind::Uniform,
        Kind::Conductivity,
        Kind::PeronaMalik,
        Kind::Combined,
        Kind::Edges,
        Kind::Tensor,
    ];
    let mut rows = Vec::new();
    for kind in of_paper.into_iter().chain([ISOTROPIC, ALONG]) {
        rows.extend([Eikonal, Explicit, ExplicitDistance, Implicit, Bridge].map(|r| (kind, r)));
        if !kind.is_tensor() {
            rows.push((kind, HeatMethod));
        }
    }
    rows.extend([Eikonal, BridgeOfVessels].map(|readout| (Kind::Middle, readout)));
    rows.extend([1.0, 3.0, 4.0].map(|power| (vessels(power, 0.0, 1.0), Eikonal)));
    rows
}

impl Kind {
    pub(crate) fn name(self) -> String {
        match self {
            Self::Uniform => "uniform (1)".into(),
            Self::Conductivity => "conductivity (6)".into(),
            Self::PeronaMalik => "Perona-Malik (8)".into(),
            Self::Combined => "combined (10)".into(),
            Self::Edges => "edges (11)".into(),
            Self::Tensor => "tensor (12)-(14)".into(),
            Self::Middle => "vesselness and medialness".into(),
            Self::Vesselness { power, anisotropy: 0.0, .. } => format!("vesselness, power {power}"),
            Self::Vesselness { power, anisotropy, anisotropy_power } => {
                format!("vesselness, power {power}, A = {anisotropy} v^{anisotropy_power}")
            }
        }
    }

    /// Whether the medium is another for each source.
    pub(crate) fn depends_on_source(self) -> bool {
        matches!(self, Self::Conductivity | Self::Combined)
    }

    fn is_tensor(self) -> bool {
        match self {
            Self::Tensor => true,
            Self::Vesselness { anisotropy, .. } => anisotropy > 0.0,
            _ => false,
        }
    }

    /// The medium of a picture whose sources have the grey values `references`.
    pub(crate) fn medium(
        self,
        picture: &Picture,
        references: &[f64],
        exec: &Exec,
    ) -> Result<Medium<2>, Failure> {
        let grey = &picture.grey;
        let held_back = PeronaMalikOptions { smoothing: 1.0, ..PeronaMalikOptions::default() };
        Ok(match self {
            Self::Uniform => uniform(*grey.shape()),
            Self::Conductivity => conductivity(grey, references, ConductivityOptions::default())?,
            Self::PeronaMalik => perona_malik(grey, held_back)?,
            Self::Combined => {
                combined(grey, references, ConductivityOptions::default(), held_back)?
            }
            Self::Edges => edges(grey, EdgesOptions { smoothing: 1.0, ..EdgesOptions::default() })?,
            Self::Tensor => {
                let directions = Directions::Hessian { sigma: 2.0, polarity: Polarity::Bright };
                tensor(grey, TensorOptions { directions, ..TensorOptions::default() }, exec)?
            }
            Self::Vesselness { power, anisotropy, anisotropy_power } => {
                let scales = vec![1.5, 3.0, 5.0];
                let tubes = Tubes { scales, elongation: 2.0, ..Tubes::default() };
                let usual = VesselnessOptions::default();
                let options =
                    VesselnessOptions { tubes, power, anisotropy, anisotropy_power, ..usual };
                conserving(vesselness(&picture.contrast, &options, exec)?)?
            }
            Self::Middle => {
                let vessels = vessels(1.0, 0.0, 1.0).medium(picture, references, exec)?;
                let floor = VesselnessOptions::default().floor;
                let medialness = medialness(&picture.contrast, &RADII, exec)?;
                let speed_sq = Grid::from_fn(*grey.shape(), |index| {
                    let vessel = vessels.speed_sq(grey.shape().position(index)) - floor;
                    vessel.max(0.0) * medialness[index] + floor
                });
                given(speed_sq, Form::Pointwise)?
            }
        })
    }
}

/// A tensor medium with all of `k D` inside the divergence, which has the same metric.
fn conserving(medium: Medium<2>) -> Result<Medium<2>, Failure> {
    if medium.diffusion().tensor().is_none() {
        return Ok(medium);
    }
    let shape = *medium.shape();
    let field = TensorField::from_fn(shape, |i| medium.speed_sq_tensor(shape.position(i)));
    Ok(given_tensor(field)?)
}
