//! Varadhan's formula, equations (3) and (20), and its counterparts for implicit heat.

use super::matern::{Inverse, Matern, lowest};
use super::{DistanceMap, NOT_REACHED, interpolated};
use crate::Exec;
use crate::grid::heat::{Heat, Scheme};

/// The distance as Varadhan's formula gives it: `sqrt(-4 t log u)` of explicit heat, as the paper
/// prints it (eqs. 3, 20), and `-sqrt(step) log u` of implicit heat.
///
/// The two differ because implicit heat is not the heat kernel but the resolvent; which of them it
/// is, [`Heat::scheme`] knows.
///
/// The heat kernel is `exp(-phi^2 / 4t) / (4 pi t)^(N/2)` to leading order (eq. 19), so this reads
/// `sqrt(phi^2 + 2 N t log(4 pi t))`: in a uniform picture after time 120 it is 16 % too long at
/// 100 cells and three times too long at 20. The resolvent is `K_0(phi / sqrt(t)) / (2 pi t)` in the
/// plane after one step: at time 16 this reads 21 cells too much at a distance of 20 cells, and 25 at
/// 200. Use it for pictures and comparisons, and [`normalized`] for lengths. Where u is above 1 the
/// distance is 0.
#[must_use]
pub fn varadhan<const D: usize>(heat: &Heat<D>) -> DistanceMap<D> {
    let unit = heat.shape().smallest_spacing();
    let readout = match heat.scheme() {
        Scheme::Explicit => Readout::Kernel { ln_reference: 0.0, unit, four_t: 4.0 * heat.time() },
        Scheme::Implicit => Readout::Resolvent { unit: unit * heat.step().sqrt() },
    };
    map(heat, &readout)
}

/// The distance without the factor in front of the exponential: the one to be used for lengths.
///
/// **Explicit heat**: `sqrt(-4 t log(u / u0))`, where u0 is the temperature at the warmest source.
/// Dividing by u0 removes the factor `(4 pi t)^(N/2)` of eq. (19), whatever the medium around the
/// source. In uniform media the error is below 0.5 % beyond five cells, as far as `exp(-36)` of the
/// temperature reaches halfway. Further out the walk from cell to cell shows, and distances along
/// the axes and the diagonals differ; a longer time moves that limit out.
///
/// **Implicit heat**: the distance at which heat would be as warm in a uniform medium with the speed
/// of the source's cell. After one step that is the r of `u = amount K_0(r / sqrt(t)) / (2 pi t)` in
/// the plane and of `u = amount exp(-r / sqrt(t)) / (4 pi t r)` in space; after more, of a Matérn
/// function. In uniform media the error is below 0.8 % beyond five cells and 0.3 % beyond ten, however
/// far, for the default time of 16: by `h^2 / 24 t` of the length distances along the axes are too
/// short, and half of that along the diagonals. `-sqrt(t) log(u / u0)` instead would be 57 % too
/// long at 10 cells and 12 % at 80. Borders and walls reflect heat: on the border a distance is too
/// short by `sqrt(t) log 2`, in a corner by twice that, and a wall beside the source shortens all of
/// them alike. Around the end of a wall comes less heat than the length of the way lets expect:
/// distances behind it are up to 9 % too long (explicit heat: 14 %).
///
/// With several sources use [`Explicit::flow_balanced`](crate::grid::heat::Explicit::flow_balanced)
/// or [`Implicit::flow_balanced`](crate::grid::heat::Implicit::flow_balanced). Where two sources are
/// equally near, both warm the cell and it seems nearer: `phi^2` is short by `4 t log 2` there, and
/// phi by `sqrt(t) log 2` for implicit heat.
///
/// In media that vary strongly over few cells expect several per cent. A cell warmer than the source
/// (heat gathers in fast regions) has distance 0.
#[must_use]
pub fn normalized<const D: usize>(heat: &Heat<D>) -> DistanceMap<D> {
    map(heat, &Readout::normalized(heat, lowest(heat.ln_temperature())))
}

/// The [`normalized`] distances of several heats, which the threads of `exec` share.
#[must_use]
pub fn normalized_each<const D: usize>(heats: &[Heat<D>], exec: &Exec) -> Vec<DistanceMap<D>> {
    let mut maps: Vec<_> = heats.iter().map(|heat| (heat, None)).collect();
    exec.for_each(&mut maps, |(heat, map)| *map = Some(normalized(heat)));
    maps.into_iter().filter_map(|(_, map)| map).collect()
}

/// The [`normalized`] distances at `points` alone.
pub(super) fn normalized_at<const D: usize>(heat: &Heat<D>, points: &[[f64; D]]) -> Vec<f64> {
    // A table would not be worth it.
    let readout = Readout::normalized(heat, f64::INFINITY);
    let at = |cell: usize| readout.distance(heat.ln_temperature().values()[cell]);
    points.iter().map(|&point| interpolated(heat.shape(), point, at)).collect()
}

fn map<const D: usize>(heat: &Heat<D>, readout: &Readout) -> DistanceMap<D> {
    DistanceMap { field: heat.ln_temperature().map(|&ln_u| readout.distance(ln_u)) }
}

/// How `ln u` becomes a distance.
enum Readout {
    /// `sqrt(-4 t log (u / reference))`
    Kernel { ln_reference: f64, unit: f64, four_t: f64 },
    /// `-sqrt(step) log u`
    Resolvent { unit: f64 },
    /// The inverse of a Matérn function.
    Matern { inverse: Inverse, ln_reference: f64, unit: f64 },
}

impl Readout {
    /// The readout of temperatures down to the logarithm `lowest`.
    fn normalized<const D: usize>(heat: &Heat<D>, lowest: f64) -> Self {
        let (unit, ln_reference) = (heat.shape().smallest_spacing(), heat.ln_reference());
        let (dimension, steps) = (heat.shape().dimension(), heat.iterations());
        match heat.scheme() {
            Scheme::Explicit => Self::Kernel { ln_reference, unit, four_t: 4.0 * heat.time() },
            Scheme::Implicit => Self::Matern {
                inverse: Inverse::new(
                    Matern { dimension, steps, sum: false },
                    lowest - ln_reference,
                ),
                ln_reference,
                unit: unit * heat.step().sqrt(),
            },
        }
    }

    fn distance(&self, ln_u: f64) -> f64 {
        if ln_u == f64::NEG_INFINITY {
            return NOT_REACHED;
        }
        match self {
            Self::Kernel { ln_reference, unit, four_t } => {
                unit * (four_t * (ln_reference - ln_u)).max(0.0).sqrt()
            }
            Self::Resolvent { unit } => (-unit * ln_u).max(0.0),
            Self::Matern { inverse, ln_reference, unit } => {
                unit * inverse.distance(ln_u - ln_reference)
            }
        }
    }
}
