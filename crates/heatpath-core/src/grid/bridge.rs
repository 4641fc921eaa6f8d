//! Where heat passes on its way between two points: a path with a width.

use super::Grid;
use super::heat::{Heat, NoExposure};
use thiserror::Error;

/// Why there is no bridge.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BridgeError {
    /// The two heats are not of the same grid.
    #[error("the two ends are on grids of different size: {from:?} and {to:?} cells")]
    Size {
        /// The cells along each axis of the one.
        from: Vec<usize>,
        /// The cells along each axis of the other.
        to: Vec<usize>,
    },
    /// No heat from one end has come to the other.
    #[error("no heat from one end reaches the other")]
    NotReached,
    /// One of the heats was made without its exposure.
    #[error(transparent)]
    NoExposure(#[from] NoExposure),
}

/// The logarithm of `u_s u_t / u_s(t)`, where `u_s` and `u_t` are the [exposures](Heat::ln_exposure) of
/// heat from `from` and `to`.
///
/// A particle of heat wanders at random. Among those that start at s and come to t, this is the time
/// that one spends in a cell, in units of the time step. It is largest along the minimal path: far from the ends the
/// density of one implicit step falls like `exp(-excess / sqrt(t))`, where the excess is by how much
/// the way through the cell is longer than the minimal one. Half way along a straight path of
/// length d it is half as wide as `sqrt(2 d sqrt(t))`. Where there are two ways, both show.
///
/// Minus infinity where no heat of both comes. Both heats are to be of the same medium, time and
/// scheme.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::bridge::bridge;
/// use heatpath_core::grid::heat::{Implicit, ImplicitOptions};
/// use heatpath_core::grid::{Shape, Sources, medium};
///
/// let medium = medium::uniform(Shape::new([64, 48])?);
/// let exec = Exec::single_threaded();
/// let implicit = Implicit::new(&medium, ImplicitOptions::default(), &exec)?;
/// let heat = |point| implicit.flow(&Sources::new(&[point], medium.mask())?, &exec).map_err(Box::<dyn std::error::Error>::from);
/// let ln_density = bridge(&heat([12.0, 20.0])?, &heat([52.0, 20.0])?)?;
/// assert!(ln_density[[32, 20]] > ln_density[[32, 30]] + 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The grids differ, or no heat from one end reaches the other.
pub fn bridge<const D: usize>(from: &Heat<D>, to: &Heat<D>) -> Result<Grid<f64, D>, BridgeError> {
    let (size, other) = (from.shape().size(), to.shape().size());
    if size != other {
        return Err(BridgeError::Size { from: size.to_vec(), to: other.to_vec() });
    }
    let (from, towards) = (from.ln_exposure()?, to.ln_exposure()?);
    let crossing = to.sources().points().iter().map(|&point| from.sample(point));
    let crossing = crossing.fold(f64::NEG_INFINITY, f64::max);
    if !crossing.is_finite() {
        return Err(BridgeError::NotReached);
    }
    let mut density = from.map(|&ln_u| ln_u - crossing);
    density.values_mut().iter_mut().zip(towards.values()).for_each(|(d, ln_u)| *d += ln_u);
    Ok(density)
}
