//! What computations have in common: the caller's image, walls, sources and options.

use crate::buffer::hp_buffer;
use crate::options::hp_options;
use crate::pixels;
use crate::prepared::{Prepared, Solved};
use crate::progress::Progress;
use crate::settings::{Recipe, Settings};
use crate::status::{Failure, HP_OUT_OF_MEMORY, HP_PANIC};
use crate::view::View;
use heatpath_core::grid::medium::{self, Medium, MediumError};
use heatpath_core::grid::path::Descent;
use heatpath_core::grid::{Grid, Mask, Shape, Sources, TensorField, fraction};

/// What a computation needs at most, in bytes for each pixel and axis.
const BYTES_PER_AXIS: usize = 90;

/// The arguments that all computations begin with.
pub(crate) struct Arguments {
    pub(crate) image: *const hp_buffer,
    pub(crate) mask: *const hp_buffer,
    pub(crate) sources: *const f64,
    pub(crate) source_count: u64,
    pub(crate) options: *const hp_options,
}

/// A medium and the sources in it.
pub(crate) struct Problem<const D: usize> {
    medium: Medium<D>,
    sources: Sources<D>,
    settings: Settings,
}

impl<const D: usize> Problem<D> {
    /// Reads and checks everything.
    ///
    /// # Safety
    /// The pointers are NULL, misaligned, or point to what the header asks for.
    pub(crate) unsafe fn read(arguments: &Arguments) -> Result<Self, Failure> {
        // SAFETY: the caller's promise, for each of the pointers.
        unsafe {
            let settings = Settings::read(arguments.options)?;
            let image = View::read(arguments.image, "image")?;
            let points = read_points(arguments.sources, arguments.source_count, "sources")?;
            check_memory(image.shape)?;
            let mask = read_mask(arguments.mask, image.shape)?;
            let sources = Sources::new(&points, &mask)?;
            let medium = make_medium(&image, Some(&sources), &settings)?.with_walls(mask)?;
            Ok(Self { medium, sources, settings })
        }
    }

    pub(crate) fn mask(&self) -> &Mask<D> {
        self.medium.mask()
    }

    pub(crate) fn progress(&self) -> &Progress {
        &self.settings.progress
    }

    /// The distances: all of them or, if there are `ends`, at least those that paths from there need.
    /// `share` is their part of all the work, for the progress.
    pub(crate) fn solve(&self, ends: &[[f64; D]], share: f64) -> Result<Solved<D>, Failure> {
        let Self { medium, sources, settings } = self;
        let progress = &settings.progress;
        let exec = settings.exec(|finished| progress.report(share * finished))?;
        Prepared::new(medium, settings.method, &exec)?.solve(sources, ends, settings.readout, &exec)
    }

    /// What paths descend.
    pub(crate) fn descent(&self, solved: &Solved<D>) -> Result<Descent<'_, D>, Failure> {
        match &solved.heat {
            Some(heat) => Ok(Descent::new(heat, &self.medium)?),
            None => Ok(Descent::of_distances(&solved.distances, &self.sources, &self.medium)),
        }
    }
}

/// Reads a medium for sources that are not known yet.
///
/// # Safety
/// As [`Problem::read`].
pub(crate) unsafe fn read_medium<const D: usize>(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    settings: &Settings,
) -> Result<Medium<D>, Failure> {
    // SAFETY: the caller's promise, for each of the pointers.
    unsafe {
        let image = View::read(image, "image")?;
        check_memory(image.shape)?;
        let mask = read_mask(mask, image.shape)?;
        Ok(make_medium(&image, None, settings)?.with_walls(mask)?)
    }
}

/// Copies `count` points of the caller.
///
/// # Safety
/// `points` is NULL or points to `D` times `count` readable doubles; they need not be aligned.
pub(crate) unsafe fn read_points<const D: usize>(
    points: *const f64,
    count: u64,
    name: &str,
) -> Result<Vec<[f64; D]>, Failure> {
    if count == 0 {
        return Ok(Vec::new());
    }
    if points.is_null() {
        return Err(Failure::argument(format!("{name} is NULL but there are {count} of them")));
    }
    let largest = isize::MAX as usize / size_of::<[f64; D]>();
    let Some(count) = usize::try_from(count).ok().filter(|&count| count <= largest) else {
        return Err(Failure::argument(format!(
            "{name}: {count} points are more than memory holds"
        )));
    };
    let mut copy = Vec::new();
    copy.try_reserve_exact(count).map_err(|_| {
        Failure::new(HP_OUT_OF_MEMORY, format!("{name}: there is no memory for {count} points"))
    })?;
    let points = points.cast::<[f64; D]>();
    // SAFETY: the caller promises `count` points; loads that need no alignment.
    copy.extend((0..count).map(|i| unsafe { points.add(i).read_unaligned() }));
    Ok(copy)
}

/// Refuses images so large that the computation would run out of memory, which no library
/// survives. Nothing is touched: the operating system only says whether it could be had.
fn check_memory<const D: usize>(shape: Shape<D>) -> Result<(), Failure> {
    let bytes_per_pixel = BYTES_PER_AXIS * D;
    let bytes = shape.cells().checked_mul(bytes_per_pixel);
    let enough = bytes.is_some_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    if enough {
        return Ok(());
    }
    let size = shape.size().map(|n| n.to_string()).join(" x ");
    Err(Failure::new(
        HP_OUT_OF_MEMORY,
        format!(
            "image: {size} pixels need up to {bytes_per_pixel} bytes each, more memory than there is"
        ),
    ))
}

/// # Safety
/// `mask` is NULL, misaligned, or points to a description of readable pixels.
unsafe fn read_mask<const D: usize>(
    mask: *const hp_buffer,
    shape: Shape<D>,
) -> Result<Mask<D>, Failure> {
    if mask.is_null() {
        return Ok(Mask::all_open(shape));
    }
    // SAFETY: the caller's promise.
    let view = unsafe { View::read(mask, "mask")? };
    let (mask, image) = (view.shape.size(), shape.size());
    if mask != image {
        return Err(MediumError::MaskSize { mask: mask.to_vec(), image: image.to_vec() }.into());
    }
    // SAFETY: the caller's promise.
    let values = unsafe { pixels::read(&view)? };
    if let Some(position) = values.values().iter().position(|value| value.is_nan()) {
        return Err(view.bad_pixel(position, f64::NAN));
    }
    Ok(Mask::new(values.map(|&value| value != 0.0)))
}

/// # Safety
/// The view's pixels and the options' tensors can be read.
unsafe fn make_medium<const D: usize>(
    image: &View<D>,
    sources: Option<&Sources<D>>,
    settings: &Settings,
) -> Result<Medium<D>, Failure> {
    // SAFETY: the caller's promise.
    let grey = || unsafe { read_grey(image, settings.range) };
    let medium = match settings.recipe {
        Recipe::Uniform => Ok(medium::uniform(image.shape)),
        Recipe::Given(form) => {
            // SAFETY: the caller's promise.
            let field = unsafe { read_finite(image)? };
            return medium::given(field, form).map_err(|error| Failure::from(error).of("image"));
        }
        Recipe::GivenTensor { components, count } => {
            // SAFETY: the caller's promise.
            let field = unsafe { read_tensors(components, count, image.shape)? };
            return medium::given_tensor(field).map_err(|error| Failure::from(error).of("tensor"));
        }
        Recipe::Conductivity(options) => {
            let grey = grey()?;
            medium::conductivity(&grey, &references(&grey, sources, settings)?, options)
        }
        Recipe::PeronaMalik(options) => medium::perona_malik(&grey()?, options),
        Recipe::Combined(conductivity, perona_malik) => {
            let grey = grey()?;
            let references = references(&grey, sources, settings)?;
            medium::combined(&grey, &references, conductivity, perona_malik)
        }
        Recipe::Edges(options) => medium::edges(&grey()?, options),
    };
    // The image was checked, so this is about a parameter.
    medium.map_err(|error| Failure::from(error).of("options"))
}

/// Copies the caller's tensors.
///
/// # Safety
/// `components` is NULL or points to `count` readable doubles; they need not be aligned.
unsafe fn read_tensors<const D: usize>(
    components: *const f64,
    count: u64,
    shape: Shape<D>,
) -> Result<TensorField<D>, Failure> {
    if components.is_null() {
        let message = "options: tensor is NULL, but the medium is HP_MEDIUM_GIVEN_TENSOR";
        return Err(Failure::argument(message));
    }
    let expected = shape.cells() * TensorField::<D>::COMPONENTS;
    if count != expected as u64 {
        return Err(Failure::argument(format!(
            "options: tensor_count is {count}; it must be {} for each of {} pixels, {expected}",
            TensorField::<D>::COMPONENTS,
            shape.cells()
        )));
    }
    // SAFETY: the caller promises `count` doubles; loads that need no alignment.
    let copy = (0..expected).map(|i| unsafe { components.add(i).read_unaligned() }).collect();
    TensorField::from_components(shape, copy)
        .map_err(|error| Failure::new(HP_PANIC, error.to_string()))
}

/// The grey values that the image is compared with.
fn references<const D: usize>(
    grey: &Grid<f64, D>,
    sources: Option<&Sources<D>>,
    settings: &Settings,
) -> Result<Vec<f64>, Failure> {
    match (settings.reference, sources) {
        (Some(reference), _) => Ok(vec![reference]),
        (None, Some(sources)) => Ok(sources.values(grey)),
        (None, None) => Err(Failure::argument(
            "options: reference is not set; this medium compares grey values with one, and a \
             solver for any sources must be told which",
        )),
    }
}

/// # Safety
/// The view's pixels can be read.
unsafe fn read_finite<const D: usize>(image: &View<D>) -> Result<Grid<f64, D>, Failure> {
    // SAFETY: the caller's promise.
    let grid = unsafe { pixels::read(image)? };
    grid.check_finite().map_err(|error| Failure::from(error).of("image"))?;
    Ok(grid)
}

/// The image as grey values from 0 to 1.
///
/// # Safety
/// The view's pixels can be read.
unsafe fn read_grey<const D: usize>(
    image: &View<D>,
    range: [Option<f64>; 2],
) -> Result<Grid<f64, D>, Failure> {
    // SAFETY: the caller's promise.
    let mut grid = unsafe { read_finite(image)? };
    let (values, white) = (grid.values_mut(), image.sample.white());
    let smallest = || values.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = || values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = range[0].unwrap_or_else(|| white.map_or_else(smallest, |_| 0.0));
    let high = range[1].unwrap_or_else(|| white.unwrap_or_else(largest));
    let usable = low.is_finite() && high.is_finite() && low < high;
    // An image of one value only has no natural range, and is 0 everywhere.
    if !usable && range != [None, None] {
        return Err(Failure::argument(format!(
            "options: the range from {low} to {high} is empty; range_low must be a finite number \
             below range_high"
        )));
    }
    values.iter_mut().for_each(|value| *value = fraction(*value, low, high));
    Ok(grid)
}
