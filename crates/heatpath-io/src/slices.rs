//! Volumes for eyes: three slices at right angles, and beside them what shines through from behind.
//!
//! ```text
//! z = 12        x = 30      max over z    max over x
//! +--------+    +----+      +--------+    +----+
//! |  x,y   |    |z,y |      |        |    |    |
//! +--------+    +----+      +--------+    +----+
//! y = 7                     max over y
//! +--------+                +--------+
//! |  x,z   |                |        |
//! +--------+                +--------+
//! ```

use crate::canvas::{Canvas, WHITE, YELLOW};
use crate::colour::finite_range_of;
use crate::legend::with_bar;
use crate::overlay::{Overlay, sources, tinted};
use crate::text;
use heatpath_core::grid::path::Path as Curve;
use heatpath_core::grid::{Grid, Shape};
use image::{Rgb, RgbImage, imageops};
use std::io;

/// The longest side of a panel has at least and at most so many pixels.
const SIDES: [f64; 2] = [256.0, 1024.0];
/// Around panels; the letter of an axis fits in.
const GAP: usize = 14;
/// What is nearer to a slice than this, in cells, is drawn on it.
const NEAR: f64 = 1.5;
/// The width of curves, in pixels.
const LINE: f32 = 2.5;

const PAPER: Rgb<u8> = Rgb([255; 3]);
const INK: [u8; 3] = [32; 3];
const AXES: [&str; 3] = ["x", "y", "z"];

/// Axes of a panel.
#[derive(Clone, Copy, Debug)]
struct View {
    right: usize,
    down: usize,
    through: usize,
}

const FRONT: View = View { right: 0, down: 1, through: 2 };
const SIDE: View = View { right: 2, down: 1, through: 0 };
const TOP: View = View { right: 0, down: 2, through: 1 };

/// What a panel shows of the third axis.
#[derive(Clone, Copy, Debug)]
enum Depth {
    Slice(usize),
    Largest,
}

/// A volume and how large its cells are drawn.
struct Scene<'a, const D: usize> {
    volume: &'a Grid<f64, 3>,
    field: Option<&'a Grid<f64, 3>>,
    range: Option<(f64, f64)>,
    layers: &'a Overlay<'a, D>,
    sources: Vec<[f64; D]>,
    /// Pixels of each axis.
    pixels: [usize; 3],
    /// Pixels of a physical unit.
    unit: f64,
}

/// The picture of a volume with `layers` on it, whose field has the same size.
pub(crate) fn slices<const D: usize>(
    volume: &Grid<f64, 3>,
    layers: &Overlay<'_, D>,
) -> io::Result<RgbImage> {
    let scene = Scene::new(volume, layers);
    let at = scene.middle();
    let slices = scene.block(|view| Depth::Slice(at[view.through]))?;
    let projections = scene.block(|_| Depth::Largest)?;
    let both = beside(&slices, &projections);
    Ok(match scene.range {
        Some(range) => with_bar(&both, Some(range), None),
        None => both,
    })
}

impl<'a, const D: usize> Scene<'a, D> {
    fn new(volume: &'a Grid<f64, 3>, layers: &'a Overlay<'a, D>) -> Self {
        let field = layers.field.and_then(|field| (field as &dyn std::any::Any).downcast_ref());
        let unit = unit(volume.shape());
        let sides = physical_sides(volume.shape());
        Self {
            volume,
            field,
            range: field.and_then(|field: &Grid<f64, 3>| finite_range_of(field.values())),
            layers,
            sources: sources(layers),
            pixels: sides.map(|side| ((side * unit).round() as usize).max(1)),
            unit,
        }
    }

    /// The cell through which the slices go.
    fn middle(&self) -> [usize; 3] {
        let size = self.volume.shape().size();
        let longest = |one: &&Curve<D>, other: &&Curve<D>| {
            one.physical_length.total_cmp(&other.physical_length)
        };
        let curve = self.layers.paths.iter().filter(|path| !path.points.is_empty()).max_by(longest);
        let point = curve.map(|curve| curve.points[curve.points.len() / 2]);
        let point = point.or_else(|| self.sources.first().copied());
        std::array::from_fn(|axis| match point {
            Some(point) => (point[axis].round().max(0.0) as usize).min(size[axis] - 1),
            None => size[axis] / 2,
        })
    }

    /// The three views: from the front, from the side to its right, from above below it.
    fn block(&self, depth: impl Fn(View) -> Depth) -> io::Result<RgbImage> {
        let panel = |view: View| self.panel(view, depth(view));
        let [front, side, top] = [panel(FRONT)?, panel(SIDE)?, panel(TOP)?];
        let width = front.width() + side.width();
        let mut block = RgbImage::from_pixel(width, front.height() + top.height(), PAPER);
        imageops::replace(&mut block, &front, 0, 0);
        imageops::replace(&mut block, &side, i64::from(front.width()), 0);
        imageops::replace(&mut block, &top, 0, i64::from(front.height()));
        Ok(block)
    }

    /// A view with its title, the letters of its axes, and a scale.
    fn panel(&self, view: View, depth: Depth) -> io::Result<RgbImage> {
        let view_name = AXES[view.through];
        let title = match depth {
            Depth::Slice(slice) => format!("{view_name} = {slice}"),
            Depth::Largest => format!("max over {view_name}"),
        };
        let drawn = self.drawn(view, depth)?;
        let [width, height] = [drawn.width() as usize, drawn.height() as usize];
        let (left, top) = (GAP + 2, text::LINE + 4);
        let full = [left + width.max(text::width(&title)) + GAP, top + height + text::LINE + GAP];
        let mut panel = RgbImage::from_pixel(full[0] as u32, full[1] as u32, PAPER);
        text::draw(&mut panel, [left, 2], &title, INK);
        imageops::replace(&mut panel, &drawn, left as i64, top as i64);
        // The letters stand where their axes lead to.
        let letter = text::width("x");
        let end =
            [(left + width).saturating_sub(letter), (top + height).saturating_sub(text::LINE)];
        text::draw(&mut panel, [end[0], top + height + 1], AXES[view.right], INK);
        text::draw(&mut panel, [left - letter - 4, end[1]], AXES[view.down], INK);
        if view.through == FRONT.through {
            self.draw_scale(&mut panel, [left, top + height + text::LINE / 2], width);
        }
        Ok(panel)
    }

    /// A line of a round length and that length in physical units, at most half of the width in all.
    fn draw_scale(&self, panel: &mut RgbImage, at: [usize; 2], width: usize) {
        let length = round_length(0.25 * width as f64 / self.unit);
        let pixels = ((length * self.unit).round() as usize).max(1);
        for (x, y) in (0..pixels * 3).map(|i| (i % pixels, i / pixels)) {
            if let Some(pixel) = panel.get_pixel_mut_checked((at[0] + x) as u32, (at[1] + y) as u32)
            {
                *pixel = Rgb(INK);
            }
        }
        text::draw(panel, [at[0] + pixels + 5, at[1] - text::LINE / 2], &text::short(length), INK);
    }

    fn drawn(&self, view: View, depth: Depth) -> io::Result<RgbImage> {
        let mut canvas = Canvas::new(&self.ground(view, depth), 1)?.with_line(LINE);
        let paths: Vec<Curve<2>> =
            self.layers.paths.iter().flat_map(|path| self.pieces(path, view, depth)).collect();
        canvas.draw_paths(&paths);
        let place =
            |point: &[f64; D]| is_shown(point, view, depth).then(|| self.place(point, view));
        if !self.layers.are_pieces {
            let ends = self.layers.paths.iter().filter_map(|path| path.points.first());
            ends.filter_map(place).for_each(|end| canvas.draw_dot(end, WHITE));
        }
        let key_points = self.layers.key_points.iter().map(|key_point| &key_point.point);
        key_points.filter_map(place).for_each(|point| canvas.draw_dot(point, YELLOW));
        self.sources.iter().filter_map(place).for_each(|source| canvas.draw_source(source));
        Ok(canvas.into_picture())
    }

    /// Grey values, and on slices the field's colours.
    fn ground(&self, view: View, depth: Depth) -> RgbImage {
        let (size, pixels) = (self.volume.shape().size(), self.pixels);
        let values = plane(self.volume, view, depth);
        let field = self.field.filter(|_| matches!(depth, Depth::Slice(_)));
        let above = field.map(|field| plane(field, view, depth));
        let cell = |pixel: u32, axis: usize| pixel as usize * size[axis] / pixels[axis];
        RgbImage::from_fn(pixels[view.right] as u32, pixels[view.down] as u32, |x, y| {
            let at = cell(y, view.down) * size[view.right] + cell(x, view.right);
            let above = above.as_ref().map(|above| above[at]);
            Rgb(tinted(values[at], above, self.range.unwrap_or((0.0, 0.0))))
        })
    }

    /// What of a curve is seen, in pixels: all of it in projections, what is near in slices.
    fn pieces(&self, path: &Curve<D>, view: View, depth: Depth) -> Vec<Curve<2>> {
        let near = path
            .points
            .chunk_by(|one, other| is_shown(one, view, depth) && is_shown(other, view, depth));
        near.filter(|points| points.len() > 1)
            .map(|points| Curve {
                points: points.iter().map(|point| self.place(point, view)).collect(),
                ending: path.ending,
                length: path.length,
                physical_length: path.physical_length,
                distance: path.distance,
                cost: path.cost,
            })
            .collect()
    }

    /// The pixel of a point.
    fn place(&self, point: &[f64; D], view: View) -> [f64; 2] {
        [view.right, view.down].map(|axis| {
            let cell = self.pixels[axis] as f64 / self.volume.shape().size()[axis] as f64;
            (point[axis] + 0.5) * cell - 0.5
        })
    }
}

fn is_shown<const D: usize>(point: &[f64; D], view: View, depth: Depth) -> bool {
    match depth {
        Depth::Slice(slice) => (point[view.through] - slice as f64).abs() <= NEAR,
        Depth::Largest => true,
    }
}

/// The values of a slice, or the largest ones along the axis through it, row by row.
fn plane(volume: &Grid<f64, 3>, view: View, depth: Depth) -> Vec<f64> {
    let size = volume.shape().size();
    let mut plane = vec![f64::NAN; size[view.right] * size[view.down]];
    let depths = match depth {
        Depth::Slice(slice) => slice..slice + 1,
        Depth::Largest => 0..size[view.through],
    };
    let mut at = [0; 3];
    for through in depths {
        at[view.through] = through;
        for (i, cell) in plane.iter_mut().enumerate() {
            (at[view.right], at[view.down]) = (i % size[view.right], i / size[view.right]);
            *cell = cell.max(volume[at]);
        }
    }
    plane
}

fn physical_sides(shape: &Shape<3>) -> [f64; 3] {
    std::array::from_fn(|axis| shape.size()[axis] as f64 * shape.spacing()[axis])
}

/// Pixels of a physical unit: one for the smallest side of a cell, more or less in small and large
/// volumes.
fn unit(shape: &Shape<3>) -> f64 {
    let longest = physical_sides(shape).into_iter().fold(0.0, f64::max);
    let cell = 1.0 / shape.smallest_spacing();
    let [least, most] = SIDES;
    let enlarged = cell * (least / (longest * cell)).ceil().max(1.0);
    enlarged.min(most / longest)
}

/// 1, 2 or 5 times a power of ten, at most `length`.
fn round_length(length: f64) -> f64 {
    let power = 10_f64.powf(length.log10().floor());
    let digit = [5.0, 2.0].into_iter().find(|digit| digit * power <= length);
    digit.unwrap_or(1.0) * power
}

fn beside(left: &RgbImage, right: &RgbImage) -> RgbImage {
    let height = left.height().max(right.height());
    let mut both = RgbImage::from_pixel(left.width() + right.width(), height, PAPER);
    imageops::replace(&mut both, left, 0, 0);
    imageops::replace(&mut both, right, i64::from(left.width()), 0);
    both
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_have_round_lengths() {
        for (length, round) in [(1.0, 1.0), (4.9, 2.0), (5.0, 5.0), (99.0, 50.0), (0.03, 0.02)] {
            assert!((round_length(length) / round - 1.0).abs() < 1e-12, "{length}");
        }
    }

    #[test]
    fn small_volumes_are_enlarged_and_large_ones_reduced() {
        let shape = |size, spacing| Shape::with_spacing(size, spacing).expect("a shape");
        assert_eq!(unit(&shape([64, 10, 10], [0.5; 3])), 8.0);
        assert_eq!(unit(&shape([300, 10, 10], [1.0, 1.0, 2.0])), 1.0);
        assert_eq!(unit(&shape([2048, 10, 10], [1.0; 3])), 0.5);
    }
}
