//! The heat method (Crane, Weischedel and Wardetzky 2013).

mod direction;
mod margin;
mod near;
mod poisson;

use super::DistanceMap;
use crate::exec::{Cancelled, Exec};
use crate::grid::heat::{Implicit, ImplicitError, ImplicitOptions};
use crate::grid::medium::{Medium, MediumError};
use crate::grid::source::shares;
use crate::grid::{Grid, PointError, Sources, check_points};
use crate::linear::Pin;
use near::Near;
use poisson::Poisson;
use std::borrow::Cow;
use thiserror::Error;

/// A value for each face: by axis, and by the cell behind it.
type Faces<const D: usize> = [Vec<f64>; D];

/// The parameters of [`HeatMethod`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatMethodOptions {
    /// How long heat flows, in multiples of the smallest spacing squared over the mean of `k D`: at
    /// 1 heat decays by e over one cell of mean speed. Above 0; default
    /// [`DEFAULT_TIME`](Self::DEFAULT_TIME), 1.
    ///
    /// Shorter times tell narrow structures, walls and sources apart; longer ones suit media that
    /// change little from cell to cell. Largest and mean error in cells at the times 0.5, 1, 2, 4:
    /// where the speed grows from 0.1 to 0.9 over 200 cells 21/3.1, 17/2.2, 12/1.4, 8.3/0.84 (of
    /// distances up to 530); around a lane of five cells that is three times as fast as the rest
    /// 10/3, 37/13, 68/23, 99/33 (of up to 300), ten times 28/11, 17/8, 41/11, 85/24 (of up to 640).
    pub time: f64,
    /// The most memory that each of the two factorisations may take, in bytes; default 4 GiB.
    pub memory_limit: usize,
}

impl HeatMethodOptions {
    /// The default time: in a uniform medium any serves, and this is a compromise between the others.
    pub const DEFAULT_TIME: f64 = 1.0;
}

impl Default for HeatMethodOptions {
    fn default() -> Self {
        Self { time: Self::DEFAULT_TIME, memory_limit: 4 << 30 }
    }
}

/// Why the heat method cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HeatMethodError {
    /// The medium is anisotropic.
    #[error(
        "the heat method takes media that are alike in all directions, not tensors; explicit and \
         implicit heat and the eikonal equation take both"
    )]
    Tensor,
    /// One of the two systems cannot be solved.
    #[error(transparent)]
    Implicit(#[from] ImplicitError),
    /// The squared speed `k D` is out of range somewhere.
    #[error(transparent)]
    Medium(#[from] MediumError),
    /// A source is not in this medium.
    #[error(transparent)]
    Point(#[from] PointError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Distances by the heat method in one medium, borrowed or owned, prepared once for any sources.
///
/// Heat flows from the sources for a short time, by one implicit step; only its direction is kept.
/// The distances are those whose gradient is nearest to a vector of length `1 / sqrt(k D)` in that
/// direction (Crane, Weischedel and Wardetzky, Geodesics in Heat, 2013). Both steps are linear
/// systems, factored once, and a solution of each makes a map.
///
/// # What it is good for
/// Many maps in one medium that does not jump from cell to cell, above all of long distances. Errors
/// (largest / mean) in 101 x 101 cells, in cells: uniform 0.004 / 0.0024, with the source off the
/// centres near a border 0.07 / 0.007, in a corner 0.26 / 0.023; half-plane of Poincaré 0.39 / 0.10,
/// and 0.06 / 0.02 after time 8. Where fronts of several sources meet distances are a cell off, and
/// the error spreads: three sources 1.3 / 0.17. Behind the end of a wall distances are 3 % off. Where
/// the speed jumps, as in many pictures, expect several per cent, as of all heat. On finer grids
/// errors fall only if the time grows.
///
/// A picture of 512 x 512 cells takes 0.9 s to prepare and 0.2 s for each source on one thread of a
/// 2-core machine, where implicit heat takes 0.5 s and 0.07 s. The two factors take twice the memory.
///
/// # How
/// - Heat has the medium `k D laplace(u)`, which has the same metric and no drift, on a grid with a
///   margin, so that the border does not reflect. Without it errors in a uniform medium are up to
///   0.8 cells, 0.07 in the mean.
/// - Its direction is that of the differences of u, not of `ln u`: that of rays on a grid.
/// - Differences across faces are means of both cells, which is right to second order and where
///   fronts meet. Around the sources, where they are least exact, they are corrected by those of
///   circles; without the innermost of these the mean error is 0.4 cells instead of 0.0024.
/// - The Poisson equation minimises the square of the relative error of the differences: the metric's
///   norm, by the picture's area instead of the metric's. With the latter, which in the plane means
///   no weights, errors are twice as large where the speed grows from 0.1 to 0.9, and 1.6 to 6 times
///   around a fast lane.
/// - The cell of each source is pinned to its own distance from it, so that several sources do not
///   fold the distances. One source in each component needs one solution; several need some more, by
///   conjugate gradients among the pins.
///
/// Finding the direction again from the distances, and solving again, was tried: in smooth media each
/// time takes 20 to 30 % off the error, in media that jump it adds more than that.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::distance::{HeatMethod, HeatMethodOptions};
/// use heatpath_core::grid::{Shape, Sources, medium};
///
/// let medium = medium::uniform(Shape::new([64, 48])?);
/// let exec = Exec::single_threaded();
/// let method = HeatMethod::new(&medium, HeatMethodOptions::default(), &exec)?;
/// let sources = Sources::new(&[[20.0, 20.0]], medium.mask())?;
/// let distances = method.distance(&sources, &exec)?;
/// assert!((distances.at([60.0, 20.0]) - 40.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct HeatMethod<'a, const D: usize> {
    medium: Cow<'a, Medium<D>>,
    /// Heat on a grid with a margin.
    implicit: Implicit<'static, D>,
    poisson: Poisson<D>,
    slowness: Grid<f64, D>,
}

impl<'a, const D: usize> HeatMethod<'a, D> {
    /// Prepares distances in `medium`: analyses and factors two systems.
    ///
    /// # Errors
    /// A time out of range, a squared speed `k D` out of the range of
    /// [`given`](crate::grid::medium::given) media, more memory than allowed; or the caller cancelled.
    pub fn new(
        medium: impl Into<Cow<'a, Medium<D>>>,
        options: HeatMethodOptions,
        exec: &Exec,
    ) -> Result<Self, HeatMethodError> {
        let (medium, memory_limit) = (medium.into(), options.memory_limit);
        if medium.diffusion().tensor().is_some() {
            return Err(HeatMethodError::Tensor);
        }
        let cells = 0..medium.shape().cells();
        let slowness = cells.map(|cell| 1.0 / medium.speed_sq(cell).sqrt()).collect();
        let slowness = Grid::from_parts(*medium.shape(), slowness);
        let poisson = Poisson::new(&medium, &slowness, memory_limit, exec)?;
        let wide = margin::with_margin(&medium, margin_width::<D>(options.time))?;
        let time = options.time / mean_speed_sq(&medium);
        let heat = ImplicitOptions { time, memory_limit, ..ImplicitOptions::default() };
        Ok(Self { implicit: Implicit::new(wide, heat, exec)?, poisson, slowness, medium })
    }

    /// The medium.
    #[must_use]
    pub fn medium(&self) -> &Medium<D> {
        &self.medium
    }

    /// The memory that the two factorisations take, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.implicit.bytes() + self.poisson.bytes()
    }

    /// The distances from the nearest of `sources`.
    ///
    /// # Errors
    /// A source is not in this medium, or the caller cancelled.
    pub fn distance(
        &self,
        sources: &Sources<D>,
        exec: &Exec,
    ) -> Result<DistanceMap<D>, HeatMethodError> {
        self.distances(std::slice::from_ref(sources), exec).map(|mut maps| maps.remove(0))
    }

    /// The distances from each of several sets of sources by itself, which the threads of `exec`
    /// share.
    ///
    /// # Errors
    /// A source is not in this medium, or the caller cancelled.
    pub fn distances(
        &self,
        sets: &[Sources<D>],
        exec: &Exec,
    ) -> Result<Vec<DistanceMap<D>>, HeatMethodError> {
        let mut maps = Vec::with_capacity(sets.len());
        for round in sets.chunks(8 * exec.threads()) {
            let part = |maps: usize| maps as f64 / sets.len() as f64;
            let exec = exec.part(part(maps.len()), part(maps.len() + round.len()));
            maps.extend(self.round(round, &exec)?);
        }
        exec.report(1.0)?;
        Ok(maps)
    }

    fn round(
        &self,
        sets: &[Sources<D>],
        exec: &Exec,
    ) -> Result<Vec<DistanceMap<D>>, HeatMethodError> {
        let (medium, wide) = (self.medium(), self.implicit.medium());
        let moved = |sources: &Sources<D>| {
            check_points("source", sources.points(), medium.mask())?;
            margin::moved(sources, medium, wide)
        };
        let moved: Vec<Sources<D>> = sets.iter().map(moved).collect::<Result<_, _>>()?;
        // === Heat for a short time
        let heats = self.implicit.flow_many(&moved, &exec.part(0.0, 0.5))?;
        // === The divergence of its direction
        let mut sides: Vec<_> = sets.iter().zip(heats).map(|pair| (pair, Vec::new())).collect();
        exec.for_each(&mut sides, |((sources, heat), side)| {
            let ln_u = margin::without_margin(heat.ln_temperature(), medium, wide);
            let directions = direction::directions(medium.mask(), &ln_u);
            let near = Near::new(medium.mask(), sources);
            let faces = self.poisson.faces();
            let differences = direction::differences(faces, &self.slowness, &directions, &near);
            *side = self.poisson.side(&differences, |axis| medium.shape().stride(axis));
        });
        // === The distances with that divergence
        let sides: Vec<_> = sides.into_iter().map(|(_, side)| side).collect();
        let pins = sets.iter().map(|sources| self.pins(sources)).collect();
        let fields = self.poisson.solve(&sides, pins, exec).into_iter();
        let map = |field: Vec<f64>| {
            let values = field.into_iter().map(|distance| distance.max(0.0)).collect();
            DistanceMap { field: Grid::from_parts(*medium.shape(), values) }
        };
        Ok(fields.map(map).collect())
    }

    /// The cell of each source with its distance from there.
    fn pins(&self, sources: &Sources<D>) -> Vec<Pin> {
        let shape = self.medium.shape();
        let pin = |&point: &[f64; D]| {
            let cell = shape.position(shape.cell_at(point));
            let slowness: f64 = shares(self.medium.mask(), point)
                .into_iter()
                .map(|(cell, weight)| weight * self.slowness.values()[cell])
                .sum();
            self.poisson.pin(cell, slowness * shape.physical_distance(point, shape.centre(cell)))
        };
        let mut pins: Vec<Pin> = sources.points().iter().map(pin).collect();
        pins.sort_by(|a, b| a.parts[0].0.cmp(&b.parts[0].0).then(a.value.total_cmp(&b.value)));
        pins.dedup_by_key(|pin| pin.parts[0].0);
        pins
    }
}

/// How many cells around the grid heat needs: six lengths over which it decays by e, half as many in
/// space, where cells are many.
fn margin_width<const D: usize>(time: f64) -> usize {
    let lengths = if D < 3 { 6.0 } else { 3.0 };
    (lengths * time.sqrt()).ceil().clamp(0.0, 32.0) as usize
}

/// The mean of `k D` over the open cells; 1 if there are none.
fn mean_speed_sq<const D: usize>(medium: &Medium<D>) -> f64 {
    let open = (0..medium.shape().cells()).filter(|&cell| medium.mask().is_open(cell));
    let (sum, count) =
        open.fold((0.0, 0.0), |(sum, count), cell| (sum + medium.speed_sq(cell), count + 1.0));
    if count > 0.0 { sum / count } else { 1.0 }
}
