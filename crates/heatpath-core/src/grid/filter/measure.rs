//! How much the eigenvalues of a cell look like a tube.

/// Which tubes are looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Polarity {
    /// Tubes that are brighter than what is around them.
    #[default]
    Bright,
    /// Tubes that are darker than what is around them.
    Dark,
    /// Both kinds.
    Both,
}

/// How the eigenvalues of a cell become one number.
///
/// The formulas are for bright tubes, whose grey value falls to all sides: with the eigenvalues
/// `l1 >= l2 >= l3`, of which a picture has no `l3`, that along a tube is l1, near 0, and those
/// across are negative. Dark tubes are the bright ones of the negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// Frangi et al. (1998), from the Hessian: `exp(-Rb^2 / 2 beta^2) (1 - exp(-S^2 / 2 c^2))` in a
    /// picture, with `Rb = l1 / l2`, times `1 - exp(-Ra^2 / 2 alpha^2)` in a volume, with
    /// `Ra = l2 / l3` and `Rb = l1 / sqrt(l2 l3)`; S is the Frobenius norm, and c is the
    /// [`contrast`](super::Tubes::contrast). 0 where a value across is not negative or is
    /// smaller in size than l1.
    Frangi {
        /// How strictly plates are told from tubes, in volumes. Positive; Frangi et al. take 0.5.
        alpha: f64,
        /// How strictly blobs are told from tubes. Positive; Frangi et al. take 0.5.
        beta: f64,
    },
    /// Sato et al. (1998), from the Hessian: `w exp(-l1^2 / 2 (a w)^2)` with `w = -l2`, the smaller
    /// of the values across, and `a = 0.5` where l1 is negative and 2 where it is positive, so that
    /// a tube is not cut where it grows brighter along its way.
    Sato,
    /// Law & Chung (2008), from the optimally oriented flux through a circle or sphere: `-l2` in a
    /// picture and the geometric mean `sqrt(l2 l3)` in a volume. The flux is that of the gradient
    /// smoothed by one cell unit, over the circumference `2 pi r` or surface `4 pi r^2`. What
    /// touches the sphere at one side only is hardly seen, so neighbouring tubes stay apart. Unlike
    /// for the Hessian the response to tubes of equal contrast falls with their radius, as
    /// `1 / sqrt(r)`.
    OrientedFlux,
}

impl Measure {
    /// Frangi's measure with his own parameters.
    pub const FRANGI: Self = Self::Frangi { alpha: 0.5, beta: 0.5 };

    /// The strength of a bright tube with these ascending eigenvalues.
    pub(super) fn strength<const D: usize>(self, values: [f64; D], contrast: f64) -> f64 {
        let (strongest, weakest, along) = (values[0], values[D - 2], values[D - 1]);
        if weakest >= 0.0 {
            return 0.0;
        }
        match self {
            Self::Frangi { .. } if along > -weakest => 0.0,
            Self::Frangi { alpha, beta } => {
                let norm_sq: f64 = values.iter().map(|value| value * value).sum();
                let plate = if D == 3 { rise(weakest / strongest, alpha) } else { 1.0 };
                let blob_sq = along * along / (strongest * weakest);
                plate * (-blob_sq / (2.0 * beta * beta)).exp() * rise(norm_sq.sqrt(), contrast)
            }
            Self::Sato => {
                let tolerance = if along > 0.0 { 2.0 } else { 0.5 };
                -weakest * (1.0 - rise(along, tolerance * weakest))
            }
            Self::OrientedFlux => (strongest * weakest).sqrt(),
        }
    }
}

/// `1 - exp(-x^2 / 2 scale^2)`: 0 where x is far below the scale, 1 where it is far above.
pub(crate) fn rise(x: f64, scale: f64) -> f64 {
    -(-0.5 * (x / scale).powi(2)).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-14, "{found} is not {expected}");
    }

    #[test]
    fn frangi_in_numbers() {
        let e = |x: f64| x.exp();
        close(Measure::FRANGI.strength([-2.0, 1.0], 5.0_f64.sqrt()), e(-0.5) * (1.0 - e(-0.5)));
        let in_space = Measure::FRANGI.strength([-4.0, -1.0, 1.0], 3.0);
        close(in_space, (1.0 - e(-0.125)) * e(-0.5) * (1.0 - e(-1.0)));
        assert_eq!(Measure::FRANGI.strength([-2.0, 2.5], 1.0), 0.0, "a valley");
        assert_eq!(Measure::FRANGI.strength([-2.0, 0.5, 1.0], 1.0), 0.0, "a plate");
    }

    #[test]
    fn sato_and_flux_in_numbers() {
        close(Measure::Sato.strength([-2.0, -1.0], 1.0), 2.0 * (-0.5_f64).exp());
        close(Measure::Sato.strength([-3.0, -2.0, 4.0], 1.0), 2.0 * (-0.5_f64).exp());
        close(Measure::OrientedFlux.strength([-8.0, -2.0, 1.0], 1.0), 4.0);
        close(Measure::OrientedFlux.strength([-8.0, 1.0], 1.0), 8.0);
        assert_eq!(Measure::Sato.strength([-1.0, 0.0, 0.0], 1.0), 0.0);
    }
}
