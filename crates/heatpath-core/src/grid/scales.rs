//! How wide the tubes of an image are.

use super::filter::{LARGEST_SCALE, Tubes, vesselness};
use super::medium::{Form, MediumError, given};
use super::seeds::long_pieces;
use super::skeleton::thin;
use super::{Grid, Mask, structure_level};
use crate::exec::Exec;

/// The scales of which [`vesselness`] should take the strongest, from the image itself; `None` if it
/// shows nothing long.
///
/// Tubes are looked for at scales from 1 up to an eighth of the shortest side, in steps of
/// `sqrt(2)`. Where the response is strong ([`structure_level`]) and the piece of cells that touch is
/// at least `least_extent` cell units long, from corner to corner of the box around it, each cell of
/// the centreline ([`thin`]) votes for the scale of its strongest response (Lindeberg 1998). The
/// three scales have a sixth, a half and five sixths of the votes below them, in ascending order;
/// fewer, if some are equal. Short pieces do not vote because noise, whose pieces are short, has the
/// smallest scale.
///
/// Of `tubes` the measure and the polarity count; the contrast and the elongation do not, and
/// the scales are what is looked for. Walls of `mask` do not vote, but are seen by derivatives: what
/// is outside of a field of view should be even
/// ([`normalize_contrast`](super::filter::normalize_contrast)).
///
/// # Errors
/// A value that is not finite, a mask of another size, a parameter of the measure out of range, or the
/// caller cancelled.
pub fn tube_scales<const D: usize>(
    image: &Grid<f64, D>,
    tubes: &Tubes,
    mask: &Mask<D>,
    least_extent: f64,
    exec: &Exec,
) -> Result<Option<Vec<f64>>, MediumError> {
    let scales = candidates(image);
    let search = Tubes { scales: scales.clone(), elongation: 1.0, contrast: None, ..tubes.clone() };
    let found = vesselness(image, &search, exec)?;
    let speed_sq = found.response.map(|response| response.max(WEAKEST).powi(2));
    let medium = given(speed_sq, Form::Pointwise)?.with_walls(mask.clone())?;
    let Some(level) = structure_level(&medium) else { return Ok(None) };
    let mut long = image.map(|_| false);
    for cell in long_pieces(&medium, level, least_extent).into_iter().flatten() {
        long.values_mut()[cell] = true;
    }
    let centreline = thin(&long);
    let voters = centreline.values().iter().zip(found.scale.values()).filter(|(on_it, _)| **on_it);
    let mut votes = vec![0.0; scales.len()];
    for (_, &scale) in voters {
        if let Some(vote) = scales.iter().position(|&candidate| candidate == scale) {
            votes[vote] += 1.0;
        }
    }
    let mut chosen: Vec<f64> = [1.0 / 6.0, 0.5, 5.0 / 6.0]
        .into_iter()
        .filter_map(|part| quantile(&votes, part))
        .map(|steps| 2.0_f64.powf(steps / STEPS_PER_OCTAVE).clamp(1.0, scales[scales.len() - 1]))
        .collect();
    chosen.dedup();
    Ok((!chosen.is_empty()).then_some(chosen))
}

/// The weakest response: where there is no tube.
const WEAKEST: f64 = 1e-3;

const STEPS_PER_OCTAVE: f64 = 2.0;

/// The scales to look at.
fn candidates<const D: usize>(image: &Grid<f64, D>) -> Vec<f64> {
    let shape = image.shape();
    let sides = shape.size().into_iter().zip(shape.spacing());
    let sides = sides.map(|(n, spacing)| n as f64 * spacing / shape.smallest_spacing());
    let largest = (sides.fold(f64::INFINITY, f64::min) / 8.0).clamp(1.0, LARGEST_SCALE);
    let scales = (0..).map(|step| 2.0_f64.powf(f64::from(step) / STEPS_PER_OCTAVE));
    scales.take_while(|&scale| scale <= largest).collect()
}

/// Where so large a part of the votes is below, in steps from the first candidate; a candidate's
/// votes are spread over the step around it. `None` if there are no votes.
fn quantile(votes: &[f64], part: f64) -> Option<f64> {
    let wanted = part * votes.iter().sum::<f64>();
    let mut below = 0.0;
    for (number, &vote) in votes.iter().enumerate() {
        if below + vote > wanted {
            return Some(number as f64 - 0.5 + (wanted - below) / vote);
        }
        below += vote;
    }
    None
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod tests {
    use super::*;
    use crate::grid::Shape;
    use crate::grid::filter::Polarity;

    /// Bright ribbons along x, of these middles and half widths, with soft edges, and some noise.
    fn ribbons(size: [usize; 2], ribbons: &[[f64; 2]], noise: f64) -> Grid<f64, 2> {
        let mut state = 1_u32;
        Grid::from_fn(Shape::new(size).unwrap(), |[_, y]| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let inside = |[middle, half]: &[f64; 2]| {
                (half + 0.5 - (y as f64 - middle).abs()).clamp(0.0, 1.0)
            };
            ribbons.iter().map(inside).sum::<f64>() + noise * f64::from(state >> 16) / 65536.0
        })
    }

    fn scales<const D: usize>(image: &Grid<f64, D>, polarity: Polarity) -> Vec<f64> {
        let tubes = Tubes { polarity, ..Tubes::default() };
        let mask = Mask::all_open(*image.shape());
        tube_scales(image, &tubes, &mask, 20.0, &Exec::single_threaded()).unwrap().unwrap()
    }

    #[test]
    fn tubes_of_one_width_have_its_scale() {
        for half in [1.5, 3.0, 6.0] {
            for noise in [0.0, 0.5] {
                let image = ribbons([160, 140], &[[40.0, half], [100.0, half]], noise);
                let scales = scales(&image, Polarity::Bright);
                assert_eq!(scales.len(), 3);
                for scale in scales {
                    assert!((0.75..1.35).contains(&(scale / half)), "{scale} {half} {noise}");
                }
            }
        }
    }

    #[test]
    fn tubes_count_by_their_length() {
        let image = ribbons([200, 160], &[[30.0, 1.5], [80.0, 3.0], [130.0, 6.0]], 0.1);
        let found = scales(&image, Polarity::Bright);
        for (scale, half) in found.iter().zip([1.5, 3.0, 6.0]) {
            assert!((0.7..1.4).contains(&(scale / half)), "{found:?}");
        }
        let dark = image.map(|value| 1.0 - value);
        let difference = |(a, b): (&f64, &f64)| (a - b).abs();
        let dark = scales(&dark, Polarity::Dark);
        assert!(dark.iter().zip(&found).map(difference).fold(0.0, f64::max) < 1e-6, "{dark:?}");
    }

    #[test]
    fn cylinders_are_strongest_below_their_radius() {
        let image = Grid::from_fn(Shape::new([40, 48, 48]).unwrap(), |[_, y, z]| {
            let distance = (y as f64 - 23.5).hypot(z as f64 - 23.5);
            (4.5 - distance).clamp(0.0, 1.0)
        });
        for scale in scales(&image, Polarity::Bright) {
            assert!((0.75..1.35).contains(&(scale / (4.0 / 2.0_f64.sqrt()))), "{scale}");
        }
    }

    #[test]
    fn there_may_be_nothing_long() {
        let exec = Exec::single_threaded();
        let spot = |[x, y]: [usize; 2]| f64::from(u8::from(x == 30 && y == 20));
        for image in [
            Grid::from_fn(Shape::new([60, 40]).unwrap(), |_| 0.5),
            Grid::from_fn(Shape::new([60, 40]).unwrap(), spot),
        ] {
            let mask = Mask::all_open(*image.shape());
            assert_eq!(tube_scales(&image, &Tubes::default(), &mask, 20.0, &exec), Ok(None));
        }
    }
}
