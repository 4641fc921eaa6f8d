//! Tubes of several widths.

use super::elongated::{Frame, Lines};
use super::flux::{HAT_VARIANCE, ball_over_sphere};
use super::measure::{Measure, Polarity};
use super::separable::{Derivatives, Scratch, for_each_slab, second_orders, slab_cells};
use super::{FilterError, QUIET};
use crate::error::{ParameterError, check, check_positive};
use crate::exec::{Cancelled, Exec};
use crate::grid::{Grid, Matrix, eigen};
use std::borrow::Cow;
use std::ops::Range;

/// The largest scale of [`Tubes`], in cells: wider ones are found sooner in a smaller image.
pub const LARGEST_SCALE: f64 = 100.0;

/// The largest elongation of [`Tubes`].
pub const LARGEST_ELONGATION: f64 = 10.0;

/// Which tubes [`vesselness`] looks for, and how.
///
/// The default measure and scales are those that did well, on the whole, at the vessels of the retina:
/// 8 pictures of `CHASE_DB1` and 4 of STARE, green channel, against the first observer's mask in the
/// field of view. Area under the ROC curve and best F1, in per cent; the flux had radii 3, 4.5 and
/// 6.8. On 10 other pictures Sato's area is the largest again.
///
/// | | `CHASE_DB1` | STARE |
/// | --- | --- | --- |
/// | Sato | 92.0, 66.9 | 93.5, 62.9 |
/// | Sato, elongation 2 | 93.7, 68.7 | 93.5, 61.7 |
/// | Sato, elongation 3 | 94.2, 68.7 | 93.0, 60.1 |
/// | Frangi | 91.1, 67.0 | 93.1, 63.4 |
/// | flux | 89.7, 60.7 | 92.8, 60.4 |
#[derive(Clone, Debug, PartialEq)]
pub struct Tubes {
    /// What is computed at each scale; default [`Measure::Sato`].
    pub measure: Measure,
    /// Brighter or darker than what is around them; default [`Polarity::Bright`].
    pub polarity: Polarity,
    /// The scales of which the strongest counts, in cell units: standard deviations of the Gaussian
    /// for the Hessian, radii for the flux. Positive, none above
    /// [`LARGEST_SCALE`].
    ///
    /// A ribbon of half width r, in a picture, is strongest at `sigma = r`, a cylinder of radius r,
    /// in a volume, at `sigma = r / sqrt(2)`, and both at a flux of radius r to `r + 1`. Default
    /// 2, 3 and 4.5.
    pub scales: Vec<f64>,
    /// How much longer than wide the Gaussian is, from 1 to [`LARGEST_ELONGATION`]; default 1, as
    /// wide as long.
    ///
    /// Above 1 the second derivatives are averaged along a line by a Gaussian of variance
    /// `(elongation^2 - 1) sigma^2` (for the flux of a radius instead of `sigma`), and the measure is
    /// taken of the eigenvalues across the line and the value along it; the largest response of all
    /// directions counts, 12 in a picture and 49 in a volume. A straight tube along one of them
    /// responds as before, noise and blobs less, and gaps are bridged, but bends and ends suffer.
    /// Between two directions the response falls: at an elongation of 3 to 0.86 in a picture, at
    /// 7.5 degrees, for a ribbon at its own scale, and in a volume to between 0.5 and 0.6, at 17.7
    /// degrees.
    ///
    /// On whole pictures the table above has the gain at `CHASE_DB1` and the loss at STARE. After
    /// [`normalize_contrast`](super::normalize_contrast) with a sigma of 15, at the scales 1.5, 3 and 5, an
    /// elongation of 1 has 88.7, 59.9 and 94.8, 68.5, of 3 92.2, 66.9 and 95.5, 69.1.
    ///
    /// 3 did best on the whole where vessels are faint. At the retina (4 pictures of `CHASE_DB1` of
    /// [normalised contrast](super::normalize_contrast), Sato's measure at 1.5, 3 and 5, thresholds
    /// with hysteresis) the skeleton has a recall and precision within 3 pixels of 0.70 and 0.84 at an
    /// elongation of 1, 0.74 and 0.84 at 2, 0.77 and 0.82 at 3, 0.78 and 0.81 at 4; on 4
    /// pictures of STARE nothing is gained. A picture takes about ten times as long at 3 as at 1.
    pub elongation: f64,
    /// What counts as a strong tube: the c of Frangi's measure, for the others the strength whose
    /// response is 1. Positive; `None`, the default, takes half the largest norm of a Hessian over all cells and
    /// scales for c, as Frangi et al. do, and the largest strength for the others, so that the
    /// response does not depend on the contrast of the image.
    ///
    /// It is compared with derivatives times `sigma^2`: at its own scale a ribbon of contrast 1 has
    /// an eigenvalue of 0.48 (`2 / sqrt(2 pi e)`), a cylinder two of 0.37 (`1 / e`).
    pub contrast: Option<f64>,
}

impl Default for Tubes {
    fn default() -> Self {
        Self {
            measure: Measure::Sato,
            polarity: Polarity::default(),
            scales: vec![2.0, 3.0, 4.5],
            elongation: 1.0,
            contrast: None,
        }
    }
}

/// How much each cell looks like a tube, and like which.
#[derive(Clone, Debug, PartialEq)]
pub struct Vesselness<const D: usize> {
    /// From 0, no tube, to 1: see [`Tubes::contrast`].
    pub response: Grid<f64, D>,
    /// The scale of the largest response, in cell units; 0 where there is none.
    pub scale: Grid<f64, D>,
    /// The unit vector along the tube at that scale, in physical axes; 0 where there is none. Of the
    /// two opposite vectors it is the one whose largest component is positive.
    pub direction: Grid<[f64; D], D>,
}

/// The largest response over all scales to a tube through each cell.
///
/// Derivatives are multiplied by `sigma^2` (Lindeberg 1998), so that thin and thick tubes of equal
/// contrast respond alike. (scikit-image's `frangi` lost this after version 0.19: issue 7711.)
///
/// # Errors
/// A value that is not finite, a parameter out of range, or the caller cancelled.
pub fn vesselness<const D: usize>(
    image: &Grid<f64, D>,
    tubes: &Tubes,
    exec: &Exec,
) -> Result<Vesselness<D>, FilterError> {
    image.check_finite()?;
    tubes.check()?;
    let search = Search { image, tubes, quiet: QUIET * image.largest_size(), exec };
    let frangi = matches!(tubes.measure, Measure::Frangi { .. });
    let (contrast, rest) = match tubes.contrast {
        Some(contrast) => (contrast, 0.0..1.0),
        None if frangi => (0.5 * search.largest_norm(0.0..0.3)?, 0.3..1.0),
        None => (1.0, 0.0..1.0),
    };
    let mut best = search.best(contrast, rest)?;
    if !frangi {
        let largest = best.response.values().iter().copied().fold(0.0, f64::max);
        let full = tubes.contrast.unwrap_or(largest);
        let values = best.response.values_mut().iter_mut().filter(|value| **value > 0.0);
        values.for_each(|value| *value = (*value / full).min(1.0));
    }
    Ok(best)
}

impl Tubes {
    fn check(&self) -> Result<(), ParameterError> {
        self.contrast.map_or(Ok(()), |contrast| check_positive("contrast", contrast))?;
        if let Measure::Frangi { alpha, beta } = self.measure {
            check_positive("alpha", alpha)?;
            check_positive("beta", beta)?;
        }
        for &scale in &self.scales {
            let is_right = scale > 0.0 && scale <= LARGEST_SCALE;
            check("scale", scale, is_right, "positive and at most 100 cells")?;
        }
        let is_right = (1.0..=LARGEST_ELONGATION).contains(&self.elongation);
        check("elongation", self.elongation, is_right, "from 1 to 10")?;
        check("number of scales", 0.0, !self.scales.is_empty(), "at least 1")
    }
}

/// One search for tubes.
struct Search<'a, const D: usize> {
    image: &'a Grid<f64, D>,
    tubes: &'a Tubes,
    /// Norms up to this one are rounding errors.
    quiet: f64,
    exec: &'a Exec<'a>,
}

impl<const D: usize> Search<'_, D> {
    /// The largest norm of a matrix over all cells and scales.
    fn largest_norm(&self, share: Range<f64>) -> Result<f64, Cancelled> {
        let mut largest = vec![0.0; self.image.shape().size()[D - 1]];
        for (scale, share) in self.scales(share) {
            let layer = self.layer(scale, share)?;
            layer.visit(largest.iter_mut(), self.exec, |largest: &mut &mut f64, _, matrix| {
                **largest = largest.max(norm(matrix));
            })?;
        }
        Ok(largest.into_iter().fold(0.0, f64::max))
    }

    /// The strongest response of each cell.
    fn best(&self, contrast: f64, share: Range<f64>) -> Result<Vesselness<D>, Cancelled> {
        let shape = self.image.shape();
        let mut best = Vesselness {
            response: self.image.map(|_| 0.0),
            scale: self.image.map(|_| 0.0),
            direction: self.image.map(|_| [0.0; D]),
        };
        for (scale, share) in self.scales(share) {
            let layer = self.layer(scale, share)?;
            let responses = best.response.values_mut().chunks_mut(slab_cells(shape));
            let scales = best.scale.values_mut().chunks_mut(slab_cells(shape));
            let directions = best.direction.values_mut().chunks_mut(slab_cells(shape));
            let parts = responses.zip(scales).zip(directions);
            let keep = |part: &mut Part<'_, D>, cell, (response, direction)| {
                let ((responses, scales), directions) = part;
                if response > responses[cell] {
                    (responses[cell], scales[cell]) = (response, scale);
                    directions[cell] = direction;
                }
            };
            if self.tubes.elongation > 1.0 {
                let lines = layer.lines([scale, self.tubes.elongation], self.exec)?;
                let share = layer.middle()..layer.share.end;
                lines.visit(parts, (share, self.exec), |part, cell, matrix, frame| {
                    let response = self.strength_along(frame, matrix, contrast);
                    if response > part.0.0[cell] && norm(matrix) > self.quiet {
                        keep(part, cell, (response, frame.along));
                    }
                })?;
            } else {
                layer.visit(parts, self.exec, |part, cell, matrix| {
                    if norm(matrix) > self.quiet {
                        keep(part, cell, self.strength(matrix, contrast));
                    }
                })?;
            }
        }
        self.exec.report(1.0)?;
        Ok(best)
    }

    /// The strength of a tube, and its direction.
    fn strength(&self, matrix: &Matrix<D>, contrast: f64) -> (f64, [f64; D]) {
        let (values, vectors) = eigen(matrix);
        let strength = |values| self.tubes.measure.strength(values, contrast);
        let bright = || (strength(values), vectors[D - 1]);
        let dark = || (strength(std::array::from_fn(|i| -values[D - 1 - i])), vectors[0]);
        match self.tubes.polarity {
            Polarity::Bright => bright(),
            Polarity::Dark => dark(),
            Polarity::Both => {
                let (bright, dark) = (bright(), dark());
                if bright.0 >= dark.0 { bright } else { dark }
            }
        }
    }

    /// The strength of a tube along a given direction.
    fn strength_along(&self, frame: &Frame<D>, matrix: &Matrix<D>, contrast: f64) -> f64 {
        let strength =
            |matrix: &Matrix<D>| self.tubes.measure.strength(frame.values(matrix), contrast);
        let dark = || strength(&matrix.map(|row| row.map(|entry| -entry)));
        match self.tubes.polarity {
            Polarity::Bright => strength(matrix),
            Polarity::Dark => dark(),
            Polarity::Both => strength(matrix).max(dark()),
        }
    }

    /// Each scale with its part of the `share` of the whole.
    fn scales(&self, share: Range<f64>) -> impl Iterator<Item = (f64, Range<f64>)> {
        let part = (share.end - share.start) / self.tubes.scales.len() as f64;
        self.tubes.scales.iter().enumerate().map(move |(i, &scale)| {
            let start = share.start + i as f64 * part;
            (scale, start..start + part)
        })
    }

    /// What the second derivatives at one scale are taken of, and how.
    fn layer(&self, scale: f64, share: Range<f64>) -> Result<Layer<'_, D>, Cancelled> {
        let (shape, simd) = (*self.image.shape(), self.exec.simd());
        if self.tubes.measure != Measure::OrientedFlux {
            let derivatives = Derivatives::new(shape, scale, simd);
            return Ok(Layer {
                image: Cow::Borrowed(self.image),
                derivatives,
                factor: scale * scale,
                share,
            });
        }
        let half = 0.5 * (share.start + share.end);
        let image = ball_over_sphere(self.image, scale, share.start..half, self.exec)?;
        // The hat which has blurred the ball already is part of the Gaussian of one cell.
        let blur = |spacing: f64| HAT_VARIANCE * (spacing / shape.smallest_spacing()).powi(2);
        let sigmas = shape.spacing().map(|spacing| (1.0 - blur(spacing)).max(0.0).sqrt());
        let derivatives = Derivatives::with_sigmas(shape, sigmas, simd);
        Ok(Layer { image: Cow::Owned(image), derivatives, factor: 1.0, share: half..share.end })
    }
}

/// Responses, scales and directions of one slab.
type Part<'a, const D: usize> = ((&'a mut [f64], &'a mut [f64]), &'a mut [[f64; D]]);

/// One scale.
struct Layer<'a, const D: usize> {
    image: Cow<'a, Grid<f64, D>>,
    derivatives: Derivatives<D>,
    factor: f64,
    /// The part of the whole that going through it once is.
    share: Range<f64>,
}

impl<const D: usize> Layer<'_, D> {
    /// Calls `visit(part, cell, matrix)` for the matrix of each cell of the slab that each of
    /// `parts` belongs to.
    fn visit<T: Send>(
        &self,
        parts: impl Iterator<Item = T>,
        exec: &Exec,
        visit: impl Fn(&mut T, usize, &Matrix<D>) + Sync + Send,
    ) -> Result<(), Cancelled> {
        let cells = slab_cells(self.image.shape());
        let scratch = || (self.derivatives.scratch(), vec![[[0.0; D]; D]; cells]);
        for_each_slab(
            exec,
            self.share.clone(),
            parts,
            scratch,
            |(scratch, matrices), slab, part| {
                self.matrices(slab, scratch, matrices);
                for (cell, matrix) in matrices.iter().enumerate() {
                    visit(part, cell, matrix);
                }
            },
        )
    }

    /// The second derivatives, to be averaged along lines, which is half of the work.
    fn lines(&self, [scale, elongation]: [f64; 2], exec: &Exec) -> Result<Lines<D>, Cancelled> {
        let progress = (self.share.start..self.middle(), exec);
        Lines::new(&self.image, &self.derivatives, [self.factor, scale, elongation], progress)
    }

    fn middle(&self) -> f64 {
        0.5 * (self.share.start + self.share.end)
    }

    /// The second derivatives of one slab.
    fn matrices(&self, slab: usize, scratch: &mut Scratch, matrices: &mut [Matrix<D>]) {
        let pairs: Vec<_> = (0..D).flat_map(|i| (i..D).map(move |j| [i, j])).collect();
        let orders = second_orders();
        self.derivatives.slab(&self.image, slab, &orders, scratch, |component, first, row| {
            let [i, j] = pairs[component];
            for (matrix, value) in matrices[first..].iter_mut().zip(row) {
                matrix[i][j] = self.factor * value;
                matrix[j][i] = self.factor * value;
            }
        });
    }
}

/// The Frobenius norm.
fn norm<const D: usize>(matrix: &Matrix<D>) -> f64 {
    matrix.iter().flatten().map(|entry| entry * entry).sum::<f64>().sqrt()
}
