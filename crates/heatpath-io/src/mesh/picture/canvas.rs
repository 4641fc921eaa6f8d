//! Samples with a height, two by two a pixel.

use image::{Rgba, RgbaImage};

/// Samples a pixel along each axis.
pub(super) const SAMPLES: usize = 2;

/// Colours and the height of what was drawn, nearest to the eye.
pub(super) struct Canvas {
    size: [usize; 2],
    colours: Vec<[u8; 3]>,
    /// Minus infinity where nothing was drawn.
    heights: Vec<f32>,
    is_covered: Vec<bool>,
}

impl Canvas {
    /// An empty canvas for a picture of `pixels`.
    pub(super) fn new(pixels: [usize; 2]) -> Self {
        let size = pixels.map(|side| side * SAMPLES);
        let count = size[0] * size[1];
        Self {
            size,
            colours: vec![[0; 3]; count],
            heights: vec![f32::NEG_INFINITY; count],
            is_covered: vec![false; count],
        }
    }

    /// Columns and rows of samples.
    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The samples along an axis whose middle lies in `low..=high`.
    pub(super) fn range(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        // The casts send negative numbers to 0.
        let start = (low - 0.5).ceil() as usize;
        let end = ((high - 0.5).floor() + 1.0) as usize;
        start..end.min(self.size[axis])
    }

    /// Draws a sample of the surface if it is nearer than what is there.
    pub(super) fn put(
        &mut self,
        x: usize,
        y: usize,
        height: f64,
        colour: impl FnOnce() -> [u8; 3],
    ) {
        let sample = y * self.size[0] + x;
        if height as f32 > self.heights[sample] {
            self.heights[sample] = height as f32;
            self.colours[sample] = colour();
            self.is_covered[sample] = true;
        }
    }

    /// Whether the surface leaves what lies at this height free to be seen.
    pub(super) fn is_free(&self, x: usize, y: usize, height: f64) -> bool {
        height as f32 >= self.heights[y * self.size[0] + x]
    }

    /// Draws over a sample, `cover` from 0 to 255 of it.
    pub(super) fn paint(&mut self, x: usize, y: usize, [r, g, b, cover]: [u8; 4]) {
        let sample = y * self.size[0] + x;
        let cover = if self.is_covered[sample] { u32::from(cover) } else { 255 };
        let below = self.colours[sample];
        self.colours[sample] = std::array::from_fn(|c| {
            let (above, below) = (u32::from([r, g, b][c]), u32::from(below[c]));
            ((above * cover + below * (255 - cover)) / 255) as u8
        });
        self.is_covered[sample] = true;
    }

    /// The mean of the samples of each pixel; those where nothing was drawn make it transparent.
    pub(super) fn into_picture(self) -> RgbaImage {
        let [width, height] = self.size.map(|side| (side / SAMPLES) as u32);
        RgbaImage::from_fn(width, height, |x, y| {
            let first = y as usize * SAMPLES * self.size[0] + x as usize * SAMPLES;
            let samples = (0..SAMPLES * SAMPLES)
                .map(|i| first + i / SAMPLES * self.size[0] + i % SAMPLES)
                .filter(|&sample| self.is_covered[sample]);
            let (mut sum, mut count) = ([0_u32; 3], 0);
            for sample in samples {
                (0..3).for_each(|c| sum[c] += u32::from(self.colours[sample][c]));
                count += 1;
            }
            let [r, g, b] = sum.map(|sum| ((sum + count / 2) / count.max(1)) as u8);
            Rgba([r, g, b, (255 * count / (SAMPLES * SAMPLES) as u32) as u8])
        })
    }
}
