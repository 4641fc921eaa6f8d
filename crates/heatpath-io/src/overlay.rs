//! Results drawn on the picture from which they come.

use crate::WriteError;
use crate::colour::{NOT_FINITE, colour_of, enlargement, finite_range};
use crate::field::{as_picture, check_picture_size, write_png};
use crate::output::{known_format, write_atomically};
use heatpath_core::grid::Grid;
use heatpath_core::grid::keypoints::KeyPoint;
use heatpath_core::grid::path::{Ending, Path as Curve};
use image::RgbImage;
use std::io;
use std::path::Path;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Stroke,
    StrokeDash, Transform,
};

/// How much of a field's colour covers the picture.
const COVER: f64 = 0.5;

pub(crate) const BLACK: [u8; 4] = [0, 0, 0, 255];
pub(crate) const WHITE: [u8; 4] = [255, 255, 255, 255];
const YELLOW: [u8; 4] = [255, 225, 0, 255];
pub(crate) const RED: [u8; 4] = [230, 20, 30, 255];
/// Under each curve, so that it shows on light ground.
pub(crate) const SHADOW: [u8; 4] = [0, 20, 40, 200];
/// Curves that reached a source.
pub(crate) const CYAN: [u8; 4] = [0, 210, 255, 255];
/// Curves that did not.
pub(crate) const ORANGE: [u8; 4] = [255, 150, 0, 255];

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
/// # Errors
/// The ending is not `.png`, the picture is a volume, the sizes differ, the picture is too large,
/// the folder is missing, the file exists and `overwrite` is not set, or the operating system
/// refuses.
pub fn write_overlay<const D: usize>(
    path: impl AsRef<Path>,
    overwrite: bool,
    picture: &Grid<f64, D>,
    layers: &Overlay<'_, D>,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    known_format(path, None, &["png"])?;
    let Some(picture) = as_picture(picture) else {
        return Err(WriteError::Volume { path: path.to_owned() });
    };
    let field = layers.field.and_then(as_picture);
    let size = picture.shape().size();
    if let Some(field) = field.map(|field| field.shape().size())
        && field != size
    {
        return Err(WriteError::Mismatch { path: path.to_owned(), picture: size, field });
    }
    write_atomically(path, overwrite, |out| {
        write_png(out, &drawn(Canvas::new(picture, field)?, layers))
    })
}

fn drawn<const D: usize>(mut canvas: Canvas, layers: &Overlay<'_, D>) -> RgbImage {
    canvas.draw_paths(layers.paths);
    if !layers.are_pieces {
        let ends = layers.paths.iter().filter_map(|path| path.points.first());
        ends.for_each(|&end| canvas.draw_dot(end, WHITE));
    }
    layers.key_points.iter().for_each(|key_point| canvas.draw_dot(key_point.point, YELLOW));
    for source in sources(layers) {
        canvas.draw_source(source);
    }
    canvas.into_picture()
}

/// The sources, each once.
fn sources<const D: usize>(layers: &Overlay<'_, D>) -> Vec<[f64; D]> {
    let reached = layers.paths.iter().filter(|path| !layers.are_pieces && reached_source(path));
    let mut all: Vec<[f64; D]> = layers.sources.to_vec();
    for &source in reached.filter_map(|path| path.points.last()) {
        if !all.contains(&source) {
            all.push(source);
        }
    }
    all
}

fn reached_source<const D: usize>(path: &Curve<D>) -> bool {
    matches!(path.ending, Ending::Source(_))
}

/// A picture to draw on; of points the first two coordinates count.
struct Canvas {
    pixels: Pixmap,
    /// From pixel coordinates of the grid to those of the canvas, whose pixel centres are at .5.
    transform: Transform,
    /// Canvas pixels a cell.
    scale: f32,
    /// The width of curves in canvas pixels.
    line: f32,
}

impl Canvas {
    fn new(picture: &Grid<f64, 2>, field: Option<&Grid<f64, 2>>) -> io::Result<Self> {
        let size = picture.shape().size();
        check_picture_size(size)?;
        let factor = enlargement(size);
        let [width, height] = size.map(|n| (n * factor) as u32);
        let mut pixels = Pixmap::new(width, height)
            .ok_or_else(|| io::Error::other("the picture is too large to draw on"))?;
        let ground = ground(picture, field);
        for (i, pixel) in pixels.pixels_mut().iter_mut().enumerate() {
            let (x, y) = (i % width as usize / factor, i / width as usize / factor);
            *pixel = ground[y * size[0] + x];
        }
        let scale = factor as f32;
        let line = (width.max(height) as f32 / 300.0).clamp(2.0, 6.0);
        let transform = Transform::from_row(scale, 0.0, 0.0, scale, 0.5 * scale, 0.5 * scale);
        Ok(Self { pixels, transform, scale, line })
    }

    /// All outlines first: where curves meet they run into one another.
    fn draw_paths<const D: usize>(&mut self, paths: &[Curve<D>]) {
        for (widening, outline) in [(1.6, true), (0.0, false)] {
            for path in paths.iter().filter(|path| path.points.len() > 1) {
                let colour = match reached_source(path) {
                    _ if outline => SHADOW,
                    true => CYAN,
                    false => ORANGE,
                };
                self.draw_path(path, colour, self.line + widening);
            }
        }
    }

    fn draw_path<const D: usize>(&mut self, path: &Curve<D>, colour: [u8; 4], width: f32) {
        let mut builder = PathBuilder::new();
        for (i, point) in path.points.iter().enumerate() {
            let (x, y) = (point[0] as f32, point[1] as f32);
            match i {
                0 => builder.move_to(x, y),
                _ => builder.line_to(x, y),
            }
        }
        let mut stroke = self.stroke(width);
        if !reached_source(path) {
            let unit = self.line / self.scale;
            stroke.line_cap = LineCap::Butt;
            stroke.dash = StrokeDash::new(vec![4.0 * unit, 3.0 * unit], 0.0);
        }
        self.draw_stroke(builder, colour, &stroke);
    }

    fn draw_dot<const D: usize>(&mut self, at: [f64; D], colour: [u8; 4]) {
        let (x, y) = (at[0] as f32, at[1] as f32);
        let radius = (1.3 * self.line).max(3.0);
        for (radius, colour) in [(radius + 1.2, BLACK), (radius, colour)] {
            let circle = PathBuilder::from_circle(x, y, radius / self.scale);
            if let Some(circle) = circle {
                let paint = paint(colour);
                self.pixels.fill_path(&circle, &paint, FillRule::Winding, self.transform, None);
            }
        }
    }

    fn draw_source<const D: usize>(&mut self, source: [f64; D]) {
        let (x, y) = (source[0] as f32, source[1] as f32);
        let arm = (2.2 * self.line).max(4.5) / self.scale;
        for (width, colour) in [(self.line + 3.0, WHITE), (self.line + 0.6, RED)] {
            let mut builder = PathBuilder::new();
            for sign in [-1.0, 1.0] {
                builder.move_to(x - arm, y - sign * arm);
                builder.line_to(x + arm, y + sign * arm);
            }
            self.draw_stroke(builder, colour, &self.stroke(width));
        }
    }

    /// A stroke whose width is given in canvas pixels.
    fn stroke(&self, width: f32) -> Stroke {
        Stroke {
            width: width / self.scale,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        }
    }

    fn draw_stroke(&mut self, builder: PathBuilder, colour: [u8; 4], stroke: &Stroke) {
        if let Some(path) = builder.finish() {
            self.pixels.stroke_path(&path, &paint(colour), stroke, self.transform, None);
        }
    }

    /// The canvas is opaque: alpha can go.
    fn into_picture(self) -> RgbImage {
        let (width, pixels) = (self.pixels.width() as usize, self.pixels.pixels());
        RgbImage::from_fn(self.pixels.width(), self.pixels.height(), |x, y| {
            let pixel = pixels[y as usize * width + x as usize];
            image::Rgb([pixel.red(), pixel.green(), pixel.blue()])
        })
    }
}

fn paint(colour: [u8; 4]) -> Paint<'static> {
    let [r, g, b, a] = colour;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(Color::from_rgba8(r, g, b, a));
    paint
}

/// The grey picture with the field's colours over it, one pixel a cell.
fn ground(picture: &Grid<f64, 2>, field: Option<&Grid<f64, 2>>) -> Vec<PremultipliedColorU8> {
    let (low, high) = field.and_then(finite_range).unwrap_or((0.0, 0.0));
    let colour = |i: usize| {
        let below = grey(picture.values()[i]);
        match field.and_then(|field| colour_of(field.values()[i], low, high)) {
            Some(above) => std::array::from_fn(|c| mixed(below[c], above[c])),
            None => below,
        }
    };
    (0..picture.values().len())
        .map(colour)
        .map(|[r, g, b]: [u8; 3]| Color::from_rgba8(r, g, b, 255).premultiply().to_color_u8())
        .collect()
}

fn grey(value: f64) -> [u8; 3] {
    if value.is_nan() { NOT_FINITE } else { [(value.clamp(0.0, 1.0) * 255.0).round() as u8; 3] }
}

fn mixed(below: u8, above: u8) -> u8 {
    (f64::from(below) * (1.0 - COVER) + f64::from(above) * COVER).round() as u8
}
