//! The caller's image and walls, and the media that they make.

use crate::buffer::hp_buffer;
use crate::pixels;
use crate::recipe::Recipe;
use crate::settings::Settings;
use crate::status::{Failure, HP_OUT_OF_MEMORY, HP_PANIC};
use crate::view::View;
use heatpath_core::Exec;
use heatpath_core::grid::filter::even_grey;
use heatpath_core::grid::medium::{self, Medium, MediumError};
use heatpath_core::grid::{Grid, Mask, Shape, TensorField, fraction};

/// What a computation needs at most, in bytes for each pixel and axis.
const BYTES_PER_AXIS: usize = 90;

/// The part of the medium in the progress of what is computed in it.
pub(crate) const MEDIUM_SHARE: f64 = 0.2;

/// An image with walls.
pub(crate) struct Scene<'a, const D: usize> {
    image: &'a View<D>,
    settings: &'a Settings,
    pub(crate) mask: Mask<D>,
}

impl<'a, const D: usize> Scene<'a, D> {
    /// Reads and checks the walls.
    ///
    /// # Safety
    /// `mask` is NULL, misaligned, or points to a description of readable pixels; those of the image
    /// and the tensors that the settings name can be read as long as the scene lives.
    pub(crate) unsafe fn read(
        image: &'a View<D>,
        mask: *const hp_buffer,
        settings: &'a Settings,
    ) -> Result<Self, Failure> {
        check_memory(image.shape)?;
        // SAFETY: the caller's promise.
        let mask = unsafe { read_mask(mask, image.shape)? };
        let mask = match settings.margin {
            0.0 => mask,
            margin => shrunk(&mask, margin)?,
        };
        Ok(Self { image, settings, mask })
    }

    /// The medium of a recipe, with the walls, for `sources` that may not be known yet.
    ///
    /// # Errors
    /// As the engine; or the recipe compares grey values, and there is nothing to compare with.
    ///
    /// The pixels can still be read, as the caller of [`read`](Self::read) has promised.
    pub(crate) fn medium(
        &self,
        recipe: &Recipe,
        sources: &[[f64; D]],
        exec: &Exec,
    ) -> Result<Medium<D>, Failure> {
        exec.report(0.0)?;
        let image = self.image;
        let medium = match recipe {
            Recipe::Uniform => Ok(medium::uniform(image.shape)),
            &Recipe::Given(form) => {
                // SAFETY: the promise of `read`.
                let field = unsafe { read_finite(image)? };
                medium::given(field, form).map_err(|error| Failure::from(error).of("image"))
            }
            &Recipe::GivenTensor { components, count } => {
                // SAFETY: the promise of `read`.
                let field = unsafe { read_tensors(components, count, image.shape)? };
                medium::given_tensor(field).map_err(|error| Failure::from(error).of("tensor"))
            }
            of_grey => self.medium_of_grey(of_grey, sources, exec),
        };
        Ok(medium?.with_walls(self.mask.clone())?)
    }

    fn medium_of_grey(
        &self,
        recipe: &Recipe,
        sources: &[[f64; D]],
        exec: &Exec,
    ) -> Result<Medium<D>, Failure> {
        let grey_end = if self.settings.normalize == 0.0 { 0.0 } else { 0.5 };
        let grey = self.grey(&exec.part(0.0, grey_end))?;
        let exec = exec.part(grey_end, 1.0);
        let medium = match recipe {
            &Recipe::Conductivity(options) => {
                medium::conductivity(&grey, &self.references(&grey, sources)?, options)
            }
            &Recipe::PeronaMalik(options) => medium::perona_malik(&grey, options),
            &Recipe::Combined(conductivity, perona_malik) => {
                let references = self.references(&grey, sources)?;
                medium::combined(&grey, &references, conductivity, perona_malik)
            }
            &Recipe::Edges(options) => medium::edges(&grey, options),
            &Recipe::Tensor(options) => medium::tensor(&grey, options, &exec),
            Recipe::Vesselness(options) => medium::vesselness(&grey, options, &exec),
            Recipe::Uniform | Recipe::Given(_) | Recipe::GivenTensor { .. } => {
                Ok(medium::uniform(self.image.shape))
            }
        };
        // The image was checked, so this is about a parameter.
        medium.map_err(|error| Failure::from(error).of("options"))
    }

    /// The image as grey values from 0 to 1, in even light if that is asked for.
    pub(crate) fn grey(&self, exec: &Exec) -> Result<Grid<f64, D>, Failure> {
        // SAFETY: the promise of `read`.
        let grey = unsafe { read_grey(self.image, self.settings.range)? };
        if self.settings.normalize == 0.0 {
            return Ok(grey);
        }
        let even = even_grey(&grey, self.settings.normalize, &self.mask, exec);
        even.map_err(|error| Failure::from(MediumError::from(error)).of("options: normalize"))
    }

    /// The grey values that the image is compared with.
    fn references(&self, grey: &Grid<f64, D>, sources: &[[f64; D]]) -> Result<Vec<f64>, Failure> {
        match self.settings.reference {
            Some(reference) => Ok(vec![reference]),
            None if sources.is_empty() => Err(Failure::argument(
                "options: reference is not set; this medium compares grey values with one, and \
                 without sources must be told which",
            )),
            None => Ok(sources.iter().map(|&source| grey.sample(source)).collect()),
        }
    }
}

/// The mask with walls thicker by `margin` cells.
fn shrunk<const D: usize>(mask: &Mask<D>, margin: f64) -> Result<Mask<D>, Failure> {
    let mask = mask.shrunk(margin * mask.shape().smallest_spacing());
    if mask.open().values().contains(&true) {
        return Ok(mask);
    }
    Err(Failure::argument(format!(
        "options: margin is {margin}, which leaves no pixel of the mask"
    )))
}

/// Whether there are so many bytes of memory. Nothing is touched: the operating system only says
/// whether they could be had.
pub(crate) fn has_memory(bytes: Option<usize>) -> bool {
    bytes.is_some_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}

/// Refuses images so large that the computation would run out of memory, which no library survives.
fn check_memory<const D: usize>(shape: Shape<D>) -> Result<(), Failure> {
    let bytes_per_pixel = BYTES_PER_AXIS * D;
    let bytes = shape.cells().checked_mul(bytes_per_pixel);
    if has_memory(bytes) {
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
