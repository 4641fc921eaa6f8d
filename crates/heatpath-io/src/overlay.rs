//! Results drawn on the picture from which they come, or on slices of the volume.

use crate::WriteError;
use crate::canvas::{Canvas, WHITE, YELLOW, reached_source};
use crate::colour::{NOT_FINITE, colour_of, enlargement, finite_range};
use crate::field::{as_picture, check_picture_size, write_png};
use crate::output::{known_format, write_atomically};
use crate::slices::slices;
use heatpath_core::grid::Grid;
use heatpath_core::grid::keypoints::KeyPoint;
use heatpath_core::grid::path::Path as Curve;
use image::{Rgb, RgbImage};
use std::any::Any;
use std::io;
use std::path::Path;

/// How much of a field's colour covers the picture.
const COVER: f64 = 0.5;

/// What is drawn on a picture.
#[derive(Clone, Copy, Debug, Default)]
pub struct Overlay<'a, const D: usize> {
    /// A field, for example of distances, in half-transparent colours; its size must be the
    /// picture's. Cells that are not finite stay as they are.
    pub field: Option<&'a Grid<f64, D>>,
    /// Curves: cyan if they ended at a source, else dashed and orange. Their end points are white
    /// dots, the sources at which they ended red crosses.
    pub paths: &'a [Curve<D>],
    /// Whether curves are pieces of a whole: without a dot and a cross at their ends.
    pub are_pieces: bool,
    /// Key points, drawn as yellow dots.
    pub key_points: &'a [KeyPoint<D>],
    /// Further sources, drawn as red crosses too.
    pub sources: &'a [[f64; D]],
}

/// Writes `picture` (values from 0, black, to 1, white) with `layers` drawn on it, as PNG.
///
/// Each cell is one pixel; if the longest side is below 256, each is a square of several pixels.
///
/// Of a volume there are three slices at right angles, through the middle of the longest curve (else
/// the first source, else the middle of the volume), and beside them the largest values along each axis,
/// all in the proportions of its spacing. The field and the pieces of curves within a cell and a half are
/// drawn on the slices, whole curves on the projections.
///
/// # Errors
/// The ending is not `.png`, the sizes differ, the picture is too large, the folder is missing, the
/// file exists and `overwrite` is not set, or the operating system refuses.
pub fn write_overlay<const D: usize>(
    path: impl AsRef<Path>,
    overwrite: bool,
    picture: &Grid<f64, D>,
    layers: &Overlay<'_, D>,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    known_format(path, None, &["png"])?;
    let size = picture.shape().size().to_vec();
    if let Some(field) = layers.field.map(|field| field.shape().size().to_vec())
        && field != size
    {
        return Err(WriteError::Mismatch { path: path.to_owned(), picture: size, field });
    }
    if let Some(volume) = (picture as &dyn Any).downcast_ref() {
        return write_atomically(path, overwrite, |out| write_png(out, &slices(volume, layers)?));
    }
    let Some(picture) = as_picture(picture) else {
        return Err(WriteError::Volume { path: path.to_owned() });
    };
    write_atomically(path, overwrite, |out| write_png(out, &drawn(picture, layers)?))
}

fn drawn<const D: usize>(picture: &Grid<f64, 2>, layers: &Overlay<'_, D>) -> io::Result<RgbImage> {
    let size = picture.shape().size();
    check_picture_size(size)?;
    let field = layers.field.and_then(as_picture);
    let mut canvas = Canvas::new(&ground(picture, field), enlargement(size))?;
    canvas.draw_paths(layers.paths);
    if !layers.are_pieces {
        let ends = layers.paths.iter().filter_map(|path| path.points.first());
        ends.for_each(|&end| canvas.draw_dot(end, WHITE));
    }
    layers.key_points.iter().for_each(|key_point| canvas.draw_dot(key_point.point, YELLOW));
    for source in sources(layers) {
        canvas.draw_source(source);
    }
    Ok(canvas.into_picture())
}

/// The sources, each once.
pub(crate) fn sources<const D: usize>(layers: &Overlay<'_, D>) -> Vec<[f64; D]> {
    let reached = layers.paths.iter().filter(|path| !layers.are_pieces && reached_source(path));
    let mut all: Vec<[f64; D]> = layers.sources.to_vec();
    for &source in reached.filter_map(|path| path.points.last()) {
        if !all.contains(&source) {
            all.push(source);
        }
    }
    all
}

/// The grey picture with the field's colours over it, one pixel a cell.
fn ground(picture: &Grid<f64, 2>, field: Option<&Grid<f64, 2>>) -> RgbImage {
    let range = field.and_then(finite_range).unwrap_or((0.0, 0.0));
    let [width, height] = picture.shape().size();
    RgbImage::from_fn(width as u32, height as u32, |x, y| {
        let cell = [x as usize, y as usize];
        Rgb(tinted(picture[cell], field.map(|field| field[cell]), range))
    })
}

/// A grey value (0 to 1), half covered by the colour of a value from a range if that is finite.
pub(crate) fn tinted(value: f64, above: Option<f64>, (low, high): (f64, f64)) -> [u8; 3] {
    let below = grey(value);
    match above.and_then(|above| colour_of(above, low, high)) {
        Some(above) => std::array::from_fn(|c| mixed(below[c], above[c])),
        None => below,
    }
}

fn grey(value: f64) -> [u8; 3] {
    if value.is_nan() { NOT_FINITE } else { [(value.clamp(0.0, 1.0) * 255.0).round() as u8; 3] }
}

fn mixed(below: u8, above: u8) -> u8 {
    (f64::from(below) * (1.0 - COVER) + f64::from(above) * COVER).round() as u8
}
