//! A colour-mapped field with a colour bar, for eyes.
//!
//! ```text
//! title
//! +---------------+  # max
//! |               |  #
//! |     field     |  # middle
//! |               |  #
//! +---------------+  # min
//! ```

use crate::colour::{colour_map, enlargement, finite_range, viridis};
use crate::text;
use heatpath_core::grid::Grid;
use image::{Rgb, RgbImage, imageops};

/// The height of the title's strip.
const TITLE: usize = text::LINE + 8;
/// Between the field and the bar, and around labels.
const GAP: usize = 12;
/// The width of the bar.
const BAR: usize = 18;
/// The length of a tick.
const TICK: usize = 5;
const TICKS: usize = 5;
/// What the labels need so that they do not touch.
const LOWEST: usize = 6 * text::LINE;

const PAPER: Rgb<u8> = Rgb([255; 3]);
const INK: [u8; 3] = [32; 3];

/// The field in its upper left corner (below the title, if there is one), enlarged by a whole
/// number if it is small, and a colour bar to its right.
pub(crate) fn with_legend(field: &Grid<f64, 2>, title: Option<&str>) -> RgbImage {
    let map = enlarged(&colour_map(field), enlargement(field.shape().size()) as u32);
    with_bar(&map, finite_range(field), title)
}

/// A picture with a bar of the colours of this range to its right, if there is one.
pub(crate) fn with_bar(map: &RgbImage, range: Option<(f64, f64)>, title: Option<&str>) -> RgbImage {
    let labels = labels(range);
    let top = if title.is_some() { TITLE } else { 0 };
    let (width, height) = (map.width() as usize, (map.height() as usize).max(LOWEST));
    let widest = labels.iter().map(|label| text::width(label)).max().unwrap_or(0);
    let right = width + GAP + BAR + TICK + GAP / 2 + widest + GAP;
    let mut canvas = RgbImage::from_pixel(right as u32, (top + height) as u32, PAPER);
    imageops::replace(&mut canvas, map, 0, top as i64);
    if let Some(title) = title {
        text::draw(&mut canvas, [4, 4], title, INK);
    }
    draw_bar(&mut canvas, [width + GAP, top], height, &labels);
    canvas
}

/// Each pixel as a square of `factor` x `factor` pixels.
pub(crate) fn enlarged(picture: &RgbImage, factor: u32) -> RgbImage {
    if factor == 1 {
        return picture.clone();
    }
    RgbImage::from_fn(picture.width() * factor, picture.height() * factor, |x, y| {
        *picture.get_pixel(x / factor, y / factor)
    })
}

/// The numbers at the ticks, the smallest first: one if all values are equal, none if none is
/// finite.
fn labels(range: Option<(f64, f64)>) -> Vec<String> {
    match range {
        None => Vec::new(),
        Some((low, high)) if low == high => vec![text::short(low)],
        Some((low, high)) => (0..TICKS)
            .map(|i| i as f64 / (TICKS - 1) as f64)
            .map(|part| text::short(low * (1.0 - part) + high * part))
            .collect(),
    }
}

/// A bar of the given height (labels included) with its upper left corner at `at`.
fn draw_bar(canvas: &mut RgbImage, at: [usize; 2], height: usize, labels: &[String]) {
    if labels.is_empty() {
        return;
    }
    let (top, bottom) = (at[1] + text::LINE / 2, at[1] + height - text::LINE / 2 - 1);
    let part =
        |y: usize| if labels.len() > 1 { (bottom - y) as f64 / (bottom - top) as f64 } else { 0.0 };
    for y in top..=bottom {
        for x in at[0]..at[0] + BAR {
            canvas.put_pixel(x as u32, y as u32, Rgb(viridis(part(y))));
        }
    }
    for (i, label) in labels.iter().enumerate() {
        let y = bottom - i * (bottom - top) / (labels.len() - 1).max(1);
        for x in at[0] + BAR..at[0] + BAR + TICK {
            canvas.put_pixel(x as u32, y as u32, Rgb(INK));
        }
        let left = at[0] + BAR + TICK + GAP / 2;
        text::draw(canvas, [left, y - text::LINE / 2], label, INK);
    }
}
