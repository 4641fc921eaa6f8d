//! Generated pictures like those of the paper's figures: 300 x 300, grey values from 0 to 1.

use heatpath_core::grid::{Grid, Shape};
use std::f64::consts::TAU;

const SIDE: usize = 300;

/// The source on the wide curve, as in figure 1.
pub(crate) const ON_THE_CURVE: [f64; 2] = [187.0, 36.0];

/// Half the width of the wide curve.
const HALF_WIDTH: f64 = 13.0;

fn draw(grey: impl Fn(f64, f64) -> f64) -> Grid<f64, 2> {
    let shape = Shape::new([SIDE, SIDE]).expect("a fixed size");
    Grid::from_fn(shape, |[x, y]| grey(x as f64, y as f64))
}

/// The x of the middle of the wide curve.
fn middle(y: f64) -> f64 {
    150.0 + 60.0 * (TAU * (y - 36.0) / 260.0 + 0.665).sin()
}

/// The distance from the middle of the wide curve, about.
fn off_the_curve(x: f64, y: f64) -> f64 {
    let slope = (middle(y + 0.5) - middle(y - 0.5)).abs();
    (x - middle(y)).abs() / slope.hypot(1.0)
}

pub(crate) fn is_on_the_curve(x: f64, y: f64) -> bool {
    off_the_curve(x, y) <= HALF_WIDTH
}

/// Whether a point lies in the regular polygon around `centre`.
fn in_polygon(x: f64, y: f64, centre: [f64; 2], radius: f64, sides: f64) -> bool {
    let (dx, dy) = (x - centre[0], y - centre[1]);
    let sector = TAU / sides;
    let angle = dy.atan2(dx).rem_euclid(sector) - 0.5 * sector;
    dx.hypot(dy) * angle.cos() <= radius * (0.5 * sector).cos()
}

/// The hexagon beside the wide curve.
pub(crate) fn in_hexagon(x: f64, y: f64) -> bool {
    in_polygon(x, y, [70.0, 85.0], 46.0, 6.0)
}

/// A wide black curve among polygons of several greys.
pub(crate) fn wide_curve() -> Grid<f64, 2> {
    draw(|x, y| {
        if is_on_the_curve(x, y) {
            0.1
        } else if in_hexagon(x, y) {
            0.45
        } else if in_polygon(x, y, [235.0, 205.0], 44.0, 4.0) {
            0.35
        } else if in_polygon(x, y, [60.0, 230.0], 42.0, 3.0) {
            0.6
        } else {
            0.75
        }
    })
}

/// The y of the thin line.
pub(crate) fn thin_line_at(x: f64) -> f64 {
    150.0 + 40.0 * (TAU * x / 300.0).sin()
}

/// A line of one or two pixels, a little darker than its ground, whose left half is a shade darker
/// than its right half.
pub(crate) fn thin_line() -> Grid<f64, 2> {
    draw(|x, y| {
        let ground = if x < 150.0 { 0.5 } else { 0.6 };
        if (y - thin_line_at(x)).abs() < 1.0 { ground - 0.3 } else { ground }
    })
}
