//! The media and readouts that are compared.

use crate::Failure;
use crate::data::Picture;
use crate::pairs::Ways;
use heatpath_core::Exec;
use heatpath_core::grid::distance::{
    DistanceMap, Eikonal, EikonalOptions, HeatMethod, HeatMethodOptions, normalized,
};
use heatpath_core::grid::filter::{Measure, Polarity, Tubes};
use heatpath_core::grid::heat::{
    Duration, Explicit, Heat, HeatOptions, Implicit, ImplicitOptions, Step,
};
use heatpath_core::grid::medium::{
    ConductivityOptions, Directions, EdgesOptions, Medium, PeronaMalikOptions, TensorOptions,
    VesselnessOptions, combined, conductivity, edges, given_tensor, perona_malik, tensor, uniform,
    vesselness,
};
use heatpath_core::grid::path::{Descent, Ending, PathOptions};
use heatpath_core::grid::{Sources, TensorField};

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
}

/// How paths come from a medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Readout {
    Eikonal,
    /// The exposure of explicit heat.
    Explicit,
    /// The normalized distance of explicit heat.
    ExplicitDistance,
    /// One implicit step of [`TIME`].
    Implicit,
    HeatMethod,
}

/// The steps of explicit heat, as long as is stable.
pub(crate) const STEPS: usize = 600;

/// The time of implicit heat.
pub(crate) const TIME: f64 = 32.0;

/// Isotropic vesselness: with [`Readout::Eikonal`] it is the baseline.
pub(crate) const ISOTROPIC: Kind = vessels(2.0, 0.0, 1.0);

/// The best of the tensors.
pub(crate) const ALONG: Kind = vessels(2.0, 0.9, 0.3);

const fn vessels(power: f64, anisotropy: f64, anisotropy_power: f64) -> Kind {
    Kind::Vesselness { power, anisotropy, anisotropy_power }
}

/// All rows of the table.
pub(crate) fn all() -> Vec<(Kind, Readout)> {
    use Readout::{Eikonal, Explicit, ExplicitDistance, HeatMethod, Implicit};
    let of_paper = [
        Kind::Uniform,
        Kind::Conductivity,
        Kind::PeronaMalik,
        Kind::Combined,
        Kind::Edges,
        Kind::Tensor,
    ];
    let mut rows = Vec::new();
    for kind in of_paper.into_iter().chain([ISOTROPIC, vessels(2.0, 0.9, 1.0), ALONG]) {
        rows.extend([Eikonal, Explicit, ExplicitDistance, Implicit].map(|r| (kind, r)));
        if !kind.is_tensor() {
            rows.push((kind, HeatMethod));
        }
    }
    rows.extend([1.0, 3.0].map(|power| (vessels(power, 0.0, 1.0), Eikonal)));
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
                let (measure, scales) = (Measure::OrientedFlux, vec![1.0, 2.0, 3.0, 4.5]);
                let tubes = Tubes { measure, scales, ..Tubes::default() };
                let usual = VesselnessOptions::default();
                let options =
                    VesselnessOptions { tubes, power, anisotropy, anisotropy_power, ..usual };
                conserving(vesselness(&picture.contrast, &options, exec)?)?
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

impl Readout {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Eikonal => "eikonal",
            Self::Explicit => "explicit",
            Self::ExplicitDistance => "explicit, distance",
            Self::Implicit => "implicit",
            Self::HeatMethod => "heat method",
        }
    }

    /// The paths from the ends of each of `ways` to its source, and how many did not arrive.
    pub(crate) fn paths(
        self,
        medium: &Medium<2>,
        ways: &[Ways],
        exec: &Exec,
    ) -> Result<Traced, Failure> {
        let mut traced = Traced::default();
        match self {
            Self::Eikonal => {
                let eikonal = Eikonal::new(medium, exec)?;
                traced.by_distance(medium, ways, |sources, targets| {
                    let options = EikonalOptions { targets, ..EikonalOptions::default() };
                    Ok(eikonal.distance(sources, &options, exec)?)
                })?;
            }
            Self::Explicit | Self::ExplicitDistance => {
                let duration = Duration::Iterations(STEPS);
                let options = HeatOptions { duration, step: Step::Auto, ..HeatOptions::default() };
                let explicit = Explicit::new(medium, options)?;
                if self == Self::Explicit {
                    traced.by_heat(medium, ways, |sources| Ok(explicit.flow(sources, exec)?))?;
                } else {
                    traced.by_distance(medium, ways, |sources, _| {
                        Ok(normalized(&explicit.flow(sources, exec)?))
                    })?;
                }
            }
            Self::Implicit => {
                let options = ImplicitOptions { time: TIME, ..ImplicitOptions::default() };
                let implicit = Implicit::new(medium, options, exec)?;
                traced.by_heat(medium, ways, |sources| Ok(implicit.flow(sources, exec)?))?;
            }
            Self::HeatMethod => {
                let method = HeatMethod::new(medium, HeatMethodOptions::default(), exec)?;
                traced
                    .by_distance(medium, ways, |sources, _| Ok(method.distance(sources, exec)?))?;
            }
        }
        Ok(traced)
    }
}

/// Paths in pixel coordinates of the full size, in the order of the ways.
#[derive(Debug, Default)]
pub(crate) struct Traced {
    pub(crate) paths: Vec<Vec<[f64; 2]>>,
    pub(crate) lost: usize,
}

impl Traced {
    /// The ends alone, from which no path comes.
    pub(crate) fn none(ways: &[Ways]) -> Self {
        let truths = ways.iter().flat_map(|ways| &ways.truths);
        let paths: Vec<_> = truths.map(|truth| vec![truth[0]]).collect();
        Self { lost: paths.len(), paths }
    }

    fn by_heat(
        &mut self,
        medium: &Medium<2>,
        ways: &[Ways],
        heat: impl Fn(&Sources<2>) -> Result<Heat<2>, Failure>,
    ) -> Result<(), Failure> {
        for ways in ways {
            let heat = heat(&sources(medium, ways)?)?;
            self.add(&Descent::new(&heat, medium)?, &normalized(&heat), ways)?;
        }
        Ok(())
    }

    fn by_distance(
        &mut self,
        medium: &Medium<2>,
        ways: &[Ways],
        distance: impl Fn(&Sources<2>, Vec<[f64; 2]>) -> Result<DistanceMap<2>, Failure>,
    ) -> Result<(), Failure> {
        for ways in ways {
            let sources = sources(medium, ways)?;
            let map = distance(&sources, ends(ways).collect())?;
            self.add(&Descent::of_distances(&map, &sources, medium), &map, ways)?;
        }
        Ok(())
    }

    fn add(
        &mut self,
        descent: &Descent<'_, 2>,
        distances: &DistanceMap<2>,
        ways: &Ways,
    ) -> Result<(), Failure> {
        for end in ends(ways) {
            let path = descent.path(end, distances, PathOptions::default())?;
            self.lost += usize::from(!matches!(path.ending, Ending::Source(_)));
            self.paths.push(path.points.iter().map(|&point| from_half(point)).collect());
        }
        Ok(())
    }
}

pub(crate) fn sources(medium: &Medium<2>, ways: &Ways) -> Result<Sources<2>, Failure> {
    Ok(Sources::new(&[to_half(ways.source)], medium.mask())?)
}

fn ends(ways: &Ways) -> impl Iterator<Item = [f64; 2]> {
    ways.truths.iter().map(|truth| to_half(truth[0]))
}

/// From pixel coordinates of the full size to those of the halved picture.
pub(crate) fn to_half(point: [f64; 2]) -> [f64; 2] {
    point.map(|x| 0.5 * x - 0.25)
}

fn from_half(point: [f64; 2]) -> [f64; 2] {
    point.map(|x| 2.0 * x + 0.5)
}
