//! The exact weighted distance: the eikonal equation, by fast marching.

mod axes;
mod closed;
mod factor;
mod growing;
mod lattice;
mod march;
mod pair;
mod queue;
mod seed;
mod stencil;
mod update;
mod value;

pub(crate) use self::growing::Arrival;

use self::axes::Axes;
use self::lattice::Lattice;
use self::march::Front;
use self::seed::Seed;
use self::stencil::Stencil;
use super::{DistanceMap, NOT_REACHED};
use crate::exec::{Cancelled, Exec};
use crate::grid::medium::Medium;
use crate::grid::source::shares;
use crate::grid::{Grid, PointError, Sources, check_points};
use std::borrow::Cow;
use std::iter;
use thiserror::Error;

/// Which differences the march takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Over one cell.
    First,
    /// Over two cells, where the second is known and nearer still.
    #[default]
    Second,
}

/// The parameters of [`Eikonal::distance`].
#[derive(Clone, Debug, PartialEq)]
pub struct EikonalOptions<const D: usize> {
    /// First or second order; default second.
    pub order: Order,
    /// The distance at each source, in physical units, finite and not negative; empty (the default)
    /// is 0 at all of them.
    ///
    /// A source that lies farther from another than its own distance is passed over.
    pub initial: Vec<f64>,
    /// The march ends at this distance, in physical units; all cells beyond are not reached. Positive;
    /// default infinity.
    pub farthest: f64,
    /// If there are any points here (pixel coordinates), the march ends as soon as the distances at
    /// all of them are known, and those of the cells around them. Default empty.
    pub targets: Vec<[f64; D]>,
}

impl<const D: usize> Default for EikonalOptions<D> {
    fn default() -> Self {
        Self {
            order: Order::default(),
            initial: Vec::new(),
            farthest: f64::INFINITY,
            targets: Vec::new(),
        }
    }
}

/// Why there is no distance.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EikonalError {
    /// The grid is too large for the numbers of its cells.
    #[error("the grid has {cells} cells; fast marching takes up to {most}")]
    TooLarge {
        /// The number of cells, in isotropic media with those of a rim around them.
        cells: usize,
        /// The largest number.
        most: usize,
    },
    /// There is not one initial distance for each source.
    #[error("{given} initial distances were given for {expected} sources")]
    InitialCount {
        /// The number of initial distances.
        given: usize,
        /// The number of sources.
        expected: usize,
    },
    /// An initial distance makes no sense.
    #[error(
        "the initial distance of source {number} is {value}; it must be finite and not negative"
    )]
    Initial {
        /// The source, counted from 0.
        number: usize,
        /// The rejected value.
        value: f64,
    },
    /// The march cannot end at this distance.
    #[error("farthest is {0}; it must be a positive distance")]
    Farthest(f64),
    /// A target lies outside the grid or in a wall.
    #[error(transparent)]
    Target(#[from] PointError),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The exact weighted distance in one medium: the viscosity solution of the eikonal equation
/// `grad T' k D grad T = 1`, prepared for any sources.
///
/// Heat measures the same metric, `ds / sqrt(k D)`, but in media that vary from cell to cell its
/// readouts differ from the distance by several per cent. This is the number itself, to second order,
/// by fast marching (Sethian 1996): the reference that heat is compared with, and the solver for those
/// who want the distance rather than the heat.
///
/// - *Factored.* At a source the distance has a kink that spoils the order of every scheme.
///   Here `T = r tau`, where r is the distance in the metric of the source, whose derivatives are exact;
///   differences are taken of the smooth tau (Treister & Haber 2016). In a constant isotropic medium
///   the result is exact to rounding. Sources may lie anywhere between cell centres: in the cells beside the source,
///   towards which no neighbour lies, the derivative of r alone counts.
/// - *Walls* are cells that take no part; of an anisotropic medium an offset that meets a wall on its
///   way takes no part either. Nothing leaks, and a way around a corner that two walls share does not
///   exist.
/// - *Anisotropic media* use the offsets of their tensors' decompositions ([`Medium`] says what is
///   the metric and what its inverse). Along an offset that leads into a wall or off the grid, the
///   derivative is that of the gradient which the other offsets imply.
///
/// Memory beside the medium: 24 bytes a cell, or of an anisotropic picture 90 and volume 190, and 4
/// more with several sources.
///
/// ```
/// use heatpath_core::Exec;
/// use heatpath_core::grid::distance::{Eikonal, EikonalOptions};
/// use heatpath_core::grid::{Shape, Sources, medium};
///
/// let medium = medium::uniform(Shape::new([64, 48])?);
/// let exec = Exec::single_threaded();
/// let eikonal = Eikonal::new(&medium, &exec)?;
/// let sources = Sources::new(&[[12.25, 20.0]], medium.mask())?;
/// let distances = eikonal.distance(&sources, &EikonalOptions::default(), &exec)?;
/// assert!((distances.field()[[42, 20]] - 29.75).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Eikonal<'a, const D: usize> {
    medium: Cow<'a, Medium<D>>,
    stencil: AnyStencil<D>,
    /// Of a slot of the queue.
    width: f64,
}

#[derive(Debug)]
enum AnyStencil<const D: usize> {
    Axes(Axes<D>),
    /// Three terms, of the tensor of a picture.
    Plane(Lattice<D, 3>),
    /// Six terms, of the tensor of a volume.
    Space(Lattice<D, 6>),
}

/// Places are numbered in 32 bits, those of the wall around the cells too.
const MOST_CELLS: usize = u32::MAX as usize;

/// So are the dependents of tensors, of which a cell of a volume may have eighteen.
const MOST_TENSORS: usize = MOST_CELLS / 18;

/// The number of slots for the time that the front takes through a typical cell: some dozens of cells
/// are in each then.
const SLOTS_PER_CELL: f64 = 64.0;

/// The number of cells that are asked for what is typical.
const SAMPLES: usize = 1000;

impl<'a, const D: usize> Eikonal<'a, D> {
    /// Prepares a medium, borrowed or owned.
    ///
    /// # Errors
    /// The grid, with a rim of up to 11 cells, has more than 4 billion cells, or 230 million with tensors.
    pub fn new(medium: impl Into<Cow<'a, Medium<D>>>, exec: &Exec) -> Result<Self, EikonalError> {
        let medium = medium.into();
        let is_tensor = medium.diffusion().tensor().is_some();
        let (cells, most) = if is_tensor {
            (medium.shape().cells(), MOST_TENSORS)
        } else {
            (Axes::places_around(medium.shape()), MOST_CELLS)
        };
        if cells > most {
            return Err(EikonalError::TooLarge { cells, most });
        }
        let stencil = match D {
            _ if !is_tensor => AnyStencil::Axes(Axes::new(&medium)),
            2 => AnyStencil::Plane(Lattice::new(&medium, exec)),
            _ => AnyStencil::Space(Lattice::new(&medium, exec)),
        };
        let width = typical_slowness(&medium) / SLOTS_PER_CELL;
        Ok(Self { medium, stencil, width })
    }

    /// The medium.
    #[must_use]
    pub fn medium(&self) -> &Medium<D> {
        &self.medium
    }

    /// The distance of each cell from the nearest source.
    ///
    /// # Errors
    /// The initial distances, targets or end are not right, or the caller cancelled.
    pub fn distance(
        &self,
        sources: &Sources<D>,
        options: &EikonalOptions<D>,
        exec: &Exec,
    ) -> Result<DistanceMap<D>, EikonalError> {
        Ok(self.march(sources, options, exec)?.0)
    }

    /// The distance of each cell from the nearest source, and the number of that source, counted from
    /// 0; `None` where none is reached.
    ///
    /// # Errors
    /// Those of [`distance`](Self::distance).
    pub fn distance_and_nearest(
        &self,
        sources: &Sources<D>,
        options: &EikonalOptions<D>,
        exec: &Exec,
    ) -> Result<(DistanceMap<D>, Grid<Option<usize>, D>), EikonalError> {
        let (distances, numbers) = self.march(sources, options, exec)?;
        let mut numbers = numbers.into_iter();
        let nearest = distances.field.map(|&distance| {
            let number = numbers.next().unwrap_or(0);
            (distance < NOT_REACHED).then_some(number as usize)
        });
        Ok((distances, nearest))
    }

    /// The distances, and for several sources the numbers of the nearest.
    fn march(
        &self,
        sources: &Sources<D>,
        options: &EikonalOptions<D>,
        exec: &Exec,
    ) -> Result<(DistanceMap<D>, Vec<u32>), EikonalError> {
        check_initial(sources, &options.initial)?;
        if options.farthest.is_nan() || options.farthest <= 0.0 {
            return Err(EikonalError::Farthest(options.farthest));
        }
        if !options.targets.is_empty() {
            check_points("target", &options.targets, self.medium.mask())?;
        }
        match &self.stencil {
            AnyStencil::Axes(axes) => self.march_on(axes, sources, options, exec),
            AnyStencil::Plane(lattice) => self.march_on(lattice, sources, options, exec),
            AnyStencil::Space(lattice) => self.march_on(lattice, sources, options, exec),
        }
        .map_err(EikonalError::from)
    }

    fn march_on<const N: usize>(
        &self,
        stencil: &impl Stencil<D, N>,
        sources: &Sources<D>,
        options: &EikonalOptions<D>,
        exec: &Exec,
    ) -> Result<(DistanceMap<D>, Vec<u32>), Cancelled> {
        let shape = self.medium.shape();
        let unit = shape.smallest_spacing();
        let initial = options.initial.iter().copied().chain(iter::repeat(0.0));
        let seeds: Vec<Seed<D>> = (sources.points().iter().zip(initial))
            .map(|(&point, initial)| Seed::new(&self.medium, stencil, point, initial / unit))
            .collect();
        let targets = self.cells_around(&options.targets);
        let targets = targets.map(|cell| stencil.place(shape.index(cell))).collect();
        let mut front = Front::new(stencil, &seeds, options.order, self.width);
        front.march(options.farthest / unit, targets, exec)?;
        let along_row = &stencil.along_row(shape.size()[0]);
        let places = || {
            shape.rows().flat_map(|row| {
                let first = stencil.place(row);
                along_row.iter().map(move |added| first + added)
            })
        };
        let distances = places().map(|place| unit * front.distance(place)).collect();
        let nearest =
            if seeds.len() > 1 { places().map(|p| front.nearest(p)).collect() } else { vec![] };
        Ok((DistanceMap { field: Grid::from_parts(*shape, distances) }, nearest))
    }

    /// The open cells that share each of the points, and their neighbours.
    fn cells_around(&self, points: &[[f64; D]]) -> impl Iterator<Item = usize> {
        let (shape, mask) = (self.medium.shape(), self.medium.mask());
        let cells = points.iter().flat_map(|&point| shares(mask, point));
        cells
            .flat_map(|(cell, _)| iter::once(cell).chain(shape.neighbours(cell)))
            .filter(|&cell| mask.is_open(cell))
    }
}

fn check_initial<const D: usize>(
    sources: &Sources<D>,
    initial: &[f64],
) -> Result<(), EikonalError> {
    let (given, expected) = (initial.len(), sources.points().len());
    if given != 0 && given != expected {
        return Err(EikonalError::InitialCount { given, expected });
    }
    match initial.iter().position(|value| !(value.is_finite() && *value >= 0.0)) {
        Some(number) => Err(EikonalError::Initial { number, value: initial[number] }),
        None => Ok(()),
    }
}

/// The median of one over the speed, over some cells.
fn typical_slowness<const D: usize>(medium: &Medium<D>) -> f64 {
    let cells = medium.shape().cells();
    let mut samples: Vec<f64> = (0..cells)
        .step_by(cells.div_ceil(SAMPLES))
        .map(|cell| 1.0 / medium.speed_sq(cell).sqrt())
        .collect();
    samples.sort_by(f64::total_cmp);
    samples[samples.len() / 2]
}
