//! Heights that paths descend.

use crate::grid::Grid;
use crate::grid::distance::matern::{Inverse, Matern, lowest};
use crate::grid::heat::{Heat, NoExposure, Scheme};
use std::f64::consts::PI;

/// Exposure as a potential that is lowest at the sources.
///
/// In the uniform plane the exposure from a unit source is `E1(r^2 / 4t) / 4 pi`, in space it is
/// `erfc(r / sqrt(4t)) / 4 pi r`. The functions of the exposure used here are monotone, so they
/// change no path, but they are close to `r^2 / 4t` near the source as well as far from it: central
/// differences and interpolation are nearly exact for such a function, and paths come straight into
/// the source.
///
/// Of implicit heat the potential is the square of the distance at which it would be as large in a
/// uniform medium.
pub(super) fn of_heat<const D: usize>(heat: &Heat<D>) -> Result<Grid<f64, D>, NoExposure> {
    let exposure = heat.ln_exposure()?;
    if heat.scheme() == Scheme::Implicit {
        return Ok(implicit_potential(heat, exposure));
    }
    let speeds = heat.speeds_sq.iter().zip(&heat.amounts);
    let scale =
        speeds.map(|(speed_sq, amount)| 4.0 * PI * speed_sq / amount).fold(f64::MAX, f64::min);
    let unit =
        if D < 3 { scale * heat.step } else { scale * heat.step * (4.0 * heat.time()).sqrt() };
    // Where heat is trapped around its source, exp(-exposure) would leave the range of numbers.
    let highest = exposure.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let ln_unit = unit.ln().min(30_f64.ln() - highest);
    Ok(exposure.map(|&ln_exposure| {
        let ln = ln_exposure + ln_unit;
        if ln == f64::NEG_INFINITY {
            f64::INFINITY
        } else if D < 3 {
            minus_ln_of_one_minus_exp_of_minus(ln)
        } else if ln < -30.0 {
            -2.0 * ln
        } else {
            (-2.0 * ln).exp().ln_1p()
        }
    }))
}

fn implicit_potential<const D: usize>(heat: &Heat<D>, exposure: &Grid<f64, D>) -> Grid<f64, D> {
    let dimension = heat.shape().dimension();
    let matern = Matern { dimension, steps: heat.iterations(), sum: true };
    let highest = exposure.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Where heat is trapped around its source, there would be no such distance.
    let strength = heat.ln_reference().max(highest - matern.ln(1e-4).0);
    let inverse = Inverse::new(matern, lowest(exposure) - strength);
    exposure.map(|&ln_exposure| {
        if ln_exposure == f64::NEG_INFINITY {
            f64::INFINITY
        } else {
            inverse.distance(ln_exposure - strength).powi(2)
        }
    })
}

/// `-ln(1 - exp(-a))` for `a = exp(ln_a)`, accurate for all of them: it is close to `exp(-a)` for
/// large a and to `-ln(a)` for small a.
fn minus_ln_of_one_minus_exp_of_minus(ln_a: f64) -> f64 {
    let a = ln_a.exp();
    if ln_a < -30.0 {
        -ln_a
    } else if a < 0.5 {
        -(-(-a).exp_m1()).ln()
    } else {
        -(-(-a).exp()).ln_1p()
    }
}
