//! How paths are read from a medium.

use crate::Failure;
use crate::pairs::Ways;
use heatpath_core::Exec;
use heatpath_core::grid::bridge::bridge;
use heatpath_core::grid::distance::{
    DistanceMap, Eikonal, EikonalOptions, HeatMethod, HeatMethodOptions, normalized,
};
use heatpath_core::grid::heat::{
    Duration, Explicit, Heat, HeatOptions, Implicit, ImplicitOptions, Step,
};
use heatpath_core::grid::medium::{Form, Medium, given};
use heatpath_core::grid::path::{Descent, Ending, PathOptions};
use heatpath_core::grid::{Grid, Sources};

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
    /// Fast marching in the medium along the bridge of heats from both ends, each one implicit step
    /// of [`BRIDGE_TIME`].
    Bridge,
    /// The same, but heat flows in isotropic vesselness, and the power of the medium is
    /// [`MIDDLE_POWER`].
    BridgeOfVessels,
    HeatMethod,
}

/// The steps of explicit heat, as long as is stable.
pub(crate) const STEPS: usize = 600;

/// The time of implicit heat.
pub(crate) const TIME: f64 = 16.0;

/// The time of implicit heat of which a bridge is made.
const BRIDGE_TIME: f64 = 4000.0;

/// The powers of the medium and of the density in [`along_bridge`].
const BRIDGE_POWERS: [f64; 2] = [2.0, 0.7];

/// The power of the medium where heat flows in another.
const MIDDLE_POWER: f64 = 2.5;

/// The least squared speed in [`along_bridge`].
const BRIDGE_FLOOR: f64 = 1e-6;

/// How far beyond the length of its ways a window reaches, in pixels.
const MARGIN: f64 = 10.0;

impl Readout {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Eikonal => "eikonal",
            Self::Explicit => "explicit",
            Self::ExplicitDistance => "explicit, distance",
            Self::Implicit => "implicit",
            Self::Bridge => "bridge",
            Self::BridgeOfVessels => "bridge of vesselness",
            Self::HeatMethod => "heat method",
        }
    }

    /// The paths from the ends of `ways` to their source, and how many did not arrive.
    pub(crate) fn paths(
        self,
        window: &Window,
        ways: &Ways,
        exec: &Exec,
    ) -> Result<Traced, Failure> {
        let medium = &window.medium;
        let source = window.sources(ways.source)?;
        let ends: Vec<_> = ways.truths.iter().map(|truth| window.inside(truth[0])).collect();
        let explicit = || -> Result<Heat<2>, Failure> {
            let duration = Duration::Iterations(STEPS);
            let options = HeatOptions { duration, step: Step::Auto, ..HeatOptions::default() };
            Ok(Explicit::new(medium, options)?.flow(&source, exec)?)
        };
        let implicit = |medium, time: f64| {
            Implicit::new(medium, ImplicitOptions { time, ..ImplicitOptions::default() }, exec)
        };
        let mut traced = Traced::default();
        match self {
            Self::Eikonal => {
                let map = fast_marching(medium, &source, &ends, exec)?;
                traced.add(&Descent::of_distances(&map, &source, medium), &map, &ends, window)?;
            }
            Self::Explicit => traced.by_heat(&explicit()?, &ends, window)?,
            Self::ExplicitDistance => {
                let map = normalized(&explicit()?);
                traced.add(&Descent::of_distances(&map, &source, medium), &map, &ends, window)?;
            }
            Self::Implicit => {
                traced.by_heat(&implicit(medium, TIME)?.flow(&source, exec)?, &ends, window)?;
            }
            Self::Bridge | Self::BridgeOfVessels => {
                let (heated, powers) = match self {
                    Self::Bridge => (medium, BRIDGE_POWERS),
                    _ => (&window.vessels, [MIDDLE_POWER, BRIDGE_POWERS[1]]),
                };
                let implicit = implicit(heated, BRIDGE_TIME)?;
                let from = implicit.flow(&source, exec)?;
                for end in ends {
                    let to = implicit.flow(&Sources::new(&[end], medium.mask())?, exec)?;
                    let medium = along_bridge(medium, powers, [&from, &to])?;
                    let map = fast_marching(&medium, &source, &[end], exec)?;
                    let descent = Descent::of_distances(&map, &source, &medium);
                    traced.add(&descent, &map, &[end], window)?;
                }
            }
            Self::HeatMethod => {
                let method = HeatMethod::new(medium, HeatMethodOptions::default(), exec)?;
                let map = method.distance(&source, exec)?;
                traced.add(&Descent::of_distances(&map, &source, medium), &map, &ends, window)?;
            }
        }
        Ok(traced)
    }
}

/// The medium `k^2 b^0.7`, or with other `powers`, where b is the density of heat between two points, over its
/// largest value.
fn along_bridge(
    medium: &Medium<2>,
    powers: [f64; 2],
    [from, to]: [&Heat<2>; 2],
) -> Result<Medium<2>, Failure> {
    let ln_density = bridge(from, to)?;
    let ln_speed_sq = Grid::from_fn(*medium.shape(), |index| {
        let speed_sq = medium.speed_sq(medium.shape().position(index));
        powers[0] * speed_sq.ln() + powers[1] * ln_density[index]
    });
    let largest = ln_speed_sq.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let speed_sq = ln_speed_sq.map(|ln_speed_sq| (ln_speed_sq - largest).exp().max(BRIDGE_FLOOR));
    Ok(given(speed_sq, Form::Pointwise)?)
}

fn fast_marching(
    medium: &Medium<2>,
    source: &Sources<2>,
    ends: &[[f64; 2]],
    exec: &Exec,
) -> Result<DistanceMap<2>, Failure> {
    let options = EikonalOptions { targets: ends.to_vec(), ..EikonalOptions::default() };
    Ok(Eikonal::new(medium, exec)?.distance(source, &options, exec)?)
}

/// A part of a medium around a source that holds its ways.
pub(crate) struct Window {
    medium: Medium<2>,
    /// Isotropic vesselness.
    vessels: Medium<2>,
    low: [f64; 2],
}

impl Window {
    /// Ways of `length` leave the source by no more than that.
    pub(crate) fn new(medium: &Medium<2>, vessels: &Medium<2>, ways: &Ways, length: f64) -> Self {
        let reach = length + MARGIN;
        let low = ways.source.map(|x| (x - reach).max(0.0).floor());
        let size = [0, 1].map(|axis| (ways.source[axis] + reach - low[axis]) as usize + 1);
        let [medium, vessels] = [medium, vessels].map(|m| m.cropped(low.map(|x| x as usize), size));
        Self { medium, vessels, low }
    }

    fn inside(&self, point: [f64; 2]) -> [f64; 2] {
        [point[0] - self.low[0], point[1] - self.low[1]]
    }

    fn sources(&self, point: [f64; 2]) -> Result<Sources<2>, Failure> {
        Ok(Sources::new(&[self.inside(point)], self.medium.mask())?)
    }
}

/// Paths in pixel coordinates of the picture, in the order of the ways.
#[derive(Debug, Default)]
pub(crate) struct Traced {
    pub(crate) paths: Vec<Vec<[f64; 2]>>,
    pub(crate) lost: usize,
}

impl Traced {
    /// The ends alone, from which no path comes.
    pub(crate) fn none(ways: &Ways) -> Self {
        let paths: Vec<_> = ways.truths.iter().map(|truth| vec![truth[0]]).collect();
        Self { lost: paths.len(), paths }
    }

    fn by_heat(
        &mut self,
        heat: &Heat<2>,
        ends: &[[f64; 2]],
        window: &Window,
    ) -> Result<(), Failure> {
        self.add(&Descent::new(heat, &window.medium)?, &normalized(heat), ends, window)
    }

    fn add(
        &mut self,
        descent: &Descent<'_, 2>,
        distances: &DistanceMap<2>,
        ends: &[[f64; 2]],
        window: &Window,
    ) -> Result<(), Failure> {
        for &end in ends {
            let path = descent.path(end, distances, PathOptions::default())?;
            self.lost += usize::from(!matches!(path.ending, Ending::Source(_)));
            let outside = |point: &[f64; 2]| [point[0] + window.low[0], point[1] + window.low[1]];
            self.paths.push(path.points.iter().map(outside).collect());
        }
        Ok(())
    }
}
