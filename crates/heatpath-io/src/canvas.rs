//! Curves and points drawn on a picture.

use crate::legend::enlarged;
use heatpath_core::grid::path::{Ending, Path as Curve};
use image::RgbImage;
use std::io;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};

pub(crate) const BLACK: [u8; 4] = [0, 0, 0, 255];
pub(crate) const WHITE: [u8; 4] = [255, 255, 255, 255];
pub(crate) const YELLOW: [u8; 4] = [255, 225, 0, 255];
pub(crate) const RED: [u8; 4] = [230, 20, 30, 255];
/// Under each curve, so that it shows on light ground.
pub(crate) const SHADOW: [u8; 4] = [0, 20, 40, 200];
/// Curves that reached a source.
pub(crate) const CYAN: [u8; 4] = [0, 210, 255, 255];
/// Curves that did not.
pub(crate) const ORANGE: [u8; 4] = [255, 150, 0, 255];

/// A picture to draw on; of points the first two coordinates count.
pub(crate) struct Canvas {
    pixels: Pixmap,
    /// From pixel coordinates of the grid to those of the canvas, whose pixel centres are at .5.
    transform: Transform,
    /// Canvas pixels a cell.
    scale: f32,
    /// The width of curves in canvas pixels.
    line: f32,
}

impl Canvas {
    /// A canvas on which each pixel of `ground` is a cell of `factor` x `factor` pixels.
    pub(crate) fn new(ground: &RgbImage, factor: usize) -> io::Result<Self> {
        let ground = enlarged(ground, factor as u32);
        let (width, height) = ground.dimensions();
        let mut pixels = Pixmap::new(width, height)
            .ok_or_else(|| io::Error::other("the picture is too large to draw on"))?;
        for (pixel, below) in pixels.pixels_mut().iter_mut().zip(ground.pixels()) {
            let [r, g, b] = below.0;
            *pixel = Color::from_rgba8(r, g, b, 255).premultiply().to_color_u8();
        }
        let scale = factor as f32;
        let line = (width.max(height) as f32 / 300.0).clamp(2.0, 6.0);
        let transform = Transform::from_row(scale, 0.0, 0.0, scale, 0.5 * scale, 0.5 * scale);
        Ok(Self { pixels, transform, scale, line })
    }

    /// The same with lines of another width, in pixels.
    pub(crate) fn with_line(self, line: f32) -> Self {
        Self { line, ..self }
    }

    /// All outlines first: where curves meet they run into one another.
    pub(crate) fn draw_paths<const D: usize>(&mut self, paths: &[Curve<D>]) {
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

    pub(crate) fn draw_dot<const D: usize>(&mut self, at: [f64; D], colour: [u8; 4]) {
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

    pub(crate) fn draw_source<const D: usize>(&mut self, source: [f64; D]) {
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
    pub(crate) fn into_picture(self) -> RgbImage {
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

pub(crate) fn reached_source<const D: usize>(path: &Curve<D>) -> bool {
    matches!(path.ending, Ending::Source(_))
}
