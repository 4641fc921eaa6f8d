//! Numbers as colours.

use colorgrad::Gradient;
use heatpath_core::grid::{Grid, fraction};
use image::{Rgb, RgbImage};
use std::sync::LazyLock;

/// The colour of cells that are infinite or not a number: walls and what was not reached.
pub const NOT_FINITE: [u8; 3] = [64, 64, 64];

/// Pictures whose longest side is below this are enlarged, so that small fields can be seen.
const SMALL: usize = 256;

/// The steps of the colour table: finer than 8-bit colours can show.
const STEPS: usize = 1024;

static VIRIDIS: LazyLock<Vec<[u8; 3]>> = LazyLock::new(|| {
    let gradient = colorgrad::preset::viridis();
    let colour = |i| gradient.at(i as f32 / (STEPS - 1) as f32).to_rgba8();
    (0..STEPS)
        .map(|i| {
            let [r, g, b, _] = colour(i);
            [r, g, b]
        })
        .collect()
});

/// The colour that stands for `part`, from 0 (dark blue) to 1 (yellow): the map "viridis", whose
/// lightness grows evenly and which colour-blind readers can read.
#[must_use]
pub fn viridis(part: f64) -> [u8; 3] {
    // The cast sends what is not a number to 0.
    VIRIDIS[(part.clamp(0.0, 1.0) * (STEPS - 1) as f64).round() as usize]
}

/// A field in colours, one pixel a cell: [`viridis`] from the smallest to the largest finite value,
/// [`NOT_FINITE`] for all others.
///
/// # Panics
/// A side has more than 2^32 - 1 cells.
#[must_use]
pub fn colour_map(field: &Grid<f64, 2>) -> RgbImage {
    let (low, high) = finite_range(field).unwrap_or((0.0, 0.0));
    let [width, height] = field.shape().size().map(|n| u32::try_from(n).expect("side below 2^32"));
    let mut picture = RgbImage::new(width, height);
    for (pixel, &value) in picture.pixels_mut().zip(field.values()) {
        *pixel = Rgb(colour_of(value, low, high).unwrap_or(NOT_FINITE));
    }
    picture
}

/// The colour of one value; none if it is not finite.
pub(crate) fn colour_of(value: f64, low: f64, high: f64) -> Option<[u8; 3]> {
    value.is_finite().then(|| viridis(fraction(value, low, high)))
}

/// The smallest and the largest finite value, if any value is finite.
pub(crate) fn finite_range(field: &Grid<f64, 2>) -> Option<(f64, f64)> {
    finite_range_of(field.values())
}

/// [`finite_range`] of a list.
pub(crate) fn finite_range_of(values: &[f64]) -> Option<(f64, f64)> {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    finite.fold(None, |range, value| match range {
        None => Some((value, value)),
        Some((low, high)) => Some((value.min(low), value.max(high))),
    })
}

/// By which whole number a picture of this size is enlarged.
pub(crate) fn enlargement(size: [usize; 2]) -> usize {
    let longest = size[0].max(size[1]).max(1);
    if longest < SMALL { SMALL.div_ceil(longest) } else { 1 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heatpath_core::grid::Shape;

    #[test]
    fn the_map_runs_from_dark_blue_to_yellow() {
        assert_eq!(viridis(0.0), [68, 1, 84]);
        assert_eq!(viridis(1.0), [254, 232, 37]);
        assert_eq!(viridis(f64::NAN), viridis(0.0));
        let green = viridis(0.5);
        assert!(green[1] > green[0] && green[1] > 120);
    }

    #[test]
    fn a_field_is_stretched_between_its_finite_extremes() {
        let values = vec![2.0, 3.0, 4.0, f64::INFINITY, f64::NAN, f64::NEG_INFINITY];
        let field = Grid::from_values(Shape::new([3, 2]).unwrap(), values).unwrap();
        let picture = colour_map(&field);
        assert_eq!(picture.get_pixel(0, 0).0, viridis(0.0));
        assert_eq!(picture.get_pixel(1, 0).0, viridis(0.5));
        assert_eq!(picture.get_pixel(2, 0).0, viridis(1.0));
        for x in 0..3 {
            assert_eq!(picture.get_pixel(x, 1).0, NOT_FINITE);
        }
    }

    #[test]
    fn fields_without_a_range_have_one_colour() {
        let constant = Grid::from_fn(Shape::new([2, 2]).unwrap(), |_| 7.0);
        assert!(colour_map(&constant).pixels().all(|pixel| pixel.0 == viridis(0.0)));
        let unreached = constant.map(|_| f64::INFINITY);
        assert!(colour_map(&unreached).pixels().all(|pixel| pixel.0 == NOT_FINITE));
    }

    #[test]
    fn small_pictures_are_enlarged() {
        assert_eq!(enlargement([1, 1]), 256);
        assert_eq!(enlargement([100, 30]), 3);
        assert_eq!(enlargement([255, 255]), 2);
        assert_eq!(enlargement([256, 1]), 1);
    }
}
