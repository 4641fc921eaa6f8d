//! Panels of the figures that find structures by themselves.

use super::scenes::Scene;
use super::{beside, panel};
use heatpath_core::grid::Grid;
use heatpath_io::colour::viridis;
use image::{Rgb, RgbImage};

pub(crate) const BLUE: [u8; 3] = [0, 90, 255];
pub(crate) const RED: [u8; 3] = [230, 20, 30];
pub(crate) const WHITE: [u8; 3] = [255; 3];

/// A square dot, cut off at the border.
pub(crate) fn dot(panel: &mut RgbImage, pixel: [f64; 2], side: i64, colour: [u8; 3]) {
    let [left, top] = pixel.map(|part| part.round() as i64 - side / 2);
    for (x, y) in (0..side * side).map(|i| (left + i % side, top + i / side)) {
        if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
            && let Some(pixel) = panel.get_pixel_mut_checked(x, y)
        {
            *pixel = Rgb(colour);
        }
    }
}

/// The pixel of a panel in which a point lies.
pub(crate) fn pixel(point: [f64; 2]) -> [f64; 2] {
    point.map(|part| (0.5 * part).floor())
}

/// A colour for a part from 0 to 1, in twelve bands.
pub(crate) fn band(part: f64) -> [u8; 3] {
    viridis((12.0 * part).floor().min(11.0) / 11.0)
}

/// The grey values in sixteen steps, so that noise takes less space, with a red dot at the source.
pub(crate) fn grey_panel(image: &Grid<f64, 2>, source: [f64; 2]) -> RgbImage {
    panel(image, |grey| [(15.0 * grey).round() as u8 * 17; 3], &[source])
}

/// Distances in the cells that are `shown`, white elsewhere.
pub(crate) fn distance_panel(distances: &Grid<f64, 2>, shown: &Grid<bool, 2>) -> RgbImage {
    let shown = Grid::from_fn(*distances.shape(), |cell| {
        if shown[cell] { distances[cell] } else { f64::INFINITY }
    });
    let finite = shown.values().iter().copied().filter(|distance| distance.is_finite());
    let farthest = finite.fold(0.0, f64::max);
    panel(&shown, |d| if d.is_finite() { band(1.0 - d / farthest) } else { WHITE }, &[])
}

/// The tubes in grey.
pub(crate) fn ground(scene: &Scene) -> RgbImage {
    panel(&scene.outside, |outside| if outside <= 0.5 { [200; 3] } else { WHITE }, &[])
}

/// Points of paths in blue.
pub(crate) fn draw_paths<'a>(drawn: &mut RgbImage, paths: impl Iterator<Item = &'a [[f64; 2]]>) {
    paths.flatten().for_each(|&point| dot(drawn, pixel(point), 1, BLUE));
}

/// Panels below each other with a white gap.
pub(crate) fn below(rows: &[RgbImage]) -> RgbImage {
    let turned: Vec<_> = rows.iter().map(image::imageops::rotate270).collect();
    image::imageops::rotate90(&beside(&turned))
}
