//! Words and numbers in pictures.

use image::RgbImage;
use noto_sans_mono_bitmap::{
    FontWeight, RasterHeight, RasterizedChar, get_raster, get_raster_width,
};

const WEIGHT: FontWeight = FontWeight::Regular;
const SIZE: RasterHeight = RasterHeight::Size16;

/// The height of a line in pixels.
pub(crate) const LINE: usize = 16;

/// The width of `text` in pixels.
pub(crate) fn width(text: &str) -> usize {
    text.chars().count() * get_raster_width(WEIGHT, SIZE)
}

/// Writes `text` with its upper left corner at `at`; what leaves the picture is cut off. Characters
/// that the font lacks become question marks.
pub(crate) fn draw(picture: &mut RgbImage, at: [usize; 2], text: &str, ink: [u8; 3]) {
    for (i, character) in text.chars().enumerate() {
        let glyph = get_raster(character, WEIGHT, SIZE).or_else(|| get_raster('?', WEIGHT, SIZE));
        if let Some(glyph) = glyph {
            draw_glyph(picture, [at[0] + i * glyph.width(), at[1]], &glyph, ink);
        }
    }
}

fn draw_glyph(picture: &mut RgbImage, at: [usize; 2], glyph: &RasterizedChar, ink: [u8; 3]) {
    for (y, row) in glyph.rows().enumerate() {
        for (x, &cover) in row.iter().enumerate() {
            let (x, y) = ((at[0] + x) as u32, (at[1] + y) as u32);
            if let Some(pixel) = picture.get_pixel_mut_checked(x, y) {
                pixel.0 = std::array::from_fn(|c| blend(pixel.0[c], ink[c], cover));
            }
        }
    }
}

fn blend(below: u8, above: u8, cover: u8) -> u8 {
    let mixed = u32::from(below) * u32::from(255 - cover) + u32::from(above) * u32::from(cover);
    (mixed / 255) as u8
}

/// A number with 4 significant digits: `0.5`, `12.35`, `1.235e6`.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-3.0..5.0).contains(&magnitude) {
        let text = format!("{value:.3e}");
        return match text.split_once('e') {
            Some((digits, power)) => format!("{}e{power}", without_zeros(digits)),
            None => text,
        };
    }
    let decimals = (3.0 - magnitude).max(0.0) as usize;
    without_zeros(&format!("{value:.decimals$}")).to_owned()
}

/// Drops the zeros at the end of a decimal fraction.
fn without_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, "0"),
            (-0.5, "-0.5"),
            (12.3456, "12.35"),
            (1234.56, "1235"),
            (98765.4, "98765"),
            (1_234_567.0, "1.235e6"),
            (0.001_234_56, "0.001235"),
            (0.000_123, "1.23e-4"),
            (100.0, "100"),
            (f64::MAX, "1.798e308"),
            (5e-324, "4.941e-324"),
        ];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
    }

    #[test]
    fn text_is_cut_off_at_the_border() {
        let mut picture = RgbImage::from_pixel(20, 12, Rgb([255; 3]));
        draw(&mut picture, [4, 2], "W\u{4e2d}W and more", [0; 3]);
        assert!(picture.pixels().any(|pixel| pixel.0 == [0; 3]));
        assert_eq!(picture.get_pixel(0, 0).0, [255; 3]);
    }
}
